//! Stage `model`: what is said once per model: `world`, `formulation`.
//!
//! In: their items. Out: gravity, what becomes of constraints, whether speeds are to be chosen, the independent coordinates, rounds of Newton's method.

use proc_macro2::Span;
use syn::Expr;
use syn::spanned::Spanned;

use crate::model::checker::{Checker, ScopeId};
use crate::model::expand::root;
use crate::model::topology::Topology;
use crate::model::typed::Allowed;
use crate::model::types::Expr as Checked;
use crate::model::types::{Coordinate, Handling, Joints, Packs};
use crate::syntax::tree;

use super::fields::{Known, field};

const WORLD: Known<'static> = Known { required: &[], optional: &["gravity"] };

const FORMULATION: Known<'static> = Known {
    required: &[],
    optional: &["coordinates", "constraints", "independent", "rounds", "packs", "speeds", "rate", "position"],
};

/// More rounds of Newton's method than any guess is worth.
const MOST_ROUNDS: usize = 50;

const PACKS: [&str; 2] = ["Off", "Four"];

const SPEEDS: [&str; 2] = ["Rates", "Auto"];

const HANDLINGS: [&str; 4] = ["Multipliers", "Reduced", "Stabilised", "Auto"];

impl<'a> Checker<'a, '_> {
    pub(in crate::model) fn world(&mut self, fields: &'a tree::Fields, scope: ScopeId) -> Option<Checked> {
        self.check_given("the world", fields, &WORLD);
        let gravity = field(fields, "gravity")?;
        let gravity = self.vector(gravity, root(scope), Allowed::Parameters)?;
        self.finite(&gravity)?;
        Some(gravity.expr)
    }

    /// The coordinates have been read before anything else; here their mistakes are reported.
    pub(in crate::model) fn formulation(&mut self, fields: &'a tree::Fields, scope: ScopeId) -> Option<Handling> {
        self.check_given("the formulation", fields, &FORMULATION);
        if let Some(expr) = field(fields, "coordinates") {
            self.check_coordinates(expr);
        }
        let mut term = |name: &str| {
            let expr = field(fields, name)?;
            let value = self.scalar(expr, root(scope), Allowed::Parameters)?;
            self.not_negative(&value, "a term of the stabilisation").map(|value| (expr.span(), value.expr))
        };
        let (rate, position) = (term("rate"), term("position"));
        let Some(expr) = field(fields, "constraints") else {
            if let Some(stray) = fields.list.iter().find(|given| given.name == "rate" || given.name == "position") {
                self.stray_term(&stray.name);
            }
            return None;
        };
        let name = self.word(expr)?;
        if matches!(name.as_str(), "Multipliers" | "Reduced" | "Auto")
            && let Some(stray) = fields.list.iter().find(|given| given.name == "rate" || given.name == "position")
        {
            self.stray_term(&stray.name);
        }
        match name.as_str() {
            "Multipliers" => Some(Handling::Multipliers),
            "Reduced" => Some(Handling::Reduced),
            "Auto" => Some(Handling::Auto),
            "Stabilised" => {
                if let (Some((_, rate)), Some((_, position))) = (&rate, &position) {
                    return Some(Handling::Stabilised { rate: rate.clone(), position: position.clone() });
                }
                for missing in ["rate", "position"].iter().filter(|name| field(fields, name).is_none()) {
                    self.report.help(
                        expr.span(),
                        format!("`Stabilised` needs `{missing}`"),
                        "write `constraints: Stabilised, rate: 40.0, position: 400.0`, in 1/s and 1/s^2",
                    );
                }
                None
            }
            other => {
                self.report.unknown(
                    expr.span(),
                    "unknown treatment of constraints",
                    other,
                    HANDLINGS,
                    Some(format!("there are `{}`", HANDLINGS.join("`, `"))),
                );
                None
            }
        }
    }

    /// `rounds: 4`
    pub(in crate::model) fn rounds(&mut self, fields: &'a tree::Fields, scope: ScopeId) -> Option<usize> {
        let expr = field(fields, "rounds")?;
        let rounds = self.whole_number(expr, root(scope))?;
        match usize::try_from(rounds) {
            Ok(rounds) if (1..=MOST_ROUNDS).contains(&rounds) => Some(rounds),
            _ => {
                let message = format!("expected a number of rounds from 1 to {MOST_ROUNDS}, found {rounds}");
                self.report.help(
                    expr.span(),
                    message,
                    "Newton's method doubles its digits in every round: three serve a guess that is near, six one that is not",
                );
                None
            }
        }
    }

    /// `packs: Four`
    pub(in crate::model) fn packs(&mut self, fields: &'a tree::Fields) -> Option<Packs> {
        let expr = field(fields, "packs")?;
        let name = self.word(expr)?;
        match name.as_str() {
            "Four" => Some(Packs::Four),
            "Off" => Some(Packs::Off),
            other => {
                let help = Some(format!("there are `{}`", PACKS.join("`, `")));
                self.report.unknown(expr.span(), "unknown packs of limbs", other, PACKS, help);
                None
            }
        }
    }

    /// `speeds: Auto`
    pub(in crate::model) fn speed_choice(&mut self, fields: &'a tree::Fields) -> Option<Span> {
        let expr = field(fields, "speeds")?;
        let name = self.word(expr)?;
        if !SPEEDS.contains(&name.as_str()) {
            let help =
                Some(format!("there are `{}`; speeds of your own are items: `speed u = ..;`", SPEEDS.join("`, `")));
            self.report.unknown(expr.span(), "unknown choice of speeds", &name, SPEEDS, help);
        }
        (name == "Auto").then(|| expr.span())
    }

    /// A word of the language; empty where something else stands. What couldn't be read has been told of.
    fn word(&mut self, expr: &Expr) -> Option<String> {
        match expr {
            Expr::Verbatim(_) => {
                self.report.silent();
                None
            }
            Expr::Path(path) => Some(path.path.get_ident().map(ToString::to_string).unwrap_or_default()),
            _ => Some(String::new()),
        }
    }

    fn stray_term(&mut self, name: &proc_macro2::Ident) {
        self.report.error(name.span(), format!("`{name}` goes with `constraints: Stabilised` only"));
    }

    /// `independent: [crank, rocker.angle]`
    pub(in crate::model) fn independent(
        &mut self,
        fields: &'a tree::Fields,
        scope: ScopeId,
        joints: Option<(&Topology, &Joints)>,
    ) -> Vec<Coordinate> {
        let Some(expr) = field(fields, "independent") else {
            return Vec::new();
        };
        let Some(found) = self.several_coordinates(expr, root(scope)) else {
            return Vec::new();
        };
        let mut independent = Vec::new();
        for (coordinate, at) in found {
            match joints {
                Some((topology, list)) if topology.is_cut(coordinate.joint) => {
                    self.refuse_cut_coordinate(coordinate.joint, at, list);
                }
                _ if independent.contains(&coordinate) => {
                    let message = format!("{} is named twice", self.coordinate_name(coordinate));
                    self.report.error(at, message);
                }
                _ => independent.push(coordinate),
            }
        }
        independent
    }

    /// An item of which a model has one.
    pub(in crate::model) fn only_once(&mut self, seen: &mut bool, keyword: Span, name: &str) {
        if *seen {
            let message = format!("a model has one `{name}`");
            self.report.help(keyword, message, "write both into the first");
        }
        *seen = true;
    }
}
