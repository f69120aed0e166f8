//! Room `results`: one file per thing that generated functions give, made of the tree's algorithms and of what takes the
//! place of dependent coordinates.

pub(super) mod accelerations;
pub(super) mod actuation;
pub(super) mod assembly;
pub(super) mod balls;
pub(super) mod centroidal;
pub(super) mod constrained;
pub(super) mod constraint_forces;
pub(super) mod dynamics;
pub(super) mod embedded;
pub(super) mod energy;
pub(super) mod euler_singularities;
pub(super) mod first_order;
pub(super) mod jacobian;
pub(super) mod jumps;
pub(super) mod kinks;
pub(super) mod linearisation;
pub(super) mod margins;
pub(super) mod momentum;
pub(super) mod outputs;
pub(super) mod parts;
pub(super) mod poses;
pub(super) mod reactions;
pub(super) mod state_space;
pub(super) mod systems;
