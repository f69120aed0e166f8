//! Loops that Newton's method closes, in any units: what it finds is put into the constraint equations of the same mechanism with
//! multipliers, whose Jacobian nalgebra solves densely in double precision. In double and in single precision, with all lengths
//! or those of one loop by parameters from hundredths of a micrometre to kilometres while a metre is declared, at random poses, where loops
//! are folded, and where a parameter is infinite.

use multibody::nalgebra::{DMatrix, DVector, SVector};
use multibody::{Configuration, Constrained, Real, multibody};
use multibody_tests::models::iterated::geared_knee;
use multibody_tests::support::random::Random;
use num_dual::Dual64;

/// The same mechanism twice.
macro_rules! both {
    ($($newton:ident $kept:ident [$($formulation:tt)*] { $($items:tt)* })*) => {
        multibody! {
            $(
                pub(crate) mod $newton {
                    $($items)*
                    formulation { constraints: Reduced, $($formulation)* }
                    emit forward_dynamics, derivatives;
                }
                pub(crate) mod $kept { $($items)* formulation { constraints: Multipliers } emit forward_dynamics; }
            )*
        }
    };
}
both! {
    // Equations of lengths beside equations of cosines, a travel beside angles.
    spatial spatial_kept [independent: [shaft]] {
        param size = 1.0;
        world { gravity: -9.80665 * Z }
        body crank { mass: 0.2, com: 0.1 * X, inertia: diag(0.1, 0.2, 0.2) }
        body coupler { mass: 0.3, com: [0.2, 0.1, 0.0], inertia: diag(0.2, 0.6, 0.6) }
        body rocker { mass: 0.2, com: 0.2 * X, inertia: diag(0.1, 0.3, 0.3) }
        joint shaft: Revolute { parent: ground, child: crank, axis: [0.1, 0.2, 1.0] }
        joint elbow: Universal { parent: crank.at(2.0 * size * X), child: coupler, axes: [Y, Z] }
        joint foot: Cylindrical {
            parent: ground.at([5.0 * size, size, 0.0]), child: rocker, axis: [0.0, 0.1, 1.0],
        }
        #[cut] joint pin: Universal { parent: coupler.at(6.0 * size * X), child: rocker.at(4.0 * size * X), axes: [Y, Z] }
        output rates = [shaft.rate, elbow.first.rate, elbow.second.rate, foot.travel.rate, foot.angle.rate];
        output accels = [shaft.accel, elbow.first.accel, elbow.second.accel, foot.travel.accel, foot.angle.accel];
    }
    // Three angles in equations of lengths and of cosines: one of them only the lengths can give.
    ball ball_kept [independent: [shaft]] {
        param size = 1.0;
        world { gravity: -9.80665 * Z }
        body crank { mass: 0.2, com: 0.1 * X, inertia: diag(0.1, 0.2, 0.2) }
        body coupler { mass: 0.3, com: [0.2, 0.1, 0.0], inertia: diag(0.2, 0.6, 0.6) }
        body rocker { mass: 0.2, com: 0.2 * X, inertia: diag(0.1, 0.3, 0.3) }
        joint shaft: Revolute { parent: ground, child: crank, axis: [0.1, 0.2, 1.0] }
        joint elbow: Ball { parent: crank.at(2.0 * size * X), child: coupler, coordinates: RollPitchYaw }
        joint foot: Cylindrical {
            parent: ground.at([5.0 * size, size, 0.0]), child: rocker, axis: [0.0, 0.1, 1.0],
        }
        #[cut] joint pin: Revolute { parent: coupler.at(6.0 * size * X), child: rocker.at(4.0 * size * X), axis: [0.1, 1.0, 0.2] }
        force twist: Effort { joint: shaft, value: 0.4 * sin(elbow.roll + 0.3) - 0.2 * (elbow.yaw - 0.1) * elbow.pitch }
        output rates = [
            shaft.rate, elbow.roll.rate, elbow.pitch.rate, elbow.yaw.rate, foot.travel.rate, foot.angle.rate,
        ];
        output accels = [
            shaft.accel, elbow.roll.accel, elbow.pitch.accel, elbow.yaw.accel, foot.travel.accel, foot.angle.accel,
        ];
    }
    // Axes are held parallel by a loop whose lengths may be anything.
    sarrus sarrus_kept [independent: [a]] {
        param size = 1.0;
        world { gravity: -9.80665 * Z }
        body a1 { mass: 0.4, com: [0.2, 0.0, 0.0], inertia: diag(0.1, 0.2, 0.2) }
        body a2 { mass: 0.4, com: [0.2, 0.0, 0.0], inertia: diag(0.1, 0.2, 0.2) }
        body b1 { mass: 0.4, com: [0.0, 0.2, 0.0], inertia: diag(0.2, 0.1, 0.2) }
        body b2 { mass: 0.4, com: [0.0, 0.2, 0.0], inertia: diag(0.2, 0.1, 0.2) }
        body plate { mass: 1.0, com: [0.1, 0.1, 0.0], inertia: diag(0.2, 0.2, 0.3) }
        joint a: Revolute { parent: ground, child: a1, axis: Y }
        joint ab: Revolute { parent: a1.at(0.4 * size * X), child: a2, axis: Y }
        joint ac: Revolute { parent: a2.at(0.4 * size * X), child: plate, axis: Y }
        joint b: Revolute { parent: ground.at([0.6 * size, -0.5 * size, 0.0]), child: b1, axis: X }
        joint bb: Revolute { parent: b1.at(0.4 * size * Y), child: b2, axis: X }
        #[cut] joint bc: Revolute {
            parent: b2.at(0.4 * size * Y), child: plate.at([0.1 * size, -0.003 * size, 0.0]), axis: X,
        }
        output rates = [a.rate, ab.rate, ac.rate, b.rate, bb.rate];
        output accels = [a.accel, ab.accel, ac.accel, b.accel, bb.accel];
    }
    // Two loops in the plane that are closed together; the second has lengths of its own, and stands anywhere.
    six_bar six_bar_kept [independent: [turning]] {
        param size = 1.0;
        param small = 1.0;
        param across = 0.3;
        param up = -0.5;
        world { gravity: -9.80665 * Y }
        body crank { mass: 0.3, com: 0.1 * X, inertia: diag(0.1, 0.2, 0.2) }
        body coupler { mass: 0.6, com: [0.3, 0.1, 0.0], inertia: diag(0.1, 0.2, 0.2) }
        body rocker { mass: 0.5, com: 0.25 * X, inertia: diag(0.1, 0.2, 0.2) }
        body link { mass: 0.4, com: 0.2 * X, inertia: diag(0.1, 0.2, 0.2) }
        body last { mass: 0.4, com: 0.3 * X, inertia: diag(0.1, 0.2, 0.2) }
        joint shaft: Revolute { parent: ground, child: link, axis: Z }
        joint floating: Revolute { parent: link.at(0.45 * size * X), child: coupler, axis: Z }
        joint pin: Revolute { parent: ground.at([0.8 * size, 0.1 * size, 0.0]), child: rocker, axis: Z }
        #[cut] joint one: Revolute { parent: coupler.at(0.7 * size * X), child: rocker.at(0.5 * size * X), axis: Z }
        joint turning: Revolute { parent: ground.at([across, up, 0.0]), child: crank, axis: Z }
        joint lever: Revolute { parent: crank.at(0.2 * small * X), child: last, axis: Z }
        #[cut] joint two: Revolute {
            parent: coupler.at([0.35 * size, 0.25 * size, 0.0]), child: last.at(0.9 * small * X), axis: Z,
        }
        output rates = [shaft.rate, floating.rate, pin.rate, turning.rate, lever.rate];
        output accels = [shaft.accel, floating.accel, pin.accel, turning.accel, lever.accel];
    }
}

