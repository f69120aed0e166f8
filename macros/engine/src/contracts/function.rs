//! Functions that are generated: one row each, which all stages read.
//!
//! A row says what asks for the function, its name, what it takes, what it gives and its documentation. The [`Shape`] says
//! what type it gives, and which slots fill it.

use std::borrow::Cow;

use crate::model::types::{Model, Request};

use super::results::{Form, Parts, Slot};

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum FunctionKind {
    /// Accelerations in the order of velocity coordinates, then the rates of the user's states; with constraints the
    /// multipliers and the rank of their system; with iterations the greatest residual of the loops.
    ForwardDynamics,
    /// Efforts in the order of velocity coordinates; with `solve_for` the inputs found, then the rank of their system.
    InverseDynamics,
    /// DOF x DOF, row by row.
    MassMatrix,
    /// Of the same what is on and below the diagonal, row by row.
    MassMatrixLower,
    /// DOF
    Bias,
    KineticEnergy,
    PotentialEnergy,
    /// Residuals of the constraint equations.
    Constraints,
    /// Equations x DOF, row by row.
    ConstraintJacobian,
    /// Equations x displacements of the position, row by row, where velocities are others.
    PositionJacobian,
    /// Time derivatives of the residuals.
    ConstraintRate,
    /// What is left of the second time derivatives of the residuals where accelerations are zero.
    ConstraintBias,
    /// DOF dynamic rows M a + bias + G^T lambda, then the residuals of the constraint equations.
    Residual,
    /// Of the model's kinematics number k: values, then rates, then accelerations.
    Kinematics(usize),
    /// What vanishes where the model's assembly modes are, by the point of the circle that tells them.
    AssemblyCondition,
    /// Coordinates in the mode that a point and sides tell, then the greatest error of the distances.
    Assembly,
    /// The unknowns of all iterations, then the greatest residual.
    Guess,
    /// Roots in closed forms of loops that vanish where two solutions meet.
    DeadCentres,
    /// Of each of `Structure::margins` what vanishes in its dead centre, and the rate of its square; then, with iterations,
    /// the greatest residual at the guess.
    Margins,
    /// Of each of `Structure::granted` the residual over its scale, at the guess.
    Granted,
    /// Partial derivatives of the accelerations and of the rates of own states, R of them: R x DOF by displacements of the
    /// position, R x DOF by velocities, R x own states, R x scalars of inputs, each row by row.
    ForwardDerivatives,
    /// The same of the efforts, DOF of them.
    InverseDerivatives,
    /// Matrices A, B, C, D of the equations linearised at a state, each row by row: of the rates of displacements, velocities
    /// and own states, then of all scalars of outputs; by displacements, velocities and own states, and by scalars of inputs.
    Linearization,
    /// The jump of the velocities; with constraints the multipliers and the rank of their system.
    Impulse,
    /// Rates of positions, where velocities are others.
    PositionRates,
    /// Of these R x displacements of the position, R x velocities, R x own states, R x scalars of inputs, each row by row.
    RateDerivatives,
    /// The least displacement that the constraint equations demand, DOF of it, then their rank.
    Displacement,
    /// Momenta, by velocity coordinate.
    Momentum,
    /// Their rates.
    MomentumRate,
    /// Velocities that belong to momenta.
    MomentumVelocity,
    /// Angular momentum about the centre of mass, then linear momentum, by velocity: 6 x DOF, row by row.
    CentroidalMomentumMatrix,
    /// The two themselves, for laws alone.
    CentroidalMomentum,
    /// Of each body the position of its frame's origin, then its rotation row by row, in the order of declaration.
    Poses,
    /// Output after output, flattened: `Vec3` 3, `Rotation` 9 row by row, `Pose` x, y, z, w, i, j, k, `Twist` and
    /// `Wrench` 6, `Jacobian` 6 x DOF row by row, arrays element by element.
    Outputs,
    /// The same of the model's group of outputs number k alone.
    OutputGroup(usize),
}

