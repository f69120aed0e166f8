//! Stage `emit`: statements, grouped into blocks.
//!
//! In: a program. Out: `let` statements. Every `let` opens a debug scope, and some thousands in a row overflow rustc's
//! stack; more than [`MOST`] are therefore grouped into blocks that return their live values as a tuple,
//! `let (a, b) = { ..; (a, b) };`, and very many into blocks of blocks. Blocks begin where a paragraph does: statements in a
//! row that were derived under one heading. Values that nothing reads are left out.

use std::sync::Arc;

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use crate::emit::layout::leaf;
use crate::emit::names;
use crate::optimize::program::{Expression, Local, Program, Sine, Size, Statement};

use super::expressions::Names;

/// As many statements may stand in a row.
const MOST: usize = 256;
/// As many stand in a block, about.
const BLOCK: usize = 128;

/// Fewer statements in a row are no paragraph of their own: they go on with the one before.
const LEAST: usize = 3;

/// A function's statements and results.
pub(in crate::emit) struct Body {
    pub(in crate::emit) statements: TokenStream,
    /// One per result of the program.
    pub(in crate::emit) results: Vec<TokenStream>,
}

/// Expands to a program's statements.
pub(in crate::emit) fn body(program: &Program, names: &Names<'_>) -> Body {
    let mut live = live_statements(program);
    let mut read: Vec<&Expression> = program.results.iter().collect();
    // `let a = x + y; a` says less than `x + y`.
    if let (Some((Live { statement: Statement::Let { local, value }, .. }, rest)), [Expression::Local(result)]) =
        (live.split_last(), &program.results[..])
        && local == result
        && rest.len() < MOST
    {
        read = vec![value];
        live.pop();
    }
    let results = read.iter().map(|result| names.expression(result)).collect();
    let statements = Blocks::new(names, &live, &program.headings, &read).all();
    Body { statements, results }
}

/// `, &[0, 0, 2]`, the last argument of a function that compares equations in groups; nothing where each stands for itself.
pub(in crate::emit) fn groups_argument(groups: &[usize]) -> Option<TokenStream> {
    let numbers = groups.iter().map(|&group| Literal::usize_unsuffixed(group));
    (!groups.is_empty()).then(|| quote!(, &[#(#numbers),*]))
}

/// Expands to some of a program's live statements; `after` is what is read behind them.
pub(in crate::emit) fn some(
    program: &Program,
    names: &Names<'_>,
    live: &[Live<'_>],
    after: impl Iterator<Item = Local>,
) -> TokenStream {
    let after: Vec<Expression> = after.map(Expression::Local).collect();
    let after: Vec<&Expression> = after.iter().collect();
    Blocks::new(names, live, &program.headings, &after).all()
}

/// Statements that something reads.
pub(in crate::emit) fn live_statements(program: &Program) -> Vec<Live<'_>> {
    let mut read = vec![false; program.locals.len()];
    for result in &program.results {
        result.each_local(&mut |local| set(&mut read, local, true));
    }
    live(&program.statements, &mut read)
}

/// A statement that something reads, and what lives inside it.
pub(in crate::emit) struct Live<'a> {
    pub(super) statement: &'a Statement,
    body: Vec<Live<'a>>,
    /// Of several sines those that are read.
    sines: Vec<&'a Sine>,
    /// Unknowns of an iteration that are read, by number.
    unknowns: Vec<usize>,
    /// Whether its residual is.
    residual: bool,
}

/// Those that are read; what they read is marked.
fn live<'a>(statements: &'a [Statement], read: &mut Vec<bool>) -> Vec<Live<'a>> {
    let mut found = Vec::new();
    for statement in statements.iter().rev() {
        if !statement.defined().iter().any(|&local| get(read, local)) {
            continue;
        }
        let mark = |expression: &Expression, read: &mut Vec<bool>| {
            expression.each_local(&mut |local| set(read, local, true));
        };
        let mut entry = Live { statement, body: Vec::new(), sines: Vec::new(), unknowns: Vec::new(), residual: false };
        if let Statement::Iterate { unknowns, start, body, next, residual, .. } = statement {
            entry.residual = get(read, residual.0);
            if entry.residual {
                mark(&residual.1, read);
            }
            // A round reads what the one before has left: again until nothing more is read.
            loop {
                let now: Vec<usize> = (0..unknowns.len()).filter(|&k| get(read, unknowns[k])).collect();
                now.iter().for_each(|&k| mark(&next[k], read));
                entry.body = live(body, read);
                let more = (0..unknowns.len()).any(|k| get(read, unknowns[k]) && !now.contains(&k));
                if !more {
                    entry.unknowns = now;
                    break;
                }
            }
            entry.unknowns.iter().for_each(|&k| mark(&start[k], read));
        } else if let Statement::SinCos(sines) = statement {
            let is_read = |sine: &&Sine| sine.defined().iter().any(|&local| get(read, local));
            entry.sines = sines.iter().filter(is_read).collect();
            entry.sines.iter().for_each(|sine| mark(&sine.angle, read));
        } else {
            statement.expressions().for_each(|expression| mark(expression, read));
        }
        found.push(entry);
    }
    found.reverse();
    found
}

