//! Laws of closed loops: energy, derivatives of equations, and formulations of one mechanism that must agree.

use std::f64::consts::TAU;

use multibody::nalgebra::{DMatrix, SMatrix, SVector, UnitQuaternion, Vector3};
use multibody::{DormandPrince, Projection, Twist, assemble};
use multibody_tests::models::mechanisms::*;
use multibody_tests::support::compare::{mixed, worse};
use multibody_tests::support::random::Random;
use num_dual::Dual64;

fn assert_close(what: &str, got: &[f64], want: &[f64], bound: f64) {
    let error = mixed(got, want);
    assert!(error <= bound, "{what}: {got:?} instead of {want:?}, error {error:e}, allowed {bound:e}");
}

/// Jacobian, rate and bias are what differentiation by dual numbers gives; accelerations keep the equations, and
/// multipliers are the forces that do so.
macro_rules! check_equations {
    ($model:ident, $t:expr, $state:expr, $input:expr) => {{
        const N: usize = $model::DOF;
        const M: usize = $model::CONSTRAINTS;
        let name = stringify!($model);
        let (t, state, input): (f64, $model::State, _) = ($t, $state, $input);
        let model = $model::Model::new(&$model::Params::default());
        let dual = $model::Model::<Dual64>::new(&$model::Params::default());
        let (q, v): (SVector<f64, N>, SVector<f64, N>) = (state.q.into(), state.v.into());
        let jacobian = model.constraint_jacobian(t, &state.q);
        for j in 0..N {
            let mut direction = SVector::<f64, N>::zeros();
            direction[j] = 1.0;
            let at = q.zip_map(&direction, Dual64::new).into();
            let column = dual.constraints(Dual64::from(t), &at).map(|x| x.eps);
            assert_close(name, jacobian.column(j).as_slice(), column.as_slice(), 1e-14);
        }
        let at = q.zip_map(&v, Dual64::new);
        let rate = dual.constraints(Dual64::new(t, 1.0), &at.into());
        assert_close(name, rate.map(|x| x.re).as_slice(), model.constraints(t, &state.q).as_slice(), 1e-14);
        assert_close(name, model.constraint_rate(t, &state).as_slice(), rate.map(|x| x.eps).as_slice(), 1e-13);
        let mut moving = $model::State::<Dual64>::default();
        (moving.q, moving.v) = (at.into(), v.map(Dual64::from).into());
        let bias = dual.constraint_rate(Dual64::new(t, 1.0), &moving).map(|x| x.eps);
        assert_close(name, model.constraint_bias(t, &state).as_slice(), bias.as_slice(), 1e-12);

        let rates = model.forward_dynamics(t, &state, &input);
        let a: SVector<f64, N> = rates.v.into();
        assert_eq!(rates.rank, M as f64);
        let size = 1.0 + a.amax() + rates.multipliers.amax();
        let kept = jacobian * a + bias;
        assert!(kept.amax() <= 1e-12 * size, "{name}: accelerations leave the loop: {kept}");
        let residual = model.residual(t, &state, &input, &rates.v, &rates.multipliers);
        assert!(residual.amax() <= 1e-12 * size, "{name}: {residual}");
        // The picture says where entries are.
        for (i, row) in $model::JACOBIAN.iter().enumerate() {
            for (j, entry) in row.chars().enumerate() {
                assert!(entry == 'x' || jacobian[(i, j)] == 0.0, "{name}: {i} {j}");
            }
        }
        assert_eq!(($model::JACOBIAN.len(), $model::EQUATIONS.len(), $model::COORDINATES.len()), (M, M, N));
        (rates, jacobian)
    }};
}

/// How far the energy drifts in `steps` of `dt`, relative to one plus its size.
macro_rules! drift {
    ($model:ident, $state:expr, $dt:expr, $steps:expr) => {{
        let model = $model::Model::new(&$model::Params::default());
        let energy = |state: &$model::State| model.outputs(0.0, state, &Default::default()).energy;
        let (start, mut most) = (energy(&$state), 0.0);
        DormandPrince::integrate(&model, 0.0, &$state, &Default::default(), $dt, $steps, |_, state| {
            most = worse(most, (energy(state) - start).abs());
        })
        .unwrap();
        println!("{}: energy {start} J, drift {most:e} J", stringify!($model));
        assert!(most <= 1e-9 * (1.0 + start.abs()), "{}: drift {most:e} of {start}", stringify!($model));
    }};
}

