//! Stage `dynamics`: algorithms on a tree of links, one per file. It knows no model, no tokens and no results: links,
//! coordinates and forces come in as expressions of the graph, and expressions go out.
//!
//! [`tree`] is what all recursions walk. Kinematics: [`kinematics`] and [`velocities`] in link axes, [`columns`] and
//! [`world`] in those of one link or the world, [`point_kinematics`] for single points. Dynamics: [`newton_euler`],
//! [`lumped`] (the same over links that turn together), [`composite`], [`composite_at_root`] (the same for long chains),
//! [`articulated`], [`embedded`] (the same where loops are solved), [`momentum`], [`energy`]; [`regroup`], [`slid_origins`], [`turned_ends`], [`shared_axes`] and
//! [`floating_bases`] say how a tree is written so that they cost less; [`saddle`] solves systems with constraints, in an
//! order that [`elimination`] finds.

pub mod articulated;
pub mod articulated_inertia;
pub mod columns;
pub mod composite;
pub mod composite_at_root;
pub mod elimination;
pub mod embedded;
pub mod energy;
pub mod floating_bases;
pub mod inertia;
mod kept_masses;
pub mod kinematics;
pub mod lumped;
pub mod momentum;
pub mod newton_euler;
pub mod point_kinematics;
pub mod regroup;
pub mod saddle;
pub mod shared_axes;
pub mod slid_origins;
pub mod tree;
pub mod turned_ends;
pub mod velocities;
pub mod world;
