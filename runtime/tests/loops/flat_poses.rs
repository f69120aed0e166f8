//! A parallelogram with its equations falls through flat poses, where another motion crosses its own, that of the
//! anti-parallelogram. Every run goes on as it came, or says that it can't tell; none turns off and returns `Ok`.
//! The truth is the same mechanism reduced to one coordinate, which knows no other motion.

use multibody::{
    Dop853, DormandPrince, IntegrationError, Integrator, Projection, Rk4, SemiImplicitEuler, WithBaumgarte,
    WithProjection, multibody,
};

macro_rules! bars {
    ($($name:ident { $($form:tt)* })*) => {
        multibody! {
            $(
                pub mod $name {
                    world { gravity: -9.81 * Y }
                    body a { mass: 0.3, com: 0.2 * X, inertia: rod(0.3, 0.4, X) }
                    body b { mass: 0.3, com: 0.2 * X, inertia: rod(0.3, 0.4, X) }
                    body c { mass: 0.1, com: [0.03, 0.02, 0], inertia: diag(1e-4, 1e-4, 1e-4) }
                    joint p: Revolute { parent: ground, child: a, axis: Z }
                    joint q: Revolute { parent: ground.at(0.06 * X), child: b, axis: Z }
                    joint r: Revolute { parent: a.at(0.4 * X), child: c, axis: Z }
                    #[cut]
                    joint s: Revolute { parent: b.at(0.4 * X), child: c.at(0.06 * X), axis: Z }
                    $($form)*
                }
            )*
        }
    };
}
bars! {
    kept { formulation { constraints: Multipliers } emit forward_dynamics, derivatives; }
    reduced { formulation { constraints: Reduced } solve (q, r) = (p, -p); }
}

multibody! {
    /// Three equal bars, the last one's length a parameter: four equations of which three are independent wherever they hold.
    pub mod thrice {
        /// [m]
        param length = 0.4;
        world { gravity: -9.81 * Y }
        body a { mass: 0.3, com: 0.2 * X, inertia: rod(0.3, 0.4, X) }
        body b { mass: 0.3, com: 0.2 * X, inertia: rod(0.3, 0.4, X) }
        body d { mass: 0.3, com: 0.2 * X, inertia: rod(0.3, 0.4, X) }
        body c { mass: 0.1, com: [0.03, 0.02, 0], inertia: diag(1e-4, 1e-4, 1e-4) }
        joint p: Revolute { parent: ground, child: a, axis: Z }
        joint q: Revolute { parent: ground.at(0.3 * X), child: b, axis: Z }
        joint o: Revolute { parent: ground.at(0.6 * X), child: d, axis: Z }
        joint r: Revolute { parent: a.at(0.4 * X), child: c, axis: Z }
        #[cut]
        joint s: Revolute { parent: b.at(0.4 * X), child: c.at(0.3 * X), axis: Z }
        #[cut]
        joint u: Revolute { parent: d.at(length * X), child: c.at(0.6 * X), axis: Z }
        formulation { constraints: Multipliers }
        /// [J]
        output energy = kinetic() + potential();
    }
}

const END: f64 = 0.8;

/// Rates at the start, with the angle at the end.
fn truths() -> Vec<(f64, f64)> {
    let integrator = Integrator::adaptive(Dop853, 1e-11, 1e-11);
    let fall = |k: u32| {
        let rate = -0.25 * f64::from(k);
        let start = reduced::State { q: reduced::Position { p: 1.2 }, v: reduced::Velocity { p: rate } };
        let (end, _) = integrator.integrate(&reduced::Model::default(), 0.0, END, &start, &(), |_, _| ()).unwrap();
        (rate, end.q.p)
    };
    (0..16).map(fall).collect()
}

/// How runs ended.
#[derive(Debug, Default)]
struct Tally {
    right: u32,
    told: u32,
}

/// Counts the runs that end within `near` of the truth, and those that say that they can't tell. No other end is allowed.
macro_rules! tally {
    ($t:ty, $integrator:expr, $near:expr, $wrap:expr) => {{
        let model = kept::Model::<$t>::default();
        let mut tally = Tally::default();
        for (rate, truth) in truths() {
            let v = rate as $t;
            let start = kept::State::<$t> {
                q: kept::Position { p: 1.2, q: 1.2, r: -1.2 },
                v: kept::Velocity { p: v, q: v, r: -v },
            };
            match $integrator.integrate(&$wrap(&model), 0.0, END, &start, &(), |_, _| ()) {
                Ok((end, statistics)) => {
                    let off = (f64::from(end.q.p) - truth).abs();
                    assert!(
                        off < $near,
                        "{} from {rate} rad/s: off by {off:.1e} rad, {statistics:?}",
                        stringify!($integrator)
                    );
                    tally.right += 1;
                }
                Err(IntegrationError::Ambiguous { time }) => {
                    assert!(time > 0.1 && time < END, "at {time}");
                    tally.told += 1;
                }
                Err(other) => panic!("{}: {other}", stringify!($integrator)),
            }
        }
        println!("{}, {}: {tally:?}", stringify!($integrator), stringify!($wrap));
        tally
    }};
}

