//! Stage `mechanics`: what the symbols of a derivation stand for.
//!
//! In: the checked model. Out: one graph symbol for time and for every scalar of parameters, inputs, states, positions,
//! velocities and accelerations, in this order, whatever is derived later: the same symbol has the same number, and the
//! same print, in every graph of one model.

use crate::model::types::{InputId, Joint, JointId, JointKind, Model, Orientation, ParamId, StateId};
use crate::optimize::program::Symbol;
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
    /// Place of each joint's first velocity coordinate among all.
    pub first: Vec<usize>,
    pub freedoms: usize,
}

impl Symbols {
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
            let straight = straight_positions(joint);
            let mut list = several(g, &mut table, straight, symbol);
            if has_quaternion(joint) {
                table.extend((straight..straight + 4).map(symbol));
                list.extend(g.unit_quaternion());
            }
            list
        });
        let positions = positions.collect();
        let mut of_joints = |make: fn(JointId, usize) -> Symbol| -> Vec<Vec<Scalar>> {
            let joints = model.joints.iter().enumerate();
            let lists = joints.map(|(k, joint)| {
                several(g, &mut table, joint.kind.freedoms(), |component| make(JointId(k), component))
            });
            lists.collect()
        };
        let velocities = of_joints(|joint, component| Symbol::Velocity { joint, component });
        let accelerations = of_joints(|joint, component| Symbol::Acceleration { joint, component });
        let mut freedoms = 0;
        let first = model.joints.iter().map(|joint| {
            let first = freedoms;
            freedoms += joint.kind.freedoms();
            first
        });
        let first = first.collect();
        Symbols { table, time, params, inputs, states, positions, velocities, accelerations, first, freedoms }
    }

    /// The scalars of one joint's list, or nothing.
    pub fn of(lists: &[Vec<Scalar>], joint: JointId) -> &[Scalar] {
        lists.get(joint.0).map_or(&[], Vec::as_slice)
    }
}

/// Whether the joint's orientation is a quaternion.
pub fn has_quaternion(joint: &Joint) -> bool {
    matches!(joint.kind, JointKind::Ball(Orientation::Quaternion) | JointKind::Free(Orientation::Quaternion))
}

/// Position components that change at the rate of a velocity coordinate.
fn straight_positions(joint: &Joint) -> usize {
    let freedoms = joint.kind.freedoms();
    if has_quaternion(joint) { freedoms - 3 } else { freedoms }
}

fn one(g: &mut Graph, table: &mut Vec<Symbol>, symbol: Symbol) -> Scalar {
    table.push(symbol);
    g.symbol()
}

fn several(g: &mut Graph, table: &mut Vec<Symbol>, count: usize, symbol: impl Fn(usize) -> Symbol) -> Vec<Scalar> {
    (0..count).map(|element| one(g, table, symbol(element))).collect()
}
