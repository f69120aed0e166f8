//! Bodies whose mass follows states: at every moment they are bodies with parameters in the place of the states; and motions
//! whose course is known.

use multibody::impact::impulse;
use multibody::nalgebra::SVector;
use multibody::simba::simd::{SimdValue, WideF64x4};
use multibody::{DormandPrince, Integrator, Radau, Real, verify_at};
use multibody_tests::models::tanks::*;
use multibody_tests::support::compare::{mixed, worse};
use multibody_tests::support::random::Random;
use num_dual::Dual64;

/// Between two programs for the same numbers.
const ROUNDING: f64 = 1e-13;

/// A point at which both are looked at.
struct Point {
    q: [f64; 3],
    v: [f64; 3],
    a: [f64; 3],
    fuel: f64,
    input: [f64; 2],
}

impl Point {
    fn new(random: &mut Random) -> Point {
        let [q, v, a] = [(); 3].map(|()| random.units());
        Point { q: q.map(|x: f64| 3.0 * x), v, a, fuel: 1.1 + random.unit(), input: random.units() }
    }

    fn state<T: Real>(&self) -> tank::State<T> {
        let of = |list: [f64; 3]| SVector::<T, 3>::from(list.map(T::lit));
        tank::State { q: of(self.q).into(), v: of(self.v).into(), x: tank::States { fuel: T::lit(self.fuel) } }
    }

    fn input<T: Real>(&self) -> tank::Input<T> {
        tank::Input { push: T::lit(self.input[0]), burn: T::lit(self.input[1]) }
    }

    /// All of the one with the state.
    fn changing<T: Real>(&self) -> Vec<T> {
        let (model, state, input) = (tank::Model::<T>::default(), self.state(), self.input());
        let accel = SVector::<T, 3>::from(self.a.map(T::lit)).into();
        let zero = T::lit(0.0);
        let mut list: Vec<T> =
            SVector::<T, 3>::from(model.forward_dynamics(zero, &state, &input).v).iter().copied().collect();
        list.extend(SVector::<T, 3>::from(model.inverse_dynamics(zero, &state, &input, &accel)).iter());
        list.extend(model.mass_matrix(&state).iter());
        list.extend(SVector::<T, 3>::from(model.bias(zero, &state, &input)).iter());
        list.extend([model.kinetic_energy(&state), model.potential_energy(&state)]);
        list.extend(model.centroidal_momentum_matrix(&state).iter());
        list
    }

    /// The same behind `at`, less what isn't asked for there.
    fn behind(&self) -> Vec<f64> {
        let (model, state, input) = (tank::Model::<f64>::default(), self.state(), self.input());
        let at = model.at(&state.q, &state.x);
        let accel = SVector::<f64, 3>::from(self.a).into();
        let mut list: Vec<f64> =
            SVector::<f64, 3>::from(at.forward_dynamics(&state.v, &input).v).iter().copied().collect();
        list.extend(SVector::<f64, 3>::from(at.inverse_dynamics(&state.v, &input, &accel)).iter());
        list.extend(at.mass_matrix().iter());
        list.extend(SVector::<f64, 3>::from(at.bias(&state.v, &input)).iter());
        list.push(at.kinetic_energy(&state.v));
        list
    }

    /// All of the one with the parameter.
    fn frozen(&self) -> Vec<f64> {
        let model = frozen::Model::new(&frozen::Params { content: self.fuel, ..Default::default() });
        let state = frozen::State { q: SVector::from(self.q).into(), v: SVector::from(self.v).into() };
        let input = frozen::Input { push: self.input[0], burn: self.input[1] };
        let accel = SVector::<f64, 3>::from(self.a).into();
        let mut list: Vec<f64> =
            SVector::<f64, 3>::from(model.forward_dynamics(0.0, &state, &input)).iter().copied().collect();
        list.extend(SVector::<f64, 3>::from(model.inverse_dynamics(0.0, &state, &input, &accel)).iter());
        list.extend(model.mass_matrix(&state.q).iter());
        list.extend(SVector::<f64, 3>::from(model.bias(0.0, &state, &input)).iter());
        list.extend([model.kinetic_energy(&state), model.potential_energy(&state.q)]);
        list.extend(model.centroidal_momentum_matrix(&state.q).iter());
        list
    }
}

