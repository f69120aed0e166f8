//! Stage `emit`: types of single fields in generated structs.
//!
//! In: kinds of joints and types of values. Out: for each the Rust type, how to reach one of its scalars, and how to
//! build it from scalars. The names of the runtime's structs of coordinates stand in the table of joint kinds.

use proc_macro2::{Literal, TokenStream, TokenTree};
use quote::{ToTokens, quote};
use syn::Path;

use crate::emit::names;
use crate::invariant::fault::OrFault;
use crate::model::joint_kinds::{self, JointKind};
use crate::model::types::{Orientation, Type};

/// A field's type.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::emit) enum Leaf {
    Scalar,
    Vec3,
    /// `UnitQuaternion`: w, i, j, k.
    Quaternion,
    /// `Rotation3`: 9, row by row.
    Rotation,
    /// 6 rows, row by row.
    Jacobian(usize),
    /// A struct of the runtime.
    Struct(&'static Struct),
    /// The runtime's struct of a joint's coordinates, all scalars.
    Coordinates(&'static JointKind),
    Array(Box<Leaf>, usize),
}

/// A struct of the runtime and its fields.
#[derive(Debug, PartialEq)]
pub(in crate::emit) struct Struct {
    pub(in crate::emit) name: &'static str,
    fields: &'static [(&'static str, Leaf)],
}

const FREE_ROLL_PITCH_YAW: &Struct = &Struct {
    name: "FreeRollPitchYaw",
    fields: &[("position", Leaf::Vec3), ("orientation", Leaf::Coordinates(&joint_kinds::BALL_BY_ANGLES))],
};
const POSE: &Struct = &Struct { name: "Pose", fields: &[("position", Leaf::Vec3), ("orientation", Leaf::Quaternion)] };
const PLACEMENT: &Struct =
    &Struct { name: "Placement", fields: &[("position", Leaf::Vec3), ("rotation", Leaf::Rotation)] };
const TWIST: &Struct = &Struct { name: "Twist", fields: &[("linear", Leaf::Vec3), ("angular", Leaf::Vec3)] };
const WRENCH: &Struct = &Struct { name: "Wrench", fields: &[("force", Leaf::Vec3), ("moment", Leaf::Vec3)] };

impl Leaf {
    /// Of a joint's position; nothing where it has no coordinates.
    pub(in crate::emit) fn position(kind: &'static JointKind) -> Option<Leaf> {
        match (kind.has_quaternion(), kind.is_free()) {
            (true, false) => Some(Leaf::Quaternion),
            (true, true) => Some(Leaf::Struct(POSE)),
            (false, _) => Leaf::velocity(kind),
        }
    }

    /// Of a joint's velocity, acceleration or effort.
    pub(in crate::emit) fn velocity(kind: &'static JointKind) -> Option<Leaf> {
        Some(match (kind.orientation, kind.is_free()) {
            (Some(Orientation::Quaternion), false) => Leaf::Vec3,
            (Some(Orientation::Quaternion), true) => Leaf::Struct(TWIST),
            (Some(Orientation::RollPitchYaw), true) => Leaf::Struct(FREE_ROLL_PITCH_YAW),
            (Some(Orientation::RollPitchYaw), false) | (None, _) => match kind.freedoms() {
                0 => return None,
                1 => Leaf::Scalar,
                _ => Leaf::Coordinates(kind),
            },
        })
    }

    /// Of a body's pose as `poses` gives it: 3, then 9 row by row.
    pub(in crate::emit) fn placement() -> Leaf {
        Leaf::Struct(PLACEMENT)
    }

    /// Of a param, an input or an output.
    pub(in crate::emit) fn value(ty: &Type, dof: usize) -> Leaf {
        match ty {
            Type::Scalar | Type::Bool => Leaf::Scalar,
            Type::Vec3 => Leaf::Vec3,
            Type::Rotation => Leaf::Rotation,
            Type::Pose => Leaf::Struct(POSE),
            Type::Twist => Leaf::Struct(TWIST),
            Type::Wrench => Leaf::Struct(WRENCH),
            Type::Jacobian => Leaf::Jacobian(dof),
            Type::Array(element, count) => Leaf::Array(Box::new(Leaf::value(element, dof)), *count),
        }
    }

    /// Whether it is the struct of a free body by angles, of its position or of its rates.
    pub(in crate::emit) fn is_free_by_angles(&self) -> bool {
        *self == Leaf::Struct(FREE_ROLL_PITCH_YAW)
    }

