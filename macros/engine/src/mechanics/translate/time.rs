//! Stage `mechanics`: rates of expressions along the motion of the tree.
//!
//! In: scalars of positions and time. Out: their first and second time derivatives, in terms of the velocity and
//! acceleration symbols, and partial derivatives by velocity coordinates, dr' / dv. A unit quaternion moves by
//! q' = q (0, w) / 2, with w in the child's axes. Drives move by time: where an expression of it stands in place of a
//! position, there is no symbol to seed.

use crate::mechanics::equations::Equations;
use crate::model::types::{Coordinate, JointId};
use crate::symbolic::differentiate::Differentiator;
use crate::symbolic::graph::{Graph, Scalar, ScalarNode};

use super::orientation::quaternion_rate;
use super::symbols::{Symbols, has_quaternion};

/// (symbol, its derivative)
pub type Seeds = Vec<(Scalar, Scalar)>;

impl Equations<'_> {
    /// How symbols move in time. Order 1: positions by velocities, and time itself; order 2: velocities by
    /// accelerations too.
    pub fn seeds(&mut self, order: u8) -> Seeds {
        let mut seeds = vec![(self.scene.symbols.time, Scalar::ONE)];
        for joint in 0..self.scene.model.joints.len() {
            let id = JointId(joint);
            let velocities = Symbols::of(&self.scene.symbols.velocities, id).to_vec();
            self.move_joint(id, &velocities, &mut seeds);
            if order > 1 {
                let accelerations = Symbols::of(&self.scene.symbols.accelerations, id).to_vec();
                let pairs = velocities.into_iter().zip(accelerations);
                seeds.extend(pairs.filter(|&(v, _)| is_symbol(&self.g, v)));
            }
        }
        if order > 1 {
            seeds.extend(self.scene.symbols.speeds.iter().map(|&[speed, rate]| (speed, rate)));
        }
        seeds
    }

    /// Own states that are read, with their rates.
    pub(in crate::mechanics) fn seeds_of_states(&mut self, read: &[bool]) -> Seeds {
        let (model, states) = (self.scene.model, self.scene.symbols.states.clone());
        let read = model.states.iter().zip(states).zip(read).filter(|(_, read)| **read);
        read.map(|((state, symbol), _)| (symbol, self.scalar(&state.rate))).collect()
    }

    /// d/dt of scalars that depend on positions and time.
    pub fn time_derivative(&mut self, list: &[Scalar]) -> Vec<Scalar> {
        let seeds = self.seeds(1);
        Differentiator::new(&seeds).scalars(&mut self.g, list)
    }

    /// First and second derivative of scalars that depend on positions and time.
    pub fn time_derivatives(&mut self, list: &[Scalar]) -> [Vec<Scalar>; 2] {
        let seeds = self.seeds(2);
        let mut along = Differentiator::new(&seeds);
        let first = along.scalars(&mut self.g, list);
        let second = along.scalars(&mut self.g, &first);
        [first, second]
    }

    /// How positions move where this velocity coordinate alone is one.
    pub fn direction(&mut self, coordinate: Coordinate) -> Seeds {
        let count = Symbols::of(&self.scene.symbols.velocities, coordinate.joint).len();
        let mut velocities = vec![Scalar::ZERO; count];
        if let Some(slot) = velocities.get_mut(coordinate.index) {
            *slot = Scalar::ONE;
        }
        let mut seeds = Vec::new();
        self.move_joint(coordinate.joint, &velocities, &mut seeds);
        seeds.retain(|&(_, seed)| seed != Scalar::ZERO);
        seeds
    }

    /// Derivatives of several scalars by one velocity coordinate.
    pub fn partial(&mut self, list: &[Scalar], coordinate: Coordinate) -> Vec<Scalar> {
        let seeds = self.direction(coordinate);
        Differentiator::new(&seeds).scalars(&mut self.g, list)
    }

    fn move_joint(&mut self, id: JointId, velocities: &[Scalar], seeds: &mut Seeds) {
        let positions = Symbols::of(&self.scene.symbols.positions, id).to_vec();
        let turns = has_quaternion(&self.scene.model.joints[id]) && positions.len() >= 4;
        let straight = if turns { positions.len() - 4 } else { positions.len() };
        let mut rates: Vec<Scalar> = velocities.iter().copied().take(straight).collect();
        if let (true, [.., w, i, j, k], [.., x, y, z]) = (turns, &positions[..], velocities) {
            rates.extend(quaternion_rate(&mut self.g, [*w, *i, *j, *k], [*x, *y, *z]));
        }
        let pairs = positions.into_iter().zip(rates);
        seeds.extend(pairs.filter(|&(q, _)| is_symbol(&self.g, q)));
    }
}

fn is_symbol(g: &Graph, s: Scalar) -> bool {
    matches!(g.node(s), ScalarNode::Symbol(_))
}
