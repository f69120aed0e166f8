//! Large functions in parts: what is computed, in which order, and that every value is where it is looked for.

use std::collections::HashMap;

use multibody_engine::emit::in_parts;
use multibody_engine::mechanics::loops::structure::Structure;
use quote::ToTokens;
use syn::{Expr, ImplItem, Item, Pat, Stmt};

use crate::parsed;
use crate::samples::*;

/// The method of this name, then its parts in order.
fn functions(module: &syn::ItemMod, name: &str) -> Vec<syn::ImplItemFn> {
    let part = format!("{name}_part_");
    let (_, items) = module.content.as_ref().unwrap();
    let methods = items.iter().flat_map(|item| match item {
        Item::Impl(block) if block.trait_.is_none() => block.items.as_slice(),
        _ => &[],
    });
    let found = methods.filter_map(|item| match item {
        ImplItem::Fn(method) if method.sig.ident == name || method.sig.ident.to_string().starts_with(&part) => {
            Some(method.clone())
        }
        _ => None,
    });
    found.collect()
}

/// Statements that compute something, as text, blocks opened.
fn computed(block: &syn::Block, list: &mut Vec<String>) {
    for statement in &block.stmts {
        let Stmt::Local(local) = statement else { continue };
        match (&local.pat, local.init.as_ref().map(|init| init.expr.as_ref())) {
            (_, Some(Expr::Block(inner))) => computed(&inner.block, list),
            (Pat::Slice(_), _) | (_, Some(Expr::Reference(_) | Expr::Repeat(_))) => {}
            _ => list.push(parsed::text(local)),
        }
    }
}

#[test]
fn parts_are_short_and_compute_the_same_in_the_same_order() {
    let (model, compiled) = long(700);
    let structure = Structure::open(&model);
    let whole = parsed::module(&model, &compiled);
    let mut expected = Vec::new();
    computed(&parsed::method(&whole, "forward_dynamics").block, &mut expected);
    assert_eq!(functions(&whole, "forward_dynamics").len(), 1);
    for size in [2, 7, 100, 999, 2_099] {
        let cut: syn::ItemMod = syn::parse2(in_parts(&model, &structure, &compiled, size)).unwrap();
        let functions = functions(&cut, "forward_dynamics");
        // Three operations in a statement.
        let parts = 2_100_usize.div_ceil(size).min(700);
        assert!(functions.len() > parts / 2 && functions.len() <= parts + 1, "{} of {size}", functions.len());
        let mut found = Vec::new();
        for function in &functions {
            let before = found.len();
            computed(&function.block, &mut found);
            assert!(3 * (found.len() - before) <= 2 * size + 6, "{} of {size}", found.len() - before);
        }
        assert_eq!(found.len(), expected.len());
        for (found, expected) in found.iter().zip(&expected) {
            assert_eq!(found, expected);
        }
    }
}

/// What the text of one function does with the array, followed by hand.
#[test]
fn every_value_is_where_it_is_looked_for() {
    let (model, compiled) = long(2_500);
    let cut: syn::ItemMod = syn::parse2(in_parts(&model, &Structure::open(&model), &compiled, 300)).unwrap();
    let mut kept: HashMap<String, String> = HashMap::new();
    let mut places = 0;
    let functions = functions(&cut, "forward_dynamics");
    assert!(functions.len() > 10);
    for function in functions.iter().skip(1) {
        let mut known: Vec<String> = Vec::new();
        for statement in &function.block.stmts {
            match statement {
                Stmt::Local(local) => match (&local.pat, local.init.as_ref().map(|init| init.expr.as_ref())) {
                    (Pat::Slice(names), Some(Expr::Array(values))) => {
                        assert_eq!(names.elems.len(), values.elems.len());
                        for (name, place) in names.elems.iter().zip(&values.elems) {
                            assert_eq!(kept.get(&parsed::text(place)), Some(&parsed::text(name)));
                            known.push(parsed::text(name));
                        }
                    }
                    _ => known.push(parsed::text(&local.pat)),
                },
                Stmt::Expr(Expr::Assign(assign), _) => {
                    let name = parsed::text(&assign.right);
                    assert!(known.contains(&name), "{name}");
                    kept.insert(parsed::text(&assign.left), name);
                }
                other => panic!("{}", parsed::text(other)),
            }
        }
        places = places.max(kept.len());
    }
    // A thousand values wait for the one that reads them; places of others are used again.
    assert!((1_000..1_110).contains(&places), "{places}");
}

#[test]
fn small_functions_are_whole() {
    let (model, compiled) = long(1_000);
    let module = parsed::module(&model, &compiled);
    assert_eq!(functions(&module, "forward_dynamics").len(), 1);
    let (model, compiled) = long(20_000);
    let module = parsed::module(&model, &compiled);
    assert!(functions(&module, "forward_dynamics").len() > 2);
}

/// Results that are computed, plain inputs, and literals; parts take no argument that nothing reads.
#[test]
fn results_stand_where_they_are_known() {
    let (model, mut compiled) = long(30);
    let program = &mut compiled.functions[0].program;
    program.results = vec![mul(&[local(3), local(4)])];
    let cut: syn::ItemMod = syn::parse2(in_parts(&model, &Structure::open(&model), &compiled, 6)).unwrap();
    let functions = functions(&cut, "forward_dynamics");
    // Behind what it reads, and nothing of what nobody reads.
    let last = parsed::text(functions.last().unwrap());
    assert!(last.contains("letresult_1=value_3*value_4;"), "{last}");
    let text = parsed::text(&functions[0].block);
    assert!(text.starts_with("{letmutkept=[T::lit(0.0);"), "{text}");
    assert!(text.contains("self.forward_dynamics_part_1(state,&mutkept);"), "{text}");
    let (_, place) = last.split_once("]=result_1;").map(|(before, _)| before.rsplit_once("kept[").unwrap()).unwrap();
    assert!(text.ends_with(&format!("Velocity{{hinge:kept[{place}]}}}}")), "{text}");
    assert!(!cut.to_token_stream().to_string().contains("value_5"));
}
