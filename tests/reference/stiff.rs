//! The governor with stiff links: Radau's method against a solution of 20 digits (`data/motion/governor.json`, written by
//! `scripts/stiff.py` from equations of its own) and against explicit methods; its equilibria against closed forms.

use multibody::{Configuration, DormandPrince, Free, Integrator, Radau, Statistics, Tangent, equilibrium, trim};
use multibody_tests::models::stiff::governor::{Input, Model, Position, State, Velocity};
use multibody_tests::support::data::{array, list, number, read};

const SPEED: f64 = 9.0;

fn state(y: [f64; 8]) -> State {
    let [shaft, right_arm, left_arm, slide, w, w1, w2, vs] = y;
    State {
        q: Position { shaft, right_arm, left_arm, slide },
        v: Velocity { shaft: w, right_arm: w1, left_arm: w2, slide: vs },
    }
}

/// The greatest error of positions and of velocities at all points of the reference, and what it took.
fn run(tolerance: f64, implicit: bool) -> ([f64; 2], Statistics) {
    let reference = read("motion/governor");
    let points = list(&reference["points"]);
    let model = Model::default();
    let input = Input { speed: SPEED };
    let mut now = state(array(&points[0]["y"]));
    let (mut t, mut worst, mut total) = (0.0, [0.0_f64; 2], Statistics::default());
    for point in &points[1..] {
        let end = number(&point["t"]);
        let (next, statistics) = if implicit {
            Integrator::adaptive(Radau, tolerance, tolerance).integrate(&model, t, end, &now, &input, |_, _| ())
        } else {
            let explicit = Integrator::adaptive(DormandPrince, tolerance, tolerance).max_steps(1_000_000);
            explicit.integrate(&model, t, end, &now, &input, |_, _| ())
        }
        .unwrap();
        let exact = state(array(&point["y"]));
        let greatest = |worst: f64, e: f64| worst.max(e.abs());
        worst[0] = next.q.magnitude().add_scaled(-1.0, &exact.q.magnitude()).fold(worst[0], &mut { greatest });
        worst[1] = next.v.add_scaled(-1.0, &exact.v).fold(worst[1], &mut { greatest });
        total.evaluations += statistics.evaluations;
        total.jacobians += statistics.jacobians;
        total.factorisations += statistics.factorisations;
        total.accepted += statistics.accepted;
        total.rejected += statistics.rejected;
        (t, now) = (end, next);
    }
    (worst, total)
}

#[test]
fn against_twenty_digits() {
    for tolerance in [1e-4, 1e-6, 1e-8, 1e-10] {
        let ([position, velocity], took) = run(tolerance, true);
        println!("tolerance {tolerance:e}: {position:.2e} m or rad, {velocity:.2e} per second, {took:?}");
        assert!(position < 10.0 * tolerance && velocity < 1e3 * tolerance);
        assert!(took.accepted < 1500 && took.jacobians <= took.accepted);
    }
}

/// Stability, not accuracy, rules an explicit method: it takes a hundred times as many evaluations.
#[test]
fn against_an_explicit_method() {
    let (implicit, took) = run(1e-6, true);
    let (explicit, took_explicitly) = run(1e-6, false);
    println!("Radau {implicit:?} {took:?}\nDormand-Prince {explicit:?} {took_explicitly:?}");
    assert!(took_explicitly.evaluations > 100 * took.evaluations);
}

const FREE: Velocity = Velocity { shaft: 0.0, right_arm: 1.0, left_arm: 1.0, slide: 1.0 };

/// At rest arms and links hang straight down, the links bear the sleeve.
#[test]
fn hanging() {
    let guess = state([0.0, 0.3, 0.301, -0.382, 1.0, 0.0, 0.0, 0.0]);
    let all = Velocity { shaft: 1.0, ..FREE };
    let found = equilibrium(&Model::default(), 0.0, &guess, &Input { speed: 0.0 }, &all).unwrap();
    println!("{found:?}");
    let slide = -0.2 - (0.2 + 9.81 / 2e7);
    assert!(found.state.q.right_arm.abs() < 1e-13 && found.state.q.left_arm.abs() < 1e-13);
    assert!((found.state.q.slide - slide).abs() < 1e-15);
    assert_eq!((found.state.q.shaft, found.state.v, found.rank), (0.0, Velocity::default(), 3.0));
}

/// Angle of the arms and place of the sleeve at a speed, from the balance of forces and moments alone: a link at the
/// angle b bears `F = m g / (2 cos b)`, and an arm `m r l w^2 cos a = m g l sin a + F k sin(a + b)`.
fn balanced(speed: f64) -> (f64, f64) {
    let link = |arm: f64| {
        let mut angle = arm;
        let mut length = 0.2;
        for _ in 0..60 {
            length = 0.2 + 9.81 / (2.0 * angle.cos()) / 1e7;
            angle = (0.2 * arm.sin() / length).asin();
        }
        (angle, length)
    };
    let moment = |arm: f64| {
        let (angle, _) = link(arm);
        let force = 9.81 / (2.0 * angle.cos());
        0.5 * (0.05 + 0.3 * arm.sin()) * 0.3 * speed * speed * arm.cos()
            - 0.5 * 9.81 * 0.3 * arm.sin()
            - force * 0.2 * (arm + angle).sin()
    };
    let (mut low, mut high) = (0.0, 1.5);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if moment(middle) > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    let (angle, length) = link(low);
    (low, -0.2 * low.cos() - length * angle.cos())
}

/// Turning steadily: the speed of the shaft is given, arms, sleeve and the input of the drive are found.
#[test]
fn turning() {
    for speed in [3.0, 6.0, SPEED, 15.0] {
        let guess = state([0.7, 0.3, 0.301, -0.382, speed, 0.0, 0.0, 0.0]);
        let free = Free { position: FREE, velocity: Velocity::zero(), states: (), input: Input { speed: 1.0 } };
        let found = trim(&Model::default(), 0.0, &guess, &Input { speed: 1.0 }, &free).unwrap();
        let (arm, slide) = balanced(speed);
        let q = found.state.q;
        println!("{speed} rad/s: arms {} {} ({arm}), sleeve {} ({slide}), {found:?}", q.right_arm, q.left_arm, q.slide);
        assert!((q.right_arm - arm).abs() < 1e-9 && (q.left_arm - arm).abs() < 1e-9 && (q.slide - slide).abs() < 1e-9);
        assert!((found.input.speed - speed).abs() < 1e-12 && found.rank == 4.0);
    }
}
