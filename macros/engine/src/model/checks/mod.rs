//! Room `checks`: what is refused of a model for its values, in numbers at the declared defaults.

mod changing_mass;
pub(super) mod configuration;
pub(crate) mod evaluate;
mod mass_matrix;
mod massless;
pub(super) mod matrix3;
pub(crate) mod placement;
pub(super) mod spatial;
mod weightless;
