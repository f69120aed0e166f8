//! Generated models in the solvers of the crate `diffsol`, for people who already use it: a double pendulum by its explicit
//! Runge-Kutta method, a stiff governor by its backward differentiation formulas with the exact Jacobian; and that they
//! agree with this project's own integrators.
//!
//! `cargo run --release` in `examples/diffsol`
//!
//! diffsol wants rates of one vector as a function on slices, and for implicit methods the product of their Jacobian with
//! a vector. Here the vector is (q, v), so the product is (dv, A dq + B dv) with the blocks A and B of
//! `forward_derivatives`.

mod models;

use diffsol::{NalgebraLU, NalgebraMat, OdeBuilder, OdeSolverMethod, VectorCommon};
use multibody::nalgebra::{SVector, SVectorView};
use multibody::{Dop853, Integrator, Radau};

use models::{double_pendulum, governor};

/// What all runs are asked for.
const TOLERANCE: f64 = 1e-9;

/// Error of a vector, relative to one more than its greatest entry.
fn apart<const N: usize>(a: &SVector<f64, N>, b: &SVector<f64, N>) -> f64 {
    (a - b).amax() / (1.0 + b.amax())
}

/// `(q, v)` of a slice.
fn halves<const N: usize>(slice: &[f64]) -> [SVector<f64, N>; 2] {
    let (q, v) = slice.split_at(N);
    [q, v].map(|half| SVectorView::<f64, N>::from_slice(half).into_owned())
}

/// Rates and Jacobian products of a model with `N` coordinates, all of them in a vector.
macro_rules! functions {
    ($module:ident, $n:literal) => {{
        let state = |x: &[f64]| {
            let [q, v] = halves::<$n>(x);
            $module::State { q: q.into(), v: v.into() }
        };
        let rates = move |x: &[f64], _p: &[f64], t: f64, y: &mut [f64]| {
            let state = state(x);
            let accelerations = $module::Model::<f64>::default().forward_dynamics(t, &state, &());
            y[..$n].copy_from_slice(&x[$n..]);
            y[$n..].copy_from_slice(SVector::<f64, $n>::from(accelerations).as_slice());
        };
        let product = move |x: &[f64], _p: &[f64], t: f64, d: &[f64], y: &mut [f64]| {
            let by = $module::Model::<f64>::default().forward_derivatives(t, &state(x), &());
            let [dq, dv] = halves::<$n>(d);
            y[..$n].copy_from_slice(&d[$n..]);
            y[$n..].copy_from_slice((by.position * dq + by.velocity * dv).as_slice());
        };
        (rates, product)
    }};
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("Relative differences at the end, tolerances of {TOLERANCE:.0e}:\n");
    pendulum()?;
    stiff()?;
    Ok(())
}

fn pendulum() -> Result<(), Box<dyn std::error::Error>> {
    let start = double_pendulum::State { q: SVector::from([0.5, 0.3]).into(), v: Default::default() };
    let q: SVector<f64, 2> = start.q.into();
    let (rates, product) = functions!(double_pendulum, 2);
    let problem = OdeBuilder::<NalgebraMat<f64>>::new()
        .rtol(TOLERANCE)
        .atol([TOLERANCE])
        .rhs_implicit(rates, product)
        .init(move |_p, _t, y| y.copy_from_slice(&[q[0], q[1], 0.0, 0.0]), 4)
        .build()?;
    let mut solver = problem.tsit45()?;
    solver.solve(10.0)?;
    let [q, v] = halves::<2>(solver.state().y.inner().as_slice());

    let own = Integrator::adaptive(Dop853, TOLERANCE, TOLERANCE);
    let model = double_pendulum::Model::<f64>::default();
    let (end, statistics) = own.integrate(&model, 0.0, 10.0, &start, &(), |_, _| ())?;
    let difference = apart(&q, &end.q.into()).max(apart(&v, &end.v.into()));
    println!(
        "  double pendulum, 10 s: {difference:.1e} between tsit45 and Dop853 ({} evaluations)",
        statistics.evaluations
    );
    assert!(difference < 1e-6);
    Ok(())
}

fn stiff() -> Result<(), Box<dyn std::error::Error>> {
    let mut start = governor::State { q: SVector::from([0.0, 0.3, 0.301, -0.382]).into(), v: Default::default() };
    start.v.shaft = 6.0;
    let [q, v]: [SVector<f64, 4>; 2] = [start.q.into(), start.v.into()];
    let (rates, product) = functions!(governor, 4);
    let mut problem = OdeBuilder::<NalgebraMat<f64>>::new()
        .rtol(TOLERANCE)
        .atol([TOLERANCE])
        .rhs_implicit(rates, product)
        .init(
            move |_p, _t, y| {
                y[..4].copy_from_slice(q.as_slice());
                y[4..].copy_from_slice(v.as_slice());
            },
            8,
        )
        .build()?;
    // Its Newton iterations give up now and then, which only shortens a step; it bounds their number over the whole motion.
    problem.ode_options.max_nonlinear_solver_failures = 1000;
    let mut solver = problem.bdf::<NalgebraLU<f64>>()?;
    solver.solve(2.0)?;
    let [q, v] = halves::<4>(solver.state().y.inner().as_slice());

    let own = Integrator::adaptive(Radau, TOLERANCE, TOLERANCE);
    let (end, statistics) = own.integrate(&governor::Model::<f64>::default(), 0.0, 2.0, &start, &(), |_, _| ())?;
    let difference = apart(&q, &end.q.into()).max(apart(&v, &end.v.into()));
    println!(
        "  stiff governor, 2 s:   {difference:.1e} between bdf and Radau ({} evaluations)",
        statistics.evaluations
    );
    assert!(difference < 1e-6);
    Ok(())
}
