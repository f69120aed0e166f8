//! What the analysis makes of constraints of velocities.

use multibody_engine::mechanics::analysis::analyse;
use multibody_engine::mechanics::loops::constraints::row_name;
use multibody_engine::mechanics::loops::structure::{DependentRates, Row, Structure};
use multibody_engine::model::types::Model;
use multibody_engine::{Trouble, compile};

use super::support::model_with;

const SLED: &str = "body sled { mass: 2.0, com: [0.1, 0.2, 0.0], inertia: diag(1.0, 1.0, 1.0) }
     joint plane: Planar { parent: ground, child: sled, axis: [0.1, 0.2, 1.0] }";

fn model(items: &str) -> Model {
    model_with("", &format!("{SLED} {items}"))
}

fn sound(model: &Model) -> Structure {
    analyse(model).unwrap_or_else(|complaints| panic!("{complaints:?}"))
}

fn names(model: &Model, rows: &[Row]) -> Vec<String> {
    rows.iter().map(|row| row_name(model, row.closing, row.index)).collect()
}

fn complaints(items: &str) -> String {
    let found = analyse(&model(items)).expect_err("a complaint");
    found.into_iter().map(|complaint| complaint.message).collect::<Vec<_>>().join("; ")
}

/// A car with two wheels on each axle: those of one axle can't slip sideways for the same reason.
#[test]
fn wheels_of_one_axle() {
    let car = model(
        "constraint left = sled.express(sled.at(0.7 * Y).velocity).y;
         constraint right = sled.express(sled.at(-0.7 * Y).velocity).y;
         constraint front = sled.express(sled.at(1.4 * X).velocity).y - 0.3 * plane.angle.rate;",
    );
    let structure = sound(&car);
    assert_eq!(names(&car, &structure.rows), ["left", "front"]);
    assert_eq!(names(&car, &structure.dropped), ["right"]);
    assert!(!structure.redundant && structure.independent.is_empty());
    assert!(structure.notes.iter().any(|note| note.contains("redundant equations of velocities, left out: `right`")));
}

