//! Which equations of velocities are told to be rates of equations of positions.

use multibody_engine::mechanics::analysis::analyse;
use multibody_engine::model::types::Model;

use super::support::model_with;

/// Columns of a machine, each on its own.
const SHAFTS: &str = "body one { mass: 1.0, inertia: diag(1.0, 1.0, 1.0) } body two { mass: 1.0, inertia: diag(1.0, 1.0, 1.0) }
     body three { mass: 1.0, inertia: diag(1.0, 1.0, 1.0) } body four { mass: 1.0, inertia: diag(1.0, 1.0, 1.0) }
     joint p: Revolute { parent: ground, child: one, axis: X } joint q: Revolute { parent: ground, child: two, axis: Y }
     joint r: Revolute { parent: ground, child: three, axis: Z } joint s: Prismatic { parent: ground, child: four, axis: X }";

const SLED: &str = "body sled { mass: 2.0, com: [0.1, 0.2, 0.0], inertia: diag(1.0, 1.0, 1.0) }
     joint plane: Planar { parent: ground, child: sled, axis: [0.1, 0.2, 1.0] }";

const FREE: &str =
    "body top { mass: 0.7, inertia: diag(0.011, 0.0219, 0.013) } joint float: Free { parent: ground, child: top }";

const BALL: &str =
    "body top { mass: 0.7, inertia: diag(0.011, 0.0219, 0.013) } joint float: Ball { parent: ground, child: top }";

fn notes(model: &Model) -> Vec<String> {
    let structure = analyse(model).unwrap_or_else(|complaints| panic!("{complaints:?}"));
    let about = |note: &String| note.contains("integrate");
    structure
        .notes
        .into_iter()
        .filter(about)
        .map(|note| note.split("; written as").next().unwrap_or_default().to_owned())
        .collect()
}

fn said(items: &str) -> String {
    notes(&model_with("", items)).join("; ")
}

const NONE: &str = "no combination of the equations of velocities integrates to positions";
const ALONE: &str = "equations of velocities that integrate to positions";
const TOGETHER: &str = "equations of velocities that integrate to positions together";

#[test]
fn gears() {
    for gear in [
        "2.0 * p.angle.rate - q.angle.rate",
        "cos(p.angle) * p.angle.rate + 0.3 * r.angle.rate",
        // Exact but for a factor.
        "(2.0 + sin(r.angle)) * (cos(p.angle) * p.angle.rate - q.angle * s.travel.rate - s.travel * q.angle.rate)",
        "q.angle * p.angle.rate - p.angle * q.angle.rate",
        // Of two angles, whatever it is.
        "exp(p.angle) * p.angle.rate - (1.3 + sin(p.angle + 2.0 * q.angle)) * q.angle.rate",
    ] {
        assert_eq!(said(&format!("{SHAFTS} constraint gear = {gear};")), format!("{ALONE}: `gear`"), "{gear}");
    }
    for gear in [
        "p.angle.rate - r.angle * q.angle.rate",
        "p.angle.rate + q.angle * r.angle.rate - r.angle * q.angle.rate",
        "s.travel.rate - sin(p.angle) * q.angle.rate",
    ] {
        assert_eq!(said(&format!("{SHAFTS} constraint gear = {gear};")), NONE, "{gear}");
    }
}

#[test]
fn time_is_a_coordinate() {
    for gear in [
        "p.angle.rate - 0.3 * sin(t)",
        "(1.0 + t * t) * (p.angle.rate - 2.0 * q.angle.rate)",
        "t * p.angle.rate + p.angle",
        // A filter that leads to where p falls off: a linear equation of time alone.
        "p.angle.rate + 0.3 * p.angle",
    ] {
        assert_eq!(said(&format!("{SHAFTS} constraint gear = {gear};")), format!("{ALONE}: `gear`"), "{gear}");
    }
    for gear in
        ["p.angle.rate - t * q.angle.rate", "p.angle.rate - 0.3 * q.angle", "p.angle.rate - q.angle.rate + t * r.angle"]
    {
        assert_eq!(said(&format!("{SHAFTS} constraint gear = {gear};")), NONE, "{gear}");
    }
}

