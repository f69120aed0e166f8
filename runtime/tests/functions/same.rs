//! Truth: the same function in the language, and differences.

mod arm {
    crate::twice! {
        /// [N]
        input push;
        param mu = 0.3;
        world { gravity: [0.3, -9.7, 1.2] }
        body upper { mass: 2.0, com: [0.1, -0.4, 0.05], inertia: inertia(0.1, 0.2, 0.25, 0.01, -0.02, 0.03) }
        body lower { mass: 1.0, com: [0.2, -0.3, 0.1], inertia: diag(0.1, 0.2, 0.25) }
        joint shoulder: Revolute { parent: ground, child: upper, axis: [0.1, 0.2, 1.0] }
        joint elbow: Ball { parent: upper.at([0.2, -0.8, 0.1]).rotated([1.0, -2.0, 0.5], 0.4), child: lower }
        state z: rate = grip(shoulder.rate, mu) - z * grip(z, push) + blend(shoulder, z, mu), start: 0.2;
        let speed = lower.at([0.1, 0.2, -0.6]).velocity;
        force drag: Force {
            at: lower.at([0.1, 0.2, -0.6]),
            value: [grip(speed.x, mu), grip(speed.y, z), -blend(speed.z, push, 0.7)],
            axes: upper,
        }
        force spring: SpringDamper { joint: shoulder, stiffness: 20.0 + grip(mu, 1.2), damping: 1.0 + grip(shoulder, z) }
        output tip = norm(speed) * grip(1.0, z);
        output loss = blend(push, shoulder.rate, grip(2.0, 3.0));
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy, derivatives, linearize, impulse,
            outputs { short: [loss] }, at { functions: [forward_dynamics, outputs] };
    }
}

/// Slopes in outputs, which nothing differentiates.
mod slopes {
    crate::twice! {
        input push;
        param mu = 0.3;
        world { gravity: [0.3, -9.7, 1.2] }
        body upper { mass: 2.0, com: [0.1, -0.4, 0.05], inertia: diag(0.1, 0.2, 0.25) }
        body lower { mass: 1.0, com: [0.2, -0.3, 0.1], inertia: diag(0.1, 0.2, 0.25) }
        joint shoulder: Universal { parent: ground, child: upper, axes: [[0.0, 0.6, 0.8], X] }
        joint elbow: PinSlot { parent: upper.at([0.2, -0.8, 0.1]), child: lower, axis: Z, slide: [0.6, 0.8, 0.0] }
        state z: rate = grip(elbow.angle, z), start: 0.2;
        force drag: Effort { joint: elbow.travel, value: diff(blend(mu, elbow.travel, z), elbow.travel) }
        output by_angle = diff(grip(elbow.angle, elbow.angle * mu), elbow.angle);
        output by_mu = diff(blend(mu, mu, push), mu);
        output by_push = diff(blend(mu, z, push) * grip(z, push), push);
        output by_time = diff(grip(elbow.angle, z), t);
        output as_if = substitute(grip(elbow.angle, z), z = 1.5);
        emit forward_dynamics, inverse_dynamics;
    }
}

/// Four legs that are alike, in packs.
mod legs {
    crate::twice! {
        @ leg {
            port hip: Frame;
            param side = 1.0;
            input torque;
            body thigh { mass: 0.6, com: [-0.003, -0.02 * side, -0.03], inertia: diag(0.0044, 0.0047, 0.0008) }
            body shin { mass: 0.2, com: [0.006, 0.0, -0.1], inertia: diag(0.003, 0.003, 0.0004) }
            joint roll: Revolute { parent: hip, child: thigh, axis: [1.0, 0.1, 0.0] }
            joint knee: Revolute { parent: thigh.at(-0.2 * Z), child: shin, axis: Y }
            force motor: Effort { joint: roll, value: grip(roll.rate, torque) }
            force stop: Effort { joint: knee, value: -blend(knee, roll, side) - grip(knee.rate, side) }
            output grip = diff(grip(knee, torque), knee);
        }
        formulation { packs: Four }
        world { gravity: -9.81 * Z }
        body trunk { mass: 4.7, com: [0.011, 0.002, 0.0005], inertia: diag(0.0168, 0.063, 0.0717) }
        joint float: Planar { parent: ground, child: trunk, axis: [0.0, 0.6, 0.8] }
        part legs: [leg; 4] = |i| leg { hip: trunk.at([0.2 - 0.1 * i, 0.1, 0.02 * i]).rotated(Z, 0.3 * i) };
        emit forward_dynamics, inverse_dynamics, bias, at { functions: [forward_dynamics, bias, outputs] };
    }
}

