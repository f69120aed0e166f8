//! Stage `mechanics`: derivatives, substitutions and entries of matrices, in expressions of the user.
//!
//! In: values on the tree, in which every coordinate is a symbol. Out: values on the tree again. A coordinate of the state
//! takes those that follow from it along: with the velocity map v = S u their positions move by a column of S, and their
//! rates by the derivative of S u. What parameters, time or another place of the state do to coordinates that follow is
//! known only where their equations are solved, so there such derivatives and substitutions are refused.

use std::collections::HashSet;
use std::rc::Rc;

use crate::invariant::fault::OrFault;
use crate::mechanics::analysis::Complaint;
use crate::mechanics::equations::Equations;
use crate::mechanics::loops::constraints::{coordinate_name, is_rate, path, row_called, row_name, rows_of_joint};
use crate::mechanics::loops::reduction::Reduction;
use crate::mechanics::loops::structure::{Means, Role, Row, Structure};
use crate::model::site::Sited;
use crate::model::types::{
    BodyRef, ConstraintId, ConstraintKind, Coordinate, Expr, ExprNode, ForceKind, Frame, LoopClosure, Model, Order,
    SystemQuantity, TwoRoots, Variable,
};
use crate::solve;
use crate::symbolic::differentiate::Differentiator;
use crate::symbolic::graph::{BlockKind, Scalar};
use crate::symbolic::substitute::Substitution;

use super::time::Seeds;
use super::values::{Part, Value};

/// Definitions of coordinates outside the state are made before expressions are translated.
const DEFINED: &str = "coordinates that follow are defined before expressions are translated";

/// Larger systems are solved with pivots.
pub(in crate::mechanics) const MOST_WRITTEN: usize = 3;

