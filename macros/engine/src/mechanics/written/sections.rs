//! Room `written`: the sections of a page.
//!
//! In: one derivation. Out: closed forms and what follows from them, equations that keep multipliers, equations of motion with
//! their mass matrix and parts, outputs.

use std::collections::{HashMap, HashSet};
use std::rc::Rc;

use crate::contracts::call::Call;
use crate::invariant::fault::OrFault;
use crate::mechanics::analysis::Complaint;
use crate::mechanics::equations::Equations;
use crate::mechanics::loops::constraints::{coordinate_name, path, row_name};
use crate::mechanics::loops::reduction::{Definition, Reduction};
use crate::mechanics::loops::structure::{Means, Role};
use crate::mechanics::results::parts::Parts;
use crate::mechanics::translate::forces::LoadCase;
use crate::model::types::{Coordinate, JointId, Type};
use crate::symbolic::graph::{Graph, Scalar, ScalarNode, SymbolId};
use crate::symbolic::write::formula::{Class, Equation, Formula, Function, Identifier};
use crate::symbolic::write::{self, Names, Wanted, Writing};

use super::domains::Conditions;
use super::following::{Following, Named};
use super::letters::{Letters, plain};
use super::names::{external, identifier};
use super::order::in_reading_order;
use super::solved::{Solved, solved};
use super::{Line, Page, Section, Subject, apart, domains, rows};

/// An equation of motion is written out where it is no longer than this many symbols.
const MOST_WRITTEN_OUT: usize = 120;

/// A line before its right side is written.
struct Draft {
    subject: Subject,
    left: Formula,
    value: Scalar,
    collect: Vec<Scalar>,
    says: Option<String>,
    /// What must not be negative for the value to be real.
    radicand: Option<Scalar>,
}

impl Draft {
    fn new(subject: Subject, left: Formula, value: Scalar) -> Draft {
        Draft { subject, left, value, collect: Vec::new(), says: None, radicand: None }
    }
}

impl Equations<'_> {
    /// All that is written.
    pub(in crate::mechanics) fn page(&mut self) -> Result<Page, Vec<Complaint>> {
        let reduction = self.reduce()?;
        let follow: Vec<Definition> = reduction.of_rates().copied().collect();
        let follow = in_reading_order(self, &follow);
        let mut reduction = (*reduction).clone();
        let places: HashSet<Coordinate> =
            reduction.definitions.iter().map(|definition| definition.coordinate).collect();
        reduction.definitions = follow.iter().filter(|d| places.contains(&d.coordinate)).copied().collect();
        let mut writer = Sections::new(self);
        writer.solved = solved(self.scene.model, &reduction, &writer.letters);
        let following = Following::new(self, follow, &writer.letters);
        writer.drives(self, &reduction);
        writer.velocities(self);
        writer.followers(self, &reduction, &following);
        writer.constraints(self, &following);
        writer.motion(self, &following);
        writer.own(self, &following);
        writer.page.without_raw_names();
        writer.page.tell_apart();
        Ok(writer.page)
    }
}

/// A term of the equations of motion: its letter, what its lines state, its values.
type Part<'a> = (&'a str, fn(usize) -> Subject, &'a [Scalar]);

struct Sections {
    page: Page,
    identifiers: HashMap<SymbolId, Identifier>,
    taken: HashSet<String>,
    letters: Letters,
    /// Of closed forms what has no line yet.
    solved: Solved,
    /// Equations and velocity coordinates whose slope is not zero.
    sloped: HashSet<(usize, usize)>,
}

