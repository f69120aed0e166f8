//! Stage `emit`: the constants that name coordinates and constraint equations: `COORDINATES`, `CONSTRAINTS`, `EQUATIONS`,
//! `JACOBIAN`, `DEAD_CENTRES`.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use crate::contracts::function::FunctionKind;
use crate::emit::Context;
use crate::emit::document::loops;

/// Expands to `pub const COORDINATES: &[&str] = &["shoulder", "elbow"];` and, where loops are held by equations, to the
/// others.
pub(super) fn items(context: &Context<'_>) -> TokenStream {
    let layout = &context.layout;
    let coordinates = layout.coordinates();
    let rows = layout.structure.rows.iter().map(|row| layout.row(*row));
    let rows = (layout.rows() > 0).then(|| {
        let count = Literal::usize_unsuffixed(layout.rows());
        quote! {
            /// Number of constraint equations.
            pub const CONSTRAINTS: usize = #count;
            /// Names of the constraint equations, in order.
            pub const EQUATIONS: &[&str] = &[#(#rows),*];
        }
    });
    let picture = loops::picture(context).filter(|_| layout.rows() > 0).map(|picture| {
        quote! {
            /// The Jacobian of the constraint equations, one string for each: `x` where an entry is not always zero, `.`
            /// where it is.
            pub const JACOBIAN: &[&str] = &[#(#picture),*];
        }
    });
    let centres = layout.structure.dead_centres.iter().map(|centre| layout.coordinate(*centre));
    let centres = context.function(FunctionKind::DeadCentres).map(|_| {
        quote! {
            /// The coordinates whose dead centres `dead_centres` tells of, in order.
            pub const DEAD_CENTRES: &[&str] = &[#(#centres),*];
        }
    });
    quote! {
        /// Names of the components of a velocity, in order.
        pub const COORDINATES: &[&str] = &[#(#coordinates),*];
        #rows
        #picture
        #centres
    }
}