impl Equations<'_> {
    /// The derivative of a value.
    pub(super) fn derivative(&mut self, of: &Value, by: Variable, accelerated: bool) -> Value {
        let seeds = match by {
            Variable::Time => self.seeds_of_time(of, accelerated),
            other => self.seeds_of(other),
        };
        let mut along = Differentiator::new(&seeds);
        of.map(&mut self.g, &mut |g, part| match part {
            Part::Scalar(s) => Part::Scalar(along.scalar(g, s)),
            Part::Vector(v) => Part::Vector(along.vector(g, v)),
        })
    }

    /// What moves with a variable other than time, and how fast.
    fn seeds_of(&mut self, by: Variable) -> Seeds {
        match by {
            Variable::Coordinate(coordinate, Order::Position) => self.seeds_of_displacement(coordinate),
            Variable::Coordinate(coordinate, _) => {
                let symbol = self.coordinate_symbols(coordinate)[1];
                let mut seeds = vec![(symbol, Scalar::ONE)];
                let along = self.followers(coordinate);
                seeds
                    .extend(along.into_iter().map(|(dependent, slope)| (self.coordinate_symbols(dependent)[1], slope)));
                seeds
            }
            other => vec![(self.variable(other), Scalar::ONE)],
        }
    }

    /// All positions by velocities; own states that are read by their rates, which may be of the rate of something else;
    /// velocities by accelerations where these are read.
    fn seeds_of_time(&mut self, of: &Value, accelerated: bool) -> Seeds {
        let mut seeds = self.seeds(1);
        let states = self.scene.symbols.states.clone();
        let mut read = vec![false; states.len()];
        of.map(&mut self.g, &mut |g, part| {
            let by = match part {
                Part::Scalar(s) => g.read_by(&[s], &states),
                Part::Vector(v) => g.read_by_vectors(&[v], &states),
            };
            read.iter_mut().zip(by).for_each(|(read, by)| *read |= by);
            part
        });
        seeds.extend(self.seeds_of_states(&read));
        if accelerated {
            let velocities = self.scene.symbols.velocities.concat();
            let accelerations = self.accelerations();
            seeds.extend(velocities.into_iter().zip(accelerations.iter().copied()));
        }
        seeds
    }

    /// Along a displacement of one coordinate of the state.
    fn seeds_of_displacement(&mut self, coordinate: Coordinate) -> Seeds {
        let mut seeds = self.direction(coordinate);
        for (dependent, slope) in self.followers(coordinate) {
            let symbol = self.coordinate_symbols(dependent)[0];
            seeds.push((symbol, slope));
        }
        let Some(reduction) = self.reduced.clone() else { return seeds };
        let mut along = Differentiator::new(&seeds);
        // Rates of the state rest, whatever the velocities are.
        let follow = &reduction.displacements;
        let rates: Vec<Scalar> = follow.iter().map(|&(_, rate)| along.scalar(&mut self.g, rate)).collect();
        let velocities = self.scene.symbols.velocities.concat();
        seeds.extend(follow.iter().zip(rates).map(|(&(freedom, _), rate)| (velocities[freedom], rate)));
        seeds
    }

    /// Coordinates that follow from one of the state, each with its column of the velocity map.
    fn followers(&mut self, coordinate: Coordinate) -> Vec<(Coordinate, Scalar)> {
        let structure = Rc::clone(&self.scene.structure);
        let unknowns: Vec<Coordinate> = structure.steps.iter().flat_map(|step| step.unknowns.iter().copied()).collect();
        if unknowns.is_empty() {
            return Vec::new();
        }
        let reduction = self.definitions();
        let freedom = self.freedom(coordinate);
        let map = self.map_by(&reduction.displacements, &[freedom]);
        unknowns.into_iter().map(|unknown| (unknown, map[self.freedom(unknown)][0])).collect()
    }

    fn definitions(&self) -> Rc<Reduction> {
        self.reduced.clone().or_fault(DEFINED)
    }

    /// A value with others in the place of variables.
    pub(super) fn substituted(&mut self, of: &Value, pairs: &[(Variable, Scalar)]) -> Value {
        let pairs: Vec<(Scalar, Scalar)> = pairs.iter().map(|&(by, value)| (self.variable(by), value)).collect();
        let mut put = Substitution::of_nodes(&pairs);
        of.map(&mut self.g, &mut |g, part| match part {
            Part::Scalar(s) => Part::Scalar(put.scalars(g, &[s])[0]),
            Part::Vector(v) => Part::Vector(put.vectors(g, &[v])[0]),
        })
    }

    /// The symbol of a variable.
    fn variable(&self, variable: Variable) -> Scalar {
        let symbols = &self.scene.symbols;
        match variable {
            Variable::Time => symbols.time,
            Variable::Coordinate(coordinate, Order::Position) => self.coordinate_symbols(coordinate)[0],
            Variable::Coordinate(coordinate, Order::Rate) => self.coordinate_symbols(coordinate)[1],
            Variable::Coordinate(coordinate, Order::Acceleration) => self.coordinate_symbols(coordinate)[2],
            Variable::State(id) => symbols.states[id.0],
            Variable::Param(id, place) => symbols.params[id.0][place],
            Variable::Input(id, place) => symbols.inputs[id.0][place],
        }
    }

    /// One unknown of a system of linear equations: the matrix row by row, then the right-hand sides. Up to three are quotients
    /// of determinants, which people can read.
    pub(super) fn solved_system(&mut self, system: Vec<Scalar>, size: usize, index: usize) -> Scalar {
        if size <= MOST_WRITTEN {
            let (matrix, sides) = system.split_at(size * size);
            return self.quotient(size, matrix, sides, index);
        }
        self.g.block_outputs(BlockKind::Solve { size, symmetric: false, groups: [].into() }, &system)[index]
    }

    /// One unknown as a quotient of determinants (Cramer's rule).
    pub(in crate::mechanics) fn quotient(
        &mut self,
        size: usize,
        matrix: &[Scalar],
        sides: &[Scalar],
        index: usize,
    ) -> Scalar {
        let rows: Vec<Vec<Scalar>> = matrix.chunks(size).map(<[Scalar]>::to_vec).collect();
        let mut replaced = rows.clone();
        replaced.iter_mut().zip(sides).for_each(|(row, &side)| row[index] = side);
        let (above, below) = (self.determinant(&replaced), self.determinant(&rows));
        self.g.div(above, below)
    }

    /// A solution of an equation in one unknown.
    pub(super) fn one_of_two(&mut self, form: TwoRoots, coefficients: [Scalar; 3], second: bool) -> Scalar {
        match form {
            TwoRoots::Quadratic => solve::quadratic(&mut self.g, coefficients, second),
            TwoRoots::Circular => match solve::circular(&mut self.g, coefficients, second) {
                solve::Value::Angle { cos, sin } => self.g.angle(cos, sin),
                solve::Value::Length(x) => x,
            },
        }
    }

    /// By the first row.
    fn determinant(&mut self, rows: &[Vec<Scalar>]) -> Scalar {
        let Some((first, rest)) = rows.split_first() else { return Scalar::ONE };
        let terms: Vec<Scalar> = (0..first.len())
            .map(|column| {
                let others = |row: &Vec<Scalar>| {
                    row.iter()
                        .enumerate()
                        .filter(|(k, _)| *k != column)
                        .map(|(_, &entry)| entry)
                        .collect::<Vec<Scalar>>()
                };
                let minor: Vec<Vec<Scalar>> = rest.iter().map(others).collect();
                let minor = self.determinant(&minor);
                let term = self.g.mul(first[column], minor);
                if column % 2 == 0 { term } else { -term }
            })
            .collect();
        self.g.sum(&terms)
    }

    /// An entry of the mass matrix, on the tree.
    pub(super) fn mass_matrix_entry(&mut self, [row, column]: [Coordinate; 2]) -> Scalar {
        let structure = Rc::clone(&self.scene.structure);
        if !self.is_constrained() {
            let (row, column) = (self.freedom(row), self.freedom(column));
            return self.mass_matrix()[row * self.scene.symbols.freedoms + column];
        }
        let place =
            |of: Coordinate| structure.speeds().iter().position(|&at| at == of).or_fault("entries are of velocities");
        let reduction = self.definitions();
        // Derivatives follow dependent coordinates by the velocity map, so these stay symbols; an expansion puts them in, and
        // is refused where they are found by iteration, which can't be differentiated.
        let matrix = if self.is_first_order() {
            self.reduced_mass_matrix(&reduction)
        } else {
            self.mass_matrix_on_tree(&reduction)
        };
        matrix[place(row)][place(column)]
    }

    /// An entry of the bias, on the tree.
    pub(super) fn bias_entry(&mut self, coordinate: Coordinate) -> Scalar {
        if self.derives_forces() {
            // Forces that depend on the bias are refused by the checker.
            return Scalar::ZERO;
        }
        if !self.is_constrained() {
            let freedom = self.freedom(coordinate);
            return self.bias()[freedom];
        }
        let place = self.scene.structure.speeds().iter().position(|&at| at == coordinate);
        let reduction = self.definitions();
        self.reduced_bias(&reduction)[place.or_fault("entries are of velocities")]
    }
}

