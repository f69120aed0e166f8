//! Arms and robots on legs.

use std::ffi::CStr;

use multibody::nalgebra::{DMatrix, SVector};
use multibody::{Configuration, Pose};

use crate::abi::{Subject, subject};
use crate::export::{COUNT, PACKS, PROGRAM};
use crate::floating;
use crate::random::Random;
use crate::robots::{
    four_legged_driven, four_legged_packed, humanoid, humanoid_driven, humanoid_packed, panda, panda_driven, puma560,
    puma560_driven,
};

/// Random states of a tree with `joints` coordinates, on a floating base if `floats`; none of any other robot.
pub fn states(robot: &CStr) -> Option<Vec<f64>> {
    let (joints, floats) = match robot.to_bytes() {
        b"puma560" => (6, false),
        b"panda" => (7, false),
        b"four_legged" => (12, true),
        b"humanoid" => (32, true),
        _ => return None,
    };
    let mut random = Random::new(1);
    let state = |_| {
        let mut state = Vec::new();
        let mut draw = |count: usize, size: f64, to: &mut Vec<f64>| {
            let start = to.len();
            to.extend((0..count).map(|_| size * random.unit()));
            start
        };
        let base = if floats { 6 } else { 0 };
        if floats {
            draw(3, 1.0, &mut state);
            let start = draw(4, 1.0, &mut state);
            let length = state[start..].iter().map(|x| x * x).sum::<f64>().sqrt();
            state[start..].iter_mut().for_each(|x| *x /= length);
        }
        draw(joints, 3.0, &mut state);
        draw(base + joints, 2.0, &mut state);
        draw(base + joints, 2.0, &mut state);
        state.extend(vec![0.0; base]);
        draw(joints, 20.0, &mut state);
        state
    };
    Some((0..COUNT).flat_map(state).collect())
}

fn vector<const N: usize>(values: &[f64]) -> SVector<f64, N> {
    SVector::from_column_slice(&values[..N])
}

/// All coordinates in their order.
fn flat<const N: usize>(coordinates: impl Into<SVector<f64, N>>) -> Vec<f64> {
    coordinates.into().as_slice().to_vec()
}

/// Matrices, one behind the other, by columns.
fn columns(matrices: &[DMatrix<f64>]) -> Vec<f64> {
    matrices.iter().flat_map(|matrix| matrix.iter().copied()).collect()
}

fn dynamic<const R: usize, const C: usize>(matrix: &multibody::nalgebra::SMatrix<f64, R, C>) -> DMatrix<f64> {
    DMatrix::from_column_slice(R, C, matrix.as_slice())
}

/// An arm without inputs: inverse dynamics and mass matrix.
macro_rules! inverse {
    ($name:literal, $module:ident, $dof:literal) => {{
        type Point = ($module::Model<f64>, $module::State<f64>, $module::Velocity<f64>);
        subject!(
            $name,
            c"inverse",
            PROGRAM,
            4 * $dof,
            1,
            Point,
            |x| {
                let state = $module::State { q: vector::<$dof>(x).into(), v: vector::<$dof>(&x[$dof..]).into() };
                ($module::Model::default(), state, vector::<$dof>(&x[2 * $dof..]).into())
            },
            (|(model, state, accel): &Point| model.inverse_dynamics(0.0, state, &(), accel)),
            (|_, _, efforts| flat::<$dof>(efforts)),
        )
    }};
}

macro_rules! mass {
    ($name:literal, $module:ident, $dof:literal) => {{
        type Point = ($module::Model<f64>, $module::Position<f64>);
        subject!(
            $name,
            c"mass",
            PROGRAM,
            4 * $dof,
            1,
            Point,
            |x| ($module::Model::default(), vector::<$dof>(x).into()),
            (|(model, q): &Point| model.mass_matrix(q)),
            (|_, _, mass: multibody::nalgebra::SMatrix<f64, $dof, $dof>| mass.as_slice().to_vec()),
        )
    }};
}

/// An arm with an input for each joint.
macro_rules! driven {
    ($name:literal, $function:literal, $module:ident, $dof:literal, $evaluate:expr, $results:expr) => {{
        type Point = ($module::Model<f64>, $module::State<f64>, $module::Input<f64>);
        subject!(
            $name,
            $function,
            PROGRAM,
            4 * $dof,
            1,
            Point,
            |x| {
                let state = $module::State { q: vector::<$dof>(x).into(), v: vector::<$dof>(&x[$dof..]).into() };
                let torque = std::array::from_fn(|k| x[3 * $dof + k]);
                ($module::Model::default(), state, $module::Input { torque })
            },
            (|(model, state, input): &Point| $evaluate(model, state, input)),
            $results,
        )
    }};
}

