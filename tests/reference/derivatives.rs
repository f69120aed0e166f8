//! `emit derivatives`: derivatives of the arms against another library's numbers (`data/robots`), of all else against
//! dual numbers, in every scalar.

use multibody::linear::Square;
use multibody::nalgebra::SMatrix;
use multibody::simba::simd::{SimdValue, WideF64x4};
use multibody::{
    Configuration, Derivatives, Differentiable, JacobianMatrix, Real, StateSpace, System, Tangent, VelocityOf,
};
use multibody_tests::models::linearised;
use multibody_tests::support::arm::*;
use multibody_tests::support::compare::{relative, worse};
use multibody_tests::support::data::{flat, list, read};
use multibody_tests::support::random::Random;
use num_dual::Dual64;

/// Of max |x - ref| over max |ref| per matrix.
const TOLERANCE: f64 = 1e-11;
/// The same in single precision.
const SINGLE: f64 = 2e-3;

/// The matrices that the samples have, with their names there. An effort as input turns up in inverse dynamics with a
/// minus, and in accelerations by the inverse mass matrix.
fn matrices<T: Real, A: Arm<T>>(arm: &A, q: &[T], v: &[T], a: &[T], tau: &[T]) -> Vec<(&'static str, Vec<T>)> {
    let forward = arm.forward_derivatives(q, v, tau);
    let inverse = arm.inverse_derivatives(q, v, a);
    vec![
        ("drnea_dq", inverse.position),
        ("drnea_dv", inverse.velocity),
        ("daba_dq", forward.position),
        ("daba_dv", forward.velocity),
        ("Minv", forward.input),
        ("minus one", inverse.input),
    ]
}

/// The largest errors over all samples, by matrix.
fn errors<T: Real + Into<f64>, A: Arm<T>>() -> Vec<(&'static str, f64)> {
    let arm = A::new();
    let mut worst: Vec<(&str, f64)> = Vec::new();
    let file = read(&format!("robots/{}.samples", A::NAME));
    assert_eq!(list(&file["samples"]).len(), 20);
    for sample in list(&file["samples"]) {
        let get = |key: &str| -> Vec<T> { flat(&sample[key]).into_iter().map(T::lit).collect() };
        let (q, v, a, tau) = (get("q"), get("v"), get("a"), get("tau"));
        for (k, (key, got)) in matrices(&arm, &q, &v, &a, &tau).into_iter().enumerate() {
            let got: Vec<f64> = got.into_iter().map(Into::into).collect();
            let n = q.len();
            let want = match key {
                "minus one" => (0..n * n).map(|at| if at % (n + 1) == 0 { -1.0 } else { 0.0 }).collect(),
                key => flat(&sample[key]),
            };
            let error = relative(&got, &want);
            match worst.get_mut(k) {
                Some(entry) => entry.1 = worse(entry.1, error),
                None => worst.push((key, error)),
            }
        }
    }
    worst
}

fn within(what: &str, errors: &[(&str, f64)], bar: f64) {
    let line: Vec<String> = errors.iter().map(|(key, error)| format!("{key} {error:.1e}")).collect();
    println!("{what}: {}", line.join(", "));
    for (key, error) in errors {
        assert!(*error <= bar, "{what}, {key}: error {error:e}");
    }
}

/// Lanes are double precision, four times: all of them must be what one number gives, to the last rounding.
fn in_lanes<A: Arm<f64>, W: Arm<WideF64x4>>() {
    let (one, four) = (A::new(), W::new());
    let mut random = Random::new(5);
    let n = list(&read(&format!("robots/{}.samples", A::NAME))["samples"][0]["q"]).len();
    let mut draw = || -> [Vec<f64>; 4] { [0; 4].map(|_| (0..n).map(|_| random.unit()).collect()) };
    let (q, v, a, tau) = (draw(), draw(), draw(), draw());
    let wide = |x: &[Vec<f64>; 4]| -> Vec<WideF64x4> {
        (0..n).map(|k| WideF64x4::from([x[0][k], x[1][k], x[2][k], x[3][k]])).collect()
    };
    let together = matrices(&four, &wide(&q), &wide(&v), &wide(&a), &wide(&tau));
    for lane in 0..4 {
        let alone = matrices(&one, &q[lane], &v[lane], &a[lane], &tau[lane]);
        for ((key, got), (_, want)) in together.iter().zip(&alone) {
            let got: Vec<f64> = got.iter().map(|x| x.extract(lane)).collect();
            let error = relative(&got, want);
            assert!(error <= 1e-11, "{key}: error {error:e}");
        }
    }
}

macro_rules! arms {
    ($($test:ident: $arm:ident, $params:ident;)*) => {$(
        mod $test {
            use super::*;

            #[test]
            fn literals() {
                within(concat!(stringify!($test), ", literals"), &errors::<f64, $arm<f64>>(), TOLERANCE);
            }
            #[test]
            fn params() {
                within(concat!(stringify!($test), ", params"), &errors::<f64, $params<f64>>(), TOLERANCE);
            }
        }
    )*};
}

