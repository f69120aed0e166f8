//! Two four-bars in five coordinates, brought back to where they are closed after each step.

use multibody::{Projection, Rk4};

use super::{Draw, Random, Scene};
use crate::Scalar;
use crate::models::linkages::redundant::{Model, Position, State, Velocity};

/// [`Projection::project`] of a state: between one iteration and as many as it may take.
#[derive(Default)]
pub struct Projected(Model<Scalar>);

impl Scene for Projected {
    type Input = State<Scalar>;
    type Output = State<Scalar>;
    const NAME: &'static str = "two four-bars, projection";

    #[inline(never)]
    fn call(&self, input: &State<Scalar>) -> State<Scalar> {
        match Projection::default().project(&self.0, 0.0, input) {
            Ok(projected) => projected.state,
            Err(_) => *input,
        }
    }
    fn start(&self) -> State<Scalar> {
        // It hangs and swings, away from the flat poses.
        let mut state = State::default();
        state.q.crank = -1.0;
        (state.q.middle, state.q.last) = (-1.0, -1.0);
        (state.q.coupler1, state.q.coupler2) = (1.0, 1.0);
        state.v.crank = 0.3;
        self.call(&state)
    }
    /// A step of a millisecond.
    fn next(&self, _input: &State<Scalar>, output: &State<Scalar>) -> State<Scalar> {
        Rk4::step(&self.0, 0.0, output, &(), 1e-3)
    }
    fn random(&self, random: &mut Random, coordinate: Draw) -> State<Scalar> {
        let mut draw = || coordinate(random);
        let q = Position { crank: draw(), middle: draw(), last: draw(), coupler1: draw(), coupler2: draw() };
        let mut draw = || random.within(10.0);
        let v = Velocity { crank: draw(), middle: draw(), last: draw(), coupler1: draw(), coupler2: draw() };
        State { q, v }
    }
    fn numbers(output: &State<Scalar>, each: impl FnMut(Scalar)) {
        let State { q, v } = output;
        let numbers =
            [[q.crank, q.middle, q.last, q.coupler1, q.coupler2], [v.crank, v.middle, v.last, v.coupler1, v.coupler2]];
        numbers.into_iter().flatten().for_each(each);
    }
}
