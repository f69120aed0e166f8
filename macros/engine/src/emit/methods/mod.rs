//! Room `methods`: the methods of `Model`: what they take, their bodies, what they give back.

pub(super) mod arguments;
pub(super) mod functions;
mod in_parts;
pub(super) mod results;
