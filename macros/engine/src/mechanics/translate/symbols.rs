//! Stage `mechanics`: what the symbols of a derivation stand for.
//!
//! In: the checked model. Out: one graph symbol for time and for every scalar of parameters, inputs, states, positions,
//! velocities and accelerations, in this order, whatever is derived later: the same symbol has the same number, and the
//! same print, in every graph of one model. Joints that close loops have no coordinates.

use crate::contracts::symbol::Symbol;
use crate::mechanics::loops::structure::{Role, Structure};
use crate::model::types::{Coordinate, InputId, Joint, JointId, Model, ParamId, Request, StateId};
use crate::solve::placement::Alternative;
use crate::symbolic::graph::{Graph, Scalar};

/// Handles of all symbols, by what they stand for.
#[derive(Clone, Debug)]
pub struct Symbols {
    /// By the number of the symbol in the graph.
    pub table: Vec<Symbol>,
    pub time: Scalar,
    pub params: Vec<Vec<Scalar>>,
    pub inputs: Vec<Vec<Scalar>>,
    pub states: Vec<Scalar>,
    /// By joint; with quaternions w, i, j, k are the last four.
    pub positions: Vec<Vec<Scalar>>,
    pub velocities: Vec<Vec<Scalar>>,
    pub accelerations: Vec<Vec<Scalar>>,
    /// By speed of the user's choice: itself and its rate.
    pub speeds: Vec<[Scalar; 2]>,
    /// Place of each joint's first velocity coordinate among all.
    pub first: Vec<usize>,
    pub freedoms: usize,
    /// By constraint equation with a multiplier.
    pub multipliers: Vec<Scalar>,
    /// By velocity coordinate: impulses, or momenta, that velocities answer to.
    pub impulses: Vec<Scalar>,
    /// By constraint equation with a multiplier: its rate in a jump.
    pub rates: Vec<Scalar>,
    /// What tells an assembly mode, where the model asks for them.
    pub alternative: Option<Alternative>,
    guesses: Vec<Scalar>,
    unknowns: Vec<Scalar>,
    /// By unknown of an iteration: cosine and sine, where it is an angle that is iterated as such.
    points: Vec<[Scalar; 2]>,
}

/// Bits for coordinates outside the state, which stand-ins share.
const MARKS: usize = 126;

/// Unknowns that one closing brings into its loop, at most: two balls.
pub(in crate::mechanics) const UNWANTED: usize = 6;

impl Symbols {
    /// The same with symbols for multipliers, and for so many unknowns of iterations.
    pub fn with_structure(mut self, g: &mut Graph, model: &Model, structure: &Structure, guesses: usize) -> Symbols {
        self.mark(g, structure);
        let table = &mut self.table;
        self.multipliers = several(g, table, structure.rows.len(), |row| Symbol::Multiplier { row });
        self.guesses = several(g, table, guesses, |index| Symbol::Guess { index });
        let solves = !structure.steps.is_empty() || !model.kinematics.is_empty() || model.assembly.is_some();
        let closings = model.solves.iter().map(|solve| solve.closings().count()).max().unwrap_or(0).max(1);
        let unknowns = if solves { guesses + closings * UNWANTED } else { 0 };
        self.unknowns = several(g, table, unknowns, |index| Symbol::Unknown { index });
        let point = |k: usize| {
            table.extend([0, 1].map(|component| Symbol::UnknownPoint { index: k, component }));
            g.unit_circle()
        };
        self.points = (0..guesses).map(point).collect();
        self
    }

    /// The same with the arguments of the jump of velocities, where the model asks for it, and of projections. They stand behind
    /// all others, whose numbers stay.
    pub fn with_impulses(mut self, g: &mut Graph, model: &Model, structure: &Structure) -> Symbols {
        let jumps = model.emit.contains(&Request::Impulse);
        let moves = jumps || model.emit.contains(&Request::Momentum);
        let table = &mut self.table;
        if !moves {
            if model.emit.contains(&Request::ForwardDynamics) && structure.is_projected_by_zeros() {
                self.rates = several(g, table, structure.rows.len(), |row| Symbol::Rate { row });
            }
            return self;
        }
        let impulses = structure.speeds().iter().map(|&Coordinate { joint, index: component }| {
            let symbol =
                if jumps { Symbol::Impulse { joint, component } } else { Symbol::Momentum { joint, component } };
            one(g, table, symbol)
        });
        self.impulses = impulses.collect();
        self.rates = several(g, table, structure.rows.len(), |row| Symbol::Rate { row });
        self
    }

