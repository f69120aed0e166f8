//! Which velocities a model has: rates, those that constraints of velocities leave, and the user's own.

use multibody_engine::mechanics::analysis::analyse;
use multibody_engine::mechanics::loops::constraints::coordinate_name;
use multibody_engine::mechanics::loops::structure::{Means, Step, Structure};
use multibody_engine::model::types::{Coordinate, Model};

use multibody_engine::model::types::Request;
use multibody_engine::optimize::program::Compiled;
use multibody_engine::{chosen, compile};

use super::support::model_with;

const ARM: &str = "body x { mass: 1.0, com: [0.5, 0.1, 0.2], inertia: diag(0.1, 0.2, 0.3) }
     body y { mass: 1.0, com: [0.3, 0.2, 0.1], inertia: diag(0.1, 0.2, 0.15) }
     joint a: Revolute { parent: ground, child: x, axis: [0.1, 0.2, 1.0] }
     joint b: Revolute { parent: x.at(X), child: y, axis: [1.0, 2.0, 2.0] / 3.0 }
     let tip = y.at([0.7, 0.1, 0.0]);";

const SLED: &str = "body sled { mass: 2.0, com: [0.1, 0.2, 0.0], inertia: diag(1.0, 1.0, 1.0) }
     joint plane: Planar { parent: ground, child: sled, axis: [0.1, 0.2, 1.0] }
     formulation { constraints: Reduced }";

fn structure(items: &str) -> (Model, Structure) {
    let model = model_with("", items);
    let structure = analyse(&model).unwrap_or_else(|complaints| panic!("{complaints:?}"));
    (model, structure)
}

fn names(model: &Model, list: &[Coordinate]) -> Vec<String> {
    list.iter().map(|&coordinate| coordinate_name(model, coordinate)).collect()
}

fn complaints(items: &str) -> String {
    let found = analyse(&model_with("", items)).expect_err("a complaint");
    found.into_iter().map(|complaint| complaint.message).collect::<Vec<_>>().join("; ")
}

#[test]
fn rates_are_velocities_where_nothing_else_is_said() {
    let (model, structure) = structure(ARM);
    assert!(!structure.has_speeds());
    assert_eq!(names(&model, structure.speeds()), ["a", "b"]);
}

/// A speed takes the place of what it reads, and of nothing else.
#[test]
fn a_speed_takes_the_place_of_rates() {
    let (model, one) = structure(&format!("{ARM} speed u = (2.0 + sin(b)) * b.rate;"));
    assert_eq!(
        (names(&model, one.speeds()), names(&model, &one.rates.unknowns)),
        (vec!["a".into(), "u".into()], vec!["b".into()])
    );
    let (model, both) = structure(&format!("{ARM} speed u = tip.velocity.x; speed w = tip.velocity.y;"));
    assert_eq!(names(&model, both.speeds()), ["u", "w"]);
    assert_eq!(names(&model, &both.state), ["a", "b"]);
    assert!(both.notes.iter().any(|note| note == "rates that follow from velocities: `a`, `b`"), "{:?}", both.notes);
}

/// Of equations of velocities the rates that stay are those in which the others are best determined, or the user's.
#[test]
fn what_constraints_leave() {
    let blade = "constraint blade = sled.express(sled.velocity).y - 0.3 * plane.angle.rate;";
    let (model, left) = structure(&format!("{SLED} {blade}"));
    assert_eq!((left.speeds().len(), left.rates.unknowns.len(), left.rows.len()), (2, 1, 0));
    assert_eq!(left.rates.held, left.rates.unknowns);
    assert_eq!(names(&model, &left.state), ["plane.x", "plane.y", "plane.angle"]);
    let (model, named) =
        structure(&format!("{} {blade}", SLED.replace("Reduced", "Reduced, independent: [plane.x, plane.angle]")));
    assert_eq!(names(&model, named.speeds()), ["plane.x", "plane.angle"]);
    let ahead = "speed ahead = sled.express(sled.velocity).x;";
    let (model, chosen) = structure(&format!("{SLED} {blade} {ahead}"));
    assert_eq!(names(&model, chosen.speeds()), ["plane.angle", "ahead"]);
    // Forces are those of the constraint alone.
    assert_eq!((chosen.rates.held.len(), chosen.rates.unknowns.len()), (1, 2));
}

