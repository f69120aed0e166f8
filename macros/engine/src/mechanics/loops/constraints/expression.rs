//! Stage `mechanics`: what an expression that is held at zero does to the bodies.
//!
//! In: an expression phi of positions. Out: what acts per unit of its multiplier, by virtual work. Every frame that phi reads
//! belongs to a link, and the origin o and the rotation R of each of these links stand for themselves, as symbols; so do the
//! coordinates that phi reads. Then dphi = f . do + m . dtheta for a link whose origin moves by do and that turns by dtheta,
//! in world axes, with f = dphi/do and m the sum of R_j x dphi/dR_j over the columns of R; and dphi = e dq for a coordinate.
//! The wrench -lambda (f, m) acts on the link, the effort -lambda e on the coordinate, between the two bodies of its joint.
//! As efforts on the coordinates of the tree all of this is -lambda times the partial derivatives of phi, but only wrenches
//! on bodies load the joints that carry them. Of an expression of velocities it is the same with the velocities v and w of links and
//! the rates of coordinates that it reads: f = de/dv, m = de/dw.

use std::collections::{BTreeMap, HashMap};
use std::rc::Rc;

use crate::dynamics::newton_euler::Wrench;
use crate::invariant::fault::raise;
use crate::mechanics::equations::Equations;
use crate::mechanics::translate::build::FixedFrame;
use crate::mechanics::translate::symbols::Symbols;
use crate::mechanics::translate::values::Value;
use crate::model::types::{ConstraintId, ConstraintKind, Coordinate, Expr, FrameQuantity, JointId, LoopClosure};
use crate::symbolic::graph::{Scalar, Vector};
use crate::symbolic::rotations::{self, transpose};

use super::super::reduction::Map;
use super::super::structure::Row;

/// What expressions that are held read, and what they act with.
#[derive(Clone, Default)]
pub(in crate::mechanics) struct Readings {
    stand_ins: StandIns,
    /// By constraint.
    slopes: HashMap<ConstraintId, Rc<Slopes>>,
}

/// Symbols that stand for what an expression reads.
#[derive(Clone, Default)]
struct StandIns {
    /// By link: origin and columns of the rotation, in world axes.
    links: BTreeMap<usize, Link>,
    /// By link: velocity of the origin and angular velocity, in world axes.
    moving: BTreeMap<usize, [[Scalar; 3]; 2]>,
    /// Measured coordinates, of joints that close loops.
    measured: BTreeMap<Coordinate, Scalar>,
    /// Their rates.
    rates: BTreeMap<Coordinate, Scalar>,
    /// What each stands for.
    map: Map,
    /// What is read by the expression at hand; nothing while quantities mean themselves.
    read: Option<Read>,
}

#[derive(Clone, Copy)]
struct Link {
    origin: [Scalar; 3],
    columns: [[Scalar; 3]; 3],
}

#[derive(Clone, Default)]
struct Read {
    links: BTreeMap<usize, Link>,
    coordinates: BTreeMap<Coordinate, Scalar>,
    moving: BTreeMap<usize, [[Scalar; 3]; 2]>,
    rates: BTreeMap<Coordinate, Scalar>,
}

/// What acts per unit of minus the multiplier.
#[derive(Default)]
pub(in crate::mechanics) struct Slopes {
    /// By link, about its origin in world axes.
    pub wrenches: Vec<(usize, Wrench)>,
    pub efforts: Vec<(Coordinate, Scalar)>,
}