/// What is asked of coordinates that are not in the state.
pub(in crate::mechanics) fn complaints(model: &Model, structure: &Structure) -> Vec<Complaint> {
    complaints_of(model, structure, roots(model))
}

/// The same of some expressions.
pub(in crate::mechanics) fn complaints_of(model: &Model, structure: &Structure, roots: Vec<&Expr>) -> Vec<Complaint> {
    let follows = structure.roles.iter().flatten().any(|role| *role != Role::State);
    let (mut complaints, mut seen) = (Vec::new(), HashSet::new());
    let mut stack = roots;
    while let Some(expr) = stack.pop() {
        if !seen.insert(Rc::as_ptr(&expr.node)) {
            continue;
        }
        stack.extend(expr.node.operands());
        match &*expr.node {
            // What is wrong with an equation is said there.
            ExprNode::Derivative { of, .. } if is_wrong_row(model, structure, of) => {}
            ExprNode::Derivative { of, by, .. } => match by {
                Variable::Coordinate(coordinate, _) => complaints.extend(outside(model, structure, *coordinate, expr)),
                Variable::Time if holds(of, |node| matches!(node, ExprNode::Potential)) && springs_read_inputs(model) => {
                    complaints.push(Complaint {
                        at: expr.site(),
                        message: "a spring's energy depends on an input: its rate is not known, so there is no derivative by time"
                            .to_owned(),
                        help: Some("differentiate by coordinates, and multiply by their rates".to_owned()),
                    });
                }
                Variable::Param(..) if follows && reads_positions(of) => complaints.push(Complaint {
                    at: expr.site(),
                    message: "this reads positions, and some coordinates follow from others by equations that parameters are \
                              in: their derivatives by parameters are not known"
                        .to_owned(),
                    help: Some("differentiate a part that reads no positions".to_owned()),
                }),
                _ => {}
            },
            ExprNode::Substituted { of, pairs } => {
                let moved = |by: &Variable| !matches!(by, Variable::State(_) | Variable::Input(..));
                for (by, _) in pairs {
                    if let Variable::Coordinate(coordinate, _) = by {
                        complaints.extend(outside(model, structure, *coordinate, expr));
                    }
                }
                if follows && reads_positions(of) && pairs.iter().any(|pair| moved(&pair.0)) {
                    complaints.push(Complaint {
                        at: expr.site(),
                        message: "this reads positions, and some coordinates follow from others by equations that would have \
                                  to be solved anew"
                            .to_owned(),
                        help: Some("inputs and states can be put in here; or substitute in a part that reads no positions".to_owned()),
                    });
                }
            }
            ExprNode::Residual { closing, component } => {
                complaints.extend(no_row(model, structure, *closing, component.as_deref(), expr));
            }
            ExprNode::Multiplier(constraint) => complaints.extend(no_multiplier(model, structure, *constraint, expr)),
            ExprNode::Closed(coordinate) => complaints.extend(not_closed(model, structure, *coordinate, expr)),
            ExprNode::MassMatrix(list) => {
                complaints.extend(list.iter().filter_map(|coordinate| no_velocity(model, structure, *coordinate, expr)));
            }
            ExprNode::Bias(coordinate) => complaints.extend(no_velocity(model, structure, *coordinate, expr)),
            _ => {}
        }
    }
    complaints
}