/// A blade, a disc that rolls upright and one that may lean, a ball.
#[test]
fn what_rolls_and_cuts() {
    assert_eq!(said(&format!("{SLED} constraint blade = sled.express(sled.velocity).y;")), NONE);
    assert_eq!(said(&format!("{SLED} constraint blade: Skate {{ blade: sled, along: [1.0, 0.3, 0.0] }}")), NONE);
    let upright =
        "body fork { mass: 1.0, inertia: diag(1.0, 1.0, 1.0) } body disc { mass: 1.0, inertia: diag(1.0, 1.3, 1.0) }
        joint plane: Planar { parent: ground.rotated([1.0, 2.0, 0.3], 0.4), child: fork, axis: [0.3, 0.2, 1.0] }
        joint axle: Revolute { parent: fork.rotated([0.3, 0.2, 1.0], 0.7), child: disc, axis: [1.0, 0.0, -0.3] }
        let ahead = cross([0.3, 0.2, 1.0], [1.0, 0.0, -0.3]);
        constraint along = dot(fork.express(disc.velocity), ahead) - 0.3 * axle.angle.rate;
        constraint aside = dot(fork.express(disc.velocity), [1.0, 0.0, -0.3]);";
    assert_eq!(said(upright), NONE);
    assert_eq!(said(&format!("{FREE} constraint roll: Rolling {{ wheel: top, axis: Y, radius: 0.25 }}")), NONE);
    assert_eq!(said(&format!("{FREE} constraint roll: Rolling {{ wheel: top, radius: 0.25 }}")), NONE);
}

/// What rolls on a straight line rolls by an equation of positions.
#[test]
fn what_rolls_on_a_line() {
    let wheel = "body wheel { mass: 1.0, inertia: diag(1.0, 1.3, 1.0) }
         joint plane: Planar { parent: ground, child: wheel, axis: Y }
         constraint along = wheel.velocity.x - 0.3 * plane.angle.rate;
         constraint touch = plane.x * 0.0 + wheel.position.z - 0.3;";
    assert_eq!(said(wheel), format!("{ALONE}: `along`"));
    let rolling = "body wheel { mass: 1.0, inertia: diag(1.0, 1.3, 1.0) }
         joint plane: Planar { parent: ground, child: wheel, axis: Y }
         constraint roll: Rolling { wheel: wheel, axis: Y, radius: 0.3 }";
    assert_eq!(said(rolling), format!("{ALONE}: `roll.along`"));
    let ball = format!(
        "{FREE} constraint roll: Rolling {{ wheel: top, radius: 0.25 }}
         constraint line = top.position.y; constraint aside = top.angular_velocity.z;"
    );
    // No slip across the line is a turn that isn't there.
    assert_eq!(said(&ball), format!("{TOGETHER}: `roll.along`, `roll.across`, `aside`"));
    let spinning = format!(
        "{FREE} constraint roll: Rolling {{ wheel: top, radius: 0.25 }}
         constraint line = top.position.y;"
    );
    assert_eq!(said(&spinning), NONE);
}

/// Axes of a body: turns about them don't commute.
#[test]
fn turns() {
    for (turning, frame) in [(FREE, "top"), (BALL, "top")] {
        for axis in ["z", "x"] {
            let one = format!("{turning} constraint c = {frame}.express({frame}.angular_velocity).{axis};");
            assert_eq!(said(&one), NONE, "{one}");
        }
        let two =
            "constraint c = top.express(top.angular_velocity).x; constraint d = top.express(top.angular_velocity).y;";
        // With one turn left there is one number that tells it.
        assert_eq!(said(&format!("{turning} {two}")), format!("{TOGETHER}: `c`, `d`"));
        let beside = "constraint c = top.express(top.angular_velocity).x; constraint d = top.express(top.angular_velocity).y - 0.3 * t;";
        assert_eq!(said(&format!("{turning} {beside}")), NONE);
        let all = format!("{two} constraint e = top.express(top.angular_velocity).z;");
        assert_eq!(said(&format!("{turning} {all}")), format!("{TOGETHER}: `c`, `d`, `e`"));
        // The height of a point of the body, by its velocity.
        let height = "constraint c = (1.0 + top.position.x) * top.at([0.3, 0.4, 0.5]).velocity.z;";
        assert_eq!(said(&format!("{turning} {height}")), format!("{ALONE}: `c`"));
    }
    // Angular velocities about an axis that a joint keeps.
    let hinged = format!("{SLED} constraint c = sled.angular_velocity.z - 0.3 * plane.x.rate;");
    assert_eq!(said(&hinged), format!("{ALONE}: `c`"));
}

