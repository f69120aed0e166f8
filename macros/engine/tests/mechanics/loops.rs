//! Reactions in closed loops: Newton's and Euler's laws for every body with all that acts on it, eliminated coordinates
//! against multipliers, and efforts of drives.

use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::model::types::Coordinate;

use super::support::*;

/// What acts from outside: gravity, and wind at a place of the third body.
struct Outside {
    gravity: [f64; 3],
    wind: [f64; 3],
}

const GRAVITY: [f64; 3] = [1.0, -9.0, 2.0];
const OUTSIDE: Outside = Outside { gravity: GRAVITY, wind: [3.0, -2.0, 5.0] };
/// In the plane of bars, whose hinges share all other loads as rigid bodies don't tell.
const IN_PLANE: Outside = Outside { gravity: [1.0, -9.0, 0.0], wind: [3.0, -2.0, 0.0] };

/// A body: name, mass, centre of mass, moments of inertia and products; joints that it hangs on with the sign of their
/// reactions.
struct Body {
    name: &'static str,
    mass: f64,
    com: [f64; 3],
    inertia: [f64; 6],
    joints: &'static [(&'static str, f64)],
}

const ONE: Body = Body {
    name: "one",
    mass: 1.0,
    com: [0.5, 0.1, 0.2],
    inertia: [0.5, 0.6, 0.7, 0.02, -0.03, 0.01],
    joints: &[("crank", 1.0), ("coupler", -1.0)],
};
const TWO: Body = Body {
    name: "two",
    mass: 0.7,
    com: [1.1, -0.2, 0.1],
    inertia: [0.3, 0.2, 0.4, 0.01, 0.02, -0.01],
    joints: &[("coupler", 1.0), ("pin", -1.0)],
};
const THREE: Body = Body {
    name: "three",
    mass: 1.3,
    com: [0.9, 0.2, -0.1],
    inertia: [0.4, 0.5, 0.3, -0.02, 0.01, 0.03],
    joints: &[("rocker", 1.0), ("pin", 1.0)],
};

/// A body's text, and outputs that tell all of its motion.
fn text_of(body: &Body) -> String {
    let Body { name, mass, com, inertia: [a, b, c, d, e, f], .. } = body;
    format!(
        "body {name} {{ mass: {mass:?}, com: {com:?}, inertia: inertia({a:?}, {b:?}, {c:?}, {d:?}, {e:?}, {f:?}) }}
        output {name}_com = {name}.at({com:?}).position;
        output {name}_acceleration = {name}.at({com:?}).acceleration;
        output {name}_rotation = {name}.rotation;
        output {name}_spin = {name}.angular_velocity;
        output {name}_spin_rate = {name}.angular_acceleration;"
    )
}

/// Outputs of the joints: where they act, and what they transmit.
fn joints(list: &[(&str, &str)]) -> String {
    list.iter()
        .map(|(joint, frame)| {
            format!("output {joint}_at = {frame}.position; output {joint}_reaction = {joint}.reaction;")
        })
        .collect()
}

const BARS: [&Body; 3] = [&ONE, &TWO, &THREE];

const FLAT: [&Body; 3] = [
    &Body { com: [0.5, 0.1, 0.0], inertia: [0.5, 0.6, 0.7, 0.02, 0.0, 0.0], ..ONE },
    &Body { com: [1.1, -0.2, 0.0], inertia: [0.3, 0.2, 0.4, 0.01, 0.0, 0.0], ..TWO },
    &Body { com: [0.9, 0.2, 0.0], inertia: [0.4, 0.5, 0.3, -0.02, 0.0, 0.0], ..THREE },
];

/// Bars in a plane, with a torque, wind, and what is read of them.
fn four_bar(items: &str, pin: &str) -> String {
    let read = joints(&[("crank", "one"), ("coupler", "two"), ("rocker", "three"), ("pin", "three.at(2.0 * X)")]);
    bars(&format!("{items} {read}"), pin)
}

