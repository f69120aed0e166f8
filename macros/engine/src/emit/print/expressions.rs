//! Stage `emit`: expressions of programs as Rust expressions.
//!
//! In: an [`Expression`] in normal form. Out: tokens with no parentheses but those that are needed: the order of
//! operations is the program's own, to the last bit. Signs move to where they read well, which rounds nothing:
//! `-a + b` is written `b - a`, and `a + (-2 b)` is `a - 2 b`.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use crate::contracts::call::Call;
use crate::emit::layout::Layout;
use crate::emit::layout::leaf;
use crate::emit::names;
use crate::invariant::fault::raise;
use crate::invariant::injection::{Break, broken};
use crate::model::types::{External, ExternalId};
use crate::optimize::program::{Expression, FieldId, Size};

use super::literals;

/// How tightly an expression binds, loosest first.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Level {
    Or,
    And,
    Sum,
    Product,
    Unary,
    Atom,
}

/// What the names in expressions mean.
pub(in crate::emit) struct Names<'a> {
    pub(in crate::emit) layout: &'a Layout<'a>,
    pub(in crate::emit) locals: &'a [Ident],
    pub(in crate::emit) fields: &'a [Ident],
    /// In functions of what `Model::at` gives: its own fields, numbered behind those of the model.
    pub(in crate::emit) stored: Option<&'a [Ident]>,
    /// Whether statements stand under headings, as `#[doc = "// .."]`.
    pub(in crate::emit) commented: bool,
    /// Where operations are those of packs: how many members these have.
    pub(in crate::emit) packed: Option<Size>,
}

