//! Stage `mechanics`: assembly modes, all positions that what is given leaves.
//!
//! In: what is given and what is to be found, with the structure in which the one is independent and the other follows. Out: one
//! body that moves freely or in a plane, held by distances alone, as a [`Placement`]; and of it a condition on a point of the circle,
//! and the coordinates that belong to each point. Joints of legs that stand in a `solve` item follow from the body's pose by its
//! formulas.
//!
//! That each leg holds the body by its distance and by nothing else follows from its joints, and is counted too: one equation more
//! than it has unknown joints. The formulas are looked at in numbers, at configurations that Newton's method has closed by the equations themselves: several must be among the modes.

use std::f64::consts::TAU;

use crate::contracts::call::Call;
use crate::contracts::results::{Results, Slot};
use crate::contracts::symbol::Symbol;
use crate::invariant::fault::OrFault;
use crate::mechanics::analysis::Complaint;
use crate::mechanics::equations::Equations;
use crate::mechanics::loops::constraints::{closings, coordinate_name};
use crate::mechanics::loops::reduction::{Map, Reduction};
use crate::mechanics::loops::structure::{Closed, Means, Modes, Role, Row, Structure};
use crate::model::site::Sited;
use crate::model::types::{Coordinate, JointId, Kinematics, LoopClosure};
use crate::solve::placement::{Alternative, Placed, Placement, Unplaced};
use crate::solve::{KinematicLoop, Segment};
use crate::symbolic::evaluate::{Evaluator, Real};
use crate::symbolic::graph::{Scalar, SymbolId};

/// Configurations at which formulas are looked at, and how many of them have to be found if it is not most of them: some lie where
/// two modes meet, and where a sum changes its sign tells less than what the runtime looks for.
const POSES: usize = 8;
const ENOUGH: usize = 3;

/// How near a mode has to come to a configuration, in all of twelve numbers.
const NEAR: f64 = 1e-4;

/// Places at which a series is looked at for changes of its sign.
const LOOKED_AT: usize = 4096;

/// All assembly modes of a model.
pub(in crate::mechanics) struct Assembly {
    pub condition: Option<Scalar>,
    pub results: Results<Scalar>,
    pub modes: Modes,
    /// How they are found.
    pub name: &'static str,
}

