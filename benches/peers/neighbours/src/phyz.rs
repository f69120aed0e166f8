//! `phyz`: Featherstone's algorithms on vectors of any length.

use phyz_math::{DVec, Mat3, SpatialInertia, SpatialTransform, Vec3};
use phyz_model::{Model, ModelBuilder, State};
use phyz_rigid::{aba, crba, rnea};

use crate::abi::{Subject, subject};
use crate::file;

/// A model, a state with its efforts, and accelerations.
type Point = (Model, State, DVec);

/// An arm of hinges about z, which is what `robots.py` writes of them.
fn model(robot: &str) -> Model {
    let text = std::fs::read_to_string(file(robot, "robot")).expect("a robot");
    let mut lines = text.lines();
    let vector = |x: &[f64]| Vec3::new(x[0], x[1], x[2]);
    let head: Vec<f64> = lines.next().expect("a head").split(' ').skip(2).map(|word| word.parse().unwrap()).collect();
    let builder = ModelBuilder::new().gravity(vector(&head));
    lines
        .enumerate()
        .fold(builder, |builder, (k, line)| {
            let (parent, rest) = line.split_once(' ').expect("a link");
            let numbers = rest.strip_prefix("revolute ").expect("a hinge").split(' ');
            let x: Vec<f64> = numbers.map(|word| word.parse().expect("a number")).collect();
            assert_eq!(x[..3], [0.0, 0.0, 1.0]);
            let (turn, place, mass, com, i) = (&x[3..12], &x[12..15], x[15], &x[16..19], &x[19..25]);
            // Rotations lead from the parent to the joint.
            let back = Mat3::new(turn[0], turn[3], turn[6], turn[1], turn[4], turn[7], turn[2], turn[5], turn[8]);
            let inertia = Mat3::new(i[0], i[3], i[4], i[3], i[1], i[5], i[4], i[5], i[2]);
            builder.add_revolute_body(
                &format!("link{k}"),
                parent.parse().expect("a number"),
                SpatialTransform::new(back, vector(place)),
                SpatialInertia::new(mass, vector(com), inertia),
            )
        })
        .build()
}

fn point(robot: &str, x: &[f64]) -> Point {
    let (model, n) = (model(robot), x.len() / 4);
    let mut state = model.default_state();
    state.q = DVec::from_slice(&x[..n]);
    state.v = DVec::from_slice(&x[n..2 * n]);
    // Without actuators these are the efforts.
    state.ctrl = DVec::from_slice(&x[3 * n..]);
    (model, state, DVec::from_slice(&x[2 * n..3 * n]))
}

macro_rules! function {
    ($name:literal, $label:literal, $dof:literal, $function:literal, $evaluate:expr, $results:expr) => {
        subject!($label, $function, c"phyz", 4 * $dof, 1, Point, |x| point($name, x), $evaluate, $results)
    };
}

macro_rules! arm {
    ($name:literal, $label:literal, $dof:literal) => {
        &[
            function!(
                $name,
                $label,
                $dof,
                c"inverse",
                (|(model, state, accel): &Point| rnea(model, state, accel)),
                (|_, _, efforts: DVec| efforts.as_slice().to_vec())
            ),
            function!(
                $name,
                $label,
                $dof,
                c"forward",
                (|(model, state, _): &Point| aba(model, state)),
                (|_, _, accel: DVec| accel.as_slice().to_vec())
            ),
            function!(
                $name,
                $label,
                $dof,
                c"mass",
                (|(model, state, _): &Point| crba(model, state)),
                (|_, _, mass: phyz_math::DMat| (0..$dof * $dof).map(|k| mass[(k % $dof, k / $dof)]).collect())
            ),
        ]
    };
}

const PUMA: &[Subject; 3] = arm!("puma560", c"puma560", 6);
const PANDA: &[Subject; 3] = arm!("panda", c"panda", 7);
pub const SUBJECTS: &[Subject] = &[PUMA[0], PUMA[1], PUMA[2], PANDA[0], PANDA[1], PANDA[2]];