fn bars(items: &str, pin: &str) -> String {
    let Outside { gravity, wind } = IN_PLANE;
    format!(
        "world {{ gravity: {gravity:?} }}
        {} {items}
        joint crank: Revolute {{ parent: ground, child: one, axis: Z }}
        joint coupler: Revolute {{ parent: one.at(X), child: two, axis: Z }}
        joint rocker: Revolute {{ parent: ground.at(3.0 * X), child: three, axis: Z }}
        #[cut]
        joint pin: {pin} {{ parent: two.at(2.5 * X), child: three.at(2.0 * X), axis: Z }}
        force wind: Force {{ at: three.at([0.3, 0.2, 0.0]), value: {wind:?}, axes: ground }}
        force motor: Effort {{ joint: crank, value: 4.0 }}
        output place = three.at([0.3, 0.2, 0.0]).position;
        output values = [coupler, rocker];
        output rates = [coupler.rate, rocker.rate];
        emit forward_dynamics;",
        FLAT.map(text_of).concat()
    )
}

fn vector(case: &Case, name: &str, point: &Point) -> [f64; 3] {
    let list = case.output(name, point);
    std::array::from_fn(|k| list[k])
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| a[k] - b[k])
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// What is left of m (a - g) = F and of J w' + w x J w = M about the centre of mass, with further forces at points and
/// moments.
fn imbalance(case: &Case, point: &Point, body: &Body, gravity: [f64; 3], others: &[([f64; 3], [f64; 3])]) -> [f64; 6] {
    let get = |what: &str| vector(case, &format!("{}_{what}", body.name), point);
    let (com, a, w, alpha) = (get("com"), get("acceleration"), get("spin"), get("spin_rate"));
    let r = case.output(&format!("{}_rotation", body.name), point);
    let r: Matrix = std::array::from_fn(|i| std::array::from_fn(|j| r[3 * i + j]));
    let [xx, yy, zz, xy, xz, yz] = body.inertia;
    let tensor = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
    let tensor = times(&times(&r, &tensor), &transpose(&r));
    let mut force = minus(a, gravity).map(|x| body.mass * x);
    let mut moment = plus(&apply(&tensor, &alpha), &cross(w, apply(&tensor, &w)));
    let mut act = |at: [f64; 3], f: [f64; 3], m: [f64; 3]| {
        force = minus(force, f);
        moment = minus(moment, plus(&m, &cross(minus(at, com), f)));
    };
    for (joint, sign) in body.joints {
        let reaction = case.output(&format!("{joint}_reaction"), point);
        let at = vector(case, &format!("{joint}_at"), point);
        act(at, std::array::from_fn(|k| sign * reaction[k]), std::array::from_fn(|k| sign * reaction[3 + k]));
    }
    for &(at, f) in others {
        act(at, f, [0.0; 3]);
    }
    [force, moment].concat().try_into().expect("six")
}

/// Newton's method to its end, from a start near by.
fn settle(case: &Case, point: &mut Point, start: &[f64]) {
    let mut guess = start.to_vec();
    for _ in 0..5 {
        for (index, &value) in guess.iter().enumerate() {
            point.set(Symbol::Guess { index }, value);
        }
        guess = case.eval(FunctionKind::Guess, point);
        let residual = guess.pop().expect("a residual");
        assert!(residual < 1.0, "{residual}");
    }
}

/// All bodies balance, with the wind on one of them.
fn balanced(what: &str, case: &Case, point: &Point, bodies: &[&Body], outside: &Outside) {
    let wind = [(vector(case, "place", point), outside.wind)];
    for body in bodies {
        let others = if body.name == "three" { &wind[..] } else { &[] };
        close(
            &format!("{what}: {}", body.name),
            &imbalance(case, point, body, outside.gravity, others),
            &[0.0; 6],
            1e-11,
        );
    }
}