/// A robot on a floating base with an input for each of its joints.
macro_rules! floating {
    ($name:literal, $function:literal, $module:ident, $joints:literal, $evaluate:expr, $results:expr) => {
        floating!($name, $function, PROGRAM, $module, $joints, $evaluate, $results)
    };
    ($name:literal, $function:literal, $program:expr, $module:ident, $joints:literal, $evaluate:expr, $results:expr) => {{
        const DOF: usize = 6 + $joints;
        type Point = ($module::Model<f64>, $module::State<f64>, $module::Input<f64>);
        subject!(
            $name,
            $function,
            $program,
            1 + 4 * DOF,
            1,
            Point,
            |x| {
                let mut joints = SVector::<f64, DOF>::zeros();
                joints.rows_mut(6, $joints).copy_from_slice(&x[7..7 + $joints]);
                let mut state = $module::State::default();
                state.q = state.q.displace(&joints.into());
                state.q.float = floating::pose(x);
                let v = &x[1 + DOF..];
                state.v = vector::<DOF>(v).into();
                state.v.float = floating::velocity(&state.q.float, v);
                let torque = std::array::from_fn(|k| x[1 + 3 * DOF + 6 + k]);
                ($module::Model::default(), state, $module::Input { torque })
            },
            (|(model, state, input): &Point| $evaluate(model, state, input)),
            $results,
        )
    }};
}

/// Forward dynamics of the four-legged robot, and its derivatives.
macro_rules! four_legged {
    (forward, $program:expr, $module:ident) => {
        floating!(
            c"four_legged",
            c"forward",
            $program,
            $module,
            12,
            (|model: &$module::Model<f64>, state, input| model.forward_dynamics(0.0, state, input)),
            (|(_, state, _): &Point, _, accel: $module::Velocity<f64>| {
                let base = floating::accel(&state.q.float, &state.v.float, &accel.float);
                [&base, &flat::<18>(accel)[6..]].concat()
            })
        )
    };
    (derivatives, $program:expr, $module:ident) => {
        floating!(
            c"four_legged",
            c"derivatives",
            $program,
            $module,
            12,
            (|model: &$module::Model<f64>, state, input| model.forward_derivatives(0.0, state, input)),
            (|(model, state, input): &Point, _, by: multibody::Derivatives<f64, 18, 18, 0, 12>| {
                let accel = model.forward_dynamics(0.0, state, input);
                let by = [dynamic(&by.position), dynamic(&by.velocity), dynamic(&by.input)];
                columns(&floating::derivatives(&state.q.float, &state.v.float, &accel.float, by))
            })
        )
    };
}

/// Forward dynamics of the humanoid, and its mass matrix.
macro_rules! humanoid {
    (forward, $program:expr, $module:ident) => {
        floating!(
            c"humanoid",
            c"forward",
            $program,
            $module,
            32,
            (|model: &$module::Model<f64>, state, input| model.forward_dynamics(0.0, state, input)),
            (|(_, state, _): &Point, _, accel: $module::Velocity<f64>| {
                let base = floating::accel(&state.q.float, &state.v.float, &accel.float);
                [&base, &flat::<38>(accel)[6..]].concat()
            })
        )
    };
    (mass, $program:expr, $module:ident) => {{
        type Point = ($module::Model<f64>, $module::Position<f64>);
        subject!(
            c"humanoid",
            c"mass",
            $program,
            1 + 4 * 38,
            1,
            Point,
            |x| {
                let mut joints = SVector::<f64, 38>::zeros();
                joints.rows_mut(6, 32).copy_from_slice(&x[7..39]);
                let mut q = $module::Position::default().displace(&joints.into());
                q.float = floating::pose(x);
                ($module::Model::default(), q)
            },
            (|(model, q): &Point| model.mass_matrix(q)),
            (|(_, q): &Point, _, mass| {
                let pose: &Pose<f64> = &q.float;
                columns(&[floating::mass(pose, &dynamic::<38, 38>(&mass))])
            }),
        )
    }};
}

pub const SUBJECTS: &[Subject] = &[
    inverse!(c"puma560", puma560, 6),
    mass!(c"puma560", puma560, 6),
    driven!(
        c"puma560",
        c"forward",
        puma560_driven,
        6,
        (|model: &puma560_driven::Model<f64>, state, input| model.forward_dynamics(0.0, state, input)),
        (|_, _, accel| flat::<6>(accel))
    ),
    inverse!(c"panda", panda, 7),
    mass!(c"panda", panda, 7),
    driven!(
        c"panda",
        c"forward",
        panda_driven,
        7,
        (|model: &panda_driven::Model<f64>, state, input| model.forward_dynamics(0.0, state, input)),
        (|_, _, accel| flat::<7>(accel))
    ),
    driven!(
        c"panda",
        c"derivatives",
        panda_driven,
        7,
        (|model: &panda_driven::Model<f64>, state, input| model.forward_derivatives(0.0, state, input)),
        (|_, _, by: multibody::Derivatives<f64, 7, 7, 0, 7>| {
            columns(&[dynamic(&by.position), dynamic(&by.velocity), dynamic(&by.input)])
        })
    ),
    four_legged!(forward, PROGRAM, four_legged_driven),
    four_legged!(forward, PACKS, four_legged_packed),
    four_legged!(derivatives, PROGRAM, four_legged_driven),
    four_legged!(derivatives, PACKS, four_legged_packed),
    humanoid!(forward, PROGRAM, humanoid_driven),
    humanoid!(forward, PACKS, humanoid_packed),
    humanoid!(mass, PROGRAM, humanoid),
    humanoid!(mass, PACKS, humanoid_packed),
];
