//! Stage `mechanics`: what entries of matrices depend on, for readers.
//!
//! In: a model and its structure. Out: of every entry of the mass matrix and of the constraint Jacobian whether it is always
//! zero, a number, decided by parameters, or changing with the motion. Equal values are one node, so what cancels is gone
//! here, whatever the model asks to be emitted.

use crate::contracts::results::Results;
use crate::mechanics::analysis::Complaint;
use crate::mechanics::loops::structure::Structure;
use crate::model::types::Model;
use crate::symbolic::graph::{AnyNode, Scalar};

use super::Deriving;

/// What an entry of a matrix depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Entry {
    /// It is zero always.
    Zero,
    /// A number.
    Constant,
    /// On parameters alone.
    Parameters,
    /// On the configuration or the time.
    Varying,
}

/// Matrices row by row; a column for each coordinate of the state.
#[derive(Clone, Debug, Default)]
pub struct Patterns {
    pub mass: Vec<Entry>,
    /// Of the equations that keep multipliers.
    pub jacobian: Vec<Entry>,
}

/// The patterns of a model, with loops closed as they are in the generated functions.
pub fn patterns(model: &Model, structure: &Structure) -> Result<Patterns, Vec<Complaint>> {
    let mut deriving = Deriving::new(model, structure);
    deriving.choose_writing()?;
    let open = deriving.is_open();
    let mut split = 0;
    let found = deriving.only("", |e| {
        if open {
            let entries = e.mass_matrix();
            split = entries.len();
            return Ok(Results::vector(entries));
        }
        let reduction = e.reduce()?;
        let mut entries = e.reduced_mass_matrix(&reduction).concat();
        split = entries.len();
        entries.extend(e.constraint_jacobian(&reduction));
        Ok(Results::vector(entries))
    })?;
    let entries = found.into_iter().next().map(|(_, results)| results.list).unwrap_or_default();
    let mut mass = deriving.entries(&entries);
    let jacobian = mass.split_off(split.min(mass.len()));
    Ok(Patterns { mass, jacobian })
}

impl Deriving<'_> {
    fn entries(&self, roots: &[Scalar]) -> Vec<Entry> {
        let (g, symbols) = (&self.graph, &self.symbols);
        let nodes = g.reachable(roots);
        let parameters: Vec<Scalar> = symbols.params.concat();
        let symbol = |node: &AnyNode| match *node {
            AnyNode::Scalar(index) => Some(g.scalar_at(index)).filter(|&s| g.symbol_id(s).is_some()),
            AnyNode::Vector(_) | AnyNode::Rotation(_) => None,
        };
        let others = nodes.iter().filter_map(symbol).filter(|symbol| !parameters.contains(symbol));
        let varying = g.depending(&nodes, others.collect::<Vec<Scalar>>());
        let adjustable = g.depending(&nodes, parameters.iter().copied());
        let entry = |root: &Scalar| {
            let node = AnyNode::Scalar(root.index());
            match () {
                () if *root == Scalar::ZERO => Entry::Zero,
                () if varying.has(node) => Entry::Varying,
                () if adjustable.has(node) => Entry::Parameters,
                () => Entry::Constant,
            }
        };
        roots.iter().map(entry).collect()
    }
}
