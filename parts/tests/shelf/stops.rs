//! Ends of travels, ropes.

use multibody::multibody;

use super::{after, close};

multibody! {
    use multibody_parts::{bump_stops, rope};

    /// A mass between two stops.
    pub mod buffers {
        param damping = 0;
        body cart { mass: 1.3 }
        joint x: Prismatic { parent: ground, child: cart, axis: [2, -1, 2] }
        part ends: bump_stops { joint: x, lower: -0.4, upper: 0.25, stiffness: 5e3, damping: damping };
        /// [J]
        state lost: rate = ends.loss, start: 0;
        output energy = kinetic() + ends.energy + lost;
        output potential_part = ends.energy;
    }

    /// Two weights on a rope over a body that slides.
    pub mod hoist {
        world { gravity: -9.81 * Z }
        body left { mass: 2 }
        body right { mass: 3 }
        body pulley { mass: 5 }
        joint a: Prismatic { parent: ground.at([-0.4, 0, -1]), child: left, axis: Z }
        joint b: Prismatic { parent: ground.at([0.7, 0.2, -2]), child: right, axis: Z }
        joint p: Prismatic { parent: ground, child: pulley, axis: X }
        part cable: rope { from: left, over: pulley, to: right, length: 3.1, stiffness: 700, damping: 30 };
        output tension = cable.tension;
    }
}

/// A mass turns where its energy is in the stop: m v^2 / 2 = s d^3 / 3.
#[test]
fn stops_give_back_what_they_take() {
    let model = buffers::Model::<f64>::default();
    let mut x = buffers::State::default();
    x.v.x = 2.0;
    let energy = 0.5 * 1.3 * 4.0;
    let mut deepest: f64 = 0.0;
    for _ in 0..400 {
        x = after(&model, &x, &(), 0.002, 20);
        deepest = deepest.max(x.q.x);
        close("energy", model.outputs(0.0, &x, &()).energy, energy, 1e-9);
    }
    close("depth", deepest - 0.25, (3.0 * energy / 5e3_f64).cbrt(), 1e-3);
    let model = buffers::Model::new(&buffers::Params { damping: 300.0 });
    let end =
        after(&model, &buffers::State { v: buffers::Velocity { x: 2.0 }, ..Default::default() }, &(), 2.0, 20_000);
    assert!(end.x.lost > 0.1 * energy);
    close("energy", model.outputs(0.0, &end, &()).energy, energy, 1e-9);
}

/// Tension from lengths, and forces along the rope's sides.
#[test]
fn a_rope_pulls_where_it_is_taut() {
    let model = hoist::Model::<f64>::default();
    let mut x = hoist::State::default();
    (x.q.p, x.v.p, x.v.a) = (0.1, 0.3, -0.2);
    let (left, right) = ([0.5_f64, 0.0, 1.0], [-0.6_f64, -0.2, 2.0]);
    let norm = |v: [f64; 3]| (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    let [first, second] = [left, right].map(norm);
    // The pulley leaves the left end and comes to the right one.
    let speed = (left[0] * 0.3 + left[2] * 0.2) / first + right[0] * 0.3 / second;
    let tension = 700.0 * (first + second - 3.1) + 30.0 * speed;
    assert!(tension > 50.0);
    close("tension", model.outputs(0.0, &x, &()).tension, tension, 1e-12);
    let accel = model.forward_dynamics(0.0, &x, &());
    close("left", accel.a, tension * left[2] / first / 2.0 - 9.81, 1e-12);
    close("right", accel.b, tension * right[2] / second / 3.0 - 9.81, 1e-12);
    close("pulley", accel.p, -tension * (left[0] / first + right[0] / second) / 5.0, 1e-11);
    (x.q.a, x.q.b) = (0.6, 0.6);
    assert_eq!(model.outputs(0.0, &x, &()).tension, 0.0);
}
