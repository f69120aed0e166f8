//! What holds whatever the numbers: conservation, power, impulses, two descriptions of one mechanism.

mod at;
mod changing_mass;
mod hopper;
mod impulse;
mod iterated;
mod limbs;
mod loops;
mod momentum;
mod output_groups;
mod packs;
mod power_balance;
mod struts_in_packs;
mod trees;
