//! From the checked model to numbers: derived functions are interpreted on the graph and compared with plain f64
//! computations, with finite differences and with laws of mechanics.

mod actuation;
mod advice;
mod against;
mod alike;
mod analysis;
mod assembly;
mod auto;
mod balance;
mod balls;
mod centroidal;
mod changing_mass;
mod closed_forms;
mod closings;
mod closures;
mod every_formulation;
mod expressions;
mod forces;
mod formulations;
mod groups;
mod integrability;
#[path = "../common/interpreter.rs"]
mod interpreter;
mod iterated;
mod jacobians;
mod joints;
mod kinks;
mod loop_candidates;
mod loop_counts;
mod loops;
mod motion;
mod pin_slot;
mod poses;
mod random_loops;
mod random_outputs;
mod ranks;
mod rates;
mod reactions;
mod scaling;
mod several_closings;
mod speeds;
mod support;
mod systems;
mod tables;
mod translations;
mod worked;
