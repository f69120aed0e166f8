//! Mechanisms as users write them, compiled once for all tests.

pub mod actuated;
pub mod arms;
pub mod assembled;
pub mod energy;
pub mod extremes;
pub mod formulas;
pub mod hundred_rods;
pub mod impulses;
pub mod iterated;
pub mod laws;
pub mod limbs;
pub mod linearised;
pub mod linkages;
pub mod loops;
pub mod manipulations;
pub mod mechanisms;
pub mod motion;
pub mod placed;
pub mod random;
pub mod required;
pub mod rows;
pub mod small;
pub mod state_space;
pub mod stewart;
pub mod stiff;
pub mod tanks;
