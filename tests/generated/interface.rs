//! The generated interface of closed loops compiles against the runtime without a warning, and every scalar of a program
//! comes out where its documentation says.

#[path = "../../macros/engine/tests/emit/looped.rs"]
mod looped_sample;
#[path = "../../macros/engine/tests/emit/samples.rs"]
mod samples;

use std::path::Path;

use multibody_engine::emit::{emit, source};
use multibody_tests::support::data::path;

use crate::cargo;

/// What a user would write around the module.
const MAIN: &str = r#"
use looped::{CONSTRAINTS, Closed, DOF, Derivative, Input, Model, Position, Solved, State, Velocity};
use multibody::nalgebra::{SMatrix, SVector};
use multibody::{Kinematics, Projection, Rk4, System, assemble};

fn main() {
    let model = Model::<f64>::default();
    let mut state = State::default();
    assert_eq!(SVector::from(state.guess), SVector::from([0.0; 4]));
    state.q.a = 0.75;
    state.q.b = -0.5;
    state.v.a = 2.0;
    state.v.b = 3.0;
    state.guess.legs[1].gimbal.second = 0.5;

    // The pieces of forward dynamics.
    let Derivative { v, x, multipliers, rank, residual } = model.forward_dynamics(0.0, &state, &Input::default());
    assert_eq!((v.a, v.table_angle, v.platform.y, v.head.yaw), (1.0, 4.0, 6.0, 10.0));
    assert_eq!((x.current, multipliers[0], rank, residual), (0.75, 100.5, 1.0, 1e-9));

    // Inputs that are not looked for stay.
    let mut input = Input::default();
    input.wind.y = 5.0;
    input.legs[0].thrust = 9.0;
    let Solved { input: solved, rank } = model.inverse_dynamics(0.0, &state, &input, &v);
    assert_eq!([solved.legs[0].thrust, solved.legs[1].thrust, solved.wind.y, rank], [11.0, 22.0, 5.0, 2.0]);

    // Equations.
    let jacobian: SMatrix<f64, CONSTRAINTS, DOF> = model.constraint_jacobian(0.0, &state.q);
    assert_eq!((jacobian[(0, 0)], jacobian[(0, 1)], jacobian[(0, 2)]), (0.75, -0.5, 0.0));
    assert_eq!(model.constraint_rate(0.0, &state)[0], 0.0);
    assert_eq!(model.constraint_bias(0.0, &state)[0], 13.0);
    let all = model.residual(0.0, &state, &input, &v, &SVector::from([4.0]));
    assert_eq!((all[0], all[9], all[10]), (3.0, 9.0, 0.8125));

    // Kinematics.
    state.q.table_y_2 = 0.1;
    state.q.platform.z = 0.2;
    state.v.table_angle = 0.3;
    state.v.head.pitch = 0.4;
    state.q.head.roll = 0.5;
    let found: Kinematics<f64, 2> = model.kinematics(0.6, &state, &v);
    assert_eq!(found.position, SVector::from([0.1, 0.2]));
    assert_eq!(found.velocity, SVector::from([0.3, 0.4]));
    assert_eq!(found.acceleration, SVector::from([0.5, 0.6]));
    assert_eq!(model.kinematics_2(0.0, &state, &v).acceleration[0], 9.0);

    // The guess: renewed by steps, kept by everything else.
    let Closed { state: closed, residual } = model.close(0.0, &state);
    assert_eq!((SVector::from(closed.guess), residual), (SVector::from([1.0, 2.0, 3.0, 4.5]), 0.125));
    assert!(closed.q == state.q && closed != state);
    assert_eq!(model.accepted(0.0, &state, &input), closed);
    assert_eq!(Rk4::step(&model, 0.0, &state, &input, 1e-3).guess, closed.guess);

    // What the runtime makes of the constraints.
    let held = Velocity::from(SVector::from([0.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0]));
    let assembled = assemble(&model, 0.0, &state, &held).expect("a bead").state;
    assert!((assembled.q.b + 0.4375_f64.sqrt()).abs() < 1e-12 && assembled.q.a == 0.75);
    assert_eq!(assembled.guess, state.guess);
    let projected = Projection::default().project(&model, 0.0, &state).expect("a bead").state;
    let Position { a, b, .. } = projected.q;
    assert!((a * a + b * b - 1.0).abs() < 1e-12 && (a * projected.v.a + b * projected.v.b).abs() < 1e-12);
    assert_eq!(SVector::from(projected.q)[7], 0.5);
}
"#;

#[test]
fn loops_against_the_runtime() {
    let (model, structure, compiled) = looped_sample::looped();
    let looped = source(&emit(&model, &structure, &compiled));

    let root = Path::new(env!("CARGO_TARGET_TMPDIR")).join("interface");
    std::fs::create_dir_all(root.join("src")).unwrap();
    std::fs::copy(path("../Cargo.lock"), root.join("Cargo.lock")).unwrap();
    let runtime = path("../runtime").display().to_string();
    let manifest = format!(
        "[workspace]\n\n[package]\nname = \"interface\"\nversion = \"0.1.0\"\nedition = \"2024\"\n\n\
         [dependencies]\nmultibody = {{ path = {runtime:?} }}\n"
    );
    std::fs::write(root.join("Cargo.toml"), manifest).unwrap();
    let lib = format!("//! Generated.\n#![deny(warnings, missing_docs)]\n{looped}");
    std::fs::write(root.join("src/lib.rs"), lib).unwrap();
    let main = format!("//! Generated.\n#![deny(warnings)]\nuse interface::looped;\n{MAIN}");
    std::fs::write(root.join("src/main.rs"), main).unwrap();
    let output = cargo("run", &root).args(["--offline", "--quiet"]).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}
