//! Methods: order, steps, events, how they fail, equilibria; and what holds of every system.

mod adaptive;
#[path = "../common/mod.rs"]
mod common;
mod compensated;
mod driver;
mod equilibrium;
mod events;
mod failures;
mod generalised_alpha;
mod order;
mod order_symplectic;
mod own_steps;
mod radau;
mod sampled;
mod speeds;
mod verify;
mod without_inertia;
mod wrappers;
