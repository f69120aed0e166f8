//! Stage `model`: equations of the user's own, and what is left out of a model.
//!
//! In: `solve (x) from a == b;`, `simplify current.rate == 0.0;`, `simplify small(hinge);`. Out: names of unknowns with their
//! systems of equations; coordinates whose motion is taken to first order.

use proc_macro2::{Ident, Span};
use syn::spanned::Spanned;
use syn::{BinOp, Expr};

use crate::model::checker::{Checker, Context, Equation, Lazy, ScopeId, Symbol, System, SystemId};
use crate::model::expressions::source_text;
use crate::model::topology::Topology;
use crate::model::types::{Coordinate, Joints};
use crate::syntax::tree::{self, ItemKind};

impl<'a> Checker<'a, '_> {
    /// Enters the unknowns of each `solve (x, y) from [a == b, c == d]`: of each item its system, if it is one.
    pub(in crate::model) fn declare_systems(
        &mut self,
        module: &'a tree::Module,
        scope: ScopeId,
    ) -> Vec<Option<SystemId>> {
        let one = |item: &'a tree::Item| match &item.kind {
            ItemKind::System { unknowns, equations, branches } => {
                Some(self.declare_system(unknowns, (equations, branches), item.keyword, scope))
            }
            _ => None,
        };
        module.items.iter().map(one).collect()
    }

    fn declare_system(
        &mut self,
        unknowns: &'a [Expr],
        (equations, branches): (&'a [Expr], &'a [Expr]),
        keyword: Span,
        scope: ScopeId,
    ) -> SystemId {
        let mut names: Vec<&Ident> = Vec::new();
        for unknown in unknowns {
            let name = match unknown {
                Expr::Path(path) => path.path.get_ident(),
                _ => None,
            };
            let Some(name) = name else {
                self.report.help(
                    unknown.span(),
                    "expected a name: these equations declare their unknowns",
                    "coordinates are found by `solve (a, b) from joint { .. }`",
                );
                continue;
            };
            if names.contains(&name) {
                self.report.error(name.span(), "this unknown is named twice");
            } else if self.is_free(name, scope) {
                names.push(name);
            }
        }
        let equations = equations.iter().filter_map(|equation| match equation {
            Expr::Binary(binary) if matches!(binary.op, BinOp::Eq(_)) => {
                Some(Equation::Equal(&binary.left, &binary.right))
            }
            _ => None,
        });
        let equations = equations.collect();
        let complete = names.len() == unknowns.len();
        let id = self.add_system(names, equations, branches, keyword, scope);
        if !complete {
            // What is left of the system has no solution, and that has been said.
            self.systems[id].state = Lazy::Done(None);
        }
        id
    }

    /// Enters states that follow from their equations: those of one module are one system. Gives their names.
    pub(in crate::model) fn declare_settled(&mut self, module: &'a tree::Module, scope: ScopeId) -> Vec<&'a Ident> {
        let settled = |name: &Ident| {
            module.items.iter().any(|item| match &item.kind {
                ItemKind::Settled(Expr::Path(path)) => path.path.is_ident(name),
                _ => false,
            })
        };
        let (mut names, mut equations, mut at) = (Vec::new(), Vec::new(), None);
        for item in &module.items {
            if let ItemKind::State { name, rate, .. } = &item.kind
                && settled(name)
            {
                names.push(name);
                equations.push(Equation::Settled(rate));
                at.get_or_insert(name.span());
            }
        }
        if let Some(at) = at {
            self.add_system(names.clone(), equations, &[], at, scope);
        }
        names
    }

    fn add_system(
        &mut self,
        unknowns: Vec<&'a Ident>,
        equations: Vec<Equation<'a>>,
        branches: &'a [Expr],
        span: Span,
        scope: ScopeId,
    ) -> SystemId {
        let id = SystemId(self.systems.len());
        let first = self.systems.last().map_or(0, |last| last.first + last.unknowns.len());
        for (place, name) in unknowns.iter().enumerate() {
            self.set_symbol(scope, name, Symbol::Unknown(id, place));
        }
        self.systems.push(System { unknowns, first, equations, branches, scope, span, state: Lazy::Waiting });
        id
    }

    /// `simplify current.rate == 0.0` names a state of its own module.
    pub(in crate::model) fn check_settled(&mut self, state: &Expr, scope: ScopeId) {
        let own = match state {
            Expr::Path(path) => path.path.get_ident(),
            _ => None,
        };
        let symbol = own.and_then(|name| self.scopes[scope].symbol(&name.to_string()));
        match symbol {
            Some(Symbol::Unknown(system, _)) => {
                self.solve_system(system);
            }
            Some(Symbol::Opaque(_)) => self.report.silent(),
            _ => self.report.help(
                state.span(),
                format!("`{}` is no state of this module", source_text(state)),
                "a `state` is settled where it is declared; a coordinate is held by `simplify hinge == 0.0;`",
            ),
        }
    }

    /// What the report says of states that follow from their equations.
    pub(in crate::model) fn settled_states(&self) -> Vec<String> {
        let is_settled = |system: &&System<'_>| system.equations.iter().any(|e| matches!(e, Equation::Settled(_)));
        let names = self.systems.iter().filter(is_settled).flat_map(|system| &system.unknowns);
        names
            .map(|name| format!("state `{name}`: its rate is taken as zero, so it follows from its equation"))
            .collect()
    }

    /// `small(hinge)`: coordinates of the tree, each once, since each has one term of first order.
    pub(in crate::model) fn small(
        &mut self,
        expr: &Expr,
        context: Context<'a>,
        joints: Option<(&Topology, &Joints)>,
        known: &[Coordinate],
    ) -> Vec<Coordinate> {
        let found = self.several_coordinates(expr, context).unwrap_or_default();
        let mut small = Vec::new();
        for (coordinate, at) in found {
            if known.contains(&coordinate) || small.contains(&coordinate) {
                self.report.error(at, "this coordinate is named twice");
                continue;
            }
            if let Some((topology, list)) = joints
                && topology.is_cut(coordinate.joint)
            {
                self.refuse_cut_coordinate(coordinate.joint, at, list);
                continue;
            }
            if self.joint_kind(coordinate.joint).is_some_and(|kind| kind.has_quaternion()) {
                self.report.help(
                    at,
                    "a rotation by a quaternion has no small angles",
                    "write `coordinates: RollPitchYaw` on the joint",
                );
                continue;
            }
            small.push(coordinate);
        }
        small
    }
}