fn bar(crank: f64, rate: f64) -> four_bar::State {
    four_bar::State { q: four_bar::Position { crank }, v: four_bar::Velocity { crank: rate } }
}

#[test]
fn energy_of_free_loops_stays() {
    drift!(four_bar, bar(0.3, 2.0), 1e-4, 20000);
    let mut spun = spatial::State::default();
    (spun.q.driver, spun.v.driver) = (0.2, 1.0);
    drift!(spatial, spun, 2e-4, 10000);
    let mut turned = geared::State::default();
    (turned.q.swing, turned.v.swing) = (0.8, 1.0);
    drift!(geared, turned, 1e-3, 2000);
    let mut lowered = delta::State::default();
    (lowered.q.plate, lowered.v.plate) = (Vector3::new(0.05, 0.02, -0.6), Vector3::new(0.1, 0.2, 0.1));
    drift!(delta, lowered, 1e-4, 1000);
    let mut planar = planar_platform::State::default();
    (planar.q.plane.x, planar.v.plane.angle) = (0.05, 0.5);
    drift!(planar_platform, planar, 1e-4, 1000);
    drift!(seven_legs, seven(&mut Random::new(5)), 1e-4, 5000);
}

#[test]
fn inverse_after_forward() {
    let mut random = Random::new(11);
    let bars = four_bar::Model::new(&four_bar::Params::default());
    let rods = spatial::Model::new(&spatial::Params::default());
    for _ in 0..20 {
        let torque = 5.0 * random.unit();
        let state = bar(3.0 * random.unit(), 2.0 * random.unit());
        let input = four_bar::Input { torque };
        let accel = bars.forward_dynamics(0.0, &state, &input);
        let left = bars.inverse_dynamics(0.0, &state, &input, &accel).crank;
        assert!(left.abs() <= 1e-12 * (1.0 + accel.crank.abs()), "{left:e}");
        let sum = bars.mass_matrix(&state.q)[(0, 0)] * accel.crank + bars.bias(0.0, &state, &input)[0];
        assert!(sum.abs() <= 1e-12 * (1.0 + accel.crank.abs()), "{sum:e}");

        let mut state = spatial::State::default();
        (state.q.driver, state.v.driver) = (0.9 * random.unit(), 2.0 * random.unit());
        let input = spatial::Input { torque };
        let accel = rods.forward_dynamics(0.0, &state, &input);
        let left = rods.inverse_dynamics(0.0, &state, &input, &accel).driver;
        assert!(left.abs() <= 1e-12 * (1.0 + accel.driver.abs()), "{left:e}");
    }
    // Through inputs: three torques on a plate, seven forces on a platform (as efforts of its own).
    let plate = planar_platform::Model::new(&planar_platform::Params::default());
    for _ in 0..20 {
        let (state, _) = planar(&mut random);
        let mut input = planar_platform::Input::default();
        input.limbs.iter_mut().for_each(|limb| limb.torque = random.unit());
        let accel = plate.forward_dynamics(0.0, &state, &input);
        let solved = plate.inverse_dynamics(0.0, &state, &Default::default(), &accel);
        let torques = |input: &planar_platform::Input| input.limbs.map(|limb| limb.torque);
        assert_close("torques", &torques(&solved.input), &torques(&input), 1e-11);
        assert_eq!(solved.rank, 3.0);
    }
    let legs = seven_legs::Model::new(&seven_legs::Params::default());
    for _ in 0..20 {
        let state = seven(&mut random);
        let mut input = seven_legs::Input::default();
        input.legs.iter_mut().for_each(|leg| leg.thrust = 5.0 * random.unit());
        let accel = legs.forward_dynamics(0.0, &state, &input);
        let left: SVector<f64, 6> = legs.inverse_dynamics(0.0, &state, &input, &accel).into();
        let a: SVector<f64, 6> = accel.into();
        assert!(left.amax() <= 1e-12 * (1.0 + a.amax()), "{left}");
        let sum = legs.mass_matrix(&state.q) * a + legs.bias(0.0, &state, &input);
        assert!(sum.amax() <= 1e-12 * (1.0 + a.amax()), "{sum}");
    }
}

