//! NaN, infinity, denormals, zeros and the greatest numbers in times, states, parameters, inputs, steps and tolerances:
//! every public function gives a typed error or passes NaN on. None panics, none hangs: whatever goes on is bounded.

use multibody::nalgebra::{SVector, Vector3};
use multibody::{
    Configuration, Constrained, DormandPrince, Euler, Integrator, Method, Projection, Rk4, SemiImplicitEuler,
    StateSpace, System, Tangent, Tolerance, WithProjection, assemble, linear, rotation,
};
use multibody_tests::models::{extremes, loops, mechanisms, motion, small};
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};
use std::cell::Cell;
use std::hint::black_box;

/// Numbers drawn once, handed out again and again.
#[derive(Debug)]
struct Numbers {
    drawn: Vec<f64>,
    next: Cell<usize>,
}

impl Numbers {
    fn draw(&self) -> f64 {
        let k = self.next.get();
        self.next.set(k + 1);
        self.drawn[k % self.drawn.len()]
    }

    fn vector<V: Tangent<f64>>(&self) -> V {
        V::zero().map(&mut |_| self.draw())
    }

    fn state<Z: StateSpace<Scalar = f64> + Default>(&self) -> Z {
        let start = Z::default();
        let (q, _, _) = start.split();
        start.join(q.displace(&self.vector()), self.vector(), self.vector())
    }
}

fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => -10.0..10.0_f64,
        1 => Just(f64::NAN),
        1 => prop_oneof![Just(f64::INFINITY), Just(f64::NEG_INFINITY)],
        1 => prop_oneof![Just(f64::MAX), Just(-f64::MAX), Just(1e200), Just(-1e155)],
        1 => prop_oneof![Just(0.0), Just(-0.0)],
        1 => prop_oneof![Just(5e-324), Just(-1e-310), Just(f64::MIN_POSITIVE), Just(1e-200)],
    ]
}

/// Draws many sets of numbers.
fn all(cases: u32, check: impl Fn(&Numbers)) {
    let mut runner = TestRunner::new(Config { failure_persistence: None, cases, ..Config::default() });
    let sets = prop::collection::vec(number(), 67).prop_map(|drawn| Numbers { drawn, next: Cell::new(0) });
    runner
        .run(&sets, |numbers| {
            check(&numbers);
            Ok(())
        })
        .unwrap();
}

/// Any step, any tolerance, any time, with a bound on the steps.
fn integrate<S: System<Scalar = f64>>(system: &S, state: &S::State, input: &S::Input, numbers: &Numbers) {
    fn fixed<S: System<Scalar = f64>, M: Method<S>>(
        method: M,
        system: &S,
        state: &S::State,
        input: &S::Input,
        n: &Numbers,
    ) {
        let integrator = Integrator::fixed(method, n.draw()).max_steps(20);
        let outcome = integrator.integrate(system, n.draw(), n.draw(), state, input, |_, _| ());
        let _ = black_box(outcome.is_ok());
        let outcome = integrator.compensated().integrate(system, 0.0, 0.01, state, input, |_, _| ());
        let _ = black_box(outcome.is_ok());
    }
    fn adaptive<S: System<Scalar = f64>, M: Method<S>>(
        method: M,
        system: &S,
        state: &S::State,
        input: &S::Input,
        n: &Numbers,
    ) {
        let wild = Tolerance {
            first_step: n.draw(),
            min_step: n.draw(),
            max_step: n.draw(),
            ..Tolerance::new(n.draw(), n.draw())
        };
        for tolerance in [wild, Tolerance::new(1e-6, 1e-6)] {
            let integrator = Integrator::within(method, tolerance).max_steps(50);
            let outcome = integrator.intervals(system, n.draw(), n.draw(), state, input, |interval| {
                black_box(interval.at(n.draw()));
            });
            let _ = black_box(outcome.is_ok());
            let outcome = integrator.integrate(system, 0.0, 0.1, state, input, |_, _| ());
            let _ = black_box(outcome.is_ok());
        }
    }
    fixed(Euler, system, state, input, numbers);
    fixed(SemiImplicitEuler, system, state, input, numbers);
    fixed(Rk4, system, state, input, numbers);
    fixed(DormandPrince, system, state, input, numbers);
    adaptive(DormandPrince, system, state, input, numbers);
    black_box(Rk4::step(system, numbers.draw(), state, input, numbers.draw()).split().0.magnitude().len());
    let outcome = Rk4::integrate(system, numbers.draw(), state, input, numbers.draw(), 5, |_, _| ());
    let _ = black_box(outcome.is_ok());
}

/// Projection and assembly from any state with any settings.
fn close<S: Constrained<Scalar = f64>>(system: &S, state: &S::State, input: &S::Input, n: &Numbers) {
    let (q, _, _) = state.split();
    black_box(system.constraints(n.draw(), &q).len());
    black_box(system.constraint_rate(n.draw(), state).len());
    black_box(system.correction(n.draw(), &q, &n.vector(), &n.vector()).1);
    let wild = Projection { tolerance: n.draw(), iterations: 30, ..Projection::default() };
    for projection in [wild, Projection::default()] {
        let _ = black_box(projection.project(system, n.draw(), state).is_ok());
        let _ = black_box(projection.project_weighted(system, n.draw(), state, &n.vector()).is_ok());
        black_box(projection.project_fixed(system, n.draw(), state).residual);
        integrate(&WithProjection::new(system, projection), state, input, n);
    }
    let _ = black_box(assemble(system, n.draw(), state, &n.vector()).is_ok());
}

/// Functions that every model of the list has.
macro_rules! torment {
    ($($name:ident: $module:path, $input:expr, [$($function:ident),*] $(, $close:ident)?;)+) => {
        $(
            #[test]
            fn $name() {
                use $module as module;
                all(64, |n| {
                    let model = module::Model::<f64>::default();
                    let state: module::State = n.state();
                    let input = $input(n);
                    black_box(model.forward_dynamics(n.draw(), &state, &input));
                    $(torment!(@$function model, state, input, n);)*
                    integrate(&model, &state, &input, n);
                    $($close(&model, &state, &input, n);)?
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
        black_box($model.residual($n.draw(), &$state, &$input, &$n.vector(), &$n.vector::<SVector<f64, _>>()))
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
        |n: &Numbers| mechanisms::four_bar_multipliers::Input { torque: n.draw() }, [inverse_dynamics, residual], close;
    spatial: mechanisms::spatial_multipliers,
        |n: &Numbers| mechanisms::spatial_multipliers::Input { torque: n.draw() }, [inverse_dynamics, residual], close;
    slider_crank: loops::rrp_right, |_| (), [inverse_dynamics, kinematics];
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

#[test]
fn functions_of_the_runtime() {
    all(512, |n| {
        let row = || [n.draw(), n.draw(), n.draw()];
        let matrix = [row(), row(), row()];
        black_box(linear::solve(matrix, row()));
        black_box(linear::solve_symmetric(matrix, row()));
        let (d, v) = (Vector3::from(row()), Vector3::from(row()));
        black_box(rotation::dexp_inv(&d, &v));
        let q = rotation::displace(&rotation::normalized(n.draw(), n.draw(), n.draw(), n.draw()), &d);
        black_box(rotation::advance(&q, &d, &v));
        black_box(rotation::from_scaled_axis(&v));
    });
}
