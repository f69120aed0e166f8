//! Stage `emit`: `System`, by which integrators run the model.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use crate::contracts::function::{Arguments, FunctionKind};
use crate::emit::items::singular;
use crate::emit::layout::Layout;
use crate::emit::methods::arguments::input_type;
use crate::emit::methods::{functions, results};
use crate::emit::print::blocks::groups_argument;
use crate::emit::print::literals;
use crate::emit::{Context, names};
use crate::invariant::fault::OrFault;
use crate::mechanics::loops::constraints::{is_length, row_name};
use crate::mechanics::loops::structure::{Means, Row};

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
    let position_rates = position_rates(context);
    let accepted = accepted(context);
    let margins = margins(context);
    let opening = opening(context);
    let constrained = constrained(context);
    let without_inertia = singular::without_inertia(context);
    let ambiguity = constrained.is_some().then(|| singular::ambiguity(context));
    quote! {
        impl<T: Real> #krate::System for Model<T> {
            type Scalar = T;
            type State = State<T>;
            type Input = #input;

            fn derivative(&self, t: T, state: &State<T>, input: &#input) -> (Velocity<T>, #extra) {
                #value
            }
            #position_rates
            #accepted
            #margins
            #opening
            #ambiguity
            #without_inertia
        }
        #constrained
    }
}

