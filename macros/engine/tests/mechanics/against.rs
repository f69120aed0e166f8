//! Closed forms from several closings together, against the same mechanism with multipliers and by Newton's method: positions, rates
//! and accelerations of everything at random poses, on each branch that the conditions choose.

use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::model::types::Coordinate;

use super::support::{Case, Point, Random, case, close};

/// A mechanism as its text.
pub(super) struct Mechanism {
    pub(super) name: &'static str,
    pub(super) items: Vec<&'static str>,
    /// What stands behind the word.
    pub(super) solve: &'static str,
    /// Coordinates of the state that are moved, and how far.
    pub(super) moved: Vec<(&'static str, f64)>,
    pub(super) assumed: &'static str,
    /// One for each solution.
    pub(super) branches: Vec<&'static str>,
    /// As the model addresses them.
    pub(super) coordinates: Vec<&'static str>,
    pub(super) bodies: Vec<&'static str>,
}

impl Mechanism {
    fn text(&self, rest: &str) -> String {
        let mut text = format!("{} {rest} emit forward_dynamics;", self.items.join(" "));
        for (k, address) in self.coordinates.iter().enumerate() {
            text += &format!("output coordinate_{k} = [{address}, {address}.rate];");
        }
        for (k, body) in self.bodies.iter().enumerate() {
            text += &format!(
                "output pose_{k} = {body}.pose; output velocity_{k} = {body}.velocity;
                output spin_{k} = {body}.angular_velocity; output acceleration_{k} = {body}.acceleration;
                output spin_rate_{k} = {body}.angular_acceleration;"
            );
        }
        text
    }

    fn coordinates(&self, case: &Case) -> Vec<Coordinate> {
        self.coordinates.iter().map(|address| self.place(case, address)).collect()
    }

    fn place(&self, case: &Case, address: &str) -> Coordinate {
        let (name, freedom) = address.split_once('.').unwrap_or((address, ""));
        let joint = case.joint(name);
        let freedoms = case.model.joints[joint].kind.freedoms;
        let index = freedoms.iter().position(|one| one.name == freedom).unwrap_or(0);
        Coordinate { joint, index }
    }

    /// At poses all over the range of what is moved.
    pub(super) fn check(&self) {
        let kept = case(&self.text("formulation { constraints: Multipliers }"));
        let moved: Vec<&str> =
            self.moved.iter().map(|moved| moved.0).filter(|name| !self.coordinates.contains(name)).collect();
        let independent =
            if moved.is_empty() { String::new() } else { format!(", independent: [{}]", moved.join(", ")) };
        let independent = format!("formulation {{ constraints: Reduced{independent} }}");
        let newton = case(&self.text(&independent));
        for branch in &self.branches {
            let solve =
                format!("formulation {{ constraints: Reduced }} {} solve {} {{ {branch} }}", self.assumed, self.solve);
            self.compare(branch, &case(&self.text(&solve)), &kept, &newton);
        }
    }

    fn compare(&self, branch: &str, closed: &Case, kept: &Case, newton: &Case) {
        let mut random = Random(23);
        let (mut compared, mut iterated, mut unreal, mut poor) = (0, 0, 0, 0);
        for draw in 0..600 {
            let mut point = closed.random(draw);
            let state = &closed.structure.state;
            let mut positions = Vec::new();
            for &(name, range) in &self.moved {
                let position = range * random.next();
                positions.push(position);
                let place = self.place(closed, name);
                if state.contains(&place) {
                    point.set(Symbol::Position { joint: place.joint, component: place.index }, position);
                }
            }
            for symbol in closed.derivation.symbols.iter().filter(|symbol| matches!(symbol, Symbol::Param { .. })) {
                let declared = point.get(*symbol);
                point.set(*symbol, declared * (1.0 + 0.1 * random.next()));
            }
            let roots = closed.candidate(FunctionKind::DeadCentres, 0, &point);
            if roots.iter().any(|root| root.is_nan()) {
                unreal += 1;
                continue;
            }
            if roots.iter().any(|root| root.abs() < 2e-3) {
                poor += 1;
                continue;
            }
            let outputs = closed.outputs(&point);
            let mut other = kept.random(draw);
            let same = |of: &Case, other: &mut Point| {
                for &Coordinate { joint, index: component } in state {
                    let its = of.joint(&closed.model.joints[joint].place.field.to_string());
                    let position = point.get(Symbol::Position { joint, component });
                    other.set(Symbol::Position { joint: its, component }, position);
                    let velocity = point.get(Symbol::Velocity { joint, component });
                    other.set(Symbol::Velocity { joint: its, component }, velocity);
                }
                let common =
                    |symbol: &&Symbol| matches!(symbol, Symbol::Input { .. } | Symbol::Param { .. } | Symbol::Time);
                closed
                    .derivation
                    .symbols
                    .iter()
                    .filter(common)
                    .for_each(|&symbol| other.set(symbol, point.get(symbol)));
            };
            // The accelerations of the state here.
            let of_state = |of: &Case, accelerations: &[f64]| -> Vec<f64> {
                let places = state.iter().map(|c| {
                    let joint = of.joint(&closed.model.joints[c.joint].place.field.to_string());
                    let own = Coordinate { joint, index: c.index };
                    of.structure.state.iter().position(|other| *other == own).expect("a state there")
                });
                places.map(|place| accelerations[place]).collect()
            };
            same(kept, &mut other);
            for (k, coordinate) in self.coordinates(kept).into_iter().enumerate() {
                let [value, rate] = outputs[&format!("coordinate_{k}")][..] else { panic!("a value and its rate") };
                let Coordinate { joint, index: component } = coordinate;
                other.set(Symbol::Position { joint, component }, value);
                other.set(Symbol::Velocity { joint, component }, rate);
            }
            let what = format!("{}, {branch}, at {positions:?}", self.name);
            for kind in [FunctionKind::Constraints, FunctionKind::ConstraintRate] {
                let open = kept.candidate(kind, 0, &other);
                assert!(open.iter().all(|gap| gap.abs() < 1e-9), "{what}: {kind:?} {open:?}");
            }
            let own = closed.candidate(FunctionKind::ForwardDynamics, 0, &point);
            let its = kept.candidate(FunctionKind::ForwardDynamics, 0, &other);
            close(&what, &own[..state.len()], &of_state(kept, &its), 1e-7);
            // Bodies move alike, accelerations too.
            let all = kept.outputs(&other);
            for (name, values) in &outputs {
                close(&format!("{what}: {name}"), values, &all[name], 1e-6);
            }
            let mut guessed = newton.random(draw);
            same(newton, &mut guessed);
            let places: Vec<Coordinate> = self.coordinates(newton);
            for (index, coordinate) in newton.structure.guessed().iter().enumerate() {
                let k = places.iter().position(|other| other == coordinate).expect("a coordinate");
                let value = outputs[&format!("coordinate_{k}")][0];
                guessed.set(Symbol::Guess { index }, value + 1e-4 * random.next());
            }
            let found = newton.candidate(FunctionKind::ForwardDynamics, 0, &guessed);
            if found.last().is_some_and(|&residual| residual < 1e-12) {
                close(&format!("{what}, by Newton's method"), &own[..state.len()], &of_state(newton, &found), 1e-7);
                iterated += 1;
            }
            compared += 1;
        }
        println!(
            "{}, {branch}: {compared} poses, {iterated} by Newton's method too, {unreal} unreal, {poor} poor",
            self.name
        );
        assert!(compared > 40 && 10 * iterated > 9 * compared, "{compared} poses, {iterated} by Newton's method");
    }
}