/// All sizes, and none.
const SIZES: [f64; 12] = [1.0, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 10.0, 100.0, 1e3];
/// Guesses are right, or off by so much: where they are right a residual tells nothing.
const OFF: [f64; 2] = [0.0, 1e-3];
/// Greater conditions are those of a pose that is nearly singular.
const SINGULAR: f64 = 1e3;

/// What was compared, and what was left aside since loops are open there or nearly singular.
#[derive(Debug)]
struct Seen {
    /// How far results may be off, in roundings times the square of the condition.
    limit: f64,
    compared: usize,
    open: usize,
    singular: usize,
    worst: f64,
}

impl Seen {
    fn within(limit: f64) -> Seen {
        Seen { limit, compared: 0, open: 0, singular: 0, worst: 0.0 }
    }
}

/// The Jacobian's columns of what follows, by rows and columns of length one (Ruiz 2001), with the lengths of both; the condition.
fn scaled(matrix: &DMatrix<f64>) -> (DMatrix<f64>, DVector<f64>, DVector<f64>, f64) {
    let mut matrix = matrix.clone();
    let (mut rows, mut columns) = (DVector::repeat(matrix.nrows(), 1.0), DVector::repeat(matrix.ncols(), 1.0));
    for _ in 0..60 {
        for (k, mut row) in matrix.row_iter_mut().enumerate() {
            let root = row.norm().sqrt();
            rows[k] *= root;
            row /= root;
        }
        for (k, mut column) in matrix.column_iter_mut().enumerate() {
            let root = column.norm().sqrt();
            columns[k] *= root;
            column /= root;
        }
    }
    let values = matrix.singular_values();
    let condition = values.max() / values.min();
    (matrix, rows, columns, condition)
}

