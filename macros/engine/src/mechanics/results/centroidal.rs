//! Stage `mechanics`: the centroidal momentum matrix (Orin, Goswami and Lee 2013).
//!
//! In: the tree with the inertias of all bodies. Out: A(q) with A v = (angular momentum about the centre of mass, linear
//! momentum), in world axes. A unit velocity of a joint moves all that the joint carries as one rigid body: with its mass m,
//! first moment h and inertia J about the link's origin, the twist (w, u) there and the way r from the centre of mass to that
//! origin, the momenta are p = m u + w x h and L = J w + h x u + r x p.
//!
//! A link that carries all mass has h + m r = 0, so L is J w + r x (w x h) there and no translation turns the whole. Elsewhere
//! r is measured from the link that carries all: the way from the world's origin, which may be long, takes no part in it.

use crate::dynamics::columns::Columns;
use crate::dynamics::composite::{composites, unit_wrench};
use crate::dynamics::inertia::Inertia;
use crate::dynamics::newton_euler::Wrench;
use crate::mechanics::equations::Equations;
use crate::model::types::SystemQuantity;
use crate::symbolic::graph::{Rotation, Scalar};

impl Equations<'_> {
    /// By velocity of the state, row by row: angular rows, then linear ones.
    pub(in crate::mechanics) fn centroidal_momentum_matrix(&mut self) -> Vec<Scalar> {
        let system = self.as_one(&self.chosen(&None));
        let (tree, carrier) = (&system.tree, system.carrier);
        let centre = self.centre(&system);
        let inertias = composites(&mut self.g, tree);
        let carrying: Vec<usize> = tree.support(carrier).collect();
        let mut places = Columns::new(carrier, Rotation::IDENTITY);
        let freedoms = self.scene.symbols.places();
        let mut rows: [Vec<Scalar>; 6] = std::array::from_fn(|_| vec![Scalar::ZERO; freedoms]);
        for (index, link) in tree.links.iter().enumerate() {
            for (freedom, twist) in tree.twists(link).into_iter().filter(|column| column.0 < freedoms) {
                let (axes, momenta) = if carrying.contains(&index) {
                    (Some(index), self.momenta_of_all(&inertias[index], system.mass, &twist))
                } else {
                    let Wrench { moment, force } = unit_wrench(&mut self.g, &inertias[index], &twist);
                    let [moment, force] = [moment, force].map(|v| places.rotate(&mut self.g, tree, Some(index), v));
                    let origin = places.origin(&mut self.g, tree, Some(index));
                    let arm = self.g.sub_vectors(origin, centre);
                    let lever = self.g.cross(arm, force);
                    (carrier, Wrench { moment: self.g.add_vectors(moment, lever), force })
                };
                let flips = self.scene.mechanism.flipped.get(freedom) == Some(&true);
                let column = [momenta.moment, momenta.force].map(|v| {
                    let v = self.between(axes, None, v);
                    self.g.components(if flips { -v } else { v })
                });
                for (row, &entry) in rows.iter_mut().zip(column.as_flattened()) {
                    row[freedom] = entry;
                }
            }
        }
        self.by_velocity_of_state(rows).concat()
    }

    /// Momenta of everything under a unit velocity of what carries it.
    fn momenta_of_all(&mut self, all: &Inertia, mass: Scalar, twist: &[Scalar; 6]) -> Wrench {
        let [x, y, z, ..] = *twist;
        let turning = [x, y, z, Scalar::ZERO, Scalar::ZERO, Scalar::ZERO];
        let turned = unit_wrench(&mut self.g, all, &turning);
        let first = self.g.vector(all.first);
        let factor = self.g.reciprocal(mass);
        let centre = self.g.scale(factor, first);
        let lever = self.g.cross(centre, turned.force);
        Wrench { moment: self.g.sub_vectors(turned.moment, lever), force: unit_wrench(&mut self.g, all, twist).force }
    }

    /// The momenta themselves, link by link.
    pub(in crate::mechanics) fn centroidal_momentum(&mut self) -> Vec<Scalar> {
        let quantities = [SystemQuantity::AngularMomentum, SystemQuantity::LinearMomentum];
        let vectors = quantities.map(|quantity| {
            let momentum = self.of_bodies(&None, quantity).vector(&mut self.g);
            self.g.components(momentum)
        });
        vectors.concat()
    }
}