/// What asks for a function.
#[derive(Clone, Copy)]
pub enum Asked {
    /// The user, by a word in `emit`; the trait of the runtime's `emitted` speaks of it where it is missing.
    By { request: Request, word: &'static str, missing: &'static str },
    /// Equations that keep a multiplier.
    Equations,
    /// Velocities that are no rates of positions.
    Speeds,
    /// Loops that Newton's method closes.
    Guesses,
    /// Outputs of the model.
    Outputs,
    /// What the derivation has found: a loop with a dead centre, an equation that was left out.
    Found,
}

/// What a method takes besides `&self`, in this order.
#[derive(Clone, Copy, PartialEq, Eq, Default)]
pub struct Arguments {
    pub time: bool,
    /// The state, or else only its position.
    pub state: bool,
    pub input: bool,
    pub accel: bool,
    pub multipliers: bool,
    /// With the rates of the constraint equations, if there are any.
    pub impulse: bool,
    /// Of the constraint equations.
    pub rates: bool,
    pub momentum: bool,
    /// What tells an assembly mode.
    pub alternative: bool,
}

impl Arguments {
    const POSITION: Arguments = Arguments {
        time: false,
        state: false,
        input: false,
        accel: false,
        multipliers: false,
        impulse: false,
        rates: false,
        momentum: false,
        alternative: false,
    };
    const TIMED: Arguments = Arguments { time: true, ..Arguments::POSITION };
    const ALTERNATIVE: Arguments = Arguments { alternative: true, ..Arguments::TIMED };
    const STATE: Arguments = Arguments { state: true, ..Arguments::POSITION };
    const TIMED_STATE: Arguments = Arguments { time: true, ..Arguments::STATE };
    const ALL: Arguments = Arguments { input: true, ..Arguments::TIMED_STATE };
}

/// How large a model's structs are.
#[derive(Clone, Copy, Default)]
pub struct Sizes {
    pub dof: usize,
    /// Components of a displacement of the position.
    pub displacements: usize,
    /// Whether velocities are no rates of positions.
    pub speeds: bool,
    /// Equations that keep a multiplier.
    pub rows: usize,
    /// Scalars of own states, inputs, outputs.
    pub states: usize,
    pub inputs: usize,
    pub outputs: usize,
    pub guesses: usize,
    /// Inputs that inverse dynamics finds in the place of efforts.
    pub solved: Option<usize>,
    /// Coordinates that the kinematics, or the assembly modes, in question find.
    pub found: usize,
    /// Scalars of the group of outputs in question.
    pub grouped: usize,
    pub dead_centres: usize,
    pub margins: usize,
    pub granted: usize,
    /// Scalars of the bodies' poses.
    pub poses: usize,
}

impl Sizes {
    /// Whether forward dynamics gives more than accelerations.
    pub fn has_derivative(&self) -> bool {
        self.speeds || self.states > 0 || self.rows > 0 || self.guesses > 0
    }
}

/// What results fill.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    Scalar,
    Vector(usize),
    /// Row by row.
    Matrix(usize, usize),
    /// Of a symmetric matrix of so many rows what is on and below the diagonal, row by row.
    Lower(usize),
    Velocity,
    /// Of positions.
    Rates,
    /// Accelerations, rates of own states, rates of positions where velocities are others, multipliers, rank, residual: those that there are.
    Derivative,
    /// Inputs, then the rank of their system.
    Solved(usize),
    /// Dynamic rows, then equations: one vector.
    Residual,
    /// So many roots, each with the rate of its square, then the residual, if there is one: one vector.
    Margins(usize),
    /// Velocities, multipliers, rank.
    Jump,
    Poses,
    Outputs,
    /// Scalars of a group of outputs.
    OutputGroup(usize),
    /// Positions, rates, accelerations, so many each, then the residual.
    Kinematics(usize),
    /// Positions, so many, then the residual.
    Assembly(usize),
    /// Of so many results: matrices by position, velocity, own states, inputs.
    Derivatives(usize),
    /// Of so many components of the state.
    Linearization(usize),
    /// The unknowns of all iterations, then the greatest residual.
    Closed,
}

