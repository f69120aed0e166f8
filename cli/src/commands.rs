//! One file per command.

pub(crate) mod check;
pub(crate) mod compare;
pub(crate) mod counts;
pub(crate) mod diff;
pub(crate) mod equations;
pub(crate) mod expand;
pub(crate) mod import;
pub(crate) mod report;