/// Four wheels that Ackermann's law steers turn about one point, so one on each axle says it all; on any road, and of wheels that roll
/// what they say along stays.
#[test]
fn wheels_of_a_steered_car() {
    let road = "let road = ground.rotated([1.0, 0.4, 0.2], 0.7);
         body chassis { mass: 20.0, com: [0.5, 0.07, 0.2], inertia: diag(2.0, 3.0, 4.0) }
         body left { mass: 1.5, inertia: diag(0.1, 0.1, 0.1) }
         body right { mass: 1.5, inertia: diag(0.1, 0.1, 0.1) }
         joint plane: Planar { parent: road.at(0.3 * Z), child: chassis, axis: Z }
         joint steer_left: Revolute { parent: chassis.at([1.3, 0.4, 0.0]), child: left, axis: Z }
         joint steer_right: Revolute { parent: chassis.at([1.3, -0.4, 0.0]), child: right, axis: Z }";
    let blades = "constraint rear_left: Skate { blade: chassis.at(0.4 * Y), along: X, on: road }
         constraint rear_right: Skate { blade: chassis.at(-0.4 * Y), along: X, on: road }
         constraint front_left: Skate { blade: left, along: X, on: road }
         constraint front_right: Skate { blade: right, along: X, on: road }";
    let wheels = "body one { mass: 1.0, inertia: diag(0.02, 0.03, 0.02) }
         body two { mass: 1.0, inertia: diag(0.02, 0.03, 0.02) }
         body three { mass: 1.0, inertia: diag(0.02, 0.03, 0.02) }
         body four { mass: 1.0, inertia: diag(0.02, 0.03, 0.02) }
         joint first: Revolute { parent: chassis.at(0.4 * Y), child: one, axis: Y }
         joint second: Revolute { parent: chassis.at(-0.4 * Y), child: two, axis: Y }
         joint third: Revolute { parent: left, child: three, axis: Y }
         joint fourth: Revolute { parent: right, child: four, axis: Y }
         constraint rear_left: Rolling { wheel: one, axis: Y, radius: 0.3, on: road }
         constraint rear_right: Rolling { wheel: two, axis: Y, radius: 0.3, on: road }
         constraint front_left: Rolling { wheel: three, axis: Y, radius: 0.3, on: road }
         constraint front_right: Rolling { wheel: four, axis: Y, radius: 0.3, on: road }";
    let aside = ["rear_right.across", "front_right.across"];
    // cot(right) - cot(left) is track by base; the second is that times all that it divides by.
    for law in [
        "cos(steer_right) / sin(steer_right) - cos(steer_left) / sin(steer_left) - 0.8 / 1.3",
        "1.3 * sin(steer_left - steer_right) - 0.8 * sin(steer_left) * sin(steer_right)",
    ] {
        for (ground, left_out, kept) in [
            (blades, vec![], vec!["rear_left.across", "front_left.across"]),
            (
                wheels,
                vec!["rear_left.touch", "rear_right.touch", "front_left.touch", "front_right.touch"],
                vec![
                    "rear_left.along",
                    "rear_left.across",
                    "rear_right.along",
                    "front_left.along",
                    "front_left.across",
                    "front_right.along",
                ],
            ),
        ] {
            let car = model_with("", &format!("{road} constraint steering = {law}; {ground}"));
            let structure = sound(&car);
            assert_eq!(names(&car, &structure.dropped), [&left_out[..], &aside].concat(), "{law}");
            assert_eq!(names(&car, &structure.rows), [&["steering"], &kept[..]].concat(), "{law}");
            let told = "redundant equations of velocities, left out: `rear_right.across` (from `rear_left.across`), \
                        `front_right.across` (from `rear_left.across`, `front_left.across`)";
            assert!(structure.notes.iter().any(|note| note.contains(told)), "{:?}", structure.notes);
        }
    }
    // Whatever track and base are: with others the law is kept at other angles. Where they are the law's alone it holds as declared only.
    let law = "cos(steer_right) / sin(steer_right) - cos(steer_left) / sin(steer_left) - 2.0 * half / base";
    let open = format!("param half = 0.4; param base = 1.3; {road} constraint steering = {law}; {blades}");
    let adjusted = open.replace("1.3, ", "base, ").replace("0.4 * Y", "half * Y").replace("0.4, 0.0]", "half, 0.0]");
    let car = model_with("", &adjusted);
    assert_eq!(names(&car, &sound(&car).dropped), aside);
    let told: Vec<String> =
        analyse(&model_with("", &open)).expect_err("a complaint").into_iter().map(|one| one.message).collect();
    assert_eq!(
        told,
        [
            "the constraint `front_right.across` follows from `rear_left.across`, `front_left.across`, or contradicts that, wherever it was looked at"
        ]
    );
    // By another law the wheels are at odds, and all say something.
    let odd = model_with("", &format!("{road} constraint steering = steer_right - 0.8 * steer_left; {blades}"));
    let structure = sound(&odd);
    assert_eq!(names(&odd, &structure.dropped), ["rear_right.across"]);
}

/// Rows that are independent at some time, or with a velocity that is driven, stay.
#[test]
fn what_is_independent_at_other_times_stays() {
    for more in ["sin(t) * plane.y.rate", "0.3 * sin(t) * plane.angle.rate - 0.1"] {
        let timed = model(&format!("constraint one = plane.x.rate; constraint two = plane.x.rate + {more};"));
        let structure = sound(&timed);
        assert_eq!(names(&timed, &structure.rows), ["one", "two"], "{more}");
        assert!(!structure.redundant && structure.dropped.is_empty());
    }
    let steered = model(
        "let h = 0.3 * sin(t);
         constraint steer = cos(h) * plane.y.rate - sin(h) * plane.x.rate;
         constraint rail = plane.y.rate;",
    );
    assert_eq!(names(&steered, &sound(&steered).rows), ["steer", "rail"]);
}

/// A wheel in an upright plane can't slip aside.
#[test]
fn what_is_zero_whatever_moves() {
    let wheel = model_with(
        "",
        "body wheel { mass: 1.0, inertia: diag(1.0, 1.3, 1.0) }
         joint plane: Planar { parent: ground, child: wheel, axis: Y }
         constraint aside = dot(wheel.velocity, Y);
         constraint along = wheel.velocity.x - 0.3 * plane.angle.rate;",
    );
    let structure = sound(&wheel);
    assert_eq!(names(&wheel, &structure.rows), ["along"]);
    assert_eq!(names(&wheel, &structure.dropped), ["aside"]);
}

