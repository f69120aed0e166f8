//! Stage `model`: unknowns of equations of the user's own.
//!
//! In: a system of equations, two sides each. Out: its solution, as expressions. Equations that are linear in their unknowns
//! are taken apart by putting numbers in: what an equation is with all unknowns zero, and with one of them one, gives the
//! right-hand side and a column of the matrix. Unknowns that share no equation are solved apart. One equation in one unknown
//! that is of second degree, or linear in its cosine and sine, has two solutions, from which conditions choose: where none or
//! both satisfy them there is none. Its coefficients are found by putting numbers in too; its solutions stand in
//! [`crate::solve`].

use std::collections::HashMap;
use std::rc::Rc;

use proc_macro2::{Ident, Span};

use crate::model::checker::{Checker, Context, Equation, Lazy, SystemId};
use crate::model::expand::root;
use crate::model::typed::{Allowed, Class, Typed, Uses, new_expr, number};
use crate::model::types::{Expr, ExprNode, Function, TwoRoots, Type};

use super::span;

/// Most unknowns of one system.
const MOST_UNKNOWNS: usize = 40;

impl<'a> Checker<'a, '_> {
    /// What an unknown stands for: the solution, or inside its own equations a leaf.
    pub(super) fn unknown(&mut self, id: SystemId, place: usize, site: &Ident) -> Option<Typed> {
        let system = &self.systems[id];
        match &system.state {
            Lazy::Working => {
                let leaf = ExprNode::Unknown(system.first + place);
                let uses = Uses::of(Class::Finished, site.to_string(), site.span());
                Some(Typed::leaf(leaf, Type::Scalar, site.span()).with(uses))
            }
            Lazy::Done(values) => values.as_ref().map(|values| values[place].clone().at(site.span())),
            Lazy::Waiting => {
                self.solve_system(id);
                let values = match &self.systems[id].state {
                    Lazy::Done(Some(values)) => Rc::clone(values),
                    _ => return None,
                };
                Some(values[place].clone().at(site.span()))
            }
        }
    }

    /// Solves a system when it is first asked for.
    pub(in crate::model) fn solve_system(&mut self, id: SystemId) -> Option<()> {
        let system = &mut self.systems[id];
        match system.state {
            Lazy::Waiting => system.state = Lazy::Working,
            _ => return Some(()),
        }
        let known = self.opened.len();
        let found = self.solution(id);
        self.systems[id].state = Lazy::Done(found.map(Rc::from));
        for named in self.opened.split_off(known) {
            self.named[named].state = Lazy::Waiting;
        }
        Some(())
    }

    /// Whether an expression reads an unknown of equations that are being solved.
    pub(in crate::model) fn holds_unknown(&self, expr: &Expr) -> bool {
        let open = self.systems.iter().any(|system| matches!(system.state, Lazy::Working));
        open && any(expr, &mut |node| matches!(node, ExprNode::Unknown(_)))
    }

    fn solution(&mut self, id: SystemId) -> Option<Vec<Typed>> {
        let system = &self.systems[id];
        let (first, count, at, context) = (system.first, system.unknowns.len(), system.span, root(system.scope));
        let (equations, branches) = (system.equations.clone(), system.branches);
        let names: Vec<String> = system.unknowns.iter().map(ToString::to_string).collect();
        let gaps: Vec<Option<Typed>> = equations.iter().map(|equation| self.gap(*equation, context)).collect();
        let gaps: Vec<Typed> = gaps.into_iter().collect::<Option<_>>()?;
        if gaps.len() != count || count > MOST_UNKNOWNS {
            let plural = |n: usize| if n == 1 { "" } else { "s" };
            let message = if count > MOST_UNKNOWNS {
                format!("more than {MOST_UNKNOWNS} unknowns can't be solved for")
            } else {
                format!("{count} unknown{} but {} equation{}", plural(count), gaps.len(), plural(gaps.len()))
            };
            self.report.error(at, message);
            return None;
        }
        let mut algebra = Algebra { first, count, degrees: HashMap::new() };
        let degrees: Vec<u8> = gaps.iter().map(|gap| algebra.degree(&gap.expr)).collect();
        let form = match (&gaps[..], &degrees[..]) {
            (_, [2]) => Some(TwoRoots::Quadratic),
            ([gap], [OTHER]) if algebra.circular(&gap.expr, &mut HashMap::new()) == Circular::Linear => {
                Some(TwoRoots::Circular)
            }
            _ => None,
        };
        for (gap, degree) in gaps.iter().zip(&degrees) {
            if algebra.holds_others(&gap.expr) {
                let message = format!("{} is found from what is found from it", list(&names));
                self.report.help(
                    gap.expr.span,
                    message,
                    "write one `solve` with all unknowns and equations of the circle",
                );
                return None;
            }
            let message = match degree {
                0 => format!("this equation holds none of {}", list(&names)),
                1 => continue,
                _ if form.is_some() => continue,
                2 => format!("this equation is of second degree in {}", list(&names)),
                _ => format!("{} can't be taken out of this equation", list(&names)),
            };
            self.report.help(
                gap.expr.span,
                message,
                "equations are linear in their unknowns, or there is one, of second degree, such as `x * x`, or as \
                 `a * cos(x) + b * sin(x)`",
            );
            return None;
        }
        if let Some(form) = form {
            return self.one_of_two(form, &gaps[0], &mut algebra, branches, context, &names[0]).map(|root| vec![root]);
        }
        let mut solved = self.linear(&gaps, &mut algebra, at, &names)?;
        for condition in branches {
            // One solution needs no choice; a condition that it breaks leaves none.
            let condition = self.condition(condition, &mut algebra, context)?;
            let values: Vec<Expr> = solved.iter().map(|value| value.expr.clone()).collect();
            let condition = algebra.put(&condition.expr, &|place| values[place].clone());
            for value in &mut solved {
                let node = ExprNode::Select(condition.clone(), value.expr.clone(), undefined(at));
                value.expr = new_expr(node, Type::Scalar, at);
                value.depth = value.depth.saturating_add(1);
            }
        }
        Some(solved)
    }

    /// A condition on a solution, in which solutions can be put.
    fn condition(&mut self, branch: &'a syn::Expr, algebra: &mut Algebra, context: Context<'a>) -> Option<Typed> {
        let condition = self.typed(branch, context, &Type::Bool, Allowed::Forces)?;
        if algebra.holds_others(&condition.expr) || !algebra.can_put(&condition.expr) {
            self.report.error(span(branch), "this condition can't choose a solution");
            return None;
        }
        Some(condition)
    }

    /// Left side less right side.
    fn gap(&mut self, equation: Equation<'a>, context: Context<'a>) -> Option<Typed> {
        match equation {
            Equation::Settled(rate) => self.scalar(rate, context, Allowed::Forces),
            Equation::Equal(left, right) => {
                let (a, b) =
                    (self.scalar(left, context, Allowed::Forces), self.scalar(right, context, Allowed::Forces));
                let (a, b) = (a?, b?);
                let at = span(left);
                self.build(ExprNode::Sub(a.expr.clone(), b.expr.clone()), Type::Scalar, at, &[&a, &b])
            }
        }
    }

    /// Unknowns that share equations, as systems of their own.
    fn linear(&mut self, gaps: &[Typed], algebra: &mut Algebra, at: Span, names: &[String]) -> Option<Vec<Typed>> {
        let count = gaps.len();
        let zero = |_: usize| number(0.0, at);
        let reads: Vec<Vec<bool>> =
            gaps.iter().map(|gap| (0..count).map(|place| algebra.reads(&gap.expr, place)).collect()).collect();
        let mut solved: Vec<Option<Typed>> = vec![None; count];
        for start in 0..count {
            if solved[start].is_some() {
                continue;
            }
            let (unknowns, rows) = connected(start, &reads);
            if unknowns.len() != rows.len() {
                let named: Vec<String> = unknowns.iter().map(|&k| names[k].clone()).collect();
                let message = format!("{} equations hold {}: they are not determined", rows.len(), list(&named));
                self.report.error(at, message);
                return None;
            }
            let rests: Vec<Expr> = rows.iter().map(|&row| algebra.put(&gaps[row].expr, &zero)).collect();
            let mut system = Vec::with_capacity(rows.len() * (rows.len() + 1));
            for (&row, rest) in rows.iter().zip(&rests) {
                for &unknown in &unknowns {
                    let unit = |place: usize| number(if place == unknown { 1.0 } else { 0.0 }, at);
                    let with = algebra.put(&gaps[row].expr, &unit);
                    system.push(new_expr(ExprNode::Sub(with, rest.clone()), Type::Scalar, at));
                }
            }
            system.extend(rests.into_iter().map(|rest| new_expr(ExprNode::Neg(rest), Type::Scalar, at)));
            let system: Rc<[Expr]> = system.into();
            let parts: Vec<&Typed> = rows.iter().map(|&row| &gaps[row]).collect();
            for (index, &unknown) in unknowns.iter().enumerate() {
                let node = ExprNode::Solved { system: Rc::clone(&system), size: rows.len(), index };
                let mut value = self.build(node, Type::Scalar, at, &parts)?;
                value.depth = value.depth.saturating_add(2);
                value.uses.add(Class::Finished, names[unknown].clone(), at);
                solved[unknown] = Some(value);
            }
        }
        solved.into_iter().collect()
    }

    /// An equation with two solutions, and conditions that hold for one of them.
    fn one_of_two(
        &mut self,
        form: TwoRoots,
        gap: &Typed,
        algebra: &mut Algebra,
        branches: &'a [syn::Expr],
        context: Context<'a>,
        name: &str,
    ) -> Option<Typed> {
        let at = gap.expr.span;
        if branches.is_empty() {
            let message = format!("two values of `{name}` satisfy this equation");
            let example = match form {
                TwoRoots::Quadratic => format!("{name} > 0.0"),
                TwoRoots::Circular => format!("cos({name}) > 0.0"),
            };
            self.report.help(at, message, format!("say which one: `solve ({name}) from .. {{ {example} }}`"));
            return None;
        }
        let coefficients = Rc::new(coefficients(form, &gap.expr, algebra));
        let solutions = [false, true].map(|second| {
            let node = ExprNode::OneOfTwo { form, coefficients: Rc::clone(&coefficients), second };
            new_expr(node, Type::Scalar, at)
        });
        let mut parts = vec![gap.clone()];
        let mut conditions = Vec::new();
        for branch in branches {
            let condition = self.condition(branch, algebra, context)?;
            conditions.push(condition.expr.clone());
            parts.push(condition);
        }
        let boolean = |node| new_expr(node, Type::Bool, at);
        let holds = solutions.each_ref().map(|solution| {
            let put = conditions.iter().map(|condition| algebra.put(condition, &|_| solution.clone()));
            put.reduce(|all, one| boolean(ExprNode::And(all, one)))
        });
        let [Some(first), Some(second)] = holds else { return None };
        let one = |this: Expr, other: Expr| boolean(ExprNode::And(this, boolean(ExprNode::Not(other))));
        let [plus, minus] = solutions;
        let rest = ExprNode::Select(one(second.clone(), first.clone()), minus, undefined(at));
        let rest = new_expr(rest, Type::Scalar, at);
        let node = ExprNode::Select(one(first, second), plus, rest);
        let parts: Vec<&Typed> = parts.iter().collect();
        let mut value = self.build(node, Type::Scalar, at, &parts)?;
        value.depth = value.depth.saturating_add(12);
        value.uses.add(Class::Finished, name, at);
        Some(value)
    }
}

