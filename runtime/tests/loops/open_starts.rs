//! Motions that can't start: loops that are open, velocities that open them, parameters that don't fit. What counts is how
//! far a mechanism would have to move, in its own size.

use multibody::{Dop853, IntegrationError, Integrator, Projection, Rk4, multibody, simulate};

/// Four bars, closed by a rod and by a hinge.
macro_rules! bars {
    ($($name:ident $unit:literal;)*) => {
        multibody! {
            $(
                pub mod $name {
                    let unit = $unit;
                    world { gravity: -9.81 * unit * Y }
                    body crank { mass: 0.5, com: 0.2 * unit * X, inertia: rod(0.5, 0.4 * unit, X) }
                    body rocker { mass: 0.8, com: 0.4 * unit * X, inertia: rod(0.8, 0.8 * unit, X) }
                    body third { mass: 0.8, com: 0.4 * unit * X, inertia: rod(0.8, 0.9 * unit, X) }
                    body fourth { mass: 0.8, com: 0.4 * unit * X, inertia: rod(0.8, 0.9 * unit, X) }
                    joint a: Revolute { parent: ground, child: crank, axis: Z }
                    joint b: Revolute { parent: ground.at(unit * X), child: rocker, axis: Z }
                    joint c: Revolute { parent: crank.at(0.4 * unit * X), child: third, axis: Z }
                    joint d: Revolute { parent: rocker.at(0.8 * unit * X), child: fourth, axis: Z }
                    #[cut]
                    joint e: Revolute { parent: third.at(0.9 * unit * X), child: fourth.at(0.9 * unit * X), axis: Z }
                    constraint link: Rod { between: [crank.at(0.4 * unit * X), rocker.at(0.8 * unit * X)], length: unit }
                    formulation { constraints: Multipliers }
                }
            )*
        }
    };
}
bars! {
    millimetre 0.001;
    metre 1.0;
    kilometre 1000.0;
}

multibody! {
    /// Wheels on each other, coupled by their measured angles.
    pub mod measured {
        world { gravity: -9.81 * Y }
        body one { mass: 1.0, com: [0.1, 0.05, 0.0], inertia: diag(0.1, 0.2, 0.3), coordinates: Absolute(RollPitchYaw) }
        body two { mass: 2.0, com: [0.2, 0.0, 0.1], inertia: diag(0.2, 0.3, 0.4), coordinates: Absolute(Quaternion) }
        joint a: Revolute { parent: ground, child: one, axis: Z }
        joint b: Revolute { parent: one.at([0.7, 0.0, 0.1]), child: two, axis: [0.0, 0.3, 1.0] }
        constraint gear = a.angle + 2.0 * b.angle;
        force motor: Effort { joint: a, value: 40.0 }
        output place = [one.at(X).position, two.at(X).position, two.at(Y).position];
    }

    /// The same in relative coordinates.
    pub mod counted {
        world { gravity: -9.81 * Y }
        body one { mass: 1.0, com: [0.1, 0.05, 0.0], inertia: diag(0.1, 0.2, 0.3) }
        body two { mass: 2.0, com: [0.2, 0.0, 0.1], inertia: diag(0.2, 0.3, 0.4) }
        joint a: Revolute { parent: ground, child: one, axis: Z }
        joint b: Revolute { parent: one.at([0.7, 0.0, 0.1]), child: two, axis: [0.0, 0.3, 1.0] }
        constraint gear = a.angle + 2.0 * b.angle;
        force motor: Effort { joint: a, value: 40.0 }
        output place = [one.at(X).position, two.at(X).position, two.at(Y).position];
    }
}

multibody! {
    /// Bars of any size beside a flywheel, on a sledge.
    pub mod beside {
        param unit = 1.0;
        world { gravity: -9.81 * unit * Y }
        body sledge { mass: 1.0 }
        body crank { mass: 0.5, com: 0.2 * unit * X, inertia: rod(0.5, 0.4 * unit, X) }
        body rocker { mass: 0.8, com: 0.4 * unit * X, inertia: rod(0.8, 0.8 * unit, X) }
        body third { mass: 0.8, com: 0.4 * unit * X, inertia: rod(0.8, 0.9 * unit, X) }
        body fourth { mass: 0.8, com: 0.4 * unit * X, inertia: rod(0.8, 0.9 * unit, X) }
        body wheel { mass: 1.0, inertia: diag(0.1, 0.1, 0.2) }
        joint rail: Prismatic { parent: ground, child: sledge, axis: X }
        joint spin: Revolute { parent: ground, child: wheel, axis: Z }
        joint a: Revolute { parent: sledge, child: crank, axis: Z }
        joint b: Revolute { parent: sledge.at(unit * X), child: rocker, axis: Z }
        joint c: Revolute { parent: crank.at(0.4 * unit * X), child: third, axis: Z }
        joint d: Revolute { parent: rocker.at(0.8 * unit * X), child: fourth, axis: Z }
        #[cut]
        joint e: Revolute { parent: third.at(0.9 * unit * X), child: fourth.at(0.9 * unit * X), axis: Z }
        constraint link: Rod { between: [crank.at(0.4 * unit * X), rocker.at(0.8 * unit * X)], length: unit }
        formulation { constraints: Multipliers }
    }
}