    /// The same with what tells an assembly mode, where the model asks for them, behind all others.
    pub fn with_alternative(mut self, g: &mut Graph, model: &Model) -> Symbols {
        if model.assembly.is_some() {
            self.table.extend([0, 1].map(|component| Symbol::Alternative { component }));
            let point = g.unit_circle();
            let sides = [2, 3, 4].map(|component| one(g, &mut self.table, Symbol::Alternative { component }));
            self.alternative = Some(Alternative { point, sides });
        }
        self
    }

    /// Marks what will be replaced in results: coordinates that are not in the state, one bit for each order of each; and
    /// accelerations of the state, and inputs, which are set to zero where they are solved for.
    fn mark(&self, g: &mut Graph, structure: &Structure) {
        for input in self.inputs.iter().flatten() {
            g.mark(*input, MARKS + 1);
        }
        for [_, rate] in &self.speeds {
            g.mark(*rate, MARKS);
        }
        let mut next = 0;
        for joint in 0..self.velocities.len() {
            let lists = [&self.positions, &self.velocities, &self.accelerations].map(|lists| &lists[joint]);
            for index in 0..lists[1].len() {
                let role = structure.role(Coordinate { joint: JointId(joint), index });
                let coordinate = Coordinate { joint: JointId(joint), index };
                if structure.rates.unknowns.contains(&coordinate) {
                    for list in [lists[1], lists[2]] {
                        g.mark(list[index], next % MARKS);
                        next += 1;
                    }
                    continue;
                }
                if role == Role::State {
                    g.mark(lists[2][index], MARKS);
                    continue;
                }
                for list in lists {
                    list.get(index).iter().for_each(|&&symbol| g.mark(symbol, next % MARKS));
                    next += 1;
                }
                // The fourth component of a quaternion.
                if index + 1 == lists[1].len() {
                    lists[0][lists[1].len()..].iter().for_each(|&symbol| g.mark(symbol, (next + MARKS - 3) % MARKS));
                }
            }
        }
    }

    /// The bit of what stands for a quantity while an expression is taken apart.
    pub(in crate::mechanics) const STAND_INS: usize = MARKS - 1;

    /// Whether an expression reads a coordinate that is not in the state: such symbols must be replaced.
    pub fn is_unfinished(g: &Graph, s: Scalar) -> bool {
        g.marks(s) & ((1 << MARKS) - 1) != 0
    }

    /// Where an iteration starts.
    pub fn guess(&self, index: usize) -> Scalar {
        self.guesses[index]
    }

    /// The unknown of an iteration, inside it.
    pub fn unknown(&self, index: usize) -> Scalar {
        self.unknowns[index]
    }

    /// The same as a point on the circle.
    pub fn unknown_point(&self, index: usize) -> [Scalar; 2] {
        self.points[index]
    }

    /// A placeholder for a coordinate of what closes a loop: those of the next closing of an item stand `UNWANTED` further on.
    pub fn unwanted(&self, number: usize) -> Scalar {
        self.unknown(self.guesses.len() + number)
    }

    /// Number of velocities of the tree, and of speeds of the user's choice behind them.
    pub fn places(&self) -> usize {
        self.freedoms + self.speeds.len()
    }

    /// The velocity coordinate of a joint at a place among them.
    pub fn coordinate_at(&self, place: usize) -> Option<Coordinate> {
        let joint = self.first.iter().rposition(|&first| first <= place)?;
        let index = place - self.first[joint];
        (index < self.velocities[joint].len()).then_some(Coordinate { joint: JointId(joint), index })
    }