/// Of an equation that is known to have a form: what it is at three values of its unknown.
fn coefficients(form: TwoRoots, gap: &Expr, algebra: &Algebra) -> [Expr; 3] {
    let at = gap.span;
    let scalar = |node| new_expr(node, Type::Scalar, at);
    let scaled = |factor: f64, of: ExprNode| scalar(ExprNode::Mul(number(factor, at), scalar(of)));
    let put = |x: &Expr| algebra.put(gap, &|_| x.clone());
    let pi = scalar(ExprNode::Pi);
    match form {
        TwoRoots::Quadratic => {
            let [none, plus, minus] = [0.0, 1.0, -1.0].map(|x| put(&number(x, at)));
            let mean = scaled(0.5, ExprNode::Add(plus.clone(), minus.clone()));
            let square = scalar(ExprNode::Sub(mean, none.clone()));
            [square, scaled(0.25, ExprNode::Sub(plus, minus)), none]
        }
        TwoRoots::Circular => {
            let (none, half) = (put(&number(0.0, at)), put(&pi));
            let quarter = put(&scalar(ExprNode::Mul(number(0.5, at), pi)));
            let mean = scaled(0.5, ExprNode::Add(none.clone(), half.clone()));
            let cosine = scaled(0.5, ExprNode::Sub(none, half));
            let sine = scalar(ExprNode::Sub(quarter, mean.clone()));
            [cosine, sine, scalar(ExprNode::Neg(mean))]
        }
    }
}