#[test]
fn a_state_is_a_parameter_of_the_moment() {
    let mut random = Random::new(16);
    let (mut double, mut single, mut behind) = (0.0, 0.0, 0.0);
    for _ in 0..30 {
        let point = Point::new(&mut random);
        let want = point.frozen();
        let found = point.changing::<f64>();
        double = worse(double, mixed(&found, &want));
        let singles: Vec<f64> = point.changing::<f32>().into_iter().map(f64::from).collect();
        single = worse(single, mixed(&singles, &want));
        let shared = point.behind();
        behind = worse(behind, mixed(&shared, &want[..shared.len()]));
        let lanes = point.changing::<WideF64x4>();
        for (lane, &x) in lanes.iter().zip(&found) {
            assert!((lane.extract(2) - x).abs() <= ROUNDING * (1.0 + x.abs()));
        }
    }
    println!("f64 {double:e}, f32 {single:e}, at {behind:e}");
    assert!(double <= ROUNDING && behind <= ROUNDING && single <= 1e-4);
}

/// Columns of the state in all derivatives, by dual numbers, and the same column of the linearised equations.
#[test]
fn derivatives_by_the_state() {
    let (mut random, mut most) = (Random::new(17), 0.0);
    let (model, dual) = (tank::Model::<f64>::default(), tank::Model::<Dual64>::default());
    for _ in 0..20 {
        let point = Point::new(&mut random);
        let (state, input) = (point.state::<f64>(), point.input());
        let mut moving = point.state::<Dual64>();
        moving.x.fuel = Dual64::new(point.fuel, 1.0);
        let found = model.forward_derivatives(0.0, &state, &input);
        let slope = dual.forward_dynamics(Dual64::from(0.0), &moving, &point.input());
        let mut want: Vec<f64> = SVector::<Dual64, 3>::from(slope.v).iter().map(|x| x.eps).collect();
        want.push(slope.x.fuel.eps);
        most = worse(most, mixed(found.states.as_slice(), &want));
        assert!(want.iter().all(|x| x.abs() > 1e-6), "nothing depends on the mass");
        let whole = model.linearize(0.0, &state, &input);
        let column: Vec<f64> = (3..7).map(|row| whole.a[(row, 6)]).collect();
        most = worse(most, mixed(&column, &want));
        let accel = SVector::<f64, 3>::from(point.a);
        let efforts = model.inverse_derivatives(0.0, &state, &input, &accel.into());
        let slope = dual.inverse_dynamics(Dual64::from(0.0), &moving, &point.input(), &accel.map(Dual64::from).into());
        let want: Vec<f64> = SVector::<Dual64, 3>::from(slope).iter().map(|x| x.eps).collect();
        most = worse(most, mixed(efforts.states.as_slice(), &want));
    }
    println!("{most:e}");
    assert!(most <= 1e-11, "{most:e}");
}

/// A blow at the moment: M d = impulse with the masses that are there.
#[test]
fn a_blow_finds_what_is_left() {
    let (mut random, mut most) = (Random::new(19), 0.0);
    let model = tank::Model::<f64>::default();
    for _ in 0..20 {
        let point = Point::new(&mut random);
        let state = point.state::<f64>();
        let blow = SVector::<f64, 3>::from(point.a);
        let after = impulse(&model, 0.0, &state, &blow.into()).unwrap().state;
        let jump = SVector::<f64, 3>::from(after.v) - SVector::<f64, 3>::from(state.v);
        let found = model.mass_matrix(&state) * jump;
        most = worse(most, mixed(found.as_slice(), blow.as_slice()));
        assert_eq!(after.x.fuel, state.x.fuel);
    }
    assert!(most <= 1e-12, "{most:e}");
}

#[test]
fn functions_agree() {
    let mut random = Random::new(18);
    for _ in 0..20 {
        let point = Point::new(&mut random);
        assert!(verify_at(&tank::Model::default(), 0.0, &point.state(), &point.input()).worst() < ROUNDING);
    }
}