/// Rates of what follows, for the rate of coordinate `free` and what equations say beside it.
fn truth(jacobian: &DMatrix<f64>, free: usize, rate: f64, rest: &DVector<f64>) -> (DVector<f64>, DVector<f64>, f64) {
    let side = -(jacobian.column(free) * rate + rest);
    let (matrix, rows, columns, condition) = scaled(&jacobian.clone().remove_column(free));
    // Equations may depend on each other.
    let factors = matrix.qr();
    let side = factors.q().transpose() * side.component_div(&rows);
    let found = factors.r().solve_upper_triangular(&side).expect("regular");
    (found.component_div(&columns).insert_row(free, rate), columns.insert_row(free, 1.0), condition)
}

/// Compares at one state. The pose has all coordinates; that of number `free` is the state's.
macro_rules! look {
    ($newton:ident, $kept:ident, $t:ty, [$($name:ident: $value:expr),*], $pose:expr, $free:expr, $unit:expr, $off:expr, $seen:expr) => {{
        const N: usize = $kept::DOF;
        let pose: [f64; N] = $pose;
        let free: usize = $free;
        let real = |x: f64| <$t as Real>::lit(x);
        let params = $newton::Params::<$t> { $($name: real($value)),* };
        let wide = $kept::Params::<f64> { $($name: f64::from(real($value))),* };
        let model = $newton::Model::<$t>::new(&params);
        let others: Vec<usize> = (0..N).filter(|&k| k != free).collect();
        let state = $newton::State::<$t> {
            q: SVector::<$t, 1>::from([real(pose[free])]).into(),
            v: SVector::<$t, 1>::from([real(0.7)]).into(),
            guess: SVector::<$t, { N - 1 }>::from(std::array::from_fn(|k| real(pose[others[k]] + $unit[others[k]] * $off))).into(),
        };
        let closed = model.close(real(0.0), &state);
        let found: SVector<$t, { N - 1 }> = closed.state.guess.into();
        let mut full = [0.0; N];
        full[free] = f64::from(real(pose[free]));
        others.iter().zip(found.iter()).for_each(|(&k, &x)| full[k] = f64::from(x));
        let kept = $kept::Model::<f64>::new(&wide);
        let q: $kept::Position = SVector::<f64, N>::from(full).into();
        // Equations are in units of lengths and of one.
        let gap = kept.constraints(0.0, &q);
        let jacobian = kept.constraint_jacobian(0.0, &q);
        let jacobian = DMatrix::from_column_slice(jacobian.nrows(), N, jacobian.as_slice());
        let slopes = DVector::from_iterator(jacobian.nrows(), jacobian.row_iter().map(|row| row.amax()));
        let epsilon = f64::from(<$t>::EPSILON);
        let closed = gap.iter().zip(slopes.iter()).all(|(gap, slope)| gap.abs() <= 1e3 * epsilon * slope);
        let none = DVector::zeros(jacobian.nrows());
        let rate = f64::from(real(0.7));
        let (want, units, condition) = truth(&jacobian, free, rate, &none);
        if !closed {
            $seen.open += 1;
        } else if condition.is_nan() || condition > SINGULAR {
            $seen.singular += 1;
        } else {
            let got = model.outputs(real(0.0), &state, &());
            let size = want.component_mul(&units).amax();
            let v: $kept::Velocity = SVector::<f64, N>::from_column_slice(want.as_slice()).into();
            let bias = kept.constraint_bias(0.0, &$kept::State { q, v });
            let bias = DVector::from_column_slice(bias.as_slice());
            let accel = f64::from(got.accels[free]);
            let (accels, ..) = truth(&jacobian, free, accel, &bias);
            let quick = accels.component_mul(&units).amax().max(size * size);
            for k in 0..N {
                for (got, want, size) in [(got.rates[k], want[k], size), (got.accels[k], accels[k], quick)] {
                    let off = (f64::from(got) - want).abs() * units[k] / size / (epsilon * condition * condition);
                    assert!(
                        off <= $seen.limit,
                        "{} {params:?}: {k}: {got:e} {want:e}, off by {off:e} with {condition:e}",
                        stringify!($newton)
                    );
                    $seen.worst = f64::max($seen.worst, off);
                }
            }
            $seen.compared += 1;
        }
    }};
}

