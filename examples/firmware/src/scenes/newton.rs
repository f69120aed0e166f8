//! A loop without a formula: Newton's method in every evaluation.

use multibody::Rk4;

use super::{Draw, Random, Scene};
use crate::Scalar;
use crate::models::spatial_four_bar::{Model, State};

/// One step of a millisecond.
#[derive(Default)]
pub struct Newton(Model<Scalar>);

impl Scene for Newton {
    type Input = State<Scalar>;
    type Output = State<Scalar>;
    const NAME: &'static str = "spatial four-bar by Newton's method, RK4 step";

    #[inline(never)]
    fn call(&self, input: &State<Scalar>) -> State<Scalar> {
        Rk4::step(&self.0, 0.0, input, &(), 1e-3)
    }
    fn start(&self) -> State<Scalar> {
        let mut state = State::default();
        state.v.shaft = 3.0;
        state
    }
    fn next(&self, _input: &State<Scalar>, output: &State<Scalar>) -> State<Scalar> {
        *output
    }
    fn random(&self, random: &mut Random, coordinate: Draw) -> State<Scalar> {
        let mut state = State::default();
        (state.q.shaft, state.v.shaft) = (coordinate(random), random.within(10.0));
        state
    }
    fn numbers(output: &State<Scalar>, each: impl FnMut(Scalar)) {
        [output.q.shaft, output.v.shaft].into_iter().for_each(each);
    }
}
