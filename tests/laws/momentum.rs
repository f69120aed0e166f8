//! Momenta: their rates against derivatives of M v along true motions, and the energy that Hamilton's equations keep.

use multibody::nalgebra::SVector;
use multibody::{Canonical, Separable, System};
use multibody_tests::models::impulses::*;
use multibody_tests::models::{arms, rows, small};
use multibody_tests::support::compare::{mixed, worse};
use multibody_tests::support::random::Random;
use num_dual::Dual64;

/// p = M v; v = M^-1 p; p' is the derivative by time of M(q) v along the motion that forward dynamics gives, by dual numbers.
macro_rules! check {
    ($model:ident, $position:expr, $t:expr, $input:expr, $bound:expr) => {{
        const N: usize = $model::DOF;
        let model = $model::Model::new(&$model::Params::default());
        let dual = $model::Model::<Dual64>::new(&$model::Params::default());
        let mut random = Random::new(4);
        let (mut most, mut turned) = ([0.0; 3], 0.0_f64);
        for _ in 0..20 {
            let q: SVector<f64, N> = $position(&mut random);
            let v = SVector::<f64, N>::from(random.units());
            let state = $model::State { q: q.into(), v: v.into() };
            let input = $input(&mut random);
            let momentum: SVector<f64, N> = model.momentum(&state).into();
            let want = model.mass_matrix(&state.q) * v;
            most[0] = worse(most[0], mixed(momentum.as_slice(), want.as_slice()));
            let back: SVector<f64, N> = model.velocity(&state.q, &momentum.into()).into();
            most[1] = worse(most[1], mixed(back.as_slice(), v.as_slice()));
            let a: SVector<f64, N> = model.forward_dynamics($t, &state, &input).into();
            let (q, v) = (q.zip_map(&v, Dual64::new), v.zip_map(&a, Dual64::new));
            let matrix = dual.mass_matrix(&q.into());
            let rate: SVector<f64, N> = model.momentum_rate($t, &state, &input).into();
            let want = SVector::<f64, N>::from_fn(|i, _| (0..N).map(|j| (matrix[(i, j)] * v[j]).eps).sum());
            most[2] = worse(most[2], mixed(rate.as_slice(), want.as_slice()));
            let moving: SVector<Dual64, N> = dual.momentum(&$model::State { q: q.into(), v: v.into() }).into();
            most[2] = worse(most[2], mixed(rate.as_slice(), moving.map(|p| p.eps).as_slice()));
            // What the change of the mass matrix adds.
            let still = SVector::<f64, N>::from_fn(|i, _| (0..N).map(|j| matrix[(i, j)].re * a[j]).sum());
            turned = turned.max((want - still).amax());
            let by_trait = [
                Canonical::momentum(&model, &state),
                Canonical::velocity(&model, &state.q, &momentum.into()),
                Canonical::momentum_rate(&model, $t, &state, &input),
            ];
            assert_eq!(by_trait, [momentum.into(), back.into(), rate.into()]);
        }
        println!("{}: momentum {:e}, velocity {:e}, rate {:e}", stringify!($model), most[0], most[1], most[2]);
        assert!(most.iter().all(|most| *most <= $bound), "{}: {most:?}", stringify!($model));
        assert!(turned > 1e-3, "{}: the mass matrix is constant", stringify!($model));
    }};
}

#[test]
fn rates_follow_the_motion() {
    let any = |random: &mut Random| SVector::from(random.units());
    let push = |random: &mut Random| tree::Input { push: random.units() };
    check!(tree, any, 0.7, push, 1e-12);
    let any = |random: &mut Random| SVector::from(random.units());
    check!(rods, any, 0.0, |_: &mut Random| (), 1e-13);
    let any = |random: &mut Random| SVector::from(random.units());
    check!(crane, any, 0.0, |_: &mut Random| (), 1e-13);
}

#[test]
fn rates_follow_the_motion_of_closed_loops() {
    check!(four_bar, |r: &mut Random| SVector::from([1.2 + 0.5 * r.unit()]), 0.0, |_: &mut Random| (), 1e-12);
    let position = |r: &mut Random| SVector::from([r.unit(), 1.2 + 0.5 * r.unit(), r.unit()]);
    check!(carried, position, 0.0, |_: &mut Random| (), 1e-12);
    let any = |random: &mut Random| SVector::from(random.units());
    check!(geared, any, 0.0, |_: &mut Random| (), 1e-12);
}

