//! Algorithms on trees of links, in numbers: recursions, struts, references of other libraries.

#[path = "../common/arms.rs"]
mod arms;
mod embedded;
#[path = "../common/formulations.rs"]
mod formulations;
mod lumped;
#[path = "../common/on_graph.rs"]
mod on_graph;
#[path = "../common/plain.rs"]
mod plain;
#[path = "../common/random.rs"]
mod random;
mod reference_arms;
#[path = "../common/rng.rs"]
mod rng;
mod stewart_counts;
mod struts;
mod trees;
