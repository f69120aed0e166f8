//! Which velocities a model has: rates, those that constraints of velocities leave, and the user's own.

use multibody_engine::mechanics::analysis::analyse;
use multibody_engine::mechanics::loops::constraints::coordinate_name;
use multibody_engine::mechanics::loops::structure::Structure;
use multibody_engine::model::types::{Coordinate, Model};

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
            format!("{ARM} speed u = a.rate + b.rate;"),
            "1 speed doesn't determine the rates that it reads: `a.rate`, `b.rate`",
        ),
        (
            format!("{ARM} speed u = a.rate; speed w = 2.0 * a.rate;"),
            "the speed `w` follows from other speeds and from the constraints",
        ),
        (
            format!("{SLED} {blade} speed u = sled.express(sled.velocity).y + t;"),
            "the speed `u` follows from other speeds and from the constraints",
        ),
        (
            format!("{SLED} {blade} speed u = plane.x.rate; speed v = plane.y.rate; speed w = plane.angle.rate;"),
            "the speed `v` follows from other speeds and from the constraints",
        ),
        (
            format!("{} {blade} speed u = plane.angle.rate;", SLED.replace("Reduced", "Multipliers")),
            "speeds and equations that keep multipliers don't go together",
        ),
        (
            format!("{ARM} speed u = a.rate + 0.2; emit forward_dynamics, momentum;"),
            "the velocities of this model are not the rates of its coordinates: momenta are known in those alone",
        ),
    ] {
        assert_eq!(complaints(&items), told, "{items}");
    }
}
