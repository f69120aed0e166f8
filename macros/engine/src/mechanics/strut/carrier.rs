//! Stage `mechanics`: a body on struts, seen in axes and about a point of choice.
//!
//! In: the motion of a body, its moments, its struts between points of the ground and points of the body. Out: a
//! [`View`]: all of that in one set of axes, the body's or the world's, about a reference point of the body. The body's
//! own axes come in as columns: units in the body's axes, columns of the rotation in the world's, so that one set of
//! equations serves both. Which axes and point are cheapest is for the count to tell.

use crate::dynamics::inertia::Inertia;
use crate::dynamics::tree::Tree;
use crate::symbolic::graph::{Graph, Scalar};

use super::detect::Chain;
use super::triple::{self, Triple, UNITS, ZERO, add, apply, apply_transposed, combine, cross, minus, scale, total};
use super::{Strut, motion};

/// A strut and where it ends.
#[derive(Clone, Debug)]
pub struct Leg {
    /// What its links have in common in their names.
    pub name: String,
    pub strut: Strut,
    /// Centre, in the world.
    pub foot: Triple,
    /// Point, in the body's frame.
    pub pin: Triple,
}

/// A body on struts.
#[derive(Clone, Debug)]
pub struct Carrier {
    /// Rotation from the body's to the world's axes, row by row.
    pub rows: [Triple; 3],
    /// Of the body's origin, in the world's axes.
    pub place: Triple,
    pub velocity: Triple,
    pub acceleration: Triple,
    /// In the body's axes.
    pub omega: Triple,
    pub d_omega: Triple,
    /// Of the body and of what the struts leave at their points, in the body's frame.
    pub inertia: Inertia,
    /// In the world's axes.
    pub gravity: Triple,
    /// Other forces on the body and their moment about its origin, in the body's axes.
    pub load: (Triple, Triple),
    pub legs: Vec<Leg>,
}

/// Axes in which equations are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axes {
    Body,
    World,
}

/// A carrier in one set of axes, about one point.
pub struct View {
    /// The body's axes, and their first and second derivatives.
    pub columns: [Triple; 3],
    pub rates: [Triple; 3],
    pub seconds: [Triple; 3],
    pub omega: Triple,
    pub d_omega: Triple,
    /// Of the reference point.
    pub place: Triple,
    pub velocity: Triple,
    pub acceleration: Triple,
    pub gravity: Triple,
    /// About the reference point, in the body's axes.
    pub inertia: Inertia,
    pub load: (Triple, Triple),
    pub feet: Vec<Triple>,
    /// From the reference point, in the body's axes.
    pub pins: Vec<Triple>,
}

impl Carrier {
    /// The link of a tree that these struts carry; pins in its axes. Nothing if what lies between it and the ground has
    /// mass, or if it carries links itself. Accelerations are the tree's symbols.
    pub fn of(g: &mut Graph, tree: &Tree, link: usize, legs: &[(Chain, Triple, bool)]) -> Option<Carrier> {
        let path = tree.path(None, Some(link));
        let bare = path.iter().all(|&at| {
            let other = &tree.links[at];
            other.armature == Scalar::ZERO && (at == link || other.inertia.is_zero())
        });
        let leaf = tree.links.iter().all(|other| other.parent != Some(link));
        let grounded = legs.iter().all(|(chain, ..)| chain.parent.is_none());
        if !bare || !leaf || !grounded {
            return None;
        }
        let moves = motion::moves(g, tree, link, &tree.acceleration).pop()?;
        let mut inertia = tree.links[link].inertia;
        for (chain, pin, _) in legs {
            let point = Inertia { mass: chain.mass, ..Inertia::ZERO }.shift(g, *pin);
            inertia = inertia.add(g, &point);
        }
        let legs = legs.iter().map(|(chain, pin, positive)| Leg {
            name: chain.name(tree),
            strut: chain.strut(*positive),
            foot: chain.centre,
            pin: *pin,
        });
        let vectors = [moves.place, moves.velocity, moves.acceleration, moves.omega, moves.d_omega];
        let [place, velocity, acceleration, omega, d_omega] = vectors.map(|v| g.components(v));
        Some(Carrier {
            rows: g.rotation_rows(moves.rotation),
            place,
            velocity,
            acceleration,
            omega,
            d_omega,
            inertia,
            gravity: tree.gravity.unwrap_or(ZERO),
            load: (ZERO, ZERO),
            legs: legs.collect(),
        })
    }

