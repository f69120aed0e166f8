//! Stage `syntax`: the syntax tree, as close to the user's tokens as it can be.
//!
//! In: nothing. Out: the types that the parser fills and `model` reads. No name is resolved here, no value computed.
//!
//! What could not be read is reported by the parser and kept as a placeholder, so that one mistake doesn't cause forty:
//! an expression is [`poisoned`], a type is [`poisoned_type`], a kind is [`UNREADABLE`]; lost fields set
//! [`Fields::broken`], lost items [`Module::broken`]. Later stages stay silent about what these stand for.

use proc_macro2::{Ident, Span, TokenStream};
use syn::{Attribute, Expr, Path, Type, Visibility};

/// The name of a kind (`joint elbow: ?? { .. }`) that could not be read and has been reported.
pub const UNREADABLE: &str = "_";

/// A placeholder for an expression that has been reported: no later stage speaks of it again.
pub fn poison() -> Expr {
    Expr::Verbatim(TokenStream::new())
}

/// Whether `expr` is the placeholder that [`poison`] makes; it stands alone, never inside another expression.
pub fn poisoned(expr: &Expr) -> bool {
    matches!(expr, Expr::Verbatim(_))
}

/// A placeholder for a type that has been reported.
pub fn poison_type() -> Type {
    Type::Verbatim(TokenStream::new())
}

/// Whether `ty` is the placeholder that [`poison_type`] makes.
pub fn poisoned_type(ty: &Type) -> bool {
    matches!(ty, Type::Verbatim(_))
}

/// All that stands inside one `multibody! { .. }`.
pub struct Source {
    /// `#![krate(::mb)]`: where the runtime crate is found, `::multibody` if not said.
    pub krate: Option<Path>,
    /// `@fused`, which the runtime's macro says with its feature `fma`.
    pub fused: bool,
    /// Whether serde writes and reads generated structs, which the runtime asks for with its feature `serde`.
    pub serialised: bool,
    /// Models and parts in source order; a module with ports is a part. Behind those of the call stand those that it uses.
    pub modules: Vec<Module>,
    /// Parts of this call that other calls may use.
    pub exports: Vec<Export>,
    /// A `use` was lost to an error already reported: what looks unknown may be what it named.
    pub lost: bool,
    /// Parts of other calls that are asked for. Then nothing else of the call is read yet.
    pub pending: Option<Pending>,
}

impl Source {
    /// Functions of the user's own Rust, of all modules in their order.
    pub fn externals(&self) -> impl Iterator<Item = &External> {
        let items = self.modules.iter().flat_map(|module| &module.items);
        items.filter_map(|item| match &item.kind {
            ItemKind::External(function) => Some(function),
            _ => None,
        })
    }
}

/// A part of this call, as tokens that another call reads.
pub struct Export {
    /// Its place in [`Source::modules`].
    pub module: usize,
    /// Of `@part(..)`: the version of the language, the part's name, and the modules that it needs.
    pub tokens: TokenStream,
}

impl Export {
    /// The same where the call has a mistake: those who use the part hear nothing more of it.
    pub fn withheld(&self) -> TokenStream {
        self.tokens.clone().into_iter().take(2).collect()
    }
}

/// A call that can't go on before rustc has put in the parts that it uses.
pub struct Pending {
    /// What the next call begins with: where the runtime is, and what is known already.
    pub head: TokenStream,
    /// What the next call is: the path of the procedural macro.
    pub callback: TokenStream,
    /// At least one.
    pub uses: Vec<Use>,
    /// Modules of the call.
    pub rest: TokenStream,
}

/// `use robot_parts::leg as limb;`, of one part.
#[derive(Clone)]
pub struct Use {
    /// `robot_parts::leg`
    pub path: TokenStream,
    /// `limb`; the last name of the path where nothing else is said.
    pub name: Ident,
}

/// `pub mod name { .. }`
pub struct Module {
    /// Documentation, `cfg`, `allow`, .. as written.
    pub attrs: Vec<Attribute>,
    /// `pub`, `pub(crate)` or nothing.
    pub vis: Visibility,
    /// Of the generated module.
    pub name: Ident,
    /// In source order.
    pub items: Vec<Item>,
    /// An item was lost to an error already reported: what looks missing or unknown may be what was lost.
    pub broken: bool,
    /// All of the above as written.
    pub tokens: TokenStream,
    /// Whose it is.
    pub home: Home,
}

/// Where a module was declared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Home {
    /// In this call.
    Own,
    /// In another call, and named by a `use` of this one.
    Used,
    /// In another call; only parts from there know its name.
    Inner,
}

/// One declaration inside a module.
pub struct Item {
    /// Documentation, `#[cut]`, `#[allow(unphysical_inertia)]`.
    pub attrs: Vec<Attribute>,
    /// The keyword's span.
    pub keyword: Span,
    /// What is declared.
    pub kind: ItemKind,
}