    pub fn new(g: &mut Graph, model: &Model) -> Symbols {
        let mut table = Vec::new();
        let time = one(g, &mut table, Symbol::Time);
        let params = model.params.iter().enumerate().map(|(k, param)| {
            let symbol = |element| Symbol::Param { param: ParamId(k), element };
            several(g, &mut table, param.ty.scalars(), symbol)
        });
        let params = params.collect();
        let inputs = model.inputs.iter().enumerate().map(|(k, input)| {
            let symbol = |element| Symbol::Input { input: InputId(k), element };
            several(g, &mut table, input.ty.scalars(), symbol)
        });
        let inputs = inputs.collect();
        let states = (0..model.states.len()).map(|k| one(g, &mut table, Symbol::State { state: StateId(k) }));
        let states = states.collect();
        let positions = model.joints.iter().enumerate().map(|(k, joint)| {
            let symbol = |component| Symbol::Position { joint: JointId(k), component };
            let cut = model.cuts.contains(&JointId(k));
            let straight = if cut { 0 } else { straight_positions(joint) };
            let mut list = several(g, &mut table, straight, symbol);
            if has_quaternion(joint) && !cut {
                table.extend((straight..straight + 4).map(symbol));
                list.extend(g.unit_quaternion());
            }
            list
        });
        let positions = positions.collect();
        let mut of_joints = |make: fn(JointId, usize) -> Symbol| -> Vec<Vec<Scalar>> {
            let joints = model.joints.iter().enumerate();
            let lists = joints.map(|(k, joint)| {
                let freedoms = freedoms_of(model, JointId(k), joint);
                several(g, &mut table, freedoms, |component| make(JointId(k), component))
            });
            lists.collect()
        };
        let velocities = of_joints(|joint, component| Symbol::Velocity { joint, component });
        let accelerations = of_joints(|joint, component| Symbol::Acceleration { joint, component });
        let speeds = (0..model.speeds.len()).map(|number| {
            let Coordinate { joint, index: component } = model.coordinate_of(number);
            let speed = one(g, &mut table, Symbol::Velocity { joint, component });
            [speed, one(g, &mut table, Symbol::Acceleration { joint, component })]
        });
        let speeds = speeds.collect();
        let mut freedoms = 0;
        let first = model.joints.iter().enumerate().map(|(k, joint)| {
            let first = freedoms;
            freedoms += freedoms_of(model, JointId(k), joint);
            first
        });
        let first = first.collect();
        Symbols {
            table,
            time,
            params,
            inputs,
            states,
            positions,
            velocities,
            accelerations,
            speeds,
            first,
            freedoms,
            multipliers: Vec::new(),
            impulses: Vec::new(),
            rates: Vec::new(),
            alternative: None,
            guesses: Vec::new(),
            unknowns: Vec::new(),
            points: Vec::new(),
        }
    }

    /// All parameters.
    pub fn parameters(&self) -> Vec<Scalar> {
        self.params.concat()
    }

    /// The scalars of one joint's list, or nothing.
    pub fn of(lists: &[Vec<Scalar>], joint: JointId) -> &[Scalar] {
        &lists[joint.0]
    }
}

/// Number of velocity coordinates that a joint has in the tree.
pub fn freedoms_of(model: &Model, id: JointId, joint: &Joint) -> usize {
    if model.cuts.contains(&id) { 0 } else { joint.kind.freedoms() }
}

/// Whether the joint's orientation is a quaternion.
pub fn has_quaternion(joint: &Joint) -> bool {
    joint.kind.has_quaternion()
}

/// Position components that change at the rate of a velocity coordinate.
fn straight_positions(joint: &Joint) -> usize {
    joint.kind.freedoms.len()
}

fn one(g: &mut Graph, table: &mut Vec<Symbol>, symbol: Symbol) -> Scalar {
    table.push(symbol);
    g.symbol()
}

fn several(g: &mut Graph, table: &mut Vec<Symbol>, count: usize, symbol: impl Fn(usize) -> Symbol) -> Vec<Scalar> {
    (0..count).map(|element| one(g, table, symbol(element))).collect()
}
