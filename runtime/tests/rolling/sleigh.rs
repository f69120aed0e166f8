//! Chaplygin's sleigh on oblique axes, in four ways: at random poses, along its closed solution, and down a slope.

use multibody::nalgebra::{Matrix3, Vector3};
use multibody::{Configuration, Dop853, Integrator, Projection, Tangent, WithProjection, multibody};

use crate::speeds::{Random, agree, derivatives_are_slopes, flat, projections_agree, same_ends, with_rates};

four_ways!([sleigh_held, sleigh, sleigh_chosen, sleigh_beside], [plane.x, plane.angle], {
    /// [m]
    param ahead = 0.3;
    /// Share of the weight that acts: without it the sleigh runs as on a level plane.
    param heavy = 1.0;
    world { gravity: heavy * [0.4, -0.7, -9.0] }
    body sled { mass: 2.0, com: [ahead, 0.05, 0.1], inertia: inertia(0.3, 0.4, 0.5, 0.01, 0.02, -0.03) }
    joint plane: Planar { parent: ground.rotated([1.0, 0.4, 0.2], 0.3), child: sled, axis: [0.1, -0.2, 1.0] }
    let blade_axes = sled.rotated(Z, 0.4);
    constraint blade = blade_axes.express(sled.velocity).y;
    output moved = [sled.acceleration, sled.angular_acceleration];
    output forces = [plane.reaction.force, plane.reaction.moment];
    output energy = kinetic() + potential();
    output living = kinetic();
    output place = plane.angle;
    output ways = [sled.express(sled.velocity), sled.express(sled.angular_velocity)];
    output cut = blade.multiplier;
}, {
    /// [m/s]
    speed along = blade_axes.express(sled.velocity).x;
    /// [rad/s]
    speed turning = 0.5 * plane.angle.rate - 0.1 * blade_axes.express(sled.velocity).x;
}, {
    /// [m/s]
    speed across = blade_axes.express(sled.velocity).y;
});

/// In four ways at random poses.
#[test]
fn a_sleigh() {
    let (held, reduced) = (sleigh_held::Model::<f64>::default(), sleigh::Model::<f64>::default());
    let (chosen, beside) = (sleigh_chosen::Model::<f64>::default(), sleigh_beside::Model::<f64>::default());
    assert_eq!((sleigh_held::DOF, sleigh::DOF, sleigh_chosen::DOF, sleigh_beside::DOF), (3, 2, 2, 3));
    let mut random = Random(5);
    for _ in 0..20 {
        let mut other = sleigh_chosen::State::<f64>::default();
        other.q = other.q.displace(&random.vector::<sleigh_chosen::Rates>().scale(3.0));
        other.v = random.vector();
        let rates = chosen.position_rates(0.0, &other);
        let mut all = sleigh_held::State::<f64>::default();
        (all.q.plane, all.v.plane) = (other.q.plane, rates.plane);
        assert!(held.constraint_rate(0.0, &all).amax() < 1e-12);
        let same = held.outputs(0.0, &all, &());
        let wanted = [&same.moved[..], &same.forces[..]].concat();
        let out = chosen.outputs(0.0, &other, &());
        agree(&[&out.moved[..], &out.forces[..]].concat(), &wanted);
        let mut more = sleigh_beside::State::<f64>::default();
        more.q.plane = other.q.plane;
        let more = with_rates(&beside, 0.0, &more, &flat(&rates));
        assert!(more.v.across.abs() < 1e-12 && (more.v.along - other.v.along).abs() < 1e-12);
        let out = beside.outputs(0.0, &more, &());
        agree(&[&out.moved[..], &out.forces[..]].concat(), &wanted);
        derivatives_are_slopes(&beside, 0.0, &more, &());
        projections_agree(&mut random, 0.0, (&held, &all), (&beside, &more), true);
        // In rates of which the blade's axes know nothing there may be a pose without motion ahead.
        let mut state = sleigh::State::<f64>::default();
        state.q.plane = other.q.plane;
        let state = with_rates(&reduced, 0.0, &state, &flat(&rates));
        agree(&reduced.outputs(0.0, &state, &()).moved, &same.moved);
    }
}