impl Sections {
    fn new(e: &Equations<'_>) -> Sections {
        let model = e.scene.model;
        let named = e.scene.symbols.table.iter().map(|&symbol| (plain(identifier(model, symbol)), symbol));
        let mut symbols: Vec<_> = named.collect();
        let outputs = model.outputs.iter().map(|output| {
            let index = (output.value.ty != Type::Scalar).then(String::new);
            plain(Identifier { index, ..named_by(path(model, &output.place)) })
        });
        let functions = model.externals.iter().map(|function| plain(named_by(function.name.to_string())));
        let is_own = |name: &Identifier| matches!(name.class, Class::Defined | Class::Multiplier);
        let of_users = symbols.iter().map(|(name, _)| name).filter(|name| !is_own(name)).cloned();
        let of_users: Vec<Identifier> = of_users.chain(outputs).chain(functions).collect();
        let mut taken = symbols.iter().map(|(name, _)| name).chain(&of_users).map(|name| name.text.clone()).collect();
        let letters = Letters::new(&of_users, &mut taken);
        for (name, _) in symbols.iter_mut().filter(|(name, _)| name.class == Class::Multiplier) {
            name.text = letters.word("lambda").to_owned();
        }
        let identifiers = symbols.iter().enumerate().map(|(k, (name, _))| (SymbolId(k), name.clone())).collect();
        let page = Page { symbols, ..Page::default() };
        Sections { page, identifiers, taken, letters, solved: Solved::new(), sloped: HashSet::new() }
    }

    /// Writes values, with what they read before them.
    fn lines(&mut self, e: &Equations<'_>, drafts: Vec<Draft>) -> Vec<Line> {
        self.lines_with(e, drafts, true)
    }

    /// The same; `shortens` what several of them have in common.
    fn lines_with(&mut self, e: &Equations<'_>, drafts: Vec<Draft>, shortens: bool) -> Vec<Line> {
        let mut wanted: Vec<Wanted> =
            drafts.iter().map(|draft| Wanted { value: draft.value, collect: draft.collect.clone() }).collect();
        // Behind all others, so that nothing is written apart for them alone.
        let radicands = drafts.iter().filter_map(|draft| draft.radicand);
        wanted.extend(radicands.map(|value| Wanted { value, collect: Vec::new() }));
        let symbol = |id: SymbolId| self.identifiers.get(&id).cloned().or_fault("every symbol of a page has a name");
        let external = |call: Call| plain(external(e.scene.model, call));
        let names = Names { symbol: &symbol, external: &external };
        let mut writing = write::write(&e.g, &wanted, &names, &self.taken);
        let mut said = self.name_what_is_solved(&mut writing, drafts.len());
        let mut radicands = writing.formulas.split_off(drafts.len()).into_iter();
        let hidden: Vec<Identifier> = writing
            .definitions
            .iter()
            .filter(|apart| apart.reader >= drafts.len())
            .map(|apart| apart.name.clone())
            .collect();
        let mut lines: Vec<Line> = Vec::new();
        let mut under_roots: Vec<(Subject, Formula, bool)> = Vec::new();
        let mut waiting = writing.definitions;
        for (k, (draft, right)) in drafts.into_iter().zip(writing.formulas).enumerate() {
            let (now, later) = waiting.into_iter().partition(|apart| apart.reader == k);
            waiting = later;
            for apart in now {
                self.taken.insert(apart.name.text.clone());
                // What has no value is a result of a linear system or of an iteration: its name says what it is.
                let Some(right) = apart.value else { continue };
                let says = said.remove(&apart.name);
                let equation = Equation { left: Formula::Name(apart.name), right };
                lines.push(Line { subject: Subject::Definition, equation, says });
            }
            let radicand = draft.radicand.and_then(|root| Some((root, radicands.next()?)));
            under_roots
                .extend(radicand.map(|(root, radicand)| (draft.subject, radicand, domains::is_square(&e.g, root))));
            let equation = Equation { left: draft.left, right };
            lines.push(Line { subject: draft.subject, equation, says: draft.says });
        }
        if shortens {
            lines = rows::shortened(lines, &mut self.taken);
        }
        let part = |subject| apart::part_of(e.scene.model, &e.scene.structure, subject);
        let renamed = apart::by_element(&mut lines, &part, &mut self.taken);
        for (subject, mut radicand, is_square) in under_roots {
            apart::rename(&mut radicand, &renamed);
            // What has a line has a name.
            let apart =
                lines.iter().find(|line| line.subject == Subject::Definition && line.equation.right == radicand);
            radicand = apart.map_or(radicand, |line| line.equation.left.clone());
            for line in lines.iter_mut().filter(|line| line.subject == subject) {
                let real = domains::real(&radicand, is_square, &line.equation.right, &hidden);
                line.says = domains::joined(line.says.take(), Some(real));
            }
        }
        lines
    }

