//! A disc that rolls, in speeds that are no rates of its coordinates: q' = N(q) u.

use multibody::Rk4;

use super::{Draw, Random, Scene};
use crate::Scalar;
use crate::models::rolling_disc::{Model, State};

/// One step of a millisecond.
#[derive(Default)]
pub struct Rolling(Model<Scalar>);

impl Scene for Rolling {
    type Input = State<Scalar>;
    type Output = State<Scalar>;
    const NAME: &'static str = "rolling disc in speeds, RK4 step";

    #[inline(never)]
    fn call(&self, input: &State<Scalar>) -> State<Scalar> {
        Rk4::step(&self.0, 0.0, input, &(), 1e-3)
    }
    /// Leaning, and faster than what it takes to stay up: it wobbles along an arc.
    fn start(&self) -> State<Scalar> {
        let mut state = State::default();
        state.q.lean = 0.2;
        (state.v.tip, state.v.roll, state.v.swerve) = (0.3, 12.0, 0.5);
        state
    }
    fn next(&self, _input: &State<Scalar>, output: &State<Scalar>) -> State<Scalar> {
        *output
    }
    fn random(&self, random: &mut Random, coordinate: Draw) -> State<Scalar> {
        let mut state = State::default();
        (state.q.x, state.q.y) = (random.within(10.0), random.within(10.0));
        (state.q.yaw, state.q.lean, state.q.spin) = (coordinate(random), coordinate(random), coordinate(random));
        (state.v.tip, state.v.roll, state.v.swerve) = (random.within(10.0), random.within(10.0), random.within(10.0));
        state
    }
    fn numbers(output: &State<Scalar>, each: impl FnMut(Scalar)) {
        let State { q, v } = output;
        [q.x, q.y, q.yaw, q.lean, q.spin, v.tip, v.roll, v.swerve].into_iter().for_each(each);
    }
}