    /// Number of scalars.
    pub(in crate::emit) fn size(&self) -> usize {
        match self {
            Leaf::Scalar => 1,
            Leaf::Vec3 => 3,
            Leaf::Quaternion => 4,
            Leaf::Rotation => 9,
            Leaf::Jacobian(dof) => 6 * dof,
            Leaf::Struct(of) => of.fields.iter().map(|(_, leaf)| leaf.size()).sum(),
            Leaf::Coordinates(kind) => kind.freedoms(),
            Leaf::Array(element, count) => element.size() * count,
        }
    }

    /// Whether a unit quaternion is in it: then a sum of vectors is not a position.
    pub(in crate::emit) fn has_quaternion(&self) -> bool {
        match self {
            Leaf::Quaternion => true,
            Leaf::Struct(of) => of.fields.iter().any(|(_, leaf)| leaf.has_quaternion()),
            Leaf::Array(element, _) => element.has_quaternion(),
            Leaf::Scalar | Leaf::Vec3 | Leaf::Rotation | Leaf::Jacobian(_) | Leaf::Coordinates(_) => false,
        }
    }

    /// Whether it compares only where the scalar is more than `PartialEq`, so that a derived comparison fails.
    pub(in crate::emit) fn compares_by_hand(&self) -> bool {
        match self {
            Leaf::Rotation | Leaf::Quaternion => true,
            Leaf::Struct(of) => of.fields.iter().any(|(_, leaf)| leaf.compares_by_hand()),
            Leaf::Array(element, _) => element.compares_by_hand(),
            Leaf::Scalar | Leaf::Vec3 | Leaf::Jacobian(_) | Leaf::Coordinates(_) => false,
        }
    }