#[test]
fn four_bar_in_three_formulations() {
    let solved = four_bar::Model::new(&four_bar::Params::default());
    let iterated = four_bar_newton::Model::new(&four_bar_newton::Params::default());
    let kept = four_bar_multipliers::Model::new(&four_bar_multipliers::Params::default());
    let mut random = Random::new(3);
    for _ in 0..20 {
        let state = bar(3.0 * random.unit(), 2.0 * random.unit());
        let torque = 5.0 * random.unit();
        let want = solved.outputs(0.0, &state, &four_bar::Input { torque });

        // From a guess that is wrong by some degrees.
        let mut same = four_bar_newton::State::default();
        (same.q.crank, same.v.crank) = (state.q.crank, state.v.crank);
        same.guess =
            SVector::from([want.angles[1] + 0.05 * random.unit(), want.angles[2] + 0.05 * random.unit()]).into();
        let closed = iterated.close(0.0, &same);
        assert!(closed.residual <= 1e-14, "{:e}", closed.residual);
        assert_close("guess", SVector::from(closed.state.guess).as_slice(), &want.angles[1..], 1e-13);
        let got = iterated.outputs(0.0, &same, &four_bar_newton::Input { torque });
        let accel = iterated.forward_dynamics(0.0, &same, &four_bar_newton::Input { torque });
        assert!(accel.residual <= 1e-14, "{:e}", accel.residual);
        assert_close("acceleration", &[accel.v.crank], &want.accels[..1], 1e-12);
        for (a, b) in [(got.angles, want.angles), (got.rates, want.rates), (got.accels, want.accels)] {
            assert_close("iterated", &a, &b, 1e-12);
        }

        let ([crank, coupler, rocker], [cv, kv, rv]) = (want.angles, want.rates);
        let q = four_bar_multipliers::Position { crank, coupler, rocker };
        let v = four_bar_multipliers::Velocity { crank: cv, coupler: kv, rocker: rv };
        let state = four_bar_multipliers::State { q, v };
        let input = four_bar_multipliers::Input { torque };
        let (rates, jacobian) = check_equations!(four_bar_multipliers, 0.0, state, input);
        let a = rates.v;
        assert_close("with multipliers", &[a.crank, a.coupler, a.rocker], &want.accels, 1e-12);
        // M a + bias - f = -G' lambda
        let effort: SVector<f64, 3> = kept.inverse_dynamics(0.0, &state, &input, &a).into();
        assert_close("efforts", effort.as_slice(), (-jacobian.transpose() * rates.multipliers).as_slice(), 1e-12);
        let got = kept.outputs(0.0, &state, &input);
        let all = [got.reactions, want.reactions].map(|list| list.map(|force| [force.x, force.y, force.z]).concat());
        assert_close("reactions", &all[0], &all[1], 1e-12);
        // Moments on the lever about its foot: that of the pin, of gravity, and the moment of inertia, 9 kg m^2.
        let (sin, cos) = rocker.sin_cos();
        let pin = want.reactions[1];
        let moment = 3.0 * (cos * pin.y - sin * pin.x) - 3.0 * 9.81 * 1.5 * cos;
        assert_close("moments", &[9.0 * want.accels[2]], &[moment], 1e-12);
        assert!(pin.norm() > 1.0);
    }
}

