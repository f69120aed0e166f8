//! Stage `mechanics`: forces in the struts under a body whose motion is given.
//!
//! In: a [`Carrier`]. Out: the actuators' forces and the rank of the system that gives them. Balance of the body: with
//! T the transverse force of a strut (see [`super`]) and phi d what acts along its line,
//!
//! ```text
//! sum phi d = sum T + m (a - g) + U h - load
//! sum r x phi d = sum r x T + h x (a - g) + axial(U D) - load
//! ```
//!
//! about a reference point, U the matrix of the body's spin. Columns are (d, r x d) and not those of unit vectors:
//! their unknown takes the factor. In the body's axes, or about the feet in the world's, r has constant components,
//! and rows of the system may come out proportional (see [`crate::symbolic::inputs`]).

use crate::dynamics::inertia::{Inertia, entry};
use crate::symbolic::graph::{Graph, Scalar};
use crate::symbolic::inputs::{Known, solve_inputs};

use super::Moving;
use super::carrier::{Axes, Carrier, View};
use super::triple::{Triple, ZERO, add, combine, cross, label, minus, scale, sub, total};

/// About which points the moments of the lines of force are taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Arms {
    /// The view's reference point: arms are the pins' constant places.
    Pins,
    /// The first pin: its strut has no moment, so that half of a column is zero from the start.
    Pin,
    /// The world's origin: arms are the feet's constant places where axes are the world's.
    Feet,
}

/// How the struts' transverse forces are added up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gather {
    /// As vectors.
    Forces,
    /// By moments of their coefficients mu, beta and kappa over the pins: where all pins move alike this is less.
    Moments,
}

/// One way to write the equations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Variant {
    pub axes: Axes,
    pub arms: Arms,
    pub gather: Gather,
    /// Whether numbers of struts are symbols (see [`super::apart`]).
    pub apart: bool,
}

/// What is worth counting: ways with their names and reference points. `assumed`: some height of a pin above its foot
/// is known not to vanish, so that columns may be scaled. Where struts go into `packs`, there is one in which they are alike too.
pub fn ways(carrier: &Carrier, assumed: bool, packs: bool) -> Vec<(&'static str, Variant, Triple)> {
    let still = carrier.omega == ZERO && carrier.d_omega == ZERO;
    let gather = if still { Gather::Moments } else { Gather::Forces };
    let plane = carrier.plane();
    let way = |axes, arms| Variant { axes, arms, gather, apart: false };
    let mut list = vec![("struts, moments about a pin", way(Axes::Body, Arms::Pin), plane)];
    if let Some(leg) = carrier.legs.first().filter(|leg| leg.pin != plane) {
        list.push(("struts, everything about a pin", way(Axes::Body, Arms::Pins), leg.pin));
    }
    if still {
        list.push(("struts, moments about a point of the pins' plane", way(Axes::Body, Arms::Pins), plane));
    }
    if assumed {
        list.push(("struts in world axes, moments about the feet", way(Axes::World, Arms::Feet), plane));
    }
    if packs {
        let alike = Variant { gather: Gather::Forces, apart: true, ..way(Axes::Body, Arms::Pin) };
        list.push(("struts one by one, moments about a pin", alike, plane));
    }
    list
}

/// Forces of the actuators.
pub struct Forces {
    pub forces: Vec<Scalar>,
    pub rank: Scalar,
    /// Rows of the system that were eliminated at compile time.
    pub constant: usize,
}