    /// Gives what closed forms are made of the names that it has in books, and says what it is.
    fn name_what_is_solved(&mut self, writing: &mut Writing, drafts: usize) -> HashMap<Identifier, String> {
        let mut renamed = apart::Renamed::new();
        let mut said = HashMap::new();
        for apart in writing.definitions.iter_mut().filter(|apart| apart.reader < drafts && apart.value.is_some()) {
            if let Some((name, says)) = apart.label.as_ref().and_then(|label| self.solved.remove(label)) {
                said.insert(name.clone(), says);
                renamed.insert(std::mem::replace(&mut apart.name, name.clone()), name);
            }
        }
        let apart = writing.definitions.iter_mut().filter_map(|apart| apart.value.as_mut());
        writing.formulas.iter_mut().chain(apart).for_each(|formula| apart::rename(formula, &renamed));
        said
    }

    fn section(&mut self, title: &'static str, says: Vec<String>, lines: Vec<Line>) {
        if !lines.is_empty() || !says.is_empty() {
            self.page.sections.push(Section { title, says, lines });
        }
    }

    fn name(&self, e: &Equations<'_>, symbol: Scalar) -> Formula {
        let known = e.g.symbol_id(symbol).and_then(|id| self.identifiers.get(&id));
        Formula::Name(known.cloned().or_fault("every symbol of a page has a name"))
    }

    /// Coordinates with a prescribed course.
    fn drives(&mut self, e: &mut Equations<'_>, reduction: &Reduction) {
        let structure = Rc::clone(&e.scene.structure);
        let mut drafts = Vec::new();
        for (joint, roles) in structure.roles.iter().enumerate() {
            for index in (0..roles.len()).filter(|&index| matches!(roles[index], Role::Driven(_))) {
                let coordinate = Coordinate { joint: JointId(joint), index };
                for (order, symbol) in e.coordinate_symbols(coordinate).into_iter().enumerate() {
                    let value = e.g.symbol_id(symbol).and_then(|id| reduction.map.get(&id).copied());
                    let Some(value) = value else { continue };
                    let left = self.name(e, symbol);
                    drafts.push(Draft::new(Subject::Driven(coordinate, order), left, value));
                }
            }
        }
        let lines = self.lines(e, drafts);
        self.section("Prescribed coordinates", Vec::new(), lines);
    }

    /// Rates of the user's own states, and outputs.
    fn own(&mut self, e: &mut Equations<'_>, motion: &Following) {
        let model = e.scene.model;
        let mut drafts = Vec::new();
        for (k, state) in model.states.iter().enumerate() {
            let value = e.scalar(&state.rate);
            let value = e.put_in_stand_ins(&[value])[0];
            let name = self.name(e, e.scene.symbols.states[k]);
            let left = match name {
                Formula::Name(identifier) => Formula::Name(Identifier { dots: 1, ..identifier }),
                other => other,
            };
            drafts.push(Draft::new(Subject::StateRate(k), left, value));
        }
        let lines = self.lines(e, drafts);
        self.section("States", Vec::new(), lines);
        let mut drafts = Vec::new();
        let mut solved = Vec::new();
        let mut place = 0;
        for output in &model.outputs {
            let value = e.value(&output.value);
            let mut flat = Vec::new();
            value.flatten(&mut e.g, &mut flat);
            let flat = e.put_in_stand_ins(&flat);
            for (k, &value) in flat.iter().enumerate() {
                let index = (flat.len() > 1).then(|| component(&output.value.ty, k));
                let text = path(model, &output.place);
                let left = Formula::Name(Identifier { index, ..named_by(text) });
                if !has_block(&e.g, value) {
                    drafts.push(Draft::new(Subject::Output(place + k), left, value));
                }
            }
            if flat.iter().any(|&value| has_block(&e.g, value)) {
                solved.push(format!("`{}`", path(model, &output.place)));
            }
            place += flat.len();
        }
        let says = match solved.is_empty() {
            true => Vec::new(),
            false => vec![format!("Solved for, without a formula, by elimination with pivots: {}.", solved.join(", "))],
        };
        let read: Vec<Scalar> = drafts.iter().map(|draft| draft.value).collect();
        drafts.splice(0..0, self.accelerations(e, motion, &read));
        let lines = self.lines(e, drafts);
        self.section("Outputs", says, lines);
    }

