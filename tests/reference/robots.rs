//! Emitted code of the arms against another library's numbers (`data/robots`), in every scalar.

use multibody::Real;
use multibody::simba::simd::{SimdValue, WideF64x4};
use multibody_tests::support::arm::*;
use multibody_tests::support::compare::{relative, worse};
use multibody_tests::support::data::{flat, list, number, read};
use num_dual::Dual64;
use serde_json::Value;

/// Of max |x - ref| over max |ref| per vector.
const TOLERANCE: f64 = 1e-12;
/// The same in single precision: puma560's mass matrix has a condition number of 7e4.
const SINGLE: f32 = 2e-3;
/// Of derivatives by dual numbers.
const DERIVATIVE: f64 = 1e-9;

/// The random states of one arm.
fn samples(name: &str) -> Vec<Value> {
    let file = read(&format!("robots/{name}.samples"));
    let samples = list(&file["samples"]).to_vec();
    assert_eq!(samples.len(), 20);
    samples
}

/// A state, and what acts in it.
struct Point<T> {
    q: Vec<T>,
    v: Vec<T>,
    a: Vec<T>,
    tau: Vec<T>,
}

impl<T: Real> Point<T> {
    fn of(sample: &Value) -> Self {
        let get = |key: &str| flat(&sample[key]).into_iter().map(T::lit).collect();
        Self { q: get("q"), v: get("v"), a: get("a"), tau: get("tau") }
    }
}

/// Everything that an arm's functions say, with the names that the samples have for it.
fn everything<T: Real, A: Arm<T>>(arm: &A, p: &Point<T>) -> Vec<(&'static str, Vec<T>)> {
    let zero = vec![T::lit(0.0); p.q.len()];
    let tool = arm.tool(&p.q, &p.v);
    vec![
        ("rnea", arm.inverse_dynamics(&p.q, &p.v, &p.a)),
        ("nle", arm.bias(&p.q, &p.v)),
        ("gravity", arm.bias(&p.q, &zero)),
        ("M", arm.mass_matrix(&p.q)),
        ("aba", arm.forward_dynamics(&p.q, &p.v, &p.tau)),
        ("kinetic", vec![arm.kinetic_energy(&p.q, &p.v)]),
        ("potential", vec![arm.potential_energy(&p.q)]),
        ("ee_p", tool.position),
        ("ee_R", tool.orientation),
        ("ee_R", tool.rotation),
        ("ee_J_local_world_aligned", tool.jacobian),
        ("ee_v_lwa", tool.twist),
    ]
}

fn in_double_precision<A: Arm<f64>>(what: &str) {
    let arm = A::new();
    let mut worst: Vec<(&str, f64)> = Vec::new();
    for sample in samples(A::NAME) {
        for (k, (key, got)) in everything(&arm, &Point::of(&sample)).into_iter().enumerate() {
            let error = relative(&got, &flat(&sample[key]));
            match worst.get_mut(k) {
                Some(entry) => entry.1 = worse(entry.1, error),
                None => worst.push((key, error)),
            }
        }
    }
    let line: Vec<String> = worst.iter().map(|(key, error)| format!("{key} {error:.1e}")).collect();
    println!("{what}: {}", line.join(", "));
    for (key, error) in worst {
        assert!(error <= TOLERANCE, "{what}, {key}: error {error:e}");
    }
}

fn in_single_precision<A: Arm<f32>>() {
    let arm = A::new();
    for sample in samples(A::NAME) {
        for (key, got) in everything(&arm, &Point::of(&sample)) {
            let got: Vec<f64> = got.into_iter().map(f64::from).collect();
            let error = relative(&got, &flat(&sample[key]));
            assert!(error <= f64::from(SINGLE), "{}, {key}: error {error:e}", A::NAME);
        }
    }
}

fn lanes(points: [&[f64]; 4]) -> Vec<WideF64x4> {
    (0..points[0].len()).map(|k| WideF64x4::from(points.map(|p| p[k]))).collect()
}

/// Four samples at once.
fn in_lanes<A: Arm<f64>, W: Arm<WideF64x4>>() {
    let (one, four) = (A::new(), W::new());
    for quad in samples(A::NAME).chunks_exact(4) {
        let points: Vec<Point<f64>> = quad.iter().map(Point::of).collect();
        let of = |get: fn(&Point<f64>) -> &[f64]| lanes([0, 1, 2, 3].map(|k| get(&points[k])));
        let together = Point { q: of(|p| &p.q), v: of(|p| &p.v), a: of(|p| &p.a), tau: of(|p| &p.tau) };
        let together = everything(&four, &together);
        for (lane, point) in points.iter().enumerate() {
            for ((key, alone), (_, together)) in everything(&one, point).into_iter().zip(&together) {
                let together: Vec<f64> = together.iter().map(|x| x.extract(lane)).collect();
                let error = relative(&together, &alone);
                assert!(error <= TOLERANCE, "{}, {key}, lane {lane}: error {error:e}", A::NAME);
            }
        }
    }
}