#[test]
fn drives_and_their_efforts() {
    let solved = four_bar_driven::Model::new(&four_bar_driven::Params::default());
    let kept = four_bar_driven_multipliers::Model::new(&four_bar_driven_multipliers::Params::default());
    let free = four_bar::Model::new(&four_bar::Params::default());
    for k in 0..20 {
        let t = 0.1 * f64::from(k);
        let rate = 1.5 + 0.6 * (2.0 * t).cos();
        let accel = -1.2 * (2.0 * t).sin();
        let state = bar(0.4 + 1.5 * t + 0.3 * (2.0 * t).sin(), rate);
        let want = free.inverse_dynamics(t, &state, &Default::default(), &four_bar::Velocity { crank: accel }).crank;
        let output = solved.outputs(t, &four_bar_driven::State::default(), &Default::default());
        assert_close("effort", &[output.effort], &[want], 1e-12);
        let closed = free.outputs(t, &state, &Default::default());
        assert_close("energy", &[output.energy], &[closed.energy], 1e-13);
        let mut same = four_bar_driven_multipliers::State::default();
        (same.q.coupler, same.q.rocker) = (closed.angles[1], closed.angles[2]);
        (same.v.coupler, same.v.rocker) = (closed.rates[1], closed.rates[2]);
        let other = kept.outputs(t, &same, &Default::default());
        assert_close("effort", &[other.effort], &[want], 1e-12);
        assert_close("pin", other.pin_force.as_slice(), output.pin_force.as_slice(), 1e-12);
        check_equations!(four_bar_driven_multipliers, t, same, Default::default());
    }
}

#[test]
fn spatial_loop_in_three_formulations() {
    let solved = spatial::Model::new(&spatial::Params::default());
    let iterated = spatial_newton::Model::new(&spatial_newton::Params::default());
    let kept = spatial_multipliers::Model::new(&spatial_multipliers::Params::default());
    let mut random = Random::new(4);
    for _ in 0..20 {
        let mut state = spatial::State::default();
        (state.q.driver, state.v.driver) = (0.9 * random.unit(), 2.0 * random.unit());
        let torque = random.unit();
        let want = solved.outputs(0.0, &state, &spatial::Input { torque });
        let [driver, shaft, first, second] = want.angles;

        let mut same = spatial_newton::State::default();
        (same.q.driver, same.v.driver) = (state.q.driver, state.v.driver);
        // Its unknowns, in the order of the tree.
        same.guess = SVector::from([first, second, shaft]).map(|x| x + 0.02).into();
        let got = iterated.outputs(0.0, &same, &spatial_newton::Input { torque });
        for (a, b) in [(got.angles, want.angles), (got.rates, want.rates), (got.accels, want.accels)] {
            assert_close("iterated", &a, &b, 1e-11);
        }

        let mut state = spatial_multipliers::State::default();
        (state.q.driver, state.q.shaft) = (driver, shaft);
        (state.q.gimbal.first, state.q.gimbal.second) = (first, second);
        (state.v.driver, state.v.shaft) = (want.rates[0], want.rates[1]);
        (state.v.gimbal.first, state.v.gimbal.second) = (want.rates[2], want.rates[3]);
        let input = spatial_multipliers::Input { torque };
        let (rates, _) = check_equations!(spatial_multipliers, 0.0, state, input);
        let a = rates.v;
        assert_close("kept", &[a.driver, a.shaft, a.gimbal.first, a.gimbal.second], &want.accels, 1e-11);
        let got = kept.outputs(0.0, &state, &input);
        assert_close("reaction", got.reaction.as_slice(), want.reaction.as_slice(), 1e-11);
        assert_close("energy", &[got.energy], &[want.energy], 1e-13);
    }
}

/// The guess travels with the state: a motion on one branch, all the way round.
#[test]
fn newtons_guess_follows_the_motion() {
    let iterated = four_bar_newton::Model::new(&four_bar_newton::Params::default());
    let solved = four_bar::Model::new(&four_bar::Params::default());
    let start = bar(0.3, 8.0);
    let angles = solved.outputs(0.0, &start, &Default::default()).angles;
    let mut same = four_bar_newton::State::default();
    (same.q.crank, same.v.crank, same.guess) = (0.3, 8.0, SVector::from([angles[1], angles[2]]).into());
    let end = DormandPrince::integrate(&solved, 0.0, &start, &Default::default(), 1e-3, 3000, |_, _| ()).unwrap();
    let other = DormandPrince::integrate(&iterated, 0.0, &same, &Default::default(), 1e-3, 3000, |_, _| ()).unwrap();
    assert!((end.q.crank - 0.3).abs() > 6.0, "it should have gone round: {}", end.q.crank);
    assert_close("end", &[other.q.crank, other.v.crank], &[end.q.crank, end.v.crank], 1e-10);
}

