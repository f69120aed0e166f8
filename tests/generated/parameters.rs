//! What `Params::check` says of parameters that no mechanism has, and of numbers that the scalar doesn't hold.

use multibody::{ParamError, multibody};

multibody! {
    /// Literals beyond single precision, and one whose product with another is within.
    pub mod beyond {
        const K = 1e39;
        body b { mass: 1e-30, inertia: diag(1e-30, 1e-30, 1e-30), com: 1e-9 * X }
        joint j: Revolute { parent: ground, child: b, axis: Z }
        output within = K * 1e-39 * j.angle;
        output big = K * j.angle * sin(t) * 1.5;
    }
    /// A mass that is zero in single precision.
    pub mod light {
        param mass = 1e-46;
        body b { mass: mass }
        joint j: Prismatic { parent: ground, child: b, axis: Z }
        force s: Spring { joint: j, stiffness: 1.0 }
    }
    pub mod rods {
        param length = 1.0;
        param rest = 0.3;
        param offset: Vec3 = [0.5, 0.0, 0.0];
        world { gravity: -9.81 * Y }
        body arm { mass: 1.0, com: offset, inertia: diag(0.1, 0.1, 0.1) }
        body bar { mass: 1.0, inertia: diag(0.1, 0.1, 0.1) }
        joint a: Revolute { parent: ground, child: arm, axis: Z }
        joint b: Revolute { parent: ground.at(X), child: bar, axis: Z }
        constraint link: Rod { between: [arm.at(Y), bar.at(Y)], length: length }
        force band: Spring { between: [arm.at(0.3 * Y), ground], stiffness: 10.0, length: rest }
    }
}

static STILL: light::Params<f32> = light::Params { mass: 1.0 };

fn what<T>(result: Result<T, ParamError>) -> &'static str {
    result.err().expect("an error").what
}

#[test]
fn numbers_beyond_the_scalar_are_told() {
    assert!(beyond::Params::<f64>::default().check().is_ok());
    assert!(what(beyond::Params::<f32>::default().check()).contains("1.5e39"));
    let model = beyond::Model::<f32>::default();
    let mut state = beyond::State::default();
    state.q.j = 0.1;
    let outputs = model.outputs(1.0, &state, &());
    assert!(outputs.within == 0.1 && outputs.big.is_infinite());
}

#[test]
fn a_mass_that_vanishes_is_told() {
    assert!(light::Params::<f64>::default().check().is_ok());
    assert!(what(light::Params::<f32>::default().check()).contains("1e-46"));
    assert!(what(light::Params::<f32> { mass: 0.0 }.check()).contains("1e-46"));
    assert!(STILL.check().is_ok());
    assert!(what(light::Params::<f64> { mass: 0.0 }.check()).contains("nothing resists `j`"));
    let _ = light::Model::new(&STILL);
}

#[test]
fn lengths_are_such_as_there_are() {
    let params = rods::Params::<f64>::default();
    assert!(params.check().is_ok());
    assert!(what(rods::Params { length: 0.0, ..params }.check()).contains("the length of `link` is not positive"));
    assert!(what(rods::Params { length: f64::NAN, ..params }.check()).contains("`length` is not finite"));
    assert!(what(rods::Params { rest: -0.1, ..params }.check()).contains("the length of `band` is negative"));
    let offset = multibody::nalgebra::Vector3::new(0.0, f64::INFINITY, 0.0);
    assert!(what(rods::Params { offset, ..params }.check()).contains("`offset` is not finite"));
}