/// Positions that move with the velocity `direction`.
fn moving(q: &[f64], direction: &[f64]) -> Vec<Dual64> {
    q.iter().zip(direction).map(|(q, d)| Dual64::new(*q, *d)).collect()
}

fn parts(list: &[Dual64]) -> (Vec<f64>, Vec<f64>) {
    list.iter().map(|x| (x.re, x.eps)).unzip()
}

/// Angular velocity of a turning quaternion w, i, j, k, in world axes: twice the vector part of q' q*.
fn angular(q: &[f64], rate: &[f64]) -> Vec<f64> {
    let ([w, x, y, z], [a, b, c, d]) = (q, rate) else { panic!("not a quaternion") };
    let v = [w * b - a * x - (c * z - d * y), w * c - a * y - (d * x - b * z), w * d - a * z - (b * y - c * x)];
    v.map(|component| 2.0 * component).to_vec()
}

fn in_dual_numbers<A: Arm<f64>, D: Arm<Dual64>>() {
    let (arm, dual) = (A::new(), D::new());
    for sample in samples(A::NAME) {
        let p = Point::<f64>::of(&sample);
        let n = p.q.len();
        let fixed = |list: &[f64]| -> Vec<Dual64> { list.iter().map(|x| Dual64::from(*x)).collect() };
        let (v, a) = (fixed(&p.v), fixed(&p.a));
        let (mut by_position, mut by_velocity) = (vec![0.0; n * n], vec![0.0; n * n]);
        let mut jacobian = vec![0.0; 6 * n];
        for k in 0..n {
            let unit: Vec<f64> = (0..n).map(|i| f64::from(u8::from(i == k))).collect();
            let q = moving(&p.q, &unit);
            let (value, column) = parts(&dual.inverse_dynamics(&q, &v, &a));
            assert!(relative(&value, &flat(&sample["rnea"])) <= TOLERANCE);
            (0..n).for_each(|i| by_position[i * n + k] = column[i]);
            let (_, column) = parts(&dual.inverse_dynamics(&fixed(&p.q), &moving(&p.v, &unit), &a));
            (0..n).for_each(|i| by_velocity[i * n + k] = column[i]);
            let tool = dual.tool(&q, &v);
            let (quaternion, rate) = parts(&tool.quaternion);
            let rows = [parts(&tool.position).1, angular(&quaternion, &rate)].concat();
            (0..6).for_each(|i| jacobian[i * n + k] = rows[i]);
        }
        // Rates: how everything that depends on positions changes along the motion.
        let tool = dual.tool(&moving(&p.q, &p.v), &v);
        let (quaternion, rate) = parts(&tool.quaternion);
        let twist = [parts(&tool.position).1, angular(&quaternion, &rate)].concat();
        let power = number_of(&dual.potential_energy(&moving(&p.q, &p.v)));
        let gravity = arm.bias(&p.q, &vec![0.0; n]);
        let expected: f64 = gravity.iter().zip(&p.v).map(|(g, v)| g * v).sum();
        for (what, got, want) in [
            ("d tau / d q", by_position, flat(&sample["drnea_dq"])),
            ("d tau / d v", by_velocity, flat(&sample["drnea_dv"])),
            ("Jacobian", jacobian, arm.tool(&p.q, &p.v).jacobian),
            ("twist", twist, flat(&sample["ee_v_lwa"])),
            ("power of gravity", vec![power], vec![expected]),
        ] {
            let error = relative(&got, &want);
            assert!(error <= DERIVATIVE, "{}, {what}: error {error:e}", A::NAME);
        }
    }
}

fn number_of(x: &Dual64) -> f64 {
    x.eps
}

/// The default of every param is the number of the model, so both kinds of models are one arm.
#[test]
fn samples_are_of_these_arms() {
    for name in ["double_pendulum", "cart5", "puma560", "panda"] {
        let model = read(&format!("robots/{name}.model"));
        let dof = list(&model["joints"]).len();
        assert_eq!(number(&model["nv"]), dof as f64);
        assert!(samples(name).iter().all(|sample| flat(&sample["q"]).len() == dof));
    }
}

macro_rules! tests {
    ($($test:ident: $arm:ident, $params:ident;)*) => {$(
        mod $test {
            use super::*;

            #[test]
            fn literals() {
                in_double_precision::<$arm<f64>>(concat!(stringify!($test), ", literals"));
            }
            #[test]
            fn params() {
                in_double_precision::<$params<f64>>(concat!(stringify!($test), ", params"));
            }
            #[test]
            fn single_precision() {
                in_single_precision::<$arm<f32>>();
                in_single_precision::<$params<f32>>();
            }
            #[test]
            fn four_lanes() {
                in_lanes::<$arm<f64>, $arm<WideF64x4>>();
            }
            #[test]
            fn dual_numbers() {
                in_dual_numbers::<$arm<f64>, $arm<Dual64>>();
            }
        }
    )*};
}

tests! {
    double_pendulum: DoublePendulum, DoublePendulumParams;
    cart5: Cart5, Cart5Params;
    puma560: Puma560, Puma560Params;
    panda: Panda, PandaParams;
}
