//! What the emitted tokens say, by reading them again.

#![allow(dead_code, unreachable_pub)]

use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::model::types::Model;
use multibody_engine::optimize::program::{Compiled, Expression, Program, Statement};
use syn::{ImplItem, Item, ItemMod};

use crate::samples::{derived, emit, pendulum};

pub fn module(model: &Model, compiled: &Compiled) -> ItemMod {
    syn::parse2(emit(model, compiled)).expect("emitted code is a module")
}

/// A method of `Model`.
pub fn method(module: &ItemMod, name: &str) -> syn::ImplItemFn {
    let (_, items) = module.content.as_ref().expect("a body");
    let methods = items.iter().flat_map(|item| match item {
        Item::Impl(block) if block.trait_.is_none() => block.items.as_slice(),
        _ => &[],
    });
    let mut found = methods.filter_map(|item| match item {
        ImplItem::Fn(method) if method.sig.ident == name => Some(method.clone()),
        _ => None,
    });
    found.next().expect("a method of that name")
}

/// A pendulum's kinetic energy with this program in it.
pub fn scalar_function(program: Program) -> syn::ImplItemFn {
    let (model, mut compiled) = pendulum();
    compiled.functions = vec![derived(FunctionKind::KineticEnergy, program)];
    method(&module(&model, &compiled), "kinetic_energy")
}

/// How a scalar expression is written, without spaces.
pub fn written(locals: &[&str], statements: Vec<Statement>, value: Expression) -> String {
    let program = crate::samples::program(locals, statements, vec![value]);
    let method = scalar_function(program);
    match method.block.stmts.last() {
        Some(syn::Stmt::Expr(expr, None)) => text(expr),
        _ => panic!("no value"),
    }
}

pub fn text(tokens: &impl quote::ToTokens) -> String {
    let text = tokens.to_token_stream().to_string();
    text.split_whitespace().collect()
}
