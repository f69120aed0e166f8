//! Generated code of the same models, whole and in parts.

/// As the macro writes it.
// Both lints pass over what macros write, and this is no macro.
#[allow(clippy::all, unused_variables)]
pub mod whole {
    include!(concat!(env!("OUT_DIR"), "/whole/walker.rs"));
    include!(concat!(env!("OUT_DIR"), "/whole/linkage.rs"));
}

/// With all functions of some operations in parts.
#[allow(clippy::all, unused_variables)]
pub mod cut {
    include!(concat!(env!("OUT_DIR"), "/cut/walker.rs"));
    include!(concat!(env!("OUT_DIR"), "/cut/linkage.rs"));

    /// The text, in which the tests look for parts.
    pub const TEXT: [&str; 2] = [
        include_str!(concat!(env!("OUT_DIR"), "/cut/walker.rs")),
        include_str!(concat!(env!("OUT_DIR"), "/cut/linkage.rs")),
    ];
}
