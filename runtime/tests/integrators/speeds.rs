//! Systems whose velocities are speeds, not the rates of coordinates: all that runs systems runs them, and comes to the motion
//! of the same system with `q' = v`, or to one in closed form.

mod systems;

use core::marker::PhantomData;

use multibody::impact::{impact, impact_at_rate};
use multibody::integrators::{Action, Event, Events, Interval};
use multibody::nalgebra::{UnitQuaternion, Vector2, Vector3, Vector4};
use multibody::projection::{SeparateWeights, assemble_by};
use multibody::simba::simd::{SimdValue, WideF64x4};
use multibody::{
    Configuration, Constrained, Differentiable, Dop853, DormandPrince, Euler, Free, FullJacobian, GaussLegendre4,
    GaussLegendre6, ImplicitMidpoint, Integrator, Method, Projection, Radau, Real, Rk4, SemiImplicitEuler, System,
    WithBaumgarte, WithProjection, WithRank, ambiguity, closed_loop, constrained_equilibrium, equilibrium, sampled,
    simulate, simulate_lanes, simulate_stiff, trim, verify,
};

use crate::common::loops::{Coordinates, Rod};
use systems::{
    Angled, Bodily, Direct, Disc, Geared, Loaded, Misled, Skate, State, Tilted, Top, Turned, differences, state,
    turning, weights,
};

/// `[s]` start and length of most runs.
const START: f64 = 0.5;
const SPAN: f64 = 2.0;

/// A system with a start, and how far a state is from the true one after [`SPAN`].
struct Case<S: System, F> {
    name: &'static str,
    system: S,
    start: S::State,
    input: S::Input,
    error: F,
}

impl<S: System<Scalar = f64>, F: Fn(&S::State) -> f64> Case<S, F> {
    fn run<M: Method<S>>(&self, integrator: Integrator<M>) -> f64 {
        let run = integrator.integrate(&self.system, START, START + SPAN, &self.start, &self.input, |_, _| ());
        (self.error)(&run.unwrap().0)
    }

    /// The order seen between `steps` and twice as many is that of the method.
    fn order<M: Method<S>>(&self, method: M, steps: u32, bar: f64) {
        let [coarse, halved] = [steps, 2 * steps].map(|n| self.run(Integrator::fixed(method, SPAN / f64::from(n))));
        let (order, method) = (f64::from(M::ORDER), core::any::type_name::<M>());
        let seen = (coarse / halved).log2();
        println!("{}: {method}: order {seen:.3}, error {halved:.1e}", self.name);
        assert!(halved > 1e-13, "{halved} is rounding: the order cannot be seen");
        assert!((seen - order).abs() <= bar, "{}: {method} has order {seen}", self.name);
    }

    /// Within rounding of the truth, with given steps and with steps chosen by error.
    fn agrees<M: Method<S>>(&self, method: M, steps: u32) {
        let fixed = Integrator::fixed(method, SPAN / f64::from(steps));
        let mut errors = vec![self.run(fixed), self.run(fixed.compensated())];
        if M::ESTIMATE > 0 {
            errors.push(self.run(Integrator::adaptive(method, 1e-13, 1e-13)));
        }
        println!("{}: {}: errors {errors:?}", self.name, core::any::type_name::<M>());
        assert!(errors.iter().all(|&error| error < 1e-10), "{}: {errors:?}", self.name);
    }

    fn check(&self, [first, second, fourth, explicit, implicit, eighth]: [u32; 6])
    where
        S: Differentiable,
    {
        self.order(Euler, first, 0.1);
        self.order(SemiImplicitEuler, first, 0.1);
        self.order(ImplicitMidpoint, second, 0.1);
        self.order(Rk4, fourth, 0.2);
        self.order(GaussLegendre4, fourth, 0.2);
        self.order(DormandPrince, explicit, 0.5);
        self.order(Radau, implicit, 0.3);
        self.order(GaussLegendre6, implicit, 0.3);
        self.order(Dop853, eighth, 0.8);
        self.agrees(DormandPrince, 1000);
        self.agrees(Dop853, 200);
        self.agrees(GaussLegendre6, 400);
        self.agrees(Radau, 1000);
    }
}