/// With the centre of mass a ahead of the blade and b aside, its velocity along the blade is p = u - b w, and p' = a w^2,
/// (I + m a^2) w' = -m a w p: p = V tanh(s t), w = V / sqrt(J) / cosh(s t), on the ellipse p^2 + J w^2 = V^2, with J = I / m + a^2 and
/// s = a V / J (Neimark and Fufaev 1972, for b = 0). The heading is the integral of w, and the blade's force m (a w' + w u - b w^2).
#[test]
fn a_sleigh_along_its_ellipse() {
    // In the body's axes: those along and across the blade lean out of the plane.
    let normal = Vector3::new(0.1, -0.2, 1.0).normalize();
    let (sin, cos) = 0.4_f64.sin_cos();
    let (along, across) = (Vector3::new(cos, sin, 0.0), Vector3::new(-sin, cos, 0.0));
    let aside = (across - normal * normal.dot(&across)).normalize();
    let ahead = aside.cross(&normal);
    let (mass, com) = (2.0, Vector3::new(0.8, 0.05, 0.1));
    let tensor = Matrix3::new(0.3, 0.01, 0.02, 0.01, 0.4, -0.03, 0.02, -0.03, 0.5);
    let (a, b) = (com.dot(&ahead), com.dot(&aside));
    let j = normal.dot(&(tensor * normal)) / mass + a * a;
    let speed = 0.6;
    let s = a * speed / j;
    let [from, until] = [-1.0, 1.8].map(|x| x / s);
    let motion = |t: f64| (speed * (s * t).tanh(), speed / j.sqrt() / (s * t).cosh());
    let turned = |t: f64| 2.0 * (0.5 * s * t).tanh().atan() * j.sqrt() / a;
    // Half way through its turn the blade lies along the joint's x axis: in the rates of x and of the angle the motion ends where it lies
    // across.
    let along_x = {
        let model = sleigh_held::Model::<f64>::default();
        let mut state = sleigh_held::State::<f64>::default();
        state.v.plane.x = 1.0;
        let x = model.outputs(0.0, &state, &()).ways[0];
        x.dot(&aside).atan2(x.dot(&ahead))
    };
    let heading = |t: f64| along_x + turned(t) - 0.5 * (turned(from) + turned(until));
    let mut ends: Vec<Vec<f64>> = Vec::new();
    let start = {
        let model = sleigh_chosen::Model::<f64>::new(&sleigh_chosen::Params { ahead: 0.8, heavy: 0.0 });
        let mut state = sleigh_chosen::State::<f64>::default();
        state.q.plane = multibody::Planar { x: 0.3, y: -0.4, angle: heading(from) };
        let (p, w) = motion(from);
        let u = p + b * w;
        state.v.along = u * ahead.dot(&along);
        state.v.turning = 0.5 * w - 0.1 * state.v.along;
        flat(&model.position_rates(0.0, &state))
    };
    macro_rules! check {
        ($name:ident, $held:tt) => {
            let model = $name::Model::<f64>::new(&$name::Params { ahead: 0.8, heavy: 0.0 });
            let mut state = $name::State::<f64>::default();
            state.q.plane = multibody::Planar { x: 0.3, y: -0.4, angle: heading(from) };
            let state = with_rates(&model, from, &state, &start);
            let before = model.outputs(from, &state, &()).living;
            let mut looked = 0;
            let (end, _) = run!(model, $held, from, until, &state, &(), |t, state| {
                let out = model.outputs(t, state, &());
                let [velocity, turning] = out.ways;
                let (p, w) = motion(t);
                let force = mass * w * p * (1.0 - a * a / j);
                let apart = [
                    velocity.dot(&ahead) - b * normal.dot(&turning) - p,
                    normal.dot(&turning) - w,
                    velocity.dot(&aside),
                    out.place - heading(t),
                    -out.cut * aside.dot(&across) - force,
                ];
                assert!(apart.iter().all(|x| x.abs() < 1e-10), "{} at {t}: {apart:?}", stringify!($name));
                assert!((out.living / before - 1.0).abs() < 1e-12, "{} at {t}", stringify!($name));
                looked += 1;
            })
            .unwrap();
            assert!(looked > 5);
            ends.push(vec![end.q.plane.x, end.q.plane.y, end.q.plane.angle]);
        };
    }
    each_way!(check: sleigh_held, sleigh, sleigh_chosen, sleigh_beside);
    same_ends(&ends);
}

/// Down a slope, on both sides of its fall line: one motion, along which energy stays.
#[test]
fn a_sleigh_down_a_slope() {
    for (angle, speeds) in [(-0.7, [0.9, 0.3]), (-2.4, [0.5, -0.4])] {
        let start = {
            let model = sleigh_chosen::Model::<f64>::default();
            let mut state = sleigh_chosen::State::<f64>::default();
            state.q.plane.angle = angle;
            [state.v.along, state.v.turning] = speeds;
            flat(&model.position_rates(0.0, &state))
        };
        let mut ends: Vec<Vec<f64>> = Vec::new();
        macro_rules! check {
            ($name:ident, $held:tt) => {
                let model = $name::Model::<f64>::default();
                let mut state = $name::State::<f64>::default();
                state.q.plane.angle = angle;
                let state = with_rates(&model, 0.0, &state, &start);
                let before = model.outputs(0.0, &state, &());
                let (mut most, mut living) = (0.0_f64, before.living);
                let (end, _) = run!(model, $held, 0.0, 3.0, &state, &(), |t, state| {
                    let out = model.outputs(t, state, &());
                    living = living.max(out.living);
                    most = most.max((out.energy - before.energy).abs());
                })
                .unwrap();
                assert!(most < 1e-12 * living && living > 2.0 * before.living);
                ends.push(vec![end.q.plane.x, end.q.plane.y, end.q.plane.angle]);
            };
        }
        each_way!(check: sleigh_held, sleigh, sleigh_chosen, sleigh_beside);
        same_ends(&ends);
    }
}
