//! Systems of masses and loops (M, G^T; G, 0), eliminated in an order that was found while compiling, against the same matrices
//! solved densely with full pivoting, and against singular values: at random closed poses, with light and heavy limbs, where
//! limbs are folded or have no length, and near that.

use multibody::nalgebra::{DMatrix, DVector, SMatrix, SVector, UnitQuaternion, Vector3};
use multibody::{Configuration, Constrained, FreeRollPitchYaw};
use multibody_tests::models::limbs::*;
use multibody_tests::support::compare::worse;
use multibody_tests::support::random::Random;

/// Poses of each model. `POSES=1000 cargo test -p multibody-tests --test laws limbs` looks at as many.
fn poses() -> usize {
    std::env::var("POSES").ok().and_then(|text| text.parse().ok()).unwrap_or(100)
}

fn dynamic<const N: usize, const M: usize>(m: &SMatrix<f64, N, M>) -> DMatrix<f64> {
    DMatrix::from_column_slice(N, M, m.as_slice())
}

/// Singular values of G in the metric of M^-1, rows of the length one there: the greatest first.
fn singular(mass: &DMatrix<f64>, jacobian: &DMatrix<f64>) -> Vec<f64> {
    let root = mass.clone().cholesky().expect("a mass matrix is positive definite").l();
    let mut rows = root.solve_lower_triangular(&jacobian.transpose()).expect("regular");
    for mut column in rows.column_iter_mut() {
        let norm = column.norm();
        column /= norm;
    }
    rows.singular_values().as_slice().to_vec()
}

/// The least eigenvalue of a mass matrix whose diagonal is one: near the poses where roll and yaw are one next to nothing.
fn regular(mass: &DMatrix<f64>) -> f64 {
    let scaled =
        DMatrix::from_fn(mass.nrows(), mass.ncols(), |i, j| mass[(i, j)] / (mass[(i, i)] * mass[(j, j)]).sqrt());
    scaled.symmetric_eigenvalues().min()
}

/// What a solution leaves, over what its terms are made of: of M d + G^T mu = p, and of G d = r.
fn left(mass: &DMatrix<f64>, jacobian: &DMatrix<f64>, [p, r]: [&[f64]; 2], [d, mu]: [&[f64]; 2]) -> f64 {
    let [d, mu, p, r] = [d, mu, p, r].map(DVector::from_row_slice);
    let forces = mass * &d + jacobian.transpose() * &mu - &p;
    let rates = jacobian * &d - &r;
    let of_forces = (mass.abs() * d.abs() + jacobian.transpose().abs() * mu.abs() + p.abs()).amax();
    let of_rates = (jacobian.abs() * d.abs() + r.abs()).amax();
    worse(forces.amax() / of_forces, rates.amax() / of_rates)
}

/// Solved as it stands.
fn dense(mass: &DMatrix<f64>, jacobian: &DMatrix<f64>, p: &[f64], r: &[f64]) -> Option<DVector<f64>> {
    let (n, m) = (mass.nrows(), jacobian.nrows());
    let mut all = DMatrix::zeros(n + m, n + m);
    all.view_mut((0, 0), (n, n)).copy_from(mass);
    all.view_mut((n, 0), (m, n)).copy_from(jacobian);
    all.view_mut((0, n), (n, m)).copy_from(&jacobian.transpose());
    all.full_piv_lu().solve(&DVector::from_iterator(n + m, p.iter().chain(r).copied()))
}

/// Below this a singular value may count as zero, above it not.
const THRESHOLDS: [f64; 2] = [1e-9, 1e-6];

/// What one pose has shown.
#[derive(Default)]
struct Shown {
    poses: usize,
    /// Those whose rank is not full.
    short: usize,
    left: f64,
    /// Against the dense solution, by energy, times what both systems have left of their digits.
    off: f64,
    /// Least displacements that are short of their rank, and against those that the runtime finds without squares.
    short_moves: usize,
    moved: f64,
}