/// Of two equations none is a rate, and a combination with coefficients of position is.
#[test]
fn combinations() {
    let f = "(cos(p.angle) * p.angle.rate + (1.0 + q.angle * q.angle) * q.angle.rate)";
    let g = "(s.travel.rate - q.angle * r.angle.rate)";
    let rows = format!(
        "constraint first = (2.0 + sin(r.angle)) * ({f} + {g}); constraint second = (3.0 + s.travel) * (exp(p.angle) * {f} - {g});"
    );
    let of = |names: &str| format!("of the {names} one combination integrates to positions");
    assert_eq!(said(&format!("{SHAFTS} {rows}")), of("2 equations of velocities `first`, `second`"));
    // Beside one that is a rate by itself, and one that is none.
    let more = format!(
        "{SHAFTS} {FREE} {rows} constraint third = top.velocity.x - r.angle.rate; constraint fourth = top.angular_velocity.x;"
    );
    assert_eq!(said(&more), format!("{ALONE}: `third`; {}", of("2 equations of velocities `first`, `second`")));
}

/// The same with a body that turns any way, and beside a loop.
#[test]
fn combinations_on_manifolds() {
    let of = "of the 2 equations of velocities `first`, `second` one combination integrates to positions";
    let f = "top.at([0.3, 0.4, 0.5]).velocity.z";
    let g = "(top.express(top.angular_velocity).x - 0.3 * p.angle.rate)";
    let rows = format!(
        "let own = top.rotation * [0.8, 0.1, -0.6];
         constraint first = (2.0 + own.y) * ({f} + {g}); constraint second = exp(q.angle) * {f} - {g};"
    );
    assert_eq!(said(&format!("{SHAFTS} {FREE} {rows}")), of);
    let bars = "constraint rod: Rod { between: [one.at([0.0, 0.3, 1.0]), two.at([0.5, 0.0, 0.2])], length: 0.9 }";
    let f = "(p.angle.rate - q.angle * s.travel.rate)";
    let loops = format!("{SHAFTS} {bars} constraint hold = s.travel - 0.3 * sin(q.angle) - 0.1 * t;");
    // The form f integrates with what holds `s.travel`: with the other equation one that does not.
    let timed = format!("{loops} constraint first = {f};");
    assert_eq!(said(&timed), format!("{ALONE}: `first`"));
    let f = "(r.angle.rate - q.angle * p.angle.rate)";
    let g = "(s.travel.rate - r.angle * q.angle.rate)";
    let rows = format!(
        "constraint first = (2.0 + sin(r.angle)) * ({f} + {g}); constraint second = (3.0 + s.travel) * (exp(p.angle) * {f} - {g});"
    );
    assert_eq!(
        said(&format!(
            "{SHAFTS} {bars} body five {{ mass: 1.0, inertia: diag(1.0, 1.0, 1.0) }}
         joint u: Prismatic {{ parent: ground, child: five, axis: X }} {}",
            rows.replace("r.angle * q.angle.rate", "r.angle * u.travel.rate")
        )),
        of
    );
}

