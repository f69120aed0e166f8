//! Stage `mechanics`: one derivation.
//!
//! In: a scene. Out: [`Equations`], a graph with the model's symbols and tree, to which the other files of this stage add
//! what is asked for and nothing else. Everything is made when it is first needed, once: a file that keeps what it made has
//! a cache whose fields it alone reads. What is kept follows from the scene and from the definitions of dependent
//! coordinates, which come first, so the order of later calls makes no difference. What varies is an argument.

use std::rc::Rc;

use crate::dynamics::columns::Columns;
use crate::model::types::Model;
use crate::symbolic::graph::Graph;

use super::loops::constraints::expression::Readings;
use super::loops::constraints::turns::KnownTurns;
use super::loops::known::Decided;
use super::loops::reduction::Reduction;
use super::loops::rotors::Rotors;
use super::results::accelerations::Accelerations;
use super::results::constrained::Residuals;
use super::results::constraint_forces::Holding;
use super::results::reactions::Transmitted;
use super::scene::Scene;
use super::translate::expressions::Memo;
use super::translate::forces::Forces;
use super::translate::frames::Links;
use super::translate::symbols::Symbols;
use super::trees::Trees;

/// One derivation.
pub struct Equations<'m> {
    pub scene: Rc<Scene<'m>>,
    pub g: Graph,
    pub(super) caches: Caches,
    /// Definitions of the coordinates outside the state, once they are found.
    pub(super) reduced: Option<Rc<Reduction>>,
    /// By derivations before this one.
    pub(super) decided: Decided<'m>,
    /// Nodes that the graph had before anything was asked for.
    pub(super) born: usize,
}

/// What was worked out already.
#[derive(Clone, Default)]
pub(super) struct Caches {
    pub memo: Memo,
    /// Links in world axes.
    pub world: Columns,
    pub links: Links,
    pub trees: Trees,
    pub forces: Forces,
    pub residuals: Residuals,
    pub readings: Readings,
    pub turns: KnownTurns,
    pub rotors: Rotors,
    pub accelerations: Accelerations,
    pub transmitted: Transmitted,
    pub holding: Holding,
}

impl<'m> Equations<'m> {
    /// With the tree built.
    pub fn new(g: Graph, scene: Scene<'m>) -> Self {
        let mut equations = Equations {
            scene: Rc::new(scene),
            g,
            caches: Caches::default(),
            reduced: None,
            decided: Decided::default(),
            born: 0,
        };
        let mechanism = Rc::new(equations.build());
        equations.scene = Rc::new(Scene { mechanism, ..(*equations.scene).clone() });
        equations.born = equations.g.size();
        equations
    }

    /// Of a model whose coordinates have no roles yet, in a graph of its own.
    pub fn plain(model: &'m Model) -> Self {
        let mut graph = Graph::new();
        let symbols = Symbols::new(&mut graph, model);
        Equations::new(graph, Scene::new(model, Rc::new(symbols)))
    }
}