/// Two blades in line let a body move along them alone. Where it is declared to stand that is along one axis of its plane, of which the other says nothing.
#[test]
fn velocities_hold_where_coordinates_are_declared_to_stand() {
    for (along, kept) in [("X", "plane.x"), ("Y", "plane.y")] {
        let items = format!(
            "formulation {{ constraints: Reduced }}
            body sled {{ mass: 5.0, com: 0.1 * X, inertia: diag(1.0, 1.1, 1.2) }}
            joint plane: Planar {{ parent: ground, child: sled, axis: Z }}
            constraint front: Skate {{ blade: sled.at(0.5 * {along}), along: {along} }}
            constraint rear: Skate {{ blade: sled.at(-0.5 * {along}), along: {along} }}"
        );
        let (model, structure) = structure(&items);
        assert_eq!(names(&model, structure.speeds()), [kept]);
    }
}

/// All velocities are speeds, of which constraints make one zero: it isn't there.
#[test]
fn redundant_blades() {
    let (model, left) = structure(&format!(
        "{SLED} constraint one = sled.express(sled.velocity).y;
         constraint other = 2.0 * sled.express(sled.velocity).y;
         speed ahead = sled.express(sled.velocity).x;"
    ));
    assert_eq!(names(&model, left.speeds()), ["plane.angle", "ahead"]);
    assert_eq!(left.dropped.len(), 1);
}

/// Beside equations that keep multipliers all rates count, and these equations none.
#[test]
fn beside_multipliers() {
    let (model, kept) = structure(&format!(
        "{} constraint blade = sled.express(sled.velocity).y - 0.3 * plane.angle.rate;
         speed ahead = sled.express(sled.velocity).x;
         speed aside = sled.express(sled.velocity).y;",
        SLED.replace("Reduced", "Multipliers")
    ));
    assert_eq!(names(&model, kept.speeds()), ["plane.angle", "ahead", "aside"]);
    assert_eq!((kept.rows.len(), kept.rates.rows.len(), kept.rates.held.len()), (1, 0, 0));
}

/// What a coupling gives may follow from what an equation gives, and the other way about, before rates follow from velocities: the height
/// of a wheel stands alone all the same.
#[test]
fn a_coupling_whose_dependent_must_follow_at_the_start() {
    let model = model_with(
        "",
        "body sled { mass: 1.0, com: [0.01, 0.02, 0.03], inertia: diag(0.1, 0.12, 0.13) }
        body rider { mass: 0.7, com: [0.1, 0.02, 0.03], inertia: diag(0.02, 0.012, 0.013) }
        joint float: Free { parent: ground, child: sled, coordinates: RollPitchYaw }
        joint seat: Ball { parent: sled, child: rider, coordinates: RollPitchYaw }
        constraint blade: Skate { blade: sled, along: X }
        constraint product = float.yaw + 0.1 * sin(float.yaw) + seat.yaw * seat.roll;
        formulation { constraints: Reduced }
        emit mass_matrix;",
    );
    assert!(compile(&model).is_ok());
}

#[test]
fn couplings_beside_wheels() {
    let disc = "body disc { mass: 1.0, com: [0.01, 0.02, 0.03], inertia: diag(0.1, 0.12, 0.13) }
        body rider { mass: 0.7, com: [0.1, 0.02, 0.03], inertia: diag(0.02, 0.012, 0.013) }
        joint float: Free { parent: ground, child: disc, coordinates: RollPitchYaw }
        joint slide: Prismatic { parent: disc.at([0.1, 0.2, 0.3]), child: rider, axis: [1, 2, 0.5] }
        constraint roll: Rolling { wheel: disc, axis: [0.1, 1, 0.2], radius: 0.255, on: ground }
        formulation { constraints: Reduced }";
    for couplings in [
        "constraint one = float.pitch + float.roll;",
        "constraint one = -1.777 * float.pitch + 1.1 * float.roll + 0.7;",
        "constraint one = 1.3 * float.pitch + float.roll - 0.2 * slide;
         constraint other = slide - 0.3 * sin(float.roll) - 0.1 * float.x;",
        // The height leads back to itself: it doesn't stand alone.
        "constraint one = float.pitch + float.roll - 2.0 * float.z;",
    ] {
        let model = model_with(
            "",
            &format!(
                "world {{ gravity: [0.3, -0.2, -9.7] }} {disc} {couplings} emit forward_dynamics, energy, bias, mass_matrix;"
            ),
        );
        let (structure, _) = compile(&model).unwrap_or_else(|_| panic!("{couplings}"));
        let explicit = |step: &Step| matches!(step.means, Means::Explicit(_));
        let found: Vec<Coordinate> =
            structure.steps.iter().filter(|step| explicit(step)).flat_map(|step| step.unknowns.clone()).collect();
        assert_eq!(
            names(&model, &found).contains(&"float.z".to_owned()),
            !couplings.contains("float.z"),
            "{couplings}"
        );
    }
}

