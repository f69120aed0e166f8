//! Names of the file as names of the language.
//!
//! Capitals become small, with `_` before one that begins a word, as in `IMULink`; what is neither letter nor digit becomes
//! `_`. Links, joints and what belongs to them have their names in common here: a name that is taken, or that the language has
//! for itself, gets the kind of its thing at the end, then a number.

use std::collections::HashSet;

use multibody_engine::diagnostics::Diagnostics;
use multibody_engine::syntax;

use crate::build;

#[derive(Default)]
pub(super) struct Names {
    taken: HashSet<String>,
    changed: Vec<(String, String)>,
}

impl Names {
    /// Of a thing in the file; `kind` is `link` or `joint`.
    pub(super) fn of(&mut self, name: &str, kind: &str) -> String {
        let given = self.give(&snake(name, kind), kind);
        if given != name {
            self.changed.push((name.to_owned(), given.clone()));
        }
        given
    }

    /// Of what the file has no name for.
    pub(super) fn give(&mut self, wanted: &str, kind: &str) -> String {
        let is_free = |name: &String| !self.taken.contains(name) && is_item(name);
        let longer = |k: usize| if k == 1 { format!("{wanted}_{kind}") } else { format!("{wanted}_{kind}_{k}") };
        let mut all = std::iter::once(wanted.to_owned()).chain((1..).map(longer));
        let name = all.find(is_free).unwrap_or_default();
        self.taken.insert(name.clone());
        name
    }

    /// Which names have changed.
    pub(super) fn note(&self) -> Option<String> {
        let each: Vec<String> =
            self.changed.iter().map(|(old, new)| format!("`{}` is `{new}`", old.escape_debug())).collect();
        (!each.is_empty()).then(|| format!("names: {}", each.join(", ")))
    }
}

/// Of the model.
pub(super) fn module(name: &str) -> String {
    let name = snake(name, "robot");
    if is_sound(&format!("mod {name} {{ {} }}", body("b", "j"))) { name } else { format!("{name}_robot") }
}

fn snake(name: &str, kind: &str) -> String {
    let letters: Vec<char> = name.trim().chars().collect();
    let mut text = String::new();
    for (k, letter) in letters.iter().enumerate() {
        let before = k.checked_sub(1).map(|k| letters[k]);
        let is_next_small = letters.get(k + 1).is_some_and(char::is_ascii_lowercase);
        let begins = before.is_some_and(|before| {
            before.is_ascii_lowercase() || before.is_ascii_digit() || before.is_ascii_uppercase() && is_next_small
        });
        if letter.is_ascii_uppercase() && begins {
            text.push('_');
        }
        text.push(if letter.is_ascii_alphanumeric() { letter.to_ascii_lowercase() } else { '_' });
    }
    if text.starts_with(|first: char| first.is_ascii_digit()) { format!("{kind}_{text}") } else { text }
}

/// Whether an item may have this name: the compiler is asked, whose list it is.
fn is_item(name: &str) -> bool {
    let held = format!("{name}_held");
    is_sound(&format!("mod m {{ {} }}", body(name, &held))) && is_sound(&format!("mod m {{ {} }}", body(&held, name)))
}

/// Items without which nothing is a model.
fn body(name: &str, joint: &str) -> String {
    format!(
        "body {name} {{ mass: 1.0, inertia: diag(1.0, 1.0, 1.0) }} \
         joint {joint}: Free {{ parent: ground, child: {name} }}"
    )
}

fn is_sound(call: &str) -> bool {
    let Ok(tokens) = call.parse() else { return false };
    let mut diagnostics = Diagnostics::default();
    let source = syntax::parse(tokens, &mut diagnostics);
    build::checked(&source, &mut diagnostics);
    diagnostics.errors().is_empty()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_of_rust() {
        for (name, expected) in [
            ("panda_link0", "panda_link0"),
            ("LH_HAA", "lh_haa"),
            ("hipYaw", "hip_yaw"),
            ("LeftIMULink2Roll", "left_imu_link2_roll"),
            ("left arm/tip.3", "left_arm_tip_3"),
            ("3rd", "link_3rd"),
            ("Z\u{fc}", "z_"),
        ] {
            assert_eq!(snake(name, "link"), expected);
        }
    }

    #[test]
    fn what_is_taken_gets_another_name() {
        let mut names = Names::default();
        assert_eq!(names.of("elbow", "link"), "elbow");
        assert_eq!(names.of("elbow", "joint"), "elbow_joint");
        assert_eq!(names.of("Elbow", "joint"), "elbow_joint_2");
        assert_eq!(names.of("sin", "link"), "sin_link");
        assert_eq!(names.of("type", "link"), "type_link");
        assert_eq!(names.of("_", "link"), "__link");
        assert_eq!(names.of("ground", "link"), "ground_link");
        assert_eq!(names.of("world", "link"), "world_link");
        assert_eq!(module("crate"), "crate_robot");
        assert_eq!(module("panda"), "panda");
    }
}