/// Rates of a closed loop depend on its equations of positions.
#[test]
fn rates_of_what_positions_hold() {
    let held = model(
        "constraint rod = plane.x - 0.3 * plane.angle;
         constraint same = plane.x.rate - 0.3 * plane.angle.rate;
         constraint blade = sled.express(sled.velocity).y;",
    );
    let structure = sound(&held);
    assert_eq!(names(&held, &structure.dropped), ["same"]);
    assert!(names(&held, &structure.rows).contains(&"blade".to_owned()));
}

/// A linear coupling stands before what it reads: of two angles of a disc that rolls the one follows from the other, which the height gives.
#[test]
fn rates_behind_what_a_coupling_reads() {
    let disc = model_with(
        "",
        "body disc { mass: 1.0, inertia: diag(0.1, 0.1, 0.1) }
         joint float: Free { parent: ground, child: disc, coordinates: RollPitchYaw }
         constraint height = float.z - 0.3 * cos(float.roll) * cos(float.pitch);
         constraint equal = float.pitch + float.roll;
         constraint ahead = disc.velocity.x - 0.3 * disc.angular_velocity.y;
         formulation { constraints: Reduced }
         emit forward_dynamics, energy, inverse_dynamics, mass_matrix;",
    );
    // Its own check compares what is derived with what is asked for beside that.
    assert!(compile(&disc).is_ok_and(|(_, compiled)| compiled.sound));
}