    /// What velocities stand for, and equations that rates follow from.
    fn velocities(&mut self, e: &mut Equations<'_>) {
        let (model, structure) = (e.scene.model, Rc::clone(&e.scene.structure));
        let mut drafts = Vec::new();
        let mechanism = Rc::clone(&e.scene.mechanism);
        for (number, speed) in model.speeds.iter().enumerate() {
            // Those of a ball are what they stand for already.
            let ball = mechanism.balls.iter().find(|ball| (ball.speed..ball.speed + 3).contains(&number));
            let value = match ball {
                Some(ball) => e.turned_by_hinges(ball)[number - ball.speed],
                None => e.scalar(&speed.value),
            };
            let value = e.put_in_stand_ins(&[value])[0];
            let left = self.name(e, e.scene.symbols.speeds[number][0]);
            drafts.push(Draft::new(Subject::Speed(number), left, value));
        }
        for &row in &structure.rates.rows {
            let Some(rate) = e.rate_expression(row) else { continue };
            let rate = e.put_in_stand_ins(&[rate])[0];
            let name = self.letters.entry("Phi", row_name(model, row.closing, row.index));
            drafts.push(Draft::new(Subject::Rolling(row), Formula::Name(name), rate));
        }
        let mut says = Vec::new();
        if !structure.rates.rows.is_empty() {
            says.push(self.letters.sentence("`Phi` is zero in all motions: so rates follow from the others."));
        }
        let lines = self.lines_with(e, drafts, false);
        self.section("Velocities", says, lines);
    }

    /// Coordinates that follow from others: positions, rates, accelerations.
    fn followers(&mut self, e: &mut Equations<'_>, reduction: &Reduction, motion: &Following) {
        let mut drafts = Vec::new();
        let mut says = Vec::new();
        let structure = Rc::clone(&e.scene.structure);
        for step in &structure.steps {
            if let Means::Newton { rows, .. } = &step.means {
                let names: Vec<String> = step
                    .unknowns
                    .iter()
                    .map(|&unknown| format!("`{}`", coordinate_name(e.scene.model, unknown)))
                    .collect();
                let solved = self.letters.sentence(
                    "with them `Phi` of their loops is zero, and the derivatives of `Phi` by them are the matrix of the linear \
                     systems that give their rates and accelerations.",
                );
                says.push(format!("Newton's method finds {}: {solved}", names.join(", ")));
                for &row in rows {
                    let residual = e.row(row);
                    let residual = e.put_in_stand_ins(&[residual])[0];
                    let name = self.letters.entry("Phi", row_name(e.scene.model, row.closing, row.index));
                    drafts.push(Draft::new(Subject::Closing(row), Formula::Name(name), residual));
                }
            }
        }
        let conditions = self.conditions(e, reduction);
        for definition in &reduction.definitions {
            self.follower(e, reduction, &conditions, definition.coordinate, definition.position, &mut drafts);
        }
        for named in &motion.named {
            self.identifiers.extend(e.g.symbol_id(named.symbol).map(|id| (id, named.name.clone())));
        }
        // Each after what it reads: slopes, rates, what is left of accelerations.
        let rates = self.rates(e, motion);
        let (slopes, rests): (Vec<&Named>, Vec<&Named>) =
            motion.named.iter().partition(|named| matches!(named.subject, Subject::Follows(..)));
        let draft = |named: &&Named| Draft::new(named.subject, Formula::Name(named.name.clone()), named.value);
        let written = |named: &&&Named| !has_block(&e.g, named.value);
        drafts.extend(slopes.iter().filter(written).map(draft));
        drafts.extend(rates);
        drafts.extend(rests.iter().filter(written).map(draft));
        let lines = self.lines(e, drafts);
        let is_unsolved = |unknown: &Coordinate| {
            let row = &motion.map[e.freedom(*unknown)];
            motion.named.iter().any(|named| row.contains(&named.symbol) && has_block(&e.g, named.value))
        };
        self.page.unsolved = structure.rates.unknowns.iter().copied().filter(is_unsolved).collect();
        if !self.page.unsolved.is_empty() {
            let rates = self.page.unsolved.iter().map(|&c| format!("`{}`", coordinate_name(e.scene.model, c)));
            let rates = rates.collect::<Vec<_>>().join(", ");
            says.push(self.letters.sentence(&format!(
                "The equations of velocities above give the rates of {rates} by elimination with pivots: `S` are the slopes of that \
                 solution, `gamma` what is left of its derivative by time, and neither has a formula."
            )));
        }
        if !motion.definitions.is_empty() {
            // Speeds take the place of the state's rates, and may have a share of time beside them.
            let says_of = match (structure.has_speeds(), slopes.is_empty()) {
                (true, true) => {
                    "`gamma` is what is left of the acceleration of what follows where those of the velocities are zero."
                }
                (true, false) => {
                    "`S` are the slopes of what follows by the velocities u, `gamma` what is left of its acceleration where u' is zero: \
                     x' = S u and what time and drives add, x'' = S u' + gamma."
                }
                (false, _) => {
                    "`S` are the slopes of what follows by the state's velocities, `gamma` what is left of its acceleration where those of \
                     the state are zero: x' = S q', x'' = S q'' + gamma."
                }
            };
            says.push(self.letters.sentence(says_of));
        }
        self.section("Coordinates that follow", says, lines);
    }