/// Angles are found as points on a circle, and given back on the turn on which the guess has them.
#[test]
fn whole_turns_of_guesses_are_kept() {
    let model = four_bar_newton::Model::new(&four_bar_newton::Params::default());
    let mut state = four_bar_newton::State::default();
    (state.q.crank, state.v.crank) = (0.3, 8.0);
    state.guess = model.close(0.0, &state).state.guess;
    let near = SVector::from(state.guess);
    let want = model.forward_dynamics(0.0, &state, &Default::default());
    let turns = [[0.0, 0.0], [1.0, 0.0], [-3.0, 2.0], [40.0, -41.0]];
    for (turns, off) in turns.into_iter().flat_map(|turns| [0.0, 0.2, -0.3].map(|off| (turns, off))) {
        let whole = SVector::from(turns) * TAU;
        let mut turned = state;
        turned.guess = (near + whole + SVector::from([off, -off])).into();
        let closed = model.close(0.0, &turned);
        assert!(closed.residual < 1e-13, "{turns:?}, {off}: {:e}", closed.residual);
        let (found, wanted) = (SVector::from(closed.state.guess), near + whole);
        assert!((found - wanted).norm() < 1e-12, "{turns:?}, {off}: {found} {wanted}");
        let got = model.forward_dynamics(0.0, &turned, &Default::default());
        assert_close("accelerations", &[got.v.crank], &[want.v.crank], 1e-11);
    }
}

/// Couplings are eliminated in every formulation: what is left has the inertia of all that is geared together.
#[test]
fn couplings_are_eliminated_exactly() {
    let (a, b) = (geared::Model::new(&geared::Params::default()), geared_multipliers::Model::new(&Default::default()));
    assert_eq!((geared::DOF, geared_multipliers::DOF), (2, 2));
    let mut random = Random::new(6);
    for _ in 0..10 {
        let (q, v): ([f64; 2], [f64; 2]) = (random.units(), random.units());
        let torque = random.unit();
        let x = geared::State { q: SVector::from(q).into(), v: SVector::from(v).into() };
        let y = geared_multipliers::State { q: SVector::from(q).into(), v: SVector::from(v).into() };
        let got = a.outputs(0.0, &x, &geared::Input { torque });
        let other = b.outputs(0.0, &y, &geared_multipliers::Input { torque });
        for (x, y) in [(got.angles, other.angles), (got.rates, other.rates), (got.accels, other.accels)] {
            assert_close("geared", &x, &y, 1e-13);
        }
        let [first, second, travel, swing] = got.angles;
        assert_close("couplings", &[3.0 * second + first, second * 0.2 - travel + 0.05], &[0.0; 2], 1e-15);
        // By hand: with the carriage's travel s the wheels turn by b = 5 s and a = -15 s.
        let [_, _, _, w] = got.rates;
        let (sin, cos) = swing.sin_cos();
        let [_, _, sdd, wdd] = got.accels;
        // The bob hangs at 0.4 (0, sin, -cos) from the carriage, which goes along (0, 0.6, 0.8).
        let arm = [0.4 * sin, -0.4 * cos];
        let way = [0.6, 0.8];
        let turn = |k: f64, r: [f64; 2]| [-k * r[1], k * r[0]];
        let bob = [0, 1].map(|i| way[i] * sdd + turn(wdd, arm)[i] - w * w * arm[i]);
        let force = [0.5 * bob[0], 0.5 * (bob[1] + 9.81)];
        let swinging = arm[0] * force[1] - arm[1] * force[0] + 0.01 * wdd;
        assert!(swinging.abs() <= 1e-12, "{swinging:e}");
        let wheel = 2.0 * 0.01 + 0.05;
        let gravity = 2.0 * 9.81 * 0.1 * second.cos() * 5.0;
        let sliding = way[0] * force[0]
            + way[1] * (force[1] + 3.0 * 9.81)
            + 3.0 * sdd
            + (0.01 * 225.0 + wheel * 25.0) * sdd
            + gravity
            + 15.0 * torque;
        assert!(sliding.abs() <= 1e-11, "{sliding:e}");
    }
}

