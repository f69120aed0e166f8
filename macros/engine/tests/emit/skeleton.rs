//! What stands beside errors has the names that the model would have had.

use multibody_engine::{commented, expand};
use proc_macro2::TokenStream;

/// All that a call expands to, errors first, without spaces.
fn expanded(text: &str) -> String {
    written(expand(text.parse().expect("tokens")))
}

/// The same without what editors alone follow.
fn modules(text: &str) -> String {
    written(commented(text.parse().expect("tokens")))
}

fn written(tokens: TokenStream) -> String {
    syn::parse2::<syn::File>(tokens.clone()).expect("items");
    tokens.to_string().split_whitespace().collect()
}

/// The modules beside the errors.
fn skeletons_of(text: &str) -> String {
    let text = expanded(text);
    assert!(text.contains("compile_error!"), "no error");
    let start = text.find("#[doc=\"Standsinfor").unwrap_or(0);
    text[start..].to_string()
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
        "pub(crate)modbroken{use::core::prelude::v1::*;use::mb::Real;",
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
        assert!(text.contains(piece), "{piece} is missing");
    }
    assert!(text.contains("pubwrong:T") && !text.contains("lost"));
    assert_eq!(text.matches("modbroken").count(), 1);
}

/// Orientations by quaternions are never guessed: a guess of one could not be compared.
#[test]
fn quaternions_stay_in_the_state() {
    let text = skeletons_of(
        "mod m {
            body plate { mass: 3.0, inertia: diag(1.0, 1.0, 1.0) }
            body ball { mass: 1.0, inertia: diag(1.0, 1.0, 1.0) }
            joint hinge: Universal { parent: ground, child: plate, axes: [X, Y] }
            joint free: Free { parent: plate, child: ball }
            constraint roll: Rolling { wheel: ball, radius: 0.25, on: plate }
            formulation { constraints: Reduced, independent: [hinge.first, free.x, free.y] }
        }",
    );
    let guess = text.split("pubstructGuess").nth(1).map_or("", |rest| rest.split('}').next().unwrap_or_default());
    assert!(guess.contains("pubhinge") && !guess.contains("pubfree"), "{guess}");
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
        "pubfnconstraint_jacobian(&self,_t:T,_q:&Position<T>)->::multibody::nalgebra::SMatrix<T,4,7>",
        "pubfnresidual(",
        "pubfninverse_dynamics(&self,_t:T,_state:&State<T>,_input:&Input<T>,_accel:&Velocity<T>)->Solved<T>",
        "pubfnkinematics(&self,_t:T,_state:&State<T>,_accel:&Velocity<T>)->::multibody::Kinematics<T,1>",
        "->::multibody::Kinematics<T,7>",
        "impl<T:Real>::multibody::ConstrainedforModel<T>",
    ] {
        assert!(text.contains(piece), "{piece} is missing");
    }
    assert!(!text.contains("guess"));
    let text = skeletons_of(&format!("mod broken {{ formulation {{ constraints: Reduced }} {items} }}"));
    for piece in ["pubguess:Guess<T>", "pubfnclose(", "pubresidual:T"] {
        assert!(text.contains(piece), "{piece} is missing");
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

const FOUR_BAR: &str = "
    body a { mass: 1.0, inertia: rod(1.0, 1.0, X) }
    body b { mass: 1.0, com: X, inertia: rod(1.0, 3.0, X) }
    body c { mass: 1.0, inertia: rod(1.0, 2.0, X) }
    joint ja: Revolute { parent: ground, child: a, axis: Z }
    joint jb: Revolute { parent: a.at(X), child: b, axis: Z }
    joint jc: Revolute { parent: ground.at(3 * X), child: c, axis: Z }
    joint jd: Revolute { parent: b.at(3 * X), child: c.at(2 * X), axis: Z }
    output p = c.position;";

/// A model without mistakes is there in full, whatever stands beside it.
#[test]
fn a_model_without_mistakes_stays_whole() {
    let good = modules(&format!("pub mod good {{ {FOUR_BAR} }}"));
    let bad = "pub mod bad { body a { mass: 0.0 } joint x: Prismatic { parent: ground, child: a, axis: X } }";
    let both = modules(&format!("pub mod good {{ {FOUR_BAR} }} {bad}"));
    assert_eq!(both.matches("compile_error!").count(), 1);
    assert!(both.contains(&good), "the good model has changed");
    let both = modules(&format!("{bad} pub mod good {{ {FOUR_BAR} }}"));
    assert!(both.ends_with(&good), "the good model has changed");
    // Mistakes that only the equations show.
    let bad = bad.replace("mass: 0.0", "mass: 1e308 * 1e308");
    let both = modules(&format!("{bad} pub mod good {{ {FOUR_BAR} }}"));
    assert_eq!(both.matches("compile_error!").count(), 1);
    assert!(both.ends_with(&good), "the good model has changed");
}

/// Whatever is wrong, the structs are those of the model that was meant.
#[test]
fn stand_ins_have_the_types_that_were_meant() {
    let structs = |text: &str| -> Vec<String> {
        let starts = text.match_indices("pubstruct");
        let declared = starts.filter_map(|(at, _)| text[at..].split_once('}').map(|(item, _)| item.to_string()));
        let names = ["Position<", "Velocity<", "State<", "Params<", "Input<", "Output<", "Derivative<", "States<"];
        let plain = |item: String| -> String {
            let mut out = String::new();
            let mut rest = item.as_str();
            while let Some((before, after)) = rest.split_once("#[doc=") {
                out += before;
                rest = after.split_once("\"]").map_or("", |(_, after)| after);
            }
            out + rest
        };
        declared.map(plain).filter(|item| names.iter().any(|name| item.contains(name))).collect()
    };
    let cases: &[(&str, &str, &str)] = &[
        ("", "com: X", "cmo: X"),
        ("", "com: X", "com: Q"),
        ("", "c.position", "c.positoin"),
        ("", "c.position", "cc.position"),
        ("", "c.position", "2.0 * (c.position + mistake)"),
        ("", "parent: b.at(3 * X)", "parent: bb.at(3 * X)"),
        ("", "parent: a.at(X)", "parent: a.at(XX)"),
        ("", "parent: ground.at(3 * X)", "prent: ground.at(3 * X)"),
        ("", "jb: Revolute", "jb: Revolut"),
        ("", "jd: Revolute", "jd: Hinge"),
        ("", "mass: 1.0", "mass: -1.0"),
        ("", "mass: 1.0", "mass 1.0"),
        ("param m: Vec3 = [1.0, 2.0, 3.0];", "m: Vec3", "m: Vector3"),
        ("param m = [1.0, 2.0, 3.0];", "[1.0, 2.0, 3.0]", "[1.0, 2.0, pi]"),
        ("param m = 2.0 * X;", "2.0 * X", "2.0 * X + Q"),
        ("input u: [Scalar; 3];", "[Scalar; 3]", "[scalar; 3]"),
        ("input f: Vec3; force w: Force { at: b, value: f, axes: ground }", "at: b", "on: b"),
        ("input f; force w: Effort { joint: ja, value: f }", "joint: ja", "joint: joa"),
        ("state s: rate = 1.0 - s, start: 0.0;", "1.0 - s", "1.0 - ss"),
        ("output v = b.velocity.x;", "b.velocity", "b.velocty"),
        ("output r = ja.reaction;", "reaction", "reactin"),
        ("output n = norm(b.velocity);", "norm", "nrom"),
        ("output n = cross(b.velocity, X);", "b.velocity", "b.speed"),
        ("output n = [b.velocity, c.velocity];", "c.velocity", "c.speed"),
        ("param k = 2.0; output n = k * X;", "k * X", "kk * X"),
        ("formulation { constraints: Reduced, independent: ja }", "mass: 1.0", "mas: 1.0"),
        (
            "formulation { constraints: Reduced } solve (jb, jc) from jd { sin(ja + jb - jc) > 0.0 }",
            "sin(ja + jb - jc) > 0.0",
            "sin(ja + jbb - jc) > 0.0",
        ),
        (
            "formulation { constraints: Reduced } solve (jb, jc) from jd { sin(ja + jb - jc) > 0.0 }",
            "Reduced",
            "Reducd",
        ),
        ("formulation { coordinates: Absolute(RollPitchYaw) }", "com: X", "comm: X"),
        ("drive ja = 2.0 * t;", "2.0 * t", "2.0 * tt"),
        ("drive ja = 2.0 * t;", "axis: Z", "axes: Z"),
        ("#[allow(unphysical_inertia)]", "allow(unphysical_inertia)", "allow(unphysical)"),
    ];
    let mut wrong = String::new();
    for (more, right, mistake) in cases {
        let text = format!(
            "pub mod m {{ {FOUR_BAR} {more} {} }}",
            if more.starts_with('#') {
                "body z { mass: 1.0, inertia: diag(1.0, 1.0, 1.0) } joint jz: Free { parent: ground, child: z }"
            } else {
                ""
            }
        );
        let meant = expanded(&text);
        assert!(!meant.contains("compile_error!"), "{more}: {}", &meant[..200]);
        assert!(text.contains(right), "{right}");
        // The last one: items of the case come last.
        let at = text.rfind(right).expect("there");
        let found = expanded(&format!("{}{mistake}{}", &text[..at], &text[at + right.len()..]));
        let errors = found.matches("compile_error!").count();
        if errors != 1 {
            wrong += &format!("{more} {mistake}: {errors} errors\n");
        }
        let (meant, found) = (structs(&meant), structs(&found));
        for item in &meant {
            // Where a frame is unknown so is the number of equations that don't follow from others.
            if ["bb.at", "XX"].iter().any(|unknown| mistake.contains(unknown)) && item.contains("Derivative") {
                continue;
            }
            if !found.contains(item) {
                wrong += &format!("{more} {mistake}: no {item}\n");
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}