/// Four bars with a guide on the rocker, which takes no freedom as long as it sits at the rocker's end.
macro_rules! cranks {
    ($($name:ident { $($items:tt)* })*) => {
        multibody! {
            $(
                pub mod $name {
                    param len = 0.5;
                    world { gravity: -9.81 * Y }
                    body crank { mass: 0.5, com: 0.25 * X, inertia: rod(0.5, 0.5, X) }
                    body coupler { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
                    body rocker { mass: 0.5, com: 0.25 * X, inertia: rod(0.5, 0.5, X) }
                    joint a: Revolute { parent: ground, child: crank, axis: Z }
                    joint b: Revolute { parent: crank.at(0.4 * X), child: coupler, axis: Z }
                    joint c: Revolute { parent: ground.at(X), child: rocker, axis: Z }
                    #[cut]
                    joint d: Revolute { parent: coupler.at(X), child: rocker.at(0.5 * X), axis: Z }
                    constraint guide = coupler.at(X).position.x - rocker.at(len * X).position.x;
                    $($items)*
                }
            )*
        }
    };
}
cranks! {
    cranks_solved {
        formulation { constraints: Reduced }
        solve (b, c) from d { sin(c.angle - a.angle - b.angle) > 0.0 }
    }
    cranks_iterated { formulation { constraints: Reduced, independent: [a] } }
    cranks_kept { formulation { constraints: Multipliers } }
}

multibody! {
    /// A slider of ten kilometres, closed by Newton's method.
    pub mod vast {
        let unit = 10000.0;
        body crank { mass: 0.5, com: 0.2 * unit * X, inertia: rod(0.5, 0.4 * unit, X) }
        body block { mass: 0.8 }
        joint a: Revolute { parent: ground, child: crank, axis: Z }
        joint rail: Prismatic { parent: ground.at(unit * X), child: block, axis: X }
        constraint link: Rod { between: [crank.at(0.4 * unit * X), block], length: unit }
        formulation { constraints: Reduced, independent: [a] }
    }
}

multibody! {
    /// A hinge that closes a loop in a plane only where a parameter is zero.
    pub mod tilted {
        param lift = 0.0;
        world { gravity: -9.81 * Y }
        body one { mass: 0.5, com: 0.25 * X, inertia: rod(0.5, 0.5, X) }
        body two { mass: 0.5, com: 0.25 * X, inertia: rod(0.5, 0.5, X) }
        joint a: Revolute { parent: ground, child: one, axis: Z }
        joint b: Revolute { parent: ground, child: two, axis: Z }
        constraint level = two.at(lift * Z).position.z;
        constraint gear = a.angle - b.angle;
    }
}

/// A start of the bars, found from a guess.
macro_rules! closed {
    ($name:ident, $scalar:ty) => {{
        let mut guess = $name::State::<$scalar>::default();
        (guess.q.a, guess.q.b, guess.q.c, guess.q.d) = (1.0, 1.7, 1.2, -2.5);
        guess.v.a = 0.7;
        let model = $name::Model::<$scalar>::default();
        let free = $name::Velocity { a: 0.0, b: 1.0, c: 1.0, d: 1.0 };
        let start = multibody::assemble(&model, 0.0, &guess, &free).expect("bars that close").state;
        (model, start)
    }};
}

macro_rules! starts_by_size {
    ($name:ident, $scalar:ty) => {{
        let (model, start) = closed!($name, $scalar);
        let run = |start: &$name::State<$scalar>| {
            Integrator::fixed(Rk4, 1e-3).integrate(&model, 0.0, 2e-3, start, &(), |_, _| ()).map(drop)
        };
        assert_eq!(run(&start), Ok(()));
        // Open by a hundredth of the mechanism, in the rod and in the hinge.
        for turn in [[0.0, 0.01, 0.0], [0.0, 0.0, 0.01]] {
            let mut open = start;
            open.q.b += turn[1];
            open.q.d += turn[2];
            let told = run(&open);
            let Err(IntegrationError::OpenLoops { residual, remedy, .. }) = told else { panic!("{told:?}") };
            assert!(residual > 1e-3 && residual < 0.1 && remedy.contains("assemble"), "{residual} {remedy}");
        }
        // Closed, but not for long.
        let mut fast = start;
        fast.v.b += 0.01;
        let told = run(&fast);
        let Err(IntegrationError::OpenVelocities { time, rate, remedy }) = told else { panic!("{told:?}") };
        assert!(time == 0.0 && rate > 1e-3 && rate < 0.1 && remedy.contains("assemble"), "{rate} {remedy}");
        assert!(told.unwrap_err().to_string().contains("velocities"));
        // At rest nothing opens.
        let rest = $name::State { v: $name::Velocity::default(), ..start };
        assert_eq!(run(&rest), Ok(()));
    }};
}

#[test]
fn a_start_is_judged_in_the_size_of_its_mechanism() {
    starts_by_size!(millimetre, f64);
    starts_by_size!(metre, f64);
    starts_by_size!(kilometre, f64);
    starts_by_size!(metre, f32);
}

macro_rules! starts_beside {
    ($scalar:ty, $sizes:expr) => {
        for unit in $sizes {
            let model = beside::Model::<$scalar>::new(&beside::Params { unit });
            let mut guess = beside::State::<$scalar>::default();
            (guess.q.a, guess.q.b, guess.q.c, guess.q.d, guess.v.a) = (1.0, 1.7, 1.2, -2.5, 0.7);
            let free = beside::Velocity { rail: 0.0, spin: 0.0, a: 0.0, b: 1.0, c: 1.0, d: 1.0 };
            let mut start = multibody::assemble(&model, 0.0, &guess, &free).expect("bars that close").state;
            let run = |start: &beside::State<$scalar>| {
                Integrator::fixed(Rk4, 1e-6).integrate(&model, 0.0, 2e-6, start, &(), |_, _| ()).map(drop)
            };
            assert_eq!(run(&start), Ok(()));
            // What else is fast or far makes no difference.
            (start.v.spin, start.v.rail) = (1e4, 1.0);
            assert_eq!(run(&start), Ok(()));
            let mut fast = start;
            fast.v.b += 0.05;
            let told = run(&fast);
            assert!(matches!(told, Err(IntegrationError::OpenVelocities { .. })), "{unit}: {told:?}");
            let mut open = start;
            (open.q.d, open.q.rail) = (start.q.d + 0.01, 1e4);
            let told = run(&open);
            assert!(matches!(told, Err(IntegrationError::OpenLoops { .. })), "{unit}: {told:?}");
            // Many turns on, and far away, it is closed as far as coordinates can tell.
            let turns = 1000.0 * (std::f64::consts::TAU as $scalar);
            let mut far = start;
            far.q.rail = 1e4;
            (far.q.a, far.q.b) = (start.q.a + turns, start.q.b - turns);
            assert_eq!(run(&far), Ok(()));
        }
    };
}

#[test]
fn a_start_is_judged_by_what_its_loops_read() {
    starts_beside!(f64, [1e-3, 1.0, 1e3]);
    starts_beside!(f32, [1.0]);
}

/// What Newton's method leaves is reported in the mechanism's size too.
#[test]
fn a_run_is_judged_in_the_size_of_its_mechanism() {
    let model = vast::Model::<f64>::default();
    let mut state = vast::State::<f64>::default();
    (state.q.a, state.guess.rail) = (0.7, 4000.0 + 10.0);
    let state = multibody::System::accepted(&model, 0.0, &state, &());
    let off = vast::State { guess: vast::Guess { rail: state.guess.rail + 10.0 }, ..state };
    let [closed, open] = [state, off].map(|state| multibody::System::margins(&model, 0.0, &state, &(), &mut |_| ()));
    assert!(closed < 1e-12 && open > 1e-4 && open < 1e-2, "{closed} {open}");
}

#[test]
fn projection_gives_a_start() {
    let (model, start) = closed!(metre, f64);
    let mut fast = start;
    fast.v.b += 0.01;
    let projected = Projection::default().project(&model, 0.0, &fast).unwrap().state;
    simulate(&model, 0.0, 0.01, &projected, &(), 1e-6, |_, _| ()).unwrap();
    let told = simulate(&model, 0.0, 0.01, &fast, &(), 1e-6, |_, _| ());
    assert!(matches!(told, Err(IntegrationError::OpenVelocities { .. })), "{told:?}");
}

/// Angles that are measured anew at every instant hold their coupling over turns.
#[test]
fn measured_couplings_go_round() {
    let integrator = Integrator::adaptive(Dop853, 1e-10, 1e-10);
    let truth = counted::Model::<f64>::default();
    let mut start = counted::State::<f64>::default();
    start.v.a = 2.0;
    let (end, _) = integrator.integrate(&truth, 0.0, 2.0, &start, &(), |_, _| ()).unwrap();
    assert!(end.q.a > 25.0, "{}", end.q.a);
    let expected = truth.outputs(2.0, &end, &()).place;

    let model = measured::Model::<f64>::default();
    let mut start = measured::State::<f64>::default();
    (start.q.two.position, start.v.one.orientation.yaw) = ([0.7, 0.0, 0.1].into(), 2.0);
    // The second turns by -1 rad/s about its axis against the first.
    let length = 1.09_f64.sqrt();
    let spin = [0.0, -0.3 / length, 2.0 - 1.0 / length];
    start.v.two.linear = [0.0, 2.0 * 0.7, 0.0].into();
    start.v.two.angular = spin.into();
    let system = multibody::WithProjection::new(&model, Projection::default());
    let (end, _) = integrator.integrate(&system, 0.0, 2.0, &start, &(), |_, _| ()).unwrap();
    let found = model.outputs(2.0, &end, &()).place;
    for (found, expected) in found.iter().zip(&expected) {
        assert!((found - expected).norm() < 1e-6, "{found} {expected}");
    }
}

/// A coupling of measured angles is closed by one of two poses that are half a turn apart.
#[test]
fn a_start_half_a_turn_off_is_open() {
    let model = measured::Model::<f64>::default();
    let mut start = measured::State::<f64>::default();
    start.q.two.position = [0.7, 0.0, 0.1].into();
    let integrator = Integrator::fixed(Rk4, 1e-3);
    integrator.integrate(&model, 0.0, 1e-2, &start, &(), |_, _| ()).unwrap();
    // b by a quarter: the coupling by a half.
    let axis = [0.0, 0.3 / 1.09_f64.sqrt(), 1.0 / 1.09_f64.sqrt()];
    let half = std::f64::consts::FRAC_PI_4;
    let [x, y, z] = axis.map(|part| part * half.sin());
    let turned = multibody::nalgebra::Quaternion::new(half.cos(), x, y, z);
    start.q.two.orientation = multibody::nalgebra::UnitQuaternion::from_quaternion(turned);
    let told = integrator.integrate(&model, 0.0, 1e-2, &start, &(), |_, _| ());
    let Err(IntegrationError::OpenLoops { residual, .. }) = told else { panic!("{told:?}") };
    assert!(residual > 0.5, "{residual}");
}

macro_rules! unfit {
    ($name:ident, $start:expr, $param:ident = $value:literal, $what:literal) => {{
        let start = $start;
        let run = |params: $name::Params<f64>| {
            let model = $name::Model::new(&params);
            Integrator::fixed(Rk4, 1e-3).integrate(&model, 0.0, 1e-2, &start, &(), |_, _| ()).map(drop)
        };
        let declared = $name::Params::<f64>::default();
        assert_eq!((declared.check(), run(declared)), (Ok(()), Ok(())));
        let other = $name::Params { $param: $value };
        let told = run(other);
        let Err(IntegrationError::UnfitParameters { equation, residual, .. }) = told else { panic!("{told:?}") };
        assert!(equation == $what && residual > 1e-3 && residual < 1.0, "{equation} {residual}");
        let told = other.check().unwrap_err().to_string();
        assert!(told.contains(concat!("`", $what, "`")), "{told}");
    }};
}

#[test]
fn parameters_that_do_not_fit_are_told() {
    let mut solved = cranks_solved::State::<f64>::default();
    (solved.q.a, solved.v.a) = (0.7, 0.3);
    unfit!(cranks_solved, solved, len = 0.51, "guide");

    let mut iterated = cranks_iterated::State::<f64>::default();
    (iterated.q.a, iterated.v.a) = (0.7, 0.3);
    (iterated.guess.b, iterated.guess.c) = (-0.5, 1.0);
    unfit!(cranks_iterated, iterated, len = 0.51, "guide");

    unfit!(tilted, tilted::State::<f64>::default(), lift = 0.01, "level");

    // With multipliers no start closes it.
    let mut kept = cranks_kept::State::<f64>::default();
    let (declared, free) = (cranks_kept::Model::default(), cranks_kept::Velocity { a: 0.0, b: 1.0, c: 1.0 });
    (kept.q.a, kept.q.b, kept.q.c) = (0.7, -0.5, 1.0);
    let kept = multibody::assemble(&declared, 0.0, &kept, &free).unwrap().state;
    let run = |params: cranks_kept::Params<f64>| {
        let model = cranks_kept::Model::new(&params);
        Integrator::fixed(Rk4, 1e-3).integrate(&model, 0.0, 1e-2, &kept, &(), |_, _| ()).map(drop)
    };
    assert_eq!(run(cranks_kept::Params::default()), Ok(()));
    let told = run(cranks_kept::Params { len: 0.51 });
    assert!(matches!(told, Err(IntegrationError::OpenLoops { .. })), "{told:?}");
}