impl Equations<'_> {
    /// `closure` is the structure in which what is given is independent; the reduction knows the `solve` items alone.
    pub(in crate::mechanics) fn assembly(
        &mut self,
        wanted: &Kinematics,
        closure: &Structure,
        reduction: &Reduction,
    ) -> Result<Assembly, Vec<Complaint>> {
        let complain =
            |message: String, help: &str| vec![Complaint { at: wanted.site(), message, help: Some(help.to_owned()) }];
        let body = self.placed_body(closure).map_err(|message| {
            complain(message, "ask for `kinematics`, which finds the pose that is near by Newton's method")
        })?;
        // In the order of its motions.
        let sequence = self.scene.model.joints[body].kind.sequence();
        let chain: Vec<Coordinate> = sequence.into_iter().map(|index| Coordinate { joint: body, index }).collect();
        let cycles = self.legs(closure, &chain).map_err(|message| {
            complain(message, "ask for `kinematics`, which finds the pose that is near by Newton's method")
        })?;
        let symbols: Vec<Scalar> = chain.iter().map(|&c| self.coordinate_symbols(c)[0]).collect();
        let alternative = self.scene.symbols.alternative.or_fault("who asks for assembly modes has their symbols");
        let placement = Placement::new(&mut self.g, &cycles, &symbols);
        let placed = placement.and_then(|placement| {
            let placed = placement.place(&mut self.g, &alternative)?;
            Ok((placement, placed))
        });
        let (placement, placed) = placed.map_err(|why| {
            let message = unplaced(&why);
            complain(message, "ask for `kinematics`, which finds the pose that is near by Newton's method")
        })?;
        let modes = Modes { sides: placement.sides(), roots: placement.roots(), choices: placement.choices() };
        if !self.is_found(&placed, modes) || !self.is_told_apart(&placed, &alternative, modes) {
            let message =
                "the formulas of the assembly modes do not find the configurations that close the loops".to_owned();
            return Err(complain(
                message,
                "ask for `kinematics`; points that have to be apart may be in one place, or in a line, with the declared parameters",
            ));
        }
        let find: Vec<Scalar> = wanted.find.iter().map(|&c| self.coordinate_symbols(c)[0]).collect();
        let found = self.finish(reduction, &find);
        let pairs: Vec<(Scalar, Scalar)> = symbols.iter().copied().zip(placed.values).collect();
        let map = self.map(&pairs);
        let mut found = self.g.substitute(&found, &map);
        let following = closure.steps.iter().flat_map(|step| &step.unknowns);
        let others: Vec<Scalar> = following.map(|&c| self.coordinate_symbols(c)[0]).collect();
        if let Some(at) = found.iter().position(|&s| self.g.depends_on(s, &others)) {
            let name = coordinate_name(self.scene.model, wanted.find[at]);
            let message = format!("`{name}` is not known from the pose of the body that the legs hold");
            return Err(complain(message, "give it a `solve` item, `solve (gimbal, stroke) from ball { .. }`"));
        }
        let mut errors = placed.errors;
        if wanted.find.iter().any(|coordinate| !chain.contains(coordinate)) {
            errors.extend(self.other_branches(wanted, reduction, &map, placement.square()));
        }
        let sizes: Vec<Scalar> = errors.iter().map(|&error| self.g.call(Call::Abs, &[error])).collect();
        found.push(self.worst(&sizes));
        // Given coordinates follow from the pose by the formulas of their legs, but here they are what is known.
        let given = wanted.given.iter().flat_map(|joint| &self.scene.symbols.positions[joint.0]);
        let given: Vec<SymbolId> = given.filter_map(|&symbol| self.g.symbol_id(symbol)).collect();
        let mut known = reduction.map.clone();
        known.retain(|id, _| !given.contains(id));
        let found = self.g.substitute(&found, &known);
        let (residual, positions) = found.split_last().or_fault("the residual stands behind all positions");
        let results =
            Results::default().with(Slot::Positions, positions.to_vec()).with_scalar(Slot::Residual, *residual);
        let condition = placed.condition.map(|condition| self.g.substitute(&[condition], &known)[0]);
        Ok(Assembly { condition, results, modes, name: placement.describe() })
    }

    /// What joints of legs that follow from the pose make of what is given: a formula may be on another branch than that, and is of no
    /// use then. Squares, those of lengths beside one.
    fn other_branches(
        &mut self,
        wanted: &Kinematics,
        reduction: &Reduction,
        pose: &Map,
        square: Scalar,
    ) -> Vec<Scalar> {
        let model = self.scene.model;
        let mut errors = Vec::new();
        for &joint in &wanted.given {
            for index in 0..model.joints[joint].kind.freedoms() {
                let symbol = self.coordinate_symbols(Coordinate { joint, index })[0];
                let Some(&formula) = self.g.symbol_id(symbol).and_then(|id| reduction.map.get(&id)) else { continue };
                let formula = self.g.substitute(&[formula], pose)[0];
                let off = self.g.sub(symbol, formula);
                errors.push(match model.joints[joint].kind.is_slide(index) {
                    true => {
                        let squared = self.g.mul(off, off);
                        self.g.div(squared, square)
                    }
                    false => {
                        let cos = self.g.cos(off);
                        self.g.sub(Scalar::ONE, cos)
                    }
                });
            }
        }
        errors
    }

    /// The one body that is to be placed: its joint slides and turns, and nothing of it is given.
    fn placed_body(&self, closure: &Structure) -> Result<JointId, String> {
        let model = self.scene.model;
        let mut bodies = model.joints.iter().enumerate().map(|(k, joint)| (JointId(k), joint)).filter(|(id, joint)| {
            let open = |index| {
                let coordinate = Coordinate { joint: *id, index };
                let is_state = self.scene.structure.role(coordinate) == Role::State;
                is_state && matches!(closure.role(coordinate), Role::Dependent(_))
            };
            let freedoms = joint.kind.freedoms();
            !model.cuts.contains(id)
                && joint.kind.slides() >= 2
                && freedoms > joint.kind.slides()
                && (0..freedoms).all(open)
        });
        let first = bodies.next();
        match (first, bodies.next()) {
            (Some((id, _)), None) => Ok(id),
            (Some(_), Some(_)) => Err("assembly modes are found of one body that legs hold, and here are several".to_owned()),
            (None, _) => {
                Err("assembly modes are found of a body that moves freely or in a plane, and is held by legs: there is none".to_owned())
            }
        }
    }

    /// Cycles through the body's motions, one for each leg.
    fn legs(&mut self, closure: &Structure, chain: &[Coordinate]) -> Result<Vec<KinematicLoop>, String> {
        let model = self.scene.model;
        let mut unknowns = Vec::new();
        let mut rows = Vec::new();
        for step in &closure.steps {
            match &step.means {
                Means::Newton { rows: own, .. } => rows.extend(own.iter().copied()),
                Means::Explicit(id) => rows.push(Row { closing: LoopClosure::Constraint(*id), index: 0 }),
                Means::Linear(_) | Means::Solve(_) => {
                    return Err("a coupling of coordinates has a part in what legs hold".to_owned());
                }
            }
            unknowns.extend(step.unknowns.iter().copied());
        }
        let symbols: Vec<(Coordinate, Scalar)> =
            unknowns.iter().map(|&c| (c, self.coordinate_symbols(c)[0].positive())).collect();
        let (mut cycles, mut seen) = (Vec::new(), Vec::new());
        for closing in closings(model) {
            let count = rows.iter().filter(|row| row.closing == closing).count();
            if count == 0 {
                continue;
            }
            let segments = self.segments(closing, 0, &unknowns);
            let open: Vec<Coordinate> = segments
                .iter()
                .filter_map(|segment| match segment {
                    Segment::Unknown { symbol, wanted: true, .. } => {
                        symbols.iter().find(|one| one.1 == *symbol).map(|one| one.0)
                    }
                    _ => None,
                })
                .collect();
            let own: Vec<Coordinate> = open.iter().copied().filter(|c| !chain.contains(c)).collect();
            if open.len() == own.len() {
                return Err("a loop of its own has a part in what legs hold".to_owned());
            }
            let shared = own.iter().any(|c| seen.contains(c));
            if shared || count > own.len() + 1 || segments.is_empty() {
                return Err("a leg holds the body by more than one distance".to_owned());
            }
            if count <= own.len() {
                return Err("a leg does not hold the body".to_owned());
            }
            seen.extend(own);
            cycles.push(KinematicLoop { segments, winding: None });
        }
        let all = seen.len() + chain.len() == unknowns.len() && cycles.len() == chain.len();
        if all { Ok(cycles) } else { Err("each leg has to hold the body by one distance".to_owned()) }
    }

    /// Whether every side is in what it tells apart: modes that share one are counted twice, and others are lost, which the
    /// configurations that are found need not show.
    fn is_told_apart(&self, placed: &Placed, alternative: &Alternative, modes: Modes) -> bool {
        let sides = &alternative.sides[..modes.sides + modes.choices];
        sides.iter().all(|&side| placed.values.iter().any(|&value| self.g.depends_on(value, &[side])))
    }

    /// Whether the configurations that close the loops are among the modes.
    fn is_found(&self, placed: &Placed, modes: Modes) -> bool {
        let closed = &self.scene.structure.closed;
        let list: Vec<&Closed> = closed.iter().take(POSES).collect();
        let found = list.iter().filter(|closed| self.is_mode(placed, modes, closed)).count();
        found >= ENOUGH || 2 * found > list.len()
    }

    fn is_mode(&self, placed: &Placed, modes: Modes, closed: &Closed) -> bool {
        (0..1 << (modes.sides + modes.choices)).any(|choice: usize| {
            let side = |k: usize| if choice >> k & 1 == 1 { -1.0 } else { 1.0 };
            let value = |roots: &[Scalar], angle: f64| -> Vec<f64> {
                let symbols = |id: SymbolId| match self.scene.symbols.table[id.0] {
                    Symbol::Param { param, element } => self.scene.model.params[param].default[element],
                    Symbol::Position { joint, component } => {
                        closed.positions.get(joint.0).and_then(|list| list.get(component)).copied().unwrap_or(0.0)
                    }
                    Symbol::Alternative { component } => {
                        [angle.cos(), angle.sin(), side(0), side(1), side(2)][component]
                    }
                    _ => 0.0,
                };
                Evaluator::new(&self.g, Real { symbols: &symbols }).run(roots)
            };
            let near = |angle: f64| value(&placed.between, angle).iter().all(|x| x.abs() < NEAR);
            match placed.condition {
                None => near(0.0),
                Some(condition) => roots(modes.roots, |angle| value(&[condition], angle)[0]).into_iter().any(near),
            }
        })
    }
}