/// A four-bar on an inclined plane, with constraints one way or another.
macro_rules! bar {
    ($name:ident, $constraints:ident, $($more:tt)*) => {
        mod $name {
            crate::twice! {
                input push;
                param mu = 0.3;
                formulation { constraints: $constraints }
                world { gravity: [0.3, -9.7, 1.2] }
                body crank { mass: 1.0, com: [0.1, 0.0, 0.05], inertia: diag(0.01, 0.02, 0.03) }
                body coupler { mass: 1.5, com: [0.4, 0.02, 0.0], inertia: diag(0.01, 0.2, 0.2) }
                body rocker { mass: 1.2, com: [0.3, 0.0, 0.03], inertia: diag(0.01, 0.1, 0.1) }
                joint a: Revolute { parent: ground.rotated([1.0, 2.0, 0.5], 0.7), child: crank, axis: Z }
                joint b: Revolute { parent: crank.at(0.3 * X), child: coupler, axis: Z }
                joint c: Revolute { parent: ground.rotated([1.0, 2.0, 0.5], 0.7).at(0.9 * X), child: rocker, axis: Z }
                joint d: Revolute { parent: coupler.at(0.8 * X), child: rocker.at(0.6 * X), axis: Z }
                state z: rate = grip(c, 0.7) - 0.4 * z, start: 0.1;
                force drag: Effort { joint: a, value: grip(a.rate, 1.0 + mu) + blend(b.rate, push, z) }
                force wind: Force {
                    at: coupler.at([0.4, 0.1, 0.0]),
                    value: grip(rocker.velocity.x, mu) * [0.2, 1.0, 0.4],
                    axes: ground,
                }
                output tip = grip(b, c);
                $($more)*
            }
        }
    };
}
bar!(held, Multipliers, emit forward_dynamics, inverse_dynamics, residual, constraints, derivatives, linearize;);
bar!(
    reduced,
    Reduced,
    solve (b, c) from d { sin(c.angle - a.angle - b.angle) > 0.0 }
    emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy, derivatives, linearize;
);
bar!(iterated, Reduced, emit forward_dynamics, inverse_dynamics, mass_matrix, bias, derivatives;);

use multibody::nalgebra::SVector;
use multibody::{Configuration, PinSlot, Universal};

use crate::{Drawn, assert_same, entries, scalars};

