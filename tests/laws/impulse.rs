//! Jumps of velocities under impulses: against the mass matrix, against a dense solution of all equations, and where
//! equations depend on each other.

use multibody::nalgebra::{DMatrix, DVector, SMatrix, SVector, UnitQuaternion, Vector3};
use multibody::{Constrained, Impulsive, RollPitchYaw, System, Tangent};
use multibody_tests::models::impulses::*;
use multibody_tests::support::compare::{mixed, worse};
use multibody_tests::support::random::Random;

fn any<const N: usize>(random: &mut Random) -> SVector<f64, N> {
    SVector::from(random.units())
}

/// M d = p, by an independently derived mass matrix; the trait gives the same.
macro_rules! check_open {
    ($model:ident, $position:expr) => {{
        const N: usize = $model::DOF;
        let model = $model::Model::new(&$model::Params::default());
        let mut random = Random::new(1);
        let mut most = 0.0;
        for _ in 0..20 {
            let q: $model::Position = $position(&mut random);
            let impulse = SVector::<f64, N>::from(random.units());
            let jump = model.impulse(&q, &impulse.into());
            let matrix: SMatrix<f64, N, N> = model.mass_matrix(&q);
            let d: SVector<f64, N> = jump.into();
            let want = matrix.lu().solve(&impulse).unwrap();
            most = worse(most, mixed(d.as_slice(), want.as_slice()));
            let back = matrix * d;
            most = worse(most, mixed(back.as_slice(), impulse.as_slice()));
            let state = $model::State { q, ..Default::default() };
            let (same, rank) = Impulsive::jump(&model, 0.0, &state, &impulse.into(), &());
            assert_eq!((same, rank), (jump, 0.0));
        }
        println!("{}: {most:e}", stringify!($model));
        assert!(most <= 1e-12, "{}: {most:e}", stringify!($model));
    }};
}

#[test]
fn open_trees_obey_the_mass_matrix() {
    check_open!(tree, |random: &mut Random| any::<{ tree::DOF }>(random).into());
    check_open!(crane, |random: &mut Random| any::<{ crane::DOF }>(random).into());
    check_open!(floating, |random: &mut Random| floating::Position::normalized(SVector::from(random.units())));
    check_open!(geared, |random: &mut Random| any::<{ geared::DOF }>(random).into());
}

#[test]
fn loops_that_are_reduced_obey_the_reduced_mass_matrix() {
    check_open!(four_bar, |random: &mut Random| four_bar::Position { crank: 1.2 + 0.5 * random.unit() });
}

/// A constraint that moves by itself gives impulses a time.
#[test]
fn jumps_depend_on_time_where_the_mechanism_does() {
    let model = turning::Model::<f64>::default();
    let (q, impulse) = (turning::Position::<f64> { hang: 0.4 }, turning::Velocity { hang: 0.7 });
    for t in [0.0, 0.3] {
        // slide = 0.3 crank sin(hang): the ring moves with slope, the bob with both.
        let slope = 0.3 * (1.0 + 2.0 * t) * q.hang.cos();
        let inertia = 0.5 * 1.2 * 1.2 / 12.0 + 0.5 * 0.36;
        let mass = 1.1 * slope * slope + 2.0 * 0.5 * 0.6 * q.hang.cos() * slope + inertia;
        let jump = model.impulse(t, &q, &impulse);
        assert!((jump.hang - 0.7 / mass).abs() <= 1e-14, "{} instead of {}", jump.hang, 0.7 / mass);
        let state = turning::State { q, ..Default::default() };
        assert_eq!(model.jump(t, &state, &impulse, &()).0, jump);
    }
}

/// M d + G^T mu = p, G d = r, solved as they stand.
fn dense(mass: &DMatrix<f64>, jacobian: &DMatrix<f64>, p: &[f64], r: &[f64]) -> DVector<f64> {
    let (n, m) = (mass.nrows(), jacobian.nrows());
    let mut all = DMatrix::zeros(n + m, n + m);
    all.view_mut((0, 0), (n, n)).copy_from(mass);
    all.view_mut((n, 0), (m, n)).copy_from(jacobian);
    all.view_mut((0, n), (n, m)).copy_from(&jacobian.transpose());
    let side = DVector::from_iterator(n + m, p.iter().chain(r).copied());
    all.full_piv_lu().solve(&side).expect("a regular system")
}

fn dynamic<const N: usize, const M: usize>(m: &SMatrix<f64, N, M>) -> DMatrix<f64> {
    DMatrix::from_column_slice(N, M, m.as_slice())
}

macro_rules! check_constrained {
    ($model:ident, $position:expr, ($($t:expr)?)) => {{
        const N: usize = $model::DOF;
        const M: usize = $model::CONSTRAINTS;
        let model = $model::Model::new(&$model::Params::default());
        let mut random = Random::new(2);
        let mut most = 0.0;
        for _ in 0..20 {
            let q: $model::Position = $position(&mut random);
            let t = 0.0 $(+ $t)?;
            let p = SVector::<f64, N>::from(random.units());
            let r = SVector::<f64, M>::from(random.units());
            let $model::Jump { v, multipliers, rank } = model.impulse($($t,)? &q, &p.into(), &r);
            assert_eq!(rank, M as f64);
            let (mass, jacobian) = (dynamic(&model.mass_matrix(&q)), dynamic(&model.constraint_jacobian(t, &q)));
            let want = dense(&mass, &jacobian, p.as_slice(), r.as_slice());
            let d: SVector<f64, N> = v.into();
            let got: Vec<f64> = d.iter().chain(&multipliers).copied().collect();
            most = worse(most, mixed(&got, want.as_slice()));
            let state = $model::State { q, ..Default::default() };
            let (same, rank) = model.jump(t, &state, &p.into(), &r);
            assert_eq!((same, rank), (v, M as f64));
            // It is the residual of the constraints that the rates belong to.
            let _: <$model::Model as Constrained>::Residual = r;
        }
        println!("{}: {most:e}", stringify!($model));
        assert!(most <= 1e-11, "{}: {most:e}", stringify!($model));
    }};
}

