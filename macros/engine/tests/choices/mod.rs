//! Choices of equations that few models need, one by one: the library's own test, since nothing outside can ask for them.

use super::*;
use crate::diagnostics::Diagnostics;

/// Bennett's linkage, of which two equations are independent, but not the same two at all poses.
const BENNETT: &str = "pub mod m {
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
    }
}";

#[test]
fn a_whole_loop_keeps_all() {
    let mut diagnostics = Diagnostics::default();
    let source = crate::parse(BENNETT.parse().expect("tokens"), &mut diagnostics);
    let model = crate::model::check(&source, &mut diagnostics).remove(0);
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
}
