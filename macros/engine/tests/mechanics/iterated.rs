//! Loops that Newton's method closes against the same mechanisms with multipliers: the compiled programs, as users run them,
//! at many closed configurations, from guesses that are off.

use std::collections::HashMap;

use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::model::types::Coordinate;
use multibody_engine::optimize::compile;
use multibody_engine::optimize::program::Compiled;
use multibody_engine::symbolic::evaluate::solve_f64;

use super::interpreter::run;
use super::support::{Case, Random, case_with};

/// A mechanism without its formulation.
struct Mechanism {
    name: &'static str,
    parts: &'static str,
    body: &'static str,
    /// Coordinates that stay in the state.
    independent: &'static str,
}

const DELTA: Mechanism = Mechanism {
    name: "Delta robot, rods as bodies",
    parts: "mod limb {
        port hip: Frame; port left: Frame; port right: Frame;
        input torque;
        body arm { mass: 0.3, com: 0.15 * X, inertia: diag(0.0001, 0.003, 0.003) }
        body rod_a { mass: 0.1, com: 0.4 * X, inertia: diag(0.00001, 0.006, 0.006) }
        body rod_b { mass: 0.1, com: 0.4 * X, inertia: diag(0.00001, 0.006, 0.006) }
        joint shoulder: Revolute { parent: hip, child: arm, axis: Y }
        joint elbow_a: Universal { parent: arm.at(0.3 * X + 0.05 * Y), child: rod_a, axes: [Y, Z] }
        joint elbow_b: Universal { parent: arm.at(0.3 * X - 0.05 * Y), child: rod_b, axes: [Y, Z] }
        #[cut] joint wrist_a: Ball { parent: rod_a.at(0.8 * X), child: left }
        #[cut] joint wrist_b: Ball { parent: rod_b.at(0.8 * X), child: right }
        force motor: Effort { joint: shoulder, value: torque }
    }",
    body: "world { gravity: -9.80665 * Z }
        body plate { mass: 0.5, inertia: diag(0.001, 0.001, 0.002), coordinates: Absolute(RollPitchYaw) }
        part limbs: [limb; 3] = |i| limb {
            hip: ground.rotated(Z, i * 2.0 * PI / 3.0).at(0.2 * X),
            left: plate.rotated(Z, i * 2.0 * PI / 3.0).at(0.05 * X + 0.05 * Y),
            right: plate.rotated(Z, i * 2.0 * PI / 3.0).at(0.05 * X - 0.05 * Y),
        };",
    independent: "",
};

const RPS: Mechanism = Mechanism {
    name: "3-RPS",
    parts: "mod limb {
        port hip: Frame; port tip: Frame;
        input thrust;
        body cylinder { mass: 0.4, com: 0.3 * Z, inertia: diag(0.01, 0.01, 0.001) }
        body piston { mass: 0.3, com: -0.3 * Z, inertia: diag(0.01, 0.01, 0.001) }
        joint hinge: Revolute { parent: hip, child: cylinder, axis: Y }
        joint stroke: Prismatic { parent: cylinder.at(0.8 * Z), child: piston, axis: Z }
        #[cut] joint ball: Ball { parent: piston, child: tip }
        force motor: Effort { joint: stroke, value: thrust }
    }",
    body: "world { gravity: -9.80665 * Z }
        body plate { mass: 2.0, inertia: diag(0.05, 0.05, 0.1), coordinates: Absolute(RollPitchYaw) }
        part limbs: [limb; 3] = |i| limb {
            hip: ground.rotated(Z, i * 2.0 * PI / 3.0).at(0.5 * X),
            tip: plate.rotated(Z, i * 2.0 * PI / 3.0).at(0.3 * X),
        };",
    independent: "",
};

