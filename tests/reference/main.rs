//! Against truth from elsewhere: reference data of other programs, published solutions, plain arithmetic.

mod actuated;
mod assembled;
mod closed_forms;
mod derivatives;
mod formulas;
mod linearization;
mod loops;
mod manipulations;
mod motion;
mod placed;
mod random_models;
mod robots;
mod simulate;
mod stewart;
mod stiff;
