//! NaN, infinity, denormals, zeros and the greatest numbers in times, states, parameters, inputs, steps and tolerances:
//! every public function gives a typed error or passes NaN on, and what ends without an error has a finite state. None
//! panics, none hangs: systems count what is asked of them. `extremes/numbers/list.rs` holds the list of functions against
//! what is called here.

mod bounded;
mod drawn;
mod lengths;
mod list;
#[path = "../../models/numbers.rs"]
mod models;
mod runtime;
mod searches;
mod steps;

use bounded::Bounded;
use drawn::{Drawn, Numbers, all};
use models::{kept, tree};
use multibody::nalgebra::SVector;
use multibody::simba::simd::{WideF32x8, WideF64x4};
use multibody::{Dop853, Radau, Rk4, System};
use multibody_tests::models::{
    assembled, energy, extremes, impulses, linearised, loops, mechanisms, motion, small, stiff,
};
use std::hint::black_box;

/// What one integration may ask of a system: four steps, a thousand places in each where functions of events are looked at,
/// and a crossing before each place, for which some hundred steps of the method are made.
const BOUND: u32 = 4 * 1000 * 16 * 400;

/// The least of each kind: an explicit method with and one without an estimate.
fn integrate<S: System<Scalar: Drawn>>(model: &S, state: &S::State, input: &S::Input, n: &Numbers) {
    let system = Bounded::new(model, BOUND);
    steps::method(Rk4, (&system, &system), (state, input), n);
    steps::method(Dop853, (&system, &system), (state, input), n);
}

/// Functions that every model of the list has.
macro_rules! torment {
    ($($name:ident: $module:path, $input:expr, [$($function:ident),*];)+) => {
        $(
            #[test]
            fn $name() {
                use $module as module;
                all(256, |n| {
                    let model = module::Model::<f64>::default();
                    let state: module::State = n.state();
                    let input = $input(n);
                    black_box(model.forward_dynamics(n.draw(), &state, &input));
                    $(torment!(@$function model, state, input, n);)*
                    integrate(&model, &state, &input, n);
                });
            }
        )+
    };
    (@inverse_dynamics $model:ident, $state:ident, $input:ident, $n:ident) => {
        black_box($model.inverse_dynamics($n.draw(), &$state, &$input, &$n.vector()))
    };
    (@mass_matrix $model:ident, $state:ident, $input:ident, $n:ident) => {
        black_box($model.mass_matrix(&$state.q))
    };
    (@bias $model:ident, $state:ident, $input:ident, $n:ident) => {
        black_box($model.bias($n.draw(), &$state, &$input))
    };
    (@energy $model:ident, $state:ident, $input:ident, $n:ident) => {
        black_box($model.kinetic_energy(&$state) + $model.potential_energy(&$state.q))
    };
    (@outputs $model:ident, $state:ident, $input:ident, $n:ident) => {
        black_box($model.outputs($n.draw(), &$state, &$input))
    };
    (@dead_centres $model:ident, $state:ident, $input:ident, $n:ident) => {
        black_box($model.dead_centres($n.draw(), &$state.q))
    };
    (@residual $model:ident, $state:ident, $input:ident, $n:ident) => {
        black_box($model.residual($n.draw(), &$state, &$input, &$n.vector(), &$n.vector::<f64, SVector<f64, _>>()))
    };
    (@kinematics $model:ident, $state:ident, $input:ident, $n:ident) => {
        black_box($model.kinematics($n.draw(), &$state, &$n.vector()))
    };
}

torment! {
    cart: small::cart_pole, |n: &Numbers| small::cart_pole::Input { push: n.draw() },
        [inverse_dynamics, mass_matrix, bias, energy];
    masses: motion::two_masses, |_| (), [inverse_dynamics, mass_matrix, bias, energy];
    body: motion::free_body, |_| (), [inverse_dynamics, mass_matrix, bias, energy];
    ball: motion::top, |_| (), [inverse_dynamics, mass_matrix, bias, energy];
    universal: motion::pendulum_on_universal, |_| (), [inverse_dynamics, mass_matrix, bias, energy, outputs];
    gimbals: extremes::gimballed, |_| (), [inverse_dynamics, mass_matrix, bias, energy, outputs, dead_centres];
    reduced: mechanisms::four_bar, |n: &Numbers| mechanisms::four_bar::Input { torque: n.draw() },
        [inverse_dynamics, mass_matrix, bias];
    newton: mechanisms::four_bar_newton, |n: &Numbers| mechanisms::four_bar_newton::Input { torque: n.draw() },
        [inverse_dynamics, bias];
    multipliers: mechanisms::four_bar_multipliers,
        |n: &Numbers| mechanisms::four_bar_multipliers::Input { torque: n.draw() }, [inverse_dynamics, residual];
    spatial: mechanisms::spatial_multipliers,
        |n: &Numbers| mechanisms::spatial_multipliers::Input { torque: n.draw() }, [inverse_dynamics, residual];
    slider_crank: loops::rrp_right, |_| (), [inverse_dynamics, kinematics];
}

