//! Stage `model`: what is said once per model: `world`, `formulation`, `emit`.
//!
//! In: their items. Out: gravity, the functions to derive; 'not yet' for what later versions bring.

use proc_macro2::Span;
use syn::Expr;
use syn::spanned::Spanned;

use super::checker::{Checker, ScopeId};
use super::expand::root;
use super::fields::{Known, field};
use super::typed::Allowed;
use super::types::{Expr as Checked, Request};
use crate::syntax::tree;

const WORLD: Known<'static> = Known { required: &[], optional: &["gravity"] };

const FORMULATION: Known<'static> = Known { required: &[], optional: &["coordinates", "constraints", "independent"] };

const REQUESTS: [(&str, Request); 5] = [
    ("forward_dynamics", Request::ForwardDynamics),
    ("inverse_dynamics", Request::InverseDynamics),
    ("mass_matrix", Request::MassMatrix),
    ("bias", Request::Bias),
    ("energy", Request::Energy),
];

/// Named by the design, derived by later versions.
const NOT_YET: [&str; 11] = [
    "kinematics",
    "residual",
    "derivatives",
    "linearize",
    "regressor",
    "constraints",
    "constraint_jacobian",
    "constraint_bias",
    "assemble",
    "reactions",
    "gravity",
];

impl<'a> Checker<'a, '_> {
    pub(super) fn world(&mut self, fields: &'a tree::Fields, scope: ScopeId) -> Option<Checked> {
        self.check_given("the world", fields, &WORLD);
        let gravity = field(fields, "gravity")?;
        let gravity = self.vector(gravity, root(scope), Allowed::Parameters)?;
        self.finite(&gravity)?;
        Some(gravity.expr)
    }

    pub(super) fn formulation(&mut self, fields: &tree::Fields) {
        self.check_given("the formulation", fields, &FORMULATION);
        for given in &fields.list {
            let name = given.name.to_string();
            let joint = matches!(&given.value, Expr::Path(path) if path.path.is_ident("Joint"));
            if matches!(given.value, Expr::Verbatim(_)) {
                self.report.silent();
            } else if name == "coordinates" && !joint {
                self.report.help(
                    given.value.span(),
                    "coordinates other than `Joint` are not available yet",
                    "write `coordinates: Joint`",
                );
            } else if matches!(name.as_str(), "constraints" | "independent") {
                self.report.error(given.name.span(), format!("`{name}` is not available yet: loops come later"));
            }
        }
    }

    pub(super) fn emit(&mut self, requests: &[tree::Request], into: &mut Vec<Request>) {
        for request in requests {
            let name = request.name.to_string();
            let span = request.name.span();
            if name == tree::UNREADABLE {
                self.report.silent();
                continue;
            }
            if let Some(options) = &request.options {
                match options.list.first() {
                    Some(option) => self.report.error(
                        option.name.span(),
                        format!("options of `emit`, such as `{}`, are not available yet", option.name),
                    ),
                    None if options.broken => self.report.silent(),
                    None => {}
                }
            }
            if let Some((_, found)) = REQUESTS.iter().find(|(known, _)| *known == name) {
                if into.contains(found) {
                    let message = format!("`{name}` is asked for twice");
                    self.report.error(span, message);
                } else {
                    into.push(*found);
                }
            } else if NOT_YET.contains(&name.as_str()) {
                let message = format!("`{name}` is not available yet");
                self.report.error(span, message);
            } else if name == "outputs" {
                self.report.help(span, "`outputs` needs no asking for", "outputs are always emitted");
            } else {
                let list: Vec<&str> = REQUESTS.iter().map(|(known, _)| *known).collect();
                self.report.unknown(
                    span,
                    format!("`{name}` is nothing that can be derived"),
                    &name,
                    list.iter().copied().chain(NOT_YET),
                    Some(format!("there are `{}`", list.join("`, `"))),
                );
            }
        }
    }

    /// An item of which a model has one.
    pub(super) fn only_once(&mut self, seen: &mut bool, keyword: Span, name: &str) {
        if *seen {
            let message = format!("a model has one `{name}`");
            self.report.help(keyword, message, "write both into the first");
        }
        *seen = true;
    }
}