/// The end of a motion with `q' = v`.
fn truth<S: System<Scalar = f64>>(system: &S, start: &S::State, input: &S::Input) -> S::State {
    Dop853::integrate(system, START, start, input, SPAN / 1000.0, 1000, |_, _| ()).unwrap()
}

const GEARED: Geared<f64> = Geared { clock: 1.0, damping: 0.2 };

/// A start of the pendulum, and of its twin.
fn swinging(system: &Geared<f64>, t: f64, q: f64, rate: f64) -> [State<f64, f64, f64>; 2] {
    [state(q, system.speed(t, q, rate)), state(q, rate)]
}

#[test]
fn pendulum_with_a_varying_gear() {
    let [start, twin] = swinging(&GEARED, START, 1.0, 0.5);
    let end = truth(&Direct(GEARED), &twin, &0.7);
    let speed = GEARED.speed(START + SPAN, end.q, end.u);
    let error = |x: &State<f64, f64, f64>| (x.q - end.q).abs().max((x.u - speed).abs());
    Case { name: "pendulum", system: GEARED, start, input: 0.7, error }.check([10_000, 500, 200, 200, 50, 25]);
}

fn bodily() -> Bodily<f64> {
    Bodily(Top { damping: 0.1 }, PhantomData)
}

fn loaded() -> Loaded<f64> {
    Loaded(Top { damping: 0.1 }, PhantomData)
}

/// Angles, and the angular velocity in body axes.
const ANGLES: Vector3<f64> = Vector3::new(0.3, -0.4, 0.9);
const SPIN: Vector3<f64> = Vector3::new(0.3, 0.8, -0.7);

#[test]
fn body_in_angles_with_its_angular_velocity() {
    // The columns of the matrix between them, from one rate each.
    let columns = [Vector3::x(), Vector3::y(), Vector3::z()].map(|rates| turning(&ANGLES, &rates)[0]);
    let matrix = multibody::nalgebra::Matrix3::from_columns(&columns);
    let rates = matrix.try_inverse().unwrap() * SPIN;
    let end = truth(&Angled(bodily().0), &state(ANGLES, rates), &());
    let spin = turning(&end.q, &end.u)[0];
    let error = |x: &State<f64, Vector3<f64>, Vector3<f64>>| (x.q - end.q).amax().max((x.u - spin).amax());
    Case { name: "angles", system: bodily(), start: state(ANGLES, SPIN), input: (), error }
        .check([5_000, 500, 100, 40, 20, 10]);
}

#[test]
fn body_on_a_quaternion_with_its_momentum() {
    let q = UnitQuaternion::from_euler_angles(ANGLES.x, ANGLES.y, ANGLES.z);
    let end = truth(&Turned(loaded().0), &state(q, SPIN), &());
    let inertia = Top::inertia::<f64>();
    let momentum = inertia * end.u;
    let error = |x: &State<f64, UnitQuaternion<f64>, Vector3<f64>>| {
        (x.q.as_ref().coords - end.q.as_ref().coords).amax().max((x.u - momentum).amax())
    };
    Case { name: "quaternion", system: loaded(), start: state(q, inertia * SPIN), input: (), error }
        .check([5_000, 500, 100, 40, 20, 10]);

    // It is the body of the other tests.
    let other = truth(&bodily(), &state(ANGLES, SPIN), &());
    let turn = UnitQuaternion::from_euler_angles(other.q.x, other.q.y, other.q.z);
    assert!((turn.as_ref().coords.abs() - end.q.as_ref().coords.abs()).amax() < 1e-11);
    let agreement = verify(&loaded(), &state(q, inertia * SPIN));
    assert!(agreement.worst() < 1e-14, "{agreement:?}");
}

/// Positions move with the new velocities.
#[test]
fn semi_implicit() {
    let [start, _] = swinging(&GEARED, START, 1.0, 0.5);
    let end = SemiImplicitEuler::step(&GEARED, START, &start, &0.7, 0.1);
    let u = start.u + 0.1 * GEARED.derivative(START, &start, &0.7).0;
    assert_eq!(end, state(start.q + 0.1 * GEARED.position_rates(START, &state(start.q, u)), u));
}