/// A disc that always lies flat and a blade that always stands on end have no direction, in whatever axes; nor has what is nothing.
#[test]
fn nothing_by_nothing() {
    let coin = "body coin { mass: 1.0, inertia: diag(0.1, 0.1, 0.2) }";
    let axes = "[-sin(0.3) / sqrt(2), sin(0.3) / sqrt(2), cos(0.3)]";
    for items in [
        "joint plane: Planar { parent: ground, child: coin, axis: Z }
         constraint roll: Rolling { wheel: coin, axis: Z, radius: 0.3 }"
            .to_owned(),
        "joint hinge: Revolute { parent: ground, child: coin, axis: Z }
         constraint roll: Rolling { wheel: coin, axis: -2 * Z, radius: 0.3 }"
            .to_owned(),
        format!(
            "joint plane: Planar {{ parent: ground.rotated([1, 2, 3], 0.7), child: coin, axis: Z }}
             constraint roll: Rolling {{ wheel: coin.rotated([1, 1, 0], 0.3), axis: {axes}, radius: 0.3, on: ground.rotated([1, 2, 3], 0.7) }}"
        ),
        "joint plane: Planar { parent: ground, child: coin, axis: Z }
         constraint roll: Skate { blade: coin, along: Z }"
            .to_owned(),
        "joint plane: Planar { parent: ground, child: coin, axis: Z }
         force touch: Contact { at: coin, axis: Z, radius: 0.3, stiffness: 1e4, damping: 0.1 }"
            .to_owned(),
        "joint plane: Planar { parent: ground, child: coin, axis: Z }
         output o = (plane.x - plane.x) / (plane.y - plane.y);"
            .to_owned(),
        "joint plane: Planar { parent: ground, child: coin, axis: Z }
         output way = (coin.position - coin.position) / norm(coin.position - coin.position);"
            .to_owned(),
    ] {
        let model = model_with("", &format!("{coin} {items}"));
        let said = analyse(&model).expect_err(&items);
        let said: Vec<&str> = said.iter().map(|complaint| complaint.message.as_str()).collect();
        assert_eq!(said, ["this divides by what is zero wherever the mechanism stands"], "{items}");
    }
    // Powers and logarithms are poles too, and so is what no position tells.
    for (output, what) in [
        ("(plane.x - plane.x) * powi(norm(coin.position - coin.position), -1)", "a negative power of"),
        ("(plane.x - plane.x) * powf(plane.y - plane.y, -0.5)", "a negative power of"),
        ("(plane.x - plane.x) * ln(plane.y - plane.y)", "the logarithm of"),
    ] {
        let items =
            format!("{coin} joint plane: Planar {{ parent: ground, child: coin, axis: Z }} output o = {output};");
        let said = analyse(&model_with("", &items)).expect_err(output);
        assert_eq!(said[0].message, format!("this is {what} what is zero wherever the mechanism stands"), "{output}");
    }
    for divisor in ["t - t", "plane.x.rate - plane.x.rate", "push - push", "norm(cross(coin.velocity, coin.velocity))"]
    {
        let items = format!(
            "{coin} joint plane: Planar {{ parent: ground, child: coin, axis: Z }}
             input push: Scalar; output o = plane.x / ({divisor});"
        );
        let said = analyse(&model_with("", &items)).expect_err(divisor);
        assert_eq!(said[0].message, "this divides by what is zero wherever the mechanism stands", "{divisor}");
    }
    // Drives keep the disc flat and the blade on end, in oblique axes.
    for kept in [
        "drive lean = 0.0; constraint roll: Rolling { wheel: wheel, axis: [1, 2, 2], radius: 0.3, on: ground.rotated([2, -1, 1], 0.4) }",
        "drive lean = 0.3 * (t - t); constraint roll: Skate { blade: wheel, along: [1, 2, 2], on: ground.rotated([2, -1, 1], 0.4) }",
    ] {
        let items = format!(
            "{coin} body wheel {{ mass: 1.0, inertia: diag(0.1, 0.1, 0.2) }}
             joint plane: Planar {{ parent: ground.rotated([2, -1, 1], 0.4), child: coin, axis: Z }}
             joint lean: Revolute {{ parent: coin, child: wheel.rotated([2, -1, 0] / norm([2, -1, 0]), -acos(2.0 / 3.0)), axis: X }}
             {kept}"
        );
        let said = analyse(&model_with("", &items)).expect_err(kept);
        let said: Vec<&str> = said.iter().map(|complaint| complaint.message.as_str()).collect();
        assert_eq!(said, ["this divides by what is zero wherever drives keep the mechanism"], "{kept}");
    }
    // Couplings keep the blade on end, loops the plane flat.
    let level = "joint plane: Planar { parent: ground, child: coin, axis: Z }
        body mid { mass: 1.0, inertia: diag(0.1, 0.1, 0.2) }
        body blade { mass: 1.0, inertia: diag(0.1, 0.1, 0.2) }
        joint lean: Revolute { parent: coin, child: mid, axis: X }
        joint back: Revolute { parent: mid, child: blade, axis: X }
        constraint level = lean + back;";
    let flat = "joint plane: Planar { parent: ground, child: coin, axis: Z }
        constraint roll: Skate { blade: coin, along: Z }
        formulation { coordinates: Absolute(Quaternion) }";
    for items in [
        &format!("{level} constraint roll: Skate {{ blade: blade, along: Z }} formulation {{ constraints: Reduced }}"),
        &format!("{level} constraint roll: Skate {{ blade: blade, along: Z }}"),
        &format!("{level} output o = (lean * lean - back * back) / (lean + back);"),
        flat,
    ] {
        let model = model_with("", &format!("{coin} {items}"));
        let said = analyse(&model).expect_err(items);
        let said: Vec<&str> = said.iter().map(|complaint| complaint.message.as_str()).collect();
        assert_eq!(said, ["this divides by what is zero wherever loops are closed"], "{items}");
    }
    let meant = format!("{level} output o = lean / max(abs(lean + back), 1e-9);");
    assert!(analyse(&model_with("", &format!("{coin} {meant}"))).is_ok());
    // Where a choice is made nothing is divided.
    let chosen = "joint plane: Planar { parent: ground, child: coin, axis: Z }
        output o = select(plane.x > 0.0, plane.x / (plane.y - plane.y), 2.0);";
    let model = model_with("", &format!("{coin} {chosen}"));
    assert!(analyse(&model).is_ok());
}

