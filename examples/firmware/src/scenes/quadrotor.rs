//! A quadrotor with its attitude as a quaternion.

use multibody::Rk4;
use multibody::nalgebra::{Quaternion, UnitQuaternion, Vector3};

use super::{Draw, Random, Scene};
use crate::Scalar;
use crate::models::quadrotor::{Input, Model, State};

/// [N] a little more than the weight on the first two rotors, a little less on the others.
const THRUST: [Scalar; 4] = [2.5, 2.48, 2.45, 2.46];

/// One step of a millisecond.
#[derive(Default)]
pub struct Quadrotor(Model<Scalar>);

impl Scene for Quadrotor {
    type Input = State<Scalar>;
    type Output = State<Scalar>;
    const NAME: &'static str = "quadrotor, RK4 step";

    #[inline(never)]
    fn call(&self, input: &State<Scalar>) -> State<Scalar> {
        Rk4::step(&self.0, 0.0, input, &Input { thrust: THRUST }, 1e-3)
    }
    fn start(&self) -> State<Scalar> {
        let mut state = State::default();
        state.v.float.angular = Vector3::new(0.3, -0.2, 0.5);
        state
    }
    fn next(&self, _input: &State<Scalar>, output: &State<Scalar>) -> State<Scalar> {
        *output
    }
    fn random(&self, random: &mut Random, coordinate: Draw) -> State<Scalar> {
        let mut state = State::default();
        state.q.float.position = Vector3::from_fn(|_, _| coordinate(random));
        let attitude = Quaternion::new(1.0, random.within(1.0), random.within(1.0), random.within(1.0));
        state.q.float.orientation = UnitQuaternion::new_normalize(attitude);
        state.v.float.linear = Vector3::from_fn(|_, _| random.within(10.0));
        state.v.float.angular = Vector3::from_fn(|_, _| random.within(10.0));
        state
    }
    fn numbers(output: &State<Scalar>, mut each: impl FnMut(Scalar)) {
        let (q, v) = (&output.q.float, &output.v.float);
        q.position.iter().chain(q.orientation.coords.iter()).copied().for_each(&mut each);
        v.linear.iter().chain(v.angular.iter()).copied().for_each(each);
    }
}