impl Shape {
    /// The slots that fill it.
    pub fn parts(self, sizes: &Sizes) -> Parts {
        let one = |form| Parts::default().with(Slot::Value, form);
        let velocity = || Parts::default().with(Slot::Velocity, Form::Vector(sizes.dof));
        let any = |parts: Parts, slot, size: usize| if size > 0 { parts.with(slot, Form::Vector(size)) } else { parts };
        let multipliers = |parts: Parts| {
            if sizes.rows == 0 {
                return parts;
            }
            parts.with(Slot::Multipliers, Form::Vector(sizes.rows)).with(Slot::Rank, Form::Scalar)
        };
        let residual = |parts: Parts| if sizes.guesses > 0 { parts.with(Slot::Residual, Form::Scalar) } else { parts };
        match self {
            Shape::Scalar => one(Form::Scalar),
            Shape::Vector(size) => one(Form::Vector(size)),
            Shape::Matrix(rows, columns) => one(Form::Matrix(rows, columns)),
            Shape::Lower(rows) => one(Form::Vector(triangle(rows))),
            Shape::Velocity => velocity(),
            Shape::Rates => one(Form::Vector(sizes.displacements)),
            Shape::Derivative => {
                let moved = if sizes.speeds { sizes.displacements } else { 0 };
                let states = any(velocity(), Slot::States, sizes.states);
                residual(multipliers(any(states, Slot::Rates, moved)))
            }
            Shape::Solved(inputs) => {
                Parts::default().with(Slot::Inputs, Form::Vector(inputs)).with(Slot::Rank, Form::Scalar)
            }
            Shape::Residual => any(velocity(), Slot::Gaps, sizes.rows),
            Shape::Margins(count) => residual(one(Form::Vector(2 * count))),
            Shape::Jump => multipliers(velocity()),
            Shape::Poses => one(Form::Vector(sizes.poses)),
            Shape::Outputs => one(Form::Vector(sizes.outputs)),
            Shape::OutputGroup(size) => one(Form::Vector(size)),
            Shape::Kinematics(found) => [Slot::Positions, Slot::Rates, Slot::Accelerations]
                .into_iter()
                .fold(Parts::default(), |parts, slot| parts.with(slot, Form::Vector(found)))
                .with(Slot::Residual, Form::Scalar),
            Shape::Assembly(found) => {
                Parts::default().with(Slot::Positions, Form::Vector(found)).with(Slot::Residual, Form::Scalar)
            }
            Shape::Derivatives(results) => [
                (Slot::ByPosition, sizes.displacements),
                (Slot::ByVelocity, sizes.dof),
                (Slot::ByState, sizes.states),
                (Slot::ByInput, sizes.inputs),
            ]
            .into_iter()
            .fold(Parts::default(), |parts, (slot, columns)| parts.with(slot, Form::Matrix(results, columns))),
            Shape::Linearization(state) => [
                (Slot::StateMatrix, state, state),
                (Slot::InputMatrix, state, sizes.inputs),
                (Slot::OutputMatrix, sizes.outputs, state),
                (Slot::Feedthrough, sizes.outputs, sizes.inputs),
            ]
            .into_iter()
            .fold(Parts::default(), |parts, (slot, rows, columns)| parts.with(slot, Form::Matrix(rows, columns))),
            Shape::Closed => residual(Parts::default().with(Slot::Unknowns, Form::Vector(sizes.guesses))),
        }
    }
}

/// Entries on and below the diagonal of so many rows.
pub fn triangle(rows: usize) -> usize {
    rows * (rows + 1) / 2
}

/// One generated function.
pub struct FunctionRow {
    pub asked: Asked,
    /// Of the method; kinematics behind the first have their number in it, groups of outputs their name behind it.
    pub name: &'static str,
    /// What its meaning demands.
    pub takes: Arguments,
    pub gives: fn(&Sizes) -> Shape,
    /// Of kinematics, `{}` are the coordinates that it finds.
    pub documentation: fn(&Sizes) -> &'static str,
}

