//! Choices of equations that few models need, one by one: the library's own test, since nothing outside can ask for them.

use super::*;
use crate::diagnostics::Diagnostics;

/// Bennett's linkage, of which two equations are independent, but not the same two at all poses.
const BENNETT: &str = "
    formulation { constraints: Multipliers }
    body one { mass: 1.0, inertia: diag(0.1, 0.1, 0.1) }
    body two { mass: 1.5, inertia: diag(0.1, 0.1, 0.1) }
    body three { mass: 1.0, inertia: diag(0.1, 0.1, 0.1) }
    joint a: Revolute { parent: ground, child: one, axis: Z }
    joint b: Revolute { parent: one.at(X).rotated(X, 0.6), child: two, axis: Z }
    joint c: Revolute { parent: two.at(sin(1.1) / sin(0.6) * X).rotated(X, 1.1), child: three, axis: Z }
    #[cut]
    joint d: Revolute {
        parent: three.at(X).rotated(X, 0.6), child: ground.rotated(X, -1.1).at(-sin(1.1) / sin(0.6) * X), axis: Z
    }";

fn bennett(more: &str) -> Model {
    let mut diagnostics = Diagnostics::default();
    let text = format!("pub mod m {{ {BENNETT} {more} }}");
    let source = crate::parse(text.parse().expect("tokens"), &mut diagnostics);
    let mut models = crate::model::check(&source, &mut diagnostics);
    assert!(diagnostics.errors().is_empty(), "{more}");
    models.remove(0)
}

#[test]
fn a_whole_loop_keeps_all() {
    let model = bennett("");
    let common = Choice::plain(ClosedIn::Common);
    let plain = split(&model, common).expect("a structure");
    let needed = needed(&model, &plain, plain.writing);
    assert_eq!(plain.rows.len(), 2);
    assert!(!needed.is_empty());
    let mut first = enough(&model, &plain, plain.writing).expect("a better choice");
    first.sort_unstable();
    let better = checked(&model, Choice { first: &first, ..common }).expect("a structure");
    assert_eq!(better.rows, first);
    assert!(better.rows != plain.rows);
    let whole = split(&model, Choice { whole: &needed, ..common }).expect("a structure");
    assert_eq!((whole.rows.len(), whole.dropped.len()), (5, 0));
    assert!(whole.redundant);
    let told = checks::unsteady(&model, &needed);
    let message = "the loop that `d` closes can't be reduced: which of its equations follow from the others changes with the pose (`d.z`";
    assert!(told.len() == 1 && told[0].message.starts_with(message), "{}", told[0].message);
}

/// What is driven, by a drive or by a constraint that reads the time, gets to where the first equations depend on each other.
#[test]
fn driven_loops_get_everywhere() {
    for more in ["drive a = 0.5 * t;", "constraint given = a.angle - 0.5 * t - 0.6;"] {
        let model = bennett(more);
        let plain = split(&model, Choice::plain(ClosedIn::Common)).expect("a structure");
        assert!(!needed(&model, &plain, plain.writing).is_empty(), "{more}");
        let found = structure(&model).expect("a structure");
        assert!(needed(&model, &found, found.writing).is_empty() && found.rows != plain.rows, "{more}");
    }
}