    /// Rates of what follows: by the slopes, or as they come where a drive or time moves loops too.
    fn rates(&self, e: &mut Equations<'_>, motion: &Following) -> Vec<Draft> {
        let follow = motion.definitions.iter().map(|definition| definition.coordinate);
        let own = follow.chain(e.scene.structure.speeds().iter().copied());
        let rest: Vec<(Scalar, Scalar)> = own.map(|c| (e.velocity_symbols(c)[0], Scalar::ZERO)).collect();
        let rest = e.map(&rest);
        let rates: Vec<Scalar> = motion.definitions.iter().map(|definition| definition.rate).collect();
        let rates = e.put_in_stand_ins(&rates);
        let drifts = e.g.substitute(&rates, &rest);
        let moved = drifts.iter().any(|&drift| drift != Scalar::ZERO);
        let state: Vec<Scalar> = e.scene.structure.speeds().iter().map(|&c| e.velocity_symbols(c)[0]).collect();
        let mut drafts = Vec::new();
        for (definition, rate) in motion.definitions.iter().zip(rates) {
            let row = &motion.map[e.freedom(definition.coordinate)];
            let terms: Vec<Scalar> = row.iter().zip(&state).map(|(&slope, &v)| e.g.mul(slope, v)).collect();
            let value = if moved { rate } else { e.g.sum(&terms) };
            if !has_block(&e.g, value) {
                let left = self.name(e, e.coordinate_symbols(definition.coordinate)[1]);
                drafts.push(Draft::new(Subject::Rate(definition.coordinate), left, value));
            }
        }
        drafts
    }

    /// Accelerations of what follows, of those that values read.
    fn accelerations(&self, e: &mut Equations<'_>, motion: &Following, values: &[Scalar]) -> Vec<Draft> {
        let read: HashSet<usize> = e.g.reachable_scalars(values).into_iter().collect();
        let state: Vec<Scalar> = e.scene.structure.speeds().iter().map(|&c| e.velocity_symbols(c)[1]).collect();
        let mut drafts = Vec::new();
        for definition in &motion.definitions {
            let acceleration = e.coordinate_symbols(definition.coordinate)[2];
            if !read.contains(&acceleration.index()) {
                continue;
            }
            let row = &motion.map[e.freedom(definition.coordinate)];
            let mut terms: Vec<Scalar> = row.iter().zip(&state).map(|(&slope, &a)| e.g.mul(slope, a)).collect();
            terms.extend(e.g.symbol_id(acceleration).map(|id| motion.still[&id]));
            let value = e.g.sum(&terms);
            let left = self.name(e, acceleration);
            drafts.push(Draft::new(Subject::Acceleration(definition.coordinate), left, value));
        }
        drafts
    }