macro_rules! look {
    ($model:ident, $built:expr, $q:expr, $random:expr, $shown:expr) => {{
        const N: usize = $model::DOF;
        const M: usize = $model::CONSTRAINTS;
        let (model, q): (&$model::Model<f64>, &$model::Position) = (&$built, &$q);
        let p = SVector::<f64, N>::from($random.units());
        let r = SVector::<f64, M>::from($random.units());
        let $model::Jump { v, multipliers, rank } = model.impulse(q, &p.into(), &r);
        let (mass, jacobian) = (dynamic(&model.mass_matrix(q)), dynamic(&model.constraint_jacobian(0.0, q)));
        let values = singular(&mass, &jacobian);
        let least = *values.last().expect("rows");
        let [certain, possible] =
            [THRESHOLDS[1], THRESHOLDS[0]].map(|bound| values.iter().filter(|&&value| value > bound).count());
        assert!(
            (certain as f64..=possible as f64).contains(&rank),
            "{}: rank {rank} for singular values {values:?}",
            stringify!($model)
        );
        let d: SVector<f64, N> = v.into();
        $shown.poses += 1;
        if rank == M as f64 {
            let now = left(&mass, &jacobian, [p.as_slice(), r.as_slice()], [d.as_slice(), multipliers.as_slice()]);
            $shown.left = worse($shown.left, now);
            if let Some(want) = dense(&mass, &jacobian, p.as_slice(), r.as_slice()) {
                let want = want.rows(0, N).into_owned();
                let energy = |d: &DVector<f64>| (d.transpose() * &mass * d)[0].sqrt();
                let off = energy(&(DVector::from_row_slice(d.as_slice()) - &want)) / energy(&want);
                $shown.off = worse($shown.off, off * least * regular(&mass));
            }
        } else {
            $shown.short += 1;
        }
        // Projections: the same with masses of one.
        let here = $model::State { q: *q, ..Default::default() };
        let (want, least) = model.correction(0.0, &here, &r, &SVector::<f64, N>::repeat(1.0).into());
        let (d, rank) = model.least_correction(0.0, &here, &r).unwrap_or((want, least));
        let [d, want]: [SVector<f64, N>; 2] = [d.into(), want.into()];
        let values = singular(&DMatrix::identity(N, N), &jacobian);
        let [certain, possible] =
            [THRESHOLDS[1], THRESHOLDS[0]].map(|bound| values.iter().filter(|&&value| value > bound).count());
        assert!(
            (certain as f64..=possible as f64).contains(&rank),
            "{}: rank {rank} of a displacement for singular values {values:?}",
            stringify!($model)
        );
        assert!(d.iter().all(|x| x.is_finite()), "{}", stringify!($model));
        if rank == M as f64 {
            let off = (d - want).norm() / want.norm() * values.last().expect("rows");
            $shown.moved = worse($shown.moved, off);
        } else {
            $shown.short_moves += 1;
        }
        // What is reported short is finite, and obeys the equations that can be obeyed.
        assert!(d.iter().chain(&multipliers).all(|x| x.is_finite()), "{}", stringify!($model));
        (rank, values)
    }};
}

/// Closes loops from a position, with some coordinates held; nothing where that fails.
macro_rules! closed {
    ($model:ident, $built:expr, $start:expr, $weights:expr) => {{
        const N: usize = $model::DOF;
        let model: &$model::Model<f64> = &$built;
        let (mut q, weights): ($model::Position, $model::Velocity) = ($start, $weights);
        let mut found = None;
        for _ in 0..40 {
            let gap = model.constraints(0.0, &q);
            if gap.amax() < 1e-13 {
                found = Some(q);
                break;
            }
            let here = $model::State { q, ..Default::default() };
            let (d, _) = model.correction(0.0, &here, &gap, &weights);
            let d: SVector<f64, N> = d.into();
            let most = d.amax();
            q = q.displace(&(-d * f64::min(0.5 / most, 1.0)).into());
        }
        found
    }};
}

