//! Types that several stages speak, where the stages meet: none of these files knows a stage behind the model.
//!
//! [`call`] and [`cost`] say which functions there are in expressions and what work costs, [`symbol`] what a symbol stands
//! for, [`function`] which functions are generated, [`results`] what they give.

pub mod call;
pub mod cost;
pub mod function;
pub mod results;
pub mod symbol;