    /// What chooses the solutions of loops, by the coordinate that each condition is about.
    fn conditions(&self, e: &mut Equations<'_>, reduction: &Reduction) -> Conditions {
        let values = domains::chosen(e, reduction);
        let wanted: Vec<Wanted> = values.iter().map(|&(_, value)| Wanted { value, collect: Vec::new() }).collect();
        let symbol = |id: SymbolId| self.identifiers.get(&id).cloned().or_fault("every symbol of a page has a name");
        let external = |call: Call| plain(external(e.scene.model, call));
        let names = Names { symbol: &symbol, external: &external };
        let writing = write::write(&e.g, &wanted, &names, &self.taken);
        let mut conditions = Conditions::new();
        // What is too long for one formula is said in the model.
        if writing.definitions.is_empty() {
            for ((coordinate, _), formula) in values.into_iter().zip(&writing.formulas) {
                conditions.entry(coordinate).or_default().push(format!("`{}`", domains::condition(formula)));
            }
        }
        conditions
    }

    fn follower(
        &self,
        e: &mut Equations<'_>,
        reduction: &Reduction,
        conditions: &Conditions,
        coordinate: Coordinate,
        position: Scalar,
        drafts: &mut Vec<Draft>,
    ) {
        let name = self.name(e, e.coordinate_symbols(coordinate)[0]);
        let position = e.put_in_stand_ins(&[position])[0];
        let root = reduction.dead_centres.iter().find(|centre| centre.0 == coordinate).map(|centre| centre.1);
        // Where conditions are evaluated at run time, the formula is none where they fail too.
        let root = root.filter(|_| !domains::is_chosen(&e.g, position));
        let radicand = root.and_then(|root| {
            let root = e.put_in_stand_ins(&[root])[0];
            domains::radicand(&mut e.g, root)
        });
        let says = conditions.get(&coordinate).map(|list| format!("the branch with {}", list.join(", ")));
        let less = root.filter(|_| radicand.is_none()).map(|_| domains::BETWEEN.to_owned());
        let says = domains::joined(says, less);
        if let ScalarNode::Angle(cos, sin) = *e.g.node(position) {
            let sin = if position.is_negative() { -sin } else { sin };
            let of = |function| Formula::Apply(function, vec![name.clone()]);
            drafts.push(Draft { says, radicand, ..Draft::new(Subject::Cosine(coordinate), of(Function::Cos), cos) });
            drafts.push(Draft::new(Subject::Sine(coordinate), of(Function::Sin), sin));
        } else if !has_block(&e.g, position) {
            drafts.push(Draft { says, radicand, ..Draft::new(Subject::Position(coordinate), name, position) });
        }
    }

    /// Equations that keep multipliers.
    fn constraints(&mut self, e: &mut Equations<'_>, following: &Following) {
        let structure = Rc::clone(&e.scene.structure);
        let mut drafts = Vec::new();
        for &row in &structure.rows {
            let residual = e.rate_expression(row).unwrap_or_else(|| e.row(row));
            let residual = e.put_in_stand_ins(&[residual])[0];
            let name = self.letters.entry("Phi", row_name(e.scene.model, row.closing, row.index));
            drafts.push(Draft::new(Subject::Constraint(row), Formula::Name(name), residual));
        }
        for (k, &row) in structure.rows.iter().enumerate() {
            let (rate, _) = e.row_rates(row);
            let rate = e.put_in_stand_ins(&[rate])[0];
            for (j, &coordinate) in structure.speeds().iter().enumerate() {
                let seeds = following.along(e, j);
                let slope = e.g.derivative(rate, &seeds);
                if slope == Scalar::ZERO {
                    continue;
                }
                self.sloped.insert((k, j));
                let index = format!(
                    "{}, {}",
                    row_name(e.scene.model, row.closing, row.index),
                    coordinate_name(e.scene.model, coordinate)
                );
                let name = Formula::Name(self.letters.entry("G", index));
                drafts.push(Draft::new(Subject::Slope(k, j), name, slope));
            }
        }
        let lines = self.lines_with(e, drafts, false);
        let closing = |subject| match subject {
            Subject::Constraint(row) => Some(row.closing),
            Subject::Slope(k, _) => Some(structure.rows[k].closing),
            _ => None,
        };
        let part = |subject| apart::part_of(e.scene.model, &structure, subject);
        let lines = rows::shared(lines, &closing, &part, &mut self.taken);
        let says = match lines.is_empty() {
            true => Vec::new(),
            false => vec![
                self.letters
                    .sentence("Each is zero where its loop is closed; `G` is their Jacobian by the velocities."),
            ],
        };
        self.section("Constraints", says, lines);
    }