macro_rules! check {
    ($model:ident, $params:expr, $bound:expr) => {
        check!($model, $params, $bound, |_: &$model::Position| true)
    };
    // Where what is assumed holds.
    ($model:ident, $params:expr, $bound:expr, $holds:expr) => {{
        let holds: fn(&$model::Position) -> bool = $holds;
        let built = $model::Model::new(&$params);
        let mut random = Random::new(5);
        let mut shown = Shown::default();
        for k in 0..poses() {
            let far = [0.1, 0.5, 1.5, 4.0][k % 4];
            let step = SVector::<f64, { $model::DOF }>::from(random.units()) * far;
            let start = $model::Position::default().displace(&step.into());
            let q = closed!($model, built, start, SVector::<f64, { $model::DOF }>::repeat(1.0).into());
            if let Some(q) = q.filter(holds) {
                look!($model, built, q, random, shown);
            }
        }
        println!(
            "{}: {} poses, {} short, left {:e}, off {:e}; moves {} short, off {:e}",
            stringify!($model),
            shown.poses,
            shown.short,
            shown.left,
            shown.off,
            shown.short_moves,
            shown.moved
        );
        assert!(shown.moved <= $bound && shown.short_moves <= shown.short, "{}", stringify!($model));
        assert!(3 * shown.poses > poses(), "{}: {} poses close", stringify!($model), shown.poses);
        assert!(shown.left <= $bound && shown.off <= $bound, "{}", stringify!($model));
    }};
}

#[test]
fn systems_are_solved_at_random_poses() {
    check!(struts, struts::Params::default(), 1e-11);
    check!(free_struts, free_struts::Params::default(), 1e-11);
    check!(limbs, limbs::Params::default(), 1e-11);
    check!(folded, folded::Params::default(), 1e-11);
}

fn are_long(q: &long_struts::Position) -> bool {
    q.legs.iter().all(|leg| leg.stroke > -0.6)
}

/// Limbs of a millionth of the body's mass, and of a thousand times as much.
#[test]
fn light_and_heavy_limbs() {
    for mass in [1e-6, 1e3] {
        let mut params = struts::Params::default();
        params.legs.iter_mut().for_each(|leg| (leg.heavy, leg.light) = (mass, mass));
        params.legs[2].heavy = 0.37;
        check!(struts, params, 1e-9);
        let mut params = long_struts::Params::default();
        params.legs.iter_mut().for_each(|leg| (leg.heavy, leg.light) = (mass, mass));
        params.legs[1].heavy = 0.37;
        check!(long_struts, params, 1e-9, are_long);
        // A heavy cylinder with a light piston, and the other way round.
        params.legs.iter_mut().for_each(|leg| (leg.heavy, leg.light) = (mass, 1.0 / mass));
        check!(long_struts, params, 1e-7, are_long);
        check!(limbs, limbs::Params { m: mass }, 1e-9);
    }
}

/// A strut of the length zero moves its end along one line alone, and one that is short hardly across it. Nothing says that it
/// is longer, so it has to be solved.
#[test]
fn struts_without_length() {
    let model = struts::Model::default();
    let mut random = Random::new(7);
    for length in [0.0, 1e-9, 1e-7, 1e-5, 1e-3, 0.1] {
        let mut shown = Shown::default();
        for _ in 0..20 {
            let mut start = struts::Position::<f64>::default();
            let turn: [f64; 3] = random.units();
            (start.plate.orientation.roll, start.plate.orientation.pitch, start.plate.orientation.yaw) =
                (0.3 * turn[0], 0.3 * turn[1], 0.3 * turn[2]);
            start.plate.position = [-0.6, 0.07, 0.13].into();
            start.legs[0].stroke = length - 0.9;
            let mut weights: struts::Velocity = SVector::<f64, { struts::DOF }>::repeat(1.0).into();
            weights.legs[0].stroke = 0.0;
            if let Some(q) = closed!(struts, model, start, weights) {
                look!(struts, model, q, random, shown);
            }
        }
        println!(
            "{length:e}: {} poses, {} short, left {:e}, off {:e}",
            shown.poses, shown.short, shown.left, shown.off
        );
        assert!(shown.poses >= 10 && shown.short == 0, "{length:e}");
        assert!(shown.left <= 1e-11 && shown.off <= 1e-11, "{length:e}");
    }
}