/// Where the disc rolls without damping: in a circle.
fn circle(start: &State<f64, Vector4<f64>, Vector2<f64>>, time: f64) -> Vector4<f64> {
    let (q, [turn, roll]) = (start.q, [start.u.x, start.u.y]);
    let ([s0, c0], heading) = ([q.z.sin(), q.z.cos()], q.z + turn * time);
    let radius = 0.5 * roll / turn;
    q + Vector4::new(radius * (heading.sin() - s0), -radius * (heading.cos() - c0), turn * time, roll * time)
}

const ROLLING: State<f64, Vector4<f64>, Vector2<f64>> =
    state(Vector4::new(0.1, -0.2, 0.3, 0.0), Vector2::new(1.7, 2.9));

#[test]
fn disc_that_rolls_in_a_circle() {
    let end = circle(&ROLLING, SPAN);
    let error = |x: &State<f64, Vector4<f64>, Vector2<f64>>| (x.q - end).amax().max((x.u - ROLLING.u).amax());
    let case = Case { name: "disc", system: Disc { damping: 0.0 }, start: ROLLING, input: Vector2::zeros(), error };
    case.order(Euler, 2000, 0.1);
    case.order(SemiImplicitEuler, 2000, 0.1);
    case.order(ImplicitMidpoint, 200, 0.1);
    case.order(Rk4, 40, 0.2);
    case.order(GaussLegendre4, 40, 0.2);
    case.order(Radau, 20, 0.3);
    case.order(GaussLegendre6, 20, 0.3);
    case.agrees(DormandPrince, 400);
    case.agrees(Dop853, 100);
    case.agrees(Radau, 400);
}

/// Rounding of a long run stays where it is summed up.
#[test]
fn compensated() {
    let steps = 100_000;
    let error = |compensated: bool| {
        let fixed = Integrator::fixed(Rk4, 1e-3);
        let fixed = if compensated { fixed.compensated() } else { fixed };
        let span = 1e-3 * f64::from(steps);
        let disc = Disc { damping: 0.0 };
        let (end, _) = fixed.integrate(&disc, 0.0, span, &ROLLING, &Vector2::zeros(), |_, _| ()).unwrap();
        (end.q - circle(&ROLLING, span)).amax()
    };
    let [plain, kept] = [false, true].map(error);
    println!("{plain:e} {kept:e}");
    assert!(kept < 1e-12 && kept < 0.2 * plain);
}

/// Jacobians written by hand are those that differences see.
#[test]
fn derivatives_of_the_systems() {
    fn check<S, const W: usize>(system: &S, x: &S::State, input: &S::Input)
    where
        S: Differentiable<Scalar = f64, Matrix = FullJacobian<[[f64; W]; W]>>,
    {
        let FullJacobian(exact) = system.jacobian(START, x, input);
        let seen: [[f64; W]; W] = differences(system, START, x, input);
        for (i, (exact, seen)) in exact.iter().zip(&seen).enumerate() {
            for (j, (exact, seen)) in exact.iter().zip(seen).enumerate() {
                assert!((exact - seen).abs() < 1e-8 * (1.0 + exact.abs()), "{i} {j}: {exact} and {seen}");
            }
        }
    }
    check(&GEARED, &swinging(&GEARED, START, 1.0, 0.5)[0], &0.7);
    check(&bodily(), &state(ANGLES, SPIN), &());
    check(&loaded(), &state(UnitQuaternion::from_euler_angles(0.3, -0.4, 0.9), SPIN), &());
    check(&Disc { damping: 0.3 }, &ROLLING, &Vector2::new(0.2, 0.4));
}