/// What no item shows by itself: the divisor is zero once couplings, drives and states stand in it, and its slopes would be nothing.
#[test]
fn nothing_by_nothing_behind_couplings_and_drives() {
    let slides = "body a { mass: 1.0, inertia: diag(1, 1, 1) } body b { mass: 2.0, inertia: diag(1, 1, 1) }
        body c { mass: 2.0, inertia: diag(1, 1, 1) }
        joint x: Prismatic { parent: ground, child: a, axis: [1, 2, 2] } joint y: Prismatic { parent: ground, child: b, axis: X }
        joint z: Prismatic { parent: ground, child: c, axis: Y }";
    let refused = |items: &str| match compile(&model_with("", &format!("{slides} {items}"))) {
        Err(Trouble::Complaints(list)) => list[0].message.clone(),
        Err(_) => "another trouble".to_owned(),
        Ok(_) => "none".to_owned(),
    };
    for items in [
        "constraint tie = x - y; constraint roll = z.rate - 0.5 * x.rate * (x - y) / ((x - y) * (2.0 + sin(t)));",
        "constraint tie = x - y - 0.3 * t; constraint roll = z.rate - 0.5 * x.rate * (x - y - 0.3 * t) / ((x - y - 0.3 * t) * (2.0 + z));",
        "state s: rate = 0.1, start: 0.2; constraint tie = x - y; constraint roll = z.rate - x.rate * (x - y) / ((x - y) * (1.0 + s));",
        "drive y = 0.5 * PI; constraint roll = z.rate - x.rate * tan(y) * cos(y);",
        "drive y = 0.2; param n = -1.0; constraint roll = z.rate - x.rate * (y - 0.2) * powf(y - 0.2, n);",
        "drive y = 0.5 * PI; output o = tan(y);",
        "drive y = 0.2 * t; state s: rate = 0.1, start: 0.2; output o = select(x > 0.0, (y - 0.2 * t) / ((y - 0.2 * t) * (1.0 + s)), 2.0);",
    ] {
        for constraints in ["Reduced", "Multipliers"] {
            let told = refused(&format!("{items} formulation {{ constraints: {constraints} }}"));
            assert!(
                told.starts_with("its equations divide by what is zero") || told.contains("divides by what is zero"),
                "{items}: {told}"
            );
        }
    }
    assert_eq!(refused("drive y = 0.5 * t; constraint roll = z.rate - x.rate * tan(y) * cos(y);"), "none");
}

/// What meets where the mechanism is drawn does not have to stay together, where equations are of velocities alone.
#[test]
fn points_that_meet_at_the_start() {
    for constraints in ["Reduced", "Multipliers"] {
        let sled = model(&format!(
            "constraint blade: Skate {{ blade: sled, along: [0, 3, 4], on: ground }}
             force loss: Damper {{ between: [ground, sled], damping: 0.63 }}
             formulation {{ constraints: {constraints} }}"
        ));
        assert!(compile(&sled).is_ok(), "{constraints}");
    }
}

/// A disc that follows its height may come to lie flat, where its equations have no slopes: of what is left to move that says nothing.
#[test]
fn poses_without_slopes_say_nothing() {
    let disc = |independent: &str| {
        model_with(
            "",
            &format!(
                "body carrier {{ mass: 1.0, inertia: diag(0.1, 0.1, 0.1) }}
                 body disc {{ mass: 1.5, inertia: diag(0.05, 0.1, 0.05) }}
                 joint plane: Planar {{ parent: ground, child: carrier, axes: [X, Z] }}
                 joint lean: Revolute {{ parent: carrier, child: disc, axis: X }}
                 constraint roll: Rolling {{ wheel: disc, axis: Y, radius: 0.3 }}
                 formulation {{ constraints: Reduced, independent: [{independent}] }}"
            ),
        )
    };
    for independent in ["plane.x, plane.y", "plane.angle, plane.y", "plane.x"] {
        let model = disc(independent);
        let structure = sound(&model);
        let DependentRates { unknowns, rows, .. } = &structure.rates;
        assert_eq!((unknowns.len(), rows.len()), (2, 2), "{independent}");
        assert!(compile(&model).is_ok(), "{independent}");
    }
}

#[test]
fn mistakes() {
    for (items, told) in [
        (
            "constraint c = plane.x.rate * plane.y.rate;",
            "the constraint `c` is not linear in velocities: what stands before `plane.x.rate` holds `plane.y.rate`",
        ),
        (
            "constraint c = sin(plane.angle.rate);",
            "the constraint `c` is not linear in velocities: what stands before `plane.angle.rate` holds `plane.angle.rate`",
        ),
        (
            "constraint c = plane.x + 0.0 * plane.x.rate;",
            "the constraint `c` is of velocities, but none of them has a say in it",
        ),
        (
            "constraint one = sled.express(sled.velocity).y; constraint two = 2.0 * sled.express(sled.velocity).y - 0.1;",
            "the constraint `two` contradicts `one`: their velocities leave none for it",
        ),
        (
            "constraint c = linear_momentum().x;",
            "a constraint of velocities can't read a velocity or momentum of several bodies: velocities of frames and rates of joints \
             may stand here",
        ),
        (
            "constraint c = sled.velocity.y; solve (plane.x) from c { plane.x > 0.0 } formulation { constraints: Reduced }",
            "this is a constraint of velocities: no position follows from it",
        ),
        (
            "constraint c = plane.y.rate + 0.3 * signum(plane.x.rate);",
            "the constraint `c` is not linear in velocities: it reads `plane.x.rate` in a function in pieces",
        ),
        (
            "drive plane.angle = 0.3 * t; constraint c = plane.angle.rate - 0.5;",
            "the constraint `c` is of velocities, but none that is free has a say in it",
        ),
    ] {
        assert_eq!(complaints(items), told, "{items}");
    }
}