/// Where a strut is shorter than the model assumes, its equations may be lost: the rank tells.
#[test]
fn what_is_assumed_and_does_not_hold_shows() {
    let model = long_struts::Model::default();
    let mut random = Random::new(8);
    let mut lost = 0;
    for length in [0.0, 1e-12, 1e-9, 1e-7, 1e-5, 1e-3, 0.1, 0.5] {
        for _ in 0..20 {
            let mut start = long_struts::Position::<f64>::default();
            let turn: [f64; 3] = random.units();
            (start.plate.orientation.roll, start.plate.orientation.pitch, start.plate.orientation.yaw) =
                (0.3 * turn[0], 0.3 * turn[1], 0.3 * turn[2]);
            start.plate.position = [-0.6, 0.07, -0.67].into();
            start.legs[0].stroke = length - 0.9;
            let mut weights: long_struts::Velocity = SVector::<f64, { long_struts::DOF }>::repeat(1.0).into();
            weights.legs[0].stroke = 0.0;
            let Some(q) = closed!(long_struts, model, start, weights) else { continue };
            let p = SVector::<f64, { long_struts::DOF }>::from(random.units());
            let r = SVector::<f64, { long_struts::CONSTRAINTS }>::from(random.units());
            let jump = model.impulse(&q, &p.into(), &r);
            let (mass, jacobian) = (dynamic(&model.mass_matrix(&q)), dynamic(&model.constraint_jacobian(0.0, &q)));
            let d: SVector<f64, { long_struts::DOF }> = jump.v.into();
            // Without any length it is no number.
            if jump.rank != long_struts::CONSTRAINTS as f64 {
                lost += 1;
                assert!(length < 1e-3, "{length:e}");
                continue;
            }
            let now = left(&mass, &jacobian, [p.as_slice(), r.as_slice()], [d.as_slice(), jump.multipliers.as_slice()]);
            assert!(now <= 1e-7, "{length:e}: {now:e}");
        }
    }
    assert!(lost >= 10, "{lost}");
}

fn are_upright(q: &upright_struts::Position) -> bool {
    q.legs.iter().all(|leg| leg.stroke > -0.6 && leg.gimbal.second.cos() > 0.25)
}

fn are_drawn(q: &turrets::Position) -> bool {
    q.legs.iter().all(|leg| leg.draw > -0.4 && leg.tilt > -1.2 && leg.tilt < 1.3)
}

/// Limbs of which two coordinates are assumed, and bounds that are parameters.
#[test]
fn two_coordinates_that_are_assumed() {
    check!(upright_struts, upright_struts::Params::default(), 1e-11, are_upright);
    check!(turrets, turrets::Params::default(), 1e-11, are_drawn);
    let mut params = upright_struts::Params::default();
    params.legs.iter_mut().for_each(|leg| (leg.length, leg.least, leg.apart) = (0.5, 0.1, 0.1));
    check!(upright_struts, params, 1e-11, |q| {
        q.legs.iter().all(|leg| leg.stroke > -0.4 && leg.gimbal.second.cos() > 0.1)
    });
}

