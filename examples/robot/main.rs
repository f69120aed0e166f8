//! From a URDF file to an arm that holds itself up against gravity.
//!
//! `cargo run --release --example robot`

use multibody::{IntegrationError, Rk4, multibody};

multibody! {
    pub mod cell {
        /// [N m] of the seven motors
        input torque: [Scalar; 7];
        world { gravity: -9.81 * Z }
        part arm: Urdf { file: "../../tests/data/robots/panda.urdf", base: ground.at(0.8 * Z), angles: Snapped, param: [link7.mass] };
        force motor1: Effort { joint: arm.joint1, value: torque[0] }
        force motor2: Effort { joint: arm.joint2, value: torque[1] }
        force motor3: Effort { joint: arm.joint3, value: torque[2] }
        force motor4: Effort { joint: arm.joint4, value: torque[3] }
        force motor5: Effort { joint: arm.joint5, value: torque[4] }
        force motor6: Effort { joint: arm.joint6, value: torque[5] }
        force motor7: Effort { joint: arm.joint7, value: torque[6] }
        output tool = arm.tool.position;
        emit forward_dynamics, bias;
    }
}

fn main() -> Result<(), IntegrationError> {
    let model = cell::Model::<f64>::default();
    let mut state = cell::State::default();
    state.q.arm.joint2 = 0.4; // rad
    state.q.arm.joint4 = -1.2;
    // What the joints need beside gravity, at rest: without torques that is what gravity pulls with.
    let none = cell::Input { torque: [0.0; 7] };
    let held = model.bias(0.0, &state, &none).into();
    let before = model.outputs(0.0, &state, &none).tool;
    for (what, torque) in [("held", held), ("let go", [0.0; 7])] {
        let input = cell::Input { torque };
        let after = Rk4::integrate(&model, 0.0, &state, &input, 1e-3, 500, |_, _| ())?;
        let way = (model.outputs(0.5, &after, &input).tool - before).norm();
        println!("{what}: after half a second the tool is {way:.3e} m away");
        assert_eq!(way < 1e-9, what == "held");
    }
    Ok(())
}
