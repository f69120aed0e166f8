//! Stage `compounds`: constraints and forces that are written in the language itself.
//!
//! In: the syntax tree of a call. Out: the same tree, in which `constraint rear: Rolling { wheel: hub, .. }` is a use of a part
//! that stands in a file beside this one, every token of it at the user's `Rolling`: all that comes behind sees bodies, forces
//! and expressions. What the part calls by a name is a quantity of the item: `rear.slip`. A kind may have several forms, told
//! apart by the fields that are given. The words reserve no names: a part or model of the user's may be called as one of these.

use proc_macro2::{Ident, Span};
use syn::ext::IdentExt;

use crate::diagnostics::{Diagnostics, nearest};
use crate::invariant::fault::OrFault;
use crate::syntax::tree::{Field, Fields, Item, ItemKind, Part, Source};
use crate::syntax::written;

/// A kind of a constraint or force.
struct Compound {
    /// `constraint` or `force`.
    keyword: &'static str,
    kind: &'static str,
    forms: &'static [Form],
}

/// One way in which a kind is written.
struct Form {
    /// The field that chooses it; the last form has none.
    by: Option<&'static str>,
    required: &'static [&'static str],
    /// With what they are where they are left out.
    optional: &'static [(&'static str, &'static str)],
    /// Of the part.
    name: &'static str,
    text: &'static str,
}

const ON: (&str, &str) = ("on", "ground");

/// All of them.
const COMPOUNDS: [Compound; 3] = [
    Compound {
        keyword: "constraint",
        kind: "Rolling",
        forms: &[
            Form {
                by: Some("axis"),
                required: &["wheel", "axis", "radius"],
                optional: &[ON],
                name: "rolling_disc",
                text: include_str!("rolling_disc.txt"),
            },
            Form {
                by: None,
                required: &["wheel", "radius"],
                optional: &[ON],
                name: "rolling_ball",
                text: include_str!("rolling_ball.txt"),
            },
        ],
    },
    Compound {
        keyword: "constraint",
        kind: "Skate",
        forms: &[Form {
            by: None,
            required: &["blade", "along"],
            optional: &[ON],
            name: "skate",
            text: include_str!("skate.txt"),
        }],
    },
    Compound {
        keyword: "force",
        kind: "Contact",
        forms: &[
            Form {
                by: Some("axis"),
                required: &["at", "axis", "radius", "stiffness", "damping"],
                optional: &[ON, EXPONENT, FRICTION, SLIP],
                name: "contact_disc",
                text: concat!(include_str!("contact_disc.txt"), include_str!("contact_law.txt")),
            },
            Form {
                by: Some("ball"),
                required: &["at", "radius", "ball", "ball_radius", "stiffness", "damping"],
                optional: &[EXPONENT, FRICTION, SLIP],
                name: "contact_balls",
                text: concat!(include_str!("contact_balls.txt"), include_str!("contact_law.txt")),
            },
            Form {
                by: None,
                required: &["at", "stiffness", "damping"],
                optional: &[("radius", "0"), ON, EXPONENT, FRICTION, SLIP],
                name: "contact_ball",
                text: concat!(include_str!("contact_ball.txt"), include_str!("contact_law.txt")),
            },
        ],
    },
];

/// Of Hertz.
const EXPONENT: (&str, &str) = ("exponent", "1.5");
const FRICTION: (&str, &str) = ("friction", "0");
/// m/s
const SLIP: (&str, &str) = ("slip_speed", "0.01");

impl Form {
    fn fields(&self) -> impl Iterator<Item = &'static str> + Clone {
        self.required.iter().copied().chain(self.optional.iter().map(|field| field.0))
    }

    /// What the part's ports and parameters are.
    fn bound(&self, fields: &Fields, span: Span) -> Vec<Field> {
        let given = fields.list.iter().map(|field| Field { name: field.name.clone(), value: field.value.clone() });
        let left = self.optional.iter().filter(|(name, _)| fields.list.iter().all(|field| field.name != name));
        let left = left.map(|(name, value)| {
            let value = syn::parse_str(value).ok().or_fault("what a field is by default is an expression");
            Field { name: Ident::new(name, span), value }
        });
        given.chain(left).collect()
    }
}

impl Compound {
    fn named(keyword: &str, kind: &Ident) -> Option<&'static Compound> {
        COMPOUNDS.iter().find(|compound| compound.keyword == keyword && kind == compound.kind)
    }

    /// The form that the fields choose, unless they have mistakes, which are reported.
    fn form(&self, name: &Ident, fields: &Fields, diagnostics: &mut Diagnostics) -> Option<&'static Form> {
        let is_given = |known: &str| fields.list.iter().any(|field| field.name == known);
        let form = self.forms.iter().find(|form| form.by.is_none_or(is_given))?;
        let errors = diagnostics.errors().len();
        let owner = format!("the {} `{name}`", self.keyword);
        for (k, field) in fields.list.iter().enumerate() {
            let given = field.name.to_string();
            if fields.list[..k].iter().any(|other| other.name == given) {
                diagnostics.error(field.name.span(), format!("the field `{given}` is given twice"));
            } else if form.fields().all(|known| known != given) {
                let mut all = self.forms.iter().flat_map(Form::fields);
                let mut known: Vec<&str> = Vec::new();
                // What would choose another form is there too, where nothing has chosen this one.
                let others = self.forms.iter().filter(|_| form.by.is_none()).flat_map(Form::fields);
                for field in form.fields().chain(others) {
                    if !known.contains(&field) {
                        known.push(field);
                    }
                }
                let has = format!("it has `{}`", known.join("`, `"));
                let help = match (form.by, nearest(&given, all.clone())) {
                    (Some(by), _) if all.any(|known| known == given) => format!("with `{by}` {has}"),
                    (_, Some(near)) => format!("did you mean `{near}`?"),
                    _ => has,
                };
                diagnostics.error_help(field.name.span(), format!("{owner} has no field `{given}`"), help);
            }
        }
        let missing: Vec<&str> = form.required.iter().copied().filter(|known| !is_given(known)).collect();
        let is_told = fields.broken || diagnostics.errors().len() > errors;
        if let ([_, ..], false) = (missing.as_slice(), is_told) {
            diagnostics.error(name.span(), format!("{owner} needs `{}`", missing.join("`, `")));
        }
        (!fields.broken && diagnostics.errors().len() == errors).then_some(form)
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
            let mut called = format!("{}_{}", form.name, name.unraw());
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
                fields: Fields { span: fields.span, list: form.bound(fields, kind.span()), broken: false },
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
