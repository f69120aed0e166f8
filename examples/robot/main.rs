//! From a URDF file to an arm that holds itself up against gravity.
//!
//! `cargo run --release --example robot`

use multibody::{IntegrationError, Rk4, closed_loop, multibody};

multibody! {
    pub mod cell {
        world { gravity: -9.81 * Z }
        part arm: Urdf { file: "../../tests/data/robots/panda.urdf", base: ground, angles: Snapped, efforts: Inputs };
        output tool = arm.tool.position;
        emit forward_dynamics, bias;
    }
}

use cell::{Input, Model, State};

fn main() -> Result<(), IntegrationError> {
    let model = Model::<f64>::default();
    let mut start = State::default();
    (start.q.arm.joint2, start.q.arm.joint4) = (0.4, -1.2); // rad
    for held in [true, false] {
        let law = |t, x: &State<f64>| {
            let mut input = Input::default();
            if held {
                // What the joints need to stand still, or to go on as they move.
                input.arm.effort = model.bias(t, x, &input).into();
            }
            input
        };
        let arm = closed_loop(&model, law);
        let end = Rk4::integrate(&arm, 0.0, &start, &(), 1e-3, 500, |_, _| ())?;
        let [before, after] = [start, end].map(|x| model.outputs(0.0, &x, &Input::default()).tool);
        let what = if held { "held" } else { "let go" };
        println!("{what}: after half a second the tool is {:.1e} m from where it was", (after - before).norm());
        assert_eq!((after - before).norm() < 1e-9, held);
    }
    Ok(())
}