/// Axes and points in general position.
const WISHBONE: Mechanism = Mechanism {
    name: "double wishbone with a tie rod",
    parts: "",
    body: "world { gravity: -9.80665 * Z }
        input load;
        body lower { mass: 2.0, com: 0.2 * X, inertia: diag(0.02, 0.03, 0.04) }
        body upper { mass: 1.5, com: 0.15 * X, inertia: diag(0.01, 0.02, 0.03) }
        body upright { mass: 8.0, com: [0.05, 0.01, 0.12], inertia: diag(0.1, 0.12, 0.08) }
        body tie { mass: 0.5, com: 0.2 * X, inertia: diag(0.001, 0.01, 0.01) }
        joint low: Revolute { parent: ground, child: lower, axis: [0.05, 1.0, 0.03] }
        joint up: Revolute { parent: ground.at([0.08, 0.02, 0.25]), child: upper, axis: [-0.04, 1.0, 0.06] }
        joint pivot: Ball { parent: lower.at([0.42, 0.02, 0.01]), child: upright, coordinates: RollPitchYaw }
        #[cut] joint head: Ball { parent: upper.at([0.31, -0.01, 0.0]), child: upright.at([-0.03, -0.01, 0.26]) }
        joint rack: Universal { parent: ground.at([0.05, -0.12, 0.08]), child: tie, axes: [Y, Z] }
        #[cut] joint steer: Ball { parent: tie.at(0.37 * X), child: upright.at([0.0, -0.13, 0.08]) }
        force spring: Effort { joint: low, value: load - 5.0 * low.rate }",
    independent: "",
};

const SARRUS: Mechanism = Mechanism {
    name: "Sarrus linkage",
    parts: "",
    body: "world { gravity: -9.80665 * Z }
        input push;
        body a1 { mass: 0.4, com: [0.2, 0.0, 0.0], inertia: diag(0.001, 0.01, 0.01) }
        body a2 { mass: 0.4, com: [0.2, 0.0, 0.0], inertia: diag(0.001, 0.01, 0.01) }
        body b1 { mass: 0.4, com: [0.0, 0.2, 0.0], inertia: diag(0.01, 0.001, 0.01) }
        body b2 { mass: 0.4, com: [0.0, 0.2, 0.0], inertia: diag(0.01, 0.001, 0.01) }
        body plate { mass: 1.0, com: [0.1, 0.1, 0.0], inertia: diag(0.02, 0.02, 0.03) }
        joint a: Revolute { parent: ground, child: a1, axis: Y }
        joint ab: Revolute { parent: a1.at(0.4 * X), child: a2, axis: Y }
        joint ac: Revolute { parent: a2.at(0.4 * X), child: plate, axis: Y }
        joint b: Revolute { parent: ground.at([0.6, -0.5, 0.0]), child: b1, axis: X }
        joint bb: Revolute { parent: b1.at(0.4 * Y), child: b2, axis: X }
        #[cut] joint bc: Revolute { parent: b2.at(0.4 * Y), child: plate.at([0.1, -0.003, 0.0]), axis: X }
        force motor: Effort { joint: a, value: push }",
    independent: "",
};

const STEPHENSON: Mechanism = Mechanism {
    name: "Stephenson's six-bar",
    parts: "",
    body: "world { gravity: -9.80665 * Y }
        input torque;
        body crank { mass: 0.3, com: 0.1 * X, inertia: rod(0.3, 0.2, X) }
        body coupler { mass: 0.6, com: [0.3, 0.1, 0.0], inertia: diag(0.01, 0.01, 0.02) }
        body rocker { mass: 0.5, com: 0.25 * X, inertia: rod(0.5, 0.5, X) }
        body link { mass: 0.4, com: 0.2 * X, inertia: rod(0.4, 0.4, X) }
        body last { mass: 0.4, com: 0.3 * X, inertia: diag(0.01, 0.01, 0.02) }
        joint shaft: Revolute { parent: ground, child: link, axis: Z }
        joint floating: Revolute { parent: link.at(0.45 * X), child: coupler, axis: Z }
        joint pin: Revolute { parent: ground.at([0.8, 0.1, 0.0]), child: rocker, axis: Z }
        #[cut] joint one: Revolute { parent: coupler.at(0.7 * X), child: rocker.at(0.5 * X), axis: Z }
        joint turning: Revolute { parent: ground.at([0.3, -0.5, 0.0]), child: crank, axis: Z }
        joint lever: Revolute { parent: crank.at(0.2 * X), child: last, axis: Z }
        #[cut] joint two: Revolute { parent: coupler.at([0.35, 0.25, 0.0]), child: last.at(0.9 * X), axis: Z }
        force motor: Effort { joint: turning, value: torque }",
    independent: ", independent: [turning]",
};