impl Live<'_> {
    /// What it reads, inside too.
    pub(in crate::emit) fn expressions(&self) -> Vec<&Expression> {
        match self.statement {
            Statement::Iterate { start, next, residual, .. } => {
                let each = self.unknowns.iter().flat_map(|&k| [&start[k], &next[k]]);
                let residual = self.residual.then_some(&residual.1);
                each.chain(residual).chain(self.body.iter().flat_map(Live::expressions)).collect()
            }
            Statement::SinCos(_) => self.sines.iter().map(|sine| &sine.angle).collect(),
            statement => statement.expressions().collect(),
        }
    }

    /// What later statements may read.
    pub(super) fn defined(&self) -> Vec<Local> {
        match self.statement {
            Statement::Iterate { unknowns, residual, .. } => {
                let residual = self.residual.then_some(residual.0);
                self.unknowns.iter().map(|&k| unknowns[k]).chain(residual).collect()
            }
            Statement::SinCos(_) => self.sines.iter().flat_map(|sine| sine.defined()).collect(),
            statement => statement.defined(),
        }
    }

    /// Visits what its body defines for itself.
    pub(super) fn inside(&self, visit: &mut dyn FnMut(Local)) {
        for live in &self.body {
            live.defined().into_iter().for_each(&mut *visit);
            live.inside(visit);
        }
    }
}

struct Blocks<'a> {
    names: &'a Names<'a>,
    live: &'a [Live<'a>],
    headings: &'a [Option<Arc<str>>],
    /// For each local, the number of the last live statement that reads it; what follows them counts as one more.
    last_use: Vec<Option<usize>>,
    /// Where paragraphs begin, with their headings.
    paragraphs: Vec<(usize, &'a str)>,
}

