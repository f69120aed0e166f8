//! The six forces that move a Stewart-Gough platform without turning it.

use multibody::nalgebra::Vector3;

use super::{Draw, Random, Scene};
use crate::Scalar;
use crate::models::level::{Input, Model, Position, State, Velocity};

/// One call of inverse dynamics, the plate level.
#[derive(Default)]
pub struct Stewart(Model<Scalar>);

/// A point of a motion.
#[derive(Clone, Copy)]
pub struct Point {
    state: State<Scalar>,
    accel: Velocity<Scalar>,
}

impl Point {
    /// The plate swings as on three springs about a point of its workspace.
    fn new(q: Vector3<Scalar>, v: Vector3<Scalar>) -> Self {
        let middle = Vector3::new(-1.5, 0.0, 1.0); // [m]
        let stiffness = Vector3::new(9.0, 12.0, 16.0); // [1/s^2]
        let accel = stiffness.component_mul(&(middle - q));
        Self {
            state: State { q: Position { platform: q }, v: Velocity { platform: v } },
            accel: Velocity { platform: accel },
        }
    }
}

impl Scene for Stewart {
    type Input = Point;
    type Output = [Scalar; 6];
    const NAME: &'static str = "Stewart platform, inverse dynamics, level";

    #[inline(never)]
    fn call(&self, input: &Point) -> [Scalar; 6] {
        let solved = self.0.inverse_dynamics(0.0, &input.state, &Input::default(), &input.accel);
        solved.input.legs.map(|leg| leg.thrust)
    }
    fn start(&self) -> Point {
        Point::new(Vector3::new(-1.3, 0.2, 1.2), Vector3::zeros())
    }
    fn next(&self, input: &Point, _output: &[Scalar; 6]) -> Point {
        let v = input.state.v.platform + input.accel.platform * 1e-3;
        Point::new(input.state.q.platform + v * 1e-3, v)
    }
    fn random(&self, random: &mut Random, coordinate: Draw) -> Point {
        let q = Vector3::from_fn(|_, _| coordinate(random));
        Point::new(q, Vector3::from_fn(|_, _| random.within(5.0)))
    }
    fn numbers(output: &[Scalar; 6], each: impl FnMut(Scalar)) {
        output.iter().copied().for_each(each);
    }
}
