//! What is generated, and what is said instead: text, interface, statements, instructions, errors.

mod expanded;
mod fuzz;
mod interface;
mod loop_errors;
mod parameters;
mod single_precision;
mod statements;