fn undefined(at: Span) -> Expr {
    new_expr(ExprNode::Undefined, Type::Scalar, at)
}

fn list(names: &[String]) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    quoted.join(", ")
}

/// Unknowns that hang together with one of them, and the equations that hold these.
fn connected(start: usize, reads: &[Vec<bool>]) -> (Vec<usize>, Vec<usize>) {
    let (mut unknowns, mut rows) = (vec![start], Vec::new());
    let mut next = 0;
    while let Some(&unknown) = unknowns.get(next) {
        next += 1;
        for (row, reads) in reads.iter().enumerate() {
            if reads[unknown] && !rows.contains(&row) {
                rows.push(row);
                let fresh = (0..reads.len()).filter(|&k| reads[k] && !unknowns.contains(&k));
                unknowns.extend(fresh.collect::<Vec<usize>>());
            }
        }
    }
    unknowns.sort_unstable();
    rows.sort_unstable();
    (unknowns, rows)
}

/// Expressions as polynomials of the unknowns of one system.
struct Algebra {
    first: usize,
    count: usize,
    degrees: HashMap<*const ExprNode, u8>,
}

/// More than a polynomial of second degree.
const OTHER: u8 = 3;

/// How an expression holds the one unknown of an equation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Circular {
    Free,
    /// Linear in its cosine and sine.
    Linear,
    Other,
}

