//! Stage `robots`: what a part says of its robot.
//!
//! In: the fields of `part arm: Urdf { .. };`, or `Mjcf`. Out: options; errors at the user's own tokens.

use proc_macro2::{Ident, Span};
use syn::{Expr, ExprLit, Lit, LitStr, Member};

use crate::diagnostics::{Diagnostics, nearest};
use crate::syntax::tree::{self, Part};

/// What the root hangs on.
#[derive(Clone)]
pub(super) enum Base {
    /// It is fixed to a frame of the module that uses the part.
    Frame(Expr),
    /// A `Free` joint on the ground; the word.
    Free(Ident),
}

/// `link7.mass`
#[derive(Clone)]
pub(super) struct Quantity {
    pub(super) item: Ident,
    pub(super) of: Ident,
}

#[derive(Clone)]
pub(super) struct Options {
    pub(super) file: LitStr,
    pub(super) base: Base,
    pub(super) lock: Vec<Ident>,
    pub(super) drop: Vec<Ident>,
    pub(super) params: Vec<Quantity>,
    /// Whether each joint of one coordinate has an input for its effort.
    pub(super) is_driven: bool,
    pub(super) are_angles_snapped: bool,
    pub(super) is_friction_ignored: bool,
    pub(super) is_inertia_waived: bool,
}

impl Options {
    /// Of a robot that stands on a frame, with everything as its file has it.
    pub(super) fn plain(file: &str) -> Options {
        let span = Span::call_site();
        Options {
            file: LitStr::new(file, span),
            base: Base::Frame(tree::poison()),
            lock: Vec::new(),
            drop: Vec::new(),
            params: Vec::new(),
            is_driven: false,
            are_angles_snapped: false,
            is_friction_ignored: false,
            is_inertia_waived: false,
        }
    }
}

const FIELDS: [&str; 9] = ["file", "base", "lock", "drop", "param", "efforts", "angles", "friction", "allow"];

/// Nothing if a mistake has been reported.
pub(super) fn read(part: &Part, extension: &str, diagnostics: &mut Diagnostics) -> Option<Options> {
    let before = diagnostics.errors().len();
    let form = format!("write `part arm: {} {{ file: \"arm.{extension}\", base: ground }};`", part.kind);
    let mut file = None;
    let mut base = None;
    let mut options = Options::plain("");
    let mut seen: Vec<String> = Vec::new();
    for field in &part.fields.list {
        let name = field.name.to_string();
        let span = field.name.span();
        if seen.contains(&name) {
            diagnostics.error(span, format!("field `{name}` is given twice"));
            continue;
        }
        seen.push(name.clone());
        if tree::poisoned(&field.value) {
            continue;
        }
        let value = &field.value;
        match name.as_str() {
            "file" => match value {
                Expr::Lit(ExprLit { lit: Lit::Str(text), .. }) => file = Some(text.clone()),
                _ => diagnostics.error_help(span, "`file` is a path in quotation marks", form.clone()),
            },
            "base" => {
                base = Some(match word(value) {
                    Some(free) if free == "Free" => Base::Free(free.clone()),
                    _ => Base::Frame(value.clone()),
                });
            }
            "lock" => options.lock = names(span, value, diagnostics),
            "drop" => options.drop = names(span, value, diagnostics),
            "param" => options.params = quantities(span, value, diagnostics),
            "efforts" => options.is_driven = is(span, value, ["Inputs", "Declared"], diagnostics),
            "angles" => options.are_angles_snapped = is(span, value, ["Snapped", "Written"], diagnostics),
            "friction" => options.is_friction_ignored = is(span, value, ["Ignored", "Refused"], diagnostics),
            "allow" => options.is_inertia_waived = is(span, value, ["unphysical_inertia", "nothing"], diagnostics),
            _ => {
                let help = match nearest(&name, FIELDS) {
                    Some(near) => format!("did you mean `{near}`?"),
                    None => format!("a robot has the fields `{}`", FIELDS.join("`, `")),
                };
                diagnostics.error_help(span, format!("unknown field `{name}`"), help);
            }
        }
    }
    if !part.fields.broken && diagnostics.errors().len() == before {
        if file.is_none() {
            diagnostics.error_help(part.name.span(), format!("`{}` needs the field `file`", part.name), form);
        } else if base.is_none() {
            let help = "write `base: ground` or another frame, or `base: Free` for a robot that floats";
            diagnostics.error_help(part.name.span(), format!("`{}` needs the field `base`", part.name), help);
        }
    }
    if diagnostics.errors().len() > before {
        return None;
    }
    Some(Options { file: file?, base: base?, ..options })
}

/// A single name.
fn word(expr: &Expr) -> Option<&Ident> {
    match expr {
        Expr::Path(path) => path.path.get_ident(),
        _ => None,
    }
}

fn elements(expr: &Expr) -> Vec<&Expr> {
    match expr {
        Expr::Array(array) => array.elems.iter().collect(),
        other => vec![other],
    }
}

fn names(field: Span, expr: &Expr, diagnostics: &mut Diagnostics) -> Vec<Ident> {
    let found: Option<Vec<Ident>> = elements(expr).into_iter().map(|element| word(element).cloned()).collect();
    found.unwrap_or_else(|| {
        diagnostics.error_help(field, "expected names", "write `[name, name]`");
        Vec::new()
    })
}

fn quantities(field: Span, expr: &Expr, diagnostics: &mut Diagnostics) -> Vec<Quantity> {
    let quantity = |element: &Expr| match element {
        Expr::Field(taken) => match (word(&taken.base), &taken.member) {
            (Some(item), Member::Named(of)) => Some(Quantity { item: item.clone(), of: of.clone() }),
            _ => None,
        },
        _ => None,
    };
    let found: Option<Vec<Quantity>> = elements(expr).into_iter().map(quantity).collect();
    found.unwrap_or_else(|| {
        diagnostics.error_help(
            field,
            "expected quantities of links and joints",
            "write `[link7.mass, joint1.damping]`",
        );
        Vec::new()
    })
}

/// Whether it is the first of two words.
fn is(field: Span, expr: &Expr, words: [&str; 2], diagnostics: &mut Diagnostics) -> bool {
    match word(expr) {
        Some(found) if found == words[0] => true,
        Some(found) if found == words[1] => false,
        _ => {
            diagnostics.error(field, format!("expected `{}` or `{}`", words[0], words[1]));
            false
        }
    }
}