/// Poses in which the loops of a mechanism of size one are closed, by corrections from random ones.
macro_rules! poses {
    ($kept:ident, $params:expr, $count:expr) => {{
        const N: usize = $kept::DOF;
        let model = $kept::Model::<f64>::new(&$params);
        let mut random = Random::new(21);
        let mut poses: Vec<[f64; N]> = Vec::new();
        for _ in 0..40 * $count {
            let start = SVector::<f64, N>::from(random.units()) * 2.5;
            let mut q: $kept::Position = start.into();
            for _ in 0..60 {
                let gap = model.constraints(0.0, &q);
                if gap.amax() < 1e-14 && poses.len() < $count {
                    poses.push(SVector::<f64, N>::from(q).into());
                    break;
                }
                let here = $kept::State { q, ..Default::default() };
                let (d, _) = model.correction(0.0, &here, &gap, &SVector::<f64, N>::repeat(1.0).into());
                let d: SVector<f64, N> = d.into();
                q = q.displace(&(-d * f64::min(0.5 / d.amax(), 1.0)).into());
            }
        }
        assert_eq!(poses.len(), $count, "closed poses of {}", stringify!($kept));
        poses
    }};
}

/// Nearly all are to be compared.
fn told(name: &str, seen: &Seen) {
    println!("{name}: {seen:?}");
    let all = seen.compared + seen.open + seen.singular;
    assert!(10 * seen.compared >= 8 * all, "{name}: {seen:?}");
}

#[test]
fn all_lengths_are_parameters() {
    macro_rules! all {
        ($newton:ident, $kept:ident, $travel:expr) => {{
            const N: usize = $kept::DOF;
            let poses = poses!($kept, $kept::Params::<f64>::default(), 40);
            let (mut double, mut single) = (Seen::within(100.0), Seen::within(100.0));
            for size in SIZES {
                for pose in &poses {
                    let unit: [f64; N] = std::array::from_fn(|k| if k == $travel { size } else { 1.0 });
                    let pose: [f64; N] = std::array::from_fn(|k| pose[k] * unit[k]);
                    for off in OFF {
                        look!($newton, $kept, f64, [size: size], pose, 0, unit, off, double);
                        look!($newton, $kept, f32, [size: size], pose, 0, unit, off, single);
                    }
                }
            }
            told(concat!(stringify!($newton), ", f64"), &double);
            told(concat!(stringify!($newton), ", f32"), &single);
        }};
    }
    all!(spatial, spatial_kept, 3);
    all!(ball, ball_kept, 4);
}

/// Hinges of one kind, in two planes.
#[test]
fn all_lengths_of_hinges_are_parameters() {
    let poses = poses!(sarrus_kept, sarrus_kept::Params::<f64>::default(), 40);
    // Of five equations Newton's method takes four, which may say less than all.
    let (mut double, mut single) = (Seen::within(2e4), Seen::within(2e4));
    for size in SIZES {
        for &pose in &poses {
            for off in OFF {
                look!(sarrus, sarrus_kept, f64, [size: size], pose, 0, [1.0; 5], off, double);
                look!(sarrus, sarrus_kept, f32, [size: size], pose, 0, [1.0; 5], off, single);
            }
        }
    }
    told("Sarrus, f64", &double);
    told("Sarrus, f32", &single);
}