#[test]
fn equations_that_change_with_time() {
    let model = shaken::Model::new(&shaken::Params::default());
    let mut random = Random::new(8);
    let mut closed = 0;
    for k in 0..20 {
        let t = 0.2 * f64::from(k);
        let mut guess = shaken::State::default();
        (guess.q.crank, guess.q.elbow, guess.q.rail) = (random.unit(), 2.0 * random.unit(), random.unit());
        guess.v = SVector::<f64, 3>::from(random.units()).into();
        let Ok(assembled) = assemble(&model, t, &guess, &SVector::from([1.0; 3]).into()) else {
            continue;
        };
        closed += 1;
        let state = assembled.state;
        assert!(model.constraint_rate(t, &state).amax() <= 1e-11);
        check_equations!(shaken, t, state, ());
    }
    assert!(closed >= 10, "only {closed} guesses could be closed");
    // Held where it is for a second, by projection after each step.
    let mut state = shaken::State::default();
    (state.q.crank, state.q.elbow, state.q.rail) = (0.7, -1.5, 0.6);
    let mut state = assemble(&model, 0.0, &state, &SVector::from([1.0; 3]).into()).unwrap().state;
    let projection = Projection::default();
    for k in 0..1000 {
        let t = 1e-3 * f64::from(k);
        state = DormandPrince::step(&model, t, &state, &(), 1e-3);
        state = projection.project(&model, t + 1e-3, &state).unwrap().state;
    }
    assert!(model.constraints(1.0, &state.q).amax() <= 1e-12);
    let follow = state.q.rail - state.q.crank.cos().powi(2) - 0.1 * 3.0_f64.sin();
    assert!(follow.abs() <= 1e-12, "{follow:e}");
}

#[test]
fn delta_robot_with_and_without_turning() {
    let (solved, kept) = (delta::Model::new(&delta::Params::default()), delta_rods::Model::new(&Default::default()));
    let mut random = Random::new(9);
    for _ in 0..10 {
        let [x, y, z]: [f64; 3] = random.units();
        let mut state = delta::State::default();
        state.q.plate = Vector3::new(0.1 * x, 0.1 * y, -0.6 + 0.05 * z);
        state.v.plate = Vector3::from(random.units());
        let torque: [f64; 3] = random.units();
        let output = solved.outputs(0.0, &state, &delta::Input { torque });
        let accel = solved.forward_dynamics(0.0, &state, &delta::Input { torque });
        let mut same = delta_rods::State::default();
        same.q.plate.position = state.q.plate;
        same.v.plate.position = state.v.plate;
        (same.q.motor0, same.q.motor1, same.q.motor2) = output.angles.into();
        (same.v.motor0, same.v.motor1, same.v.motor2) = output.rates.into();
        let (rates, _) = check_equations!(delta_rods, 0.0, same, delta_rods::Input { torque });
        assert!(kept.constraints(0.0, &same.q).amax() <= 1e-14);
        assert_close("plate", rates.v.plate.position.as_slice(), accel.plate.as_slice(), 1e-10);
        let o = rates.v.plate.orientation;
        let size = rates.v.plate.position.amax();
        assert!([o.roll, o.pitch, o.yaw].iter().all(|x| x.abs() <= 1e-10 * (1.0 + size)), "{o:?}");
    }
}