/// Forces along the struts that produce the carrier's motion. Nothing unless there are six.
pub fn forces(g: &mut Graph, carrier: &Carrier, way: Variant, reference: &Triple, known: &Known) -> Option<Forces> {
    if carrier.legs.len() != 6 {
        return None;
    }
    let view = carrier.view(g, way.axes, reference);
    let mut lines: Vec<Moving> = Vec::new();
    let mut transverse: Vec<Triple> = Vec::new();
    let mut seconds: Vec<Triple> = Vec::new();
    for (at, leg) in carrier.legs.iter().enumerate() {
        let before = g.begin(Some(format!("Strut {}.", leg.name).into()));
        let (d, rate) = (view.line(g, at), view.pin_velocity(g, at));
        let second = view.pin_acceleration(g, at);
        let line = leg.strut.moving(g, d, rate);
        line.label(g, &leg.name);
        if way.gather == Gather::Forces {
            let force = line.transverse(g, &second, &view.gravity);
            label(g, &force, &format!("{}_transverse", leg.name));
            transverse.push(force);
        }
        seconds.push(second);
        lines.push(line);
        g.begin(before);
    }
    let before = g.begin(Some("Balance of the body on its struts.".into()));
    let (force, moment) = balance(g, &view, &lines, &transverse);
    label(g, &force, "body_force");
    label(g, &moment, "body_moment");
    // From the point of the moments to the reference point.
    let first = view.pins.first().copied().unwrap_or(ZERO);
    let shift = match way.arms {
        Arms::Pins => ZERO,
        Arms::Pin => combine(g, &view.columns, &minus(&first)),
        Arms::Feet => view.place,
    };
    let shift = cross(g, &shift, &force);
    let moment = add(g, &moment, &shift);
    let mut matrix = vec![Vec::new(); 6];
    for (at, line) in lines.iter().enumerate() {
        let arm = match way.arms {
            Arms::Pins => view.arm(g, at),
            Arms::Pin => {
                let away = sub(g, &view.pins[at], &first);
                combine(g, &view.columns, &away)
            }
            Arms::Feet => view.feet[at],
        };
        let turning = cross(g, &arm, &line.d);
        for k in 0..3 {
            matrix[k].push(line.d[k]);
            matrix[k + 3].push(turning[k]);
        }
        label(g, &turning, &format!("{}_lever", carrier.legs[at].name));
    }
    let side: Vec<Scalar> = force.into_iter().chain(moment).collect();
    let found = solve_inputs(g, known, &matrix, &side);
    for (leg, &phi) in carrier.legs.iter().zip(&found.unknowns) {
        g.label(phi, || format!("{}_tension", leg.name));
    }
    g.begin(before);
    let mut forces = Vec::new();
    for (at, leg) in carrier.legs.iter().enumerate() {
        let (line, phi) = (&lines[at], found.unknowns[at]);
        forces.push(match way.gather {
            Gather::Forces => line.actuator(g, &leg.strut, &transverse[at], phi),
            Gather::Moments => line.actuator_along(g, &leg.strut, &seconds[at], &view.gravity, phi),
        });
    }
    Some(Forces { forces, rank: found.rank, constant: found.constant })
}

/// Sums of a coefficient over the pins: zeroth, first and second moments.
fn moments(g: &mut Graph, view: &View, coefficients: &[Scalar]) -> Inertia {
    let mut sum = Inertia::ZERO;
    let mut terms: [Vec<Scalar>; 10] = Default::default();
    for (&mass, &pin) in coefficients.iter().zip(&view.pins) {
        let point = Inertia { mass, ..Inertia::ZERO }.shift(g, pin);
        let list = [point.mass].into_iter().chain(point.first).chain(point.second);
        terms.iter_mut().zip(list).for_each(|(terms, term)| terms.push(term));
    }
    let sums: Vec<Scalar> = terms.iter().map(|terms| g.sum(terms)).collect();
    sum.mass = sums[0];
    sum.first.copy_from_slice(&sums[1..4]);
    sum.second.copy_from_slice(&sums[4..]);
    sum
}

/// What the lines of force have to bear: force and moment about the reference point. `transverse` is empty where forces
/// are gathered by moments.
fn balance(g: &mut Graph, view: &View, lines: &[Moving], transverse: &[Triple]) -> (Triple, Triple) {
    let mut inertia = view.inertia;
    // Distributions that a field pulls: body and pins by acceleration and gravity, struts by their pins' velocities.
    let mut weight = inertia;
    let mut drag = Inertia::ZERO;
    if transverse.is_empty() {
        let [mu, beta, kappa] = [|l: &Moving| l.mu, |l: &Moving| l.beta, |l: &Moving| -l.kappa]
            .map(|get| lines.iter().map(get).collect::<Vec<Scalar>>());
        let mu = moments(g, view, &mu);
        inertia = inertia.add(g, &mu);
        mu.label(g, "struts_mu");
        drag = moments(g, view, &beta);
        drag.label(g, "struts_beta");
        let kappa = moments(g, view, &kappa);
        kappa.label(g, "struts_kappa");
        weight = weight.add(g, &kappa);
    }
    let fields = [
        (inertia, view.acceleration, view.seconds),
        (drag, view.velocity, view.rates),
        (weight, minus(&view.gravity), [ZERO; 3]),
    ];
    let common = inertia.second[2];
    let own = [0, 1, 2].map(|k| {
        let mut terms = Vec::new();
        for (moments, at, columns) in &fields {
            terms.push(scale(g, moments.first[k], at));
            for l in 0..3 {
                let moment = moments.second[entry(k, l)];
                // axial(U D) by columns: the sum of D_kl c_k x c_l''. Of D = D' + D_zz 1 the last gives 2 D_zz w'.
                let moment = if k == l && *columns == view.seconds { g.sub(moment, common) } else { moment };
                terms.push(scale(g, moment, &columns[l]));
            }
        }
        total(g, &terms)
    });
    let (force, moment) = view.wrench(g, transverse, &own);
    let mut terms = vec![force, minus(&view.load.0)];
    for (moments, at, columns) in &fields {
        terms.push(scale(g, moments.mass, at));
        terms.push(combine(g, columns, &moments.first));
    }
    let force = total(g, &terms);
    weight.label(g, "falling");
    let two = g.integer(2);
    let twice = g.mul(two, common);
    let spin = scale(g, twice, &view.d_omega);
    let moment = total(g, &[moment, spin, minus(&view.load.1)]);
    (force, moment)
}