/// Radau's steps follow the motion and not the damping, with the exact derivatives and with no others.
#[test]
fn stiff_damping() {
    let pendulum = Geared { damping: 1e5, ..GEARED };
    let top = Bodily(Top { damping: 1e5 }, PhantomData);
    let spinning = Loaded(Top { damping: 1e5 }, PhantomData);
    let integrator = Integrator::adaptive(Radau, 1e-8, 1e-8);

    let [start, _] = swinging(&pendulum, 0.0, 1.0, 0.5);
    let (end, statistics) = integrator.integrate(&pendulum, 0.0, 20.0, &start, &0.7, |_, _| ()).unwrap();
    println!("{statistics:?}");
    assert!(statistics.accepted + statistics.rejected < 250 && statistics.evaluations < 3000, "{statistics:?}");
    // What is left is a slow creep, `q' = (moments) / damping`.
    assert!((end.q - 1.0).abs() < 1e-2 && simulate_stiff(&pendulum, 0.0, 20.0, &start, &0.7, 1e-6, |_, _| ()).is_ok());
    let slow = |damping: f64| {
        let system = Geared { damping, ..GEARED };
        let [start, twin] = swinging(&system, START, 1.0, 0.5);
        let fine = truth(&Direct(system), &twin, &0.7);
        let (end, _) = integrator.integrate(&system, START, START + SPAN, &start, &0.7, |_, _| ()).unwrap();
        (end.q - fine.q).abs()
    };
    assert!([10.0, 100.0, 400.0].into_iter().all(|damping| slow(damping) < 1e-7));

    let steps =
        |system: &Bodily<f64>| integrator.integrate(system, 0.0, 20.0, &state(ANGLES, SPIN), &(), |_, _| ()).unwrap().1;
    let seen = steps(&top);
    println!("{seen:?}");
    assert!(seen.accepted + seen.rejected < 100 && seen.evaluations < 1000, "{seen:?}");
    let q = UnitQuaternion::from_euler_angles(ANGLES.x, ANGLES.y, ANGLES.z);
    let start = state(q, Top::inertia::<f64>() * SPIN);
    let (end, seen) = integrator.integrate(&spinning, 0.0, 20.0, &start, &(), |_, _| ()).unwrap();
    println!("{seen:?}");
    assert!(seen.accepted + seen.rejected < 100 && seen.evaluations < 1000, "{seen:?}");
    let (other, _) = integrator.integrate(&top, 0.0, 20.0, &state(ANGLES, SPIN), &(), |_, _| ()).unwrap();
    let turn = UnitQuaternion::from_euler_angles(other.q.x, other.q.y, other.q.z);
    assert!(turn.angle_to(&end.q) < 1e-6);

    // With other derivatives iterations converge slowly or not at all.
    let mut taken = 0;
    let misled =
        integrator
            .max_steps(1000)
            .integrate(&Misled(top, 0.5), 0.0, 20.0, &state(ANGLES, SPIN), &(), |_, _| taken += 1);
    println!("{misled:?} {taken}");
    assert!(misled.is_err() || taken > 500);
}

