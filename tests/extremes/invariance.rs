//! Where the origin is does not matter, and how small an inertia is does not either, until it is gone.

#[path = "../models/invariance.rs"]
mod models;

use multibody::nalgebra::SVector;
use multibody::{DormandPrince, IntegrationError};
use multibody_engine::diagnostics::Diagnostics;
use multibody_engine::{model, syntax};
use multibody_tests::support::compare::worse;
use multibody_tests::support::random::Random;

use models::*;

fn bits<const N: usize>(v: SVector<f64, N>) -> Vec<u64> {
    v.iter().map(|x| x.to_bits()).collect()
}

/// Accelerations and efforts of all models of a place, at states that are the same for all places.
macro_rules! at {
    ($place:ident) => {{
        use $place::{arm, four_bar, four_bar_multipliers};
        let mut random = Random::new(3);
        let mut all = Vec::new();
        for _ in 0..50 {
            let mut vector = || SVector::<f64, 4>::from_fn(|_, _| 2.0 * random.unit());
            let state = arm::State { q: vector().into(), v: vector().into() };
            let model = arm::Model::default();
            let accel = model.forward_dynamics(0.0, &state, &());
            all.extend(bits::<4>(accel.into()));
            all.extend(bits::<4>(model.inverse_dynamics(0.0, &state, &(), &accel).into()));

            let mut state = four_bar::State::default();
            (state.q.shaft, state.v.shaft) = (3.0 * random.unit(), 2.0 * random.unit());
            let model = four_bar::Model::default();
            let accel = model.forward_dynamics(0.0, &state, &());
            all.push(accel.shaft.to_bits());
            all.push(model.inverse_dynamics(0.0, &state, &(), &accel).shaft.to_bits());

            // Its loop need not be closed for that.
            let mut vector = || SVector::<f64, 3>::from_fn(|_, _| 2.0 * random.unit());
            let state = four_bar_multipliers::State { q: vector().into(), v: vector().into() };
            let rates = four_bar_multipliers::Model::default().forward_dynamics(0.0, &state, &());
            all.extend(bits::<3>(rates.v.into()));
            all.extend(rates.multipliers.iter().map(|x| x.to_bits()));
        }
        assert!(all.iter().all(|&x| f64::from_bits(x).is_finite()));
        all
    }};
}

#[test]
fn literal_origins_leave_every_bit() {
    let here = at!(here);
    assert_eq!(here, at!(at_1e3));
    assert_eq!(here, at!(at_1e6));
    assert_eq!(here, at!(at_1e9));
    println!("{} numbers, bitwise equal at 0, 1e3, 1e6 and 1e9 m", here.len());
}

#[test]
fn an_open_chain_knows_no_base() {
    let model =
        |scale: f64| adjustable::Model::new(&adjustable::Params { origin: [scale, -0.3 * scale, 1.7 * scale].into() });
    let here = model(0.0);
    // No function reads it, so there is nothing to keep.
    assert_eq!(size_of::<adjustable::Model>(), 0);
    let mut random = Random::new(4);
    for scale in [1e3, 1e6, 1e9, 1e300, f64::INFINITY] {
        let there = model(scale);
        for _ in 0..20 {
            let mut vector = || SVector::<f64, 4>::from_fn(|_, _| 2.0 * random.unit());
            let state = adjustable::State { q: vector().into(), v: vector().into() };
            let [a, b] = [&here, &there].map(|model| model.forward_dynamics(0.0, &state, &()));
            assert_eq!(bits::<4>(a.into()), bits::<4>(b.into()), "{scale:e}");
            let [a, b] = [&here, &there].map(|model| model.inverse_dynamics(0.0, &state, &(), &a));
            assert_eq!(bits::<4>(a.into()), bits::<4>(b.into()), "{scale:e}");
        }
    }
}

/// No axial inertia is approached in proportion to it, and from 1e-15 on nothing but rounding is left.
#[test]
fn inertia_to_zero_is_continuous() {
    macro_rules! approach {
        ($model:ident, $limit:ident) => {{
            let mut random = Random::new(7);
            let limit = $limit::Model::default();
            for _ in 0..50 {
                let mut vector = || SVector::<f64, 4>::from_fn(|_, _| random.unit());
                let (q, v) = (vector(), 2.0 * vector());
                let want: SVector<f64, 4> =
                    limit.forward_dynamics(0.0, &$limit::State { q: q.into(), v: v.into() }, &()).into();
                let state = $model::State { q: q.into(), v: v.into() };
                for exponent in [3, 6, 9, 12, 15, 30, 100, 200, 300, 308, 320] {
                    let i = 10_f64.powi(-exponent);
                    let params = $model::Params { i };
                    assert!(params.check().is_ok(), "{i:e}");
                    let got: SVector<f64, 4> = $model::Model::new(&params).forward_dynamics(0.0, &state, &()).into();
                    let error = worse(0.0, (got - want).amax() / (1.0 + want.amax()));
                    assert!(error <= (200.0 * i).max(1e-13), "{i:e}: {error:e}");
                }
            }
        }};
    }
    approach!(slender, rods);
    approach!(balls, points);
}

/// A rod that spins ever more easily: finite down to the least positive number, as physics has it. At zero nothing resists
/// the spin. As a literal that is an error of the compiler which names the joint. As a parameter `check` refuses it; without
/// that NaN or infinity come out, and an integrator ends in `NoInertia`, which names the coordinate.
#[test]
fn a_singular_mass_matrix_is_a_typed_error() {
    let spun = |i: f64, torque: f64| {
        let model = spinning::Model::new(&spinning::Params { i });
        let mut state = spinning::State::default();
        state.v.support.x = 0.7;
        let input = spinning::Input { torque };
        let accel = model.forward_dynamics(0.0, &state, &input).support;
        (accel, DormandPrince::integrate(&model, 0.0, &state, &input, 1e-3, 10, |_, _| ()))
    };
    for exponent in [3, 9, 30, 100, 300] {
        let (accel, end) = spun(10_f64.powi(-exponent), 0.0);
        assert!(accel.iter().all(|x| x.is_finite()), "{exponent}: {accel}");
        assert!(end.is_ok(), "{exponent}");
    }
    for torque in [0.0, 1.0] {
        let (accel, end) = spun(0.0, torque);
        println!("no inertia, torque {torque}: {}", accel.z);
        assert!(!accel.z.is_finite(), "{torque}");
        let told = matches!(end, Err(IntegrationError::NoInertia { time: 0.0, coordinate }) if coordinate.starts_with("support"));
        assert!(told, "{torque}: {end:?}");
    }
    assert!(spinning::Params { i: 1e-3 }.check().is_ok() && spinning::Params { i: 0.0 }.check().is_err());
    // What no body can have is refused by the parameters.
    for i in [-1e-3, f64::NAN, 1.0] {
        assert!(spinning::Params { i }.check().is_err(), "{i}");
    }
    let text = "mod m { body rod { mass: 1.2, com: -0.5 * Z, inertia: diag(0.1, 0.1, 0.0) }
        joint support: Ball { parent: ground, child: rod } }";
    let mut diagnostics = Diagnostics::default();
    let source = syntax::parse(text.parse().unwrap(), &mut diagnostics);
    model::check(&source, &mut diagnostics);
    let message = &diagnostics.errors()[0].message;
    println!("{message}");
    assert!(message.contains("singular by structure") && message.contains("support"), "{message}");
}