/// Expands to `fn position_rates(..)`, and where velocities are no rates of coordinates to `fn slope(..)`, which has them of forward
/// dynamics.
fn position_rates(context: &Context<'_>) -> TokenStream {
    let layout = &context.layout;
    let krate = layout.krate();
    let Some(function) = context.function(FunctionKind::PositionRates) else {
        return quote! {
            fn position_rates(&self, _t: T, state: &State<T>) -> Velocity<T> {
                state.v
            }
        };
    };
    let arguments = functions::arguments(function);
    let ([t, _], state) = (named(arguments), names::ident("state"));
    let passed = arguments.pass();
    let input = input_type(layout);
    let (extra, x) = if layout.has_states() { (quote!(States<T>), quote!(rates.x)) } else { (quote!(()), quote!(())) };
    quote! {
        fn position_rates(&self, #t: T, #state: &State<T>) -> Rates<T> {
            self.position_rates(#passed)
        }

        fn slope(&self, t: T, state: &State<T>, input: &#input) -> #krate::Slope<Rates<T>, Velocity<T>, #extra> {
            let rates = self.forward_dynamics(t, state, input);
            #krate::Slope { q: rates.q, v: rates.v, x: #x }
        }
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
        let [_, greatest] = scales(layout);
        if greatest == 1.0 {
            quote!(margins[#last])
        } else {
            let greatest = literals::number(greatest);
            quote!(margins[#last] / T::lit(#greatest))
        }
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

/// Expands to `fn opening(..) -> Opening<T>`, which tells how far the loops of a start are open, where they can be: by what
/// Newton's method leaves, by equations with multipliers and their rates, by equations that parameters make hold.
fn opening(context: &Context<'_>) -> Option<TokenStream> {
    let layout = &context.layout;
    let krate = layout.krate();
    let ty = input_type(layout);
    let mut reads = [false; 2];
    let parts = [iterated(context, &mut reads), constrained_start(context, &mut reads), granted(context, &mut reads)];
    let mut parts = parts.into_iter().flatten();
    let first = parts.next()?;
    let [t, state, input] = ["t", "state", "input"].map(names::ident);
    let [time, inputs] = [(reads[0], &t), (reads[1], &input)]
        .map(|(read, name)| if read { name.clone() } else { names::ident(&format!("_{name}")) });
    Some(quote! {
        fn opening(&self, #time: T, #state: &State<T>, #inputs: &#ty) -> #krate::Opening<T> {
            #first #(let opening = opening.or(|| { #parts opening });)*
            opening
        }
    })
}

/// Expands to `let closed = ..; let opening = ..;` of loops that Newton's method closes; the state is the closed one then.
fn iterated(context: &Context<'_>, reads: &mut [bool; 2]) -> Option<TokenStream> {
    let layout = &context.layout;
    let arguments = functions::arguments(context.function(FunctionKind::Guess)?);
    reads[0] |= arguments.has_time();
    reads[1] |= arguments.has_input();
    let (passed, state) = (arguments.pass(), names::ident("state"));
    let opening = iterations(layout);
    Some(quote! {
        let closed = self.close(#passed);
        let #state = &closed.state;
        let opening = #opening;
    })
}

/// Expands to the `Opening` of what Newton's method has left in `closed`.
pub(super) fn iterations(layout: &Layout<'_>) -> TokenStream {
    let krate = layout.krate();
    let [least, greatest] = scales(layout).map(literals::number);
    quote!(#krate::Opening::of_iterations(closed.residual, [T::lit(#least), T::lit(#greatest)]))
}

/// The least and the greatest residual that amounts to one in the equations that Newton's method solves.
fn scales(layout: &Layout<'_>) -> [f64; 2] {
    let rows = layout.structure.steps.iter().filter_map(|step| match &step.means {
        Means::Newton { rows, .. } => Some(rows),
        _ => None,
    });
    let scales: Vec<f64> = rows.flatten().map(|&row| layout.structure.scale(row)).collect();
    [scales.iter().fold(f64::MAX, |a, &b| a.min(b)), scales.iter().fold(0.0, |a, &b| b.max(a))]
}

/// Whether what is left of constraint equations depends on nothing but time and positions, and their slopes and rates on nothing but
/// time and the state; nothing where they were not derived.
fn takes_what_is_known(context: &Context<'_>) -> Option<bool> {
    let [open, jacobian, rate] =
        [FunctionKind::Constraints, FunctionKind::ConstraintJacobian, FunctionKind::ConstraintRate]
            .map(|kind| context.function(kind).map(functions::arguments));
    let moved = context.function(FunctionKind::PositionJacobian).map(functions::arguments);
    let of_position = open? == FunctionKind::Constraints.row().takes;
    Some(of_position && [jacobian?, rate?].into_iter().chain(moved).all(|arguments| !arguments.has_input()))
}

/// The call of the method that has the constraint equations' derivatives by displacements of the position, from where `t` and `state`
/// are known.
fn of_displacements(context: &Context<'_>) -> Option<TokenStream> {
    jacobian_of(context, FunctionKind::PositionJacobian)
        .or_else(|| jacobian_of(context, FunctionKind::ConstraintJacobian))
}

fn jacobian_of(context: &Context<'_>, kind: FunctionKind) -> Option<TokenStream> {
    let passed = functions::arguments(context.function(kind)?).pass_state();
    let method = names::ident(&functions::name(context.layout.model, kind));
    Some(quote!(self.#method(#passed)))
}

/// Expands to `let opening = ..;` of equations with multipliers.
fn constrained_start(context: &Context<'_>, reads: &mut [bool; 2]) -> Option<TokenStream> {
    let layout = &context.layout;
    if !takes_what_is_known(context)? || layout.rows() == 0 {
        return None;
    }
    reads[0] = true;
    let krate = layout.krate();
    let (structure, rows) = (layout.structure, &layout.structure.rows);
    let [t, state] = ["t", "state"].map(names::ident);
    let numbers = |list: Vec<f64>| {
        let list = list.into_iter().map(literals::number);
        quote!([#(T::lit(#list)),*])
    };
    let scales = numbers(rows.iter().map(|&row| structure.scale(row)).collect());
    let kind = |row: &Row| (row.closing, is_length(layout.model, row.closing, row.index));
    let kinds = rows.iter().map(|row| {
        let first = rows.iter().position(|other| kind(other) == kind(row)).or_fault("a row is of its own kind");
        Literal::usize_unsuffixed(first)
    });
    let kinds = quote!([#(#kinds),*]);
    if layout.dof() == 0 {
        return Some(quote! {
            let gauge = #krate::Gauge { jacobian: &[], scales: &#scales, kinds: &#kinds, units: &[] };
            let opening = #krate::Opening::of_positions(self.constraints(#t, &#state.q).as_slice(), &gauge, &[]);
        });
    }
    let units = numbers(structure.units.clone());
    let sized = results::vector_type(layout, structure.state.len());
    let jacobian = of_displacements(context)?;
    // Velocities count as what they move.
    let rates = match context.function(FunctionKind::PositionRates) {
        Some(_) => quote!(#krate::System::position_rates(self, #t, #state)),
        None => quote!(#state.v),
    };
    Some(quote! {
        let jacobian = #jacobian;
        let gauge =
            #krate::Gauge { jacobian: jacobian.as_slice(), scales: &#scales, kinds: &#kinds, units: &#units };
        let sizes: #sized = #krate::Configuration::magnitude(&#state.q).into();
        let opening = #krate::Opening::of_positions(
            self.constraints(#t, &#state.q).as_slice(),
            &gauge,
            sizes.as_slice(),
        );
        let opening = opening.or(|| {
            let velocities: #sized = #rates.into();
            let rest = State { v: ::core::default::Default::default(), ..*#state };
            #krate::Opening::of_velocities(
                self.constraint_rate(#t, #state).as_slice(),
                self.constraint_rate(#t, &rest).as_slice(),
                &gauge,
                velocities.as_slice(),
            )
        });
    })
}

/// Expands to `let opening = ..;` of equations that hold for parameters like the declared ones only.
fn granted(context: &Context<'_>, reads: &mut [bool; 2]) -> Option<TokenStream> {
    let layout = &context.layout;
    let krate = layout.krate();
    let (passed, arguments) = call_granted(context)?;
    reads[0] |= arguments.has_time();
    reads[1] |= arguments.has_input();
    let names = granted_names(layout);
    Some(quote! {
        let opening = #krate::Opening::of_equations(self.granted(#passed).as_slice(), &[#(#names),*]);
    })
}

/// The arguments of `granted`, from where `t`, `state` and `input` are known.
pub(super) fn call_granted(context: &Context<'_>) -> Option<(TokenStream, Arguments)> {
    let arguments = functions::arguments(context.function(FunctionKind::Granted)?);
    let [t, state] = ["t", "state"].map(names::ident);
    let passed = if arguments.has_state() { arguments.pass() } else { quote!(#t, &#state.q) };
    Some((passed, arguments))
}

/// What errors call the equations of `granted`.
pub(super) fn granted_names(layout: &Layout<'_>) -> Vec<String> {
    layout.structure.granted.iter().map(|row| row_name(layout.model, row.closing, row.index)).collect()
}

/// Expands to `impl<T: Real> Constrained for Model<T> { .. }` where constraint equations are left that depend on what the
/// trait knows.
fn constrained(context: &Context<'_>) -> Option<TokenStream> {
    let layout = &context.layout;
    if !takes_what_is_known(context)? || layout.rows() == 0 || layout.dof() == 0 {
        return None;
    }
    let krate = layout.krate();
    let [t, state] = ["t", "state"].map(names::ident);
    let residual = results::vector_type(layout, layout.rows());
    let of_velocities = results::vector_type(layout, layout.dof());
    let groups = layout.structure.row_groups(layout.model);
    let least_norm = names::ident(if groups.is_empty() { "least_norm" } else { "least_norm_in_groups" });
    let groups = groups_argument(&groups);
    let crossings = layout.structure.redundant.then(|| {
        quote! {
            fn tells_crossings(&self) -> bool {
                false
            }
        }
    });
    let least = least(context, &residual);
    let moved = context.function(FunctionKind::PositionJacobian).is_some();
    let jacobian = of_displacements(context)?;
    let of_rates = jacobian_of(context, FunctionKind::ConstraintJacobian);
    let (displacement, sized) = match moved {
        true => (names::ident("Rates"), results::vector_type(layout, layout.structure.state.len())),
        false => (names::ident("Velocity"), of_velocities.clone()),
    };
    let of_velocities = match moved {
        true => quote! {
            let weights: #of_velocities = (*weights).into();
            let jacobian = #of_rates;
            let (change, rank) = #krate::linear::#least_norm(&jacobian, residual, &weights #groups);
            (change.into(), rank)
        },
        false => quote!(#krate::Constrained::correction(self, #t, #state, residual, weights)),
    };
    let along = match moved {
        true => quote! {
            let d: #sized = (*d).into();
            #jacobian * d
        },
        false => quote!(#krate::Constrained::constraint_rate_along(self, #t, #state, d)),
    };
    Some(quote! {
        impl<T: Real> #krate::Constrained for Model<T> {
            type Residual = #residual;

            fn constraints(&self, t: T, q: &Position<T>) -> #residual {
                self.constraints(t, q)
            }

            fn constraint_rate(&self, t: T, state: &State<T>) -> #residual {
                self.constraint_rate(t, state)
            }

            #crossings

            fn correction(
                &self,
                #t: T,
                #state: &State<T>,
                residual: &#residual,
                weights: &#displacement<T>,
            ) -> (#displacement<T>, T) {
                let weights: #sized = (*weights).into();
                let jacobian = #jacobian;
                let (change, rank) = #krate::linear::#least_norm(&jacobian, residual, &weights #groups);
                (change.into(), rank)
            }

            fn velocity_correction(
                &self,
                #t: T,
                #state: &State<T>,
                residual: &#residual,
                weights: &Velocity<T>,
            ) -> (Velocity<T>, T) {
                #of_velocities
            }

            fn constraints_along(&self, #t: T, #state: &State<T>, d: &#displacement<T>) -> #residual {
                #along
            }

            #least
        }
    })
}

/// Expands to corrections by the zeros of the Jacobian, where the model is large: of positions too where these move by the velocities.
fn least(context: &Context<'_>, residual: &TokenStream) -> Option<TokenStream> {
    let layout = &context.layout;
    let krate = layout.krate();
    let function = context.function(FunctionKind::Displacement)?;
    let timed = functions::arguments(function).has_time();
    let [t, unread, state] = ["t", "_t", "state"].map(names::ident);
    let time = if timed { &t } else { &unread };
    let passed = functions::arguments(function).pass_state();
    let [columns, rank] = [layout.dof(); 2].map(Literal::usize_unsuffixed);
    let found = quote! {
        let found = self.least_displacement(#passed, residual);
        ::core::option::Option::Some((found.fixed_rows::<#columns>(0).into_owned().into(), found[#rank]))
    };
    if layout.structure.has_speeds() {
        return Some(quote! {
            fn least_velocity_correction(&self, #time: T, #state: &State<T>, residual: &#residual) -> ::core::option::Option<(Velocity<T>, T)> {
                #found
            }
        });
    }
    Some(quote! {
        fn least_correction(&self, #time: T, #state: &State<T>, residual: &#residual) -> ::core::option::Option<(Velocity<T>, T)> {
            #found
        }

        fn least_velocity_correction(&self, #t: T, #state: &State<T>, residual: &#residual) -> ::core::option::Option<(Velocity<T>, T)> {
            #krate::Constrained::least_correction(self, #t, #state, residual)
        }
    })
}