/// The same in millimetres beside cosines: rows of different size.
const SMALL: Mechanism = Mechanism {
    name: "a small spatial four-bar",
    parts: "",
    body: "world { gravity: -9.80665 * Z }
        input torque;
        body crank { mass: 2e-4, com: 1e-3 * X, inertia: diag(1e-10, 2e-10, 2e-10) }
        body coupler { mass: 3e-4, com: [2e-3, 1e-3, 0.0], inertia: diag(2e-10, 6e-10, 6e-10) }
        body rocker { mass: 2e-4, com: 2e-3 * X, inertia: diag(1e-10, 3e-10, 3e-10) }
        joint shaft: Revolute { parent: ground, child: crank, axis: [0.1, 0.2, 1.0] }
        joint elbow: Universal { parent: crank.at(2e-3 * X), child: coupler, axes: [Y, Z] }
        joint foot: Cylindrical { parent: ground.at([5e-3, 1e-3, 0.0]), child: rocker, axis: [0.0, 0.1, 1.0] }
        #[cut] joint pin: Universal { parent: coupler.at(6e-3 * X), child: rocker.at(4e-3 * X), axes: [Y, Z] }
        force motor: Effort { joint: shaft, value: 1e-7 * torque }",
    independent: "",
};

/// One equation, one angle of which it reads the sine and cosine alone: a tip on a wavy surface, everything oblique.
const FOLLOWER: Mechanism = Mechanism {
    name: "a follower on a wave",
    parts: "",
    body: "world { gravity: [0.3, -0.2, -9.80665] }
        input torque;
        param deep = 0.11;
        body crank { mass: 0.3, com: [0.1, 0.02, 0.03], inertia: diag(0.01, 0.02, 0.03) }
        body arm { mass: 0.2, com: [0.2, -0.01, 0.05], inertia: diag(0.003, 0.02, 0.02) }
        joint shaft: Revolute { parent: ground.at([0.1, -0.2, 0.5]), child: crank, axis: [0.1, 1.0, 0.3] }
        joint elbow: Revolute { parent: crank.at([0.4, 0.1, 0.05]), child: arm, axis: [-0.2, 1.0, 0.25] }
        let tip = arm.at([0.7, 0.03, -0.02]);
        constraint on_wave = tip.position.z - deep * sin(5.0 * tip.position.x) - 0.2 * tip.position.y * tip.position.y;
        force motor: Effort { joint: shaft, value: torque }",
    independent: ", independent: [shaft]",
};

/// One equation and a number: a slider at a fixed distance on an oblique rail. Another one, an angle that is read as such.
const RIDER: Mechanism = Mechanism {
    name: "a rider, and a crank with a cam of its own angle",
    parts: "",
    body: "world { gravity: [0.3, -0.2, -9.80665] }
        input torque;
        body crank { mass: 0.3, com: [0.1, 0.02, 0.03], inertia: diag(0.01, 0.02, 0.03) }
        body block { mass: 0.7 }
        body cam { mass: 0.4, com: [0.01, 0.02, 0.05], inertia: diag(0.02, 0.02, 0.01) }
        joint shaft: Revolute { parent: ground.at([0.1, -0.2, 0.5]), child: crank, axis: [0.1, 1.0, 0.3] }
        joint rail: Prismatic { parent: ground.at([0.3, 0.1, 0.0]), child: block, axis: [1.0, 0.2, 0.1] }
        joint turn: Revolute { parent: block, child: cam, axis: [0.2, 0.3, 1.0] }
        constraint rod: Rod { between: [crank.at([0.3, 0.02, 0.1]), block.at([0.0, 0.0, 0.05])], length: 0.9 }
        constraint cammed = turn + 0.3 * sin(2.0 * turn) - 1.7 * shaft + 0.2 * rail;
        force motor: Effort { joint: shaft, value: torque }",
    independent: ", independent: [shaft]",
};

/// What stands alone in its equation is found without any guess, from what others give, before and behind it.
const FLOATER: Mechanism = Mechanism {
    name: "a float that a lever dips",
    parts: "",
    body: "world { gravity: [0.3, -0.2, -9.80665] }
        input torque;
        body sled { mass: 0.3, inertia: diag(0.01, 0.02, 0.03) }
        body buoy { mass: 0.2, com: [0.02, -0.01, 0.05], inertia: diag(0.003, 0.02, 0.02) }
        body lever { mass: 0.4, com: [0.2, 0.02, 0.05], inertia: diag(0.02, 0.02, 0.01) }
        joint run: Prismatic { parent: ground, child: sled, axis: [1.0, 0.2, 0.1] }
        joint dip: Prismatic { parent: sled.at([0.1, 0.2, 0.3]), child: buoy, axis: [0.2, -0.3, 1.0] }
        joint tilt: Revolute { parent: buoy.at([0.1, 0.02, 0.0]), child: lever, axis: [0.1, 1.0, 0.3] }
        constraint deep = 1.3 * dip - 0.2 * sin(3.0 * run) * cos(run) + 0.1 * run * run - 0.07;
        constraint touching = lever.at([0.5, 0.02, 0.1]).position.z - 0.25 - 0.05 * lever.at([0.5, 0.02, 0.1]).position.x;
        force motor: Effort { joint: run, value: torque }",
    independent: ", independent: [run]",
};

