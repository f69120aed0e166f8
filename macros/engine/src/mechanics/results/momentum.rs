//! Stage `mechanics`: momenta and their rates.
//!
//! In: the tree, its velocities, declared forces. Out: p = M v, and p' = dT/dq at fixed rates, plus the efforts of gravity
//! and of the declared forces, by the sweep of [`crate::dynamics::momentum`].
//!
//! Dependent coordinates have velocities S u: their momenta go down by S^T, rates by S^T too, and what S changes in time
//! adds (S')^T p.

use crate::dynamics::kinematics::motions;
use crate::dynamics::momentum::{carried, swept};
use crate::dynamics::newton_euler::{efforts, transmitted};
use crate::dynamics::velocities::velocities;
use crate::mechanics::equations::Equations;
use crate::mechanics::loops::reduction::Reduction;
use crate::mechanics::translate::forces::LoadCase;
use crate::symbolic::differentiate::Differentiator;
use crate::symbolic::graph::{Graph, Scalar, Vector};

/// How efforts of gravity are found.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(in crate::mechanics) enum Weight {
    /// From the links inwards, as forces.
    Force,
    /// As the gradient of the potential energy, where there is no quaternion among the tree's coordinates.
    Gradient,
}

impl Equations<'_> {
    /// p = M v of the tree, in the user's coordinates.
    pub(in crate::mechanics) fn momenta(&mut self) -> Vec<Scalar> {
        let shared = self.shared();
        let tree = &shared.tree;
        let moving = velocities(&mut self.g, tree);
        let wrenches = carried(&mut self.g, tree, &moving);
        let list = efforts(&mut self.g, tree, &wrenches, &tree.velocity);
        self.of_user(&list)
    }

    /// The same from the entries of M.
    pub(in crate::mechanics) fn momenta_by_matrix(&mut self) -> Vec<Scalar> {
        let matrix = self.mass_matrix();
        let velocities = self.scene.symbols.velocities.concat();
        times(&mut self.g, &matrix, &velocities)
    }

    /// p' on the tree, in the user's coordinates.
    pub(in crate::mechanics) fn momentum_rates(&mut self, weight: Weight) -> Vec<Scalar> {
        let shared = self.shared();
        let tree = &shared.tree;
        let moving = velocities(&mut self.g, tree);
        let wrenches = carried(&mut self.g, tree, &moving);
        let swept = swept(&mut self.g, tree, &moving, &wrenches);
        let swept = self.of_user(&swept);
        let given = self.given_efforts(weight);
        swept.iter().zip(&given).map(|(&swept, &given)| self.g.add(swept, given)).collect()
    }

    /// Momenta of the state.
    pub(in crate::mechanics) fn reduced_momenta(&mut self, reduction: &Reduction) -> Vec<Scalar> {
        let momenta = self.momenta();
        let projected = self.project(reduction, &momenta);
        let of_state: Vec<Scalar> = self.speeds().into_iter().map(|freedom| projected[freedom]).collect();
        self.finish(reduction, &of_state)
    }

    /// The same from the entries of S^T M S.
    pub(in crate::mechanics) fn reduced_momenta_by_matrix(&mut self, reduction: &Reduction) -> Vec<Scalar> {
        let matrix = self.reduced_mass_matrix(reduction).concat();
        let velocities = self.all_velocities();
        let of_state: Vec<Scalar> = self.speeds().into_iter().map(|freedom| velocities[freedom]).collect();
        times(&mut self.g, &matrix, &of_state)
    }

    /// Rates of the state's momenta.
    pub(in crate::mechanics) fn reduced_momentum_rates(
        &mut self,
        reduction: &Reduction,
        weight: Weight,
    ) -> Vec<Scalar> {
        let rates = self.momentum_rates(weight);
        let projected = self.project(reduction, &rates);
        let turned = self.turned_momenta(reduction);
        let of_state: Vec<Scalar> = self.speeds().into_iter().map(|k| self.g.add(projected[k], turned[k])).collect();
        self.finish(reduction, &of_state)
    }

    /// (S')^T p, by coordinate of the tree. Symbols of accelerations stand for the momenta while S^T is differentiated.
    fn turned_momenta(&mut self, reduction: &Reduction) -> Vec<Scalar> {
        let weights: Vec<Scalar> = self.scene.symbols.accelerations.concat();
        if reduction.rates.is_empty() {
            return vec![Scalar::ZERO; weights.len()];
        }
        let projected = self.project(reduction, &weights);
        let seeds = self.seeds(1);
        let turned = Differentiator::new(&seeds).scalars(&mut self.g, &projected);
        let momenta = self.momenta();
        let pairs: Vec<(Scalar, Scalar)> = weights.into_iter().zip(momenta).collect();
        let map = self.map(&pairs);
        self.g.substitute(&turned, &map)
    }

    /// Efforts of gravity and of the declared forces, in the user's coordinates.
    fn given_efforts(&mut self, weight: Weight) -> Vec<Scalar> {
        let base = match weight {
            Weight::Force => self.base(),
            Weight::Gradient => Vector::ZERO,
        };
        let shared = self.shared();
        let tree = &shared.tree;
        let loads = self.loads(LoadCase::Declared);
        let g = &mut self.g;
        let rest = vec![Scalar::ZERO; tree.freedoms()];
        let motions = motions(g, tree, &rest, &rest, base);
        let applied = shared.turn(g, &loads.applied);
        let wrenches = transmitted(g, tree, &motions, &applied);
        let needed = efforts(g, tree, &wrenches, &rest);
        let given: Vec<Scalar> = needed.iter().zip(&loads.efforts).map(|(&n, &given)| g.sub(given, n)).collect();
        let given = self.of_user(&given);
        if weight == Weight::Force {
            return given;
        }
        let positions: Vec<Scalar> = self.scene.symbols.positions.concat();
        let parts: Vec<(Scalar, Scalar)> = self.weight().into_iter().map(|part| (part, -Scalar::ONE)).collect();
        let pull = self.g.transpose_linear(&parts, &positions);
        given.iter().zip(&pull).map(|(&given, &pull)| self.g.add(given, pull)).collect()
    }

    fn of_user(&self, list: &[Scalar]) -> Vec<Scalar> {
        let mut list = self.scene.mechanism.sign(list);
        list.truncate(self.scene.symbols.places());
        list
    }
}

/// A square matrix, row by row, by a vector.
fn times(g: &mut Graph, matrix: &[Scalar], vector: &[Scalar]) -> Vec<Scalar> {
    let rows = matrix.chunks(vector.len().max(1));
    let dot = |row: &[Scalar]| {
        let terms: Vec<Scalar> = row.iter().zip(vector).map(|(&m, &v)| g.mul(m, v)).collect();
        g.sum(&terms)
    };
    rows.map(dot).collect()
}