/// A pose of the first loop of the six-bar, any of the second, and a foot for that where it is.
fn six_bar_pose(random: &mut Random, size: f64, small: f64) -> ([f64; 5], [f64; 2]) {
    loop {
        let shaft = 3.0 * random.unit();
        let (sin, cos) = shaft.sin_cos();
        // From the link's end to the rocker's foot: a triangle with sides 0.7 and 0.5.
        let [x, y] = [0.8 - 0.45 * cos, 0.1 - 0.45 * sin];
        let square = x * x + y * y;
        let cosine = (square + 0.49 - 0.25) / (1.4 * square.sqrt());
        if cosine.abs() > 0.95 {
            continue;
        }
        let direction = y.atan2(x) + cosine.acos();
        let (sin_c, cos_c) = direction.sin_cos();
        let tip = [0.7 * cos_c - x, 0.7 * sin_c - y];
        let [turning, lever] = [3.0 * random.unit(), 3.0 * random.unit()];
        let point =
            [size * (0.45 * cos + 0.35 * cos_c - 0.25 * sin_c), size * (0.45 * sin + 0.35 * sin_c + 0.25 * cos_c)];
        let arm = [
            small * (0.2 * turning.cos() + 0.9 * (turning + lever).cos()),
            small * (0.2 * turning.sin() + 0.9 * (turning + lever).sin()),
        ];
        // The joints in the order of the tree.
        let pose = [shaft, direction - shaft, tip[1].atan2(tip[0]), turning, lever];
        return (pose, [point[0] - arm[0], point[1] - arm[1]]);
    }
}

#[test]
fn one_loop_is_far_smaller_than_the_other() {
    let mut random = Random::new(23);
    // The truth is a difference of places far from each other.
    let (mut double, mut single) = (Seen::within(2e3), Seen::within(2e3));
    for [size, small] in [[1.0, 1.0], [1.0, 1e-2], [1.0, 1e-3], [1e-4, 1e-6], [1e3, 1.0], [1e-6, 1e-6]] {
        for _ in 0..40 {
            let (pose, [across, up]) = six_bar_pose(&mut random, size, small);
            look!(
                six_bar, six_bar_kept, f64, [size: size, small: small, across: across, up: up], pose, 3, [1.0; 5], 1e-5,
                double
            );
            look!(
                six_bar, six_bar_kept, f32, [size: size, small: small, across: across, up: up], pose, 3, [1.0; 5], 1e-5,
                single
            );
        }
    }
    told("six-bar, f64", &double);
    told("six-bar, f32", &single);
}

/// Derivatives through what is eliminated, by the transposed systems too, against dual numbers that go through all iterations.
macro_rules! slopes {
    ($newton:ident, $kept:ident, [$($name:ident: $value:expr),*], $pose:expr, $free:expr) => {{
        const N: usize = $kept::DOF;
        let pose: [f64; N] = $pose;
        let others: Vec<usize> = (0..N).filter(|&k| k != $free).collect();
        let guess = |k: usize| pose[others[k]];
        let model = $newton::Model::<f64>::new(&$newton::Params { $($name: $value),* });
        let dual = $newton::Model::<Dual64>::new(&$newton::Params { $($name: Dual64::from($value)),* });
        let state = $newton::State::<f64> {
            q: SVector::from([pose[$free]]).into(),
            v: SVector::from([0.7]).into(),
            guess: SVector::<f64, { N - 1 }>::from(std::array::from_fn(guess)).into(),
        };
        let got = model.forward_derivatives(0.0, &state, &());
        let along = |q: f64, v: f64| {
            let state = $newton::State::<Dual64> {
                q: SVector::from([Dual64::new(pose[$free], q)]).into(),
                v: SVector::from([Dual64::new(0.7, v)]).into(),
                guess: SVector::<Dual64, { N - 1 }>::from(std::array::from_fn(|k| Dual64::from(guess(k)))).into(),
            };
            let a: SVector<Dual64, 1> = dual.forward_dynamics(Dual64::from(0.0), &state, &()).v.into();
            a[0].eps
        };
        for (got, want) in [(got.position[(0, 0)], along(1.0, 0.0)), (got.velocity[(0, 0)], along(0.0, 1.0))] {
            let off = (got - want).abs() / want.abs().max(1.0);
            assert!(off <= 1e-8, "{}: {got:e} {want:e}", stringify!($newton));
        }
    }};
}

#[test]
fn derivatives_in_any_units() {
    let poses = poses!(spatial_kept, spatial_kept::Params::<f64>::default(), 10);
    let balls = poses!(ball_kept, ball_kept::Params::<f64>::default(), 10);
    let hinges = poses!(sarrus_kept, sarrus_kept::Params::<f64>::default(), 10);
    for size in [1.0, 1e-6, 1e-3, 1e3] {
        for ((pose, ball), hinges) in poses.iter().zip(&balls).zip(&hinges) {
            slopes!(spatial, spatial_kept, [size: size], std::array::from_fn(|k| if k == 3 { pose[k] * size } else { pose[k] }), 0);
            slopes!(ball, ball_kept, [size: size], std::array::from_fn(|k| if k == 4 { ball[k] * size } else { ball[k] }), 0);
            slopes!(sarrus, sarrus_kept, [size: size], *hinges, 0);
        }
    }
}