/// Where the axis of a gimbal lies along its leg, or the leg has no length, or both: the rank tells, and where it is full the
/// solution is right.
#[test]
fn one_of_two_that_does_not_hold_shows() {
    const N: usize = upright_struts::DOF;
    const M: usize = upright_struts::CONSTRAINTS;
    let model = upright_struts::Model::default();
    let mut random = Random::new(12);
    for (is_flat, is_short) in [(true, false), (false, true), (true, true)] {
        let mut lost = 0;
        for off in [0.0, 1e-12, 1e-9, 1e-7, 1e-5, 1e-3, 0.1, 0.5] {
            for _ in 0..20 {
                let mut start: upright_struts::Position =
                    upright_struts::Position::default().displace(&SVector::<f64, N>::from(random.units()).into());
                let mut weights: upright_struts::Velocity = SVector::<f64, N>::repeat(1.0).into();
                if is_flat {
                    start.legs[0].gimbal.second = std::f64::consts::FRAC_PI_2 - off;
                    weights.legs[0].gimbal.second = 0.0;
                }
                if is_short {
                    start.legs[0].stroke = off - 0.9;
                    weights.legs[0].stroke = 0.0;
                }
                let Some(q) = closed!(upright_struts, model, start, weights) else { continue };
                let p = SVector::<f64, N>::from(random.units());
                let r = SVector::<f64, M>::from(random.units());
                let jump = model.impulse(&q, &p.into(), &r);
                if jump.rank != M as f64 {
                    lost += 1;
                    assert!(off < 0.1, "{off:e}");
                    continue;
                }
                let (mass, jacobian) = (dynamic(&model.mass_matrix(&q)), dynamic(&model.constraint_jacobian(0.0, &q)));
                let d: SVector<f64, N> = jump.v.into();
                let sides = [p.as_slice(), r.as_slice()];
                let now = left(&mass, &jacobian, sides, [d.as_slice(), jump.multipliers.as_slice()]);
                assert!(now <= 1e-7, "{off:e}: {now:e}");
            }
        }
        println!("flat {is_flat}, short {is_short}: {lost} lost");
        // What was absorbed is lost where it can't be: without that this test says nothing.
        assert!(lost >= 40, "{lost}");
    }
}

/// Two links of one length: folded, their end stands on the first joint, and turns about it without moving.
#[test]
fn folded_links() {
    let model = folded::Model::default();
    let mut random = Random::new(9);
    for off in [0.0, 1e-9, 1e-7, 1e-5, 1e-3, 0.1] {
        for flat in [0.0, std::f64::consts::PI] {
            let mut shown = Shown::default();
            for _ in 0..20 {
                let mut start: folded::Position = SVector::<f64, { folded::DOF }>::from(random.units()).into();
                start.fold = flat + off;
                let mut weights: folded::Velocity = SVector::<f64, { folded::DOF }>::repeat(1.0).into();
                weights.fold = 0.0;
                let q = closed!(folded, model, start, weights).expect("the plate follows");
                look!(folded, model, q, random, shown);
            }
            println!("{flat} {off:e}: {} short, left {:e}, off {:e}", shown.short, shown.left, shown.off);
            assert_eq!((shown.poses, shown.short), (20, 0));
            assert!(shown.left <= 1e-11 && shown.off <= 1e-11, "{flat} {off:e}");
        }
    }
}

/// What is assumed of the stroke rules out the length zero with the length as it is declared, and not with a shorter one.
#[test]
fn a_length_that_is_a_parameter() {
    for length in [0.9, 0.5, 0.3] {
        let model = lengthened::Model::new(&lengthened::Params { length });
        let mut random = Random::new(10);
        let mut shown = Shown::default();
        for off in [0.0, 1e-8, 1e-4, 0.1] {
            for _ in 0..5 {
                let mut start: lengthened::Position = SVector::<f64, { lengthened::DOF }>::from(random.units()).into();
                start.stroke = off - length;
                let mut weights: lengthened::Velocity = SVector::<f64, { lengthened::DOF }>::repeat(1.0).into();
                weights.stroke = 0.0;
                let q = closed!(lengthened, model, start, weights).expect("the plate follows");
                look!(lengthened, model, q, random, shown);
            }
        }
        println!("{length}: {} short, left {:e}, off {:e}", shown.short, shown.left, shown.off);
        assert_eq!((shown.poses, shown.short), (20, 0));
        assert!(shown.left <= 1e-11 && shown.off <= 1e-11, "{length}");
    }
}