/// Where a sum of sines and cosines of multiples up to half of `count` changes its sign.
fn roots(count: usize, value: impl Fn(f64) -> f64) -> Vec<f64> {
    let samples = count + 1;
    let angle = |k: usize| TAU * k as f64 / samples as f64;
    let values: Vec<f64> = (0..samples).map(|k| value(angle(k))).collect();
    let coefficient = |order: usize| {
        let terms = values.iter().enumerate().map(|(k, v)| {
            let (sin, cos) = (order as f64 * angle(k)).sin_cos();
            [v * cos, v * sin]
        });
        let sum = terms.fold([0.0; 2], |sum, term| [sum[0] + term[0], sum[1] + term[1]]);
        let scale = if order == 0 { 1.0 } else { 2.0 } / samples as f64;
        sum.map(|x| x * scale)
    };
    let coefficients: Vec<[f64; 2]> = (0..=count / 2).map(coefficient).collect();
    let series = |t: f64| -> f64 {
        let terms = coefficients.iter().enumerate().map(|(order, [a, b])| {
            let (sin, cos) = (order as f64 * t).sin_cos();
            a * cos + b * sin
        });
        terms.sum()
    };
    let place = |k: usize| TAU * k as f64 / LOOKED_AT as f64;
    let mut found = Vec::new();
    for k in 0..LOOKED_AT {
        let (mut low, mut high) = (place(k), place(k + 1));
        let below = series(low);
        if (below > 0.0) == (series(high) > 0.0) {
            continue;
        }
        for _ in 0..50 {
            let middle = 0.5 * (low + high);
            if (series(middle) > 0.0) == (below > 0.0) {
                low = middle;
            } else {
                high = middle;
            }
        }
        found.push(low);
    }
    found
}

fn unplaced(why: &Unplaced) -> String {
    let list = |counts: &[usize]| counts.iter().map(usize::to_string).collect::<Vec<_>>().join(", ");
    match why {
        Unplaced::Unmeasured => "a leg holds the body by something else than one distance: known are rods, struts between a ball and two hinges at right angles \
             to each other and to the strut, and parallel hinges across the plane of the body"
                .to_owned(),
        Unplaced::Untold => "the coordinates of the body do not follow from its pose in closed form".to_owned(),
        Unplaced::Unknown { body, base } => format!(
            "no polynomial of low degree is known for this robot: legs end in common on the body by {}, beside it by {}; \
             known are 3, 2, 1 and 3, 1, 1, 1 and 2, 2, 2, in a plane 2, 1 and 1, 1, 1",
            list(body),
            list(base)
        ),
    }
}