    /// Equations of motion, their mass matrix and parts.
    fn motion(&mut self, e: &mut Equations<'_>, following: &Following) {
        let structure = Rc::clone(&e.scene.structure);
        if e.is_first_order() && !structure.steps.is_empty() {
            // What follows is a symbol here, so nothing could be expanded in what it follows from.
            let says = "Equations of motion are taken to first order in what is small, with all that follows put in: too long to be \
                        written.";
            self.section("Equations of motion", vec![says.to_owned()], Vec::new());
            return;
        }
        let state = structure.speeds().to_vec();
        let names: Vec<String> = state.iter().map(|&c| coordinate_name(e.scene.model, c)).collect();
        let matrix = following.mass_matrix(e);
        let Parts { inertial, gravity, forces } = e.parts(LoadCase::Declared);
        let inertial = e.g.substitute(&inertial, &following.still);
        let [velocity, gravity, forces] = [inertial, gravity, forces].map(|list| {
            let list = following.project(e, &list);
            e.first_order(&list)
        });
        let matrix: Vec<Vec<Scalar>> = matrix.iter().map(|row| e.first_order(row)).collect();
        let accelerations: Vec<Scalar> = state.iter().map(|&c| e.velocity_symbols(c)[1]).collect();
        let held = self.held(e, following);
        let mut drafts = Vec::new();
        for (i, name) in names.iter().enumerate() {
            for (j, other) in names.iter().enumerate().skip(i) {
                let left = Formula::Name(self.letters.entry("M", format!("{name}, {other}")));
                drafts.push(Draft::new(Subject::Mass(i, j), left, matrix[i][j]));
            }
        }
        let parts: [Part<'_>; 3] =
            [("c", Subject::Inertial, &velocity), ("g", Subject::Gravity, &gravity), ("Q", Subject::Force, &forces)];
        for (letter, subject, list) in parts {
            for (i, name) in names.iter().enumerate() {
                let left = Formula::Name(self.letters.entry(letter, name.clone()));
                drafts.push(Draft::new(subject(i), left, list[i]));
            }
        }
        let full: Vec<Draft> = (0..names.len())
            .map(|i| {
                let terms: Vec<Scalar> =
                    accelerations.iter().enumerate().map(|(j, &a)| e.g.mul(matrix[i][j], a)).collect();
                let sum: Vec<Scalar> = terms.into_iter().chain([velocity[i], gravity[i]]).collect();
                let left = e.g.sum(&sum);
                let right = e.g.add(forces[i], held[i]);
                let left =
                    Draft { collect: accelerations.clone(), ..Draft::new(Subject::Motion(i), Formula::zero(), left) };
                [left, Draft::new(Subject::Motion(i), Formula::zero(), right)]
            })
            .collect::<Vec<_>>()
            .into_iter()
            .flatten()
            .collect();
        let before = (self.taken.clone(), self.solved.clone());
        let written = self.lines_with(e, full, false);
        let rows = if written
            .iter()
            .all(|line| line.subject != Subject::Definition && line.equation.right.length() <= MOST_WRITTEN_OUT)
        {
            written.chunks(2).enumerate().filter_map(|(i, pair)| pair_up(i, pair)).collect()
        } else {
            (self.taken, self.solved) = before;
            self.by_name(e, &names, &held, &matrix, [&velocity, &gravity, &forces])
        };
        self.section("Equations of motion", Vec::new(), rows);
        let lines = self.lines(e, drafts);
        let held = if structure.rows.is_empty() { "" } else { " - G^T lambda" };
        let says = format!(
            "`M` is the mass matrix, symmetric; `c` are the terms of velocities, `g` those of gravity, `Q` those of forces: \
             M a + c + g = Q{held}."
        );
        self.section("Mass matrix and forces", vec![self.letters.sentence(&says)], lines);
    }

    /// Efforts of the multipliers on the state.
    fn held(&self, e: &mut Equations<'_>, following: &Following) -> Vec<Scalar> {
        if e.scene.structure.rows.is_empty() {
            return vec![Scalar::ZERO; e.scene.structure.freedoms()];
        }
        let [all, declared] = [LoadCase::Held, LoadCase::Declared].map(|case| {
            let forces = e.parts(case).forces;
            following.project(e, &forces)
        });
        all.iter().zip(&declared).map(|(&a, &b)| e.g.sub(a, b)).collect()
    }

    /// Equations of motion in the names of their parts, without those that are zero.
    fn by_name(
        &self,
        e: &Equations<'_>,
        names: &[String],
        held: &[Scalar],
        matrix: &[Vec<Scalar>],
        [velocity, gravity, forces]: [&[Scalar]; 3],
    ) -> Vec<Line> {
        let structure = &e.scene.structure;
        let named = |letter: &str, index: String| Formula::Name(self.letters.entry(letter, index));
        let part = |letter: &str, list: &[Scalar], i: usize| {
            (list[i] != Scalar::ZERO).then(|| (false, named(letter, names[i].clone())))
        };
        let rows = names.iter().enumerate().map(|(i, name)| {
            let mut left: Vec<(bool, Formula)> = Vec::new();
            for (j, &coordinate) in structure.speeds().iter().enumerate().filter(|&(j, _)| matrix[i][j] != Scalar::ZERO)
            {
                let mass = named("M", format!("{}, {}", names[i.min(j)], names[i.max(j)]));
                let acceleration = self.name(e, e.velocity_symbols(coordinate)[1]);
                left.push((false, Formula::Product(vec![mass, acceleration])));
            }
            left.extend(part("c", velocity, i));
            left.extend(part("g", gravity, i));
            let mut right: Vec<(bool, Formula)> = part("Q", forces, i).into_iter().collect();
            if held[i] != Scalar::ZERO {
                for (k, &row) in structure.rows.iter().enumerate().filter(|(k, _)| self.sloped.contains(&(*k, i))) {
                    let index = format!("{}, {name}", row_name(e.scene.model, row.closing, row.index));
                    let lambda = self.name(e, e.scene.symbols.multipliers[k]);
                    right.push((true, Formula::Product(vec![named("G", index), lambda])));
                }
            }
            let equation = Equation { left: sum(left), right: sum(right) };
            Line { subject: Subject::Motion(i), equation, says: None }
        });
        rows.collect()
    }
}

/// Terms with whether each is subtracted.
fn sum(mut terms: Vec<(bool, Formula)>) -> Formula {
    match terms.len() {
        0 => Formula::zero(),
        1 => {
            let (is_minus, term) = terms.remove(0);
            if is_minus { Formula::Minus(Box::new(term)) } else { term }
        }
        _ => Formula::Sum(terms),
    }
}

/// The name of an output.
fn named_by(text: String) -> Identifier {
    Identifier { text, dots: 0, index: None, class: Class::Defined, typed: false }
}

/// Name of a component of an output.
fn component(ty: &Type, k: usize) -> String {
    match ty {
        Type::Vec3 => ["x", "y", "z"][k % 3].to_owned(),
        Type::Array(inner, _) => {
            let width = inner.scalars().max(1);
            if width == 1 { format!("{k}") } else { format!("{}, {}", k / width, component(inner, k % width)) }
        }
        _ => format!("{k}"),
    }
}

/// Whether a value reads a result of a linear system or of an iteration: it has no formula.
fn has_block(g: &Graph, value: Scalar) -> bool {
    g.reachable_scalars(&[value]).into_iter().any(|index| g.is_output(index))
}

/// Left and right side of an equation of motion.
fn pair_up(i: usize, pair: &[Line]) -> Option<Line> {
    let [left, right] = pair else { return None };
    let equation = Equation { left: left.equation.right.clone(), right: right.equation.right.clone() };
    Some(Line { subject: Subject::Motion(i), equation, says: None })
}