impl Algebra {
    /// Which of the own unknowns a node is.
    fn place(&self, node: &ExprNode) -> Option<usize> {
        match node {
            ExprNode::Unknown(number) => number.checked_sub(self.first).filter(|place| *place < self.count),
            _ => None,
        }
    }

    /// Degree in all unknowns together.
    fn degree(&mut self, expr: &Expr) -> u8 {
        let key = Rc::as_ptr(&expr.node);
        if let Some(known) = self.degrees.get(&key) {
            return *known;
        }
        let degree = match &*expr.node {
            node if self.place(node).is_some() => 1,
            ExprNode::Neg(a) | ExprNode::Component(a, _) | ExprNode::Index(a, _) => self.degree(a),
            ExprNode::Add(a, b) | ExprNode::Sub(a, b) => self.degree(a).max(self.degree(b)),
            ExprNode::Vec3(parts) => self.most(parts),
            ExprNode::Array(parts) => self.most(parts),
            ExprNode::Mul(a, b) => (self.degree(a) + self.degree(b)).min(OTHER),
            ExprNode::Div(a, b) if self.degree(b) == 0 => self.degree(a),
            ExprNode::Call(Function::Dot | Function::Cross, parts) => {
                parts.iter().map(|part| self.degree(part)).sum::<u8>().min(OTHER)
            }
            ExprNode::Call(Function::Powi, parts) => match &parts[..] {
                [base, exponent] => match (self.degree(base), &*exponent.node) {
                    (0, _) => 0,
                    (degree, ExprNode::Number(power)) if *power == 1.0 => degree,
                    (1, ExprNode::Number(power)) if *power == 2.0 => 2,
                    _ => OTHER,
                },
                _ => OTHER,
            },
            ExprNode::Select(condition, a, b) if self.degree(condition) == 0 => self.degree(a).max(self.degree(b)),
            node => {
                let any = node.operands().into_iter().any(|part| self.degree(part) > 0);
                if any { OTHER } else { 0 }
            }
        };
        self.degrees.insert(key, degree);
        degree
    }