fn is_wrong_row(model: &Model, structure: &Structure, expr: &Expr) -> bool {
    match &*expr.node {
        ExprNode::Residual { closing, component } => {
            no_row(model, structure, *closing, component.as_deref(), expr).is_some()
        }
        _ => false,
    }
}

/// Whether an equation acts on places of frames or on a joint that closes a loop. What acts on coordinates of the tree alone, such as a gear,
/// loads no link.
pub(in crate::mechanics) fn loads_links(model: &Model, constraint: ConstraintId) -> bool {
    let ConstraintKind::Value(value) = &model.constraints[constraint].kind else { return true };
    let is_moving = |frame: &Frame| frame.body != BodyRef::Ground;
    holds(value, |node| match node {
        ExprNode::OfFrame(frame, _) | ExprNode::Express { frame, .. } => is_moving(frame),
        ExprNode::OfBodies(..) => true,
        ExprNode::Coordinate { joint, .. } => model.cuts.contains(joint),
        _ => false,
    })
}

/// A constraint whose force is not known.
fn no_multiplier(model: &Model, structure: &Structure, constraint: ConstraintId, expr: &Expr) -> Option<Complaint> {
    let of = |row: &Row| row.closing == LoopClosure::Constraint(constraint);
    let name = row_name(model, LoopClosure::Constraint(constraint), 0);
    let linear = |means: &Means| matches!(means, Means::Linear(id) if *id == constraint && !loads_links(model, *id));
    let found = structure.steps.iter().find(|step| linear(&step.means));
    let is_held = structure.rows.iter().chain(&structure.independent).chain(&structure.rates.rows).any(of);
    let is_open = structure.shared.iter().any(of) || !is_held;
    let (message, help) = match found {
        Some(_) => (
            format!("`{name}` is a coupling of coordinates that is put in where they are, without a multiplier"),
            "read the reaction of a joint that it acts on",
        ),
        None if is_open => (
            format!("`{name}` depends on other equations: how they share the load is not determined by rigid bodies"),
            "read the multipliers of equations that stand alone, or leave out what holds the same twice",
        ),
        None => return None,
    };
    Some(Complaint { at: expr.site(), message, help: Some(help.to_owned()) })
}

/// An equation that there isn't.
fn no_row(
    model: &Model,
    structure: &Structure,
    closing: LoopClosure,
    component: Option<&str>,
    expr: &Expr,
) -> Option<Complaint> {
    let is_kept = structure.rows.iter().any(|row| row.closing == closing);
    let solved = |name: &str| Complaint {
        at: expr.site(),
        message: format!("no equation of `{name}` keeps a multiplier: they are solved, and nothing is left of them"),
        help: Some("`formulation { constraints: Multipliers }` keeps them".to_owned()),
    };
    if is_rate(model, Row { closing, index: 0 }) {
        let message = "this constraint is one of velocities: it has no residual of positions".to_owned();
        let help = Some("write its expression once more, by a `let` that both use".to_owned());
        return Some(Complaint { at: expr.site(), message, help });
    }
    let joint = match closing {
        LoopClosure::Cut(joint) => joint,
        LoopClosure::Constraint(id) => return (!is_kept).then(|| solved(&path(model, &model.constraints[id].place))),
    };
    let name = path(model, &model.joints[joint].place);
    if !model.cuts.contains(&joint) {
        let message = format!("the joint `{name}` closes no loop: it has no equations");
        return Some(Complaint { at: expr.site(), message, help: None });
    }
    if row_called(model, closing, component).is_some() {
        return (!is_kept).then(|| solved(&name));
    }
    let known: Vec<String> = rows_of_joint(model, joint).iter().map(|row| format!("`{name}.{row}`")).collect();
    let message = format!("the joint `{name}` has no equation `{}`", component.unwrap_or_default());
    Some(Complaint { at: expr.site(), message, help: Some(format!("its equations are {}", known.join(", "))) })
}