/// With a projection to the default tolerance.
fn projected<S: multibody::Constrained>(model: S) -> WithProjection<S> {
    WithProjection::new(model, Projection::default())
}

fn loosely<S: multibody::Constrained>(model: S) -> WithProjection<S> {
    WithProjection::new(model, Projection { tolerance: 1e-6, ..Projection::default() })
}

/// By two corrections whatever the numbers.
fn twice<S: multibody::Constrained>(model: S) -> WithProjection<S> {
    WithProjection::fixed(model, Projection { iterations: 2, ..Projection::default() })
}

fn pulled<S: multibody::Constrained>(model: S) -> WithBaumgarte<S, multibody::projection::Plain> {
    WithBaumgarte::plain(model, 10.0)
}

fn bare<S>(model: S) -> S {
    model
}

#[test]
fn steps_chosen_by_error_lead_over_flat_poses() {
    let mut told = 0;
    for tolerance in [1e-4, 1e-6, 1e-7, 1e-8] {
        let near = 300.0 * tolerance;
        told += tally!(f64, Integrator::adaptive(Dop853, tolerance, tolerance), near, projected).told;
        told += tally!(f64, Integrator::adaptive(DormandPrince, tolerance, tolerance), near, projected).told;
    }
    assert_eq!(told, 0);
}

#[test]
fn what_rounding_would_decide_is_told() {
    // Errors near the pose are rounding, which no step makes less.
    let tally = tally!(f64, Integrator::adaptive(Dop853, 1e-11, 1e-11), 1e-6, projected);
    assert!(tally.right >= 8, "{tally:?}");
    let mut right = [0; 5];
    for tolerance in [1e-3, 1e-4, 1e-5] {
        right[0] += tally!(f32, Integrator::adaptive(Dop853, tolerance, tolerance), 0.1, projected).right;
        right[1] += tally!(f32, Integrator::adaptive(DormandPrince, tolerance, tolerance), 0.1, projected).right;
    }
    for tolerance in [1e-6, 1e-8, 1e-10] {
        right[2] += tally!(f64, Integrator::adaptive(DormandPrince, tolerance, tolerance), 1e-3, bare).right;
        right[3] += tally!(f64, Integrator::adaptive(DormandPrince, tolerance, tolerance), 1e-3, loosely).right;
        right[4] += tally!(f64, Integrator::adaptive(DormandPrince, tolerance, tolerance), 1e-3, pulled).right;
    }
    println!("right, of 48 each: {right:?}");
    assert!(right.iter().zip([4, 24, 24, 40, 24]).all(|(right, least)| *right >= least), "{right:?}");
}

#[test]
fn fixed_steps_lead_over_flat_poses() {
    for step in [1e-2, 1e-3, 1e-4] {
        assert_eq!(tally!(f64, Integrator::fixed(Rk4, step), 1e-4, projected).told, 0);
        assert_eq!(tally!(f64, Integrator::fixed(Dop853, step), 1e-4, projected).told, 0);
        tally!(f64, Integrator::fixed(SemiImplicitEuler, step), 5.0 * step, projected);
        assert!(tally!(f64, Integrator::fixed(Rk4, step), 1e-3, twice).right >= 8);
    }
}

/// Swings of the three bars far from their flat poses; their energy at the end beside that at the start.
macro_rules! swings {
    ($t:ty, $integrator:expr, $near:expr, $wrap:expr) => {{
        let model = thrice::Model::<$t>::default();
        for k in 0..8 {
            let angle = -0.6 - 0.05 * k as $t;
            let start = thrice::State::<$t> {
                q: thrice::Position { p: angle, q: angle, o: angle, r: -angle },
                v: thrice::Velocity::default(),
            };
            let run = $integrator.integrate(&$wrap(&model), 0.0, 3.0, &start, &(), |_, _| ());
            let (end, _) = run.unwrap_or_else(|error| panic!("{}, from {angle}: {error}", stringify!($wrap)));
            let energy = |state| model.outputs(0.0, state, &()).energy;
            let off = (energy(&end) - energy(&start)).abs();
            assert!(off < $near, "{}, {}: {off:.1e} J", stringify!($integrator), stringify!($wrap));
        }
    }};
}

#[test]
fn equations_that_repeat_others_where_loops_are_closed_tell_of_no_crossing() {
    for tolerance in [1e-5, 1e-8] {
        let near = 1e3 * tolerance;
        swings!(f64, Integrator::adaptive(DormandPrince, tolerance, tolerance), near, bare);
        swings!(f64, Integrator::adaptive(DormandPrince, tolerance, tolerance), near, pulled);
        swings!(f64, Integrator::adaptive(DormandPrince, tolerance, tolerance), near, projected);
        swings!(f64, Integrator::adaptive(Dop853, tolerance, tolerance), near, projected);
    }
    swings!(f64, Integrator::fixed(Rk4, 1e-3), 1e-6, projected);
    swings!(f32, Integrator::adaptive(DormandPrince, 1e-4, 1e-4), 1e-2, bare);
    swings!(f32, Integrator::fixed(Rk4, 1e-3), 1e-2, projected);
}