/// A coordinate by its joint and number.
type Name = (&'static str, usize);

fn symbols(case: &Case, (joint, component): Name) -> [Symbol; 2] {
    let joint = case.joint(joint);
    [Symbol::Position { joint, component }, Symbol::Velocity { joint, component }]
}

/// The same point in another model: coordinates that are free in both, and those that the first has found.
fn taken(case: &Case, of: &Case, point: &Point, free: &[Name], found: &[Name]) -> Point {
    let mut other = case.random(1);
    for &name in free {
        for (to, from) in symbols(case, name).into_iter().zip(symbols(of, name)) {
            other.set(to, point.get(from));
        }
    }
    let values = [of.output("values", point), of.output("rates", point)];
    for (k, &name) in found.iter().enumerate() {
        for (to, values) in symbols(case, name).into_iter().zip(&values) {
            other.set(to, values[k]);
        }
    }
    other.set(Symbol::Time, point.get(Symbol::Time));
    other
}

fn agree(what: &str, names: &[&str], a: (&Case, &Point), b: (&Case, &Point)) {
    for name in names {
        close(&format!("{what}: {name}"), &a.0.output(name, a.1), &b.0.output(name, b.1), 1e-10);
    }
}

const REACTIONS: [&str; 4] = ["crank_reaction", "coupler_reaction", "rocker_reaction", "pin_reaction"];

const REDUCED: &str = "formulation { constraints: Reduced }";

#[test]
fn four_bars_balance() {
    let pump = "force pump: Effort { joint: pin, value: 3.0 }";
    for (pin, items, moment) in [("Revolute", pump, 3.0), ("Cylindrical", "", 0.0)] {
        let held = case(&four_bar(items, pin));
        let reduced = case(&four_bar(&format!("{items} {REDUCED}"), pin));
        for seed in 1..4 {
            let mut point = reduced.random(seed);
            settle(&reduced, &mut point, &[0.3, 1.8]);
            balanced("reduced", &reduced, &point, &FLAT, &IN_PLANE);
            close("about the pin", &reduced.output("pin_reaction", &point)[5..], &[moment], 1e-11);
            close("motor", &reduced.output("crank_reaction", &point)[5..], &[4.0], 1e-11);
            let other = taken(&held, &reduced, &point, &[("crank", 0)], &[("coupler", 0), ("rocker", 0)]);
            balanced("multipliers", &held, &other, &FLAT, &IN_PLANE);
            agree(pin, &REACTIONS, (&held, &other), (&reduced, &point));
        }
    }
}

/// The drive's effort is what the reaction has about the axis beside the motor.
#[test]
fn driven_four_bars_balance() {
    let drive = "drive crank = 0.3 + 0.7 * t + 0.2 * t * t; output effort = crank.effort;";
    let held = case(&four_bar(drive, "Revolute"));
    let reduced = case(&four_bar(&format!("{drive} {REDUCED}"), "Revolute"));
    for seed in 1..4 {
        let mut point = reduced.random(seed);
        settle(&reduced, &mut point, &[0.3, 1.8]);
        balanced("reduced", &reduced, &point, &FLAT, &IN_PLANE);
        let effort = reduced.output("effort", &point)[0];
        close("drive", &reduced.output("crank_reaction", &point)[5..], &[4.0 + effort], 1e-11);
        let other = taken(&held, &reduced, &point, &[], &[("coupler", 0), ("rocker", 0)]);
        balanced("multipliers", &held, &other, &FLAT, &IN_PLANE);
        agree("driven", &REACTIONS, (&held, &other), (&reduced, &point));
        agree("drive", &["effort"], (&held, &other), (&reduced, &point));
    }
}

/// No equation is redundant.
#[test]
fn spatial_loops_balance() {
    let text = |items: &str| {
        format!(
            "world {{ gravity: {GRAVITY:?} }}
            {} {items}
            joint crank: Revolute {{ parent: ground, child: one, axis: Z }}
            joint coupler: Universal {{ parent: one.at(X), child: two, axes: [Z, Y] }}
            joint rocker: Revolute {{ parent: ground.at([3.2, 0.5, -1.0]), child: three, axis: X }}
            #[cut]
            joint pin: Ball {{ parent: two.at(2.27 * X), child: three.at(1.2 * Z) }}
            force wind: Force {{ at: three.at([0.3, 0.2, 0.1]), value: [3.0, -2.0, 5.0], axes: ground }}
            force motor: Effort {{ joint: crank, value: 4.0 }}
            force twist: Effort {{ joint: pin, value: [0.3, -0.5, 0.7] }}
            output place = three.at([0.3, 0.2, 0.1]).position;
            output values = [coupler.first, coupler.second, rocker];
            output rates = [coupler.first.rate, coupler.second.rate, rocker.rate];
            output pin_own = pin.reaction.express(three);
            {}
            emit forward_dynamics;",
            BARS.map(text_of).concat(),
            joints(&[("crank", "one"), ("coupler", "two"), ("rocker", "three"), ("pin", "three.at(1.2 * Z)")])
        )
    };
    let (held, reduced) = (case(&text("")), case(&text(REDUCED)));
    for seed in 1..4 {
        let mut point = reduced.random(seed);
        let crank = symbols(&reduced, ("crank", 0))[0];
        point.set(crank, 0.2 * point.get(crank));
        settle(&reduced, &mut point, &[0.2, -0.1, 0.0]);
        balanced("reduced", &reduced, &point, &BARS, &OUTSIDE);
        // A ball transmits its own torques, given in the child's axes.
        close("twist", &reduced.output("pin_own", &point)[3..], &[0.3, -0.5, 0.7], 1e-11);
        let found = [("coupler", 0), ("coupler", 1), ("rocker", 0)];
        let other = taken(&held, &reduced, &point, &[("crank", 0)], &found);
        balanced("multipliers", &held, &other, &BARS, &OUTSIDE);
        agree("spatial", &REACTIONS, (&held, &other), (&reduced, &point));
    }
}

/// Gears act between coordinates: what they do is part of the joints' reactions.
#[test]
fn geared_loops_balance() {
    const LINK: Body = Body {
        name: "link",
        mass: 0.9,
        com: [0.6, 0.1, 0.0],
        inertia: [0.2, 0.3, 0.25, 0.01, 0.0, 0.0],
        joints: &[("arm", 1.0), ("pin", 1.0)],
    };
    const BASE: Body = Body { joints: &[("rocker", 1.0), ("arm", -1.0)], ..*FLAT[2] };
    let bodies = [FLAT[0], FLAT[1], &BASE, &LINK];
    let Outside { gravity, wind } = IN_PLANE;
    let text = |gear: &str, other: &str, items: &str| {
        format!(
            "world {{ gravity: {gravity:?} }}
            {} {items}
            joint crank: Revolute {{ parent: ground, child: one, axis: Z }}
            joint coupler: Revolute {{ parent: one.at(X), child: two, axis: Z }}
            joint rocker: Revolute {{ parent: ground.at(3.0 * X), child: three, axis: Z }}
            joint arm: Revolute {{ parent: three.at(1.5 * X), child: link, axis: Z }}
            #[cut]
            joint pin: Revolute {{ parent: two.at(2.0 * X), child: link.at(2.0 * X), axis: Z }}
            constraint gear = {gear};
            force wind: Force {{ at: three.at([0.3, 0.2, 0.0]), value: {wind:?}, axes: ground }}
            output place = three.at([0.3, 0.2, 0.0]).position;
            output values = [coupler, {other}];
            output rates = [coupler.rate, {other}.rate];
            {}
            emit forward_dynamics;",
            bodies.map(text_of).concat(),
            joints(&[
                ("crank", "one"),
                ("coupler", "two"),
                ("rocker", "three"),
                ("arm", "link"),
                ("pin", "link.at(2.0 * X)")
            ])
        )
    };
    // A gear gives what the loop is found from.
    for (gear, other, start, [driving, driven], ratio) in
        [("rocker - 1.5 + 0.5 * crank", "arm", [0.9, 1.0], ["crank", "rocker"], 0.5)]
    {
        let (held, reduced) = (case(&text(gear, other, "")), case(&text(gear, other, REDUCED)));
        for seed in 1..4 {
            let mut point = reduced.random(seed);
            let crank = symbols(&reduced, ("crank", 0))[0];
            point.set(crank, 0.3 * point.get(crank));
            settle(&reduced, &mut point, &start);
            balanced("reduced", &reduced, &point, &bodies, &IN_PLANE);
            // The gear's torques do no work together.
            let about = |name: &str| reduced.output(&format!("{name}_reaction"), &point)[5];
            close("gear", &[about(driving)], &[ratio * about(driven)], 1e-11);
            assert!(about(driven).abs() > 1e-3, "{gear}");
            let found = [("coupler", 0), (other, 0)];
            let other = taken(&held, &reduced, &point, &[("crank", 0)], &found);
            balanced("multipliers", &held, &other, &bodies, &IN_PLANE);
            agree("gears", &REACTIONS, (&held, &other), (&reduced, &point));
            agree("gears", &["arm_reaction"], (&held, &other), (&reduced, &point));
        }
    }
}

/// A leg under a body: closed form.
#[test]
fn legs_balance() {
    const CYLINDER: Body = Body { joints: &[("gimbal", 1.0), ("stroke", -1.0)], ..ONE };
    const PISTON: Body = Body { joints: &[("stroke", 1.0), ("ball", -1.0)], ..TWO };
    const PLATFORM: Body = Body { joints: &[("ball", 1.0), ("weld", -1.0)], ..THREE };
    const LOAD: Body = Body {
        name: "load",
        mass: 0.4,
        com: [0.1, 0.2, 0.3],
        inertia: [0.2, 0.3, 0.25, 0.01, -0.01, 0.02],
        joints: &[("weld", 1.0)],
    };
    let bodies = [&CYLINDER, &PISTON, &PLATFORM, &LOAD];
    let text = |items: &str| {
        format!(
            "world {{ gravity: {GRAVITY:?} }}
            {} {items}
            joint base: Free {{ parent: ground, child: three, coordinates: RollPitchYaw }}
            joint weld: Fixed {{ parent: three.at([0.2, 0.1, 0.5]).rotated(Y, 0.4), child: load.at(0.3 * Y) }}
            joint gimbal: Universal {{ parent: ground.at([1.0, 0.5, -3.0]), child: one, axes: [X, Y] }}
            joint stroke: Prismatic {{ parent: one.at(Z), child: two, axis: Z }}
            #[cut]
            joint ball: Ball {{ parent: two.at([0.0, 0.0, 0.2]), child: three.at([0.5, 0.3, -0.2]) }}
            force thrust: Effort {{ joint: stroke, value: 6.0 }}
            force wind: Force {{ at: three.at([0.3, 0.2, 0.1]), value: [3.0, -2.0, 5.0], axes: ground }}
            output place = three.at([0.3, 0.2, 0.1]).position;
            output values = [gimbal.first, gimbal.second, stroke];
            output rates = [gimbal.first.rate, gimbal.second.rate, stroke.rate];
            output free = base.reaction;
            {}
            emit forward_dynamics;",
            bodies.map(text_of).concat(),
            joints(&[
                ("gimbal", "one"),
                ("stroke", "two"),
                ("ball", "three.at([0.5, 0.3, -0.2])"),
                ("weld", "load.at(0.3 * Y)")
            ])
        )
    };
    let solve = "solve (gimbal, stroke) from ball { stroke > -1.0, cos(gimbal.second) > 0.0 }";
    let (held, reduced) = (case(&text("")), case(&text(&format!("{REDUCED} {solve}"))));
    let free: Vec<Name> = (0..6).map(|k| ("base", k)).collect();
    for seed in 1..4 {
        let point = reduced.random(seed);
        balanced("reduced", &reduced, &point, &bodies, &OUTSIDE);
        close("nothing holds", &reduced.output("free", &point), &[0.0; 6], 1e-11);
        let found = [("gimbal", 0), ("gimbal", 1), ("stroke", 0)];
        let other = taken(&held, &reduced, &point, &free, &found);
        balanced("multipliers", &held, &other, &bodies, &OUTSIDE);
        let names = ["gimbal_reaction", "stroke_reaction", "ball_reaction", "weld_reaction"];
        agree("leg", &names, (&held, &other), (&reduced, &point));
    }
}

/// Every kind of joint that can close a loop of a crank, a ball and a slider, against Newton's and Euler's laws.
#[test]
fn every_closing_balances() {
    for pin in [
        "Ball {",
        "Universal { axes: [X, Z],",
        "Revolute { axis: Z,",
        "Cylindrical { axis: [1.0, 2.0, 0.5],",
        "Prismatic { axis: -X,",
        "Screw { axis: Y, pitch: 0.3,",
        "Planar { axis: Y,",
        "PinSlot { axis: [0.0, -1.0, 1.0], slide: [2.0, 1.0, 1.0],",
        "Planar { axes: [-X, [0.0, 1.0, 1.0]],",
        "Fixed {",
    ] {
        let (name, fields) = pin.split_once('{').expect("fields");
        let case = case(&format!(
            "world {{ gravity: {GRAVITY:?} }}
            {}
            joint crank: Ball {{ parent: ground, child: one, coordinates: RollPitchYaw }}
            joint coupler: Ball {{ parent: one.at(X), child: two, coordinates: RollPitchYaw }}
            joint rocker: Free {{ parent: ground, child: three, coordinates: RollPitchYaw }}
            #[cut]
            joint pin: {name} {{ parent: two.at([0.2, 0.1, 0.4]), child: three.at([-0.1, 0.3, 0.2]), {fields} }}
            force wind: Force {{ at: three.at([0.3, 0.2, 0.1]), value: [3.0, -2.0, 5.0], axes: ground }}
            output place = three.at([0.3, 0.2, 0.1]).position;
            {}
            emit forward_dynamics;",
            BARS.map(text_of).concat(),
            joints(&[("crank", "one"), ("coupler", "two"), ("rocker", "three"), ("pin", "three.at([-0.1, 0.3, 0.2])")])
        ));
        // Both frames coincide: closed, whatever the kind.
        let mut point = case.rest();
        let offset = [1.0 + 0.2 + 0.1, 0.1 - 0.3, 0.4 - 0.2];
        for (k, &x) in offset.iter().enumerate() {
            point.set(symbols(&case, ("rocker", k))[0], x);
        }
        balanced(pin, &case, &point, &BARS, &OUTSIDE);
        // The free body is held by the pin alone.
        close("nothing holds", &case.output("rocker_reaction", &point), &[0.0; 6], 1e-11);
    }
}

/// The root is the area of the triangle of coupler and rocker, but for a constant: zero where both are in line.
#[test]
fn dead_centres_are_told() {
    let solve = "solve (coupler, rocker) from pin { sin(rocker - crank - coupler) > 0.0 }";
    let bars = four_bar(&format!("{REDUCED} {solve}"), "Revolute").replace("2.5 * X", "1.2 * X");
    let case = case(&bars);
    let names: Vec<String> = case
        .derivation
        .dead_centres
        .iter()
        .map(|centre| case.model.joints[centre.joint].place.field.to_string())
        .collect();
    assert_eq!(names.len(), 1, "{names:?}");
    let at = |crank: f64| {
        let mut point = case.rest();
        point.set(symbols(&case, ("crank", 0))[0], crank);
        case.eval(FunctionKind::DeadCentres, &point)[0]
    };
    let area = |crank: f64| {
        let way = (10.0 - 6.0 * crank.cos()).sqrt();
        let half = 0.5 * (way + 3.2);
        (half * (half - way) * (half - 1.2) * (half - 2.0)).sqrt()
    };
    let constant = at(0.5) / area(0.5);
    for crank in [0.3, 0.9, -1.2, 1.5] {
        close("root", &[at(crank)], &[constant * area(crank)], 1e-12);
    }
    let last = (-0.04_f64).acos();
    assert!(at(last - 1e-12) < 1e-5 && at(last - 1e-12) >= 0.0, "{}", at(last - 1e-12));
    assert!(at(last + 1e-3).is_nan());
}

/// What integrators look at: the closed form's root, and Newton's determinant at its solution, vanish together, and the rates
/// of their squares are those along the motion. The hinges stand askew to the axes, so that nothing is planar in them.
#[test]
fn margins_have_their_rates() {
    let solve = "solve (coupler, rocker) from pin { sin(rocker - crank - coupler) > 0.0 }";
    let turned = |text: String| {
        text.replace("ground,", "ground.rotated([1, 2, 0.5], 0.7),")
            .replace("ground.at", "ground.rotated([1, 2, 0.5], 0.7).at")
    };
    let closed = case(&turned(bars(&format!("{REDUCED} {solve}"), "Revolute").replace("2.5 * X", "1.2 * X")));
    let newton = "formulation { constraints: Reduced, independent: [crank] }";
    let newton = case(&turned(bars(newton, "Revolute").replace("2.5 * X", "1.2 * X")));
    let (speed, step) = (0.8, 1e-6);
    let mut ratio = None;
    for crank in [0.3, 0.9, -1.2, 1.5, 1.6] {
        let mut angles = vec![1.0, 2.0];
        let mut at = |case: &Case, crank: f64| {
            let mut point = case.rest();
            let [position, velocity] = symbols(case, ("crank", 0));
            point.set(position, crank);
            point.set(velocity, speed);
            if case.derivation.functions.iter().any(|function| function.kind == FunctionKind::Guess) {
                for _ in 0..40 {
                    for (index, &value) in angles.iter().enumerate() {
                        point.set(Symbol::Guess { index }, value);
                    }
                    angles = case.eval(FunctionKind::Guess, &point);
                    angles.pop();
                }
            }
            case.eval(FunctionKind::Margins, &point)
        };
        for case in [&closed, &newton] {
            let now = at(case, crank);
            let [before, after] = [-step, step].map(|d| at(case, crank + d)[0].powi(2));
            close("rate", &[now[1]], &[speed * (after - before) / (2.0 * step)], 1e-6);
        }
        let (root, determinant) = (at(&closed, crank)[0], at(&newton, crank));
        assert!(determinant[2] < 1e-12, "solved: {determinant:?}");
        let now = (root / determinant[0]).abs();
        let constant = *ratio.get_or_insert(now);
        close("root over determinant", &[now], &[constant], 1e-9);
    }
}

/// The second loop closes in a range of the crank in which a condition of the first fails, which was not seen where the first
/// was solved: no error of the compiler.
#[test]
fn conditions_are_tried_where_their_own_loop_closes() {
    let text = |at: f64| {
        format!(
            "body wheel {{ mass: 1.0, inertia: diag(1, 1, 1) }}
            body coupler {{ mass: 0.5 }} body rocker {{ mass: 0.5 }}
            body pusher {{ mass: 0.1 }} body catch {{ mass: 0.1 }}
            joint crank: Revolute {{ parent: ground, child: wheel, axis: Z }}
            joint rod: Revolute {{ parent: wheel.at(X), child: coupler, axis: Z }}
            joint swing: Revolute {{ parent: ground.at(3.0 * X), child: rocker, axis: Z }}
            joint pin: Revolute {{ parent: coupler.at(3.0 * X), child: rocker.at(3.0 * X), axis: Z }}
            joint push: Revolute {{ parent: wheel.at(X), child: pusher, axis: Z }}
            joint held: Revolute {{ parent: ground.at([cos({at:?}), sin({at:?}), 0]), child: catch, axis: Z }}
            joint touch: Revolute {{ parent: pusher.at(0.15 * X), child: catch.at(0.1 * X), axis: Z }}
            formulation {{ independent: [crank], constraints: Reduced }}
            solve (rod, swing) from pin {{ sin(swing - rod - crank) > 0, cos(crank - {at:?}) < 0.965 }}
            solve (push, held) from touch {{ sin(held - push - crank) > 0 }}
            emit forward_dynamics;"
        )
    };
    let tried = (0..12).map(|k| try_case(&text(0.5 * f64::from(k) - 3.0)).err());
    // Where the condition was seen to fail, the user is told.
    let told: Vec<Option<String>> = tried.collect();
    assert!(told.contains(&None), "{told:?}");
    assert!(told.iter().flatten().all(|message| message.contains("satisfies the conditions")), "{told:?}");
}

/// A rod without inertia about its own line, in coordinates of its own: the mass matrix is singular by structure, and
/// equations of the joint take part in its factors. Accelerations and multipliers fulfil the equations of motion all the same,
/// where loops are closed and whatever velocities are.
#[test]
fn multipliers_where_the_mass_matrix_is_singular() {
    let case = case(
        "formulation { constraints: Multipliers }
        world { gravity: [0.5, 1.0, -9.81] }
        body rod { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X), coordinates: Absolute(RollPitchYaw) }
        joint top: Universal { parent: ground, child: rod, axes: [Y, Z] }
        emit forward_dynamics, residual;",
    );
    let dof = case.structure.state.len();
    assert!(case.structure.closed.len() > 2);
    for (seed, closed) in (1..6).zip(&case.structure.closed) {
        let mut point = case.random(seed);
        for &Coordinate { joint, index } in &case.structure.state {
            point.set(Symbol::Position { joint, component: index }, closed.positions[joint.0][index]);
        }
        let motion = case.eval(FunctionKind::ForwardDynamics, &point);
        let (accelerations, multipliers) = motion.split_at(dof);
        for (&Coordinate { joint, index }, &value) in case.structure.state.iter().zip(accelerations) {
            point.set(Symbol::Acceleration { joint, component: index }, value);
        }
        for (row, &value) in multipliers[..case.structure.rows.len()].iter().enumerate() {
            point.set(Symbol::Multiplier { row }, value);
        }
        let rows = case.eval(FunctionKind::Residual, &point);
        close("what is left of forces", &rows[..dof], &vec![0.0; dof], 1e-9);
    }
}