/// A state of the plate, and the same with its limbs.
fn planar(random: &mut Random) -> (planar_platform::State, planar_platform_multipliers::State) {
    let model = planar_platform::Model::new(&planar_platform::Params::default());
    let mut state = planar_platform::State::default();
    let [x, y, angle] = random.units();
    (state.q.plane.x, state.q.plane.y, state.q.plane.angle) = (0.1 * x, 0.1 * y, 0.4 * angle);
    [state.v.plane.x, state.v.plane.y, state.v.plane.angle] = random.units();
    let found = model.kinematics(0.0, &state, &Default::default());
    let mut same = planar_platform_multipliers::State::default();
    (same.q.plane, same.v.plane) = (state.q.plane, state.v.plane);
    for i in 0..3 {
        (same.q.limbs[i].shoulder, same.q.limbs[i].elbow) = (found.position[i], found.position[3 + i]);
        (same.v.limbs[i].shoulder, same.v.limbs[i].elbow) = (found.velocity[i], found.velocity[3 + i]);
    }
    (state, same)
}

#[test]
fn planar_platform_in_two_formulations() {
    let solved = planar_platform::Model::new(&planar_platform::Params::default());
    let kept = planar_platform_multipliers::Model::new(&Default::default());
    let mut random = Random::new(10);
    for _ in 0..20 {
        let (state, same) = planar(&mut random);
        assert!(kept.constraints(0.0, &same.q).amax() <= 1e-15);
        let torques: [f64; 3] = random.units();
        let mut input = planar_platform::Input::default();
        let mut other = planar_platform_multipliers::Input::default();
        input.limbs.iter_mut().zip(torques).for_each(|(limb, torque)| limb.torque = torque);
        other.limbs.iter_mut().zip(torques).for_each(|(limb, torque)| limb.torque = torque);
        let accel = solved.forward_dynamics(0.0, &state, &input).plane;
        let (rates, _) = check_equations!(planar_platform_multipliers, 0.0, same, other);
        let a = rates.v.plane;
        assert_close("plate", &[a.x, a.y, a.angle], &[accel.x, accel.y, accel.angle], 1e-11);
        let back = kept.inverse_dynamics(0.0, &same, &Default::default(), &rates.v);
        assert_close("torques", &back.input.limbs.map(|limb| limb.torque), &torques, 1e-11);
    }
}

fn seven(random: &mut Random) -> seven_legs::State {
    let mut state = seven_legs::State::default();
    let [x, y, z] = random.units();
    state.q.platform.position = Vector3::new(-1.5 + 0.1 * x, 0.1 * y, 1.0 + 0.1 * z);
    let turn: [f64; 3] = random.units();
    state.q.platform.orientation = UnitQuaternion::from_scaled_axis(0.3 * Vector3::from(turn));
    state.v.platform.linear = Vector3::from(random.units());
    state.v.platform.angular = Vector3::from(random.units());
    state
}

#[test]
fn seven_legs_in_two_formulations() {
    let solved = seven_legs::Model::new(&seven_legs::Params::default());
    let kept = seven_legs_multipliers::Model::new(&Default::default());
    let mut random = Random::new(12);
    for _ in 0..10 {
        let state = seven(&mut random);
        let found = solved.kinematics(0.0, &state, &Default::default());
        let (mut input, mut other) = (seven_legs::Input::default(), seven_legs_multipliers::Input::default());
        let mut same = seven_legs_multipliers::State::default();
        (same.q.platform, same.v.platform) = (state.q.platform, state.v.platform);
        for i in 0..7 {
            let thrust = 5.0 * random.unit();
            (input.legs[i].thrust, other.legs[i].thrust) = (thrust, thrust);
            let (q, v) = (&mut same.q.legs[i], &mut same.v.legs[i]);
            (q.gimbal.first, q.gimbal.second) = (found.position[2 * i], found.position[2 * i + 1]);
            (v.gimbal.first, v.gimbal.second) = (found.velocity[2 * i], found.velocity[2 * i + 1]);
            (q.stroke, v.stroke) = (found.position[14 + i], found.velocity[14 + i]);
        }
        assert!(kept.constraints(0.0, &same.q).amax() <= 1e-14);
        let accel = solved.forward_dynamics(0.0, &state, &input).platform;
        let rates = kept.forward_dynamics(0.0, &same, &other);
        assert_eq!(rates.rank, 21.0);
        let got = rates.v.platform;
        let pair = |twist: &Twist| [twist.linear.as_slice(), twist.angular.as_slice()].concat();
        assert_close("platform", &pair(&got), &pair(&accel), 1e-11);
    }
}

