//! Loops in a plane that turns: of the equations that follow from others the same ones are left out at every pose, so those that are kept must
//! be independent wherever the plane stands.

use std::f64::consts::FRAC_PI_2;

use multibody_engine::contracts::symbol::Symbol;

use super::alike::Mechanism;
use super::support::*;

/// A four-bar on a carrier that tilts about a level axis, askew in the carrier; its plane is level where the tilt is zero.
const TILTED: &str = "
    world { gravity: [0.4, -1.1, -9.7] }
    body carrier { mass: 2.0, com: [0.1, -0.2, 0.3], inertia: inertia(0.3, 0.4, 0.35, 0.02, -0.01, 0.03) }
    body one { mass: 1.0, com: [0.5, 0.1, 0.2], inertia: inertia(0.5, 0.6, 0.7, 0.02, -0.03, 0.01) }
    body two { mass: 0.7, com: [1.1, -0.2, 0.1], inertia: inertia(0.3, 0.2, 0.4, 0.01, 0.02, -0.01) }
    body three { mass: 1.3, com: [0.2, 0.3, -0.1], inertia: inertia(0.4, 0.5, 0.3, 0.03, 0.01, 0.02) }
    joint tilt: Revolute { parent: ground.at([0.1, 0.2, 0.7]).rotated(Z, HEADING), child: carrier, axis: X }
    joint crank: Revolute { parent: carrier.at([0.2, 0.1, -0.3]), child: one, axis: Z }
    joint coupler: Revolute { parent: one.at(1.0 * X), child: two, axis: Z }
    joint follower: Revolute { parent: carrier.at([2.3, 0.4, -0.3]), child: three, axis: Z }
    #[cut] joint pin: Revolute { parent: two.at(2.1 * X), child: three.at(1.5 * X), axis: Z }";

#[test]
fn equations_are_enough_wherever_the_plane_stands() {
    // Askew to the world, and about its axes.
    for heading in [0.4, 0.0, FRAC_PI_2] {
        tilt(heading);
    }
}

fn tilt(heading: f64) {
    let mechanism = Mechanism::new(&TILTED.replace("HEADING", &format!("{heading:?}")));
    let base = mechanism.with_motion("formulation { constraints: Multipliers }", true).expect("a derivation");
    let tilt = Symbol::Position { joint: base.joint("tilt"), component: 0 };
    let mut seen = 0;
    for formulation in [
        "formulation { coordinates: Absolute(RollPitchYaw) }",
        "formulation { coordinates: Absolute(Quaternion) }",
        "formulation { constraints: Reduced }",
    ] {
        let case = mechanism.with_motion(formulation, false).expect("a derivation");
        for (number, off) in [0.3, 1e-2, 1e-4, -1e-5, 1e-6, 0.0].into_iter().enumerate() {
            for upright in [FRAC_PI_2, -FRAC_PI_2] {
                let mut point = base.random(40 + number as u64);
                for (joint, angle) in [("crank", 0.9), ("coupler", -1.1), ("follower", 1.4)] {
                    point.set(Symbol::Position { joint: base.joint(joint), component: 0 }, angle);
                }
                point.set(tilt, upright + off);
                let motion = mechanism.motion_from(&base, &point).expect("loops that close");
                let (of, from) = (mechanism.adopt(&case, &base, &motion), mechanism.adopt(&base, &base, &motion));
                let (found, wanted) = (case.outputs(&of), base.outputs(&from));
                for k in 0..4 {
                    for name in [format!("acceleration_{k}"), format!("spin_rate_{k}")] {
                        let what = format!("heading {heading}, {formulation}, {off:e} beside {upright}, {name}");
                        close(&what, &found[&name], &wanted[&name], 1e-9);
                        seen += 1;
                    }
                }
            }
        }
    }
    assert_eq!(seen, 3 * 6 * 2 * 8);
}