impl FunctionKind {
    /// All of them in the order in which they are derived; the first kinematics and the first group of outputs for all.
    pub const ALL: [FunctionKind; 35] = [
        FunctionKind::ForwardDynamics,
        FunctionKind::InverseDynamics,
        FunctionKind::MassMatrix,
        FunctionKind::MassMatrixLower,
        FunctionKind::Bias,
        FunctionKind::KineticEnergy,
        FunctionKind::PotentialEnergy,
        FunctionKind::Constraints,
        FunctionKind::ConstraintJacobian,
        FunctionKind::PositionJacobian,
        FunctionKind::ConstraintRate,
        FunctionKind::ConstraintBias,
        FunctionKind::Guess,
        FunctionKind::Residual,
        FunctionKind::Kinematics(0),
        FunctionKind::AssemblyCondition,
        FunctionKind::Assembly,
        FunctionKind::ForwardDerivatives,
        FunctionKind::InverseDerivatives,
        FunctionKind::Linearization,
        FunctionKind::Impulse,
        FunctionKind::Momentum,
        FunctionKind::MomentumRate,
        FunctionKind::MomentumVelocity,
        FunctionKind::CentroidalMomentumMatrix,
        FunctionKind::CentroidalMomentum,
        FunctionKind::Poses,
        FunctionKind::Outputs,
        FunctionKind::OutputGroup(0),
        FunctionKind::DeadCentres,
        FunctionKind::Margins,
        FunctionKind::Granted,
        FunctionKind::Displacement,
        FunctionKind::PositionRates,
        FunctionKind::RateDerivatives,
    ];

