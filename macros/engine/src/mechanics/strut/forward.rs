//! Stage `mechanics`: motion of a body on struts whose forces are given.
//!
//! In: a [`Carrier`] and the actuators' forces; its accelerations are not read. Out: the acceleration of its origin in
//! the world's axes and its angular acceleration in its own. Every strut is condensed to a 3-vector at its pin, its
//! force:
//!
//! ```text
//! F = mu d'' + beta d' + kappa g - s d,
//! s = mu d.d'' / L^2 + (beta d.d' + kappa d.g) / L^2 + (f + h2 e'.e') / L
//! ```
//!
//! so mu is a mass at the pin and joins the body's moments, and mu/L^2 (d, r x d) (d, r x d)^T is taken off the body's
//! 6x6 inertia. What is left is positive definite, and factored as L^T D L without exchanges.

use crate::dynamics::inertia::Inertia;
use crate::symbolic::graph::{Graph, Scalar};
use crate::symbolic::linear_algebra::solve_symmetric;
use crate::symbolic::pairs::solve_in_pairs;

use super::carrier::{Axes, Carrier, spin_matrix};
use super::triple::{Triple, ZERO, apply, combine, cross, dot, label, minus, scale, sub, total};

/// The order in which unknowns are eliminated: translations are 0, 1, 2, rotations 3, 4, 5.
const ORDER: [usize; 6] = [5, 4, 3, 2, 1, 0];

/// What these are called.
const MOTIONS: [&str; 6] = ["x", "y", "z", "roll", "pitch", "yaw"];

/// How what struts take off the body's inertia is added up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gather {
    /// nu d d^T times constants: cheap where pins have coordinates in common or are mirrored.
    Sums,
    /// nu (d, r x d) (d, r x d)^T strut by strut.
    Lines,
}

/// One way to write the equations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Variant {
    pub gather: Gather,
    /// Whether unknowns are eliminated two at a time, which takes less time and a few operations more.
    pub pairs: bool,
    /// Whether numbers of struts are symbols (see [`super::apart`]).
    pub apart: bool,
}

/// What is worth counting: ways with their names and reference points; where struts go into packs, one in which they are alike too.
pub fn ways(carrier: &Carrier, packs: bool) -> Vec<(&'static str, Variant, Triple)> {
    let plane = carrier.plane();
    let way = |gather| Variant { gather, pairs: false, apart: false };
    let mut list = vec![("struts, condensed", way(Gather::Sums), plane)];
    if let Some(leg) = carrier.legs.first().filter(|leg| leg.pin != plane) {
        list.push(("struts, condensed, about a pin", way(Gather::Sums), leg.pin));
        list.push(("struts, condensed one by one, about a pin", way(Gather::Lines), leg.pin));
    }
    if packs {
        let alike = Variant { gather: Gather::Lines, pairs: true, apart: true };
        list.push(("struts, condensed one by one, solved in pairs", alike, plane));
    }
    list
}