/// q' = M^-1 p, p' = momentum_rate, by a Runge-Kutta method of order 4: the energy stays, and the motion is that of
/// forward dynamics.
macro_rules! check_motion {
    ($model:ident, $start:expr, $steps:expr) => {{
        const N: usize = $model::DOF;
        let model = $model::Model::<f64>::new(&$model::Params::default());
        let (mut q, v): (SVector<f64, N>, SVector<f64, N>) = $start;
        let begin = $model::State { q: q.into(), v: v.into() };
        let energy = |state: &$model::State| model.kinetic_energy(state) + model.potential_energy(&state.q);
        let rates = |q: &SVector<f64, N>, p: &SVector<f64, N>| -> [SVector<f64, N>; 2] {
            let q = (*q).into();
            let v = model.velocity(&q, &(*p).into());
            let state = $model::State { q, v };
            [v.into(), model.momentum_rate(0.0, &state, &()).into()]
        };
        let mut p: SVector<f64, N> = model.momentum(&begin).into();
        let h = 1e-3;
        let (first, mut most) = (energy(&begin), 0.0);
        for _ in 0..$steps {
            let [a, b] = rates(&q, &p);
            let [c, d] = rates(&(q + a * (0.5 * h)), &(p + b * (0.5 * h)));
            let [e, f] = rates(&(q + c * (0.5 * h)), &(p + d * (0.5 * h)));
            let [x, y] = rates(&(q + e * h), &(p + f * h));
            q += (a + c * 2.0 + e * 2.0 + x) * (h / 6.0);
            p += (b + d * 2.0 + f * 2.0 + y) * (h / 6.0);
            let state = $model::State { q: q.into(), v: model.velocity(&q.into(), &p.into()) };
            most = worse(most, (energy(&state) - first).abs());
        }
        println!("{}: energy {first} J, drift {most:e} J", stringify!($model));
        assert!(most <= 1e-9 * (1.0 + first.abs()), "{}: {most:e}", stringify!($model));
        let end = multibody::DormandPrince::integrate(&model, 0.0, &begin, &(), h, $steps, |_, _| ()).unwrap();
        let end: SVector<f64, N> = end.q.into();
        let error = mixed(q.as_slice(), end.as_slice());
        println!("{}: apart from forward dynamics by {error:e}", stringify!($model));
        assert!(error <= 1e-9, "{}: {error:e}", stringify!($model));
        assert!((end - SVector::<f64, N>::from(begin.q)).amax() > 0.1);
    }};
}

#[test]
fn hamiltons_equations_keep_the_energy() {
    check_motion!(rods, (SVector::from([1.0, -0.5]), SVector::from([0.3, 0.8])), 2000);
    check_motion!(carried, (SVector::from([0.1, 1.2, 0.4]), SVector::from([0.2, -0.5, 0.3])), 1000);
}

/// Whether a type is `Separable`: the method of the type itself comes before the trait's.
struct Probe<S>(core::marker::PhantomData<S>);

trait Otherwise {
    fn is_separable(&self) -> bool {
        false
    }
}

impl<S> Otherwise for Probe<S> {}

impl<S: Separable> Probe<S> {
    fn is_separable(&self) -> bool {
        true
    }
}

macro_rules! is_separable {
    ($model:ty) => {
        Probe::<$model>(core::marker::PhantomData).is_separable()
    };
}

#[test]
fn separable_are_those_whose_accelerations_read_no_velocity() {
    assert!(is_separable!(small::pendulum::Model));
    assert!(is_separable!(small::oscillator::Model<f32>));
    assert!(is_separable!(ball::Model));
    assert!(is_separable!(rows::four_bars_2::Model));
    assert!(!is_separable!(small::two_rods::Model));
    assert!(!is_separable!(arms::double_pendulum::Model));
    assert!(!is_separable!(small::cart_pole::Model));
    assert!(!is_separable!(damped::Model));
    assert!(!is_separable!(lagging::Model));
    assert!(!is_separable!(stretched::Model));
    fn takes<S: Separable + System>(_: &S) {}
    takes(&small::pendulum::Model::<f64>::default());
}
