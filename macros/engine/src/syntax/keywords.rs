//! Stage `syntax`: every keyword, once.
//!
//! In: a word at the start of an item. Out: the item it starts, how that item is written, and what a near miss or a
//! word of another language was probably meant to be.

use proc_macro2::Ident;

use crate::diagnostics::nearest;

macro_rules! keywords {
    ($($(#[$doc:meta])* $name:ident $word:literal $form:literal,)*) => {
        /// The word that starts an item.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Keyword {
            $($(#[$doc])* $name,)*
        }

        impl Keyword {
            /// All of them, in the order of the documentation.
            pub const ALL: &[Keyword] = &[$(Keyword::$name),*];

            /// As the user writes it.
            pub fn word(self) -> &'static str {
                match self {
                    $(Keyword::$name => $word,)*
                }
            }

            /// How the whole item is written, for error messages.
            pub fn form(self) -> &'static str {
                match self {
                    $(Keyword::$name => $form,)*
                }
            }
        }
    };
}

keywords! {
    /// A literal in the code.
    Const "const" "const NAME = 1.0;",
    /// A field of `Params`.
    Param "param" "param name = 1.0;",
    /// A field of `Input`.
    Input "input" "input name: Scalar;",
    /// A named expression.
    Let "let" "let name = value;",
    /// A function of the user's own Rust.
    Extern "extern" "extern name(x, y) = crate::path::Type;",
    /// What surrounds the mechanism.
    World "world" "world { gravity: -9.81 * Z }",
    /// How equations are set up.
    Formulation "formulation" "formulation { coordinates: Joint }",
    /// A rigid body or point mass.
    Body "body" "body name { mass: 1.0 }",
    /// A connection of two frames.
    Joint "joint" "joint name: Revolute { parent: ground, child: body, axis: Z }",
    /// A force, torque, spring or damper.
    Force "force" "force name: Effort { joint: elbow, value: 1.0 }",
    /// An expression held at zero, or a rod.
    Constraint "constraint" "constraint name = value;",
    /// A velocity coordinate of the user's choice.
    Speed "speed" "speed name = value;",
    /// A coordinate that follows an expression.
    Drive "drive" "drive joint.angle = value;",
    /// Closed form of coordinates.
    Solve "solve" "solve (a, b) from joint { a > 0.0 }",
    /// A frame that a part is connected by.
    Port "port" "port name: Frame;",
    /// A sub-model, or an array of them.
    Part "part" "part name: kind { port: frame };",
    /// A differential equation of the user's own.
    State "state" "state name: rate = value, start: 0.0;",
    /// A promise about the mechanism.
    Assume "assume" "assume value > 0.0;",
    /// What is left out, or taken to first order.
    Simplify "simplify" "simplify hinge == 0.0;",
    /// A field of `Output`.
    Output "output" "output name = value;",
    /// What to derive.
    Emit "emit" "emit forward_dynamics;",
}

/// Words that people bring from elsewhere, and the items they are looking for.
const ELSEWHERE: &[(&str, Keyword)] = &[
    ("link", Keyword::Body),
    ("segment", Keyword::Body),
    ("parameter", Keyword::Param),
    ("constant", Keyword::Const),
    ("static", Keyword::Const),
    ("var", Keyword::Let),
    ("variable", Keyword::Let),
    ("gravity", Keyword::World),
    ("spring", Keyword::Force),
    ("damper", Keyword::Force),
    ("torque", Keyword::Force),
    ("assert", Keyword::Assume),
    ("derive", Keyword::Emit),
];

impl Keyword {
    /// The keyword that `name` is.
    pub fn of(name: &Ident) -> Option<Keyword> {
        Self::ALL.iter().copied().find(|keyword| name == keyword.word())
    }

    /// The keyword that `name` is a misspelling of.
    pub fn near(name: &Ident) -> Option<Keyword> {
        let word = nearest(&name.to_string(), Self::ALL.iter().map(|keyword| keyword.word()))?;
        Self::ALL.iter().copied().find(|keyword| keyword.word() == word)
    }

    /// The keyword that somebody who writes `name` is looking for; the item is written in another way.
    pub fn meant_by(name: &Ident) -> Option<Keyword> {
        ELSEWHERE.iter().find(|(word, _)| name == word).map(|(_, keyword)| *keyword)
    }

    /// All words, as a list for error messages.
    pub fn list() -> String {
        let words: Vec<String> = Self::ALL.iter().map(|keyword| format!("`{}`", keyword.word())).collect();
        words.join(", ")
    }
}