/// The numbers of one side of a model.
type Numbers = Vec<(&'static str, Vec<f64>)>;

fn compare(rust: &Numbers, words: &Numbers, roundings: f64) {
    for ((name, rust), (other, words)) in rust.iter().zip(words) {
        assert_eq!(name, other);
        assert_same(name, rust, words, roundings);
    }
}

macro_rules! rates {
    ($of:expr) => {{
        let of = $of;
        scalars(&(of.v, of.x))
    }};
}

macro_rules! of_derivatives {
    ($list:ident, $name:literal, $of:expr) => {
        let of = $of;
        $list.push((concat!($name, " by position"), entries(&of.position)));
        $list.push((concat!($name, " by velocity"), entries(&of.velocity)));
        $list.push((concat!($name, " by states"), entries(&of.states)));
        $list.push((concat!($name, " by input"), entries(&of.input)));
    };
}

macro_rules! of_linearisation {
    ($list:ident, $of:expr) => {
        let of = $of;
        $list.extend([("a", entries(&of.a)), ("b", entries(&of.b)), ("c", entries(&of.c)), ("d", entries(&of.d))]);
    };
}

macro_rules! arm_numbers {
    ($name:ident, $module:ident) => {
        fn $name(seed: u64) -> Numbers {
            use arm::$module::{Input, Model, Params, State, Velocity};
            let mut drawn = Drawn::new(seed);
            let model = Model::new(&Params { mu: 0.3 + 0.2 * drawn.number() });
            let mut state = State::default();
            state.q.shoulder = 3.0 * drawn.number();
            let turn = [(); 3].map(|()| drawn.number()).into();
            state.q = state.q.displace(&Velocity { shoulder: 0.0, elbow: turn });
            state.v.shoulder = 2.0 * drawn.number();
            state.v.elbow = [(); 3].map(|()| 2.0 * drawn.number()).into();
            state.x.z = drawn.number();
            let input = Input { push: drawn.number() };
            let accel = Velocity { shoulder: drawn.number(), elbow: [(); 3].map(|()| 2.0 * drawn.number()).into() };
            let at = model.at(&state.q, &state.x);
            let mut list = vec![
                ("forward dynamics", rates!(model.forward_dynamics(0.4, &state, &input))),
                ("at, forward dynamics", rates!(at.forward_dynamics(&state.v, &input))),
                ("inverse dynamics", scalars(&model.inverse_dynamics(0.4, &state, &input, &accel))),
                ("mass matrix", entries(&model.mass_matrix(&state.q))),
                ("bias", entries(&model.bias(0.4, &state, &input))),
                ("energy", vec![model.kinetic_energy(&state), model.potential_energy(&state.q)]),
                ("impulse", scalars(&model.impulse(&state.q, &accel))),
                ("outputs", scalars(&model.outputs(0.4, &state, &input))),
                ("group", scalars(&model.outputs_short(0.4, &state, &input))),
            ];
            of_derivatives!(list, "forward dynamics", model.forward_derivatives(0.4, &state, &input));
            of_derivatives!(list, "inverse dynamics", model.inverse_derivatives(0.4, &state, &input, &accel));
            of_linearisation!(list, model.linearize(0.4, &state, &input));
            list
        }
    };
}
arm_numbers!(arm_in_rust, rust);
arm_numbers!(arm_in_words, words);

#[test]
fn an_arm() {
    (0..20).for_each(|seed| compare(&arm_in_rust(seed), &arm_in_words(seed), 256.0));
}

macro_rules! slopes_numbers {
    ($name:ident, $module:ident) => {
        fn $name(seed: u64) -> Numbers {
            use slopes::$module::{Input, Model, Params, State, Velocity};
            let mut drawn = Drawn::new(seed);
            let model = Model::new(&Params { mu: 0.3 + 0.2 * drawn.number() });
            let mut state = State::default();
            let pose = Velocity {
                shoulder: Universal { first: drawn.number(), second: drawn.number() },
                elbow: PinSlot { angle: drawn.number(), travel: 2.0 * drawn.number() },
            };
            state.q = state.q.displace(&pose);
            state.v = Velocity { shoulder: Universal { first: drawn.number(), second: drawn.number() }, ..pose };
            state.x.z = drawn.number();
            let input = Input { push: drawn.number() };
            vec![
                ("forward dynamics", rates!(model.forward_dynamics(0.4, &state, &input))),
                ("inverse dynamics", scalars(&model.inverse_dynamics(0.4, &state, &input, &pose))),
                ("outputs", scalars(&model.outputs(0.4, &state, &input))),
            ]
        }
    };
}
slopes_numbers!(slopes_in_rust, rust);
slopes_numbers!(slopes_in_words, words);

#[test]
fn slopes_that_expressions_ask_for() {
    (0..20).for_each(|seed| compare(&slopes_in_rust(seed), &slopes_in_words(seed), 256.0));
}

macro_rules! bar_numbers {
    ($name:ident, $module:ident, $side:ident, $size:literal, |$model:ident, $state:ident, $input:ident, $accel:ident| $more:expr) => {
        fn $name(seed: u64) -> Numbers {
            use $module::$side::{Input, Model, Params, State, Velocity};
            let mut drawn = Drawn::new(seed);
            let $model = Model::new(&Params { mu: 0.3 + 0.2 * drawn.number() });
            let mut $state = State::default();
            let mut velocity = || Velocity::from(SVector::<f64, $size>::from_fn(|_, _| drawn.number()));
            $state.q = $state.q.displace(&velocity());
            $state.v = velocity();
            let $accel = velocity();
            $state.x.z = drawn.number();
            let $input = Input { push: drawn.number() };
            let mut list = vec![
                ("forward dynamics", rates!($model.forward_dynamics(0.4, &$state, &$input))),
                ("inverse dynamics", scalars(&$model.inverse_dynamics(0.4, &$state, &$input, &$accel))),
                ("outputs", scalars(&$model.outputs(0.4, &$state, &$input))),
            ];
            of_derivatives!(list, "forward dynamics", $model.forward_derivatives(0.4, &$state, &$input));
            of_derivatives!(list, "inverse dynamics", $model.inverse_derivatives(0.4, &$state, &$input, &$accel));
            list.extend($more);
            list
        }
    };
}

macro_rules! bars {
    ($test:ident, $module:ident, $size:literal, $roundings:literal, $arguments:tt, $more:expr) => {
        #[test]
        fn $test() {
            bars!(@ in_rust, $module, rust, $size, $arguments, $more);
            bars!(@ in_words, $module, words, $size, $arguments, $more);
            (0..20).for_each(|seed| compare(&in_rust(seed), &in_words(seed), $roundings));
        }
    };
    (@ $name:ident, $module:ident, $side:ident, $size:literal, ($model:ident, $state:ident, $input:ident, $accel:ident), $more:expr) => {
        bar_numbers!($name, $module, $side, $size, |$model, $state, $input, $accel| $more);
    };
}

bars!(a_loop_with_multipliers, held, 3, 256.0, (model, state, input, accel), {
    let multipliers = [0.7, -1.3].into();
    let linear = model.linearize(0.4, &state, &input);
    [
        ("residual", model.residual(0.4, &state, &input, &accel, &multipliers).as_slice().to_vec()),
        ("constraints", model.constraints(0.4, &state.q).as_slice().to_vec()),
        ("a", entries(&linear.a)),
        ("b", entries(&linear.b)),
        ("c", entries(&linear.c)),
        ("d", entries(&linear.d)),
    ]
});
bars!(a_loop_in_closed_form, reduced, 1, 256.0, (model, state, input, accel), {
    let linear = model.linearize(0.4, &state, &input);
    [
        ("mass matrix", entries(&model.mass_matrix(&state.q))),
        ("bias", entries(&model.bias(0.4, &state, &input))),
        ("a", entries(&linear.a)),
        ("b", entries(&linear.b)),
        ("c", entries(&linear.c)),
    ]
});
// What iterations leave open is a rounding of positions, whose slopes are greater.
bars!(a_loop_by_iterations, iterated, 1, 4096.0, (model, state, input, accel), {
    [("bias", entries(&model.bias(0.4, &state, &input)))]
});

/// Against differences of forward dynamics, which know nothing of slopes.
#[test]
fn derivatives_are_those_of_the_function() {
    use arm::rust::{Input, Model, Params, State, Velocity};
    let model = Model::new(&Params { mu: 0.4 });
    for seed in 0..10 {
        let mut drawn = Drawn::new(seed);
        let mut state = State::default();
        let turn = [(); 3].map(|()| drawn.number()).into();
        state.q = state.q.displace(&Velocity { shoulder: drawn.number(), elbow: turn });
        state.v = Velocity { shoulder: drawn.number(), elbow: [(); 3].map(|()| drawn.number()).into() };
        state.x.z = drawn.number();
        let push = drawn.number();
        let at = |state: &State, push: f64| rates!(model.forward_dynamics(0.0, state, &Input { push }));
        let slopes = model.forward_derivatives(0.0, &state, &Input { push });
        let step = 1e-5;
        let difference = |of: &dyn Fn(f64) -> Vec<f64>| -> Vec<f64> {
            of(step).iter().zip(of(-step)).map(|(high, low)| (high - low) / (2.0 * step)).collect()
        };
        let along = |k: usize, step: f64| {
            let mut all = [0.0; 4];
            all[k] = step;
            Velocity { shoulder: all[0], elbow: [all[1], all[2], all[3]].into() }
        };
        for k in 0..4 {
            let moved = difference(&|step| at(&State { q: state.q.displace(&along(k, step)), ..state }, push));
            assert_near(&moved, slopes.position.column(k).as_slice());
            let faster = difference(&|step| {
                let v = along(k, step);
                let v = Velocity { shoulder: state.v.shoulder + v.shoulder, elbow: state.v.elbow + v.elbow };
                at(&State { v, ..state }, push)
            });
            assert_near(&faster, slopes.velocity.column(k).as_slice());
        }
        let own = difference(&|step| {
            let mut state = state;
            state.x.z += step;
            at(&state, push)
        });
        assert_near(&own, slopes.states.as_slice());
        assert_near(&difference(&|step| at(&state, push + step)), slopes.input.as_slice());
    }
}

fn assert_near(differences: &[f64], slopes: &[f64]) {
    assert_same("slopes", differences, slopes, 1e-7 / f64::EPSILON);
}

macro_rules! legs_numbers {
    ($name:ident, $module:ident) => {
        fn $name(seed: u64) -> Numbers {
            use legs::$module::{Input, Model, Params, State, Velocity};
            let mut drawn = Drawn::new(seed);
            let mut params = Params::default();
            params.legs.iter_mut().for_each(|leg| leg.side += 0.3 * drawn.number());
            let model = Model::new(&params);
            let mut state = State::default();
            let mut velocity = || Velocity::from(SVector::<f64, 11>::from_fn(|_, _| drawn.number()));
            state.q = state.q.displace(&velocity());
            state.v = velocity();
            let accel = velocity();
            let mut input = Input::default();
            input.legs.iter_mut().for_each(|leg| leg.torque = drawn.number());
            let at = model.at(&state.q);
            vec![
                ("forward dynamics", scalars(&model.forward_dynamics(0.4, &state, &input))),
                ("inverse dynamics", scalars(&model.inverse_dynamics(0.4, &state, &input, &accel))),
                ("bias", model.bias(0.4, &state, &input).as_slice().to_vec()),
                ("outputs", scalars(&model.outputs(0.4, &state, &input))),
                ("at, forward dynamics", scalars(&at.forward_dynamics(&state.v, &input))),
                ("at, bias", at.bias(&state.v, &input).as_slice().to_vec()),
                ("at, outputs", scalars(&at.outputs(&state.v, &input))),
            ]
        }
    };
}
legs_numbers!(legs_in_rust, rust);
legs_numbers!(legs_in_words, words);

#[test]
fn limbs_in_packs() {
    (0..20).for_each(|seed| compare(&legs_in_rust(seed), &legs_in_words(seed), 1024.0));
}