/// Functions with the values of fields.
struct Programs<'a> {
    case: &'a Case,
    compiled: Compiled,
}

type Values = HashMap<Symbol, f64>;

impl Programs<'_> {
    fn of(case: &Case) -> Programs<'_> {
        let compiled = compile(&case.derivation).unwrap_or_else(|_| panic!("too large"));
        assert!(compiled.sound);
        Programs { case, compiled }
    }

    fn eval(&self, kind: FunctionKind, values: &Values) -> Vec<f64> {
        let value = |symbol: Symbol| match symbol {
            Symbol::Param { param, element } => self.case.model.params[param].default[element],
            symbol => values.get(&symbol).copied().unwrap_or(0.0),
        };
        let fields = run(&self.compiled.prelude, &value, &|_| f64::NAN);
        let function = self.compiled.functions.iter().find(|f| f.kind == kind).expect("derived");
        run(&function.program, &value, &|field| fields[field.0])
    }
}

fn position(coordinate: Coordinate) -> Symbol {
    Symbol::Position { joint: coordinate.joint, component: coordinate.index }
}

fn velocity(coordinate: Coordinate) -> Symbol {
    Symbol::Velocity { joint: coordinate.joint, component: coordinate.index }
}

/// Of a symmetric positive matrix, over the largest.
fn least_pivot(mut matrix: Vec<f64>, n: usize) -> f64 {
    let mut open: Vec<usize> = (0..n).collect();
    let mut pivots = Vec::new();
    while let Some(&k) = open.iter().max_by(|&&a, &&b| matrix[a * n + a].total_cmp(&matrix[b * n + b])) {
        open.retain(|&other| other != k);
        let pivot = matrix[k * n + k];
        pivots.push(pivot);
        for &i in &open {
            let factor = matrix[i * n + k] / pivot;
            open.iter().for_each(|&j| matrix[i * n + j] -= factor * matrix[k * n + j]);
        }
    }
    pivots.iter().fold(f64::MAX, |a, &b| a.min(b)) / pivots[0]
}

/// Pivots of the squared slopes below this are those of a pose that is nearly singular.
const SINGULAR: f64 = 1e-8;