/// States within steps are those of the twin, and so are the times at which a function crosses zero.
#[test]
fn dense_output_and_events() {
    struct Crossing(Vec<f64>);
    impl<S: System<Scalar = f64, State = State<f64, f64, f64>>> Events<S, 1> for Crossing {
        fn values(&self, _t: f64, x: &S::State) -> [f64; 1] {
            [x.q]
        }
        fn happened(&mut self, event: &Event, _x: &S::State) -> Action<S::State> {
            self.0.push(event.time);
            Action::Continue
        }
    }
    let [start, twin] = swinging(&GEARED, START, 1.0, 0.5);
    let times = || (0..=40).map(|k| START + 0.05 * f64::from(k));
    let tight = Integrator::adaptive(Dop853, 1e-13, 1e-13);
    let mut true_states = Vec::new();
    tight.sampled(&Direct(GEARED), START, START + SPAN, &twin, &0.7, times(), |_, x| true_states.push(*x)).unwrap();
    let mut true_times = Crossing(Vec::new());
    tight.with_events(&Direct(GEARED), START, START + SPAN, &twin, &0.7, &mut true_times, |_| ()).unwrap();
    assert!(true_times.0.len() > 1);

    macro_rules! check {
        ($($method:expr),*) => {$({
            let mut k = 0;
            let mut worst = 0.0_f64;
            let compare = |t: f64, x: &State<f64, f64, f64>| {
                let Some(truth) = true_states.get(k) else { return };
                let speed = GEARED.speed(t, truth.q, truth.u);
                worst = worst.max((x.q - truth.q).abs()).max((x.u - speed).abs());
                k += 1;
            };
            let integrator = $method;
            integrator.sampled(&GEARED, START, START + SPAN, &start, &0.7, times(), compare).unwrap();
            let mut crossings = Crossing(Vec::new());
            integrator.with_events(&GEARED, START, START + SPAN, &start, &0.7, &mut crossings, |_| ()).unwrap();
            assert_eq!(crossings.0.len(), true_times.0.len());
            let late = crossings.0.iter().zip(&true_times.0).map(|(t, truth)| (t - truth).abs()).fold(0.0, f64::max);
            println!("states {worst:e}, times {late:e}");
            assert!(worst < 1e-9 && late < 1e-10, "{worst:e} {late:e}");
        })*};
    }
    check!(
        Integrator::adaptive(DormandPrince, 1e-13, 1e-13),
        Integrator::adaptive(Dop853, 1e-13, 1e-13),
        Integrator::adaptive(Radau, 1e-13, 1e-13),
        Integrator::fixed(Rk4, 1e-3),
        Integrator::fixed(GaussLegendre4, 1e-3),
        Integrator::fixed(GaussLegendre6, 1e-2)
    );

    // Dense output of seventh order on rotations, at one long step.
    let q = UnitQuaternion::from_euler_angles(ANGLES.x, ANGLES.y, ANGLES.z);
    let start = state(q, Top::inertia::<f64>() * SPIN);
    let within = |length: f64| {
        let mut worst = 0.0_f64;
        let look = |interval: &Interval<'_, Loaded<f64>, Dop853>| {
            for c in [0.2, 0.5, 0.8] {
                let x = interval.share(c);
                let fine = Dop853::integrate(&loaded(), 0.0, &start, &(), 0.025 * c * length, 40, |_, _| ()).unwrap();
                worst = worst.max((x.q.as_ref().coords - fine.q.as_ref().coords).amax()).max((x.u - fine.u).amax());
            }
        };
        Integrator::fixed(Dop853, length).intervals(&loaded(), 0.0, length, &start, &(), look).unwrap();
        worst
    };
    let power = (within(0.4) / within(0.2)).log2();
    assert!((power - 8.0).abs() < 0.7, "{power}");
}

/// Each lane has the motion that it has alone; single precision has it to its own rounding.
#[test]
fn lanes_and_single_precision() {
    let angles = [0.1, 1.0, -2.0, 3.0];
    let lit = WideF64x4::lit;
    let system = Geared { clock: lit(1.0), damping: lit(0.2) };
    let q = WideF64x4::from(angles);
    let start = state(q, system.speed(lit(START), q, lit(0.5)));
    let ends = simulate_lanes(&system, START, START + SPAN, &start, &lit(0.7), 1e-12, |_, _| ()).unwrap();
    let stepped = Rk4::integrate(&system, lit(START), &start, &lit(0.7), lit(5e-4), 4000, |_, _| ()).unwrap();
    let gauss = GaussLegendre6::integrate(&system, lit(START), &start, &lit(0.7), lit(1e-2), 200, |_, _| ()).unwrap();
    for (lane, angle) in angles.into_iter().enumerate() {
        let [start, _] = swinging(&GEARED, START, angle, 0.5);
        let (alone, _) = simulate(&GEARED, START, START + SPAN, &start, &0.7, 1e-12, |_, _| ()).unwrap();
        for x in [&ends.state, &stepped, &gauss] {
            let error = (x.q.extract(lane) - alone.q).abs().max((x.u.extract(lane) - alone.u).abs());
            assert!(error < 1e-10, "{lane}: {error:e}");
        }
    }

    let single = Geared { clock: 1.0_f32, damping: 0.2 };
    let start = state(1.0_f32, single.speed(0.5, 1.0, 0.5));
    let [wide, _] = swinging(&GEARED, START, 1.0, 0.5);
    let (truth, _) = simulate(&GEARED, START, START + SPAN, &wide, &0.7, 1e-12, |_, _| ()).unwrap();
    let (end, _) = simulate(&single, START, START + SPAN, &start, &0.7, 1e-6, |_, _| ()).unwrap();
    let fixed = GaussLegendre4::integrate(&single, 0.5, &start, &0.7, 0.01, 200, |_, _| ()).unwrap();
    for x in [end, fixed] {
        assert!((f64::from(x.q) - truth.q).abs() < 2e-5 && (f64::from(x.u) - truth.u).abs() < 5e-5);
    }
}

