//! Wheels, blades and spheres: constraints of velocities, and contacts that give way.

#[macro_use]
mod bicycle;
#[macro_use]
mod speeds;

mod beside;
mod blades;
mod car;
mod contacts;
mod hinged;
mod known;
mod sleigh;
mod snakeboard;
mod steered;
mod touching;
mod wheels;
mod whipple;
