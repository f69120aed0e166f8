//! A pole balanced on a cart by a law that is sampled at 1 kHz.

use super::{Draw, Random, Scene};
use crate::Scalar;
use crate::models::cart_pole::{Input, Model, State};
use multibody::{Real, Rk4};

/// The law, and one step of a millisecond with its push held.
#[derive(Default)]
pub struct CartPole(Model<Scalar>);

impl CartPole {
    /// [N] state feedback with all four poles of the upright pole's linear equations at -4/s, within what the motor can do.
    fn push(state: &State<Scalar>) -> Scalar {
        // track'' = a and hinge'' = (3 g / 2 l) (hinge + a / g): a = k . x by Ackermann's formula.
        const STIFFNESS: Scalar = 1.5 * 9.81 / 0.8;
        const RATE: Scalar = 1.5 / 0.8;
        const TRACK: Scalar = 256.0 / STIFFNESS;
        const TRAVEL: Scalar = 256.0 / STIFFNESS;
        const HINGE: Scalar = (96.0 + STIFFNESS + TRACK) / RATE;
        const TURN: Scalar = (16.0 + TRAVEL) / RATE;
        let acceleration =
            TRACK * state.q.track + TRAVEL * state.v.track - HINGE * state.q.hinge - TURN * state.v.hinge;
        Real::max(Real::min(1.2 * acceleration, 20.0), -20.0)
    }
}

impl Scene for CartPole {
    type Input = State<Scalar>;
    type Output = State<Scalar>;
    const NAME: &'static str = "cart-pole, control and RK4 step";

    #[inline(never)]
    fn call(&self, input: &State<Scalar>) -> State<Scalar> {
        Rk4::step(&self.0, 0.0, input, &Input { push: Self::push(input) }, 1e-3)
    }
    fn start(&self) -> State<Scalar> {
        let mut state = State::default();
        (state.q.track, state.q.hinge) = (0.5, 0.3);
        state
    }
    fn next(&self, _input: &State<Scalar>, output: &State<Scalar>) -> State<Scalar> {
        *output
    }
    fn random(&self, random: &mut Random, coordinate: Draw) -> State<Scalar> {
        let mut state = State::default();
        (state.q.track, state.q.hinge) = (coordinate(random), coordinate(random));
        (state.v.track, state.v.hinge) = (random.within(10.0), random.within(10.0));
        state
    }
    fn numbers(output: &State<Scalar>, each: impl FnMut(Scalar)) {
        [output.q.track, output.q.hinge, output.v.track, output.v.hinge].into_iter().for_each(each);
    }
}