    /// A point of the plane in which all struts end: what components of the points have in common.
    pub fn plane(&self) -> Triple {
        [0, 1, 2].map(|k| {
            let common = |pin: Scalar| self.legs.iter().all(|leg| leg.pin[k] == pin);
            self.legs.first().map(|leg| leg.pin[k]).filter(|&pin| common(pin)).unwrap_or(Scalar::ZERO)
        })
    }

    /// Everything about `reference`, a point of the body, in these axes.
    pub fn view(&self, g: &mut Graph, axes: Axes, reference: &Triple) -> View {
        let into = |g: &mut Graph, v: &Triple| match axes {
            Axes::Body => apply_transposed(g, &self.rows, v),
            Axes::World => *v,
        };
        let out = |g: &mut Graph, v: &Triple| match axes {
            Axes::Body => *v,
            Axes::World => apply(g, &self.rows, v),
        };
        let columns = match axes {
            Axes::Body => UNITS,
            Axes::World => triple::transposed(&self.rows),
        };
        let (omega, d_omega) = (out(g, &self.omega), out(g, &self.d_omega));
        let spin = spin_matrix(g, &omega, &d_omega);
        let rates = columns.map(|c| cross(g, &omega, &c));
        let seconds = columns.map(|c| apply(g, &spin, &c));
        let [place, velocity, acceleration, gravity] =
            [self.place, self.velocity, self.acceleration, self.gravity].map(|v| into(g, &v));
        let [place, velocity, acceleration] =
            [(place, &columns), (velocity, &rates), (acceleration, &seconds)].map(|(origin, axes)| {
                let offset = combine(g, axes, reference);
                add(g, &origin, &offset)
            });
        let away = minus(reference);
        let inertia = self.inertia.shift(g, away);
        let (force, moment) = self.load;
        let arm = cross(g, &away, &force);
        let moment = add(g, &moment, &arm);
        let load = (out(g, &force), out(g, &moment));
        let feet = self.legs.iter().map(|leg| into(g, &leg.foot)).collect();
        let pins = self.legs.iter().map(|leg| add(g, &leg.pin, &away)).collect();
        View {
            columns,
            rates,
            seconds,
            omega,
            d_omega,
            place,
            velocity,
            acceleration,
            gravity,
            inertia,
            load,
            feet,
            pins,
        }
    }
}

impl View {
    /// From foot to pin.
    pub fn line(&self, g: &mut Graph, leg: usize) -> Triple {
        let arm = self.arm(g, leg);
        total(g, &[self.place, arm, minus(&self.feet[leg])])
    }

    /// From the reference point to a pin.
    pub fn arm(&self, g: &mut Graph, leg: usize) -> Triple {
        combine(g, &self.columns, &self.pins[leg])
    }

    /// Velocity of a pin.
    pub fn pin_velocity(&self, g: &mut Graph, leg: usize) -> Triple {
        let turning = combine(g, &self.rates, &self.pins[leg]);
        add(g, &self.velocity, &turning)
    }

    /// Acceleration of a pin.
    pub fn pin_acceleration(&self, g: &mut Graph, leg: usize) -> Triple {
        let turning = combine(g, &self.seconds, &self.pins[leg]);
        add(g, &self.acceleration, &turning)
    }

    /// The sum of forces at the pins, and their moment about the reference point, column by column:
    /// c1 x (sum of x F) + c2 x (sum of y F) + c3 x (sum of z F).
    pub fn wrench(&self, g: &mut Graph, forces: &[Triple], own: &[Triple; 3]) -> (Triple, Triple) {
        let force = total(g, forces);
        let moments = [0, 1, 2].map(|k| {
            let mut terms: Vec<Triple> =
                forces.iter().zip(&self.pins).map(|(force, pin)| scale(g, pin[k], force)).collect();
            terms.push(own[k]);
            let sum = total(g, &terms);
            cross(g, &self.columns[k], &sum)
        });
        (force, total(g, &moments))
    }
}

/// [dw x] + [w x][w x], row by row.
pub fn spin_matrix(g: &mut Graph, w: &Triple, dw: &Triple) -> [Triple; 3] {
    let mut u = [ZERO; 3];
    let squares = w.map(|c| g.mul(c, c));
    for i in 0..3 {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        u[i][i] = -g.add(squares[j], squares[k]);
        let product = g.mul(w[j], w[k]);
        u[j][k] = g.sub(product, dw[i]);
        u[k][j] = g.add(product, dw[i]);
    }
    u
}
