//! What stands beside errors has the names that the model would have had.

use multibody_engine::diagnostics::Diagnostics;
use multibody_engine::emit::{skeleton, skeletons};
use multibody_engine::syntax::parse;

fn skeletons_of(text: &str) -> String {
    let mut diagnostics = Diagnostics::default();
    let source = parse(text.parse().expect("tokens"), &mut diagnostics);
    for module in &source.modules {
        let alone = skeleton(module);
        syn::parse2::<syn::File>(alone).expect("items");
    }
    let tokens = skeletons(&source);
    syn::parse2::<syn::File>(tokens.clone()).expect("items");
    tokens.to_string().split_whitespace().collect()
}

#[test]
fn fields_are_guessed() {
    let text = skeletons_of(
        "#![krate(::mb)]
        mod leg {
            port base: Frame;
            param m = 0.1;
            joint gimbal: Universal { parent: base, child: nothing, axes: [X, Y] }
        }
        pub(crate) mod broken {
            const COUNT = 3;
            param size: Vec3 = [1.0, 2.0, 3.0];
            param size = 4.0;
            param list: [Scalar; COUNT] = nonsense;
            input push: [Vec3; 2];
            state current: rate = 0.0, start: 0.0;
            joint hinge: Revolute { axis: Q }
            joint ball: Ball { coordinates: RollPitchYaw }
            joint free: Free {}
            joint wrong: Revolut {}
            part legs: [leg; COUNT] = |i| leg { base: ground };
            part lost: nowhere {};
            output tip: Pose = hinge;
        }",
    );
    for piece in [
        "pub(crate)modbroken{use::mb::Real;",
        "pubsize:::mb::nalgebra::Vector3<T>",
        "publist:[T;3]",
        "pubpush:[::mb::nalgebra::Vector3<T>;2]",
        "pubcurrent:T",
        "pubhinge:T",
        "pubball:::mb::RollPitchYaw<T>",
        "pubfree:::mb::Twist<T>",
        "publegs:[leg::Position<T>;3]",
        "pubgimbal:::mb::Universal<T>",
        "pubtip:::mb::Pose<T>",
        "pubfnforward_dynamics(&self,",
        "->Derivative<T>{::core::unimplemented!()}",
        "impl<T:Real>::mb::SystemforModel<T>",
    ] {
        assert!(text.contains(piece), "{piece} is not in {text}");
    }
    assert!(!text.contains("wrong") && !text.contains("lost"));
    assert_eq!(text.matches("modbroken").count(), 1);
}

/// Methods, fields and types of loops exist, whatever else is wrong.
#[test]
fn loops_are_guessed() {
    let items = "body a { mass: 1.0 } body b { mass: 1.0, coordinates: Absolute(RollPitchYaw) }
        input push; input wind: Vec3;
        joint one: Revolute { parent: ground, child: a, axis: Q }
        #[cut] joint two: Ball { parent: a, child: b }
        constraint gear = one + mistake;
        emit inverse_dynamics { solve_for: push }, kinematics { given: b.pose, find: one },
            kinematics { given: one, find: [b, one] };";
    let text = skeletons_of(&format!("mod broken {{ {items} }}"));
    for piece in [
        "pubb:::multibody::FreeRollPitchYaw<T>",
        "pubconstCONSTRAINTS:usize=4;",
        "pubmultipliers:::multibody::nalgebra::SVector<T,4>",
        "pubfnconstraint_jacobian(&self,_t:T,_q:&Position<T>)->::multibody::nalgebra::SMatrix<T,4,10>",
        "pubfnresidual(",
        "pubfninverse_dynamics(&self,_t:T,_state:&State<T>,_input:&Input<T>,_accel:&Velocity<T>)->Solved<T>",
        "pubfnkinematics(&self,_t:T,_state:&State<T>,_accel:&Velocity<T>)->::multibody::Kinematics<T,1>",
        "->::multibody::Kinematics<T,7>",
        "impl<T:Real>::multibody::ConstrainedforModel<T>",
    ] {
        assert!(text.contains(piece), "{piece} is not in {text}");
    }
    assert!(!text.contains("guess"));
    let text = skeletons_of(&format!("mod broken {{ formulation {{ constraints: Reduced }} {items} }}"));
    for piece in ["pubguess:::multibody::nalgebra::SVector<T,4>", "pubfnclose(", "pubresidual:T"] {
        assert!(text.contains(piece), "{piece} is not in {text}");
    }
    assert!(!text.contains("pubmultipliers"));
    let solved = "solve (one) from two {}";
    let text = skeletons_of(&format!("mod broken {{ formulation {{ constraints: Reduced }} {items} {solved} }}"));
    assert!(!text.contains("guess") && !text.contains("structDerivative"));
}

#[test]
fn nothing_grows_without_bound() {
    let text = skeletons_of(
        "mod a { port p: Frame; param m = 1.0; part x: [b; 1000000000] = |i| b {}; part y: [b; 9] = |i| b {}; }
        mod b { port p: Frame; param m = 1.0; part x: [a; 9] = |i| a {}; part y: a {}; }
        mod model { part x: a {}; param big: [Vec3; 100000000000] = q; }
        mod model { param other = 1.0; }",
    );
    assert!(text.len() < 10_000_000);
    assert_eq!(text.matches("modmodel").count(), 1);
}
