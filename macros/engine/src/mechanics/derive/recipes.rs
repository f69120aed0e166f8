//! Stage `mechanics`, its whole: the table of recipes.
//!
//! In: a function. Out: the ways to it, each with its name: one list where all coordinates are of the state and no equation
//! keeps a multiplier, one where some depend on others. What a way does with axes and definitions is described by [`super::ways`].

use crate::contracts::function::FunctionKind;
use crate::contracts::results::{Results, Slot};
use crate::dynamics::shared_axes::SharedAxes;
use crate::mechanics::equations::Equations;
use crate::mechanics::loops::reduction::{Newton, Reduction};
use crate::mechanics::results::euler_singularities;
use crate::mechanics::translate::forces::LoadCase;
use crate::model::types::Output;
use crate::symbolic::graph::Scalar;

use super::{AXES, COMPOSITE, Candidates, Deriving, Found, MOST_COMPOSITE, NEWTON_EULER, Names, freedoms};

/// Results from the tree, and with the definitions of dependent coordinates.
type OnTree = fn(&mut Equations<'_>) -> Found;
type OnLoops = fn(&mut Equations<'_>, &Reduction) -> Found;

/// One or several ways to a function, with their names.
pub(super) enum Way {
    /// On the tree, in the axes that [`AXES`] names.
    InAxes(Names, OnTree),
    /// The same with definitions at hand.
    Reduced(Names, OnLoops),
    /// On the tree, over links that turn together, where that is another way.
    Lumped(OnTree),
    /// Without a choice of axes: on the tree, on it with definitions put in, with definitions at hand.
    Plain(&'static str, OnTree),
    PutIn(&'static str, OnTree),
    Defined(&'static str, OnLoops),
    /// In the axes in which loops are closed, which give the name; in those axes for parallel hinges.
    Written(&'static [Option<SharedAxes>], fn(&mut Equations<'_>, &Reduction) -> Results<Scalar>),
    /// On the tree, for models of many coordinates, if it is there for them.
    FarOut(&'static str, fn(&mut Equations<'_>) -> Option<Results<Scalar>>),
    /// Ways that depend on the model.
    Chosen(fn(&mut Deriving<'_>, FunctionKind) -> Candidates),
}

/// A [`Way`] without names and axes.
#[derive(Clone, Copy)]
pub(super) enum PlainWay {
    OnTree(OnTree),
    PutIn(OnTree),
    OnLoops(OnLoops),
    Written(fn(&mut Equations<'_>, &Reduction) -> Results<Scalar>),
}

impl PlainWay {
    /// The function by this way; on an open tree there are no definitions.
    pub(super) fn derive(self, e: &mut Equations<'_>, definitions: &Reduction) -> Found {
        match self {
            PlainWay::OnTree(f) => f(e),
            PlainWay::PutIn(f) => {
                let results = f(e)?;
                Ok(Results { list: e.finish(definitions, &results.list), ..results })
            }
            PlainWay::OnLoops(f) => f(e, definitions),
            PlainWay::Written(f) => Ok(f(e, definitions)),
        }
    }
}

/// The ways to one function.
pub(super) struct Recipe {
    open: &'static [Way],
    looped: &'static [Way],
}

const AT_ROOT: &str = "composite rigid body, wrenches at the root";
const LINKS: &str = "sum over links";
const UNIT_VELOCITIES: &str = "composite rigid body under unit velocities";
const FIRST_MOMENT: &str = "first moment of mass, springs";
const WITHOUT_CHOICE: &[Option<SharedAxes>] = &[None];

/// One row per function.
fn recipe(kind: FunctionKind, solves_inputs: bool) -> Recipe {
    use FunctionKind as F;
    use Way::{Chosen, Defined, FarOut, InAxes, Lumped, Plain, PutIn, Reduced, Written};
    const NONE: &[Way] = &[];
    let (open, looped): (&'static [Way], &'static [Way]) = match kind {
        F::ForwardDynamics => {
            (const { &[Chosen(|d, _| d.forward_dynamics())] }, const { &[Chosen(|d, _| d.constrained_dynamics())] })
        }
        F::InverseDynamics if solves_inputs => (
            const {
                &[
                    InAxes(NEWTON_EULER, |e| e.actuate(&Reduction::default())),
                    Lumped(|e| e.actuate(&Reduction::default())),
                ]
            },
            const { &[Reduced(NEWTON_EULER, |e, r| e.actuate(r)), Chosen(|d, _| d.strut_inputs())] },
        ),
        F::InverseDynamics => (
            const {
                &[
                    InAxes(NEWTON_EULER, |e| Ok(Results::velocity(e.inverse_dynamics(LoadCase::Declared)))),
                    Lumped(|e| Ok(Results::velocity(e.inverse_dynamics(LoadCase::Declared)))),
                ]
            },
            const { &[Reduced(NEWTON_EULER, |e, r| Ok(Results::velocity(e.reduced_efforts(r, LoadCase::Declared))))] },
        ),
        F::Bias => (
            const { &[InAxes(NEWTON_EULER, |e| Ok(Results::vector(e.bias()))), Lumped(|e| Ok(Results::vector(e.bias())))] },
            const { &[Reduced(NEWTON_EULER, |e, r| Ok(Results::vector(e.reduced_bias(r))))] },
        ),
        F::MassMatrix => (
            const {
                &[
                    InAxes(COMPOSITE, |e| Ok(square(e.mass_matrix()))),
                    FarOut(AT_ROOT, |e| e.mass_matrix_at_root().map(square)),
                ]
            },
            const { &[Reduced(COMPOSITE, |e, r| Ok(square(e.reduced_mass_matrix(r).concat())))] },
        ),
        F::MassMatrixLower => (
            const {
                &[
                    InAxes(COMPOSITE, |e| Ok(lower(e.mass_matrix()))),
                    FarOut(AT_ROOT, |e| e.mass_matrix_at_root().map(lower)),
                ]
            },
            const { &[Reduced(COMPOSITE, |e, r| Ok(lower(e.reduced_mass_matrix(r).concat())))] },
        ),
        F::KineticEnergy => (
            const { &[Plain(LINKS, |e| Ok(Results::scalar(e.kinetic())))] },
            const { &[PutIn(LINKS, |e| Ok(Results::scalar(e.kinetic())))] },
        ),
        F::PotentialEnergy => (
            const { &[Plain(FIRST_MOMENT, |e| Ok(Results::scalar(e.potential())))] },
            const { &[PutIn(FIRST_MOMENT, |e| Ok(Results::scalar(e.potential())))] },
        ),
        F::Constraints => (NONE, const { &[Written(WITHOUT_CHOICE, |e, r| Results::vector(e.constraints(r)))] }),
        F::ConstraintJacobian => (NONE, const { &[Written(WITHOUT_CHOICE, jacobian)] }),
        F::PositionJacobian => (NONE, const { &[Written(WITHOUT_CHOICE, position_jacobian)] }),
        F::ConstraintRate => (NONE, const { &[Written(WITHOUT_CHOICE, |e, r| Results::vector(e.constraint_rate(r)))] }),
        F::ConstraintBias => (NONE, const { &[Written(WITHOUT_CHOICE, |e, r| Results::vector(e.constraint_bias(r)))] }),
        F::Residual => (
            const { &[InAxes(NEWTON_EULER, |e| Ok(Results::velocity(e.inverse_dynamics(LoadCase::Declared))))] },
            const { &[Written(&AXES, |e, r| e.residual(r)), Lumped(residual)] },
        ),
        F::AssemblyCondition | F::Assembly => {
            const SAME: &[Way] = &[Chosen(|d, kind| d.assembly(kind))];
            (SAME, SAME)
        }
        F::Kinematics(_) => (const { &[Chosen(kinematics)] }, const { &[Chosen(kinematics)] }),
        F::Guess => (NONE, const { &[Defined("Newton's method", guess)] }),
        F::DeadCentres => (
            const { &[Plain("closed forms", |e| Ok(Results::vector(pitches(e))))] },
            const { &[Defined("closed forms", dead_centres)] },
        ),
        F::Margins => (NONE, const { &[Plain("closed forms, determinants", margins)] }),
        F::Displacement => {
            (NONE, const { &[Written(WITHOUT_CHOICE, |e, r| Results::vector(e.least_displacement(r)))] })
        }
        F::PositionRates => {
            (NONE, const { &[Defined("velocity map", |e, r| Ok(Results::vector(e.position_rates(r))))] })
        }
        F::RateDerivatives => {
            (NONE, const { &[Defined("differentiated velocity map", |e, r| Ok(e.rate_derivatives(r)))] })
        }
        F::Granted => {
            const GRANTED: &[Way] = &[Plain("equations that were left out", granted)];
            (GRANTED, GRANTED)
        }
        F::ForwardDerivatives => {
            const SAME: &[Way] = &[Chosen(|d, _| d.forward_derivatives())];
            (SAME, SAME)
        }
        F::InverseDerivatives => {
            const SAME: &[Way] = &[Chosen(|d, _| d.inverse_derivatives())];
            (SAME, SAME)
        }
        F::Linearization => {
            const SAME: &[Way] = &[Chosen(|d, _| d.linearizations())];
            (SAME, SAME)
        }
        F::Impulse | F::MomentumVelocity => {
            (const { &[Chosen(|d, _| d.jumps())] }, const { &[Chosen(|d, _| d.constrained_jumps())] })
        }
        F::Momentum => (const { &[Chosen(|d, _| d.momenta())] }, const { &[Chosen(|d, _| d.reduced_momenta())] }),
        F::MomentumRate => {
            (const { &[Chosen(|d, _| d.momentum_rates())] }, const { &[Chosen(|d, _| d.reduced_momentum_rates())] })
        }
        F::CentroidalMomentumMatrix => {
            (const { &[Plain(UNIT_VELOCITIES, centroidal)] }, const { &[PutIn(UNIT_VELOCITIES, centroidal)] })
        }
        F::CentroidalMomentum => (
            const { &[Plain(LINKS, |e| Ok(Results::vector(e.centroidal_momentum())))] },
            const { &[PutIn(LINKS, |e| Ok(Results::vector(e.centroidal_momentum())))] },
        ),
        F::Outputs => {
            const SAME: &[Way] = &[Chosen(|d, _| d.outputs(&d.model.outputs.iter().collect::<Vec<_>>()))];
            (SAME, SAME)
        }
        F::Poses => {
            const SAME: &[Way] = &[Chosen(|d, _| d.poses())];
            (SAME, SAME)
        }
        F::OutputGroup(_) => {
            const SAME: &[Way] = &[Chosen(output_group)];
            (SAME, SAME)
        }
    };
    Recipe { open, looped }
}

fn kinematics(deriving: &mut Deriving<'_>, kind: FunctionKind) -> Candidates {
    match kind {
        FunctionKind::Kinematics(number) => deriving.kinematics(number),
        _ => Ok(Vec::new()),
    }
}

fn output_group(deriving: &mut Deriving<'_>, kind: FunctionKind) -> Candidates {
    match kind {
        FunctionKind::OutputGroup(number) => {
            let model = deriving.model;
            let wanted: Vec<&Output> =
                model.output_groups[number].outputs().map(|place| &model.outputs[place]).collect();
            deriving.outputs(&wanted)
        }
        _ => Ok(Vec::new()),
    }
}

fn square(entries: Vec<Scalar>) -> Results<Scalar> {
    let size = entries.len().isqrt();
    Results::matrix(size, size, entries)
}

/// Of a square matrix what is on and below the diagonal, row by row.
fn lower(entries: Vec<Scalar>) -> Results<Scalar> {
    let size = entries.len().isqrt();
    Results::vector(
        entries.chunks(size.max(1)).enumerate().flat_map(|(row, list)| list.iter().take(row + 1)).copied().collect(),
    )
}

fn jacobian(e: &mut Equations<'_>, reduction: &Reduction) -> Results<Scalar> {
    let (rows, columns) = (e.scene.structure.rows.len(), e.scene.structure.freedoms());
    Results::matrix(rows, columns, e.constraint_jacobian(reduction))
}

fn position_jacobian(e: &mut Equations<'_>, reduction: &Reduction) -> Results<Scalar> {
    let (rows, columns) = (e.scene.structure.rows.len(), e.scene.structure.state.len());
    Results::matrix(rows, columns, e.position_jacobian(reduction))
}

fn centroidal(e: &mut Equations<'_>) -> Found {
    let columns = e.scene.structure.freedoms();
    Ok(Results::matrix(6, columns, e.centroidal_momentum_matrix()))
}

fn residual(e: &mut Equations<'_>) -> Found {
    let reduction = e.reduce()?;
    Ok(e.residual(&reduction))
}

fn guess(e: &mut Equations<'_>, reduction: &Reduction) -> Found {
    let worst = e.worst_residual(reduction);
    let results = Results::default().with(Slot::Unknowns, reduction.guesses.clone()).with_scalar(Slot::Residual, worst);
    Ok(Results { list: e.finish(reduction, &results.list), ..results })
}

fn dead_centres(e: &mut Equations<'_>, reduction: &Reduction) -> Found {
    let mut roots: Vec<Scalar> = reduction.dead_centres.iter().map(|centre| centre.1).collect();
    roots.extend(pitches(e));
    Ok(Results::vector(e.finish(reduction, &roots)))
}

/// Cosines of the pitches that may stand at a right angle.
fn pitches(e: &mut Equations<'_>) -> Vec<Scalar> {
    let pitches = euler_singularities::pitches(e.scene.model, &e.scene.structure);
    euler_singularities::cosines(&mut e.g, &e.scene.symbols, &pitches)
}

fn margins(e: &mut Equations<'_>) -> Found {
    let reduction = e.reduce_by(Newton::AtGuess)?;
    Ok(e.margins(&reduction))
}

/// What equations leave that were left out for the declared parameters.
fn granted(e: &mut Equations<'_>) -> Found {
    let reduction = e.reduce_by(Newton::AtGuess)?;
    Ok(Results::vector(e.granted(&reduction)))
}

impl Deriving<'_> {
    /// All candidates of a function, in the order of the table.
    pub(super) fn candidates(&mut self, kind: FunctionKind) -> Candidates {
        let recipe = recipe(kind, !self.model.solve_for.is_empty());
        let ways = if self.is_open() { recipe.open } else { recipe.looped };
        let mut candidates = Vec::new();
        for way in ways {
            candidates.extend(match way {
                Way::InAxes(names, f) => self.one(*names, f)?,
                Way::Reduced(names, f) => self.reduced(*names, f)?,
                Way::Lumped(f) => self.lumped(f)?.into_iter().collect(),
                Way::Plain(name, f) => self.only(name, f)?,
                Way::PutIn(name, f) => self.put_in(name, f)?,
                Way::Defined(name, f) => self.equations(name, f)?,
                Way::Written(axes, f) => self.written(axes, f)?,
                Way::FarOut(name, f) => self.far_out(name, *f)?.into_iter().collect(),
                Way::Chosen(f) => f(self, kind)?,
            });
        }
        let is_large = ways.iter().any(|way| matches!(way, Way::FarOut(..))) && freedoms(self.model) > MOST_COMPOSITE;
        Ok(if is_large { self.promising(candidates) } else { candidates })
    }

    /// One way to a function, without a choice of axes; nothing where all depend on the model.
    pub(super) fn plain_way(&self, kind: FunctionKind) -> Option<PlainWay> {
        let recipe = recipe(kind, !self.model.solve_for.is_empty());
        let ways = if self.is_open() { recipe.open } else { recipe.looped };
        ways.iter().find_map(|way| match *way {
            Way::InAxes(_, f) | Way::Plain(_, f) => Some(PlainWay::OnTree(f)),
            Way::PutIn(_, f) => Some(PlainWay::PutIn(f)),
            Way::Reduced(_, f) | Way::Defined(_, f) => Some(PlainWay::OnLoops(f)),
            Way::Written(_, f) => Some(PlainWay::Written(f)),
            Way::Lumped(_) | Way::FarOut(..) | Way::Chosen(_) => None,
        })
    }
}
