//! Oil, air, water.

use multibody::multibody;

use super::{after, close};

multibody! {
    use multibody_parts::{buoyancy, hydraulic_cylinder, rotor, water_drag};

    /// A cylinder that pushes a mass against a constant force.
    pub mod press {
        input spool;
        body ram { mass: 120 }
        joint x: Prismatic { parent: ground, child: ram, axis: [1, 2, 2] }
        part cylinder: hydraulic_cylinder { rod: x, spool: spool, stroke: 3, tank: 5e5 };
        force load: Effort { joint: x, value: -9e3 }
    }

    /// A plate under one rotor, askew.
    pub mod lifted {
        input speed;
        body plate { mass: 0.8, inertia: diag(0.01, 0.02, 0.03) }
        joint free: Free { parent: ground, child: plate }
        part rotor: rotor { hub: plate.at([0.1, -0.2, 0.05]).rotated([1, 2, 2], 0.4), speed: speed, thrust: -2e-5, drag: 3e-7 };
    }

    /// A float and a stone.
    pub mod pool {
        world { gravity: -9.81 * Z }
        body float { mass: 0.3 }
        body stone { mass: 2 }
        joint f: Prismatic { parent: ground, child: float, axis: Z }
        joint s: Prismatic { parent: ground.at(-5 * Z), child: stone, axis: Z }
        part cork: buoyancy { hull: float, volume: 1e-3, height: 0.2, density: 1000 };
        part under: buoyancy { hull: stone, volume: 8e-4, height: 0.1, density: 1025 };
        part drag: water_drag { point: stone, area: 0.02, density: 1025, passage: 1e-9 };
        output lift = cork.lift;
    }
}

/// The speed of a loaded cylinder at a constant opening: c u sqrt((A ps - a pt - F) / (A^3 + a^3)) (Merritt 1967).
#[test]
fn a_loaded_cylinder_has_its_speed() {
    let model = press::Model::<f64>::default();
    let mut x = press::State::default();
    (x.x.cylinder.pressure_a, x.x.cylinder.pressure_b) = (1e7, 1e7);
    let spool = 0.3;
    let end = after(&model, &x, &press::Input { spool }, 4.0, 80_000);
    let (a, b, c) = (2e-3_f64, 1.2e-3_f64, 2e-7);
    let speed = c * spool * ((a * 2e7 - b * 5e5 - 9e3) / (a.powi(3) + b.powi(3))).sqrt();
    close("speed", end.v.x, speed, 1e-5);
    close("pressure", end.x.cylinder.pressure_a, 2e7 - (a * speed / (c * spool)).powi(2), 1e-5);
}

#[test]
fn a_rotor_pushes_and_turns() {
    let model = lifted::Model::<f64>::default();
    let accel = model.forward_dynamics(0.0, &lifted::State::default(), &lifted::Input { speed: -500.0 });
    // Rodrigues: the axis z of the hub.
    let (k, (s, c)) = ([1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0], 0.4_f64.sin_cos());
    let axis = [s * k[1] + k[0] * k[2] * (1.0 - c), -s * k[0] + k[1] * k[2] * (1.0 - c), c + k[2] * k[2] * (1.0 - c)];
    let (push, turn) = (2e-5 * 25e4, 3e-7 * 25e4);
    let at = [0.1, -0.2, 0.05];
    let force = axis.map(|x| push * x);
    let moment = [0, 1, 2].map(|i| {
        let (j, l) = ((i + 1) % 3, (i + 2) % 3);
        at[j] * force[l] - at[l] * force[j] + turn * axis[i]
    });
    for i in 0..3 {
        close("force", accel.free.linear[i], force[i] / 0.8, 1e-12);
        close("moment", accel.free.angular[i], moment[i] / [0.01, 0.02, 0.03][i], 1e-12);
    }
}

#[test]
fn floats_float_and_stones_sink() {
    let model = pool::Model::<f64>::default();
    for (height, share) in [(-0.3, 1.0), (-0.1, 1.0), (0.04, 0.3), (0.1, 0.0), (1.0, 0.0)] {
        let mut x = pool::State::default();
        x.q.f = height;
        close("lift", model.outputs(0.0, &x, &()).lift, 9810.0 * 1e-3 * share, 1e-12);
    }
    // From rest, against drag with the square of speed: v tanh(g t / v).
    let weight: f64 = 2.0 * 9.81 - 1025.0 * 9.81 * 8e-4;
    let last: f64 = (weight / (0.5 * 1025.0 * 0.02)).sqrt();
    let end = after(&model, &pool::State::default(), &(), 0.4, 4000);
    close("stone", end.v.s, -last * (weight / 2.0 * 0.4 / last).tanh(), 1e-8);
}
