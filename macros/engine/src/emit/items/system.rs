//! Stage `emit`: `System`, by which integrators run the model.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use crate::emit::arguments::{Arguments, input_type};
use crate::emit::blocks::groups_argument;
use crate::emit::items::singular;
use crate::emit::{Context, functions, names, results};
use crate::optimize::program::FunctionKind;

/// Expands to `impl<T: Real> System for Model<T> { .. }` where forward dynamics has been derived.
pub(super) fn item(context: &Context<'_>) -> TokenStream {
    let layout = &context.layout;
    if context.function(FunctionKind::ForwardDynamics).is_none() {
        return TokenStream::new();
    }
    let krate = layout.krate();
    let input = input_type(layout);
    let (extra, value) = match (layout.has_states(), layout.has_derivative()) {
        (true, _) => {
            let value = quote! {
                let rates = self.forward_dynamics(t, state, input);
                (rates.v, rates.x)
            };
            (quote!(States<T>), value)
        }
        (false, true) => (quote!(()), quote!((self.forward_dynamics(t, state, input).v, ()))),
        (false, false) => (quote!(()), quote!((self.forward_dynamics(t, state, input), ()))),
    };
    let accepted = accepted(context);
    let margins = margins(context);
    let opening = opening(context);
    let constrained = constrained(context);
    let ambiguity = constrained.is_some().then(|| singular::ambiguity(context));
    quote! {
        impl<T: Real> #krate::System for Model<T> {
            type Scalar = T;
            type State = State<T>;
            type Input = #input;

            fn derivative(&self, t: T, state: &State<T>, input: &#input) -> (Velocity<T>, #extra) {
                #value
            }
            #accepted
            #margins
            #opening
            #ambiguity
        }
        #constrained
    }
}

/// Expands to `fn accepted(..) -> State<T>`, which keeps the solutions of the loops, where there are any to keep.
fn accepted(context: &Context<'_>) -> Option<TokenStream> {
    let close = context.function(FunctionKind::Guess)?;
    let arguments = functions::arguments(close);
    let ([t, input], state) = (named(arguments), names::ident("state"));
    let passed = arguments.pass();
    let ty = input_type(&context.layout);
    Some(quote! {
        fn accepted(&self, #t: T, #state: &State<T>, #input: &#ty) -> State<T> {
            self.close(#passed).state
        }
    })
}

/// The names of `t`, `state` and `input` in a method that hands them on with `arguments`: what isn't read starts with `_`.
fn named(arguments: Arguments) -> [Ident; 2] {
    let t = names::ident(if arguments.has_time() { "t" } else { "_t" });
    let input = names::ident(if arguments.has_input() { "input" } else { "_input" });
    [t, input]
}

/// Expands to `fn margins(..) -> T`, which tells integrators of dead centres, where loops have any.
fn margins(context: &Context<'_>) -> Option<TokenStream> {
    let layout = &context.layout;
    let krate = layout.krate();
    let arguments = functions::arguments(context.function(FunctionKind::Margins)?);
    let passed = arguments.pass();
    let ([t, input], state) = (named(arguments), names::ident("state"));
    let ty = input_type(layout);
    let coordinates = layout.structure.margins();
    let count = coordinates.len();
    let calls = coordinates.iter().enumerate().map(|(k, coordinate)| {
        let name = layout.coordinate(*coordinate);
        let [root, rate] = [2 * k, 2 * k + 1].map(Literal::usize_unsuffixed);
        quote!(visit(#krate::Margin { coordinate: #name, root: margins[#root], rate: margins[#rate] });)
    });
    let residual = if layout.structure.guesses() > 0 {
        let last = Literal::usize_unsuffixed(2 * count);
        quote!(margins[#last])
    } else {
        quote!(T::lit(0.0))
    };
    Some(quote! {
        fn margins(
            &self,
            #t: T,
            #state: &State<T>,
            #input: &#ty,
            visit: &mut dyn FnMut(#krate::Margin<T>),
        ) -> T {
            let margins = self.margins(#passed);
            #(#calls)*
            #residual
        }
    })
}

/// Expands to `fn opening(..) -> Opening<T>`, which tells how far the loops of a start are open, where they can be.
fn opening(context: &Context<'_>) -> Option<TokenStream> {
    let layout = &context.layout;
    let krate = layout.krate();
    let ty = input_type(layout);
    let [time, state] = ["t", "state"].map(names::ident);
    let (arguments, residual, tolerance, remedy) = if let Some(close) = context.function(FunctionKind::Guess) {
        let arguments = functions::arguments(close);
        let passed = arguments.pass();
        (
            arguments,
            quote!(self.close(#passed).residual),
            quote!(T::lit(1e-8)),
            "Newton's method finds no solution from the guess of the state: set `guess` nearer to one, such as the \
             default, or one that `close` has found",
        )
    } else {
        let constraints = context.function(FunctionKind::Constraints).filter(|_| layout.rows() > 0)?;
        let arguments = functions::arguments(constraints);
        if arguments != Arguments::least(FunctionKind::Constraints) {
            return None;
        }
        (
            arguments,
            quote!(self.constraints(#time, &#state.q).amax()),
            quote!(T::lit(1e-4)),
            "close them with `multibody::assemble` or `Projection::project`",
        )
    };
    let [t, input] = named(arguments);
    Some(quote! {
        fn opening(&self, #t: T, #state: &State<T>, #input: &#ty) -> #krate::Opening<T> {
            let tolerance = Real::max(#tolerance, T::lit(1e4) * T::epsilon());
            #krate::Opening { residual: #residual, tolerance, remedy: #remedy }
        }
    })
}

/// Expands to `impl<T: Real> Constrained for Model<T> { .. }` where constraint equations are left that depend on what the
/// trait knows.
fn constrained(context: &Context<'_>) -> Option<TokenStream> {
    let layout = &context.layout;
    for kind in [FunctionKind::Constraints, FunctionKind::ConstraintJacobian, FunctionKind::ConstraintRate] {
        if functions::arguments(context.function(kind)?) != Arguments::least(kind) {
            return None;
        }
    }
    if layout.rows() == 0 || layout.dof() == 0 {
        return None;
    }
    let krate = layout.krate();
    let residual = results::vector_type(layout, layout.rows());
    let weights = results::vector_type(layout, layout.dof());
    let groups = layout.structure.row_groups(layout.model);
    let least_norm = names::ident(if groups.is_empty() { "least_norm" } else { "least_norm_in_groups" });
    let groups = groups_argument(&groups);
    Some(quote! {
        impl<T: Real> #krate::Constrained for Model<T> {
            type Residual = #residual;

            fn constraints(&self, t: T, q: &Position<T>) -> #residual {
                self.constraints(t, q)
            }

            fn constraint_rate(&self, t: T, state: &State<T>) -> #residual {
                self.constraint_rate(t, state)
            }

            fn correction(
                &self,
                t: T,
                q: &Position<T>,
                residual: &#residual,
                weights: &Velocity<T>,
            ) -> (Velocity<T>, T) {
                let weights: #weights = (*weights).into();
                let jacobian = self.constraint_jacobian(t, q);
                let (change, rank) = #krate::linear::#least_norm(&jacobian, residual, &weights #groups);
                (change.into(), rank)
            }
        }
    })
}