    /// Whether an expression is linear in the cosine and sine of the one unknown.
    fn circular(&mut self, expr: &Expr, known: &mut HashMap<*const ExprNode, Circular>) -> Circular {
        let key = Rc::as_ptr(&expr.node);
        if let Some(known) = known.get(&key) {
            return *known;
        }
        let free = |list: &[&Expr], algebra: &mut Algebra| list.iter().all(|part| algebra.degree(part) == 0);
        let found = match &*expr.node {
            _ if self.degree(expr) == 0 => Circular::Free,
            ExprNode::Call(Function::Sin | Function::Cos, parts) => {
                match parts.iter().map(|part| self.slope(part)).min() {
                    Some(Some(1 | -1)) => Circular::Linear,
                    _ => Circular::Other,
                }
            }
            ExprNode::Neg(a) | ExprNode::Component(a, _) | ExprNode::Index(a, _) => self.circular(a, known),
            ExprNode::Add(a, b) | ExprNode::Sub(a, b) => self.circular(a, known).max(self.circular(b, known)),
            ExprNode::Vec3(parts) => parts.iter().map(|part| self.circular(part, known)).fold(Circular::Free, Ord::max),
            ExprNode::Array(parts) => {
                parts.iter().map(|part| self.circular(part, known)).fold(Circular::Free, Ord::max)
            }
            ExprNode::Mul(a, b) if free(&[a], self) || free(&[b], self) => {
                self.circular(a, known).max(self.circular(b, known))
            }
            ExprNode::Div(a, b) if free(&[b], self) => self.circular(a, known),
            ExprNode::Call(Function::Dot | Function::Cross, parts) if parts.iter().any(|part| free(&[part], self)) => {
                parts.iter().map(|part| self.circular(part, known)).fold(Circular::Free, Ord::max)
            }
            ExprNode::Select(condition, a, b) if free(&[condition], self) => {
                self.circular(a, known).max(self.circular(b, known))
            }
            _ => Circular::Other,
        };
        known.insert(key, found);
        found
    }

    /// How often an angle holds the one unknown, where that is a whole number.
    fn slope(&mut self, angle: &Expr) -> Option<i32> {
        match &*angle.node {
            node if self.place(node).is_some() => Some(1),
            _ if self.degree(angle) == 0 => Some(0),
            ExprNode::Neg(a) => Some(-self.slope(a)?),
            ExprNode::Add(a, b) => Some(self.slope(a)? + self.slope(b)?),
            ExprNode::Sub(a, b) => Some(self.slope(a)? - self.slope(b)?),
            _ => None,
        }
    }

    fn most(&mut self, parts: &[Expr]) -> u8 {
        parts.iter().map(|part| self.degree(part)).max().unwrap_or(0)
    }

    fn reads(&self, expr: &Expr, place: usize) -> bool {
        any(expr, &mut |node| self.place(node) == Some(place))
    }

    /// Whether unknowns of another system are in an expression.
    fn holds_others(&self, expr: &Expr) -> bool {
        any(expr, &mut |node| matches!(node, ExprNode::Unknown(_)) && self.place(node).is_none())
    }

    /// Whether all nodes above an unknown can be made anew.
    fn can_put(&mut self, expr: &Expr) -> bool {
        if !any(expr, &mut |node| self.place(node).is_some()) || self.place(&expr.node).is_some() {
            return true;
        }
        is_plain(&expr.node) && expr.node.operands().into_iter().all(|part| self.can_put(part))
    }