/// Bodies without inertia about a line are held by other equations as the crank turns; none of them lets go. The same mechanism
/// at any size and of any mass turns alike.
macro_rules! turn_thin_rods {
    ($scalar:ident, $sizes:expr, $bound:expr) => {
        for (size, mass) in $sizes {
            let params = thin::Params { mass, radius: 0.2 * size, length: size };
            let (model, unit) = (thin::Model::<$scalar>::new(&params), thin::Model::<f64>::default());
            for k in 0..48 {
                let angle = f64::from(k) * std::f64::consts::PI / 24.0;
                let (sin, cos) = angle.sin_cos();
                let lean = -(0.2 * sin).asin();
                let mut state = thin::State::<f64>::default();
                state.q.crank.orientation.yaw = angle;
                state.q.rod.position = Vector3::new(0.2 * cos, 0.2 * sin, 0.0);
                state.q.rod.orientation.yaw = lean;
                state.q.piston.position.x = 0.2 * cos + lean.cos();
                assert!(unit.constraints(0.0, &state.q).amax() < 1e-15);
                let want = unit.forward_dynamics(0.0, &state, &());
                let mut other = thin::State::<$scalar>::default();
                other.q.crank.orientation.yaw = angle as $scalar;
                other.q.rod.orientation.yaw = lean as $scalar;
                other.q.rod.position = state.q.rod.position.map(|x| x as $scalar * size);
                other.q.piston.position = state.q.piston.position.map(|x| x as $scalar * size);
                let found = model.forward_dynamics(0.0, &other, &());
                assert_eq!(found.rank, thin::CONSTRAINTS as $scalar, "{angle} {size} {mass}");
                // Angles fall faster by as much as they are smaller; points by the same.
                let turning = |body: &FreeRollPitchYaw<$scalar>| f64::from(body.orientation.yaw * size);
                let got = [turning(&found.v.crank), turning(&found.v.rod), f64::from(found.v.piston.position.x)];
                let want = [want.v.crank.orientation.yaw, want.v.rod.orientation.yaw, want.v.piston.position.x];
                for (got, want) in got.iter().zip(want) {
                    assert!((got - want).abs() <= $bound * 75.0, "{angle} {size} {mass}: {got} {want}");
                }
            }
        }
    };
}

#[test]
fn thin_rods_turn() {
    let model = thin::Model::default();
    for k in 0..48 {
        let angle = f64::from(k) * std::f64::consts::PI / 24.0;
        let mut state = thin::State::<f64>::default();
        let (sin, cos) = angle.sin_cos();
        let lean = -(0.2 * sin).asin();
        state.q.crank.orientation.yaw = angle;
        state.q.rod.position = Vector3::new(0.2 * cos, 0.2 * sin, 0.0);
        state.q.rod.orientation.yaw = lean;
        state.q.piston.position.x = 0.2 * cos + lean.cos();
        state.v = SVector::<f64, { thin::DOF }>::from_fn(|k, _| f64::sin(1.0 + k as f64)).into();
        assert!(model.constraints(0.0, &state.q).amax() < 1e-15);
        let found = model.forward_dynamics(0.0, &state, &());
        assert_eq!(found.rank, thin::CONSTRAINTS as f64, "{angle}");
        let (mass, jacobian) =
            (dynamic(&model.mass_matrix(&state.q)), dynamic(&model.constraint_jacobian(0.0, &state.q)));
        let a: SVector<f64, { thin::DOF }> = found.v.into();
        let forces = -model.bias(0.0, &state, &());
        let rates = -model.constraint_bias(0.0, &state);
        let sides = [forces.as_slice(), rates.as_slice()];
        let now = left(&mass, &jacobian, sides, [a.as_slice(), found.multipliers.as_slice()]);
        assert!(now <= 1e-14, "{angle}: {now:e}");
    }
    turn_thin_rods!(f64, [(1.0, 1.0), (1e-3, 1e-6), (1e-4, 1e-11), (1.0, 1e-6), (1e2, 1e3), (1e-3, 1.0)], 1e-10);
    turn_thin_rods!(f32, [(1.0, 1.0), (0.1, 1e-2), (1e-2, 1e-4), (1.0, 1e-6), (1e-3, 1e-6)], 1e-3);
}