#[test]
fn assemblies() {
    all(256, |n| {
        let (circles, sides) =
            (n.state::<assembled::octahedron::State>(), n.state::<assembled::three_two_one::State>());
        black_box(assembled::octahedron::Model::<f64>::default().assembly_modes(n.draw(), &circles.q));
        black_box(assembled::three_two_one::Model::<f64>::default().assembly_modes(n.draw(), &sides.q));
    });
}

#[test]
fn parameters() {
    all(256, |n| {
        let array = || [n.draw(), n.draw(), n.draw()];
        let params = motion::free_body::Params { m: n.draw(), i: array() };
        let checked = params.check();
        let model = motion::free_body::Model::new(&params);
        let state: motion::free_body::State = n.state();
        integrate(&model, &state, &(), n);
        if checked.is_ok() {
            assert!(params.m >= 0.0 && params.m.is_finite(), "{params:?}");
        }
        let params = motion::two_masses::Params { g: n.draw(), m1: n.draw(), m2: n.draw(), l1: n.draw(), l2: n.draw() };
        let _ = black_box(params.check().is_ok());
        integrate(&motion::two_masses::Model::new(&params), &n.state(), &(), n);
    });
}

/// A tree with all of its functions and all methods, in any scalar.
fn tree_in<T: Drawn>(n: &Numbers) {
    let params = tree::Params { m: n.scalar(), stiffness: n.scalar() };
    let _ = black_box(params.check().is_ok());
    for model in [tree::Model::<T>::default(), tree::Model::new(&params)] {
        let (state, t): (tree::State<T>, T) = (n.state(), n.scalar());
        let input = tree::Input { torque: n.scalar() };
        let asked = n.vector();
        black_box(model.forward_dynamics(t, &state, &input));
        black_box(model.inverse_dynamics(t, &state, &input, &asked));
        black_box(model.mass_matrix(&state.q));
        black_box(model.bias(t, &state, &input));
        black_box(model.kinetic_energy(&state) + model.potential_energy(&state.q));
        black_box(model.outputs(t, &state, &input));
        black_box(model.impulse(&state.q, &asked));
        let derivatives = model.forward_derivatives(t, &state, &input);
        black_box(derivatives.jacobian().rates);
        black_box(derivatives.jacobian_at(&[3, 99, 0]).position);
        black_box(derivatives.along_input(&[n.scalar()]));
        black_box(model.inverse_derivatives(t, &state, &input, &asked));
        black_box(model.linearize(t, &state, &input));
        black_box(tree::Position::normalized(SVector::from_fn(|_, _| n.scalar::<T>())));

        let system = Bounded::new(&model, BOUND);
        let start = (&state, &input);
        steps::method(Dop853, (&system, &system), start, n);
        steps::method(Radau, (&system, &system), start, n);
        searches::struck(&system, &state, n);
        searches::at_rest(&system, start, n);
    }
}

#[test]
fn tree_in_every_scalar() {
    all(128, tree_in::<f64>);
    all(128, tree_in::<f32>);
    all(64, tree_in::<WideF64x4>);
    all(64, tree_in::<WideF32x8>);
}

/// All methods on an open tree with a state of its own, and what else asks for its functions.
#[test]
fn methods_on_a_tree() {
    let most = std::cell::Cell::new(0);
    all(256, |n| {
        let (model, state) = (tree::Model::<f64>::default(), n.state());
        let (system, input) = (Bounded::new(&model, BOUND), tree::Input { torque: n.draw() });
        steps::any(&system, (&state, &input), n);
        steps::differentiable(&system, (&state, &input), n);
        most.set(system.most().max(most.get()));
    });
    println!("one integration asked at most {} times of {BOUND}", most.get());
}

