//! Kinematics that Newton's method answers: what it can't be asked.

use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::mechanics;

use super::support::{case, model_of};

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
        // A formula that starts from something else stands in nobody's way.
        "solve (j2, j4) from pin { sin(j3.angle + j4.angle - j1.angle - j2.angle) > 0.0 } \
         emit kinematics { given: [j2, j3], find: j4 }; emit kinematics { given: [j1, j3], find: [j2, j4] };",
        // One of the two is not in the state.
        "constraint gear = j3.angle - 2.0 * j1.angle - 0.3; emit kinematics { given: j2, find: [j1, j3, j4] };",
        "constraint gear = j3.angle - 2.0 * j1.angle - 0.3; emit kinematics { given: j2, find: j3 };",
        "drive j1.angle = 0.3 * t; emit kinematics { given: [j1, j4], find: [j2, j3] };",
    ] {
        assert_eq!(complaint(items), None, "{items}");
    }
}

/// Another loop has no part in what is found, nor in what is left of its equations.
#[test]
fn loops_that_are_not_asked_for_are_left_alone() {
    let case = case(&five_bar(
        "body a { mass: 1.0, com: 0.1 * X, inertia: rod(1.0, 0.3, X) }
         body b { mass: 1.0, com: 0.4 * X, inertia: rod(1.0, 0.9, X) }
         body c { mass: 1.0, com: 0.4 * X, inertia: rod(1.0, 0.8, X) }
         joint ja: Revolute { parent: ground.at(3.0 * X), child: a, axis: Z }
         joint jb: Revolute { parent: a.at(0.3 * X), child: b, axis: Z }
         joint jc: Revolute { parent: ground.at(3.7 * X), child: c, axis: Z }
         #[cut] joint other: Revolute { parent: b.at(0.9 * X), child: c.at(0.8 * X), axis: Z }
         emit kinematics { given: [j1, j3], find: [j2, j4] };",
    ));
    let kind = FunctionKind::Kinematics(0);
    let mut point = case.random(7);
    for (joint, value) in [("j1", 2.0), ("j2", -1.2), ("j3", 1.1), ("j4", 1.0)] {
        point.set(Symbol::Position { joint: case.joint(joint), component: 0 }, value);
    }
    let found = case.eval(kind, &point);
    assert_eq!(found.len(), 7);
    assert!(found[6] < 1e-12, "{found:?}");
    for (joint, value) in [("ja", 3.3), ("jb", 30.0), ("jc", -0.4)] {
        point.set(Symbol::Position { joint: case.joint(joint), component: 0 }, value);
    }
    assert_eq!(case.eval(kind, &point), found);
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
            "3 coordinates are given, but 2 are independent | give fewer: the others follow from them",
        ),
        (
            "formulation { constraints: Reduced, independent: [j1, j3] } \
             emit kinematics { given: [j2, j4], find: [j1, j3] };",
            "`j2` is given, and follows from other coordinates of the state | write `constraints: Multipliers`: what is \
             given is read from the state, and what is to be found begins there",
        ),
        (
            "constraint gear = j3.angle - 2.0 * j1.angle - 0.3; emit kinematics { given: j3, find: [j1, j2] };",
            "`j3` is given, and follows from other coordinates of the state | give the coordinates that it follows from",
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