/// Slides across each other by default, along each other with another parameter.
#[test]
fn a_parameter_that_is_zero_by_default() {
    for tilt in [0.0, 0.4, std::f64::consts::FRAC_PI_2, 1e9] {
        check!(turned, turned::Params { tilt }, 1e-11);
    }
}

/// Rows that slides absorb leave rows that depend on each other, however light the slides are.
#[test]
fn ranks_beside_light_limbs() {
    let mut random = Random::new(11);
    for m in [1e3, 0.3, 1e-2, 1e-4, 1e-6] {
        check!(trammel, trammel::Params { m, ..Default::default() }, 1e-9);
        let model = trammel::Model::new(&trammel::Params { m, distance: 1.0 });
        let mut shown = Shown::default();
        let frame = UnitQuaternion::from_scaled_axis(Vector3::new(1.0, 2.0, 2.0) / 3.0 * 0.5);
        for _ in 0..20 {
            let about = UnitQuaternion::from_scaled_axis(3.0 * random.unit() * Vector3::z());
            let mut q = trammel::Position::<f64>::default();
            (q.rod.orientation.roll, q.rod.orientation.pitch, q.rod.orientation.yaw) = (frame * about).euler_angles();
            assert!(model.constraints(0.0, &q).amax() < 1e-15);
            look!(trammel, model, q, random, shown);
        }
        println!("{m:e}: {} poses, {} short", shown.poses, shown.short);
        assert!(shown.short == shown.poses, "{m:e}");
    }
}

/// In single precision nothing is lost that is not lost in double precision.
macro_rules! check_single {
    ($model:ident, $bound:expr, $holds:expr) => {{
        const N: usize = $model::DOF;
        const M: usize = $model::CONSTRAINTS;
        let holds: fn(&$model::Position) -> bool = $holds;
        let model = $model::Model::<f64>::default();
        let single = $model::Model::<f32>::default();
        let mut random = Random::new(12);
        let (mut most, mut poses) = (0.0_f64, 0);
        for _ in 0..50 {
            let step = SVector::<f64, N>::from(random.units()) * 0.3;
            let start = $model::Position::default().displace(&step.into());
            let q = closed!($model, model, start, SVector::<f64, N>::repeat(1.0).into());
            let Some(q) = q.filter(holds) else { continue };
            let list: SVector<f64, N> = q.into();
            let near = $model::Position::<f32>::from(list.cast::<f32>());
            let (p, r) = (SVector::<f64, N>::from(random.units()), SVector::<f64, M>::from(random.units()));
            let want = model.impulse(&q, &p.into(), &r);
            let got = single.impulse(&near, &p.cast::<f32>().into(), &r.cast::<f32>());
            assert_eq!((want.rank, got.rank), (M as f64, M as f32), "{}", stringify!($model));
            let (want, got): (SVector<f64, N>, SVector<f32, N>) = (want.v.into(), got.v.into());
            most = worse(most, (got.cast::<f64>() - want).amax() / want.amax());
            poses += 1;
        }
        println!("{}: {poses} poses, {most:e}", stringify!($model));
        assert!(poses > 20 && most <= $bound, "{}: {most:e}", stringify!($model));
    }};
}

#[test]
fn single_precision() {
    check_single!(long_struts, 1e-3, are_long);
    check_single!(limbs, 1e-3, |_| true);
    check_single!(folded, 1e-3, |_| true);
    check_single!(lengthened, 1e-3, |q| q.stroke > -0.6);
}