arms! {
    double_pendulum: DoublePendulum, DoublePendulumParams;
    cart5: Cart5, Cart5Params;
    puma560: Puma560, Puma560Params;
    panda: Panda, PandaParams;
}

#[test]
fn single_precision() {
    within("double_pendulum, f32", &errors::<f32, DoublePendulum<f32>>(), SINGLE);
    within("cart5, f32", &errors::<f32, Cart5<f32>>(), SINGLE);
}

#[test]
fn four_lanes() {
    in_lanes::<DoublePendulum<f64>, DoublePendulum<WideF64x4>>();
    in_lanes::<Cart5<f64>, Cart5<WideF64x4>>();
}

/// A model's inverse dynamics.
trait Inverse: System {
    fn efforts(
        &self,
        t: Self::Scalar,
        state: &Self::State,
        input: &Self::Input,
        accel: &VelocityOf<Self>,
    ) -> VelocityOf<Self>;

    /// Derivatives by position, velocity, own states and inputs, column by column.
    fn slopes(
        &self,
        t: Self::Scalar,
        state: &Self::State,
        input: &Self::Input,
        accel: &VelocityOf<Self>,
    ) -> [Vec<Self::Scalar>; 4];
}

fn columns<T: Real, const R: usize, const N: usize, const X: usize, const U: usize>(
    of: &Derivatives<T, R, N, X, U>,
) -> [Vec<T>; 4] {
    fn list<T: Real, const R: usize, const C: usize>(m: &SMatrix<T, R, C>) -> Vec<T> {
        m.as_slice().to_vec()
    }
    [list(&of.position), list(&of.velocity), list(&of.states), list(&of.input)]
}

macro_rules! inverse {
    ($($module:ident)*) => {$(
        impl<T: Real> Inverse for linearised::$module::Model<T> {
            fn efforts(
                &self,
                t: T,
                state: &Self::State,
                input: &Self::Input,
                accel: &VelocityOf<Self>,
            ) -> VelocityOf<Self> {
                self.inverse_dynamics(t, state, input, accel)
            }
            fn slopes(
                &self,
                t: T,
                state: &Self::State,
                input: &Self::Input,
                accel: &VelocityOf<Self>,
            ) -> [Vec<T>; 4] {
                columns(&self.inverse_derivatives(t, state, input, accel))
            }
        }
    )*};
}

inverse! { craft rack reduced iterated held shaken tied }

/// A tangent with these components.
fn filled<T: Real, V: Tangent<T>>(values: &[f64]) -> V {
    let mut values = values.iter();
    V::zero().map(&mut |_| T::lit(*values.next().expect("a value for each component")))
}

fn components<T: Real, V: Tangent<T>>(v: &V) -> Vec<T> {
    v.fold(Vec::new(), &mut |mut list: Vec<T>, x: T| {
        list.push(x);
        list
    })
}

/// With a derivative of one along a component.
fn seeded<V: Tangent<Dual64>>(v: &V, at: Option<usize>) -> V {
    let mut place = 0;
    v.map(&mut |x| {
        let eps = if at == Some(place) { 1.0 } else { 0.0 };
        place += 1;
        Dual64::new(x.re, x.eps + eps)
    })
}

/// Where derivatives are taken.
struct Point {
    t: f64,
    /// Displacement from the start of the model.
    q: Vec<f64>,
    v: Vec<f64>,
    x: Vec<f64>,
    u: Vec<f64>,
    a: Vec<f64>,
}

impl Point {
    fn state<S: System>(&self, start: &S::State) -> S::State {
        let (q, _, _) = start.split();
        start.join(q.displace(&filled(&self.q)), filled(&self.v), filled(&self.x))
    }
}

/// Which of the four kinds of variables moves, and which of them.
type Move = Option<(usize, usize)>;

fn moved<S: System<Scalar = Dual64>>(state: &S::State, input: &S::Input, along: Move) -> (S::State, S::Input)
where
    S::Input: Tangent<Dual64>,
{
    let along = |kind: usize| along.filter(|along| along.0 == kind).map(|along| along.1);
    let (q, v, x) = state.split();
    let q = q.displace(&seeded(&Tangent::zero(), along(0)));
    (state.join(q, seeded(&v, along(1)), seeded(&x, along(2))), seeded(input, along(3)))
}

