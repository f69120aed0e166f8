//! Stage `mechanics`: struts, chains between a fixed centre and a point whose mass lies on the line between the two.
//!
//! In: the moments of mass along the line, the vector d from the centre to the point with its derivatives. Out: the
//! force that the motion of the strut asks for at the point.
//!
//! A rod that turns about a fixed centre and another that slides in it along the line through the centre, up to a ball
//! at the point d (universal or ball, prismatic, ball): with all mass on the line, spin about it costs nothing, and the
//! energy depends on d alone. With e = d / L and the moments of the two rods about the centre (m1, h1, D1) and about
//! the point (m2, h2, D2), all along e, the mass m2 moves to the point (a base parameter), and
//!
//! ```text
//! T = J(L) e'.e' / 2,  J = D1 + D2 + 2 h2 L,  V = -(h1 + h2) g.e
//! ```
//!
//! A force along d is the actuator's and takes whatever value is needed, so the force on the strut at the point is
//! written up to a multiple of d, F = mu d'' + beta d' + kappa g - phi d with
//!
//! ```text
//! mu = J / L^2,  beta = (J' - 2 J / L) L' / L^2,  kappa = -(h1 + h2) / L
//! ```
//!
//! No angle and no unit vector is needed, and where forces are unknown phi is: the actuator's force follows from the
//! balance along the line, f = -F.e - h2 e'.e'.
//!
//! - [`detect`] finds struts in a tree, [`carrier`] gathers those that carry one body, [`motion`] tells how it moves.
//! - [`apart`] keeps struts alike for packs.
//! - [`inverse`] finds the actuators' forces, [`forward`] the body's accelerations.

pub mod apart;
pub mod carrier;
pub mod detect;
pub mod forward;
pub mod inverse;
pub mod motion;
pub(super) mod platform;
pub mod triple;

use crate::symbolic::graph::{Graph, Scalar};

use triple::{Triple, dot, scale, total};

/// Moments of mass along the line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Strut {
    /// First moment about the centre of what doesn't slide, plus that about the point of what does: h1 + h2.
    pub first: Scalar,
    /// First moment about the point of what slides, negative for mass between centre and point: h2.
    pub tail: Scalar,
    /// Second moments about centre and point, added up: D1 + D2.
    pub second: Scalar,
}

/// A strut in motion.
#[derive(Clone, Copy, Debug)]
pub struct Moving {
    pub d: Triple,
    /// d'.
    pub rate: Triple,
    pub length: Scalar,
    /// 1 / L.
    pub inverse: Scalar,
    /// L' = d.d' / L.
    pub length_rate: Scalar,
    /// D / L + 2 h2: mu = swell / L.
    pub swell: Scalar,
    /// 2 D / L + 2 h2: beta = -bend L' / L^2.
    pub bend: Scalar,
    /// Coefficient of d''.
    pub mu: Scalar,
    /// Coefficient of d'.
    pub beta: Scalar,
    /// Coefficient of gravity.
    pub kappa: Scalar,
}

impl Strut {
    /// All that depends on position and velocity.
    pub fn moving(&self, g: &mut Graph, d: Triple, rate: Triple) -> Moving {
        let square = dot(g, &d, &d);
        let length = g.sqrt(square);
        let inverse = g.reciprocal(length);
        let along = dot(g, &d, &rate);
        let length_rate = g.mul(along, inverse);
        // J = L (D u + 2 h2) with u = 1 / L; J' - 2 J / L = -2 (D u + h2), which is one addition from D u + 2 h2.
        let turned = g.mul(self.second, inverse);
        let two = g.integer(2);
        let both = g.mul(two, self.tail);
        let sum = g.add(turned, both);
        let mu = g.mul(inverse, sum);
        let bend = g.add(turned, sum);
        let beta = -g.product(&[bend, inverse, inverse, length_rate]);
        let kappa = -g.mul(self.first, inverse);
        Moving { d, rate, length, inverse, length_rate, swell: sum, bend, mu, beta, kappa }
    }
}

impl Moving {
    /// Says what its values are, for those that get statements.
    pub fn label(&self, g: &mut Graph, leg: &str) {
        for (k, axis) in ["x", "y", "z"].into_iter().enumerate() {
            g.label(self.d[k], || format!("{leg}_line_{axis}"));
            g.label(self.rate[k], || format!("{leg}_pin_rate_{axis}"));
        }
        // Equal values are one node: these are there.
        let (square, along) = (dot(g, &self.d, &self.d), dot(g, &self.d, &self.rate));
        g.label(square, || format!("{leg}_length_squared"));
        g.label(along, || format!("{leg}_line_by_rate"));
        let swing = self.swing(g);
        g.label(swing, || format!("{leg}_swing"));
        g.label(self.length, || format!("{leg}_length"));
        g.label(self.inverse, || format!("{leg}_length_inv"));
        g.label(self.length_rate, || format!("{leg}_length_rate"));
        g.label(self.swell, || format!("{leg}_swell"));
        g.label(self.bend, || format!("{leg}_bend"));
        g.label(self.mu, || format!("{leg}_mu"));
        g.label(self.beta, || format!("{leg}_beta"));
        g.label(self.kappa, || format!("{leg}_kappa"));
    }

    /// The force at the point, up to a part along d.
    pub fn transverse(&self, g: &mut Graph, second: &Triple, gravity: &Triple) -> Triple {
        let parts = [(self.mu, second), (self.beta, &self.rate), (self.kappa, gravity)];
        let parts = parts.map(|(factor, vector)| scale(g, factor, vector));
        total(g, &parts)
    }

    /// The actuator's force from the factor of d: f = phi L - (T.d) / L - h2 e'.e', where T is the rest of the force.
    pub fn actuator(&self, g: &mut Graph, strut: &Strut, transverse: &Triple, phi: Scalar) -> Scalar {
        let along = dot(g, transverse, &self.d);
        let swing = self.swing(g);
        let pull = g.product(&[strut.tail, self.inverse, swing]);
        let rest = g.add(along, pull);
        let rest = g.mul(self.inverse, rest);
        let own = g.mul(phi, self.length);
        g.sub(own, rest)
    }

    /// The same from the motion along d alone: T.d = mu d.d'' + beta d.d' + kappa d.g.
    pub fn actuator_along(
        &self,
        g: &mut Graph,
        strut: &Strut,
        second: &Triple,
        gravity: &Triple,
        phi: Scalar,
    ) -> Scalar {
        let (pull, fall) = (dot(g, second, &self.d), dot(g, gravity, &self.d));
        let pull = g.mul(self.swell, pull);
        let fall = -g.mul(strut.first, fall);
        let speed = dot(g, &self.rate, &self.rate);
        let speed = g.mul(strut.tail, speed);
        let square = g.mul(self.length_rate, self.length_rate);
        let bend = g.add(self.bend, strut.tail);
        let bend = -g.mul(bend, square);
        // What gravity does takes one factor 1 / L less: kappa = -(h1 + h2) / L.
        let sum = g.sum(&[pull, speed, bend]);
        let sum = g.product(&[self.inverse, self.inverse, sum]);
        let fall = g.product(&[self.inverse, self.inverse, fall]);
        let own = g.mul(phi, self.length);
        g.sum(&[own, -sum, -fall])
    }

    /// L^2 e'.e' = d'.d' - L'^2.
    pub fn swing(&self, g: &mut Graph) -> Scalar {
        let speed = dot(g, &self.rate, &self.rate);
        let square = g.mul(self.length_rate, self.length_rate);
        g.sub(speed, square)
    }
}