/// Accelerations of both, over all closed configurations that were found and near them.
fn check(mechanism: &Mechanism, tolerance: f64) {
    let derived = |handling: &str, independent: &str| {
        let formulation = format!("formulation {{ constraints: {handling}{independent} }} emit forward_dynamics;");
        case_with(mechanism.parts, &format!("{} {formulation}", mechanism.body))
    };
    let (reduced, kept) = (derived("Reduced", mechanism.independent), derived("Multipliers", ""));
    let (programs, others) = (Programs::of(&reduced), Programs::of(&kept));
    let (state, guessed) = (&reduced.structure.state, reduced.structure.guessed());
    assert!(!guessed.is_empty());
    let all = &kept.structure.state;
    let columns: Vec<usize> = (0..all.len()).filter(|&k| !state.contains(&all[k])).collect();
    let of_rows = |values: &Values, columns: &[usize]| {
        let jacobian = others.eval(FunctionKind::ConstraintJacobian, values);
        let rows: Vec<Vec<f64>> = jacobian.chunks(all.len()).map(<[f64]>::to_vec).collect();
        let normal: Vec<f64> = columns
            .iter()
            .flat_map(|&i| columns.iter().map(move |&j| (i, j)))
            .map(|(i, j)| rows.iter().map(|row| row[i] * row[j]).sum())
            .collect();
        (rows, normal)
    };
    let across = |rows: &[Vec<f64>], residuals: &[f64]| -> Vec<f64> {
        columns.iter().map(|&i| rows.iter().zip(residuals).map(|(row, r)| -row[i] * r).sum()).collect()
    };
    let mut random = Random(17);
    let (mut compared, mut open, mut singular) = (0, 0, 0);
    for closed in &reduced.structure.closed {
        for off in [0.0, 1e-3, 1e-2] {
            let mut values = Values::new();
            for &coordinate in state {
                let start = closed.value(&reduced.model, coordinate).expect("a number");
                values.insert(position(coordinate), start + off * random.next());
                values.insert(velocity(coordinate), random.next());
            }
            for (index, &coordinate) in guessed.iter().enumerate() {
                let start = closed.value(&reduced.model, coordinate).expect("a number");
                values.insert(Symbol::Guess { index }, start + 0.1 * off * random.next());
            }
            let inputs = reduced.derivation.symbols.iter().filter(|symbol| matches!(symbol, Symbol::Input { .. }));
            values.extend(inputs.map(|&input| (input, 3.0 * random.next())));
            // A configuration may be far from any that is closed, or at a dead centre.
            let found = programs.eval(FunctionKind::Guess, &values);
            let residual = found[guessed.len()];
            if residual.is_nan() || residual > 1e-12 {
                open += 1;
                continue;
            }
            // What needs no guess is found by the equations of the other one, and what was found with one stays.
            let mut full = values.clone();
            let start = |&k: &usize| (position(all[k]), closed.value(&kept.model, all[k]).expect("a number"));
            full.extend(columns.iter().map(start));
            full.extend(guessed.iter().map(|&c| position(c)).zip(found.iter().copied()));
            for _ in 0..6 {
                let residuals = others.eval(FunctionKind::Constraints, &full);
                let (rows, normal) = of_rows(&full, &columns);
                for (&k, change) in columns.iter().zip(solve_f64(&normal, &across(&rows, &residuals))) {
                    *full.entry(position(all[k])).or_default() += change;
                }
            }
            // Velocities that keep the loops closed, by least squares and one refinement.
            let (rows, normal) = of_rows(&full, &columns);
            for _ in 0..3 {
                let rate = |row: &Vec<f64>| -> f64 {
                    row.iter().zip(all).map(|(a, &c)| a * full.get(&velocity(c)).copied().unwrap_or(0.0)).sum()
                };
                let rates: Vec<f64> = rows.iter().map(rate).collect();
                for (&k, change) in columns.iter().zip(solve_f64(&normal, &across(&rows, &rates))) {
                    *full.entry(velocity(all[k])).or_default() += change;
                }
            }
            // Nor do accelerations of the state say much near a dead centre, where any are right.
            if least_pivot(normal, columns.len()) < SINGULAR {
                singular += 1;
                continue;
            }
            for (&coordinate, &x) in guessed.iter().zip(&found) {
                let error = (full[&position(coordinate)] - x).abs();
                assert!(error <= tolerance, "{}: a guess off by {error:e}", mechanism.name);
            }
            let got = programs.eval(FunctionKind::ForwardDynamics, &values);
            let want = others.eval(FunctionKind::ForwardDynamics, &full);
            let size = want[..all.len()].iter().fold(1.0_f64, |size, x| size.max(x.abs()));
            for (&coordinate, a) in state.iter().zip(&got) {
                let at = all.iter().position(|&other| other == coordinate).expect("kept");
                let error = (a - want[at]).abs() / size;
                assert!(error <= tolerance, "{}: {a} {} of {size}, off by {error:e}", mechanism.name, want[at]);
            }
            compared += 1;
        }
    }
    let told = format!("{}: {compared} states, {open} open, {singular} nearly singular", mechanism.name);
    println!("{told}");
    assert!(compared >= 6 && 10 * compared >= 7 * (compared + open + singular), "{told}");
}

#[test]
fn a_delta_robot() {
    check(&DELTA, 1e-10);
}

#[test]
fn a_three_rps_platform() {
    check(&RPS, 1e-10);
}

#[test]
fn a_double_wishbone() {
    check(&WISHBONE, 1e-10);
}

#[test]
fn a_sarrus_linkage() {
    check(&SARRUS, 1e-10);
}

#[test]
fn a_six_bar() {
    check(&STEPHENSON, 1e-10);
}

#[test]
fn a_small_loop() {
    check(&SMALL, 1e-10);
}

#[test]
fn one_angle() {
    check(&FOLLOWER, 1e-10);
}

#[test]
fn one_number() {
    check(&RIDER, 1e-10);
}

#[test]
fn what_stands_alone() {
    check(&FLOATER, 1e-10);
}