impl Equations<'_> {
    /// Whether quantities stand for themselves.
    pub(in crate::mechanics) fn stands_apart(&self) -> bool {
        self.caches.readings.stand_ins.read.is_some()
    }

    pub(in crate::mechanics) fn slopes(&mut self, id: ConstraintId) -> Rc<Slopes> {
        if let Some(known) = self.caches.readings.slopes.get(&id) {
            return Rc::clone(known);
        }
        let slopes = Rc::new(self.find_slopes(id));
        self.caches.readings.slopes.insert(id, Rc::clone(&slopes));
        slopes
    }

    fn find_slopes(&mut self, id: ConstraintId) -> Slopes {
        let model = self.scene.model;
        let constraint = &model.constraints[id];
        let value = match &constraint.kind {
            ConstraintKind::Value(value) => value,
            ConstraintKind::Rate(value) => return self.find_slopes_of_rate(value),
            ConstraintKind::Rod { .. } => return Slopes::default(),
        };
        if let Some(coordinate) = constraint.drive {
            return Slopes { efforts: vec![(coordinate, Scalar::ONE)], ..Slopes::default() };
        }
        let (phi, read) = self.read(value);
        let mut slopes = Slopes::default();
        for (&coordinate, &symbol) in &read.coordinates {
            let slope = self.g.derivative(phi, &[(symbol, Scalar::ONE)]);
            let slope = self.put_in_stand_ins(&[slope])[0];
            if slope != Scalar::ZERO {
                slopes.efforts.push((coordinate, slope));
            }
        }
        for (&index, link) in &read.links {
            let force = self.g.gradient(phi, &link.origin);
            let entries = self.g.gradient(phi, &link.columns.concat());
            let columns = link.columns.concat();
            let all = self.put_in_stand_ins(&[force, entries, columns].concat());
            let g = &mut self.g;
            let vectors: Vec<Vector> = all.chunks(3).map(|c| g.vector([c[0], c[1], c[2]])).collect();
            let [force, slopes_of @ .., a, b, c] = &vectors[..] else { continue };
            let turns: Vec<Vector> = [a, b, c].into_iter().zip(slopes_of).map(|(&r, &d)| g.cross(r, d)).collect();
            let wrench = Wrench { moment: g.sum_vectors(&turns), force: *force };
            if (wrench.moment, wrench.force) != (Vector::ZERO, Vector::ZERO) {
                slopes.wrenches.push((index, wrench));
            }
        }
        slopes
    }

    /// Of an expression of velocities.
    fn find_slopes_of_rate(&mut self, value: &Expr) -> Slopes {
        let (rate, read) = self.read(value);
        let mut slopes = Slopes::default();
        for (&coordinate, &symbol) in &read.rates {
            let slope = self.g.derivative(rate, &[(symbol, Scalar::ONE)]);
            let slope = self.put_in_stand_ins(&[slope])[0];
            if slope != Scalar::ZERO {
                slopes.efforts.push((coordinate, slope));
            }
        }
        for (&index, moving) in &read.moving {
            let gradient = self.g.gradient(rate, &moving.concat());
            let gradient = self.put_in_stand_ins(&gradient);
            let [x, y, z, a, b, c] = gradient[..] else { continue };
            let wrench = Wrench { moment: self.g.vector([a, b, c]), force: self.g.vector([x, y, z]) };
            if (wrench.moment, wrench.force) != (Vector::ZERO, Vector::ZERO) {
                slopes.wrenches.push((index, wrench));
            }
        }
        slopes
    }

    /// An expression in symbols for what it reads.
    fn read(&mut self, value: &Expr) -> (Scalar, Read) {
        let memo = std::mem::take(&mut self.caches.memo);
        self.caches.readings.stand_ins.read = Some(Read::default());
        let phi = self.scalar(value);
        let read = self.caches.readings.stand_ins.read.take().unwrap_or_default();
        self.caches.memo = memo;
        (phi, read)
    }

    /// An expression in symbols for what it reads, and those of coordinates.
    pub(super) fn standing_apart(&mut self, value: &Expr) -> (Scalar, Vec<(Coordinate, Scalar)>) {
        let (phi, read) = self.read(value);
        (phi, read.coordinates.into_iter().collect())
    }

    /// Efforts of expressions with multipliers on a joint that closes a loop.
    pub(in crate::mechanics) fn expression_efforts(
        &mut self,
        joint: JointId,
        multiplied: &[(Row, Scalar)],
    ) -> Vec<Scalar> {
        let mut efforts: Vec<Scalar> = Vec::new();
        for &(row, multiplier) in multiplied {
            let LoopClosure::Constraint(id) = row.closing else { continue };
            for &(coordinate, slope) in &self.slopes(id).efforts {
                if coordinate.joint != joint {
                    continue;
                }
                efforts.resize(efforts.len().max(coordinate.index + 1), Scalar::ZERO);
                if let Some(effort) = efforts.get_mut(coordinate.index) {
                    let term = self.g.mul(multiplier, slope);
                    *effort = self.g.sub(*effort, term);
                }
            }
        }
        efforts
    }

    /// What the symbols stand for in their places.
    pub(in crate::mechanics) fn put_in_stand_ins(&mut self, roots: &[Scalar]) -> Vec<Scalar> {
        if self.caches.readings.stand_ins.map.is_empty() {
            roots.to_vec()
        } else {
            self.g.substitute(roots, &self.caches.readings.stand_ins.map)
        }
    }

    /// A new symbol for a value. It is replaced in all results, those included that merely look as if they read it.
    fn stand_in(&mut self, value: Scalar) -> Scalar {
        let symbol = self.g.symbol();
        self.g.mark(symbol, Symbols::STAND_INS);
        self.caches.readings.stand_ins.map.extend(self.g.symbol_id(symbol).map(|id| (id, value)));
        symbol
    }

    /// A coordinate that an expression reads.
    pub(in crate::mechanics) fn read_coordinate(&mut self, coordinate: Coordinate) -> Scalar {
        let Coordinate { joint, index } = coordinate;
        let symbol = match Symbols::of(&self.scene.symbols.positions, joint).get(index) {
            Some(&symbol) => symbol,
            None => match self.caches.readings.stand_ins.measured.get(&coordinate) {
                Some(&symbol) => symbol,
                None => {
                    let value = self.meaning_itself(|e| e.measured_position(coordinate));
                    let symbol = self.stand_in(value);
                    self.caches.readings.stand_ins.measured.insert(coordinate, symbol);
                    symbol
                }
            },
        };
        if let Some(read) = &mut self.caches.readings.stand_ins.read {
            read.coordinates.insert(coordinate, symbol);
        }
        symbol
    }

    /// The rate of a coordinate that an expression reads.
    pub(in crate::mechanics) fn read_rate(&mut self, coordinate: Coordinate) -> Scalar {
        let Coordinate { joint, index } = coordinate;
        let symbol = match Symbols::of(&self.scene.symbols.velocities, joint).get(index) {
            Some(&symbol) => symbol,
            None => match self.caches.readings.stand_ins.rates.get(&coordinate) {
                Some(&symbol) => symbol,
                None => {
                    let value = self.meaning_itself(|e| e.measured_rate(coordinate));
                    let symbol = self.stand_in(value);
                    self.caches.readings.stand_ins.rates.insert(coordinate, symbol);
                    symbol
                }
            },
        };
        if let Some(read) = &mut self.caches.readings.stand_ins.read {
            read.rates.insert(coordinate, symbol);
        }
        symbol
    }

    /// A quantity of a frame that an expression reads.
    pub(in crate::mechanics) fn read_place(&mut self, place: &FixedFrame, quantity: FrameQuantity) -> Value {
        let columns = self.read_columns(place);
        let rows = transpose(&columns);
        match quantity {
            FrameQuantity::Rotation => Value::Rotation(Rc::new(rows)),
            FrameQuantity::Pose => {
                let position = self.read_position(place);
                Value::Pose(position, crate::mechanics::translate::orientation::of_rows(&mut self.g, &rows))
            }
            FrameQuantity::Velocity => Value::Vector(self.read_motion(place)[0]),
            FrameQuantity::AngularVelocity => Value::Vector(self.read_motion(place)[1]),
            FrameQuantity::Twist => {
                let [velocity, angular] = self.read_motion(place);
                Value::Pair(velocity, angular)
            }
            FrameQuantity::Position => Value::Vector(self.read_position(place)),
            FrameQuantity::Acceleration | FrameQuantity::AngularAcceleration => {
                raise("expressions that are held read no accelerations")
            }
        }
    }

    /// The angular velocity of a joint's child relative to its parent, in the axes of the child's frame.
    pub(in crate::mechanics) fn read_relative_angular_velocity(&mut self, joint: JointId) -> Vector {
        let joint = &self.scene.model.joints[joint];
        let [parent, child] = [&joint.parent, &joint.child].map(|frame| self.place(frame));
        let [parent, angular] = [&parent, &child].map(|place| self.read_motion(place)[1]);
        let difference = self.g.sum_vectors(&[angular, -parent]);
        self.read_express(&child, difference)
    }

    /// Velocity of a frame's origin and angular velocity.
    fn read_motion(&mut self, place: &FixedFrame) -> [Vector; 2] {
        let Some(index) = place.link else { return [Vector::ZERO; 2] };
        let found = match self.caches.readings.stand_ins.moving.get(&index) {
            Some(&found) => found,
            None => {
                let origin = FixedFrame { link: place.link, ..FixedFrame::GROUND };
                let values = self.meaning_itself(|e| {
                    let (angular, velocity) = e.world_velocity(&origin);
                    [velocity, angular].map(|v| e.g.components(v))
                });
                let found = values.map(|components| components.map(|value| self.stand_in(value)));
                self.caches.readings.stand_ins.moving.insert(index, found);
                found
            }
        };
        if let Some(read) = &mut self.caches.readings.stand_ins.read {
            read.moving.insert(index, found);
        }
        let (position, origin) =
            (self.read_position(place), self.read_position(&FixedFrame { link: place.link, ..FixedFrame::GROUND }));
        let g = &mut self.g;
        let [velocity, angular] = found.map(|components| g.vector(components));
        let arm = g.sum_vectors(&[position, -origin]);
        let swing = g.cross(angular, arm);
        [g.add_vectors(velocity, swing), angular]
    }

    /// Components of a world vector in the axes of a frame that an expression reads.
    pub(in crate::mechanics) fn read_express(&mut self, place: &FixedFrame, v: Vector) -> Vector {
        let columns = self.read_columns(place).map(|column| self.g.vector(column));
        let components = columns.map(|column| self.g.dot(column, v));
        self.g.vector(components)
    }

    fn read_position(&mut self, place: &FixedFrame) -> Vector {
        let Some(link) = self.read_link(place.link) else { return place.offset };
        let offset = self.g.components(place.offset);
        let mut terms = vec![self.g.vector(link.origin)];
        for (column, x) in link.columns.into_iter().zip(offset) {
            let column = self.g.vector(column);
            terms.push(self.g.scale(x, column));
        }
        self.g.sum_vectors(&terms)
    }

    /// The axes of a frame.
    fn read_columns(&mut self, place: &FixedFrame) -> [[Scalar; 3]; 3] {
        let rows = rotations::rows(&mut self.g, place.rotation);
        let Some(link) = self.read_link(place.link) else { return transpose(&rows) };
        let g = &mut self.g;
        transpose(&rows).map(|local| {
            std::array::from_fn(|i| {
                let terms: Vec<Scalar> = (0..3).map(|j| g.mul(link.columns[j][i], local[j])).collect();
                g.sum(&terms)
            })
        })
    }

    fn read_link(&mut self, link: Option<usize>) -> Option<Link> {
        let index = link?;
        let found = match self.caches.readings.stand_ins.links.get(&index) {
            Some(&found) => found,
            None => {
                let place = FixedFrame { link, ..FixedFrame::GROUND };
                let (origin, rows) = self.meaning_itself(|e| {
                    let origin = match e.of_place(&place, FrameQuantity::Position) {
                        Value::Vector(v) => e.g.components(v),
                        _ => [Scalar::ZERO; 3],
                    };
                    (origin, e.frame_rows(&place))
                });
                let columns = transpose(&rows);
                let origin = origin.map(|value| self.stand_in(value));
                let columns = columns.map(|column| column.map(|value| self.stand_in(value)));
                let found = Link { origin, columns };
                self.caches.readings.stand_ins.links.insert(index, found);
                found
            }
        };
        if let Some(read) = &mut self.caches.readings.stand_ins.read {
            read.links.insert(index, found);
        }
        Some(found)
    }

    /// Works something out with quantities that mean themselves.
    fn meaning_itself<T>(&mut self, f: impl FnOnce(&mut Self) -> T) -> T {
        let read = self.caches.readings.stand_ins.read.take();
        let memo = std::mem::take(&mut self.caches.memo);
        let result = f(self);
        self.caches.memo = memo;
        self.caches.readings.stand_ins.read = read;
        result
    }
}