/// Accelerations from forces. Where the rotation is `held`, the carrier's own is taken and translations alone are found.
pub fn accelerations(
    g: &mut Graph,
    carrier: &Carrier,
    forces: &[Scalar],
    (reference, way): (&Triple, Variant),
    held: bool,
) -> (Triple, Triple) {
    let still = Carrier { acceleration: ZERO, d_omega: ZERO, ..carrier.clone() };
    let view = still.view(g, Axes::Body, reference);
    let mut inertia = view.inertia;
    let mut matrix = vec![vec![Scalar::ZERO; 6]; 6];
    let mut taken: Vec<Vec<Vec<Scalar>>> = vec![vec![Vec::new(); 6]; 6];
    let mut pushes: Vec<Triple> = Vec::new();
    for (at, leg) in carrier.legs.iter().enumerate() {
        let before = g.begin(Some(format!("Strut {}.", leg.name).into()));
        let (d, rate) = (view.line(g, at), view.pin_velocity(g, at));
        let line = leg.strut.moving(g, d, rate);
        line.label(g, &leg.name);
        let pin = view.pins[at];
        let point = Inertia { mass: line.mu, ..Inertia::ZERO }.shift(g, pin);
        inertia = inertia.add(g, &point);
        let nu = g.product(&[line.mu, line.inverse, line.inverse]);
        let along = scale(g, nu, &d);
        g.label(nu, || format!("{}_nu", leg.name));
        label(g, &along, &format!("{}_nu_line", leg.name));
        match way.gather {
            Gather::Sums => {
                let n = [0, 1, 2].map(|i| [0, 1, 2].map(|j| g.mul(along[i], d[j])));
                take(g, &n, &pin, &mut taken);
            }
            Gather::Lines => {
                let (turning, heavy) = (cross(g, &pin, &d), cross(g, &pin, &along));
                let row = [d, turning].concat();
                let heavy: Vec<Scalar> = along.into_iter().chain(heavy).collect();
                for i in 0..6 {
                    for j in i..6 {
                        let term = g.mul(heavy[i], row[j]);
                        taken[i][j].push(term);
                        if i != j {
                            taken[j][i].push(term);
                        }
                    }
                }
            }
        }
        // s without the unknown accelerations.
        let turning = combine(g, &view.seconds, &pin);
        let centripetal = dot(g, &turning, &d);
        let centripetal = g.product(&[line.mu, line.inverse, centripetal]);
        let fall = dot(g, &view.gravity, &d);
        let fall = g.product(&[line.kappa, line.inverse, fall]);
        let swing = line.swing(g);
        let pull = g.product(&[leg.strut.tail, line.inverse, line.inverse, swing]);
        let bent = g.mul(line.beta, line.length_rate);
        let s = g.sum(&[forces[at], centripetal, fall, pull, bent]);
        g.label(s, || format!("{}_force", leg.name));
        let s = g.mul(s, line.inverse);
        g.label(s, || format!("{}_force_by_length", leg.name));
        let push = scale(g, s, &d);
        let drag = scale(g, -line.beta, &rate);
        label(g, &drag, &format!("{}_drag", leg.name));
        let weight = scale(g, -line.kappa, &view.gravity);
        let push = total(g, &[push, drag, weight]);
        label(g, &push, &format!("{}_push", leg.name));
        pushes.push(push);
        g.begin(before);
    }
    let before = g.begin(Some("Body on its struts.".into()));
    for i in 0..6 {
        for j in 0..6 {
            let rigid = rigid(g, &inertia, i, j);
            let terms: Vec<Scalar> = taken[i][j].iter().map(|&t| -t).chain([rigid]).collect();
            matrix[i][j] = g.sum(&terms);
            g.label(matrix[i][j], || format!("inertia_{}_{}", MOTIONS[i.min(j)], MOTIONS[i.max(j)]));
        }
    }
    let (force, moment) = view.wrench(g, &pushes, &[ZERO; 3]);
    // Weight of the body alone.
    let weight = scale(g, view.inertia.mass, &view.gravity);
    let tilt = cross(g, &view.inertia.first, &view.gravity);
    let centrifugal: Vec<Triple> = (0..3).map(|k| scale(g, inertia.first[k], &view.seconds[k])).collect();
    let centrifugal = total(g, &centrifugal);
    let force = total(g, &[force, weight, minus(&centrifugal), view.load.0]);
    let spin = spin_matrix(g, &view.omega, &ZERO);
    let gyroscopic = axial(g, &spin, &inertia);
    let moment = total(g, &[moment, tilt, minus(&gyroscopic), view.load.1]);
    label(g, &force, "body_force");
    label(g, &moment, "body_moment");
    g.label(inertia.mass, || "body_and_struts_mass".to_owned());
    g.begin(before);
    let side: Vec<Scalar> = force.into_iter().chain(moment).collect();
    let solve = if way.pairs { solve_in_pairs } else { solve_symmetric };
    let (at, d_omega) = if held {
        let d_omega = carrier.d_omega;
        let rest: Vec<Scalar> = (0..3)
            .map(|i| {
                let turned = dot(g, &[matrix[i][3], matrix[i][4], matrix[i][5]], &d_omega);
                g.sub(side[i], turned)
            })
            .collect();
        let block: Vec<Vec<Scalar>> = matrix[..3].iter().map(|row| row[..3].to_vec()).collect();
        let x = solve(g, &block, &[0, 1, 2], &rest);
        ([x[0], x[1], x[2]], d_omega)
    } else {
        let x = solve(g, &matrix, &ORDER, &side);
        ([x[0], x[1], x[2]], [x[3], x[4], x[5]])
    };
    // Back to the body's origin and to the world.
    let turning = spin_matrix(g, &view.omega, &d_omega);
    let offset = apply(g, &turning, reference);
    let origin = sub(g, &at, &offset);
    (apply(g, &carrier.rows, &origin), d_omega)
}

/// Entry of the inertia of a rigid body, translation before rotation, from its moments.
fn rigid(g: &mut Graph, inertia: &Inertia, i: usize, j: usize) -> Scalar {
    match (i < 3, j < 3) {
        (true, true) => {
            if i == j {
                inertia.mass
            } else {
                Scalar::ZERO
            }
        }
        (false, false) => inertia.tensor(g, i - 3, j - 3),
        // Force by angular acceleration: w' x h.
        (true, false) => levi(i, j - 3, &inertia.first),
        (false, true) => levi(j, i - 3, &inertia.first),
    }
}

/// Component i of unit j x h.
fn levi(i: usize, j: usize, h: &Triple) -> Scalar {
    match (i + 3 - j) % 3 {
        1 => -h[3 - i - j],
        2 => h[3 - i - j],
        _ => Scalar::ZERO,
    }
}

/// Terms of (d, r x d) (d, r x d)^T times nu, from N = nu d d^T.
fn take(g: &mut Graph, n: &[Triple; 3], r: &Triple, taken: &mut [Vec<Vec<Scalar>>]) {
    // Row a of the 6-vector as a combination of d: (component of d, factor).
    let rows: [Vec<(usize, Scalar)>; 6] = std::array::from_fn(|a| {
        if a < 3 {
            return vec![(a, Scalar::ONE)];
        }
        let (j, k) = ((a - 3 + 1) % 3, (a - 3 + 2) % 3);
        vec![(k, r[j]), (j, -r[k])]
    });
    for (a, first) in rows.iter().enumerate() {
        for (b, second) in rows.iter().enumerate() {
            for &(i, x) in first {
                for &(j, y) in second {
                    let factor = g.mul(x, y);
                    let term = g.mul(factor, n[i.min(j)][i.max(j)]);
                    taken[a][b].push(term);
                }
            }
        }
    }
}

/// Moment of the body's own motion: the sum of r x U r.
fn axial(g: &mut Graph, spin: &[Triple; 3], inertia: &Inertia) -> Triple {
    let product = |g: &mut Graph, i: usize, j: usize| {
        let column = [0, 1, 2].map(|l| inertia.second[crate::dynamics::inertia::entry(l, j)]);
        dot(g, &spin[i], &column)
    };
    [0, 1, 2].map(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        let (x, y) = (product(g, k, j), product(g, j, k));
        g.sub(x, y)
    })
}
