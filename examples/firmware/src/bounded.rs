//! A step of one model of each kind in the examples, called with a state that the compiler does not know.
//!
//! Linked without a reachable panic or an allocator these steps cannot fail on any input; what iterates does so within
//! bounds: [`Projection::iterations`], and the model's own number of Newton's iterations. Other functions of a model, and
//! the formulations that are not named here, are not covered.

use core::hint::black_box;

use multibody::{Projection, Rk4};

use crate::Scalar;
use crate::models::{arm, cart, four_bar, hybrid, impacts, iterated, linkages, pendulum, reduced, squeezer};

/// One step of the classical Runge-Kutta method.
macro_rules! step {
    ($($model:path),+ $(,)?) => {{
        $({
            use $model as model;
            let state = black_box(model::State::<Scalar>::default());
            let input = black_box(Default::default());
            black_box(Rk4::step(&black_box(model::Model::<Scalar>::default()), 0.0, &state, &input, 1e-3));
        })+
    }};
}

/// One step, and then one projection onto the constraints.
macro_rules! project {
    ($($model:path),+ $(,)?) => {{
        $({
            use $model as model;
            let system = black_box(model::Model::<Scalar>::default());
            let state = black_box(model::State::<Scalar>::default());
            let input = black_box(Default::default());
            let next = Rk4::step(&system, 0.0, &state, &input, 1e-3);
            let _ = black_box(Projection::default().project(&system, 1e-3, &next));
        })+
    }};
}

/// Calls each.
pub fn all() {
    step!(pendulum::double_pendulum, cart::cart_pole, arm::panda, crate::models::crank::engine);
    step!(four_bar::free, linkages::parallel, impacts::pendulum, impacts::block, impacts::mount);
    step!(reduced, iterated);
    project!(linkages::redundant, squeezer::andrews, hybrid);
}
