//! Kinematics that Newton's method answers: what it can't be asked.

use multibody_engine::mechanics;

use super::support::model_of;

/// A five-bar with two freedoms and all coordinates in the state, unless something else is said.
fn five_bar(items: &str) -> String {
    let formulation = if items.contains("formulation") { "" } else { "formulation { constraints: Multipliers }" };
    format!(
        "body left {{ mass: 1.0, com: 0.4 * X, inertia: rod(1.0, 0.8, X) }}
         body upper {{ mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.1, X) }}
         body right {{ mass: 1.0, com: 0.4 * X, inertia: rod(1.0, 0.9, X) }}
         body lower {{ mass: 1.0, com: 0.6 * X, inertia: rod(1.0, 1.3, X) }}
         joint j1: Revolute {{ parent: ground, child: left, axis: Z }}
         joint j2: Revolute {{ parent: left.at(0.8 * X), child: upper, axis: Z }}
         joint j3: Revolute {{ parent: ground.at(X), child: right, axis: Z }}
         joint j4: Revolute {{ parent: right.at(0.9 * X), child: lower, axis: Z }}
         #[cut] joint pin: Revolute {{ parent: upper.at(1.1 * X), child: lower.at(1.3 * X), axis: Z }}
         {formulation} {items}"
    )
}

fn complaint(items: &str) -> Option<String> {
    let complaints = mechanics::of(&model_of(&five_bar(items))).err()?;
    let all = complaints.into_iter().map(|one| format!("{} | {}", one.message, one.help.unwrap_or_default()));
    Some(all.collect::<Vec<_>>().join("\n"))
}

#[test]
fn what_can_be_found() {
    for items in [
        "emit kinematics { given: [j1, j3], find: [j2, j4] };",
        "emit kinematics { given: [j2, j4], find: [j1, j3] };",
        "emit kinematics { given: [j1, j2], find: j4 };",
        "drive j1.angle = 0.3 * t; emit kinematics { given: j4, find: [j2, j3] };",
        "drive j1.angle = 0.3 * t; emit kinematics { given: [j1, j4], find: [j2, j3] };",
    ] {
        assert_eq!(complaint(items), None, "{items}");
    }
}

#[test]
fn what_can_not() {
    for (items, expected) in [
        (
            "emit kinematics { given: j1, find: [j2, j4] };",
            "`j2` does not follow from what is given | give more coordinates, or write a `solve` item for its loop",
        ),
        (
            "emit kinematics { given: [j1, j2, j3], find: j4 };",
            "3 coordinates are given, but 2 are independent | give as many coordinates as the mechanism has freedoms",
        ),
        (
            "formulation { constraints: Reduced, independent: [j1, j3] } \
             emit kinematics { given: [j2, j4], find: [j1, j3] };",
            "`j2` is given, and follows from other coordinates of the state | write `constraints: Multipliers`: what is \
             given is read from the state, and what is to be found begins there",
        ),
        (
            "formulation { constraints: Reduced, independent: [j1, j3] } emit kinematics { given: j1, find: j3 };",
            "`j2` has to be found, and is not in the state | an iteration begins where coordinates of the state stand: \
             write `constraints: Multipliers`",
        ),
    ] {
        assert_eq!(complaint(items).as_deref(), Some(expected), "{items}");
    }
}
