//! The checked model: names, parts, types, loops; what is said about mistakes.

mod errors;
mod imports;
mod joint_kinds;
mod loops;
mod parts;
mod robust;
mod samples;
mod support;
