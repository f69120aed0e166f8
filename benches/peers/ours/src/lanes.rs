//! The panda four at a time, in a lane of four.

use multibody::nalgebra::SVector;
use multibody::simba::simd::WideF64x4;

use crate::abi::{Subject, subject};
use crate::export::PROGRAM;
use crate::robots::panda_driven::{Input, Model, State, Velocity};

const DOF: usize = 7;
const LENGTH: usize = 4 * DOF;

type Lanes = WideF64x4;
type Point = (Model<Lanes>, State<Lanes>, Input<Lanes>);

/// Number `from + k` of four states.
fn lane(states: &[f64], at: usize) -> Lanes {
    std::array::from_fn::<_, 4, _>(|state| states[state * LENGTH + at]).into()
}

fn vector(states: &[f64], from: usize) -> SVector<Lanes, DOF> {
    SVector::from_fn(|k, _| lane(states, from + k))
}

pub const SUBJECTS: &[Subject] = &[subject!(
    c"panda",
    c"forward, lanes of four",
    PROGRAM,
    LENGTH,
    4,
    Point,
    |x| {
        let state = State { q: vector(x, 0).into(), v: vector(x, DOF).into() };
        (Model::default(), state, Input { torque: std::array::from_fn(|k| lane(x, 3 * DOF + k)) })
    },
    (|(model, state, input): &Point| model.forward_dynamics(Lanes::from([0.0; 4]), state, input)),
    (|_, lane: usize, accel: Velocity<Lanes>| {
        let accel: SVector<Lanes, DOF> = accel.into();
        accel.iter().map(|x| <[f64; 4]>::from(*x)[lane]).collect()
    }),
)];
