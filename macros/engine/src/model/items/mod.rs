//! Room `items`: one file per item of the language, from its fields to its place in the checked model.

pub(super) mod at;
pub(super) mod bodies;
pub(super) mod coordinates;
pub(super) mod fields;
pub(super) mod forces;
mod inertia;
pub(super) mod joints;
pub(super) mod loops;
pub(super) mod output_groups;
pub(super) mod parts;
pub(super) mod requests;
pub(super) mod solves;
pub(super) mod systems;
pub(super) mod values;
mod world;