/// Poses prove nothing where parameters, time, drives or pieces could tell rows apart.
#[test]
fn what_may_be_independent_is_refused() {
    for items in [
        "param shift = 0.0; constraint one = sled.express(sled.velocity).y; constraint two = sled.express(sled.at(shift * X).velocity).y;",
        "drive plane.angle = 0.3 * t; constraint one = sled.velocity.y; constraint two = 2.0 * sled.velocity.y + 0.1 * plane.angle.rate;",
        "constraint one = plane.x.rate; constraint two = plane.x.rate + sin(t);",
        "constraint one = plane.x.rate; constraint two = plane.x.rate + max(plane.x - 50.0, 0.0) * plane.y.rate;",
        "constraint one = plane.x.rate; constraint two = plane.x.rate + table(plane.x, [10.0, 11.0], [0.0, 1.0]) * plane.y.rate;",
        "constraint one = plane.x.rate; constraint two = plane.x.rate + select(t > 9.0, 1.0, 0.0) * plane.y.rate;",
        "param k = 2.0; constraint one = plane.x.rate; constraint two = plane.x.rate + max(k - 5.0, 0.0) * plane.y.rate;",
        "state s: rate = 1.0, start: 0.0; constraint one = plane.x.rate; constraint two = plane.x.rate + s;",
        "state s: rate = 1.0, start: 0.0; constraint one = plane.x.rate; constraint two = plane.x.rate + max(s - 9.0, 0.0) * plane.y.rate;",
        "constraint one = plane.x - 0.3 * plane.y; constraint two = plane.x.rate - 0.3 * plane.y.rate - 0.1 * sin(t);",
        "constraint one = plane.x - 0.3 * t; constraint two = plane.x.rate - 0.4;",
        "constraint one = plane.x; constraint two = plane.x + max(plane.y - 50.0, 0.0) * plane.y;",
    ] {
        let told = complaints(items);
        assert!(told.contains("wherever it was looked at"), "{items}: {told}");
    }
}

/// States may stand anywhere: what vanishes where they start says nothing.
#[test]
fn states_are_anywhere() {
    let steered = model(
        "state s: rate = 1.0, start: 0.0; constraint one = plane.x.rate; constraint two = plane.x.rate + sin(s) * plane.y.rate;",
    );
    assert_eq!(names(&steered, &sound(&steered).rows), ["one", "two"]);
    for constraints in ["Reduced", "Multipliers"] {
        let car = model(&format!(
            "input wish: Scalar; state s: rate = 3.0 * (wish - s) + 0.1 * plane.x.rate, start: 0.0;
             constraint rear = sled.express(sled.velocity).y;
             constraint front = cos(s) * sled.express(sled.at(0.7 * X).velocity).y - sin(s) * sled.express(sled.velocity).x;
             formulation {{ constraints: {constraints} }}"
        ));
        assert!(compile(&car).is_ok(), "{constraints}");
    }
}