/// A rod that swings, with a state off its constraints by some amount.
fn open(t: f64, by: f64) -> (Tilted, State<f64, Vector2<f64>, Vector2<f64>>) {
    let rod = Tilted::of(Rod { gravity: 9.81, stretch: 0.1 }, 1.0);
    let q = Vector2::new(0.8 + by, -0.6);
    let v = Vector2::new(0.6 + by, 0.8);
    let u = rod.speeds(t, &q, &v);
    (rod, state(q, u))
}

#[test]
fn projections_of_positions_and_of_speeds() {
    let projection = Projection::default();
    for by in [1e-9, 1e-3, 0.1] {
        let (system, x) = open(0.3, by);
        let closed = |x: &State<f64, Vector2<f64>, Vector2<f64>>| {
            system.constraints(0.3, &x.q).abs().max(system.constraint_rate(0.3, x).abs())
        };
        // By mass the coordinates do not matter. Speeds are kept while a position is closed, and not the rates.
        let plain = system.plain(0.3, &x);
        let twin = projection.project_by_mass(&system.rod, 0.3, &plain).unwrap().state.q;
        let rates = system.plain(0.3, &state(twin, x.u));
        let of_rates = Projection { position: false, ..projection };
        let twin = of_rates.project_by_mass(&system.rod, 0.3, &rates).unwrap().state;
        let found = projection.project_by_mass(&system, 0.3, &x).unwrap().state;
        let moved = system.plain(0.3, &found);
        assert!((moved.q - twin.q).amax() < 1e-14 && (moved.v - twin.v).amax() < 1e-14, "{by}: {moved:?} {twin:?}");
        // Displacements are those of the coordinates, whatever the speeds.
        let twin = projection.project(&system.rod, 0.3, &plain).unwrap();
        let found = projection.project(&system, 0.3, &x).unwrap();
        assert!((found.state.q - twin.state.q).amax() < 1e-14 && found.rank == 1.0 && closed(&found.state) < 1e-12);
        let held = SeparateWeights { position: weights([0.0, 1.0]), velocity: weights([1.0, 0.0]) };
        let found = projection.project_by(&held, &system, 0.3, &x).unwrap().state;
        assert!(found.q.x == x.q.x && found.u.y == x.u.y && closed(&found) < 1e-12);
        let fixed = Projection { iterations: 4, ..projection }.project_fixed_by(&held, &system, 0.3, &x).state;
        assert!((fixed.q - found.q).amax() < 1e-12 && (fixed.u - found.u).amax() < 1e-11);
        let assembled = assemble_by(&system, 0.3, &x, &held).unwrap().state;
        assert!(assembled.q.x == x.q.x && assembled.u.y == x.u.y && closed(&assembled) < 1e-12);
        assert_eq!(ambiguity(&system, 0.3, &found), 0.0);
    }
}

/// A coordinate that no speed opens is closed by a displacement, a speed that an equation forbids by velocities.
#[test]
fn blade_with_a_coordinate_and_a_speed_too_many() {
    let start = state(Vector4::new(0.0, 0.0, 1.0, 0.0), Vector3::new(1.5, 0.0, 0.7));
    let off = state(Vector4::new(0.0, 0.0, 1.2, 0.1), Vector3::new(1.5, 0.4, 0.7));
    let found = Projection::default().project(&Skate, 0.0, &off).unwrap();
    assert!((found.state.q.z.hypot(found.state.q.w) - 1.0).abs() < 1e-15 && found.state.u == start.u);
    assert!((found.state.q.w / found.state.q.z - 0.1 / 1.2).abs() < 1e-15 && found.rank == 1.0);

    let projected = WithProjection::new(&Skate, Projection::default());
    let drift = |x: &State<f64, Vector4<f64>, Vector3<f64>>| (x.q.z.hypot(x.q.w) - 1.0).abs();
    let free = Rk4::integrate(&Skate, 0.0, &start, &(), 0.1, 400, |_, _| ()).unwrap();
    let kept = Rk4::integrate(&projected, 0.0, &start, &(), 0.1, 400, |_, _| ()).unwrap();
    println!("{:e} {:e}", drift(&free), drift(&kept));
    assert!(drift(&free) > 1e-8 && drift(&kept) < 1e-15);
    let (end, _) =
        Integrator::adaptive(Dop853, 1e-12, 1e-12).integrate(&projected, 0.0, 3.0, &start, &(), |_, _| ()).unwrap();
    let (sin, cos) = 2.1_f64.sin_cos();
    let truth = Vector4::new(1.5 / 0.7 * sin, 1.5 / 0.7 * (1.0 - cos), cos, sin);
    assert!((end.q - truth).amax() < 1e-10 && end.u == start.u);
}

