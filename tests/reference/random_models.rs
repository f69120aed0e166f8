//! Twelve random mechanisms, compiled, against a plain implementation that shares nothing with the engine.

use multibody::nalgebra::{DMatrix, DVector, SVector};
use multibody_tests::models::random::*;
use multibody_tests::support::compare::mixed;
use multibody_tests::support::data::read;
use multibody_tests::support::plain::Plain;
use multibody_tests::support::random::Random;

const TOLERANCE: f64 = 1e-11;

fn assert_close(what: &str, got: &[f64], want: &[f64]) {
    let error = mixed(got, want);
    assert!(error <= TOLERANCE, "{what}: error {error:e}\ngot  {got:?}\nwant {want:?}");
}

/// Unit quaternions, and angles away from the poles.
fn positions(plain: &Plain, random: &mut Random) -> Vec<f64> {
    let mut q: Vec<f64> = (0..plain.coordinates()).map(|_| 1.2 * random.unit()).collect();
    for at in plain.quaternions() {
        let norm = q[at..at + 4].iter().map(|x| x * x).sum::<f64>().sqrt();
        q[at..at + 4].iter_mut().for_each(|x| *x /= norm);
    }
    q
}

macro_rules! tests {
    ($convert:ident: $($number:literal $tree:ident)*) => {$(
        #[test]
        fn $tree() {
            let plain = &Plain::all(&read("random"))[$number];
            let model = $tree::Model::<f64>::new(&$tree::Params::default());
            let mut random = Random::new($number);
            let n = plain.freedoms();
            assert_eq!($tree::DOF, n);
            for _ in 0..5 {
                let q = positions(plain, &mut random);
                let mut vector = || -> Vec<f64> { (0..n).map(|_| random.unit()).collect() };
                let (v, a) = (vector(), vector());
                let velocity = |list: &[f64]| $tree::Velocity::from(SVector::<f64, { $tree::DOF }>::from_fn(|k, _| list[k]));
                let state = $tree::State { q: $tree::Position::$convert(SVector::from_fn(|k, _| q[k])), v: velocity(&v) };
                let efforts: SVector<f64, { $tree::DOF }> = model.inverse_dynamics(0.0, &state, &(), &velocity(&a)).into();
                assert_close("inverse dynamics", efforts.as_slice(), &plain.inverse_dynamics(&q, &v, &a));
                let bias = plain.bias(&q, &v);
                assert_close("bias", model.bias(0.0, &state, &()).as_slice(), &bias);
                let mass = plain.mass_matrix(&q);
                assert_close("mass matrix", model.mass_matrix(&state.q).transpose().as_slice(), &mass);
                let matrix = DMatrix::from_row_slice(n, n, &mass);
                let free = matrix.cholesky().unwrap().solve(&-DVector::from_vec(bias));
                let got: SVector<f64, { $tree::DOF }> = model.forward_dynamics(0.0, &state, &()).into();
                assert_close("forward dynamics", got.as_slice(), free.as_slice());
                let energies = [model.kinetic_energy(&state), model.potential_energy(&state.q)];
                assert_close("energies", &energies, &plain.energies(&q, &v));
                let o = model.outputs(0.0, &state, &());
                let got = [o.place, o.velocity, o.omega, o.acceleration, o.reaction.force, o.reaction.moment];
                let names = ["place", "velocity", "omega", "acceleration", "force", "moment"];
                let want = plain.outputs(&q, &v, free.as_slice());
                for ((name, got), want) in names.iter().zip(got).zip(want) {
                    assert_close(name, got.as_slice(), &want);
                }
            }
        }
    )*};
}

tests! { normalized: 0 tree0 1 tree1 2 tree2 3 tree3 4 tree4 5 tree5 6 tree6 7 tree7 }
tests! { from: 8 tree8 9 tree9 10 tree10 11 tree11 }

/// Of every joint kind there is one, or the others prove too little.
#[test]
fn all_joints_occur() {
    let text = read("random").to_string();
    for kind in [
        "Revolute",
        "Prismatic",
        "Screw",
        "Cylindrical",
        "Universal",
        "Planar",
        "Ball",
        "BallAngles",
        "Free",
        "FreeAngles",
        "Fixed",
    ] {
        assert!(text.contains(&format!("\"kind\":\"{kind}\"")), "no {kind}");
    }
}