/// From guesses that are off by half a radian or half a metre.
#[test]
fn far_off_guesses_with_one_unknown() {
    let mut random = Random(71);
    for mechanism in [&FOLLOWER, &RIDER] {
        let formulation = "formulation { constraints: Reduced, independent: [shaft] } emit forward_dynamics;";
        let case = case_with(mechanism.parts, &format!("{} {formulation}", mechanism.body));
        let (programs, guessed) = (Programs::of(&case), case.structure.guessed());
        let (mut open, mut tried) = (0, 0);
        for closed in &case.structure.closed {
            let number = |coordinate: Coordinate| closed.value(&case.model, coordinate).expect("a number");
            let mut values: Values = case.structure.state.iter().map(|&c| (position(c), number(c))).collect();
            for _ in 0..20 {
                let off = guessed.iter().map(|&c| number(c) + 0.5 * random.next());
                values.extend((0..).map(|index| Symbol::Guess { index }).zip(off));
                let residual = programs.eval(FunctionKind::Guess, &values)[guessed.len()];
                open += usize::from(residual.is_nan() || residual > 1e-11);
                tried += 1;
            }
        }
        println!("{}: {open} of {tried} open", mechanism.name);
        assert!(10 * open <= tried, "{}: {open} of {tried}", mechanism.name);
    }
}

/// What a round leaves of half the error is an eighth of what it leaves of the whole.
#[test]
fn rounds_with_one_unknown_are_of_third_order() {
    for mechanism in [&FOLLOWER, &RIDER] {
        let formulation =
            "formulation { constraints: Reduced, independent: [shaft], rounds: 1 } emit forward_dynamics;";
        let case = case_with(mechanism.parts, &format!("{} {formulation}", mechanism.body));
        let (programs, guessed) = (Programs::of(&case), case.structure.guessed());
        let closed = &case.structure.closed[0];
        let mut values = Values::new();
        for &coordinate in &case.structure.state {
            values.insert(position(coordinate), closed.value(&case.model, coordinate).expect("a number"));
        }
        let mut at = |from: &[f64]| {
            values.extend((0..).map(|index| Symbol::Guess { index }).zip(from.iter().copied()));
            programs.eval(FunctionKind::Guess, &values)[..guessed.len()].to_vec()
        };
        let mut exact: Vec<f64> =
            guessed.iter().map(|&coordinate| closed.value(&case.model, coordinate).expect("a number")).collect();
        for _ in 0..4 {
            exact = at(&exact);
        }
        for k in 0..guessed.len() {
            // Later unknowns read what earlier ones are found as: each alone is off.
            let mut left = |off: f64| {
                let mut from = exact.clone();
                from[k] += off;
                (at(&from)[k] - exact[k]).abs()
            };
            for off in [0.04, -0.04] {
                let (whole, half) = (left(off), left(0.5 * off));
                println!("{}, {k}: {whole:.1e} and {half:.1e} of {off}", mechanism.name);
                assert!(whole < 40.0 * off.abs().powi(3), "{}", mechanism.name);
                // A parabola is solved at once.
                if whole < 1e-14 {
                    continue;
                }
                assert!((6.0..10.7).contains(&(whole / half)), "{}: {}", mechanism.name, whole / half);
            }
        }
    }
}

/// Sliders that all read each other: Newton's method takes a system which is too large to be written out.
#[test]
fn a_dense_system() {
    let n = 26;
    let mut body = "world { gravity: [0.3, 0.0, -9.81] } body b { mass: 1.0 }
        joint u: Prismatic { parent: ground, child: b, axis: X }"
        .to_owned();
    for i in 0..n {
        body += &format!("body b{i} {{ mass: 0.1 }} joint x{i}: Prismatic {{ parent: ground, child: b{i}, axis: X }}");
        let term = |j: usize| format!("{:.3} * sin(x{j}.travel)", 0.002 + ((7 * i + 3 * j) % 11) as f64 * 0.001);
        let sum: Vec<String> = (0..n).map(term).collect();
        let sum = sum.join(" + ");
        body += &format!("constraint c{i} = x{i}.travel + ({sum}) * cos(u.travel + {i}.0) - 0.3 * u.travel;");
    }
    let body = Box::leak(body.into_boxed_str());
    let dense = Mechanism { name: "sliders", parts: "", body, independent: ", independent: [u]" };
    check(&dense, 1e-10);
}