/// Lengths that are infinite or no number have no velocities, in whatever equation they stand.
#[test]
fn what_is_infinite_has_no_velocities() {
    for bad in [f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
        let pose = poses!(spatial_kept, spatial_kept::Params::<f64>::default(), 1)[0];
        let model = spatial::Model::new(&spatial::Params { size: bad });
        let state = spatial::State {
            q: SVector::from([pose[0]]).into(),
            v: SVector::from([0.7]).into(),
            guess: SVector::<f64, 4>::from(std::array::from_fn(|k| pose[k + 1])).into(),
        };
        let rates = model.outputs(0.0, &state, &()).rates;
        assert!(rates[1..].iter().any(|x| !x.is_finite()), "{bad}: {rates:?}");
        for params in
            [six_bar::Params { up: bad, ..Default::default() }, six_bar::Params { small: bad, ..Default::default() }]
        {
            let mut random = Random::new(24);
            let (pose, _) = six_bar_pose(&mut random, 1.0, 1.0);
            let state = six_bar::State {
                q: SVector::from([pose[3]]).into(),
                v: SVector::from([0.7]).into(),
                guess: SVector::from([pose[0], pose[1], pose[2], pose[4]]).into(),
            };
            let model = six_bar::Model::new(&params);
            let closed = model.close(0.0, &state);
            let rates = model.outputs(0.0, &state, &()).rates;
            assert!(!closed.residual.is_finite() || rates.iter().any(|x| !x.is_finite()), "{params:?}: {rates:?}");
        }
    }
}

/// Three rounds from a hundredth off are six.
#[test]
fn rounds_from_near() {
    use multibody_tests::models::iterated::*;
    macro_rules! near {
        ($($near:ident $newton:ident)*) => {
            $({
                let (near, all) = ($near::Model::<f64>::default(), $newton::Model::<f64>::default());
                // Off the default, where platforms and planes may lie flat.
                let mut start = $newton::State::<f64>::default();
                start.q = SVector::from(start.q).map(|q: f64| q + 0.2).into();
                for _ in 0..5 {
                    start.guess = all.close(0.0, &start).state.guess;
                }
                assert!(all.close(0.0, &start).residual < 1e-14, stringify!($near));
                let guess = SVector::from(start.guess);
                let mut random = Random::new(31);
                for _ in 0..40 {
                    let off = guess.map(|_| 1e-2 * random.unit());
                    let rate = SVector::from(start.v).map(|_: f64| random.unit());
                    let from = $newton::State { v: rate.into(), guess: (guess + off).into(), ..start };
                    let want = SVector::from(all.forward_dynamics(0.0, &from, &Default::default()).v);
                    let state = $near::State {
                        q: SVector::from(from.q).into(),
                        v: rate.into(),
                        guess: (guess + off).into(),
                    };
                    let got = SVector::from(near.forward_dynamics(0.0, &state, &Default::default()).v);
                    let error = (got - want).norm() / want.norm();
                    assert!(error < 1e-11, "{}: {error:e}", stringify!($near));
                }
            })*
        };
    }
    near! { wishbone_near wishbone_newton sarrus_near sarrus_newton stephenson_near stephenson_newton }
}

/// An angle that a coupling gives moves with those it is the sum of, against differences.
#[test]
fn derivatives_of_sums_of_angles() {
    let model = geared_knee::Model::<f64>::default();
    let input = geared_knee::Input { torque: 0.3 };
    let at = |turn: f64| geared_knee::State { q: SVector::from([turn]).into(), v: SVector::from([0.7]).into() };
    let accel = |turn: f64| -> f64 { SVector::<f64, 1>::from(model.forward_dynamics(0.0, &at(turn), &input))[0] };
    for turn in [0.4, 1.3, 2.9, 4.4] {
        let got = model.forward_derivatives(0.0, &at(turn), &input).position[(0, 0)];
        let want = (accel(turn + 1e-5) - accel(turn - 1e-5)) / 2e-5;
        assert!((got - want).abs() < 1e-6 * (1.0 + want.abs()), "{turn}: {got} {want}");
    }
}
