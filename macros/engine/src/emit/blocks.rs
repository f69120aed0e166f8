//! Stage `emit`: statements, grouped into blocks (law 11).
//!
//! In: a program. Out: `let` statements. Every `let` opens a debug scope, and some thousands in a row overflow rustc's
//! stack; more than [`MOST`] are therefore grouped into blocks that return their live values as a tuple,
//! `let (a, b) = { ..; (a, b) };`, and very many into blocks of blocks. Values that nothing reads are left out.

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::expressions::Names;
use crate::optimize::program::{Expression, Local, Program, Statement};

/// As many statements may stand in a row.
const MOST: usize = 256;
/// As many stand in a block, about.
const BLOCK: usize = 128;

/// A function's statements and results.
pub(super) struct Body {
    pub(super) statements: TokenStream,
    /// One per result of the program.
    pub(super) results: Vec<TokenStream>,
}

/// Expands to a program's statements.
pub(super) fn body(program: &Program, names: &Names<'_>) -> Body {
    let mut blocks = Blocks::new(program, names);
    let mut results: Vec<TokenStream> = Vec::new();
    match (blocks.live.split_last(), &program.results[..]) {
        // `let a = x + y; a` says less than `x + y`.
        (Some((Statement::Let { local, value }, rest)), [Expression::Local(result)])
            if local == result && rest.len() < MOST =>
        {
            results.push(names.expression(value));
            blocks.live.pop();
        }
        _ => results.extend(program.results.iter().map(|r| names.expression(r))),
    }
    let mut statements = TokenStream::new();
    blocks.print(0, blocks.live.len(), &mut statements);
    Body { statements, results }
}

struct Blocks<'a> {
    names: &'a Names<'a>,
    /// Statements that something reads.
    live: Vec<&'a Statement>,
    /// For each local, the number of the last live statement that reads it; results count as one more.
    last_use: Vec<Option<usize>>,
}

impl<'a> Blocks<'a> {
    fn new(program: &'a Program, names: &'a Names<'a>) -> Self {
        let mut read = vec![false; program.locals.len()];
        for result in &program.results {
            each_local(result, &mut |local| set(&mut read, local, true));
        }
        let mut live = Vec::new();
        for statement in program.statements.iter().rev() {
            let is_read = |local: &Local| read.get(local.0).copied().unwrap_or(false);
            if defined(statement).any(|local| is_read(&local)) {
                each_local(value(statement), &mut |local| set(&mut read, local, true));
                live.push(statement);
            }
        }
        live.reverse();

        let mut last_use = vec![None; program.locals.len()];
        for (number, statement) in live.iter().enumerate() {
            each_local(value(statement), &mut |local| {
                set(&mut last_use, local, Some(number));
            });
        }
        for result in &program.results {
            each_local(result, &mut |local| {
                set(&mut last_use, local, Some(live.len()));
            });
        }
        Blocks { names, live, last_use }
    }

    /// Statements `start..end`.
    fn print(&self, start: usize, end: usize, out: &mut TokenStream) {
        let count = end - start;
        if count <= MOST {
            for statement in self.live.iter().skip(start).take(count) {
                out.extend(self.statement(statement));
            }
            return;
        }
        let mut size = BLOCK;
        while count > size * BLOCK {
            size *= BLOCK;
        }
        // Parts of equal size, so that the last one is no crumb.
        let parts = count.div_ceil(size);
        for part in 0..parts {
            let (from, to) = (start + part * count / parts, start + (part + 1) * count / parts);
            let mut inner = TokenStream::new();
            self.print(from, to, &mut inner);
            let values: Vec<&Ident> = self.leaving(from, to).collect();
            out.extend(quote! {
                let (#(#values,)*) = {
                    #inner
                    (#(#values,)*)
                };
            });
        }
    }

    /// Locals that statements `from..to` define and later ones read.
    fn leaving(&self, from: usize, to: usize) -> impl Iterator<Item = &Ident> {
        let inside = self.live.iter().skip(from).take(to - from);
        inside
            .flat_map(|statement| defined(statement))
            .filter(move |local| self.last_use(*local).is_some_and(|last| last >= to))
            .filter_map(|local| self.names.locals.get(local.0))
    }

    fn last_use(&self, local: Local) -> Option<usize> {
        self.last_use.get(local.0).copied().flatten()
    }

    /// Expands to `let a = ..;` or `let (sin_a, cos_a) = Real::sin_cos(..);`.
    fn statement(&self, statement: &Statement) -> TokenStream {
        let value = self.names.expression(value(statement));
        let name = |local: Local| match self.names.locals.get(local.0) {
            Some(name) if self.last_use(local).is_some() => quote!(#name),
            _ => quote!(_),
        };
        match statement {
            Statement::Let { local, .. } => {
                let name = name(*local);
                quote!(let #name = #value;)
            }
            Statement::SinCos { sin, cos, .. } => {
                let (sin, cos) = (name(*sin), name(*cos));
                quote!(let (#sin, #cos) = Real::sin_cos(#value);)
            }
        }
    }
}

fn value(statement: &Statement) -> &Expression {
    match statement {
        Statement::Let { value, .. } => value,
        Statement::SinCos { angle, .. } => angle,
    }
}

fn defined(statement: &Statement) -> impl Iterator<Item = Local> {
    let (first, second) = match statement {
        Statement::Let { local, .. } => (*local, None),
        Statement::SinCos { sin, cos, .. } => (*sin, Some(*cos)),
    };
    std::iter::once(first).chain(second)
}

fn set<V>(list: &mut [V], local: Local, value: V) {
    if let Some(place) = list.get_mut(local.0) {
        *place = value;
    }
}

fn each_local(expression: &Expression, visit: &mut dyn FnMut(Local)) {
    each_leaf(expression, &mut |leaf| {
        if let Expression::Local(local) = leaf {
            visit(*local);
        }
    });
}

/// Every literal, symbol, field and local of an expression.
pub(super) fn each_leaf(expression: &Expression, visit: &mut dyn FnMut(&Expression)) {
    match expression {
        Expression::Literal(_) | Expression::Symbol(_) | Expression::Field(_) | Expression::Local(_) => {
            visit(expression)
        }
        Expression::Neg(inner) => each_leaf(inner, visit),
        Expression::Sum(terms) => {
            for (_, term) in terms {
                each_leaf(term, visit);
            }
        }
        Expression::Product(list) | Expression::Call(_, list) => {
            for item in list {
                each_leaf(item, visit);
            }
        }
        Expression::Quotient(above, below) => {
            each_leaf(above, visit);
            each_leaf(below, visit);
        }
    }
}

/// Every leaf of a program's live and dead expressions.
pub(super) fn each_leaf_of(program: &Program, visit: &mut dyn FnMut(&Expression)) {
    for statement in &program.statements {
        each_leaf(value(statement), visit);
    }
    for result in &program.results {
        each_leaf(result, visit);
    }
}