    /// Name of its method.
    pub fn method(self, model: &Model) -> Cow<'static, str> {
        match self {
            FunctionKind::OutputGroup(number) if number < model.output_groups.len() => {
                Cow::Owned(model.output_groups[number].method())
            }
            FunctionKind::Kinematics(number) if number > 0 => Cow::Owned(format!("{}_{}", self.row().name, number + 1)),
            kind => Cow::Borrowed(kind.row().name),
        }
    }

    pub fn row(self) -> FunctionRow {
        use Request as R;
        let by = |request, word, missing| Asked::By { request, word, missing };
        let row = |asked, name, takes, gives, documentation| FunctionRow { asked, name, takes, gives, documentation };
        match self {
            FunctionKind::ForwardDynamics => row(
                by(R::ForwardDynamics, "forward_dynamics", "ForwardDynamics"),
                "forward_dynamics",
                Arguments::ALL,
                |s| if s.has_derivative() { Shape::Derivative } else { Shape::Velocity },
                |s| match (s.has_derivative(), s.rows, s.guesses) {
                    (false, ..) => "Accelerations.",
                    (true, 0, 0) => "Accelerations, and the rates of the model's own states.",
                    (true, 0, _) => "Accelerations, and how well the loops are closed.",
                    (true, ..) => "Accelerations, and the multipliers of the constraint equations.",
                },
            ),
            FunctionKind::InverseDynamics => row(
                by(R::InverseDynamics, "inverse_dynamics", "InverseDynamics"),
                "inverse_dynamics",
                Arguments { accel: true, ..Arguments::ALL },
                |s| s.solved.map_or(Shape::Velocity, Shape::Solved),
                |s| match s.solved {
                    Some(_) => {
                        "The inputs that produce the accelerations `accel`, in the place of what `input` says of them."
                    }
                    None => "Efforts that the accelerations `accel` need beside all declared forces.",
                },
            ),
            FunctionKind::MassMatrix => row(
                by(R::MassMatrix, "mass_matrix", "MassMatrix"),
                "mass_matrix",
                Arguments::POSITION,
                |s| Shape::Matrix(s.dof, s.dof),
                |_| "Mass matrix `M` of `M * accel + bias = effort`.",
            ),
            FunctionKind::MassMatrixLower => row(
                by(R::MassMatrixLower, "mass_matrix_lower", "MassMatrix"),
                "mass_matrix_lower",
                Arguments::POSITION,
                |s| Shape::Lower(s.dof),
                |_| "What is on and below the diagonal of the mass matrix `M` of `M * accel + bias = effort`, which is symmetric.",
            ),
            FunctionKind::Bias => row(
                by(R::Bias, "bias", "Bias"),
                "bias",
                Arguments::ALL,
                |s| Shape::Vector(s.dof),
                |_| {
                    "The efforts at zero acceleration, `bias` of `M * accel + bias = effort`; declared forces and gravity are \
                     in it."
                },
            ),
            FunctionKind::KineticEnergy => row(
                by(R::Energy, "energy", "Energy"),
                "kinetic_energy",
                Arguments::STATE,
                |_| Shape::Scalar,
                |_| "`[J]` Kinetic energy of all bodies.",
            ),
            FunctionKind::PotentialEnergy => row(
                by(R::Energy, "energy", "Energy"),
                "potential_energy",
                Arguments::POSITION,
                |_| Shape::Scalar,
                |_| "`[J]` Potential energy: gravity's, zero at the world's origin, plus the springs'.",
            ),
            FunctionKind::Constraints => row(
                Asked::Equations,
                "constraints",
                Arguments::TIMED,
                |s| Shape::Vector(s.rows),
                |_| "Residuals of the constraint equations, zero where the loops are closed.",
            ),
            FunctionKind::ConstraintJacobian => row(
                Asked::Equations,
                "constraint_jacobian",
                Arguments::TIMED,
                |s| Shape::Matrix(s.rows, s.dof),
                |_| "The Jacobian `G` of the constraint equations by the velocities.",
            ),
            FunctionKind::PositionJacobian => row(
                Asked::Equations,
                "position_jacobian",
                Arguments::TIMED,
                |s| Shape::Matrix(s.rows, s.displacements),
                |_| {
                    "The Jacobian of the constraint equations by displacements of the position; of equations of velocities by the \
                     rates of positions."
                },
            ),
            FunctionKind::PositionRates => row(
                Asked::Speeds,
                "position_rates",
                Arguments::TIMED_STATE,
                |_| Shape::Rates,
                |_| "Rates of positions: the velocities of all coordinates, which follow from those of the state.",
            ),
            FunctionKind::RateDerivatives => row(
                Asked::Speeds,
                "rate_derivatives",
                Arguments::TIMED_STATE,
                |s| Shape::Derivatives(s.displacements),
                |_| "Partial derivatives of `position_rates`; those of a rotation are components of its angular velocity along its own axes.",
            ),
            FunctionKind::ConstraintRate => row(
                Asked::Equations,
                "constraint_rate",
                Arguments::TIMED_STATE,
                |s| Shape::Vector(s.rows),
                |_| "Time derivatives of the residuals of the constraint equations, `G * v` and what moves in time by itself.",
            ),
            FunctionKind::ConstraintBias => row(
                Asked::Equations,
                "constraint_bias",
                Arguments::TIMED_STATE,
                |s| Shape::Vector(s.rows),
                |_| {
                    "What is left of the second time derivatives of the residuals of the constraint equations where the \
                     accelerations are zero: the derivatives are `G * accel + constraint_bias`."
                },
            ),
            FunctionKind::Guess => row(
                Asked::Guesses,
                "close",
                Arguments::TIMED_STATE,
                |_| Shape::Closed,
                |_| "Closes the loops by Newton's method: the state with the solution as its guess, and the greatest residual.",
            ),
            FunctionKind::Residual => row(
                by(R::Residual, "residual", "Residual"),
                "residual",
                Arguments { accel: true, multipliers: true, ..Arguments::ALL },
                |_| Shape::Residual,
                |_| {
                    "All equations as a residual: `M * accel + bias + G^T * multipliers`, then the residuals of the constraint \
                     equations."
                },
            ),
            FunctionKind::Kinematics(_) => row(
                by(R::Kinematics, "kinematics { given: .., find: .. }", "Kinematics"),
                "kinematics",
                Arguments { accel: true, ..Arguments::TIMED_STATE },
                |s| Shape::Kinematics(s.found),
                |_| "Positions, rates and accelerations, in this order: {}.",
            ),
            FunctionKind::AssemblyCondition => row(
                by(R::AssemblyModes, "assembly_modes { given: .., find: .. }", "AssemblyModes"),
                "assembly_condition",
                Arguments::ALTERNATIVE,
                |_| Shape::Scalar,
                |_| {
                    "What vanishes where `assembly_modes` are: a sum of sines and cosines of multiples of the angle whose point \
                     of the circle is given, for each choice of sides."
                },
            ),
            FunctionKind::Assembly => row(
                by(R::AssemblyModes, "assembly_modes { given: .., find: .. }", "AssemblyModes"),
                "assembly_mode",
                Arguments::ALTERNATIVE,
                |s| Shape::Assembly(s.found),
                |_| "Of one of `assembly_modes` the positions, in this order: {}.",
            ),
            FunctionKind::ForwardDerivatives => row(
                by(R::Derivatives, "derivatives", "Derivatives"),
                "forward_derivatives",
                Arguments::ALL,
                |s| Shape::Derivatives(s.dof + s.states),
                |s| {
                    if s.states > 0 {
                        "Partial derivatives of the accelerations, then of the rates of the model's own states, by \
                         displacements of the position, velocities, own states and inputs."
                    } else {
                        "Partial derivatives of the accelerations by displacements of the position, velocities and inputs."
                    }
                },
            ),
            FunctionKind::InverseDerivatives => row(
                by(R::Derivatives, "derivatives", "Derivatives"),
                "inverse_derivatives",
                Arguments { accel: true, ..Arguments::ALL },
                |s| Shape::Derivatives(s.dof),
                |_| {
                    "Partial derivatives of the efforts that the accelerations `accel` need beside all declared forces, by \
                     displacements of the position, velocities, own states and inputs, at fixed `accel`."
                },
            ),
            FunctionKind::Linearization => row(
                by(R::Linearize, "linearize", "Linearize"),
                "linearize",
                Arguments::ALL,
                |s| Shape::Linearization(s.displacements + s.dof + s.states),
                |s| match (s.states, s.outputs) {
                    (0, 0) => {
                        "The equations linearised: `x' = A x + B u`, where `x` are changes of the position, as displacements, and of \
                         the velocities, and `u` changes of the inputs, both as flat as the structs are."
                    }
                    (0, _) => {
                        "The equations linearised: `x' = A x + B u` and `y = C x + D u`, where `x` are changes of the position, as \
                         displacements, and of the velocities, `u` changes of the inputs and `y` of the outputs, all as flat as \
                         the structs are."
                    }
                    (_, 0) => {
                        "The equations linearised: `x' = A x + B u`, where `x` are changes of the position, as displacements, of \
                         the velocities and of the model's own states, and `u` changes of the inputs, all as flat as the structs are."
                    }
                    (..) => {
                        "The equations linearised: `x' = A x + B u` and `y = C x + D u`, where `x` are changes of the position, as \
                         displacements, of the velocities and of the model's own states, `u` changes of the inputs and `y` of the \
                         outputs, all as flat as the structs are."
                    }
                },
            ),
            FunctionKind::Impulse => row(
                by(R::Impulse, "impulse", "Impulse"),
                "impulse",
                Arguments { impulse: true, ..Arguments::POSITION },
                |s| if s.rows > 0 { Shape::Jump } else { Shape::Velocity },
                |s| {
                    if s.rows > 0 {
                        "The jump of the velocities under an impulse, with `rates` for the jump of `constraint_rate`: \
                         `M * v + G^T * multipliers = impulse`, `G * v = rates`."
                    } else {
                        "The jump `M^-1 * impulse` of the velocities under an impulse."
                    }
                },
            ),
            FunctionKind::Displacement => row(
                Asked::Found,
                "least_displacement",
                Arguments { rates: true, ..Arguments::POSITION },
                |s| Shape::Vector(s.dof + 1),
                |s| {
                    if s.speeds {
                        return "For projections: the change `d` of the velocities with the least sum of squares for which `G * d = rates`, by the \
                                zeros of `G`; then the rank of the equations. Where that is less than their number, \
                                `Constrained::velocity_correction` tells more: squares of `G` are formed here.";
                    }
                    "For projections: the displacement `d` with the least sum of squares for which `G * d = rates`, by the zeros of \
                     `G`; then the rank of the equations. Where that is less than their number, `Constrained::correction` tells \
                     more: squares of `G` are formed here."
                },
            ),
            FunctionKind::Momentum => row(
                by(R::Momentum, "momentum", "Momentum"),
                "momentum",
                Arguments::STATE,
                |_| Shape::Velocity,
                |_| "Momenta `M * v`.",
            ),
            FunctionKind::MomentumRate => row(
                by(R::Momentum, "momentum", "Momentum"),
                "momentum_rate",
                Arguments::ALL,
                |_| Shape::Velocity,
                |_| {
                    "Rates of the momenta: the gradient of the kinetic energy by the position at fixed velocities, and the \
                     efforts of gravity and of all declared forces."
                },
            ),
            FunctionKind::MomentumVelocity => row(
                by(R::Momentum, "momentum", "Momentum"),
                "velocity",
                Arguments { momentum: true, ..Arguments::POSITION },
                |_| Shape::Velocity,
                |_| "Velocities `M^-1 * momentum` that belong to momenta.",
            ),
            FunctionKind::CentroidalMomentumMatrix => row(
                by(R::CentroidalMomentumMatrix, "centroidal_momentum_matrix", "CentroidalMomentumMatrix"),
                "centroidal_momentum_matrix",
                Arguments::POSITION,
                |s| Shape::Matrix(6, s.dof),
                |_| {
                    "Centroidal momentum matrix: three rows of angular momentum about the centre of mass, then three of linear \
                     momentum, of the whole model in the world's axes, by the velocities."
                },
            ),
            FunctionKind::CentroidalMomentum => row(
                Asked::Found,
                "centroidal_momentum",
                Arguments::TIMED_STATE,
                |_| Shape::Vector(6),
                |_| "Angular momentum about the centre of mass, then linear momentum.",
            ),
            FunctionKind::Poses => row(
                by(R::Poses, "poses", "Poses"),
                "poses",
                Arguments::POSITION,
                |_| Shape::Poses,
                |_| "Where the frames of all bodies are in the world: positions of their origins, and rotations.",
            ),
            FunctionKind::OutputGroup(_) => row(
                by(R::Outputs, "outputs { name: [output, ..] }", "Outputs"),
                "outputs",
                Arguments::ALL,
                |s| Shape::OutputGroup(s.grouped),
                |_| "Of the outputs {} alone.",
            ),
            FunctionKind::Outputs => row(Asked::Outputs, "outputs", Arguments::ALL, |_| Shape::Outputs, |_| "Outputs."),
            FunctionKind::DeadCentres => row(
                Asked::Found,
                "dead_centres",
                Arguments::TIMED,
                |s| Shape::Vector(s.dead_centres),
                |_| {
                    "Distances from dead centres, in the order of `DEAD_CENTRES`. Of a loop's solution: its square root, a product \
                     of lengths, zero where two solutions meet and NaN where the loop cannot be closed. Of roll, pitch and yaw: \
                     the cosine of the pitch, zero where roll and yaw turn about one axis. Rates grow without bound there."
                },
            ),
            FunctionKind::Margins => row(
                Asked::Found,
                "margins",
                Arguments::TIMED_STATE,
                |s| Shape::Margins(s.margins),
                |_| {
                    "For integrators, at a state whose guess is the solution: how far loops are from dead centres (the root of a \
                     closed form, the determinant of what Newton's method solves), each followed by the rate of its square; then \
                     the greatest residual of Newton's method, if it closes loops."
                },
            ),
            FunctionKind::Granted => row(
                Asked::Found,
                "granted",
                Arguments::TIMED,
                |s| Shape::Vector(s.granted),
                |_| {
                    "What equations leave that hold for parameters like the declared ones only, and were left out for them, each in \
                     units of a movement by a radian or by the mechanism's size. Integrations start where they hold."
                },
            ),
        }
    }
}
