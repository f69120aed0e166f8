//! `dynibo`: recursions over trees that a URDF describes, with workspaces of their own.

use std::cell::RefCell;

use dynibo::Robot;

use crate::abi::{Subject, subject};
use crate::file;

/// Positions, velocities, accelerations and efforts.
type Point<const N: usize> = [[f64; N]; 4];

fn point<const N: usize>(state: &[f64]) -> Point<N> {
    std::array::from_fn(|kind| std::array::from_fn(|k| state[kind * N + k]))
}

macro_rules! arm {
    ($name:ident, $label:literal, $dof:literal) => {
        mod $name {
            use super::*;

            thread_local! {
                static ROBOT: RefCell<Robot> =
                    RefCell::new(Robot::from_urdf(file(stringify!($name), "urdf")).expect("a robot"));
            }

            fn ask<const R: usize>(ask: impl FnOnce(&mut Robot, &mut [f64]) -> dynibo::Result<()>) -> [f64; R] {
                let mut results = [0.0; R];
                ROBOT.with_borrow_mut(|robot| ask(robot, &mut results)).expect("results");
                results
            }

            pub(super) const INVERSE: Subject = subject!(
                $label,
                c"inverse",
                c"dynibo",
                4 * $dof,
                1,
                Point<$dof>,
                point,
                (|[q, v, a, _]: &Point<$dof>| ask::<$dof>(|robot, to| robot.inverse_dynamics(q, v, a, &[], to))),
                (|_, _, results: [f64; $dof]| results.to_vec()),
            );
            pub(super) const FORWARD: Subject = subject!(
                $label,
                c"forward",
                c"dynibo",
                4 * $dof,
                1,
                Point<$dof>,
                point,
                (|[q, v, _, effort]: &Point<$dof>| {
                    ask::<$dof>(|robot, to| robot.forward_dynamics(q, v, effort, &[], to))
                }),
                (|_, _, results: [f64; $dof]| results.to_vec()),
            );
            pub(super) const MASS: Subject = subject!(
                $label,
                c"mass",
                c"dynibo",
                4 * $dof,
                1,
                Point<$dof>,
                point,
                (|[q, ..]: &Point<$dof>| ask::<{ $dof * $dof }>(|robot, to| robot.mass_matrix(q, to))),
                (|_, _, results: [f64; $dof * $dof]| results.to_vec()),
            );
        }
    };
}

arm!(puma560, c"puma560", 6);
arm!(panda, c"panda", 7);

pub const SUBJECTS: &[Subject] =
    &[puma560::INVERSE, puma560::FORWARD, puma560::MASS, panda::INVERSE, panda::FORWARD, panda::MASS];
