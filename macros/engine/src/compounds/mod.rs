//! Stage `compounds`: constraints and forces that are written in the language itself.
//!
//! In: the syntax tree of a call. Out: the same tree, in which `constraint rear: Rolling { wheel: hub, .. }` is a use of a part
//! that stands in a file beside this one, every token of it at the user's `Rolling`: all that comes behind sees bodies, forces
//! and expressions. What the part calls by a name is a quantity of the item: `rear.slip`. A kind may have several forms, told
//! apart by the fields that are given. The words reserve no names: a part or model of the user's may be called as one of these.

use proc_macro2::{Ident, Span};
use syn::Expr;

use crate::diagnostics::{Diagnostics, nearest};
use crate::syntax::tree::{Field, Fields, Item, ItemKind, Part, Source};
use crate::syntax::written;

/// A kind of a constraint or force.
pub(crate) struct Compound {
    /// `constraint` or `force`.
    pub keyword: &'static str,
    pub kind: &'static str,
    pub required: &'static [&'static str],
    /// With what they are where they are left out; without anything they choose the form.
    pub optional: &'static [(&'static str, Option<&'static str>)],
    forms: &'static [Form],
}

/// One way in which a kind is written.
struct Form {
    /// Fields without a value of their own that are given.
    with: &'static [&'static str],
    /// Of the part.
    name: &'static str,
    text: &'static str,
}

/// All of them.
pub(crate) const COMPOUNDS: [Compound; 2] = [
    Compound {
        keyword: "constraint",
        kind: "Rolling",
        required: &["wheel", "radius"],
        optional: &[("axis", None), ("on", Some("ground"))],
        forms: &[
            Form { with: &[], name: "rolling_ball", text: include_str!("rolling_ball.txt") },
            Form { with: &["axis"], name: "rolling_disc", text: include_str!("rolling_disc.txt") },
        ],
    },
    Compound {
        keyword: "constraint",
        kind: "Skate",
        required: &["blade", "along"],
        optional: &[("on", Some("ground"))],
        forms: &[Form { with: &[], name: "skate", text: include_str!("skate.txt") }],
    },
];

impl Compound {
    fn named(keyword: &str, kind: &Ident) -> Option<&'static Compound> {
        COMPOUNDS.iter().find(|compound| compound.keyword == keyword && kind == compound.kind)
    }

    fn fields(&self) -> impl Iterator<Item = &'static str> + Clone {
        self.required.iter().copied().chain(self.optional.iter().map(|field| field.0))
    }

    /// Reports fields that don't belong here; the form that the others choose.
    fn form(&self, name: &Ident, fields: &Fields, diagnostics: &mut Diagnostics) -> Option<&'static Form> {
        let errors = diagnostics.errors().len();
        let owner = format!("the {} `{name}`", self.keyword);
        for (k, field) in fields.list.iter().enumerate() {
            let given = field.name.to_string();
            if fields.list[..k].iter().any(|other| other.name == given) {
                diagnostics.error(field.name.span(), format!("the field `{given}` is given twice"));
            } else if !self.fields().any(|known| known == given) {
                let help = match nearest(&given, self.fields()) {
                    Some(near) => format!("did you mean `{near}`?"),
                    None => format!("it has `{}`", self.fields().collect::<Vec<_>>().join("`, `")),
                };
                diagnostics.error_help(field.name.span(), format!("{owner} has no field `{given}`"), help);
            }
        }
        let is_given = |known: &str| fields.list.iter().any(|field| field.name == known);
        let missing: Vec<&str> = self.required.iter().copied().filter(|known| !is_given(known)).collect();
        let is_told = fields.broken || diagnostics.errors().len() > errors;
        if let ([_, ..], false) = (missing.as_slice(), is_told) {
            diagnostics.error(name.span(), format!("{owner} needs `{}`", missing.join("`, `")));
        }
        if fields.broken || diagnostics.errors().len() > errors {
            return None;
        }
        let choosing = self.optional.iter().filter(|field| field.1.is_none() && is_given(field.0));
        let with: Vec<&str> = choosing.map(|field| field.0).collect();
        self.forms.iter().find(|form| form.with == with)
    }

    /// What the part's ports and parameters are.
    fn bound(&self, fields: &Fields, span: Span) -> Vec<Field> {
        let given = fields.list.iter().map(|field| Field { name: field.name.clone(), value: field.value.clone() });
        let is_left = |name: &str| fields.list.iter().all(|field| field.name != name);
        let left = self.optional.iter().filter_map(|&(name, value)| {
            let value: Expr = syn::parse_str(value.filter(|_| is_left(name))?).ok()?;
            Some(Field { name: Ident::new(name, span), value })
        });
        given.chain(left).collect()
    }
}

/// Replaces every compound by a part of its own; those with a mistake are reported and taken away.
pub(crate) fn place(source: &mut Source, diagnostics: &mut Diagnostics) {
    let mut taken: Vec<String> = source.modules.iter().map(|module| module.name.to_string()).collect();
    let mut parts = Vec::new();
    for module in &mut source.modules {
        let before = module.items.len();
        module.items.retain_mut(|item| {
            let Some((keyword, name, kind, fields)) = kinded(item) else { return true };
            let Some(compound) = Compound::named(keyword, kind) else { return true };
            let Some(form) = compound.form(name, fields, diagnostics) else { return false };
            // A part for each, so that what is wrong with one is told where it stands.
            let mut called = format!("{}_{name}", form.name);
            while taken.contains(&called) {
                called.push('_');
            }
            match written(&form.text.replacen("mod _ {", &format!("mod {called} {{"), 1), kind.span()) {
                Ok(part) => parts.push(part),
                Err(why) => {
                    diagnostics.error(kind.span(), why);
                    return false;
                }
            }
            item.kind = ItemKind::Part(Part {
                name: name.clone(),
                kind: Ident::new(&called, kind.span()),
                count: None,
                index: None,
                again: None,
                fields: Fields { span: fields.span, list: compound.bound(fields, kind.span()), broken: false },
            });
            taken.push(called);
            true
        });
        module.broken |= module.items.len() < before;
    }
    source.modules.extend(parts);
}

/// An item that has a kind: keyword, name, kind, fields.
fn kinded(item: &Item) -> Option<(&'static str, &Ident, &Ident, &Fields)> {
    match &item.kind {
        ItemKind::ConstraintKind { name, kind, fields } => Some(("constraint", name, kind, fields)),
        ItemKind::Force { name, kind, fields } => Some(("force", name, kind, fields)),
        _ => None,
    }
}