    /// Expands to the type, such as `::multibody::nalgebra::Vector3<T>`.
    pub(in crate::emit) fn ty(&self, krate: &Path) -> TokenStream {
        match self {
            Leaf::Scalar => quote!(T),
            Leaf::Vec3 => quote!(#krate::nalgebra::Vector3<T>),
            Leaf::Quaternion => quote!(#krate::nalgebra::UnitQuaternion<T>),
            Leaf::Rotation => quote!(#krate::nalgebra::Rotation3<T>),
            Leaf::Jacobian(dof) => {
                let dof = Literal::usize_unsuffixed(*dof);
                quote!(#krate::nalgebra::SMatrix<T, 6, #dof>)
            }
            Leaf::Struct(Struct { name, .. }) | Leaf::Coordinates(JointKind { struct_name: name, .. }) => {
                let name = names::ident(name);
                quote!(#krate::#name<T>)
            }
            Leaf::Array(element, count) => {
                let (element, count) = (element.ty(krate), Literal::usize_unsuffixed(*count));
                quote!([#element; #count])
            }
        }
    }

    /// Expands to the path of scalar number `component` behind a field, such as `[3].x`.
    pub(in crate::emit) fn access(&self, component: usize) -> TokenStream {
        match self {
            Leaf::Scalar | Leaf::Rotation | Leaf::Jacobian(_) => TokenStream::new(),
            Leaf::Vec3 => member(&["x", "y", "z"], component),
            Leaf::Quaternion => member(&["w", "i", "j", "k"], component),
            Leaf::Struct(of) => {
                let mut rest = component;
                for (name, leaf) in of.fields {
                    if rest < leaf.size() {
                        let (name, inner) = (names::ident(name), leaf.access(rest));
                        return quote!(.#name #inner);
                    }
                    rest -= leaf.size();
                }
                TokenStream::new()
            }
            Leaf::Coordinates(kind) => member(&kind.coordinates(), component),
            Leaf::Array(element, _) => {
                let size = element.size().max(1);
                let (index, inner) = (Literal::usize_unsuffixed(component / size), element.access(component % size));
                quote!([#index] #inner)
            }
        }
    }

    /// Expands to a value made of scalars, taken in order; constructors that can't panic. Quaternions are unit already.
    pub(in crate::emit) fn build(&self, krate: &Path, scalars: &mut dyn Iterator<Item = TokenStream>) -> TokenStream {
        self.compose(krate, scalars, &|list| {
            quote! {
                #krate::nalgebra::UnitQuaternion::new_unchecked(
                    #krate::nalgebra::Quaternion::new(#(#list),*)
                )
            }
        })
    }

    /// The same from any numbers: quaternions are normalised.
    pub(in crate::emit) fn build_normalised(
        &self,
        krate: &Path,
        scalars: &mut dyn Iterator<Item = TokenStream>,
    ) -> TokenStream {
        self.compose(krate, scalars, &|list| quote!(#krate::rotation::normalized(#(#list),*)))
    }

    fn compose(
        &self,
        krate: &Path,
        scalars: &mut dyn Iterator<Item = TokenStream>,
        quaternion: &dyn Fn(&[TokenStream]) -> TokenStream,
    ) -> TokenStream {
        match self {
            Leaf::Scalar => next(scalars),
            Leaf::Vec3 => {
                let list = (0..3).map(|_| element(next(scalars)));
                quote!(#krate::nalgebra::Vector3::from([#(#list),*]))
            }
            Leaf::Quaternion => quaternion(&[(); 4].map(|()| next(scalars))),
            Leaf::Rotation => {
                let matrix = matrix(krate, 3, 3, scalars);
                quote!(#krate::nalgebra::Rotation3::from_matrix_unchecked(#matrix))
            }
            Leaf::Jacobian(dof) => matrix(krate, 6, *dof, scalars),
            Leaf::Struct(of) => {
                let name = names::ident(of.name);
                let fields = of.fields.iter().map(|(field, leaf)| {
                    let (field, value) = (names::ident(field), leaf.compose(krate, scalars, quaternion));
                    initialiser(&field, &value)
                });
                quote!(#krate::#name { #(#fields),* })
            }
            Leaf::Coordinates(kind) => {
                let name = names::ident(kind.struct_name);
                let fields = kind.freedoms.iter().map(|freedom| {
                    let field = names::ident(freedom.name);
                    initialiser(&field, &next(scalars))
                });
                quote!(#krate::#name { #(#fields),* })
            }
            Leaf::Array(leaf, count) => {
                let list = (0..*count).map(|_| element(leaf.compose(krate, scalars, quaternion)));
                quote!([#(#list),*])
            }
        }
    }

    /// Expands to the value at the start: zero, or the identity.
    pub(in crate::emit) fn default(&self, krate: &Path) -> TokenStream {
        match self {
            Leaf::Scalar => quote!(T::lit(0.0)),
            Leaf::Vec3 => quote!(#krate::nalgebra::Vector3::zeros()),
            Leaf::Quaternion => quote!(#krate::nalgebra::UnitQuaternion::identity()),
            Leaf::Rotation => quote!(#krate::nalgebra::Rotation3::identity()),
            Leaf::Jacobian(_) => quote!(#krate::nalgebra::SMatrix::zeros()),
            Leaf::Struct(Struct { name, .. }) | Leaf::Coordinates(JointKind { struct_name: name, .. }) => {
                let name = names::ident(name);
                quote!(#krate::#name::default())
            }
            Leaf::Array(element, count) => {
                let (element, count) = (element.default(krate), Literal::usize_unsuffixed(*count));
                quote!([#element; #count])
            }
        }
    }
}

/// Expands to `field: value`, or to `field` where that says the same.
pub(in crate::emit) fn initialiser(field: &impl ToTokens, value: &TokenStream) -> TokenStream {
    let mut tokens = value.clone().into_iter();
    let single = tokens.next().filter(|_| tokens.next().is_none());
    let name = field.to_token_stream().to_string();
    if single.is_some_and(|token| token.to_string() == name) { value.clone() } else { quote!(#field: #value) }
}

/// Expands to an element of an array: a difference or product in parentheses, since all of a call's tokens stand at one
/// place in the user's file, and clippy takes an operator that follows a line break for a missing comma.
pub(in crate::emit) fn element(value: TokenStream) -> TokenStream {
    let operator = |token: &TokenTree| matches!(token, TokenTree::Punct(p) if matches!(p.as_char(), '-' | '*'));
    if value.clone().into_iter().skip(1).any(|token| operator(&token)) { quote!((#value)) } else { value }
}

/// Expands to a matrix from entries that come row by row; nalgebra's arrays are columns.
pub(in crate::emit) fn matrix(
    krate: &Path,
    rows: usize,
    columns: usize,
    scalars: &mut dyn Iterator<Item = TokenStream>,
) -> TokenStream {
    if rows * columns == 0 {
        return quote!(#krate::nalgebra::SMatrix::zeros());
    }
    let entries: Vec<TokenStream> = (0..rows * columns).map(|_| element(next(scalars))).collect();
    let columns = (0..columns).map(|column| {
        let list = entries.iter().skip(column).step_by(columns.max(1));
        quote!([#(#list),*])
    });
    quote!(#krate::nalgebra::SMatrix::from([#(#columns),*]))
}

fn next(scalars: &mut dyn Iterator<Item = TokenStream>) -> TokenStream {
    scalars.next().or_fault("a leaf takes as many scalars as it has")
}

fn member(names: &[&str], component: usize) -> TokenStream {
    let name = names::ident(names[component]);
    quote!(.#name)
}