/// A chain with a joint of every kind, and the same in absolute coordinates: then every joint is a cut one.
#[test]
fn every_kind_of_joint_closes_loops() {
    let (tree, cut) = (chain::Model::new(&chain::Params::default()), chain_absolute::Model::new(&Default::default()));
    assert_eq!((chain_absolute::DOF, chain_absolute::CONSTRAINTS), (48, 35));
    let mut random = Random::new(13);
    for _ in 0..5 {
        let mut position = [0.0; chain::DOF + 1];
        position.iter_mut().for_each(|x| *x = random.unit());
        let state = chain::State {
            q: chain::Position::normalized(SVector::from(position)),
            v: SVector::<f64, { chain::DOF }>::from(random.units()).into(),
        };
        let o = tree.outputs(0.0, &state, &());
        let mut same = chain_absolute::State::default();
        let (q, v) = (&mut same.q, &mut same.v);
        (q.b0, q.b1, q.b2, q.b3) = (o.p0, o.p1, o.p2, o.p3);
        (q.b4, q.b5, q.b6, q.b7) = (o.p4, o.p5, o.p6, o.p7);
        let twist = |linear: Vector3<f64>, angular: Vector3<f64>| Twist { linear, angular };
        (v.b0, v.b1, v.b2, v.b3) = (twist(o.v0, o.w0), twist(o.v1, o.w1), twist(o.v2, o.w2), twist(o.v3, o.w3));
        (v.b4, v.b5, v.b6, v.b7) = (twist(o.v4, o.w4), twist(o.v5, o.w5), twist(o.v6, o.w6), twist(o.v7, o.w7));
        let open = cut.constraints(0.0, &same.q);
        assert!(open.amax() <= 1e-14, "{open}");
        let rate = cut.constraint_rate(0.0, &same);
        assert!(rate.amax() <= 1e-13, "{rate}");
        let rates = cut.forward_dynamics(0.0, &same, &());
        assert_eq!(rates.rank, 35.0);
        let a = rates.v;
        let got = [a.b0, a.b1, a.b2, a.b3, a.b4, a.b5, a.b6, a.b7];
        let want = [
            (o.a0, o.e0),
            (o.a1, o.e1),
            (o.a2, o.e2),
            (o.a3, o.e3),
            (o.a4, o.e4),
            (o.a5, o.e5),
            (o.a6, o.e6),
            (o.a7, o.e7),
        ];
        for (got, want) in got.iter().zip(want) {
            assert_close("linear", got.linear.as_slice(), want.0.as_slice(), 1e-10);
            assert_close("angular", got.angular.as_slice(), want.1.as_slice(), 1e-10);
        }
        // The Jacobian by differences along each velocity.
        let jacobian: SMatrix<f64, 35, 48> = cut.constraint_jacobian(0.0, &same.q);
        let h = 1e-6;
        let mut most = 0.0;
        for j in 0..48 {
            let mut d = SVector::<f64, 48>::zeros();
            d[j] = h;
            let at = |d: SVector<f64, 48>| {
                let q = multibody::Configuration::displace(&same.q, &chain_absolute::Velocity::from(d));
                cut.constraints(0.0, &q)
            };
            let column = (at(d) - at(-d)) / (2.0 * h);
            most = worse(most, (column - jacobian.column(j)).amax());
        }
        assert!(most <= 1e-8, "{most:e}");
        let rate = jacobian * SVector::<f64, 48>::from(same.v);
        assert!((rate - cut.constraint_rate(0.0, &same)).amax() <= 1e-13);
        let rank = DMatrix::from_column_slice(35, 48, jacobian.as_slice()).rank(1e-9);
        assert_eq!(rank, 35);
    }
}