/// Couplings that lead to each other, and to what an iteration finds, in any order.
#[test]
fn couplings_that_lead_on() {
    let chain = "body a { mass: 1.3, com: [0.31, 0.07, 0.02], inertia: diag(0.1, 0.2, 0.25) }
        body b { mass: 0.6, com: [0.1, 0.2, 0.3], inertia: diag(0.1, 0.2, 0.25) }
        body c { mass: 0.7, com: [0.1, -0.2, 0.3], inertia: diag(0.2, 0.2, 0.25) }
        body d { mass: 0.8, com: [0.3, -0.2, 0.3], inertia: diag(0.2, 0.3, 0.25) }
        joint p: Revolute { parent: ground, child: a, axis: [1, 2, 2] } joint q: Revolute { parent: a, child: b, axis: Y }
        joint r: Prismatic { parent: ground, child: c, axis: X } joint z: Revolute { parent: c, child: d, axis: [0.1, 0.2, 1] }
        world { gravity: [0.3, -0.2, -9.7] } emit forward_dynamics, energy, bias, poses;";
    let links = ["constraint one = q - 0.37 * p - 0.2 * r;", "constraint two = r - 0.3 * z;"];
    for last in ["constraint three = z - 0.1 * sin(p);", "constraint three = z - 0.2 * r * q;"] {
        for order in [[0, 1], [1, 0]] {
            for independent in ["", ", independent: [p]"] {
                let couplings: String = order.map(|k| links[k]).concat();
                let items = format!("{chain} {couplings} {last} formulation {{ constraints: Reduced{independent} }}");
                assert!(compile(&model_with("", &items)).is_ok(), "{couplings} {last} {independent}");
            }
        }
    }
}

/// Speeds that are nothing in whole regions are told by name; what vanishes in single poses is the user's.
#[test]
fn speeds_in_pieces() {
    let slider =
        "body b { mass: 1.0, inertia: diag(0.1, 0.1, 0.2) } joint p: Planar { parent: ground, child: b, axis: Z }";
    let analysed = |speed: &str| {
        analyse(&model_with(
            "",
            &format!("{slider} speed v = p.y.rate; speed u = {speed}; speed w = p.angle.rate + 0.3 * p.y.rate;"),
        ))
    };
    for speed in ["max(p.x, 0.0) * p.x.rate", "select(p.x > p.y, 1.0, 0.0) * p.x.rate + p.y.rate"] {
        let said = analysed(speed).expect_err(speed);
        assert!(
            said[0].message.starts_with("in many poses the speed `u` tells nothing"),
            "{speed}: {}",
            said[0].message
        );
    }
    assert!(analysed("p.x * p.x.rate").is_ok() && analysed("abs(p.x) * p.x.rate").is_ok());
}

#[test]
fn mistakes() {
    let blade = "constraint blade = sled.express(sled.velocity).y;";
    for (items, told) in [
        (
            format!("{ARM} speed u = a.rate * b.rate;"),
            "the speed `u` is not linear in velocities: what stands before `a.rate` holds `b.rate`",
        ),
        (
            format!("{ARM} speed u = a.rate + 0.1 * signum(b.rate);"),
            "the speed `u` is not linear in velocities: it reads `b.rate` in a function in pieces",
        ),
        (format!("{ARM} speed u = 0.0 * a.rate;"), "the speed `u` is of velocities, but none of them has a say in it"),
        (
            format!("{ARM} drive a = sin(t); speed u = 2.0 * a.rate;"),
            "the speed `u` is of velocities that are given: none that is free has a say in it",
        ),
        (
            format!("{ARM} speed u = a.rate + b.rate;"),
            "1 speed doesn't determine the rates that it reads: `a.rate`, `b.rate`",
        ),
        (format!("{ARM} speed u = a.rate; speed w = 2.0 * a.rate;"), "the speed `w` follows from other speeds"),
        (
            format!("{SLED} {blade} speed u = sled.express(sled.velocity).y + t;"),
            "the speed `u` follows from other speeds and from the constraints",
        ),
        (
            format!("{SLED} {blade} speed u = plane.x.rate; speed v = plane.y.rate; speed w = plane.angle.rate;"),
            "the speed `v` follows from other speeds and from the constraints",
        ),
        (
            format!("{} {blade} speed u = sled.express(sled.velocity).x;", SLED.replace("Reduced", "Multipliers")),
            "1 speed doesn't determine the rates that it reads: `plane.x.rate`, `plane.y.rate`",
        ),
        (
            format!(
                "{} {blade} speed u = plane.x.rate; speed v = sled.express(sled.velocity).y; speed w = 2.0 * plane.x.rate;",
                SLED.replace("Reduced", "Multipliers")
            ),
            "the speed `w` follows from other speeds",
        ),
        (
            format!("{ARM} speed u = a.rate + 0.2; emit forward_dynamics, momentum;"),
            "the velocities of this model are not the rates of its coordinates: momenta are known in those alone",
        ),
    ] {
        assert_eq!(complaints(&items), told, "{items}");
    }
}

