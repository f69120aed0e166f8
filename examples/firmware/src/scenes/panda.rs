//! The torques of a seven-joint arm along a motion: what computed-torque control asks for in every cycle.

use multibody::nalgebra::SVector;

use super::{Draw, Random, Scene};
use crate::Scalar;
use crate::models::panda::{Input, Model, State, Velocity};

/// One call of inverse dynamics.
#[derive(Default)]
pub struct Panda(Model<Scalar>);

type Joints = SVector<Scalar, 7>;

/// A point of a motion.
#[derive(Clone, Copy)]
pub struct Point {
    state: State<Scalar>,
    accel: Velocity<Scalar>,
}

impl Point {
    /// Joints swing as springs about the middle of their range.
    fn new(q: Joints, v: Joints) -> Self {
        let middle = Joints::from([0.0, 0.0, 0.0, -1.5, 0.0, 1.8, 0.0]);
        let stiffness = Joints::from([1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0]); // [1/s^2]
        Self { state: State { q: q.into(), v: v.into() }, accel: stiffness.component_mul(&(middle - q)).into() }
    }
}

impl Scene for Panda {
    type Input = Point;
    type Output = Velocity<Scalar>;
    const NAME: &'static str = "panda, inverse dynamics";

    #[inline(never)]
    fn call(&self, input: &Point) -> Velocity<Scalar> {
        self.0.inverse_dynamics(0.0, &input.state, &Input::default(), &input.accel)
    }
    fn start(&self) -> Point {
        Point::new(Joints::repeat(0.8), Joints::repeat(0.0))
    }
    fn next(&self, input: &Point, _output: &Velocity<Scalar>) -> Point {
        let v = Joints::from(input.state.v) + Joints::from(input.accel) * 1e-3;
        Point::new(Joints::from(input.state.q) + v * 1e-3, v)
    }
    fn random(&self, random: &mut Random, coordinate: Draw) -> Point {
        let q = Joints::from_fn(|_, _| coordinate(random));
        Point::new(q, Joints::from_fn(|_, _| random.within(5.0)))
    }
    fn numbers(output: &Velocity<Scalar>, each: impl FnMut(Scalar)) {
        Joints::from(*output).iter().copied().for_each(each);
    }
}
