//! Stage `model`: the fields between the braces of an item.
//!
//! In: fields as written, and which there may and must be. Out: errors for unknown, repeated and missing ones.

use proc_macro2::Ident;
use syn::Expr;

use super::checker::Checker;
use crate::diagnostics::nearest;
use crate::syntax::tree;

/// Which fields an item has.
pub(super) struct Known<'k> {
    pub(super) required: &'k [&'k str],
    pub(super) optional: &'k [&'k str],
}

impl Known<'_> {
    fn names(&self) -> impl Iterator<Item = &str> {
        self.required.iter().chain(self.optional).copied()
    }

    fn has(&self, name: &str) -> bool {
        self.names().any(|known| known == name)
    }

    /// The field that somebody who writes `name` is looking for.
    fn meant(&self, name: &str) -> Option<&'static str> {
        let meant = match name {
            "k" | "spring" => "stiffness",
            "c" | "d" | "damper" => "damping",
            "body" | "frame" => "at",
            "centre" | "center" | "cog" => "com",
            "l0" | "rest_length" | "natural_length" => "length",
            "force" | "torque" => "value",
            _ => return None,
        };
        self.has(meant).then_some(meant)
    }
}

/// The value of a field; the first one where it is repeated.
pub(super) fn field<'a>(fields: &'a tree::Fields, name: &str) -> Option<&'a Expr> {
    let field = fields.list.iter().find(|f| f.name == name)?;
    Some(&field.value)
}

impl Checker<'_, '_> {
    /// `owner` is the phrase that messages begin with, such as "the joint `elbow`"; `at` is its name.
    pub(super) fn check_fields(&mut self, owner: &str, at: &Ident, fields: &tree::Fields, known: &Known<'_>) {
        self.check_given(owner, fields, known);
        if fields.broken {
            return self.report.silent();
        }
        // A misspelt field is told as such, not as a missing one too.
        let misspelt = |name: &str| {
            let given = fields.list.iter().map(|f| f.name.to_string());
            let mut unknown = given.filter(|given| !known.has(given));
            unknown.any(|given| known.meant(&given) == Some(name) || nearest(&given, [name]).is_some())
        };
        let missing: Vec<&str> =
            known.required.iter().copied().filter(|name| field(fields, name).is_none() && !misspelt(name)).collect();
        if let [first, ..] = missing.as_slice() {
            self.report.help(
                at.span(),
                format!("{owner} lacks `{}`", missing.join("`, `")),
                format!("write `{first}: {}`", example(first, known)),
            );
        }
    }

    /// Unknown and repeated fields.
    pub(super) fn check_given(&mut self, owner: &str, fields: &tree::Fields, known: &Known<'_>) {
        let mut seen: Vec<String> = Vec::new();
        for given in &fields.list {
            let name = given.name.to_string();
            if name == tree::UNREADABLE {
                self.report.silent();
                continue;
            }
            if let (false, Some(meant)) = (known.has(&name), known.meant(&name)) {
                let message = format!("{owner} has no field `{name}`");
                self.report.help(given.name.span(), message, format!("write `{meant}`"));
            } else if !known.has(&name) {
                let list: Vec<&str> = known.names().collect();
                self.report.unknown(
                    given.name.span(),
                    format!("{owner} has no field `{name}`"),
                    &name,
                    known.names(),
                    Some(format!("it has `{}`", list.join("`, `"))),
                );
            } else if seen.contains(&name) {
                let message = format!("the field `{name}` is given twice");
                self.report.error(given.name.span(), message);
            }
            seen.push(name);
        }
    }
}

/// What a field may look like.
fn example(name: &str, known: &Known<'_>) -> &'static str {
    match name {
        "axes" if known.has("at") => "ground",
        "mass" => "1.0",
        "axis" => "Z",
        "axes" => "[X, Y]",
        "parent" | "child" | "at" => "<frame>",
        "between" => "[<frame>, <frame>]",
        "pitch" => "<metres per radian>",
        "length" if known.has("stiffness") => "<natural length>",
        "given" => "<joint or body.pose>",
        "find" => "<coordinates>",
        "joint" => "<joint>",
        _ => "<value>",
    }
}
