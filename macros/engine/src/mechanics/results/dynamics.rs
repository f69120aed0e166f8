//! Stage `mechanics`: equations of motion.
//!
//! In: the tree, declared forces. Out: inverse dynamics, bias, mass matrix and accelerations in the user's coordinates, so
//! that M a + bias = effort, where the bias holds gravity, velocity terms and minus the declared forces.

use std::rc::Rc;

use crate::dynamics::floating_bases::floating_bases;
use crate::dynamics::kinematics::motions;
use crate::dynamics::newton_euler::{efforts, transmitted};
use crate::dynamics::regroup::regroup_but;
use crate::dynamics::{articulated, composite, composite_at_root, lumped};
use crate::mechanics::equations::Equations;
use crate::mechanics::scene::Method;
use crate::mechanics::translate::forces::LoadCase;
use crate::symbolic::graph::Scalar;
use crate::symbolic::linear_algebra::solve_symmetric;

impl Equations<'_> {
    /// Efforts that the accelerations take beside all declared forces.
    pub(in crate::mechanics) fn inverse_dynamics(&mut self, case: LoadCase) -> Vec<Scalar> {
        let mechanism = Rc::clone(&self.scene.mechanism);
        let list = self.efforts(&mechanism.tree.acceleration, case);
        let mut efforts = mechanism.sign(&list);
        let accelerations = self.all_accelerations();
        self.add_rotor_efforts(&mut efforts, &accelerations);
        efforts
    }

    pub(in crate::mechanics) fn bias(&mut self) -> Vec<Scalar> {
        let mechanism = Rc::clone(&self.scene.mechanism);
        let still = vec![Scalar::ZERO; mechanism.tree.freedoms()];
        let list = self.efforts(&still, LoadCase::Declared);
        let mut efforts = mechanism.sign(&list);
        self.add_rotor_efforts(&mut efforts, &still);
        efforts
    }

    /// In the tree's coordinates.
    fn efforts(&mut self, acceleration: &[Scalar], case: LoadCase) -> Vec<Scalar> {
        if self.scene.way.lumped {
            return self.lumped_efforts(acceleration, case);
        }
        let shared = self.passed();
        let tree = &shared.tree;
        let loads = self.loads(case);
        let base = self.base();
        let g = &mut self.g;
        let motions = motions(g, tree, &tree.velocity, acceleration, base);
        let applied = shared.turn(g, &loads.applied);
        let wrenches = transmitted(g, tree, &motions, &applied);
        let needed = efforts(g, tree, &wrenches, acceleration);
        let rest = needed.iter().zip(&loads.efforts).map(|(&needed, &given)| g.sub(needed, given));
        rest.take(self.scene.symbols.places()).collect()
    }

    /// The same over groups of links.
    fn lumped_efforts(&mut self, acceleration: &[Scalar], case: LoadCase) -> Vec<Scalar> {
        let tree = regroup_but(&mut self.g, &self.scene.mechanism.tree, true, &[]);
        let loads = self.loads(case);
        let base = self.base();
        let g = &mut self.g;
        let needed = lumped::efforts(g, &tree, acceleration, base, &loads.applied, &loads.world);
        let rest = needed.iter().zip(&loads.efforts).map(|(&needed, &given)| g.sub(needed, given));
        rest.take(self.scene.symbols.places()).collect()
    }

    /// Row by row.
    pub(in crate::mechanics) fn mass_matrix(&mut self) -> Vec<Scalar> {
        let shared = self.shared();
        let matrix = composite::mass_matrix(&mut self.g, &shared.tree);
        self.inertia_of_coordinates(&matrix)
    }

    /// The same with all wrenches about one point, where that is another way.
    pub(in crate::mechanics) fn mass_matrix_at_root(&mut self) -> Option<Vec<Scalar>> {
        let shared = self.shared();
        if !composite_at_root::differs(&shared.tree) {
            return None;
        }
        let matrix = composite_at_root::mass_matrix(&mut self.g, &shared.tree);
        Some(self.inertia_of_coordinates(&matrix))
    }

    /// The mass matrix of the tree in the user's coordinates, row by row, with rotors.
    fn inertia_of_coordinates(&mut self, matrix: &[Vec<Scalar>]) -> Vec<Scalar> {
        let mechanism = Rc::clone(&self.scene.mechanism);
        let mut entries = Vec::new();
        for (row, &flip) in matrix.iter().zip(&mechanism.flipped) {
            let row = mechanism.sign(row);
            entries.extend(row.iter().take(mechanism.flipped.len()).map(|&entry| if flip { -entry } else { entry }));
        }
        self.add_rotors(&mut entries);
        entries
    }

    /// Accelerations of an open tree, in the user's coordinates.
    pub(super) fn forward_dynamics(&mut self) -> Vec<Scalar> {
        let mechanism = Rc::clone(&self.scene.mechanism);
        let shared = self.shared();
        let tree = &shared.tree;
        let list = match self.scene.way.method {
            Method::Composite | Method::Floating => {
                let matrix = composite::mass_matrix(&mut self.g, tree);
                let bias = self.efforts(&vec![Scalar::ZERO; tree.freedoms()], LoadCase::Declared);
                let order = mechanism.elimination(self.scene.way.method == Method::Floating);
                let rhs: Vec<Scalar> = bias.iter().map(|&b| -b).collect();
                solve_symmetric(&mut self.g, &matrix, &order, &rhs)
            }
            Method::Articulated => {
                let loads = self.loads(LoadCase::Declared);
                let base = self.base();
                let g = &mut self.g;
                let applied = shared.turn(g, &loads.applied);
                let floating_bases = floating_bases(&mechanism.tree);
                articulated::forward_dynamics(g, tree, &floating_bases, &tree.velocity, base, &applied, &loads.efforts)
            }
        };
        mechanism.sign(&list)
    }
}
