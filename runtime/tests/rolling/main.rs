//! Constraints of velocities: wheels, blades and spheres that roll.

mod blades;
mod wheels;
mod whipple;