/// The second wheel of an axle is left out whoever steers, by a state or by a drive; and what contradicts it is told.
#[test]
fn an_axle_beside_what_varies() {
    let axle = "body left { mass: 1.0, inertia: diag(0.02, 0.03, 0.02) } body right { mass: 1.0, inertia: diag(0.02, 0.03, 0.02) }
        joint l: Revolute { parent: sled.at([0.1, 0.4, 0.2]), child: left, axis: Y }
        joint r: Revolute { parent: sled.at([0.1, -0.3, 0.2]), child: right, axis: Y }
        let road = ground.rotated(Z, 0.2).rotated(X, 0.0);
        constraint one: Rolling { wheel: left, axis: Y, radius: 0.2, on: road }
        constraint other: Rolling { wheel: right, axis: Y, radius: 0.2, on: road }";
    let sled = "body sled { mass: 2.0, com: [0.1, 0.2, 0.0], inertia: diag(1.0, 1.0, 1.0) }
        joint plane: Planar { parent: ground, child: sled, axis: Z }";
    let caster = "sled.express(sled.at(0.9 * X).velocity)";
    for steered in [
        format!("state s: rate = 0.3 - s, start: 0.0; constraint nose = cos(s) * {caster}.y - sin(s) * {caster}.x;"),
        format!("constraint nose = cos(0.3 * t) * {caster}.y - sin(0.3 * t) * {caster}.x;"),
        "body fork { mass: 1.0, inertia: diag(0.1, 0.1, 0.1) } joint steer: Revolute { parent: sled.at(0.9 * X), child: fork, axis: Z }
         drive steer = 0.3 * sin(t); constraint nose: Skate { blade: fork, along: X }"
            .to_owned(),
    ] {
        let model = model_with("", &format!("{sled} {axle} {steered}"));
        let structure = sound(&model);
        assert_eq!(names(&model, &structure.dropped), ["one.touch", "other.touch", "other.across"], "{steered}");
        assert!(names(&model, &structure.rows).contains(&"nose.across".to_owned()) || steered.contains("nose ="), "{steered}");
        let twice = format!("{sled} {axle} {steered} constraint twice = 2.0 * sled.express(sled.at(0.1 * X).velocity).y - 0.2;");
        let said = analyse(&model_with("", &twice)).expect_err(&twice);
        assert!(said[0].message.contains("the constraint `twice` contradicts `one.across`"), "{}", said[0].message);
    }
}

/// Whom a redundant equation follows from is told, and whom it doesn't is not.
#[test]
fn partners_are_named() {
    let model = model(
        "constraint one = plane.x.rate - 0.3 * plane.angle.rate;
         constraint other = plane.y.rate;
         constraint two = 0.6 * plane.angle.rate - 2.0 * plane.x.rate;",
    );
    let notes = sound(&model).notes.join("; ");
    assert!(notes.contains("left out: `two` (from `one`);"), "{notes}");
}

/// A force that rigid bodies leave open, and one that is nowhere.
#[test]
fn multipliers_that_are_not_there() {
    let said = |items: &str| match compile(&model(items)) {
        Err(Trouble::Complaints(list)) => list.into_iter().map(|one| one.message).collect::<Vec<_>>().join("; "),
        _ => String::new(),
    };
    let found = said(
        "constraint left = sled.express(sled.at(0.7 * Y).velocity).y;
         constraint right = sled.express(sled.at(-0.7 * Y).velocity).y;
         output load = left.multiplier;
         output open = right.multiplier;",
    );
    let told = |name: &str| {
        format!("`{name}` depends on other equations: how they share the load is not determined by rigid bodies")
    };
    let mut found: Vec<&str> = found.split("; ").collect();
    found.sort_unstable();
    assert_eq!(found, [told("left"), told("right")]);
    // In whatever order.
    let three = "constraint one = sled.express(sled.at(0.3 * X).velocity).y;
         constraint two = sled.express(sled.at(0.1 * X).velocity).y;
         constraint three = sled.express(sled.at(0.2 * X).velocity).y;";
    assert_eq!(said(&format!("{three} output load = one.multiplier;")), told("one"));
    // What stands alone beside them is known.
    let beside = "constraint left = sled.express(sled.at(0.7 * Y).velocity).y;
         constraint right = sled.express(sled.at(-0.7 * Y).velocity).y;
         constraint brake = sled.express(sled.velocity).x;
         output load = brake.multiplier;";
    assert_eq!(said(beside), "");
    // Parallel rods, of which all are kept.
    let rods = "body plate { mass: 1.0, inertia: diag(1.0, 1.0, 1.0) }
         joint free: Planar { parent: ground, child: plate, axis: Z }
         constraint one: Rod { between: [ground.at(0.5 * Y), plate.at(0.5 * Y)], length: 1.0 }
         constraint two: Rod { between: [ground, plate], length: 1.0 }
         constraint three: Rod { between: [ground.at(-0.5 * Y), plate.at(-0.5 * Y)], length: 1.0 }";
    assert_eq!(said(&format!("{rods} output load = one.multiplier;")), told("one"));
    let found = said("constraint gear = plane.x - 2.0 * plane.y; output load = gear.multiplier;");
    assert_eq!(found, "`gear` is a coupling of coordinates that is put in where they are, without a multiplier");
    assert!(compile(&model("constraint rack = plane.x - sin(plane.angle); output load = rack.multiplier;")).is_ok());
}
