//! Stage `emit`: a method of `Model` that is too long for one function.
//!
//! In: a function of many operations. Out: the body of its method, which calls one function after the other, and these functions.
//! They take what the method takes, and an array of what they have computed for each other ([`parts`]).

use std::collections::BTreeSet;

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use crate::contracts::function::Arguments;
use crate::emit::layout::places::{RESERVED, Root};
use crate::emit::print::blocks::{Live, live_statements, some};
use crate::emit::print::expressions::Names;
use crate::emit::print::parts::{self, Part, Parts};
use crate::emit::{Context, names};
use crate::invariant::fault::OrFault;
use crate::optimize::program::{Expression, Function, Program, Size};

use super::{functions, results};

/// The array of what is kept.
const KEPT: &str = "kept";

/// Expands to `let mut kept = ..; self.bias_part_1(q, v, &mut kept); ..`, and to the functions that are called. `named` are the
/// variables that the method's arguments are named after.
pub(super) fn method(context: &Context<'_>, function: &Function, named: &BTreeSet<Root>) -> (TokenStream, TokenStream) {
    let layout = &context.layout;
    let program = parts::with_results_first(function.program.clone());
    let live = live_statements(&program);
    let cut = Parts::new(&program, &live, context.part);
    let reserved: Vec<&str> = RESERVED.iter().copied().chain([KEPT]).collect();
    let locals = names::unique(program.locals.iter().map(String::as_str), &reserved);
    let (fields, commented) = (&context.fields, context.commented);
    let names = Names { layout, locals: &locals, fields, stored: None, commented, packed: None };
    let read = functions::roots(&program);
    let arguments = Arguments::of(function.kind, &read).read(&read);
    let writing = Writing { program: &program, live: &live, names: &names, arguments, places: cut.places };

    let stem = stem(context, function);
    let called: Vec<Ident> = (1..=cut.list.len()).map(|number| names::ident(&format!("{stem}_{number}"))).collect();
    let whole = functions::name(layout.model, function.kind);
    let functions = cut.list.iter().zip(&called).enumerate().map(|(number, (part, name))| {
        let docs = format!("Part {} of {} of `{whole}`.", number + 1, called.len());
        let function = writing.function(part, name);
        quote!(#[doc = #docs] #function)
    });
    let functions = quote!(#(#functions)*);

    let kept = names::ident(KEPT);
    let places = Literal::usize_unsuffixed(cut.places);
    let passed = arguments.handed_on(layout, named);
    let opened = arguments.open(&in_results(&program));
    let values = program.results.iter().map(|result| handed_on(result, &names, &cut)).collect();
    let value = results::value(layout, function.kind, values);
    let calls = called.iter().map(|name| quote!(self.#name(#(#passed,)* &mut #kept);));
    let block = quote! {
        let mut #kept = [T::lit(0.0); #places];
        #(#calls)*
        #opened
        #value
    };
    (block, functions)
}

/// Expands to `kept[3]`, `-kept[3]`, or to what no part has computed: read where it goes, since thousands of names for what is
/// kept would cost rustc more than a part does.
fn handed_on(result: &Expression, names: &Names<'_>, cut: &Parts) -> TokenStream {
    match result {
        Expression::Local(local) => {
            let place = cut.results.get(local).or_fault("results are kept to the end");
            let (kept, place) = (names::ident(KEPT), Literal::usize_unsuffixed(*place));
            quote!(#kept[#place])
        }
        Expression::Neg(inner) => {
            let inner = handed_on(inner, names, cut);
            quote!(-#inner)
        }
        other => names.expression(other),
    }
}

/// What the names of parts begin with; no other function's does.
fn stem(context: &Context<'_>, function: &Function) -> String {
    let model = context.layout.model;
    let mut stem = format!("{}_part", functions::name(model, function.kind));
    let all = || context.compiled.functions.iter().map(|other| functions::name(model, other.kind));
    while all().any(|name| name.starts_with(&stem)) {
        stem.push_str("_of");
    }
    stem
}

/// The variables that results read themselves.
fn in_results(program: &Program) -> BTreeSet<Root> {
    functions::roots(&Program { results: program.results.clone(), ..Program::default() })
}

/// What all parts of a function have in common.
struct Writing<'a> {
    program: &'a Program,
    live: &'a [Live<'a>],
    names: &'a Names<'a>,
    arguments: Arguments,
    places: usize,
}

impl Writing<'_> {
    /// Expands to `fn bias_part_2(&self, q: &Position<T>, kept: &mut [T; 40]) { let [a, b] = [kept[3], kept[7]]; ..; kept[5] = c; }`.
    fn function(&self, part: &Part, name: &Ident) -> TokenStream {
        let (layout, locals) = (self.names.layout, self.names.locals);
        let live = &self.live[part.from..part.to];
        let mut read = BTreeSet::new();
        for expression in live.iter().flat_map(Live::expressions) {
            expression.each_leaf(&mut |leaf| {
                if let Expression::Symbol(symbol) = leaf {
                    read.extend(Root::of(*symbol));
                }
            });
        }
        let declared = self.arguments.declare(layout, &read);
        let opened = self.arguments.open(&read);
        let kept = names::ident(KEPT);
        let place = |place: usize| Literal::usize_unsuffixed(place);
        let scalars = part.reads.iter().filter_map(|read| match (read.size, &read.places[..]) {
            (None, &[at]) => Some((&locals[read.local.0], place(at))),
            _ => None,
        });
        let (scalars, at): (Vec<&Ident>, Vec<Literal>) = scalars.unzip();
        let taken = (!scalars.is_empty()).then(|| quote!(let [#(#scalars),*] = [#(#kept[#at]),*];));
        let packs = part.reads.iter().filter_map(|read| {
            let (name, places) = (&locals[read.local.0], read.places.iter().map(|&at| place(at)));
            let of = names::ident(match read.size? {
                Size::Two => "two",
                Size::Four => "four",
            });
            Some(quote!(let #name = T::#of([#(#kept[#places]),*]);))
        });
        let statements = some(self.program, self.names, live, part.writes.iter().map(|write| write.local));
        let written = part.writes.iter().map(|write| {
            let (name, places) = (&locals[write.local.0], write.places.iter().map(|&at| place(at)));
            match write.size {
                Some(_) => quote!([#(#kept[#places]),*] = T::members(#name);),
                None => quote!(#(#kept[#places])* = #name;),
            }
        });
        let places = place(self.places);
        quote! {
            #[inline(never)]
            fn #name(&self, #declared, #kept: &mut [T; #places]) {
                #opened
                #taken
                #(#packs)*
                #statements
                #(#written)*
            }
        }
    }
}