/// A coordinate without a formula.
fn not_closed(model: &Model, structure: &Structure, coordinate: Coordinate, expr: &Expr) -> Option<Complaint> {
    let name = coordinate_name(model, coordinate);
    let (why, help) = if model.cuts.contains(&coordinate.joint) {
        ("is measured on a joint that closes a loop", "name a coordinate that the loop gives")
    } else {
        match structure.role(coordinate) {
            Role::State => {
                ("is in the state: nothing gives it", "loops are solved by `formulation { constraints: Reduced }`")
            }
            Role::Dependent(step) if matches!(structure.steps[step].means, Means::Newton { .. }) => {
                ("is found by iteration: there is no formula", "write `solve (..) from ..`")
            }
            Role::Driven(_) | Role::Dependent(_) => return None,
        }
    };
    Some(Complaint { at: expr.site(), message: format!("{name} {why}"), help: Some(help.to_owned()) })
}

/// A coordinate whose rate is no velocity of the state.
fn no_velocity(model: &Model, structure: &Structure, coordinate: Coordinate, expr: &Expr) -> Option<Complaint> {
    let found = outside(model, structure, coordinate, expr);
    if found.is_some() || structure.speeds().contains(&coordinate) {
        return found;
    }
    let name = coordinate_name(model, coordinate);
    let message = format!(
        "the rate of {name} follows from the velocities of this model: it has no equation of motion of its own"
    );
    let help = Some(
        "an output can be `kinetic()`, of which `diff` is an entry; all entries are `emit mass_matrix, bias`"
            .to_owned(),
    );
    Some(Complaint { at: expr.site(), message, help })
}

/// A coordinate that is not in the state.
fn outside(model: &Model, structure: &Structure, coordinate: Coordinate, expr: &Expr) -> Option<Complaint> {
    let name = coordinate_name(model, coordinate);
    let (what, help) = if model.cuts.contains(&coordinate.joint) {
        ("is measured on a joint that closes a loop", "name a coordinate of the state")
    } else {
        match structure.role(coordinate) {
            Role::State => return None,
            Role::Driven(_) => ("follows the time", "name a coordinate of the state, or `t`"),
            Role::Dependent(_) => ("follows from others", "name one of those; this one moves with them"),
        }
    };
    Some(Complaint {
        at: expr.site(),
        message: format!("{name} {what}: it is no variable"),
        help: Some(help.to_owned()),
    })
}

/// Whether positions or velocities are read.
fn reads_positions(expr: &Expr) -> bool {
    let mut stack = vec![expr];
    let mut seen = HashSet::new();
    while let Some(expr) = stack.pop() {
        if !seen.insert(Rc::as_ptr(&expr.node)) {
            continue;
        }
        match &*expr.node {
            ExprNode::Number(_)
            | ExprNode::Pi
            | ExprNode::Time
            | ExprNode::Param(_)
            | ExprNode::Input(_)
            | ExprNode::State(_)
            | ExprNode::OfBodies(_, SystemQuantity::TotalMass) => {}
            node if node.operands().is_empty() => return true,
            ExprNode::Express { .. } => return true,
            node => stack.extend(node.operands()),
        }
    }
    false
}

/// Whether an input decides what energy a spring holds.
fn springs_read_inputs(model: &Model) -> bool {
    model.forces.iter().any(|force| {
        let fields = match &force.kind {
            ForceKind::JointSpring { stiffness, rest, .. } => [stiffness, rest],
            ForceKind::LineSpring { stiffness, length, .. } => [stiffness, length],
            _ => return false,
        };
        fields.into_iter().flatten().any(|field| holds(field, |node| matches!(node, ExprNode::Input(_))))
    })
}

/// Whether a node of an expression is of a kind.
pub(in crate::mechanics) fn holds(expr: &Expr, is: impl Fn(&ExprNode) -> bool) -> bool {
    let mut stack = vec![expr];
    let mut seen = HashSet::new();
    while let Some(expr) = stack.pop() {
        if seen.insert(Rc::as_ptr(&expr.node)) {
            if is(&expr.node) {
                return true;
            }
            stack.extend(expr.node.operands());
        }
    }
    false
}

/// Expressions in which equations may be taken apart.
pub(in crate::mechanics) fn roots(model: &Model) -> Vec<&Expr> {
    let mut roots: Vec<&Expr> = model.outputs.iter().map(|output| &output.value).collect();
    roots.extend(model.states.iter().map(|state| &state.rate));
    roots.extend(model.forces.iter().flat_map(|force| force.kind.values()));
    roots
}
