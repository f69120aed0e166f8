//! Room `loops`: which coordinates follow from others, and how: equations of what closes loops, their solutions, and what
//! takes the place of dependent coordinates.

pub mod advice;
pub(super) mod branches;
pub mod constraints;
pub(super) mod drives;
pub mod groups;
pub(super) mod known;
pub(super) mod loop_equations;
pub(super) mod newton;
pub(super) mod reduction;
pub(super) mod rotors;
pub mod solutions;
pub(super) mod speeds;
pub mod structure;
pub(super) mod verification;