/// What an item declares, by keyword.
pub enum ItemKind {
    /// `const NAME: Ty = value;`
    Const(Value),
    /// `param name: Ty = default;`
    Param(Value),
    /// `input name: Ty;`
    Input(Value),
    /// `let name = value;`
    Let(Value),
    /// `let name(x, y) = value;`
    Function(Function),
    /// `extern name(x, y) = crate::path::Type;`
    External(External),
    /// `output name: Ty = value;`
    Output(Value),
    /// `speed name = value;`
    Speed(Value),
    /// `state name: rate = value, start: value;`
    State {
        /// After the keyword.
        name: Ident,
        /// Its derivative by time.
        rate: Expr,
        /// Its value at the beginning.
        start: Option<Expr>,
    },
    /// `port name: Frame;`
    Port {
        /// After the keyword.
        name: Ident,
        /// `Frame`, `Joint`, `Scalar` or `Vec3`.
        ty: Ident,
        /// The same as a value without a value: what stands for it in a part by itself.
        signal: Value,
    },
    /// `world { .. }`
    World(Fields),
    /// `formulation { .. }`
    Formulation(Fields),
    /// `body name { .. }`
    Body {
        /// After the keyword.
        name: Ident,
        /// Between the braces.
        fields: Fields,
    },
    /// `joint name: Kind { .. }`
    Joint {
        /// After the keyword.
        name: Ident,
        /// After the colon.
        kind: Ident,
        /// Between the braces.
        fields: Fields,
    },
    /// `force name: Kind { .. }`
    Force {
        /// After the keyword.
        name: Ident,
        /// After the colon.
        kind: Ident,
        /// Between the braces.
        fields: Fields,
    },
    /// `part name: leg { .. };` or `part name: [leg; 6] = |i| leg { .. };`
    Part(Part),
    /// `constraint name = value;`
    ConstraintValue {
        /// After the keyword.
        name: Ident,
        /// Held at zero.
        value: Expr,
    },
    /// `constraint name: Rod { .. }`
    ConstraintKind {
        /// After the keyword.
        name: Ident,
        /// After the colon.
        kind: Ident,
        /// Between the braces.
        fields: Fields,
    },
    /// `drive target = value;`
    Drive {
        /// A coordinate.
        target: Expr,
        /// What it follows.
        value: Expr,
    },
    /// `solve (unknowns) = (formulas);`, `solve (unknowns) from joint { branches }` or `from (joint, joint) { branches }`
    Solve {
        /// Between the parentheses.
        unknowns: Vec<Expr>,
        /// The formulas, or where to find them.
        how: Solution,
    },
    /// `solve (x, y) from [a == b, c == d];`, of unknowns that are declared here.
    System {
        /// Names.
        unknowns: Vec<Expr>,
        /// Comparisons by `==`.
        equations: Vec<Expr>,
        /// Conditions that choose one solution.
        branches: Vec<Expr>,
    },
    /// `assume condition;`
    Assume(Expr),
    /// `simplify small(hinge);`: first order in these coordinates and their rates.
    Small(Vec<Expr>),
    /// `simplify current.rate == 0.0;`: the state follows from its equation.
    Settled(Expr),
    /// `emit a, b { field: value };`
    Emit(Vec<Request>),
}

/// `name: Ty = value`, with those parts that the item has.
pub struct Value {
    /// After the keyword.
    pub name: Ident,
    /// `Scalar`, `Vec3`, .. (one plain name) or an array `[Ty; count]`.
    pub ty: Option<Type>,
    /// After the `=`; present on all but `input`.
    pub value: Option<Expr>,
}

/// `name(x, y) = value`, expanded where it is called.
pub struct Function {
    /// After the keyword.
    pub name: Ident,
    /// Between the parentheses: at least one, unless the item was reported and its value is poisoned.
    pub parameters: Vec<Ident>,
    /// After the `=`.
    pub value: Expr,
}

/// `name(x, y) = path`, a function of the user's own Rust.
pub struct External {
    /// After the keyword.
    pub name: Ident,
    /// Between the parentheses: at least one, unless the item was reported and its path is empty.
    pub parameters: Vec<Ident>,
    /// After the `=`: of a type, as written.
    pub path: TokenStream,
}

/// `{ name: value, .. }`
pub struct Fields {
    /// The braces.
    pub span: Span,
    /// In source order, twice the same name included.
    pub list: Vec<Field>,
    /// A field was lost to an error already reported: no field is missing for sure.
    pub broken: bool,
}

impl Fields {
    /// Not one field, for an item of which nothing more could be read.
    pub fn none(span: Span) -> Fields {
        Fields { span, list: Vec::new(), broken: true }
    }
}

/// `name: value`
pub struct Field {
    /// Before the colon.
    pub name: Ident,
    /// After it.
    pub value: Expr,
}

/// One sub-model, or an array of them.
pub struct Part {
    /// After the keyword.
    pub name: Ident,
    /// The type of the part.
    pub kind: Ident,
    /// `[leg; count]`
    pub count: Option<Expr>,
    /// `|i|`
    pub index: Option<Ident>,
    /// Of an array: the type once more, behind the index.
    pub again: Option<Ident>,
    /// Ports and parameters.
    pub fields: Fields,
}

/// How `solve` gets its formulas.
pub enum Solution {
    /// Written by the user, one for each unknown.
    Formulas(Vec<Expr>),
    /// Found by the macro.
    From {
        /// What closes the loop, or the loops.
        closings: Vec<Expr>,
        /// Conditions that choose one branch.
        branches: Vec<Expr>,
    },
}

/// One name in `emit`, with its options.
pub struct Request {
    /// A function of the generated model.
    pub name: Ident,
    /// Between the braces, if there are any.
    pub options: Option<Fields>,
}