/// A body on three hinges, with what is between them to be named.
const GIMBAL: &str = "world { gravity: [0.3, -0.2, -9.7] }
     body cart { mass: 1.3 }
     body one { mass: 0 }
     body two { mass: 0 }
     body top { mass: 2.0, com: [0.1, -0.05, 0.3], inertia: inertia(0.3, 0.4, 0.5, 0.01, 0.02, -0.03) }
     joint slide: Prismatic { parent: ground, child: cart, axis: [1.0, 0.2, 0.1] }
     joint first: Revolute { parent: cart.at([0.1, 0.2, 0.3]), child: one, axis: [0.3, 1.0, 0.2] }
     joint second: Revolute { parent: one, child: two, axis: -[1.0, 0.1, -0.3] }
     joint third: Revolute { parent: two, child: top.at([0.1, 0.05, -0.1]).rotated(Z, 0.8), axis: -Z }
     let seen = top.rotated([1.0, -1.0, 2.0], 0.7);
     let w = seen.express(top.angular_velocity - cart.angular_velocity);";

const TURN: &str = "speed x = w.x; speed y = w.y; speed z = w.z;";

fn built(items: &str) -> (Model, Structure, Compiled) {
    let model = model_with("", items);
    let model = chosen(&model).unwrap_or_else(|_| panic!("{items}")).into_owned();
    let (structure, compiled) = compile(&model).unwrap_or_else(|_| panic!("{items}"));
    (model, structure, compiled)
}

/// Additions and products of forward dynamics, which hold the rates of positions.
fn operations(items: &str) -> u32 {
    let compiled = built(items).2;
    let cost = compiled.functions[0].after;
    cost.add + cost.mul
}

/// Three speeds that are a turn make hinges about one point a ball, and then only.
#[test]
fn hinges_become_a_ball() {
    let rates = operations(GIMBAL);
    let ball = operations(&format!("{GIMBAL} {TURN}"));
    assert!(ball + 40 < rates, "{ball} of {rates}");
    let written = "speed x = seen.express(top.angular_velocity).x; speed y = seen.express(top.angular_velocity).y;
         speed z = seen.express(top.angular_velocity).z;";
    assert_eq!(operations(&format!("{GIMBAL} {written}")), ball);
    let apart = GIMBAL.replace("child: two,", "child: two.at([0.0, 0.1, 0.0]),");
    for other in [
        format!("{GIMBAL} speed y = w.y; speed x = w.x; speed z = w.z;"),
        format!("{GIMBAL} speed x = w.x; speed y = w.y; speed z = w.z + w.x;"),
        format!(
            "{GIMBAL} speed x = w.x; speed y = seen.rotated(X, 0.1).express(top.angular_velocity).y; speed z = w.z;"
        ),
        format!("{apart} {TURN}"),
        format!("{GIMBAL} {TURN} output slope = diff(kinetic(), first.rate);"),
        format!("{GIMBAL} {TURN} drive slide = sin(t);"),
    ] {
        assert!(operations(&other) > ball + 50, "{other}");
    }
}

/// What is asked of hinges that a ball doesn't have stays known: forces between them, their rates, what acts on them.
#[test]
fn hinges_of_a_ball_stay_known() {
    let read = "output loads = [third.reaction.force, third.reaction.moment]; output turning = two.angular_velocity;
         output rates = [first.rate, second.accel]; force drag: Damper { joint: second, damping: 0.3 }
         force load: Torque { at: one, axes: top, value: [0.1, 0.2, 0.3] }";
    let (_, structure, _) =
        built(&format!("{GIMBAL} {TURN} {read} emit forward_dynamics, energy, inverse_dynamics, mass_matrix;"));
    assert_eq!(structure.rates.unknowns.len(), 3);
}