/// All handlings of constraints lead to the motion of the twin.
#[test]
fn constrained_motions() {
    let (system, start) = open(0.0, 0.0);
    let start = Projection::default().project_by_mass(&system, 0.0, &start).unwrap().state;
    let twin = system.plain(0.0, &start);
    let tight = || Integrator::adaptive(Dop853, 1e-12, 1e-12);
    let projected = WithProjection::new(&system.rod, Projection::default());
    let (truth, _) = tight().integrate(&projected, 0.0, 3.0, &twin, &(), |_, _| ()).unwrap();
    macro_rules! check {
        ($($name:literal $method:expr, $wrapper:expr;)*) => {$(
            let (end, _) = $method.integrate(&$wrapper, 0.0, 3.0, &start, &(), |_, _| ()).unwrap();
            let Coordinates { q, v } = system.plain(3.0, &end);
            let error = (q - truth.q).amax().max((v - truth.v).amax());
            println!("{}: {error:e}", $name);
            assert!(error < 1e-9, "{}: {error:e}", $name);
        )*};
    }
    check! {
        "plain" tight(), WithProjection::new(&system, Projection::default());
        "by mass" tight(), WithProjection::by_mass(&system, Projection::default());
        "fixed" tight(), WithProjection::fixed(&system, Projection { iterations: 2, ..Projection::default() });
        "rank" tight(), WithRank::new(WithProjection::new(&system, Projection::default()));
        "Baumgarte" tight(), WithBaumgarte::new(&system, 5.0);
        "Baumgarte, plain" tight(), WithBaumgarte::plain(&system, 5.0);
        "Radau" Integrator::adaptive(Radau, 1e-11, 1e-11), WithProjection::new(&system, Projection::default());
        "Radau, Baumgarte" Integrator::adaptive(Radau, 1e-11, 1e-11), WithBaumgarte::new(&system, 5.0);
        "Gauss" Integrator::fixed(GaussLegendre6, 1e-2), WithProjection::new(&system, Projection::default());
    }

    // What Baumgarte's method adds is differentiated to first order where the constraints hold.
    let rod = Tilted::of(Rod::rigid(), 0.0);
    let closed = state(start.q.normalize(), Vector2::zeros());
    let stiff = WithBaumgarte::plain(&rod, 1e4);
    let FullJacobian(exact) = stiff.jacobian(0.0, &closed, &());
    let seen: [[f64; 4]; 4] = differences(&stiff, 0.0, &closed, &());
    let far = exact.iter().flatten().zip(seen.iter().flatten()).map(|(a, b)| (a - b).abs() / (1e3 + b.abs()));
    assert!(far.fold(0.0, f64::max) < 1e-2, "{exact:?} {seen:?}");
}

#[test]
fn impacts_of_speeds() {
    let (system, start) = open(0.0, 0.0);
    let ratios = Tilted::ratios(&start.q);
    let along = Vector2::new(-0.6, -0.8);
    let twin = impact(&system.rod, 0.0, &system.plain(0.0, &start), &along, 0.5).unwrap();
    // The rate along a direction is the same number of the same motion.
    let rate = along.dot(&system.plain(0.0, &start).v);
    let found = impact_at_rate(&system, 0.0, &start, &along.component_div(&ratios), rate, 0.5).unwrap();
    assert!((found.impulse - twin.impulse).abs() < 1e-14 && (found.after - twin.after).abs() < 1e-14);
    assert!((system.plain(0.0, &found.state).v - twin.state.v).amax() < 1e-14 && found.impulse > 0.1);
}

