//! Stage `mechanics`: motions on a plane, whose equations needn't know where they head.
//!
//! In: the tree. Out: of every hinge that the ground carries by slides alone, its angle, and which positions, velocities and
//! accelerations are components across its axis ([`Turn`]). Functions are lowered with the angle at zero wherever that leaves
//! their values ([`crate::symbolic::turned`]).
//!
//! Rates of such slides that follow from equations of velocities E(v) = 0 are looked for along and across the heading: with
//! v = R w, the slopes of what rolls or skates along with the mechanism, (dE/dv) R, have no angle in them, so zeros show, and which equation
//! gives which rate is a choice that doesn't change with the heading.

use std::collections::HashMap;
use std::rc::Rc;

use crate::dynamics::tree::Motion;
use crate::model::types::Coordinate;
use crate::symbolic::graph::{Rotation, Scalar, SymbolId};
use crate::symbolic::rotations::{self, turn_pair};
use crate::symbolic::turned::Turn;

use super::equations::Equations;

/// With more of them each is a body of its own on one plane, and what they have to do with each other reads all their angles.
const MOST: usize = 4;

/// A hinge, and two slides that carry it at right angles to its axis and to each other; the angle turns the first to the second.
struct Heading {
    angle: Scalar,
    slides: [Coordinate; 2],
}

/// Columns of a matrix that were turned, with cosine and sine of the angle.
pub(super) struct Turned {
    columns: [usize; 2],
    point: [Scalar; 2],
}

impl Equations<'_> {
    fn headings(&mut self) -> Vec<Heading> {
        let mechanism = Rc::clone(&self.scene.mechanism);
        let links = &mechanism.tree.links;
        let mut found = Vec::new();
        for hinge in links.iter().filter(|link| matches!(link.motion, Motion::Revolute(_))) {
            let carriers: Vec<usize> = mechanism.tree.support(hinge.parent).collect();
            if carriers.len() < 2 || !carriers.iter().all(|&link| matches!(links[link].motion, Motion::Prismatic(_))) {
                continue;
            }
            let mut slides = Vec::new();
            let mut rotation = Rotation::IDENTITY;
            for link in carriers.iter().rev().map(|&slide| &links[slide]).chain([hinge]) {
                rotation = rotations::compose(&mut self.g, rotation, link.rotation);
                let (Some(axis), Some(coordinate)) =
                    (link.motion.axis(), self.scene.symbols.coordinate_at(link.freedom))
                else {
                    continue;
                };
                // In the direction of the user's coordinate.
                let unit = self.g.along(axis, if link.q.is_negative() { -Scalar::ONE } else { Scalar::ONE });
                slides.push((coordinate, rotations::rotate(&mut self.g, rotation, unit)));
            }
            let Some((coordinate, axle)) = slides.pop() else { continue };
            slides.retain(|&(_, axis)| self.g.dot(axis, axle) == Scalar::ZERO);
            let [(first, a), (second, b)] = slides[..] else { continue };
            if self.g.dot(a, b) != Scalar::ZERO {
                continue;
            }
            let normal = self.g.cross(a, b);

            let slides = if self.g.dot(normal, axle) == Scalar::ONE { [first, second] } else { [second, first] };
            let [angle, ..] = self.coordinate_symbols(coordinate);
            found.push(Heading { angle, slides });
        }
        if found.len() > MOST {
            found.clear();
        }
        found
    }

    /// Angles, with the symbols of vectors across their axes.
    pub(super) fn turning(&mut self) -> Vec<Turn> {
        let (symbols, structure) = (Rc::clone(&self.scene.symbols), Rc::clone(&self.scene.structure));
        let speeds = structure.speeds();
        let mut found = Vec::new();
        for Heading { angle, slides } in self.headings() {
            let [a, b] = slides.map(|slide| {
                let impulse = speeds.iter().position(|&speed| speed == slide);
                let impulse = impulse.and_then(|at| symbols.impulses.get(at).copied());
                self.coordinate_symbols(slide).into_iter().map(Some).chain([impulse]).collect::<Vec<_>>()
            });
            let id = |scalar: Option<Scalar>| scalar.and_then(|scalar| self.g.symbol_id(scalar));
            let vectors: Vec<[SymbolId; 2]> =
                a.into_iter().zip(b).filter_map(|(a, b)| Some([id(a)?, id(b)?])).collect();
            found.extend(id(Some(angle)).map(|angle| Turn { angle, vectors }));
        }
        found
    }

    /// Turns columns of a matrix, given row by row, to unknowns along and across a heading, where that takes the heading out of
    /// them.
    pub(super) fn along_headings(&mut self, unknowns: &[Coordinate], matrix: &mut [Scalar]) -> Vec<Turned> {
        let size = unknowns.len();
        let mut found = Vec::new();
        for Heading { angle, slides } in self.headings() {
            let place = |slide: Coordinate| unknowns.iter().position(|&unknown| unknown == slide);
            let ([Some(a), Some(b)], Some(angle_id)) = (slides.map(place), self.g.symbol_id(angle)) else { continue };
            let point = [self.g.cos(angle), self.g.sin(angle)];
            let back = [point[0], -point[1]];
            let before: Vec<Scalar> = matrix.chunks(size).flat_map(|row| [row[a], row[b]]).collect();
            let mut turned = Vec::with_capacity(before.len());
            for pair in before.chunks(2) {
                turned.extend(turn_pair(&mut self.g, back, [pair[0], pair[1]]));
            }
            let at_zero = self.g.substitute(&turned, &HashMap::from([(angle_id, Scalar::ZERO)]));
            if at_zero == turned && self.g.read_by(&before, &[angle])[0] {
                for (row, pair) in matrix.chunks_mut(size).zip(turned.chunks(2)) {
                    (row[a], row[b]) = (pair[0], pair[1]);
                }
                found.push(Turned { columns: [a, b], point });
            }
        }
        found
    }

    /// Unknowns in the world's axes: v = R1 R2 w, where R1 was turned to first.
    pub(super) fn turn_back(&mut self, turned: &[Turned], unknowns: &mut [Scalar]) {
        for &Turned { columns: [a, b], point } in turned.iter().rev() {
            [unknowns[a], unknowns[b]] = turn_pair(&mut self.g, point, [unknowns[a], unknowns[b]]);
        }
    }
}
