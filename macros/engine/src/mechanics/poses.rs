//! Stage `mechanics`: frames in numbers, where the model stands by default.
//!
//! In: a model, its structure, frames. Out: their poses in the world with parameters at their defaults and time at zero:
//! coordinates at zero, orientations that turn nothing, loops closed as near to that as the analysis has found.

use std::rc::Rc;

use crate::contracts::symbol::Symbol;
use crate::model::types::{Expr, Frame, FrameQuantity, Model};
use crate::symbolic::evaluate::{Evaluator, Real};
use crate::symbolic::graph::{Graph, Scalar, SymbolId};

use super::equations::Equations;
use super::loops::structure::{Role, Structure};
use super::scene::Scene;
use super::translate::symbols::Symbols;

/// A frame in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// m
    pub origin: [f64; 3],
    /// Unit vectors along x, y, z.
    pub axes: [[f64; 3]; 3],
}

/// The model, standing still.
pub struct Still {
    /// Of the frames that were asked for.
    pub poses: Vec<Pose>,
    /// Values of the vectors that were asked for.
    pub vectors: Vec<[f64; 3]>,
    /// Whether all loops are closed there.
    pub is_closed: bool,
}

/// Frames, and vectors that depend on parameters at most, of a model that stands where it does by default.
pub fn still(model: &Model, structure: &Structure, frames: &[Frame], vectors: &[&Expr]) -> Still {
    // `solve` items say on which branch a loop is closed, whatever holds it in the generated functions.
    let held = !structure.rows.is_empty();
    let structure = &if held && !model.solves.is_empty() { structure.solved(model) } else { structure.clone() };
    let mut graph = Graph::new();
    let symbols = Symbols::new(&mut graph, model).with_structure(&mut graph, model, structure, structure.guesses());
    let scene = Scene { structure: structure.clone().into(), ..Scene::new(model, symbols.into()) };
    let mut equations = Equations::new(graph, scene);
    let closed = structure.closed.first();
    // What follows from others stands where the generated functions put it: on the branch that the user has chosen.
    let follows = structure.roles.iter().flatten().any(|role| *role != Role::State);
    let definitions = if follows { equations.reduce().ok() } else { None };
    let mut roots: Vec<Scalar> = frames.iter().flat_map(|frame| equations.pose(frame)).collect();
    for vector in vectors {
        let vector = equations.vector(vector);
        roots.extend(equations.g.components(vector));
    }
    let guessed = structure.guessed();
    let scene = Rc::clone(&equations.scene);
    let table = &scene.symbols.table;
    let value = |id: SymbolId| match table.get(id.0) {
        Some(&Symbol::Param { param, element }) => model.params[param].default[element],
        Some(&Symbol::State { state }) => model.states[state].start,
        Some(&Symbol::Guess { index }) => closed.and_then(|closed| closed.value(model, guessed[index])).unwrap_or(0.0),
        Some(&Symbol::Position { joint, component }) => match closed {
            Some(closed) => closed.positions[joint.0][component],
            // The real part of a quaternion.
            None => {
                let kind = model.joints[joint].kind;
                f64::from(u8::from(kind.has_quaternion() && component == kind.turning().start))
            }
        },
        _ => 0.0,
    };
    let run = |g: &Graph, roots: &[Scalar]| Evaluator::new(g, Real { symbols: &value }).run(roots);
    let mut numbers = run(&equations.g, &roots);
    if let Some(definitions) = &definitions {
        let finished = equations.finish(definitions, &roots);
        let defined = run(&equations.g, &finished);
        // Where the loops do not close in these coordinates of the state they stand as the analysis has found them.
        if defined.iter().all(|x| x.is_finite()) {
            numbers = defined;
        }
    }
    let (of_frames, of_vectors) = numbers.split_at(12 * frames.len());
    let triple = |list: &[f64], at: usize| [list[at], list[at + 1], list[at + 2]];
    let pose = |list: &[f64]| Pose {
        origin: triple(list, 0),
        axes: [0, 1, 2].map(|axis| [3, 6, 9].map(|row| list[row + axis])),
    };
    Still {
        poses: of_frames.chunks(12).map(pose).collect(),
        vectors: of_vectors.chunks(3).map(|list| triple(list, 0)).collect(),
        is_closed: closed.is_some() || !held && structure.guesses() == 0,
    }
}

impl Equations<'_> {
    /// The position of a frame's origin, then its rotation to the world row by row.
    pub(in crate::mechanics) fn pose(&mut self, frame: &Frame) -> Vec<Scalar> {
        let place = self.place(frame);
        let position = self.of_place(&place, FrameQuantity::Position).vector(&mut self.g);
        let position = self.g.components(position);
        let rows = self.frame_rows(&place);
        position.into_iter().chain(rows.into_iter().flatten()).collect()
    }
}