#[test]
fn rest_and_steady_motion() {
    // No speed, and where the moment holds the weight; the clock stands.
    let system = Geared { clock: 0.0, damping: 0.2 };
    let rest = equilibrium(&system, 0.0, &state(0.2, 1.0), &3.0, &1.0).unwrap();
    assert!((9.81 * rest.state.q.sin() - 3.0).abs() < 1e-12 && rest.state.u == 0.0 && rest.rank == 1.0);
    let held = trim(&system, 0.0, &state(0.5, 0.0), &0.0, &Free { input: 1.0, ..Free::default() }).unwrap();
    assert!((held.input - 9.81 * 0.5_f64.sin()).abs() < 1e-12);

    // The top hangs.
    for found in [
        equilibrium(&bodily(), 0.0, &state(ANGLES, SPIN), &(), &weights([1.0, 1.0, 0.0])).unwrap().state.q,
        Vector3::from(<[f64; 3]>::from(
            equilibrium(
                &loaded(),
                0.0,
                &state(UnitQuaternion::from_euler_angles(0.3, -0.4, 0.9), SPIN),
                &(),
                &weights([1.0; 3]),
            )
            .unwrap()
            .state
            .q
            .euler_angles(),
        )),
    ] {
        let up = UnitQuaternion::from_euler_angles(found.x, found.y, found.z).inverse() * Vector3::z();
        assert!(up.cross(&Vector3::new(0.3, -0.6, 1.2)).amax() < 1e-12, "{found}");
    }

    // The disc goes on in its circle: what drives it, and how fast it goes for what drives it.
    let disc = Disc { damping: 0.3 };
    let driven = trim(&disc, 0.0, &ROLLING, &Vector2::zeros(), &Free { input: weights([1.0; 2]), ..Free::default() });
    let driven = driven.unwrap();
    assert!((driven.input - ROLLING.u * 0.3).amax() < 1e-13 && driven.state == ROLLING && driven.rank == 2.0);
    let moments = Vector2::new(0.6, -0.9);
    let free = Free { velocity: weights([1.0; 2]), ..Free::default() };
    let rolling = trim(&disc, 0.0, &ROLLING, &moments, &free).unwrap();
    assert!((rolling.state.u - moments / 0.3).amax() < 1e-12 && rolling.state.q == ROLLING.q);

    // The rod hangs, with its length kept.
    let rod = Tilted::of(Rod::rigid(), 0.0);
    let guess = state(Vector2::new(0.6, -0.9), Vector2::zeros());
    let hanging = constrained_equilibrium(&rod, 0.0, &guess, &(), &weights([1.0; 2])).unwrap();
    assert!((hanging.state.q - Vector2::new(0.0, -1.0)).amax() < 1e-9, "{hanging:?}");
}

/// Wrappers hand on how positions move, and the slope as one.
#[test]
fn wrappers() {
    fn check<S>(name: &str, wrapper: &S, rod: &Tilted, start: &S::State)
    where
        S: System<Scalar = f64, Input = ()>,
        S::State: multibody::StateSpace<Position = Vector2<f64>, Velocity = Vector2<f64>>,
    {
        use multibody::StateSpace;
        let (q, u, ()) = {
            let (q, u, _) = start.split();
            (q, u, ())
        };
        let rates = wrapper.position_rates(0.2, start);
        assert_eq!(rates, rod.position_rates(0.2, &state(q, u)), "{name}");
        let before = rod.slopes.get();
        let slope = wrapper.slope(0.2, start, &());
        assert_eq!(rod.slopes.get(), before + 1, "{name}");
        assert_eq!((slope.q, slope.v), (rates, wrapper.derivative(0.2, start, &()).0), "{name}");
        let _ = q.displace(&rates);
    }
    let (rod, start) = open(0.2, 1e-3);
    check("a reference", &&rod, &rod, &start);
    check("a projection", &WithProjection::new(&rod, Projection::default()), &rod, &start);
    check("a rank", &WithRank::new(&rod), &rod, &start);
    check("Baumgarte's method", &WithBaumgarte::new(&rod, 3.0), &rod, &start);
    check("a loop", &closed_loop(&rod, |_, _: &State<f64, _, _>| ()), &rod, &start);
    let held = sampled(&rod, 0.1, |_, _: &State<f64, _, _>, (): &mut ()| ());
    check("samples", &held, &rod, &held.start(0.0, &start, ()));
}
