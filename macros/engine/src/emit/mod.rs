//! Stage `emit`: the optimised programs as a Rust module.
//!
//! In: the checked [`Model`], its [`Structure`] and the [`Compiled`] programs. Out: tokens, and on request
//! (`MULTIBODY_DUMP`) files. Nothing about the equations is decided here. The code needs no `#[allow]` in the user's crate:
//! names that the user chose count as generated, so that lints of style and dead code don't apply, and what lints check even
//! there is kept: every public item is documented, no function has more than six arguments, no literal looks like a constant
//! of `core`.
//!
//! Rooms: `layout` knows which field of which struct holds what, `print` writes programs, `methods` the functions of
//! `Model`, `items` has one file per other generated thing, `document` writes documentation and the report, `broken` what
//! stands in after errors, `references` what editors follow.

mod broken;
mod document;
mod dump;
mod exports;
mod items;
mod layout;
mod methods;
mod names;
mod print;
pub mod references;

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use crate::contracts::function::FunctionKind;
use crate::mechanics::loops::structure::Structure;
use crate::model::types::Model;
use crate::optimize::program::{Compiled, Function};

use self::layout::Layout;
use self::print::parts;

pub use self::broken::skeleton::skeleton;
pub use self::document::alike::once as alike;
pub use self::document::facts::{BodyFact, ClosingFact, Declared, Facts, ForceFact, JointFact};
pub use self::document::report::report;
pub use self::document::shown::{Form, Shown};
pub use self::document::unused::Unused;
pub use self::exports::exports;
pub use self::methods::functions::name as function_name;
pub use self::print::text::source;

/// What every generated item is printed from.
struct Context<'a> {
    layout: Layout<'a>,
    compiled: &'a Compiled,
    /// Fields of `Model`.
    fields: Vec<Ident>,
    /// Bodies of functions are left out: what stands beside errors is never run.
    hollow: bool,
    /// Paragraphs of statements have headings: for readers, since the compiler warns of comments that document nothing.
    commented: bool,
    /// Functions of more operations are written in parts, of so many operations each.
    most: usize,
    part: usize,
}

impl Context<'_> {
    fn function(&self, kind: FunctionKind) -> Option<&Function> {
        self.compiled.functions.iter().find(|function| function.kind == kind)
    }
}

/// The generated module of one model. Writes it to files too where the environment asks for that.
///
/// Expands to `pub mod double_pendulum { pub struct Params<T = f64> { .. } .. }`.
pub fn emit(model: &Model, structure: &Structure, compiled: &Compiled) -> TokenStream {
    dump::dump(model, structure, compiled);
    module(&context(model, structure, compiled, false))
}

/// The same with a heading over each paragraph of statements, as the attribute `#[doc = "// .."]`; writes no files.
pub fn commented(model: &Model, structure: &Structure, compiled: &Compiled) -> TokenStream {
    module(&Context { commented: true, ..context(model, structure, compiled, false) })
}

/// The same with all functions of more than so many operations in parts of about as many; writes no files.
pub fn in_parts(model: &Model, structure: &Structure, compiled: &Compiled, operations: usize) -> TokenStream {
    let context = context(model, structure, compiled, false);
    module(&Context { most: operations, part: operations, ..context })
}

/// The first function whose program doesn't fill the slots that its value is built from: numbers would be handed out to the
/// wrong places.
pub fn misfit(model: &Model, structure: &Structure, compiled: &Compiled) -> Option<FunctionKind> {
    let layout = Layout::new(model, structure);
    let fits = |function: &&Function| {
        let parts = methods::results::parts(&layout, function.kind);
        function.parts == parts && function.program.results.len() == parts.count()
    };
    let of_at = compiled.at.iter().flat_map(|at| &at.functions);
    compiled.functions.iter().chain(of_at).find(|function| !fits(function)).map(|function| function.kind)
}

/// What is said of a model in its documentation.
pub fn facts(model: &Model, structure: &Structure, compiled: &Compiled) -> Facts {
    Facts::new(&context(model, structure, compiled, false))
}

/// What of a model no generated function reads.
pub fn unused(model: &Model, structure: &Structure, compiled: &Compiled) -> Unused {
    Unused::new(&context(model, structure, compiled, false))
}

fn context<'a>(model: &'a Model, structure: &'a Structure, compiled: &'a Compiled, hollow: bool) -> Context<'a> {
    Context {
        layout: Layout::new(model, structure),
        compiled,
        fields: names::unique(compiled.fields.iter().map(String::as_str), &["scalar", "self"]),
        hollow,
        commented: false,
        most: parts::MOST,
        part: parts::PART,
    }
}

fn module(context: &Context<'_>) -> TokenStream {
    let model = context.layout.model;
    let (attrs, vis, krate) = (&model.attrs, &model.vis, &model.krate);
    let name = names::field(&model.name);
    let docs = document::attributes(&if context.hollow {
        vec!["Stands in for a model that has errors.".to_string()]
    } else {
        document::report::lines(context)
    });
    let items = items::all(context);
    quote! {
        #(#attrs)*
        #docs
        #vis mod #name {
            use ::core::prelude::v1::*;
            use #krate::Real;
            #items
        }
    }
}
