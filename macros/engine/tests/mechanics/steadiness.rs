//! Of equations that follow from others the same ones are left out at every pose, so those that are kept must be independent at all of them:
//! wherever the plane of a loop stands, and all the way round of linkages that move though they should not.

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

/// How far accelerations of Bennett's linkage are from those of its formulas, at the worst pose that is found by looking closer and closer
/// where it is bad.
#[test]
fn bennetts_linkage_moves_alike_at_all_poses() {
    for [a, b] in [[0.6, 1.1], [1.01, 1.164], [1.371, 0.347]] {
        let mechanism = Mechanism::new(&format!(
            "const B = sin({b:?}) / sin({a:?});
            world {{ gravity: [0.4, -1.1, -9.7] }}
            body one {{ mass: 1.0, com: [0.5, 0.1, 0.2], inertia: inertia(0.5, 0.6, 0.7, 0.02, -0.03, 0.01) }}
            body two {{ mass: 0.7, com: [1.1, -0.2, 0.1], inertia: inertia(0.3, 0.2, 0.4, 0.01, 0.02, -0.01) }}
            body three {{ mass: 1.3, com: [0.2, 0.3, -0.1], inertia: inertia(0.4, 0.5, 0.3, 0.03, 0.01, 0.02) }}
            joint first: Revolute {{ parent: ground.at([0.2, -0.4, 0.1]).rotated([1.0, 2.0, -0.5], 0.7), child: one, axis: Z }}
            joint second: Revolute {{ parent: one.at(X).rotated(X, {a:?}), child: two, axis: Z }}
            joint third: Revolute {{ parent: two.at(B * X).rotated(X, {b:?}), child: three, axis: Z }}
            #[cut]
            joint fourth: Revolute {{
                parent: three.at(X).rotated(X, {a:?}), child: ground.at([0.2, -0.4, 0.1]).rotated([1.0, 2.0, -0.5], 0.7).rotated(X, -{b:?}).at(-B * X), axis: Z,
            }}"
        ));
        let (half, off) = (0.5 * (a + b), 0.5 * (b - a));
        let formulas = format!(
            "formulation {{ constraints: Reduced }} solve (second, third) =
            (2.0 * atan2(sin({half:?}) / sin({off:?}) * cos(0.5 * first.angle), sin(0.5 * first.angle)), -first.angle);"
        );
        let base = mechanism.with_motion(&formulas, true).expect("a derivation");
        let first = Symbol::Position { joint: base.joint("first"), component: 0 };
        for formulation in ["formulation { constraints: Multipliers }", "formulation { constraints: Reduced }"] {
            let case = mechanism.with_motion(formulation, false).expect("a derivation");
            let error = |angle: f64| {
                let mut point = base.random(7);
                point.set(first, angle);
                let motion = mechanism.motion_from(&base, &point).expect("a motion");
                let (of, from) = (mechanism.adopt(&case, &base, &motion), mechanism.adopt(&base, &base, &motion));
                let (found, wanted) = (case.outputs(&of), base.outputs(&from));
                let differences = (0..3).flat_map(|k| {
                    let name = format!("acceleration_{k}");
                    let size = wanted[&name].iter().fold(1.0_f64, |most, x| most.max(x.abs()));
                    let pairs = found[&name].iter().zip(&wanted[&name]);
                    pairs.map(|(a, b)| (a - b).abs() / size).collect::<Vec<f64>>()
                });
                differences.fold(0.0, |most, x| if x.is_finite() { f64::max(most, x) } else { f64::INFINITY })
            };
            let (mut centre, mut reach) = (0.03, 3.2);
            let mut worst = 0.0_f64;
            for _ in 0..8 {
                let angles = (-20..=20).map(|k| centre + reach * f64::from(k) / 20.0);
                let (angle, most) = angles.map(|x| (x, error(x))).max_by(|a, b| a.1.total_cmp(&b.1)).expect("some");
                (centre, reach, worst) = (angle, reach / 10.0, worst.max(most));
            }
            assert!(worst < 1e-9, "{a} and {b}, {formulation}: {worst:e} at {centre}");
        }
    }
}