/// What integrates where another equation holds, and not alone.
#[test]
fn with_another_equation() {
    let rows = "constraint first = p.angle.rate - 0.3 * q.angle.rate; constraint second = r.angle.rate - (p.angle - 0.3 * q.angle) * s.travel.rate;";
    assert_eq!(said(&format!("{SHAFTS} {rows}")), format!("{ALONE}: `first`; {TOGETHER}: `first`, `second`"));
    let held = rows.replace(
        "constraint first = p.angle.rate - 0.3 * q.angle.rate",
        "constraint first = p.angle - 0.3 * q.angle - 0.1",
    );
    assert_eq!(said(&format!("{SHAFTS} {held}")), format!("{ALONE}: `second`"));
    let more = rows.replace("constraint second = ", "let e = ")
        + "let g = top.angular_velocity.x; constraint second = e + g; constraint third = exp(r.angle) * e - g;";
    let told = "of the 3 equations of velocities `first`, `second`, `third` 2 combinations integrate to positions";
    assert_eq!(said(&format!("{SHAFTS} {FREE} {more}")), format!("{ALONE}: `first`; {told}"));
    let driven = rows.replace("constraint first = p.angle.rate - 0.3 * q.angle.rate", "drive p.angle = 0.3 * sin(t)");
    assert_eq!(said(&format!("{SHAFTS} {driven}")), NONE);
    let along = "drive p.angle = 0.3 * sin(t); constraint second = r.angle.rate - p.angle * s.travel.rate;";
    assert_eq!(said(&format!("{SHAFTS} {along}")), NONE);
    let along = "drive p.angle = 0.3 * sin(t); constraint second = p.angle * r.angle.rate - p.angle.rate * r.angle;";
    assert_eq!(said(&format!("{SHAFTS} {along}")), format!("{ALONE}: `second`"));
}

/// What is driven moves with time.
#[test]
fn beside_drives() {
    let rows =
        "drive p.angle = 0.3 * sin(t); drive q.angle = t * t; constraint c = r.angle.rate - q.angle * p.angle.rate;";
    assert_eq!(said(&format!("{SHAFTS} {rows}")), format!("{ALONE}: `c`"));
    let rows = "drive p.angle = t + 0.3; constraint c = r.angle.rate - (p.angle - t) * s.travel.rate;";
    assert_eq!(said(&format!("{SHAFTS} {rows}")), format!("{ALONE}: `c`"));
    let rows = "let own = top.rotation * [0.8, 0.1, -0.6]; constraint c = r.angle.rate - own.y * s.travel.rate;";
    assert_eq!(said(&format!("{SHAFTS} {BALL} {rows}")), NONE);
    assert_eq!(said(&format!("{SHAFTS} {BALL} drive float.orientation = identity(); {rows}")), format!("{ALONE}: `c`"));
    // A quaternion that follows time is made of pieces.
    assert_eq!(said(&format!("{SHAFTS} {BALL} drive float.orientation = rotation(Z, t); {rows}")), "");
}

/// Cars and trailers: brackets of brackets tell that nothing integrates, and of how much.
#[test]
fn trailers() {
    let shape =
        "body car { mass: 1.0, inertia: diag(1.0, 1.0, 1.0) } body one { mass: 1.0, inertia: diag(1.0, 1.0, 1.0) }
         body two { mass: 1.0, inertia: diag(1.0, 1.0, 1.0) }
         joint plane: Planar { parent: ground, child: car, axis: Z }
         joint first: Revolute { parent: car.at(-0.3 * X), child: one, axis: Z }
         joint second: Revolute { parent: one.at(-1.1 * X), child: two, axis: Z }
         constraint a = car.express(car.velocity).y;
         constraint b = one.express(one.at(-0.7 * X).velocity).y;
         constraint c = two.express(two.at(-0.9 * X).velocity).y;";
    assert_eq!(said(shape), NONE);
    let more =
        "body three { mass: 1.0, inertia: diag(1.0, 1.0, 1.0) } body four { mass: 1.0, inertia: diag(1.0, 1.0, 1.0) }
         joint third: Revolute { parent: two.at(-0.8 * X), child: three, axis: Z }
         joint fourth: Revolute { parent: three.at(-1.2 * X), child: four, axis: Z }
         constraint d = three.express(three.at(-0.7 * X).velocity).y;
         constraint e = four.express(four.at(-0.6 * X).velocity).y;";
    assert_eq!(said(&format!("{shape} {more}")), NONE);
    let stiff = format!("{shape} constraint lock = first.angle.rate;");
    assert_eq!(said(&stiff), format!("{ALONE}: `lock`; {TOGETHER}: `a`, `b`, `c`, `lock`"));
}

