//! Stage `model`: the fields between the braces of an item.
//!
//! In: fields as written, and which there may and must be. Out: errors for unknown, repeated and missing ones.

use proc_macro2::Ident;
use syn::Expr;

use crate::diagnostics::nearest;
use crate::model::checker::Checker;
use crate::syntax::tree;

/// Fields that joints have elsewhere.
const STOPS: [&str; 8] = ["lower", "upper", "min", "max", "limit", "limits", "range", "stop"];
const STOP: &str = "a joint turns without end: a stop is an `Effort` that pushes back, or an event of the integrator";

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

    /// The fields that one `name` stands for elsewhere.
    fn parts(&self, name: &str) -> &'static [&'static str] {
        match name {
            "axes" if self.has("slide") => &["axis", "slide"],
            _ => &[],
        }
    }

    /// The field that may stand in the place of `name`.
    fn instead_of(&self, name: &str) -> Option<&'static str> {
        (name == "axis" && self.has("axes")).then_some("axes")
    }

    /// "`axis` or `axes`"
    fn choice(&self, name: &str) -> String {
        match self.instead_of(name) {
            Some(other) => format!("`{name}` or `{other}`"),
            None => format!("`{name}`"),
        }
    }
}

/// The value of a field; the first one where it is repeated.
pub(in crate::model) fn field<'a>(fields: &'a tree::Fields, name: &str) -> Option<&'a Expr> {
    let field = fields.list.iter().find(|f| f.name == name)?;
    Some(&field.value)
}

impl Checker<'_, '_> {
    /// `owner` is the phrase that messages begin with, such as "the joint `elbow`"; `at` is its name.
    pub(super) fn check_fields(&mut self, owner: &str, at: &Ident, fields: &tree::Fields, known: &Known<'_>) {
        let given: Vec<String> = fields.list.iter().map(|f| f.name.to_string()).collect();
        let unknown: Vec<&str> = given.iter().map(String::as_str).filter(|given| !known.has(given)).collect();
        let meant = |given: &str, name: &str| {
            known.meant(given) == Some(name) || nearest(given, [name]).is_some() || known.parts(given).contains(&name)
        };
        // A field under another name is reported as such, and not as a missing one too.
        let missing = known.required.iter().copied().filter(|name| field(fields, name).is_none());
        let missing: Vec<&str> = missing.filter(|name| !unknown.iter().any(|given| meant(given, name))).collect();
        let strange = unknown.iter().filter(|given| !known.names().any(|name| meant(given, name)));
        let strange: Vec<&str> = strange.copied().collect();
        let (instead, missing) = match missing.split_at_checked(strange.len()) {
            Some((instead, missing)) => (strange.into_iter().zip(instead.iter().copied()).collect(), missing),
            // Which of them it is nobody knows.
            None => (Vec::new(), &[][..]),
        };
        self.check_names(owner, fields, known, &instead);
        if fields.broken {
            return self.report.silent();
        }
        if let [first, ..] = missing {
            self.report.help(
                at.span(),
                format!(
                    "{owner} lacks {}",
                    missing.iter().map(|name| known.choice(name)).collect::<Vec<_>>().join(", ")
                ),
                match known.instead_of(first) {
                    Some(other) => {
                        let [first, other] = [first, other].map(|name| format!("`{name}: {}`", example(name, known)));
                        format!("write {first}, or {other}")
                    }
                    None => format!("write `{first}: {}`", example(first, known)),
                },
            );
        }
    }

    /// Unknown and repeated fields.
    pub(super) fn check_given(&mut self, owner: &str, fields: &tree::Fields, known: &Known<'_>) {
        self.check_names(owner, fields, known, &[]);
    }

    /// `instead`: unknown names, each with a field that is missing.
    fn check_names(&mut self, owner: &str, fields: &tree::Fields, known: &Known<'_>, instead: &[(&str, &str)]) {
        let mut seen: Vec<String> = Vec::new();
        for given in &fields.list {
            let name = given.name.to_string();
            if name == tree::UNREADABLE {
                self.report.silent();
                continue;
            }
            let missing = instead.iter().find(|(given, _)| *given == name).map(|(_, missing)| *missing);
            let parts: Vec<&str> =
                known.parts(&name).iter().copied().filter(|part| field(fields, part).is_none()).collect();
            if let ([_, ..], false) = (&parts[..], known.has(&name)) {
                let message = format!("{owner} has no field `{name}`");
                let parts: Vec<String> =
                    parts.iter().map(|part| format!("`{part}: {}`", example(part, known))).collect();
                self.report.help(given.name.span(), message, format!("write {}", parts.join(" and ")));
            } else if let (false, Some(meant)) = (known.has(&name), known.meant(&name).or(missing)) {
                let message = format!("{owner} has no field `{name}`");
                self.report.help(given.name.span(), message, format!("write `{meant}`"));
            } else if !known.has(&name) {
                let list: Vec<&str> = known.names().collect();
                let stop = owner.contains("joint") && STOPS.contains(&name.as_str());
                let help = if stop { STOP.to_owned() } else { format!("it has `{}`", list.join("`, `")) };
                let message = format!("{owner} has no field `{name}`");
                self.report.unknown(given.name.span(), message, &name, known.names(), Some(help));
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
        "slide" => "X",
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
