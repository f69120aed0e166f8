//! Serial arms against reference data of another library (see tests/data/robots): inverse dynamics, bias, gravity, mass
//! matrix and forward dynamics by both formulations, graphs interpreted in double precision.

use crate::arms::{ARMS, Arm, flat, load, read};
use crate::formulations;
use multibody_engine::dynamics::regroup::regroup;
use multibody_engine::symbolic::evaluate::{Evaluator, Real};
use multibody_engine::symbolic::graph::{Scalar, SymbolId};

/// Relative to the largest entry of a sample's vector.
const TOLERANCE: f64 = 1e-12;

fn error(got: &[f64], want: &[f64]) -> f64 {
    assert_eq!(got.len(), want.len());
    let largest = want.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    got.iter().zip(want).map(|(a, b)| (a - b).abs() / largest).fold(0.0, worse)
}

/// The larger of two errors; NaN is the largest.
fn worse(a: f64, b: f64) -> f64 {
    if a.is_nan() || a >= b { a } else { b }
}

/// A function of an arm, and the samples' name for it.
type Function = (&'static str, &'static str, fn(&mut Arm) -> Vec<Scalar>);

const FUNCTIONS: [Function; 6] = [
    ("inverse dynamics", "rnea", |arm| {
        let (velocity, acceleration) = (arm.tree.velocity.clone(), arm.tree.acceleration.clone());
        formulations::inverse_dynamics(&mut arm.graph, &arm.tree, &velocity, &acceleration)
    }),
    ("bias", "nle", |arm| formulations::bias(&mut arm.graph, &arm.tree)),
    ("gravity", "gravity", |arm| {
        let still = vec![Scalar::ZERO; arm.tree.freedoms()];
        formulations::inverse_dynamics(&mut arm.graph, &arm.tree, &still, &still)
    }),
    ("mass matrix", "M", |arm| formulations::mass_matrix(&mut arm.graph, &arm.tree)),
    ("composite rigid body", "aba", |arm| formulations::by_composite(&mut arm.graph, &arm.tree, &arm.efforts)),
    ("articulated body", "aba", |arm| formulations::by_articulated(&mut arm.graph, &arm.tree, &arm.efforts)),
];

/// `regrouped`: with base inertial parameters, as models are compiled, or link by link. Every function has a graph of its
/// own: in a common one, equal results are one node, and the formulation that comes second would not be tested.
fn check(name: &str, regrouped: bool) {
    let samples = read(name, "samples");
    let samples = samples["samples"].as_array().unwrap();
    assert_eq!(samples.len(), 20);
    for (what, key, derive) in FUNCTIONS {
        let mut arm = load(name);
        if regrouped {
            arm.tree = regroup(&mut arm.graph, &arm.tree);
        }
        let roots = derive(&mut arm);
        let worst = samples.iter().fold(0.0_f64, |worst, sample| {
            let point = ["q", "v", "a", "tau"].map(|key| flat(&sample[key])).concat();
            let symbols = |id: SymbolId| point[id.0];
            let got = Evaluator::new(&arm.graph, Real { symbols: &symbols }).run(&roots);
            worse(worst, error(&got, &flat(&sample[key])))
        });
        println!("{name:16} {what:21} {worst:.1e}");
        assert!(worst <= TOLERANCE, "{name}, {what}: error {worst:e}");
    }
}

#[test]
fn base_parameters() {
    ARMS.iter().for_each(|name| check(name, true));
}

#[test]
fn link_by_link() {
    ARMS.iter().for_each(|name| check(name, false));
}