/// Never dearer than rates; what is chosen is told, with the rest.
#[test]
fn a_choice_by_counts() {
    let automatic = "formulation { speeds: Auto }";
    let (model, structure, compiled) = built(&format!("{GIMBAL} {automatic}"));
    assert_eq!(names(&model, structure.speeds()), ["slide", "top_omega_x", "top_omega_y", "top_omega_z"]);
    let cost = compiled.functions[0].after;
    assert!(cost.add + cost.mul < operations(GIMBAL));
    let [remark] = &model.remarks[..] else { panic!("{:?}", model.remarks) };
    assert!(remark.starts_with("`speeds: Auto` takes turns of bodies about their own axes: "), "{remark}");
    assert!(remark.contains("; rates of coordinates: ") && remark.contains("work "), "{remark}");
    // On what slides, turns against the ground are the same.
    assert!(!remark.contains("turns of bodies against the ground"), "{remark}");
    // Nothing turns freely: there is nothing to choose.
    let (model, structure, _) = built(&format!("{ARM} {automatic}"));
    assert!(model.remarks.is_empty() && model.speeds.is_empty() && !structure.has_speeds());
    // A blade leaves the speed along it and the turn.
    let sled = SLED.replace("Reduced", "Reduced, speeds: Auto").replace("[0.1, 0.2, 1.0]", "Z");
    let (model, structure, _) = built(&format!("{sled} constraint blade = sled.express(sled.velocity).y;"));
    assert_eq!(structure.speeds().len(), 2);
    assert!(!model.speeds.is_empty() && model.emit == [Request::ForwardDynamics]);
    // What is refused with speeds stays in rates.
    let (model, _, _) = built(&format!("{GIMBAL} {automatic} emit forward_dynamics, momentum;"));
    assert!(model.speeds.is_empty());
}

/// Equations that keep multipliers take no speeds out, and are counted with them.
#[test]
fn a_choice_beside_multipliers() {
    let (model, structure, _) = built(&format!(
        "{GIMBAL} constraint link: Rod {{ between: [ground.at([0.9, 0.5, 0.2]), top.at([0.3, 0.0, 0.1])], length: 0.8 }}
         formulation {{ constraints: Multipliers, speeds: Auto }}"
    ));
    let [remark] = &model.remarks[..] else { panic!("{:?}", model.remarks) };
    // Which of them is cheapest is not what this is about.
    assert!(remark.contains("turns of bodies about their own axes: ") && !remark.contains("refused"), "{remark}");
    assert_eq!(structure.has_speeds(), !model.speeds.is_empty());
}

/// All parts of an array have the same speeds, under names that are free.
#[test]
fn choices_in_parts() {
    let model = "mod limb {
            port carrier: Frame;
            body tail { mass: 0.2, com: [0.0, 0.1, 0.05], inertia: diag(0.01, 0.02, 0.03) }
            body bob { mass: 0.2, com: [0.02, 0.1, 0.05], inertia: inertia(0.02, 0.025, 0.03, 0.001, 0.002, 0.003) }
            joint hang: Ball { parent: carrier, child: bob, coordinates: RollPitchYaw }
            joint bob_omega_x: Revolute { parent: bob, child: tail, axis: Y }
        }";
    let items = "body base { mass: 1.0 } joint slide: Prismatic { parent: ground, child: base, axis: X }
        part limbs: [limb; 2] = |k| limb { carrier: base.at(0.5 * k * Y) };
        formulation { speeds: Auto }";
    let model = model_with(model, items);
    let model = chosen(&model).unwrap_or_else(|_| panic!("chosen"));
    let names: Vec<String> = model.speeds.iter().map(|speed| speed.place.field.to_string()).collect();
    assert_eq!(names, ["bob_omega_x_", "bob_omega_y", "bob_omega_z", "bob_omega_x_", "bob_omega_y", "bob_omega_z"]);
    assert!(compile(&model).is_ok());
}

/// Functions agree where a drive carries what turns.
#[test]
fn turns_on_a_drive() {
    let (_, structure, _) = built(&format!(
        "{GIMBAL} {TURN} drive slide = sin(3.0 * t); output turning = two.angular_velocity; output effort = slide.effort;
         emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;"
    ));
    assert_eq!(structure.rates.unknowns.len(), 3);
}
