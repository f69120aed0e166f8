//! Stage `model`: functions that go on from what is done once for a position.
//!
//! In: `emit at { functions: [..] }`, and what else is asked for. Out: the functions, by the names of their methods. Whether
//! equations keep multipliers, which some functions are about, is not known here: stage `mechanics` says where there are none.

use proc_macro2::Ident;
use syn::Expr;
use syn::ext::IdentExt;
use syn::spanned::Spanned;

use crate::model::checker::Checker;
use crate::model::types::{AtFunction, Output, OutputGroup, Request};
use crate::syntax::tree;

use super::fields::{Known, field};
use super::requests::elements;

const FIELDS: Known<'static> = Known { required: &["functions"], optional: &[] };

const FORM: &str = "write `at { functions: [mass_matrix, bias] }`";

/// Methods, with the word of `emit` that gives each; nothing for those that are there without one.
const FUNCTIONS: [(&str, Option<(Request, &str)>); 22] = [
    ("forward_dynamics", Some((Request::ForwardDynamics, "forward_dynamics"))),
    ("inverse_dynamics", Some((Request::InverseDynamics, "inverse_dynamics"))),
    ("mass_matrix", Some((Request::MassMatrix, "mass_matrix"))),
    ("mass_matrix_lower", Some((Request::MassMatrixLower, "mass_matrix_lower"))),
    ("bias", Some((Request::Bias, "bias"))),
    ("kinetic_energy", Some((Request::Energy, "energy"))),
    ("potential_energy", Some((Request::Energy, "energy"))),
    ("constraints", None),
    ("constraint_jacobian", None),
    ("constraint_rate", None),
    ("constraint_bias", None),
    ("residual", Some((Request::Residual, "residual"))),
    ("forward_derivatives", Some((Request::Derivatives, "derivatives"))),
    ("inverse_derivatives", Some((Request::Derivatives, "derivatives"))),
    ("linearize", Some((Request::Linearize, "linearize"))),
    ("impulse", Some((Request::Impulse, "impulse"))),
    ("momentum", Some((Request::Momentum, "momentum"))),
    ("momentum_rate", Some((Request::Momentum, "momentum"))),
    ("velocity", Some((Request::Momentum, "momentum"))),
    ("centroidal_momentum_matrix", Some((Request::CentroidalMomentumMatrix, "centroidal_momentum_matrix"))),
    ("poses", Some((Request::Poses, "poses"))),
    ("outputs", None),
];

/// Words and methods that can't stand here; what to do instead.
const ELSEWHERE: [(&str, &str); 9] = [
    ("energy", "it gives two functions: name `kinetic_energy`, `potential_energy`"),
    ("derivatives", "it gives two functions: name `forward_derivatives`, `inverse_derivatives`"),
    ("kinematics", "it finds a position of its own from what is given: call it on the model"),
    ("assembly_modes", "it finds positions from what is given: call it on the model"),
    ("close", "it finds the guess, which `at` takes: call it on the model"),
    ("dead_centres", "integrators ask for it: call it on the model"),
    ("margins", "integrators ask for it: call it on the model"),
    ("report", "it is no function"),
    ("equations", "it is no function"),
];

impl<'a> Checker<'a, '_> {
    pub(in crate::model) fn at_functions(
        &mut self,
        request: Option<&'a tree::Request>,
        asked: &[Request],
        outputs: &[Output],
        groups: &[OutputGroup],
    ) -> Vec<AtFunction> {
        let Some(request) = request else { return Vec::new() };
        let span = request.name.span();
        let Some(options) = &request.options else {
            self.report.help(span, "`at` needs to know which functions go on from it", FORM);
            return Vec::new();
        };
        // Only here would the struct be in the way.
        if let Some(part) = self.part_types.iter().find(|part| part.name == "At") {
            let message = "the struct that `at` gives would be `At`";
            let help = format!("there is a part of this name: give `mod {}` another one", part.name);
            self.report.help(span, message, help);
        }
        self.check_fields("`at`", &request.name, options, &FIELDS);
        let Some(list) = field(options, "functions") else { return Vec::new() };
        let elements = elements(list);
        if elements.is_empty() {
            self.report.help(list.span(), "no function is named", FORM);
        }
        let groups: Vec<String> = groups.iter().map(OutputGroup::method).collect();
        let mut found: Vec<AtFunction> = Vec::new();
        for element in elements {
            let name = match element {
                Expr::Verbatim(_) => {
                    self.report.silent();
                    continue;
                }
                Expr::Path(path) => path.path.get_ident().filter(|_| path.qself.is_none()),
                _ => None,
            };
            let Some(name) = name else {
                self.report.help(element.span(), "expected the name of a function", FORM);
                continue;
            };
            if found.iter().any(|known| name.unraw() == known.name) {
                self.report.error(name.span(), format!("`{name}` is named twice"));
            } else if self.is_at_function(name, asked, outputs, &groups) {
                found.push(AtFunction { name: name.unraw().to_string(), span: name.span() });
            }
        }
        found
    }

    /// Whether a function of this name is emitted, and may stand here.
    fn is_at_function(&mut self, name: &Ident, asked: &[Request], outputs: &[Output], groups: &[String]) -> bool {
        let text = name.unraw().to_string();
        if groups.contains(&text) {
            return true;
        }
        if let Some((_, by)) = FUNCTIONS.iter().find(|known| known.0 == text) {
            match by {
                Some((request, word)) if !asked.contains(request) => {
                    let message = format!("`{text}` is not asked for");
                    self.report.help(
                        name.span(),
                        message,
                        format!("name it beside `at` too: `emit {word}, at {{ .. }}`"),
                    );
                }
                None if text == "outputs" && outputs.is_empty() => {
                    let message = "this model has no outputs";
                    self.report.help(name.span(), message, "declare one: `output name = value;`");
                }
                _ => return true,
            }
            return false;
        }
        if let Some((_, instead)) = ELSEWHERE.iter().find(|known| known.0 == text) {
            self.report.help(name.span(), format!("`{text}` can't go on from a position"), *instead);
            return false;
        }
        let known = FUNCTIONS.iter().map(|known| known.0).chain(groups.iter().map(String::as_str));
        let names: Vec<&str> = known.collect();
        let message = format!("`{text}` is no function of a model");
        let all = format!("there are `{}`", names.join("`, `"));
        self.report.unknown(name.span(), message, &text, names.iter().copied(), Some(all));
        false
    }
}
