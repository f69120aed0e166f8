//! Stage `mechanics`: rotors of joints that close loops.
//!
//! In: armatures of such joints, whose coordinates are measured. Out: what they add to the mass matrix, to efforts, wrenches
//! and the kinetic energy. With the rate r = g . v of the measured coordinate a rotor of armature J stores J r^2 / 2, so it
//! adds J g g^T to M, and resists as an effort -J r' across the joint. On joints of the tree a rotor is part of the link.

use std::rc::Rc;

use crate::mechanics::equations::Equations;
use crate::mechanics::translate::forces::{Loads, Terms};
use crate::model::types::{Coordinate, JointId, Order};
use crate::symbolic::differentiate::Differentiator;
use crate::symbolic::graph::Scalar;

pub(in crate::mechanics) struct Rotor {
    pub joint: JointId,
    pub armature: Scalar,
    pub rate: Scalar,
    /// Coefficients of the velocities of the tree that the rate depends on.
    slopes: Vec<(usize, Scalar)>,
}

/// All of them.
#[derive(Clone, Default)]
pub(in crate::mechanics) struct Rotors(Option<Rc<[Rotor]>>);

impl Equations<'_> {
    pub(in crate::mechanics) fn rotors(&mut self) -> Rc<[Rotor]> {
        if let Some(rotors) = &self.caches.rotors.0 {
            return Rc::clone(rotors);
        }
        let model = self.scene.model;
        let mut rotors = Vec::new();
        for &joint in &model.cuts {
            let Some(armature) = &model.joints[joint].armature else { continue };
            let armature = self.scalar(armature);
            if armature == Scalar::ZERO {
                continue;
            }
            let rate = self.coordinate(Coordinate { joint, index: 0 }, Order::Rate);
            let velocities = self.scene.symbols.velocities.concat();
            let slopes = velocities.into_iter().map(|v| self.g.derivative(rate, &[(v, Scalar::ONE)])).enumerate();
            let slopes = slopes.filter(|(_, slope)| *slope != Scalar::ZERO).collect();
            rotors.push(Rotor { joint, armature, rate, slopes });
        }
        let rotors: Rc<[Rotor]> = rotors.into();
        self.caches.rotors.0 = Some(Rc::clone(&rotors));
        rotors
    }

    /// J g g^T, added to a mass matrix of the user's coordinates, row by row.
    pub(in crate::mechanics) fn add_rotors(&mut self, matrix: &mut [Scalar]) {
        let size = self.scene.symbols.places();
        for rotor in self.rotors().iter() {
            for &(i, a) in &rotor.slopes {
                for &(j, b) in &rotor.slopes {
                    let term = self.g.product(&[rotor.armature, a, b]);
                    let entry = &mut matrix[i * size + j];
                    *entry = self.g.add(*entry, term);
                }
            }
        }
    }

    /// Efforts that the rotors take with these accelerations, added to efforts; all of the user's coordinates.
    pub(in crate::mechanics) fn add_rotor_efforts(&mut self, efforts: &mut [Scalar], accelerations: &[Scalar]) {
        for rotor in self.rotors().iter() {
            let push = self.rotor_effort(rotor, accelerations);
            for &(freedom, slope) in &rotor.slopes {
                let term = self.g.mul(slope, push);
                efforts[freedom] = self.g.add(efforts[freedom], term);
            }
        }
    }

    /// J r'
    pub(in crate::mechanics) fn rotor_effort(&mut self, rotor: &Rotor, accelerations: &[Scalar]) -> Scalar {
        let mut seeds = self.seeds(1);
        seeds.extend(self.scene.symbols.velocities.concat().into_iter().zip(accelerations.iter().copied()));
        let acceleration = Differentiator::new(&seeds).scalar(&mut self.g, rotor.rate);
        self.g.mul(rotor.armature, acceleration)
    }

    /// Loads with what the rotors exert on the two bodies of their joints.
    pub(in crate::mechanics) fn with_rotors(&mut self, loads: Rc<Loads>, accelerations: &[Scalar]) -> Rc<Loads> {
        let rotors = self.rotors();
        if rotors.is_empty() {
            return loads;
        }
        let mechanism = Rc::clone(&self.scene.mechanism);
        let mut terms = Terms::new(&mechanism);
        for rotor in rotors.iter() {
            let push = self.rotor_effort(rotor, accelerations);
            self.act_across(&mut terms, rotor.joint, &[-push], false);
        }
        let others = terms.sums(&mut self.g, &mechanism);
        Rc::new(loads.add(&mut self.g, &others))
    }

    /// Twice the energy of the rotors.
    pub(in crate::mechanics) fn twice_of_rotors(&mut self) -> Vec<Scalar> {
        let rotors = self.rotors();
        rotors.iter().map(|rotor| self.g.product(&[rotor.armature, rotor.rate, rotor.rate])).collect()
    }
}
