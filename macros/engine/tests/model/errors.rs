//! What the stage `model` says about mistakes: every message once at least, and where it stands.

use crate::support::said;

const CASES: [&str; 3] =
    [include_str!("cases/errors.txt"), include_str!("cases/loops.txt"), include_str!("cases/units.txt")];

/// A body on a joint, for cases about other things.
const AROUND: &str = "body b { mass: 1.0, com: 0.5 * X, inertia: diag(1.0, 1.0, 1.0) } \
    joint j: Revolute { parent: ground, child: b, axis: Z } ";

/// Four bars: the last joint closes the loop.
const FOUR_BAR: &str = "input u; param p = 1.0; \
    body crank { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) } \
    body coupler { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) } \
    body rocker { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) } \
    joint j1: Revolute { parent: ground, child: crank, axis: Z } \
    joint j2: Revolute { parent: crank.at(X), child: coupler, axis: Z } \
    joint j3: Revolute { parent: ground.at(2 * X), child: rocker, axis: Z } \
    joint closing: Revolute { parent: coupler.at(X), child: rocker.at(X), axis: Z } ";

/// A free body beside the world.
const FREE: &str = "body b { mass: 1.0, inertia: diag(1.0, 1.0, 1.0) } ";

fn text(case: &str) -> String {
    // A comment would end at the end of a line.
    let case = &case.replace('«', "#[doc = \"[").replace('»', "]\"]");
    if let Some(call) = case.strip_prefix("call: ") {
        return call.to_string();
    }
    let around = [("alone: ", ""), ("loop: ", FOUR_BAR), ("free: ", FREE), ("", AROUND)];
    let found = around.iter().find_map(|(prefix, around)| Some((case.strip_prefix(prefix)?, around)));
    found.map_or_else(String::new, |(items, around)| format!("mod m {{ {around}{items} }}"))
}

#[test]
fn cases() {
    let mut wrong = String::new();
    let mut count = 0;
    let all = CASES.join("\n");
    let mut lines = all.lines().filter(|line| !line.is_empty() && !line.starts_with("# ")).peekable();
    while let Some(case) = lines.next() {
        let mut case = case.to_string();
        while let Some(more) = lines.next_if(|line| line.starts_with("  ") && !line.starts_with("    ")) {
            case = format!("{case} {}", more.trim());
        }
        let mut expected: Vec<&str> = Vec::new();
        while let Some(line) = lines.next_if(|line| line.starts_with("    ")) {
            expected.push(line.trim());
        }
        let said = said(&text(&case));
        if said != expected {
            wrong += &format!("{case}\n    {}\n", said.join("\n    "));
        }
        count += 1;
    }
    assert!(wrong.is_empty(), "said instead:\n{wrong}");
    assert!(count > 120, "{count} cases are read");
}