    /// With others in the place of the unknowns.
    fn put(&self, expr: &Expr, value: &dyn Fn(usize) -> Expr) -> Expr {
        self.put_known(expr, value, &mut HashMap::new())
    }

    fn put_known(
        &self,
        expr: &Expr,
        value: &dyn Fn(usize) -> Expr,
        known: &mut HashMap<*const ExprNode, Expr>,
    ) -> Expr {
        if let Some(place) = self.place(&expr.node) {
            return value(place);
        }
        if let Some(made) = known.get(&Rc::as_ptr(&expr.node)) {
            return made.clone();
        }
        let holds = any(expr, &mut |node| self.place(node).is_some());
        let made = if holds { anew(expr, &mut |part| self.put_known(part, value, known)) } else { expr.clone() };
        known.insert(Rc::as_ptr(&expr.node), made.clone());
        made
    }
}

/// Whether a node of an expression, or below it, is of a kind.
fn any(expr: &Expr, is: &mut dyn FnMut(&ExprNode) -> bool) -> bool {
    let mut stack = vec![expr];
    let mut seen = std::collections::HashSet::new();
    while let Some(expr) = stack.pop() {
        if !seen.insert(Rc::as_ptr(&expr.node)) {
            continue;
        }
        if is(&expr.node) {
            return true;
        }
        stack.extend(expr.node.operands());
    }
    false
}

/// Whether [`anew`] makes a node of this kind.
fn is_plain(node: &ExprNode) -> bool {
    matches!(
        node,
        ExprNode::Neg(_)
            | ExprNode::Not(_)
            | ExprNode::Component(..)
            | ExprNode::Index(..)
            | ExprNode::Add(..)
            | ExprNode::Sub(..)
            | ExprNode::Mul(..)
            | ExprNode::Div(..)
            | ExprNode::And(..)
            | ExprNode::Or(..)
            | ExprNode::Compare(..)
            | ExprNode::Select(..)
            | ExprNode::Call(..)
            | ExprNode::Vec3(_)
            | ExprNode::Array(_)
    )
}

/// The same operation on other operands.
fn anew(expr: &Expr, f: &mut dyn FnMut(&Expr) -> Expr) -> Expr {
    let node = match &*expr.node {
        ExprNode::Neg(a) => ExprNode::Neg(f(a)),
        ExprNode::Not(a) => ExprNode::Not(f(a)),
        ExprNode::Component(a, k) => ExprNode::Component(f(a), *k),
        ExprNode::Index(a, k) => ExprNode::Index(f(a), *k),
        ExprNode::Add(a, b) => ExprNode::Add(f(a), f(b)),
        ExprNode::Sub(a, b) => ExprNode::Sub(f(a), f(b)),
        ExprNode::Mul(a, b) => ExprNode::Mul(f(a), f(b)),
        ExprNode::Div(a, b) => ExprNode::Div(f(a), f(b)),
        ExprNode::And(a, b) => ExprNode::And(f(a), f(b)),
        ExprNode::Or(a, b) => ExprNode::Or(f(a), f(b)),
        ExprNode::Compare(how, a, b) => ExprNode::Compare(*how, f(a), f(b)),
        ExprNode::Select(c, a, b) => ExprNode::Select(f(c), f(a), f(b)),
        ExprNode::Call(function, parts) => ExprNode::Call(*function, parts.iter().map(f).collect()),
        ExprNode::Vec3(parts) => ExprNode::Vec3([f(&parts[0]), f(&parts[1]), f(&parts[2])]),
        ExprNode::Array(parts) => ExprNode::Array(parts.iter().map(f).collect()),
        // Of no other kind an equation is a polynomial, or a condition may be.
        _ => return expr.clone(),
    };
    // A unit that was declared for the whole holds whatever is put in.
    Expr { unit: expr.unit.clone(), ..new_expr(node, expr.ty.clone(), expr.span) }
}