#[test]
fn loops_with_multipliers_obey_all_equations() {
    check_constrained!(stretched, |random: &mut Random| any::<{ stretched::DOF }>(random).into(), ());
    check_constrained!(shaken, |random: &mut Random| any::<{ shaken::DOF }>(random).into(), (0.7));
    let position = |random: &mut Random| {
        let mut q = hung::Position::default();
        q.first.position = Vector3::from(random.units());
        q.first.orientation = RollPitchYaw { roll: random.unit(), pitch: random.unit(), yaw: random.unit() };
        q.second.position = Vector3::from(random.units());
        let [a, b, c] = random.units();
        q.second.orientation = UnitQuaternion::from_euler_angles(a, b, c);
        q.eye = RollPitchYaw { roll: random.unit(), pitch: random.unit(), yaw: random.unit() };
        q
    };
    check_constrained!(hung, position, ());
}

/// Stretched, the two equations of the pin across the bars say one thing: the rank is known, velocities are right, and what
/// can't be is not asked for.
#[test]
fn rank_falls_where_bars_are_stretched() {
    let model = stretched::Model::<f64>::default();
    for (q, rank) in [([0.3, -0.3, 0.3], 2.0), ([0.0, 0.0, 0.0], 1.0), ([0.0, 0.5, 0.5], 2.0)] {
        let q: stretched::Position = SVector::from(q).into();
        assert!(model.constraints(0.0, &q).amax() < 1e-15);
        let p = SVector::<f64, 3>::new(0.5, -0.3, 0.8);
        let jump = model.impulse(&q, &p.into(), &SVector::zeros());
        let (mass, jacobian) = (dynamic(&model.mass_matrix(&q)), dynamic(&model.constraint_jacobian(0.0, &q)));
        let singular = jacobian.clone().svd(false, false).singular_values;
        println!("{q:?}: rank {}, singular values {singular}", jump.rank);
        assert_eq!(jump.rank, rank);
        let d = SVector::<f64, 3>::from(jump.v);
        // Velocities are those of the motions that are left: with the null space Z of G, d = Z (Z^T M Z)^-1 Z^T p.
        let eigen = (jacobian.transpose() * &jacobian).symmetric_eigen();
        let null = eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()).filter(|(value, _)| **value < 1e-12);
        let z = DMatrix::from_columns(&null.map(|(_, vector)| vector).collect::<Vec<_>>());
        let inner = (z.transpose() * &mass * &z).lu().solve(&(z.transpose() * DVector::from_row_slice(p.as_slice())));
        let want = &z * inner.unwrap();
        assert_eq!(z.ncols(), 3 - rank as usize);
        let error = mixed(d.as_slice(), want.as_slice());
        println!("error {error:e}");
        assert!(error <= 1e-13, "{d} instead of {want}");
        let left = &mass * DVector::from_row_slice(d.as_slice())
            + jacobian.transpose() * DVector::from_row_slice(jump.multipliers.as_slice())
            - DVector::from_row_slice(p.as_slice());
        assert!(left.amax() <= 1e-13, "{left}");
    }
}

/// A stop: the crank runs into it with restitution, and the loop stays closed.
#[test]
fn a_stop_with_restitution() {
    let model = stretched::Model::<f64>::default();
    let q: stretched::Position = SVector::from([0.7, -0.7, 0.7]).into();
    let mut state = stretched::State { q, v: SVector::from([1.5, -1.5, 1.5]).into() };
    let still = SVector::zeros();
    assert!(model.constraint_rate(0.0, &state).amax() < 1e-15);
    // One unit on the crank; how much of it turns the crank's velocity round with a restitution of 0.4.
    let unit = stretched::Velocity { crank: 1.0, ..Default::default() };
    let (answer, _) = model.jump(0.0, &state, &unit, &still);
    let push = -(1.0 + 0.4) * state.v.crank / answer.crank;
    let (jump, _) = model.jump(0.0, &state, &unit.scale(push), &still);
    state.v = state.v.add(&jump);
    assert!((state.v.crank + 0.4 * 1.5).abs() < 1e-14);
    assert!(model.constraint_rate(0.0, &state).amax() < 1e-14);
    // Rates take a velocity back to where the equations hold.
    state.v.coupler += 0.1;
    let off = model.constraint_rate(0.0, &state);
    let (jump, _) = model.jump(0.0, &state, &stretched::Velocity::default(), &-off);
    state.v = state.v.add(&jump);
    assert!(off.amax() > 0.05 && model.constraint_rate(0.0, &state).amax() < 1e-14);
}

/// Accelerations are jumps per time: with the efforts of all forces for the impulse.
#[test]
fn jumps_are_accelerations_of_the_mechanism_at_rest() {
    let model = crane::Model::new(&crane::Params { m: 1.3, l: 0.6 });
    let mut random = Random::new(3);
    for _ in 0..10 {
        let q: crane::Position = any::<3>(&mut random).into();
        let state = crane::State { q, v: any::<3>(&mut random).into() };
        let (a, _) = model.derivative(0.0, &state, &());
        let effort = -model.bias(0.0, &state, &());
        let jump = model.impulse(&q, &effort.into());
        let [a, jump]: [SVector<f64, 3>; 2] = [a.into(), jump.into()];
        assert!(mixed(jump.as_slice(), a.as_slice()) <= 1e-13);
    }
}
