//! What is written for readers: the equations of every model of the project against its compiled functions, and how formulas are
//! set.

#[path = "../common/corpus.rs"]
#[allow(dead_code)]
mod corpus;
#[path = "../common/interpreter.rs"]
mod interpreter;
#[path = "../common/pages.rs"]
#[allow(dead_code)]
mod pages;

mod documented;
mod faithful;
mod folded;
mod large;
mod leg;
mod reader;
mod readme;
mod setting;
mod textbook;
mod values;
