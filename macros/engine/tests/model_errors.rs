//! What the stage `model` says about mistakes: every message once at least, and where it stands.

mod model_support;

use model_support::said;

const CASES: &str = include_str!("model_cases/errors.txt");

/// A body on a joint, for cases about other things.
const AROUND: &str = "body b { mass: 1.0, com: 0.5 * X, inertia: diag(1.0, 1.0, 1.0) } \
    joint j: Revolute { parent: ground, child: b, axis: Z } ";

fn text(case: &str) -> String {
    if let Some(call) = case.strip_prefix("call: ") {
        return call.to_string();
    }
    match case.strip_prefix("alone: ") {
        Some(items) => format!("mod m {{ {items} }}"),
        None => format!("mod m {{ {AROUND}{case} }}"),
    }
}

#[test]
fn cases() {
    let mut wrong = String::new();
    let mut count = 0;
    let mut lines = CASES.lines().filter(|line| !line.is_empty() && !line.starts_with("# ")).peekable();
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
