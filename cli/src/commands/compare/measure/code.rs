//! The code of one choice, and calls of its functions.

use multibody_engine::emit;
use multibody_engine::mechanics::loops::structure::Structure;
use multibody_engine::model::types::{JointId, Model};
use multibody_engine::optimize::program::Compiled;
use proc_macro2::TokenStream;
use quote::quote;
use syn::{FnArg, ImplItem, ImplItemFn, Item, ItemMod, Pat, Type, parse_quote};

/// What is compiled of one choice.
pub(in crate::commands::compare) struct Code {
    /// The generated module with a function `subjects` beside it.
    text: String,
}

impl Code {
    /// Of the model, which is emitted for a crate of its own, and of the functions of these names.
    pub(in crate::commands::compare) fn new(
        mut model: Model,
        structure: &Structure,
        compiled: &Compiled,
        functions: &[String],
    ) -> Result<Code, String> {
        if !model.externals.is_empty() {
            return Err(format!("`{}` may call functions of Rust, which a program of its own has not", model.name));
        }
        // Conditional compilation, visibility and the library's name are those of the user's crate.
        model.attrs.clear();
        model.vis = parse_quote!(pub);
        model.krate = parse_quote!(::multibody);
        let tokens = emit::emit(&model, structure, compiled);
        let module: ItemMod =
            syn::parse2(tokens.clone()).map_err(|error| format!("the code of `{}` is no Rust: {error}", model.name))?;
        let name = &module.ident;
        let centre = centre(&model, structure);
        let close = if structure.rows.is_empty() { quote!(harness::accepted) } else { quote!(harness::assembled) };
        let calls = functions.iter().filter_map(|function| {
            let method = method(&module, function)?;
            let call = call(method);
            Some(quote!(bench.subject(&format!("{number}\t{}", #function), |model, t, state, input| #call)))
        });
        let text = quote! {
            use crate::harness::{self, Bench, Subject};
            use self::user::#name as generated;
            /// Apart from the names around it, of which it may have one.
            mod user { #tokens }
            /// Functions that are timed, none where accelerations are not finite.
            pub fn subjects(number: usize) -> Vec<Subject> {
                let model = generated::Model::<f64>::default();
                let input = generated::Input::default();
                let start = generated::State::<f64>::default();
                let Some(bench) = Bench::new(model, input, start, &[#(#centre),*], #close) else { return Vec::new() };
                vec![#(#calls),*]
            }
        };
        Ok(Code { text: text.to_string() })
    }

    pub(super) fn text(&self) -> &str {
        &self.text
    }
}

/// The displacement of the default position to the nearest one with closed loops that the compiler knows.
fn centre(model: &Model, structure: &Structure) -> Vec<f64> {
    let Some(closed) = structure.closed.first() else { return Vec::new() };
    let component = |joint: JointId, index: usize| {
        let kind = &model.joints[joint].kind;
        let position = closed.positions.get(joint.0)?;
        if kind.has_quaternion() && kind.turning().contains(&index) {
            let start = kind.turning().start;
            let &[w, x, y, z] = position.get(start..start + 4)? else { return None };
            return Some(rotation([w, x, y, z])[index - start]);
        }
        position.get(index).copied()
    };
    let components = structure.state.iter().map(|coordinate| component(coordinate.joint, coordinate.index));
    // A value that is no number would be no Rust.
    components.map(|value| value.filter(|value| value.is_finite()).unwrap_or(0.0)).collect()
}

/// The rotation vector of a unit quaternion.
fn rotation([w, x, y, z]: [f64; 4]) -> [f64; 3] {
    let sine = x.hypot(y).hypot(z);
    let share = if sine > 0.0 { 2.0 * sine.atan2(w) / sine } else { 2.0 };
    [share * x, share * y, share * z]
}

/// The method of `Model` that can be called; of one that no `emit` asks for there is a generic form that cannot.
fn method<'a>(module: &'a ItemMod, name: &str) -> Option<&'a ImplItemFn> {
    let (_, items) = module.content.as_ref()?;
    let own = items.iter().filter_map(|item| match item {
        Item::Impl(item) if item.trait_.is_none() && is_model(&item.self_ty) => Some(&item.items),
        _ => None,
    });
    let methods = own.flatten().filter_map(|item| match item {
        ImplItem::Fn(method) if method.sig.generics.params.is_empty() => Some(method),
        _ => None,
    });
    methods.into_iter().find(|method| method.sig.ident == name)
}

fn is_model(ty: &Type) -> bool {
    matches!(ty, Type::Path(path) if path.path.segments.last().is_some_and(|segment| segment.ident == "Model"))
}

/// Of accelerations, momenta and impulses any velocities do; of multipliers and rates of equations any numbers.
fn call(method: &ImplItemFn) -> TokenStream {
    let name = &method.sig.ident;
    let arguments = method.sig.inputs.iter().filter_map(|argument| match argument {
        FnArg::Typed(argument) => match &*argument.pat {
            Pat::Ident(pattern) => Some(pattern.ident.to_string()),
            _ => None,
        },
        FnArg::Receiver(_) => None,
    });
    let arguments = arguments.map(|argument| match argument.trim_start_matches('_') {
        "t" => quote!(t),
        "state" => quote!(state),
        "q" => quote!(&state.q),
        "input" => quote!(input),
        "accel" | "impulse" | "momentum" => quote!(&state.v),
        _ => quote!(&::std::hint::black_box(::multibody::nalgebra::SVector::repeat(0.25))),
    });
    quote!(model.#name(#(#arguments),*))
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use multibody_engine::diagnostics::Diagnostics;
    use multibody_engine::{compile, model, syntax};
    use syn::{Item, UseTree};

    use super::{Code, rotation};

    /// A user's model may have any name, those of the crate around it among them.
    #[test]
    fn names_of_models_are_apart() {
        for name in ["generated", "harness", "user", "subjects", "Bench"] {
            let text = format!(
                "mod {name} {{ body b {{ mass: 1.0 }} joint j: Prismatic {{ parent: ground, child: b, axis: X }} }}"
            );
            let mut diagnostics = Diagnostics::default();
            let source = syntax::parse(text.parse().expect("tokens"), &mut diagnostics);
            let model = model::check(&source, &mut diagnostics).pop().expect("a model");
            let Ok((structure, compiled)) = compile(&model) else { panic!("{name}") };
            let code = Code::new(model, &structure, &compiled, &["forward_dynamics".to_owned()]).expect("code");
            let mut names = HashSet::new();
            for item in syn::parse_file(code.text()).expect("Rust").items {
                let declared = match item {
                    Item::Mod(item) => vec![item.ident],
                    Item::Fn(item) => vec![item.sig.ident],
                    Item::Use(item) => leaves(&item.tree, None),
                    _ => Vec::new(),
                };
                for declared in declared {
                    assert!(names.insert(declared.to_string()), "{name}: {declared} stands twice");
                }
            }
            assert!(names.contains("generated") && names.contains("harness"));
        }
    }

    /// What `use` declares.
    fn leaves(tree: &UseTree, inside: Option<&syn::Ident>) -> Vec<syn::Ident> {
        match tree {
            UseTree::Path(path) => leaves(&path.tree, Some(&path.ident)),
            UseTree::Name(name) if name.ident == "self" => inside.into_iter().cloned().collect(),
            UseTree::Name(name) => vec![name.ident.clone()],
            UseTree::Rename(rename) => vec![rename.rename.clone()],
            UseTree::Group(group) => group.items.iter().flat_map(|tree| leaves(tree, inside)).collect(),
            UseTree::Glob(_) => Vec::new(),
        }
    }

    #[test]
    fn quaternions_are_turns() {
        let half = 0.3_f64;
        let [x, y, z] = rotation([half.cos(), 0.0, half.sin(), 0.0]);
        assert!(x == 0.0 && z == 0.0 && (y - 0.6).abs() < 1e-15, "{x} {y} {z}");
        assert_eq!(rotation([1.0, 0.0, 0.0, 0.0]), [0.0; 3]);
    }
}