impl<'a> Blocks<'a> {
    /// `after` is what is read behind the statements.
    fn new(
        names: &'a Names<'a>,
        live: &'a [Live<'a>],
        headings: &'a [Option<Arc<str>>],
        after: &[&Expression],
    ) -> Self {
        let mut last_use = vec![None; names.locals.len()];
        for (number, statement) in live.iter().enumerate() {
            for expression in statement.expressions() {
                expression.each_local(&mut |local| set(&mut last_use, local, Some(number)));
            }
        }
        for expression in after {
            expression.each_local(&mut |local| set(&mut last_use, local, Some(live.len())));
        }
        Blocks { names, live, last_use, headings, paragraphs: paragraphs(live, headings) }
    }

    fn all(&self) -> TokenStream {
        let mut out = TokenStream::new();
        self.print(0, self.live.len(), &mut out);
        out
    }

    /// Statements `start..end`.
    fn print(&self, start: usize, end: usize, out: &mut TokenStream) {
        let count = end - start;
        if count <= MOST {
            for (number, live) in self.live.iter().enumerate().skip(start).take(count) {
                let heading = self.paragraphs.iter().find(|(begin, _)| *begin == number);
                if let Some((_, heading)) = heading.filter(|_| self.names.commented) {
                    let text = format!("// {heading}");
                    out.extend(quote!(#[doc = #text]));
                }
                out.extend(self.statement(live));
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
            let (from, to) = (self.cut(start + part * count / parts), self.cut(start + (part + 1) * count / parts));
            let (from, to) = (from.max(start), if part + 1 == parts { end } else { to.min(end) });
            let from = if part == 0 { start } else { from };
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

    /// The nearest beginning of a paragraph, if one is near.
    fn cut(&self, at: usize) -> usize {
        let begins = self.paragraphs.iter().map(|(begin, _)| *begin);
        begins.min_by_key(|begin| begin.abs_diff(at)).filter(|begin| begin.abs_diff(at) <= BLOCK / 4).unwrap_or(at)
    }

    /// Locals that statements `from..to` define and later ones read.
    fn leaving(&self, from: usize, to: usize) -> impl Iterator<Item = &Ident> {
        let inside = self.live.iter().skip(from).take(to - from);
        inside
            .flat_map(Live::defined)
            .filter(move |local| self.last_use(*local).is_some_and(|last| last >= to))
            .map(|local| &self.names.locals[local.0])
    }

    fn last_use(&self, local: Local) -> Option<usize> {
        self.last_use[local.0]
    }

    fn name(&self, local: Local) -> TokenStream {
        let name = &self.names.locals[local.0];
        if self.last_use(local).is_some() { quote!(#name) } else { quote!(_) }
    }

    /// Names in expressions on packs.
    fn packed(&self, size: Size) -> Names<'a> {
        Names { packed: Some(size), ..*self.names }
    }

    /// Expands to `let a = ..;`, sines, packs, a solve or a loop.
    fn statement(&self, live: &Live<'_>) -> TokenStream {
        match live.statement {
            Statement::Let { local, value } => {
                let (name, value) = (self.name(*local), self.names.expression(value));
                quote!(let #name = #value;)
            }
            Statement::Pack { size, local, value } => {
                let (name, value) = (self.name(*local), self.packed(*size).expression(value));
                quote!(let #name = #value;)
            }
            Statement::PackSines(size, sine) => {
                let [sin, cos] = sine.defined().map(|local| self.name(local));
                let angle = self.packed(*size).expression(&sine.angle);
                quote!(let (#sin, #cos) = T::sines(#angle);)
            }
            Statement::Members { size, pack, members } => {
                let members = members.iter().take(size.members());
                let names = members.map(|local| local.map_or(quote!(_), |local| self.name(local)));
                let pack = self.packed(*size).expression(pack);
                quote!(let [#(#names),*] = T::members(#pack);)
            }
            Statement::SinCos(_) => self.sines(&live.sines),
            Statement::Called { function, arguments, value, slopes } => {
                let call = self.names.external(*function);
                let arguments = arguments.iter().map(|argument| leaf::element(self.names.expression(argument)));
                let slopes = slopes.iter().map(|&local| self.name(local));
                match self.last_use(*value) {
                    Some(_) => {
                        let value = self.name(*value);
                        quote!(let (#value, [#(#slopes),*]) = #call::value_and_slopes([#(#arguments),*]);)
                    }
                    None => quote!(let [#(#slopes),*] = #call::slopes([#(#arguments),*]);),
                }
            }
            Statement::Solve { size, symmetric, groups, matrix, rhs, measures, results } => {
                let sides = [&rhs[..], &measures[..]];
                self.solve(*size, (*symmetric, groups), matrix, sides, results)
            }
            Statement::Iterate { count, unknowns, start, next, residual, .. } => {
                let locals: Vec<Local> = live.unknowns.iter().map(|&k| unknowns[k]).collect();
                let (start, next) = [start, next].map(|list| live.unknowns.iter().map(|&k| &list[k]).collect()).into();
                let residual = live.residual.then_some(residual);
                self.iterate(*count, &locals, start, next, residual, &live.body)
            }
        }
    }

    /// Expands to `let (sin_a, cos_a) = Real::sin_cos(a);`, or to `let [(sin_a, cos_a), (_, cos_b)] = Real::sin_cos_all([a, b]);`.
    fn sines(&self, sines: &[&Sine]) -> TokenStream {
        let pairs = sines.iter().map(|sine| {
            let [sin, cos] = sine.defined().map(|local| self.name(local));
            quote!((#sin, #cos))
        });
        let angles = sines.iter().map(|sine| self.names.expression(&sine.angle));
        if let [_] = sines {
            return quote!(let #(#pairs)* = Real::sin_cos(#(#angles)*););
        }
        let angles = angles.map(leaf::element);
        quote!(let [#(#pairs),*] = Real::sin_cos_all([#(#angles),*]);)
    }

    /// Expands to `let ([x, y], rank) = ::multibody::linear::solve([[..], [..]], [..]);`.
    fn solve(
        &self,
        size: usize,
        (symmetric, groups): (bool, &[usize]),
        matrix: &[Expression],
        [rhs, measures]: [&[Expression]; 2],
        results: &[Local],
    ) -> TokenStream {
        let krate = self.names.layout.krate();
        let each: Vec<usize> = (0..size).collect();
        let (function, groups) = match (symmetric, measures, groups) {
            (false, ..) => ("solve", groups),
            (true, [], []) => ("solve_symmetric", groups),
            (true, [], _) => ("solve_symmetric_in_groups", groups),
            (true, _, []) => ("solve_symmetric_measured", &each[..]),
            (true, ..) => ("solve_symmetric_measured", groups),
        };
        let function = names::ident(function);
        let groups = groups_argument(groups);
        let list = |list: &[Expression]| {
            let list = list.iter().map(|e| leaf::element(self.names.expression(e)));
            quote!([#(#list),*])
        };
        let rows = matrix.chunks(size.max(1)).map(list);
        let rhs = list(rhs);
        let measures = (!measures.is_empty()).then(|| list(measures)).map(|list| quote!(, #list));
        let names: Vec<TokenStream> = results.iter().map(|&local| self.name(local)).collect();
        let (unknowns, rank) = names.split_at(size.min(names.len()));
        quote!(let ([#(#unknowns),*], #(#rank)*) = #krate::linear::#function([#(#rows),*], #rhs #measures #groups);)
    }

    /// Expands to a counted loop; all unknowns change at once.
    fn iterate(
        &self,
        count: usize,
        locals: &[Local],
        start: Vec<&Expression>,
        next: Vec<&Expression>,
        residual: Option<&(Local, Expression)>,
        body: &[Live<'_>],
    ) -> TokenStream {
        let names: Vec<&Ident> = locals.iter().map(|local| &self.names.locals[local.0]).collect();
        let start = start.into_iter().map(|e| self.names.expression(e));
        let mut after = next.clone();
        let mut out = quote!(#(let mut #names = #start;)*);
        let next: Vec<TokenStream> = next.into_iter().map(|e| self.names.expression(e)).collect();
        let mut last = TokenStream::new();
        if let Some((local, value)) = residual {
            let name = &self.names.locals[local.0];
            after.push(value);
            let value = self.names.expression(value);
            out.extend(quote!(let mut #name = T::lit(0.0);));
            last.extend(quote!(#name = #value;));
        }
        match (&names[..], &next[..]) {
            ([], _) => {}
            // By a tuple too: `x = x + step` alone is asked to be `x += step` in the user's crate.
            ([name], [next]) => last.extend(quote!((#name,) = (#next,);)),
            _ => last.extend(quote!((#(#names),*) = (#(#next),*);)),
        }
        let body = Blocks::new(self.names, body, self.headings, &after).all();
        let count = Literal::usize_unsuffixed(count);
        out.extend(quote!(for _ in 0..#count { #body #last }));
        out
    }
}

/// Statements in a row under one heading.
fn paragraphs<'a>(live: &[Live<'_>], headings: &'a [Option<Arc<str>>]) -> Vec<(usize, &'a str)> {
    let heading = |live: &Live<'_>| {
        let first = live.defined().first().copied()?;
        headings.get(first.0)?.as_deref()
    };
    let mut found: Vec<(usize, &str)> = Vec::new();
    for (number, statement) in live.iter().enumerate() {
        let Some(heading) = heading(statement) else { continue };
        match found.last() {
            Some((_, last)) if *last == heading => {}
            // A few go on with what comes after them if nothing is before.
            Some((begin, _)) if number - begin < LEAST && found.len() == 1 => found[0].1 = heading,
            Some((begin, _)) if number - begin < LEAST => {
                found.pop();
                if found.last().is_none_or(|(_, last)| *last != heading) {
                    found.push((number, heading));
                }
            }
            _ => found.push((number, heading)),
        }
    }
    found
}

fn get(list: &[bool], local: Local) -> bool {
    list[local.0]
}

fn set<V>(list: &mut [V], local: Local, value: V) {
    list[local.0] = value;
}

/// Every leaf of a program's live and dead expressions.
pub(in crate::emit) fn each_leaf_of(program: &Program, visit: &mut dyn FnMut(&Expression)) {
    program.expressions().for_each(|expression| expression.each_leaf(visit));
}
