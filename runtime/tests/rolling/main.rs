//! Wheels, blades and spheres: constraints of velocities, and contacts that give way.

mod blades;
mod contacts;
mod wheels;
mod whipple;
