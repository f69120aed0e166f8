//! Wheels, blades and spheres: constraints of velocities, and contacts that give way.

mod blades;
mod contacts;
mod hinged;
mod speeds;
mod wheels;
mod whipple;