/// A car that can't steer runs on a straight line, with parallel wheels; with others on a circle.
#[test]
fn cars_without_steering() {
    let rear = format!("{SLED} constraint rear = sled.express(sled.velocity).y;");
    let parallel = format!("{rear} constraint front = sled.express(sled.at(1.4 * X).velocity).y;");
    assert_eq!(said(&parallel), format!("{TOGETHER}: `rear`, `front`"));
    let circle = format!(
        "{rear} constraint front = sled.express(sled.at(1.4 * X).velocity).y - 0.3 * sled.express(sled.velocity).x;"
    );
    assert_eq!(said(&circle), format!("{TOGETHER}: `rear`, `front`"));
    let spinning = format!(
        "{parallel} body wheel {{ mass: 1.0, inertia: diag(1.0, 1.0, 1.0) }} joint axle: Revolute {{ parent: sled, child: wheel, axis: Y }}
         constraint roll = sled.express(sled.velocity).x - 0.3 * axle.angle.rate;"
    );
    assert_eq!(said(&spinning), format!("{TOGETHER}: `rear`, `front`, `roll`"));
}

/// Parameters that are zero by default.
#[test]
fn declared_parameters() {
    let items = "param k = 0.0; constraint c = p.angle.rate - (0.3 + k * r.angle) * q.angle.rate;";
    let with = format!("{ALONE}, with the declared parameters: `c`");
    assert_eq!(said(&format!("{SHAFTS} {items}")), with);
    let items = "param k = 0.4; constraint c = p.angle.rate - k * q.angle.rate;";
    assert_eq!(said(&format!("{SHAFTS} {items}")), format!("{ALONE}: `c`"));
}

/// Loops: a four-bar leaves one freedom, so whatever is said of its rates is a rate.
#[test]
fn beside_loops() {
    let bars =
        "body one { mass: 1.0, inertia: diag(1.0, 1.0, 1.0) } body two { mass: 1.0, inertia: diag(1.0, 1.0, 1.0) }
         body three { mass: 1.0, inertia: diag(1.0, 1.0, 1.0) } body rider { mass: 1.0, inertia: diag(1.0, 1.0, 1.0) }
         joint a: Revolute { parent: ground, child: one, axis: Z }
         joint b: Revolute { parent: one.at(0.5 * X), child: two, axis: Z }
         joint c: Revolute { parent: ground.at(X), child: three, axis: Z }
         constraint tip: Rod { between: [two.at(1.2 * X), three.at(0.8 * X)], length: 0.3 }
         constraint reach: Rod { between: [two.at(0.6 * X), ground.at([0.3, 0.9, 0.0])], length: 0.7 }
         joint seat: Revolute { parent: three, child: rider, axis: [1.0, 0.3, 0.0] }";
    let row = "constraint gear = seat.angle.rate - a.angle * b.angle.rate + cos(c.angle) * a.angle.rate;";
    for handling in ["", "formulation { constraints: Multipliers }"] {
        assert_eq!(said(&format!("{bars} {row} {handling}")), format!("{ALONE}: `gear`"), "{handling}");
        let skew = "constraint gear = b.angle.rate * cos(seat.angle) + sin(seat.angle) * a.angle.rate * 0.3;";
        assert_eq!(said(&format!("{bars} {skew} {handling}")), format!("{ALONE}: `gear`"), "{handling}");
        // Without the second rod there are two freedoms more.
        let open = bars.replace(
            "constraint reach: Rod { between: [two.at(0.6 * X), ground.at([0.3, 0.9, 0.0])], length: 0.7 }",
            "",
        );
        assert_eq!(said(&format!("{open} {row} {handling}")), NONE, "{handling}");
    }
}

/// What holds where it was looked at may not hold elsewhere.
#[test]
fn functions_in_pieces() {
    let piece = "constraint c = p.angle.rate - max(r.angle - 50.0, 0.0) * q.angle.rate;";
    assert_eq!(said(&format!("{SHAFTS} {piece}")), "");
    let beside =
        "constraint c = p.angle.rate - 2.0 * q.angle.rate; constraint d = r.angle + max(s.travel - 50.0, 0.0);";
    assert_eq!(said(&format!("{SHAFTS} {beside}")), "");
}