/// Largest errors of forward and inverse derivatives at one point, over the largest entry of each matrix.
fn errors_at<M, D>(model: &M, dual: &D, start: (&M::State, &D::State), point: &Point) -> [f64; 2]
where
    M: Differentiable<Scalar = f64> + Inverse,
    D: Inverse<Scalar = Dual64>,
    M::Input: Tangent<f64>,
    D::Input: Tangent<Dual64>,
{
    let (state, twin) = (point.state::<M>(start.0), point.state::<D>(start.1));
    let (input, twin_input): (M::Input, D::Input) = (filled(&point.u), filled(&point.u));
    let (t, twin_t) = (point.t, Dual64::lit(point.t));
    // A guess is to be a solution, derivatives included: a few rounds of Newton's method.
    let close = |state: D::State, input: &D::Input| (0..4).fold(state, |state, _| dual.accepted(twin_t, &state, input));
    let state = (0..4).fold(state, |state, _| model.accepted(t, &state, &input));
    let jacobian = model.jacobian(t, &state, &input);
    let (n, x) = (point.v.len(), point.x.len());
    assert_eq!(<M::Matrix as Square<f64>>::SIZE, n + x);
    let column = |entry: &dyn Fn(usize) -> f64| -> Vec<f64> { (0..n + x).map(entry).collect() };
    let (accel, twin_accel): (VelocityOf<M>, VelocityOf<D>) = (filled(&point.a), filled(&point.a));
    let slopes = model.slopes(t, &state, &input, &accel);
    let mut worst = [0.0; 2];
    for (kind, count) in [n, n, x, point.u.len()].into_iter().enumerate() {
        let (mut got, mut want, mut want_inverse) = (Vec::new(), Vec::new(), Vec::new());
        for at in 0..count {
            got.extend(match kind {
                0 => column(&|row| M::Matrix::by_position(&jacobian, row, at)),
                1 => column(&|row| M::Matrix::by_rates(&jacobian, row, at)),
                2 => column(&|row| M::Matrix::by_rates(&jacobian, row, n + at)),
                _ => {
                    let unit: Vec<f64> = (0..count).map(|k| if k == at { 1.0 } else { 0.0 }).collect();
                    let (v, x) = model.input_derivative(t, &state, &input, &filled(&unit));
                    [components(&v), components(&x)].concat()
                }
            });
            let (moved, moved_input) = moved::<D>(&twin, &twin_input, Some((kind, at)));
            let moved = close(moved, &moved_input);
            let (v, x) = dual.derivative(twin_t, &moved, &moved_input);
            want.extend([components(&v), components(&x)].concat().iter().map(|x: &Dual64| x.eps));
            let efforts = dual.efforts(twin_t, &moved, &moved_input, &twin_accel);
            want_inverse.extend(components(&efforts).iter().map(|x: &Dual64| x.eps));
        }
        assert!(kind > 1 || want.iter().any(|x| *x != 0.0));
        worst[0] = worse(worst[0], relative(&got, &want));
        worst[1] = worse(worst[1], relative(&slopes[kind], &want_inverse));
    }
    // Columns beyond the degrees of freedom.
    assert!(
        (n..n + x)
            .all(|at| column(&|row| M::Matrix::by_position(&jacobian, row, at)).iter().all(|entry| *entry == 0.0))
    );
    worst
}

macro_rules! models {
    ($($module:ident: $q:expr, $spread:expr;)*) => {$(
        #[test]
        fn $module() {
            use linearised::$module::{Input, Model, State};
            let (model, dual) = (Model::<f64>::default(), Model::<Dual64>::default());
            let mut random = Random::new(7);
            let (start, twin) = (State::default(), State::default());
            let (q, v, x) = start.split();
            let _ = q;
            let count = |list: Vec<f64>| list.len();
            let (n, x) = (count(components(&v)), count(components(&x)));
            let u = count(components(&<Input as Tangent<f64>>::zero()));
            let mut worst = [0.0; 2];
            let rough: &[f64] = &$q;
            for _ in 0..12 {
                let mut draw = |count: usize| -> Vec<f64> { (0..count).map(|_| random.unit()).collect() };
                let mut q = draw(n);
                q.iter_mut().enumerate().for_each(|(k, x)| *x = rough.get(k).unwrap_or(&0.0) + $spread * *x);
                let point = Point { t: 0.3, q, v: draw(n), x: draw(x), u: draw(u), a: draw(n) };
                let errors = errors_at(&model, &dual, (&start, &twin), &point);
                worst = [worse(worst[0], errors[0]), worse(worst[1], errors[1])];
            }
            println!("{}: forward {:.1e}, inverse {:.1e}", stringify!($module), worst[0], worst[1]);
            assert!(worst.iter().all(|error| *error <= TOLERANCE), "{worst:?}");
        }
    )*};
}

models! {
    craft: [], 1.0;
    rack: [], 1.0;
    reduced: [0.9], 0.6;
    iterated: [0.9], 0.3;
    held: [0.9, -0.4, 1.2], 0.4;
    shaken: [0.5], 0.8;
    tied: [0.1, 0.2, -0.1], 0.5;
}
