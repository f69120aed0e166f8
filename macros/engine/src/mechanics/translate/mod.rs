//! Room `translate`: from the checked model to the tree of links and to values of its expressions; it decides nothing about
//! loops and makes no function.

pub(super) mod agreement;
pub mod balls;
pub mod build;
mod chain;
pub(super) mod dependencies;
pub(super) mod directions;
pub(super) mod division;
pub(super) mod expressions;
pub(super) mod forces;
pub(super) mod formulas;
pub(super) mod frames;
mod functions;
pub(super) mod manipulations;
pub(super) mod names;
pub(super) mod orientation;
pub(super) mod reads;
mod springs;
pub mod symbols;
pub mod time;
mod typed;
pub(super) mod values;
