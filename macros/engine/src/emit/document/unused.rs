//! Stage `emit`: what of a model no generated function reads.
//!
//! In: programs. Out: names of parameters and inputs, between backticks. What cancels in the equations counts as not read, and
//! so does what the functions that were asked for don't need.

use std::collections::HashSet;

use crate::contracts::symbol::Symbol;
use crate::emit::Context;
use crate::emit::print::blocks::each_leaf_of;
use crate::mechanics::Inertia;
use crate::model::types::{Input, InputId, Param, ParamId};
use crate::optimize::program::{Expression, Program};

/// What no generated function reads.
pub struct Unused {
    /// With a word about those that `Params::check` reads.
    pub params: Vec<String>,
    pub inputs: Vec<String>,
}

impl Unused {
    pub(in crate::emit) fn new(context: &Context<'_>) -> Unused {
        Unused { params: params(context), inputs: inputs(context) }
    }
}

/// Symbols that programs read.
struct Read(HashSet<Symbol>);

impl Read {
    fn by<'p>(programs: impl Iterator<Item = &'p Program>) -> Read {
        let mut read = Read(HashSet::new());
        for program in programs {
            each_leaf_of(program, &mut |leaf| {
                if let Expression::Symbol(symbol) = leaf {
                    read.0.insert(*symbol);
                }
            });
        }
        read
    }

    /// Which of so many elements nothing reads, in words behind a name; nothing where all are read.
    fn missing(&self, name: &str, count: usize, symbol: impl Fn(usize) -> Symbol) -> Option<String> {
        let missing: Vec<usize> = (0..count).filter(|&element| !self.0.contains(&symbol(element))).collect();
        match missing.len() {
            0 => None,
            some if some == count => Some(format!("`{name}`")),
            _ => {
                let numbers: Vec<String> = missing.iter().map(ToString::to_string).collect();
                Some(format!("of the numbers of `{name}` (from 0 on) {}", numbers.join(", ")))
            }
        }
    }
}

/// Functions, what they read of parameters, and the matrix that the runtime looks at where accelerations are not finite.
fn programs<'c>(context: &'c Context<'_>) -> impl Iterator<Item = &'c Program> {
    let compiled = context.compiled;
    let inertia = match &compiled.inertia {
        Inertia::Own(program) => Some(program),
        Inertia::Regular | Inertia::Requested => None,
    };
    compiled.functions.iter().map(|function| &function.program).chain([&compiled.prelude]).chain(inertia)
}

fn params(context: &Context<'_>) -> Vec<String> {
    let layout = &context.layout;
    let read = Read::by(programs(context));
    let checked = Read::by(std::iter::once(&context.compiled.checks.program));
    let one = |(number, param): (usize, &Param)| {
        let symbol = |element| Symbol::Param { param: ParamId(number), element };
        let count = param.ty.scalars();
        let missing = read.missing(&layout.name(&param.place), count, symbol)?;
        let is_checked = (0..count).any(|element| checked.0.contains(&symbol(element)));
        Some(if is_checked { format!("{missing}: `Params::check` alone reads it") } else { missing })
    };
    layout.model.params.iter().enumerate().filter_map(one).collect()
}

fn inputs(context: &Context<'_>) -> Vec<String> {
    let layout = &context.layout;
    let model = layout.model;
    let read = Read::by(programs(context));
    // An input that inverse dynamics finds is a result.
    let found = |number: usize| model.solve_for.iter().any(|solved| solved.input == InputId(number));
    let inputs = model.inputs.iter().enumerate().filter(|(number, _)| !found(*number));
    let one = |(number, input): (usize, &Input)| {
        let symbol = |element| Symbol::Input { input: InputId(number), element };
        read.missing(&layout.name(&input.place), input.ty.scalars(), symbol)
    };
    inputs.filter_map(one).collect()
}
