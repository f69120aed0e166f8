//! From expressions to programs: every pass, blocks, literals that are exact.

#[allow(dead_code, reason = "other areas use the rest")]
#[path = "../common/arms.rs"]
mod arms;
mod blocks;
#[allow(dead_code, reason = "other areas use the rest")]
#[path = "../common/corpus.rs"]
mod corpus;
mod exact_literals;
#[allow(dead_code, reason = "other areas use the rest")]
#[path = "../common/expressions.rs"]
mod expressions;
#[path = "../common/formulations.rs"]
mod formulations;
mod fuse;
#[path = "../common/interpreter.rs"]
mod interpreter;
mod order;
mod packs;
mod passes;
#[path = "../common/rebuild.rs"]
mod rebuild;
#[path = "../common/rng.rs"]
mod rng;
mod together;
mod wording;
