//! Room `written`: which equations are written for readers, and what each of them says.
//!
//! In: one derivation on the tree, definitions of dependent coordinates. Out: a [`Page`]: sections of lines, each an equation
//! with what it states ([`Subject`]), so that a check can hold it against the generated functions.
//!
//! Coordinates outside the state stay symbols here, with equations of their own: a loop's equations of motion in joint angles are
//! short, and in the state alone nobody would read them. Generated code takes whatever is cheapest, so the page says what the
//! functions compute and not how.

mod apart;
pub mod domains;
pub mod folded;
mod following;
mod letters;
pub mod names;
mod order;
mod quotients;
mod rows;
mod sections;
mod solved;

use std::collections::{HashMap, HashSet};

use crate::contracts::symbol::Symbol;
use crate::model::types::Coordinate;
use crate::symbolic::write::formula::{Equation, Identifier};
use crate::symbolic::write::{latex, mathml};

use super::loops::structure::Row;

/// Equations of a model.
#[derive(Clone, Debug, Default)]
pub struct Page {
    pub sections: Vec<Section>,
    /// Symbols of the equations, by number in the graph.
    pub symbols: Vec<(Identifier, Symbol)>,
    /// Coordinates whose rates are found by elimination with pivots, so that the page has no formula for them.
    pub unsolved: Vec<Coordinate>,
}

impl Page {
    /// Names that would look alike as a letter with an index, `l1` and `l_1`, are set as they are typed.
    fn tell_apart(&mut self) {
        let mut alike: HashMap<String, HashSet<Identifier>> = HashMap::new();
        self.each_name(&mut |identifier| {
            for look in [latex::name(identifier), mathml::name(identifier)] {
                alike.entry(look).or_default().insert(identifier.clone());
            }
        });
        let typed: HashSet<Identifier> = alike.into_values().filter(|names| names.len() > 1).flatten().collect();
        self.each_name(&mut |identifier| identifier.typed |= typed.contains(identifier));
    }

    fn each_name(&mut self, visit: &mut dyn FnMut(&mut Identifier)) {
        self.symbols.iter_mut().for_each(|(identifier, _)| visit(identifier));
        for line in self.sections.iter_mut().flat_map(|section| &mut section.lines) {
            line.equation.left.each_name_mut(visit);
            line.equation.right.each_name_mut(visit);
        }
    }
}

/// Lines under one heading.
#[derive(Clone, Debug)]
pub struct Section {
    pub title: &'static str,
    /// What a reader must know of it: sentences in Markdown.
    pub says: Vec<String>,
    pub lines: Vec<Line>,
}

#[derive(Clone, Debug)]
pub struct Line {
    pub subject: Subject,
    pub equation: Equation,
    /// Where it holds, which branch was chosen, where it ends: Markdown.
    pub says: Option<String>,
}

/// What an equation states. Numbers of freedoms count the state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Subject {
    /// A value that is written apart.
    Definition,
    Mass(usize, usize),
    /// What velocities contribute, with accelerations of the state at zero.
    Inertial(usize),
    Gravity(usize),
    /// Declared forces.
    Force(usize),
    /// An equation of motion: `left - right` is the residual.
    Motion(usize),
    Position(Coordinate),
    /// Cosine and sine of a coordinate.
    Cosine(Coordinate),
    Sine(Coordinate),
    Rate(Coordinate),
    /// A prescribed coordinate, its rate or its acceleration.
    Driven(Coordinate, usize),
    /// The slope of a dependent coordinate by one of the state.
    Follows(Coordinate, usize),
    /// What is left of its acceleration where those of the state are zero.
    Rest(Coordinate),
    /// Its acceleration, where something reads it.
    Acceleration(Coordinate),
    /// What is zero where the loop is closed.
    Constraint(Row),
    /// What Newton's method makes zero.
    Closing(Row),
    /// Its slope along a velocity of the state.
    Slope(usize, usize),
    /// A component of an output, by its place among all.
    Output(usize),
    /// The rate of a state of the user's own.
    StateRate(usize),
    /// What a speed of the user's choice stands for.
    Speed(usize),
    /// What is zero in all motions, since rates follow from it.
    Rolling(Row),
}
