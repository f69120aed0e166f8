//! A double pendulum that swings over, by the classical Runge-Kutta method at 1 kHz.

use super::{Draw, Random, Scene};
use crate::Scalar;
use crate::models::double_pendulum::{Model, State};
use multibody::Rk4;

/// One step of a millisecond.
#[derive(Default)]
pub struct DoublePendulum(Model<Scalar>);

impl Scene for DoublePendulum {
    type Input = State<Scalar>;
    type Output = State<Scalar>;
    const NAME: &'static str = "double pendulum, RK4 step";

    #[inline(never)]
    fn call(&self, input: &State<Scalar>) -> State<Scalar> {
        Rk4::step(&self.0, 0.0, input, &(), 1e-3)
    }
    fn start(&self) -> State<Scalar> {
        let mut state = State::default();
        (state.q.shoulder, state.q.elbow) = (2.0, 1.5);
        state
    }
    fn next(&self, _input: &State<Scalar>, output: &State<Scalar>) -> State<Scalar> {
        *output
    }
    fn random(&self, random: &mut Random, coordinate: Draw) -> State<Scalar> {
        let mut state = State::default();
        (state.q.shoulder, state.q.elbow) = (coordinate(random), coordinate(random));
        (state.v.shoulder, state.v.elbow) = (random.within(10.0), random.within(10.0));
        state
    }
    fn numbers(output: &State<Scalar>, each: impl FnMut(Scalar)) {
        [output.q.shoulder, output.q.elbow, output.v.shoulder, output.v.elbow].into_iter().for_each(each);
    }
}