#[test]
fn methods_in_momenta() {
    fn two_pendulums<T: Drawn>(n: &Numbers) {
        let (model, state): (energy::double_swing::Model<T>, energy::double_swing::State<T>) =
            (Default::default(), n.state());
        black_box(model.momentum(&state));
        black_box(model.momentum_rate(n.scalar(), &state, &()));
        black_box(model.velocity(&state.q, &n.vector()));
        steps::canonical(&Bounded::new(&model, BOUND), (&state, &()), n);
    }
    all(256, two_pendulums::<f64>);
    all(128, two_pendulums::<f32>);
    all(64, two_pendulums::<WideF64x4>);
    all(256, |n| {
        let (model, state) = (impulses::four_bar::Model::<f64>::default(), n.state());
        let system = Bounded::new(&model, BOUND);
        steps::canonical(&system, (&state, &Default::default()), n);
        searches::struck(&system, &state, n);
    });
}

#[test]
fn methods_on_separable_systems() {
    fn pendulum<T: Drawn>(n: &Numbers) {
        let (model, state) = (energy::swing::Model::<T>::default(), n.state());
        steps::separable(&Bounded::new(&model, BOUND), (&state, &()), n);
    }
    all(256, pendulum::<f64>);
    all(128, pendulum::<f32>);
    all(64, pendulum::<WideF64x4>);
    all(256, |n| {
        let (model, state) = (impulses::ball::Model::<f64>::default(), n.state());
        steps::separable(&Bounded::new(&model, BOUND), (&state, &()), n);
    });
}

#[test]
fn stiff_systems_and_iterated_loops() {
    all(256, |n| {
        let (model, state) = (stiff::governor::Model::<f64>::default(), n.state());
        let (system, input) = (Bounded::new(&model, BOUND), stiff::governor::Input { speed: n.draw() });
        steps::differentiable(&system, (&state, &input), n);
        searches::at_rest(&system, (&state, &input), n);
    });
    all(256, |n| {
        let (model, state): (linearised::iterated::Model<f64>, linearised::iterated::State<f64>) =
            (Default::default(), n.state());
        let (system, input) = (Bounded::new(&model, BOUND), linearised::iterated::Input { torque: n.draw() });
        black_box(model.close(n.draw(), &state).residual);
        steps::differentiable(&system, (&state, &input), n);
        searches::at_rest(&system, (&state, &input), n);
    });
}

/// Loops that keep their equations: all that keeps them closed.
#[test]
fn loops_kept() {
    all(256, |n| {
        let (model, state): (kept::Model<f64>, kept::State<f64>) = (Default::default(), n.state());
        let (t, input) = (n.draw(), kept::Input { torque: n.draw() });
        let asked = n.vector();
        black_box(model.forward_dynamics(t, &state, &input));
        black_box(model.inverse_dynamics(t, &state, &input, &asked));
        black_box(model.mass_matrix(&state.q));
        black_box(model.constraints(t, &state.q));
        black_box(model.constraint_jacobian(t, &state.q));
        black_box(model.constraint_rate(t, &state));
        black_box(model.constraint_bias(t, &state));
        black_box(model.residual(t, &state, &input, &asked, &n.vector::<f64, SVector<f64, _>>()));
        black_box(model.outputs(t, &state, &input));
        let (system, start) = (Bounded::new(&model, BOUND), (&state, &input));
        searches::closed(&system, start, n);
        searches::closed_by_mass(&system, start, n);
        searches::closed_implicitly(&system, start, n);
        searches::struck(&system, &state, n);
    });
    fn lanes<T: Drawn>(n: &Numbers) {
        let (model, state): (kept::Model<T>, kept::State<T>) = (Default::default(), n.state());
        let (system, input) = (Bounded::new(&model, BOUND), kept::Input { torque: n.scalar() });
        searches::closed(&system, (&state, &input), n);
    }
    all(32, lanes::<f32>);
    all(16, lanes::<WideF64x4>);
}

/// A hundred thousand steps are allowed.
#[test]
fn simulations() {
    all(12, |n| {
        let (model, state) = (stiff::governor::Model::<f64>::default(), n.state());
        let input = stiff::governor::Input { speed: n.draw() };
        steps::simulated(&Bounded::new(&model, 30_000_000), (&state, &input), n);
    });
}
