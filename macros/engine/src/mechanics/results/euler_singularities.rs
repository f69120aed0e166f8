//! Stage `mechanics`: where roll, pitch and yaw fail.
//!
//! In: model and structure. Out: the pitches of the state whose cosines are told among the dead centres: at a right angle
//! roll and yaw turn about one axis, and rates grow without bound.

use crate::mechanics::loops::structure::{Role, Structure};
use crate::mechanics::translate::symbols::Symbols;
use crate::model::types::{Coordinate, Joint, JointId, Model};
use crate::symbolic::graph::{Graph, Scalar};

/// Pitches that are coordinates of the state, in the order of joints.
pub(in crate::mechanics) fn pitches(model: &Model, structure: &Structure) -> Vec<Coordinate> {
    let pitch = |(number, joint): (usize, &Joint)| {
        let index = joint.kind.pitch()?;
        let coordinate = Coordinate { joint: JointId(number), index };
        let role = structure.roles.get(number).and_then(|roles| roles.get(index));
        (role == Some(&Role::State)).then_some(coordinate)
    };
    model.joints.iter().enumerate().filter_map(pitch).collect()
}

/// Their cosines.
pub(in crate::mechanics) fn cosines(g: &mut Graph, symbols: &Symbols, pitches: &[Coordinate]) -> Vec<Scalar> {
    let angle = |c: &Coordinate| Symbols::of(&symbols.positions, c.joint).get(c.index).copied();
    pitches.iter().filter_map(|c| angle(c).map(|angle| g.cos(angle))).collect()
}