/// Legs that fill up by packs of four, against parameters and no packs.
#[test]
fn limbs_in_packs() {
    const N: usize = walker::DOF;
    let (mut random, mut most) = (Random::new(19), 0.0);
    let model = walker::Model::<f64>::default();
    for _ in 0..20 {
        let (mut state, mut params) = (walker::State::<f64>::default(), stiff_walker::Params::<f64>::default());
        let mut stiff = stiff_walker::State::<f64>::default();
        let (v, a) = (SVector::<f64, N>::from(random.units()), SVector::<f64, N>::from(random.units()));
        (state.v, stiff.v) = (v.into(), v.into());
        for leg in 0..4 {
            let [first, second, knee] = random.units();
            let q = &mut state.q.legs[leg];
            (q.swing.first, q.swing.second, q.knee) = (first, second, knee);
            let q = &mut stiff.q.legs[leg];
            (q.swing.first, q.swing.second, q.knee) = (first, second, knee);
            let water = 0.5 + 0.4 * random.unit();
            state.x.legs[leg].water = water;
            params.legs[leg].water = water;
        }
        let other = stiff_walker::Model::new(&params);
        let found = [
            SVector::<f64, N>::from(model.forward_dynamics(0.0, &state, &()).v).as_slice(),
            SVector::<f64, N>::from(model.inverse_dynamics(0.0, &state, &(), &a.into())).as_slice(),
            SVector::<f64, N>::from(model.bias(0.0, &state, &())).as_slice(),
            model.mass_matrix(&state).as_slice(),
        ]
        .concat();
        let want = [
            SVector::<f64, N>::from(other.forward_dynamics(0.0, &stiff, &())).as_slice(),
            SVector::<f64, N>::from(other.inverse_dynamics(0.0, &stiff, &(), &a.into())).as_slice(),
            SVector::<f64, N>::from(other.bias(0.0, &stiff, &())).as_slice(),
            other.mass_matrix(&stiff.q).as_slice(),
        ]
        .concat();
        most = worse(most, mixed(&found, &want));
    }
    println!("{most:e}");
    assert!(most <= 1e-12, "{most:e}");
}

/// Tsiolkovsky's equation, by an explicit and by an implicit method.
#[test]
fn a_rocket() {
    let model = rocket::Model::<f64>::default();
    let (start, input) = (rocket::State::default(), rocket::Input { flow: 10.0 });
    let want = 2500.0 * (1000.0_f64 / 300.0).ln();
    let explicit =
        Integrator::fixed(DormandPrince, 0.05).integrate(&model, 0.0, 70.0, &start, &input, |_, _| ()).unwrap().0;
    let implicit =
        Integrator::adaptive(Radau, 1e-13, 1e-13).integrate(&model, 0.0, 70.0, &start, &input, |_, _| ()).unwrap().0;
    let error = |end: rocket::State<f64>| (end.v.rail / want - 1.0).abs();
    println!("{:e}, {:e}", error(explicit), error(implicit));
    assert!(error(explicit) < 1e-12 && error(implicit) < 1e-11);
    assert!((explicit.x.burnt - 700.0).abs() < 1e-9);
}

/// Euler's equations are linear in the inertia: what leaks evenly turns, and goes, as if nothing left it.
#[test]
fn an_even_leak_changes_no_motion() {
    let model = tumbling::Model::<f64>::default();
    let mut start = tumbling::State::default();
    let six = SVector::<f64, 6>::from([0.3, -0.2, 0.5, 1.1, -0.7, 0.4]);
    start.v = SVector::<f64, 12>::from_fn(|row, _| six[row % 6]).into();
    let end = Integrator::fixed(DormandPrince, 0.005).integrate(&model, 0.0, 5.0, &start, &(), |_, _| ()).unwrap().0;
    let v = SVector::<f64, 12>::from(end.v);
    assert!((v.fixed_rows::<6>(0) - v.fixed_rows::<6>(6)).amax() < 1e-12);
    assert!((v.fixed_rows::<6>(0) - six).amax() > 0.1, "it only goes on");
    let share = (-2.0_f64).exp();
    assert!((end.x.share - share).abs() < 1e-12);
    let [leaking, tight] = model.outputs(5.0, &end, &()).spins;
    assert!((leaking - tight * share).norm() < 1e-12 && tight.norm() > 0.1);
}

/// The energy of what is there is that at the start, with the power of the force and less what left with its motion and height.
#[test]
fn energy_leaves_with_the_mass() {
    let model = balanced::Model::<f64>::default();
    let start = balanced::State { v: SVector::<f64, 3>::from([1.0, -2.0, 0.5]).into(), ..balanced::State::default() };
    let end = Integrator::fixed(DormandPrince, 0.002).integrate(&model, 0.0, 3.0, &start, &(), |_, _| ()).unwrap().0;
    let stored = |state| model.outputs(0.0, state, &()).stored;
    let (change, fed) = (stored(&end) - stored(&start), end.x.fed);
    println!("{change} {fed}");
    assert!((change - fed).abs() < 1e-9 * change.abs().max(1.0) && change.abs() > 0.1);
}

/// Masses are looked at where states start.
#[test]
fn parameters_are_checked_where_states_start() {
    let check = |dry: f64| tank::Params { dry }.check();
    assert_eq!(check(0.4), Ok(()));
    assert_eq!(check(-0.7), Ok(()));
    assert_eq!(check(-0.9).unwrap_err().what, "the mass of `tank` is negative or not finite");
    assert!(frozen::Params { dry: -0.9, content: 0.8 }.check().is_err());
}