impl Names<'_> {
    /// Expands to `a * (b + T::lit(0.5)) - self.c`.
    pub(in crate::emit) fn expression(&self, expression: &Expression) -> TokenStream {
        self.write(expression, is_negative(expression), Level::Or)
    }

    /// The expression's magnitude with this sign; in parentheses if it binds less than `least`.
    fn write(&self, expression: &Expression, minus: bool, least: Level) -> TokenStream {
        let expression = unwrapped(expression);
        let mut binds = level(expression);
        let tokens = match expression {
            Expression::Literal(value) => signed_literal(*value, minus),
            // Whether the two signs cancel has gone into `minus`.
            Expression::Neg(inner) => return self.write(inner, minus, least),
            Expression::Product(factors) => self.product(factors, minus),
            Expression::Quotient(above, below) => {
                let above = self.write(above, minus, Level::Product);
                let below = self.write(below, false, Level::Unary);
                quote!(#above / #below)
            }
            _ if minus => {
                // What follows a minus sign binds as it does, so that `-a * b` needs no parentheses.
                let operand = self.write(expression, false, Level::Unary);
                binds = Level::Unary;
                quote!(- #operand)
            }
            Expression::Symbol(symbol) => self.layout.symbol(*symbol),
            Expression::Field(FieldId(field)) => match (self.stored, self.fields.get(*field)) {
                (None, _) => {
                    let field = &self.fields[*field];
                    quote!(self.#field)
                }
                (Some(_), Some(field)) => quote!(self.model.#field),
                (Some(stored), None) => {
                    let field = &stored[*field - self.fields.len()];
                    quote!(self.#field)
                }
            },
            Expression::Local(local) => {
                let local = &self.locals[local.0];
                quote!(#local)
            }
            Expression::Sum(terms) => self.sum(terms),
            Expression::Fused(operands) => {
                let operands = operands.iter().map(|operand| self.expression(operand));
                match self.packed {
                    Some(_) => quote!(T::mul_adds(#(#operands),*)),
                    None => quote!(Real::mul_add(#(#operands),*)),
                }
            }
            Expression::Call(Call::Sqrt, arguments) if self.packed.is_some() => {
                let arguments = arguments.iter().map(|argument| self.expression(argument));
                quote!(T::roots(#(#arguments),*))
            }
            Expression::Call(call, arguments) => self.call(*call, arguments),
            Expression::Pack(members) => match self.packed {
                Some(size) => self.pack(size, members),
                None => raise("packs stand in statements of packs"),
            },
        };
        if binds < least { quote!((#tokens)) } else { tokens }
    }

    /// `T::four([a, b, c, d])`, `T::two_of(a)`.
    fn pack(&self, size: Size, members: &[Expression]) -> TokenStream {
        let members = &members[..members.len().min(size.members())];
        let mut each = members.iter().map(|member| self.expression(member));
        if members.iter().all(|member| Some(member) == members.first()) {
            let member = each.next();
            return match size {
                Size::Two => quote!(T::two_of(#member)),
                Size::Four => quote!(T::four_of(#member)),
            };
        }
        let each = each.map(leaf::element);
        match size {
            Size::Two => quote!(T::two([#(#each),*])),
            Size::Four => quote!(T::four([#(#each),*])),
        }
    }

    /// Terms from left to right.
    fn sum(&self, terms: &[(bool, Expression)]) -> TokenStream {
        let mut terms: Vec<(bool, &Expression)> =
            terms.iter().map(|(minus, term)| (*minus != is_negative(term), term)).collect();
        // The first two commute.
        if let [(true, _), (false, _), ..] = terms[..] {
            terms.swap(0, 1);
        }
        let Some(((minus, first), rest)) = terms.split_first() else {
            return literals::scalar(0.0);
        };
        let mut tokens = self.write(first, *minus, Level::Sum);
        for (minus, term) in rest {
            let term = self.write(term, false, Level::Product);
            tokens.extend(if *minus { quote!(- #term) } else { quote!(+ #term) });
        }
        tokens
    }

    /// Factors from left to right, the sign before the first.
    fn product(&self, factors: &[Expression], minus: bool) -> TokenStream {
        let Some((first, rest)) = factors.split_first() else {
            return signed_literal(1.0, minus);
        };
        let mut tokens = self.write(first, minus, Level::Product);
        for factor in rest {
            let factor = self.write(factor, false, Level::Unary);
            tokens.extend(quote!(* #factor));
        }
        tokens
    }

    /// `Real::sqrt(x)`: by the trait's name, since methods of other traits on the scalar have the same names.
    fn call(&self, call: Call, arguments: &[Expression]) -> TokenStream {
        let each = |least: Level| {
            let write = move |a: &Expression| self.write(a, is_negative(a), least);
            arguments.iter().map(write)
        };
        if let Some(function) = call.external() {
            let (function, arguments) = (self.external(function), each(Level::Or).map(leaf::element));
            return match call {
                Call::ExternalSlope(..) => raise("slopes are taken together"),
                _ => quote!(#function::value([#(#arguments),*])),
            };
        }
        if call == Call::Epsilon {
            return quote!(<T as Real>::epsilon());
        }
        if call == Call::Nan {
            return quote!(T::lit(f64::NAN));
        }
        if let Some(name) = function(call) {
            let (name, mut arguments) = (names::ident(name), each(Level::Or).collect::<Vec<_>>());
            if broken(Break::PrintedArguments) {
                arguments.reverse();
            }
            return quote!(Real::#name(#(#arguments),*));
        }
        match call {
            Call::And => {
                let arguments = each(Level::And);
                quote!(#(#arguments)&*)
            }
            Call::Or => {
                let arguments = each(Level::Or);
                quote!(#(#arguments)|*)
            }
            _ => {
                let argument = each(Level::Unary).next();
                quote!(! #argument)
            }
        }
    }

    /// `<crate::Tyre as ::multibody::Function<T, 2>>`, the type at the user's own token, where rustc says what it lacks.
    pub(in crate::emit) fn external(&self, id: ExternalId) -> TokenStream {
        let model = self.layout.model;
        let (krate, External { path, arguments, .. }) = (&model.krate, &model.externals[id]);
        let count = Literal::usize_unsuffixed(arguments.len());
        quote!(<#path as #krate::Function<T, #count>>)
    }
}

/// The function of `Real`; operators have none.
pub(in crate::emit) fn function(call: Call) -> Option<&'static str> {
    Some(match call {
        Call::Tan => "tan",
        Call::Asin => "asin",
        Call::Acos => "acos",
        Call::Atan => "atan",
        Call::Atan2 => "atan2",
        Call::Sinh => "sinh",
        Call::Cosh => "cosh",
        Call::Tanh => "tanh",
        Call::Exp => "exp",
        Call::Ln => "ln",
        Call::Powf => "powf",
        Call::Sqrt => "sqrt",
        Call::Abs => "abs",
        Call::Signum => "signum",
        Call::Min => "min",
        Call::Max => "max",
        Call::Less => "lt",
        Call::LessEqual => "le",
        Call::Equal => "eq",
        Call::Select => "select",
        Call::And | Call::Or | Call::Not | Call::Epsilon | Call::Nan => return None,
        Call::External(_) | Call::ExternalSlope(..) | Call::ExternalCurvature(_) => return None,
    })
}

/// A sum or product of one is that one.
fn unwrapped(expression: &Expression) -> &Expression {
    match expression {
        Expression::Product(factors) => match &factors[..] {
            [factor] => unwrapped(factor),
            _ => expression,
        },
        Expression::Sum(terms) => match &terms[..] {
            [(false, term)] => unwrapped(term),
            _ => expression,
        },
        _ => expression,
    }
}

/// Whether a minus sign can be taken out without touching any operation.
fn is_negative(expression: &Expression) -> bool {
    match unwrapped(expression) {
        Expression::Literal(value) => value.is_sign_negative(),
        Expression::Neg(inner) => !is_negative(inner),
        Expression::Product(factors) => factors.iter().filter(|f| is_negative(f)).count() % 2 == 1,
        Expression::Quotient(above, below) => is_negative(above) != is_negative(below),
        _ => false,
    }
}

/// How tightly the expression without its sign binds.
fn level(expression: &Expression) -> Level {
    match unwrapped(expression) {
        Expression::Sum(terms) if terms.is_empty() => Level::Atom,
        Expression::Sum(_) => Level::Sum,
        Expression::Product(factors) if factors.is_empty() => Level::Atom,
        Expression::Product(_) | Expression::Quotient(..) => Level::Product,
        Expression::Neg(inner) => level(inner),
        Expression::Call(Call::And, _) => Level::And,
        Expression::Call(Call::Or, _) => Level::Or,
        Expression::Call(Call::Not, _) => Level::Unary,
        _ => Level::Atom,
    }
}

/// Expands to `T::lit(-0.5)`.
fn signed_literal(value: f64, minus: bool) -> TokenStream {
    literals::scalar(if minus { -value.abs() } else { value.abs() })
}
