//! What the report says of equations with multipliers: what becomes of them, and which `assume` would let them cost less.

use multibody_engine::contracts::cost::Cost;
use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::mechanics::loops::structure::Structure;
use multibody_engine::model::types::Model;
use multibody_engine::optimize::program::{Compiled, Function, Statement};
use multibody_engine::{Trouble, compile, emit};

use super::support::model_with;

/// A plate on three struts, whose slides go along an axis of their own.
fn struts(axis: &str, assume: &str) -> (String, String) {
    let leg = format!(
        "mod leg {{ port base: Frame; port tip: Frame;
            body cylinder {{ mass: 0.1, com: 0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }}
            body piston {{ mass: 0.1, com: -0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }}
            joint gimbal: Universal {{ parent: base, child: cylinder, axes: [X, Y] }}
            joint stroke: Prismatic {{ parent: cylinder.at(Z), child: piston, axis: {axis} }}
            #[cut] joint ball: Ball {{ parent: piston, child: tip }}
            {assume}
        }}"
    );
    let plate = "const FEET: [Vec3; 3] = [[-2.12, 1.374, 0.0], [-2.38, 1.224, 0.0], [-2.38, -1.224, 0.0]];
        const PINS: [Vec3; 3] = [[0.17, 0.595, -0.4], [-0.6, 0.15, -0.4], [-0.6, -0.15, -0.4]];
        const HEADING: [Scalar; 3] = [-0.75, -0.55, 0.55];
        body plate { mass: 1.5, inertia: diag(0.08, 0.08, 0.08), coordinates: Absolute(RollPitchYaw) }
        part legs: [leg; 3] = |i| leg { base: ground.at(FEET[i]).rotated(Z, HEADING[i]), tip: plate.at(PINS[i]) };
        emit forward_dynamics, report;";
    (leg, plate.to_owned())
}

/// Four-bars that stand on each other.
fn stack(assume: &str) -> (String, String) {
    let floor = |k: usize| {
        let at = |place: &str| match k.checked_sub(1) {
            None => format!("ground.at({place})"),
            Some(below) => format!("top_{below}.at({place})"),
        };
        let (left, right) = (at("0 * X"), at("X"));
        format!(
            "body left_{k} {{ mass: 1.0, com: 0.5 * Y, inertia: rod(1.0, 1.0, Y) }}
             body right_{k} {{ mass: 1.0, com: 0.6 * Y, inertia: rod(1.0, 1.2, Y) }}
             body top_{k} {{ mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }}
             joint hip_{k}: Revolute {{ parent: {left}, child: left_{k}, axis: Z }}
             joint knee_{k}: Revolute {{ parent: left_{k}.at(Y), child: top_{k}, axis: Z }}
             joint side_{k}: Revolute {{ parent: {right}, child: right_{k}, axis: Z }}
             #[cut] joint pin_{k}: Revolute {{ parent: right_{k}.at(1.2 * Y), child: top_{k}.at(X), axis: Z }} "
        )
    };
    let floors: String = (0..4).map(floor).collect();
    (String::new(), format!("world {{ gravity: -9.81 * Y }} {floors} {assume} emit forward_dynamics, report;"))
}

struct Built {
    model: Model,
    structure: Structure,
    compiled: Compiled,
}

impl Built {
    fn new((parts, items): &(String, String)) -> Built {
        let model = model_with(parts, items);
        let (structure, compiled) = match compile(&model) {
            Ok(done) => done,
            Err(Trouble::Complaints(list)) => panic!("{}", list[0].message),
            Err(_) => panic!("it is refused"),
        };
        Built { model, structure, compiled }
    }

    fn forward(&self) -> &Function {
        self.compiled.functions.iter().find(|function| function.kind == FunctionKind::ForwardDynamics).unwrap()
    }

    fn report(&self) -> String {
        emit::report(&self.model, &self.structure, &self.compiled)
    }

    /// How many equations are absorbed, and sizes of what is left. Programs show the sizes, each equation is in one place.
    fn pivoted(&self) -> (usize, Vec<usize>) {
        let pivoted = &self.structure.pivoted[self.forward().candidate];
        let mut rows = [pivoted.absorbed.clone(), pivoted.cores.concat()].concat();
        rows.sort_unstable();
        assert_eq!(rows, self.structure.rows);
        let sizes: Vec<usize> = pivoted.cores.iter().map(Vec::len).collect();
        let solved = self.forward().program.statements.iter().filter_map(|statement| match statement {
            Statement::Solve { size, .. } => Some(*size),
            _ => None,
        });
        assert_eq!(sizes.iter().sum::<usize>(), solved.sum());
        (pivoted.absorbed.len(), sizes)
    }

    /// Lines for the user, each with the part where it stands; what is promised of them.
    fn assumable(&self) -> (Vec<(Option<String>, String)>, Cost) {
        let (lines, figures) = self.structure.advice.as_ref().unwrap().assumable.clone().expect("something to assume");
        (lines.into_iter().map(|line| (line.part, line.condition)).collect(), figures.operations)
    }
}

/// What is told is what comes of it once it is written down.
#[test]
fn assumptions_do_what_is_told_of_them() {
    for (axis, sign) in [("Z", "stroke > -0."), ("-Z", "stroke < 0.")] {
        let before = Built::new(&struts(axis, ""));
        let (lines, promised) = before.assumable();
        let [(Some(part), gimbal), (Some(other), stroke)] = &lines[..] else { panic!("{lines:?}") };
        // A strut ends at the length zero, which is one beyond where it stands by default, on the side of its own axis; its
        // gimbal's axes stand in one line at a right angle.
        assert!(part == "leg" && other == "leg" && stroke.starts_with(sign), "{stroke}");
        assert!(gimbal.starts_with("cos(gimbal.second) > 0."), "{gimbal}");
        let bound: f64 = stroke.split(' ').next_back().unwrap().parse().unwrap();
        assert!(bound.abs() < 1.0, "{stroke}");
        let after = Built::new(&struts(axis, &format!("assume {gimbal}; assume {stroke};")));
        assert_eq!(after.forward().after, promised);
        let ((few, left), (many, rest)) = (before.pivoted(), after.pivoted());
        assert!(many > few && rest.iter().sum::<usize>() < left.iter().sum(), "{few} {left:?}, {many} {rest:?}");
        let report = before.report();
        let told =
            format!("`assume {gimbal};` in `leg` and `assume {stroke};` in `leg` let more equations be absorbed");
        assert!(report.contains(&told), "{report}");
        assert!(report.contains(&format!("of 9 equations with multipliers {few} are absorbed")), "{report}");
        assert!(report.contains("; 6 are left to pivoted solutions of 1 system with 6 unknowns: "), "{report}");
        // It is not told again.
        assert!(after.structure.advice.as_ref().unwrap().assumable.is_none());
    }
}

/// What was chosen is told together with what could be assumed for it.
#[test]
fn a_choice_of_the_compiler_has_advice_too() {
    let (parts, items) = struts("Z", "");
    let built = Built::new(&(parts, format!("{items} formulation {{ constraints: Auto }}")));
    let advice = built.structure.advice.as_ref().unwrap();
    assert!(advice.is_chosen && matches!(advice.other, Some(Ok(_))));
    let (lines, promised) = built.assumable();
    assert!(lines[1].1.starts_with("stroke > -0.") && promised != built.forward().after, "{lines:?}");
    assert_eq!(advice.own.unwrap().operations, built.forward().after);
}

/// Angles have bounds on both sides, and joints outside of parts a line each.
#[test]
fn assumptions_of_angles() {
    let before = Built::new(&stack(""));
    let (lines, promised) = before.assumable();
    assert!(lines.len() > 1 && lines.iter().all(|line| line.0.is_none() && line.1.contains(" && ")), "{lines:?}");
    let written: String = lines.iter().map(|(_, condition)| format!("assume {condition}; ")).collect();
    let after = Built::new(&stack(&written));
    assert_eq!(after.forward().after, promised);
    assert!(after.pivoted().0 > before.pivoted().0);
}

/// Nobody who has not asked for it pays.
#[test]
fn advice_is_asked_for() {
    let (parts, items) = struts("Z", "");
    let built = Built::new(&(parts, items.replace(", report", "")));
    assert!(built.structure.advice.is_none() && !built.report().contains("absorbed"));
}

/// A double wishbone with a tie rod, whose bounds stand where a step ends that is halved over and over again.
#[test]
fn bounds_are_looked_for_in_so_many_steps() {
    let items = "world { gravity: -9.80665 * Z }
        body lower { mass: 2.0, com: 0.2 * X, inertia: diag(0.02, 0.03, 0.04) }
        body upper { mass: 1.5, com: 0.15 * X, inertia: diag(0.01, 0.02, 0.03) }
        body upright { mass: 8.0, com: [0.05, 0.01, 0.12], inertia: diag(0.1, 0.12, 0.08) }
        body tie { mass: 0.5, com: 0.2 * X, inertia: diag(0.001, 0.01, 0.01) }
        joint low: Revolute { parent: ground, child: lower, axis: [0.05, 1.0, 0.03] }
        joint up: Revolute { parent: ground.at([0.08, 0.02, 0.25]), child: upper, axis: [-0.04, 1.0, 0.06] }
        joint pivot: Ball { parent: lower.at([0.42, 0.02, 0.01]), child: upright, coordinates: RollPitchYaw }
        #[cut] joint head: Ball { parent: upper.at([0.31, -0.01, 0.0]), child: upright.at([-0.03, -0.01, 0.26]) }
        joint rack: Universal { parent: ground.at([0.05, -0.12, 0.08]), child: tie, axes: [Y, Z] }
        #[cut] joint steer: Ball { parent: tie.at(0.37 * X), child: upright.at([0.0, -0.13, 0.08]) }
        formulation { constraints: Multipliers }
        emit forward_dynamics, report;";
    let before = Built::new(&(String::new(), items.to_owned()));
    let (lines, promised) = before.assumable();
    let written: String = lines.iter().map(|(_, condition)| format!("assume {condition}; ")).collect();
    let after = Built::new(&(String::new(), format!("{written} {items}")));
    assert_eq!(after.forward().after, promised);
}

/// What is assumed of two coordinates is proposed for both, and what holds of one already for the other.
#[test]
fn assumptions_of_two_coordinates() {
    let before = Built::new(&struts("Z", "assume stroke > -0.7;"));
    let (lines, promised) = before.assumable();
    let [(Some(_), condition)] = &lines[..] else { panic!("{lines:?}") };
    assert!(condition.starts_with("cos(gimbal.second) > 0."), "{condition}");
    let after = Built::new(&struts("Z", &format!("assume stroke > -0.7; assume {condition};")));
    assert_eq!(after.forward().after, promised);
    assert_eq!(after.pivoted(), (9, Vec::new()));
    let report = after.report();
    assert!(report.contains("of 9 equations with multipliers 9 are absorbed"), "{report}");
}

/// A parallelogram of hinges: formulas of single angles, with the lengths as parameters where the loop closes for all of them.
#[test]
fn what_goes_along_is_told() {
    let items = |solve: &str| {
        let bars = "param l = 1.1; param w = 0.7;
            body a { mass: 1.0, com: 0.1 * X, inertia: rod(1.0, 0.3, X) }
            body b { mass: 1.0, com: 0.1 * X, inertia: rod(1.0, 1.0, X) }
            body c { mass: 1.0, com: 0.1 * X, inertia: rod(1.0, 1.0, X) }
            joint p: Revolute { parent: ground, child: a, axis: Z }
            joint q: Revolute { parent: a.at(l * X), child: b, axis: Z }
            joint r: Revolute { parent: ground.at(w * X + 0.1 * Y), child: c, axis: Z }
            #[cut] joint pin: Revolute { parent: b.at(w * X + 0.1 * Y), child: c.at(l * X), axis: Z }
            formulation { constraints: Reduced, independent: [p] }";
        Built::new(&(String::new(), format!("{bars} {solve} emit forward_dynamics, report;")))
    };
    let before = items("");
    let (lines, figures) = before.structure.advice.as_ref().unwrap().solvable.clone().expect("formulas");
    let lines: Vec<String> = lines.into_iter().map(|line| line.text).collect();
    assert_eq!(lines, ["solve (q) = (-p.angle);", "solve (r) = (p.angle);"]);
    let after = items(&lines.concat());
    assert_eq!(after.structure.advice.as_ref().unwrap().own, Some(figures));
}

/// Plates on parallelograms don't turn: a Delta robot in an oblique frame, with rods as bodies.
#[test]
fn what_stands_still_is_told() {
    let limb = "mod limb { port hip: Frame; port left: Frame; port right: Frame;
        body arm { mass: 0.3, com: 0.15 * X, inertia: diag(0.0001, 0.003, 0.003) }
        body rod_a { mass: 0.1, com: 0.4 * X, inertia: diag(0.00001, 0.006, 0.006) }
        body rod_b { mass: 0.1, com: 0.4 * X, inertia: diag(0.00001, 0.006, 0.006) }
        joint shoulder: Revolute { parent: hip, child: arm, axis: Y }
        joint elbow_a: Universal { parent: arm.at(0.3 * X + 0.05 * Y), child: rod_a, axes: [Y, Z] }
        joint elbow_b: Universal { parent: arm.at(0.3 * X - 0.05 * Y), child: rod_b, axes: [Y, Z] }
        #[cut] joint wrist_a: Ball { parent: rod_a.at(0.8 * X), child: left }
        #[cut] joint wrist_b: Ball { parent: rod_b.at(0.8 * X), child: right } }";
    let delta = |solve: &str| {
        let items = format!(
            "body base {{ mass: 3.0, inertia: diag(1.0, 1.1, 1.2) }}
             joint mount: Fixed {{ parent: ground.rotated([1.0, 2.0, 2.0], 0.7), child: base }}
             body plate {{ mass: 0.5, inertia: diag(0.001, 0.001, 0.002) }}
             joint moves: Free {{ parent: base, child: plate, coordinates: RollPitchYaw }}
             part limbs: [limb; 3] = |i| limb {{
                 hip: base.rotated(Z, i * 2.0 * PI / 3.0).at(0.2 * X),
                 left: plate.rotated(Z, i * 2.0 * PI / 3.0).at(0.05 * X + 0.05 * Y),
                 right: plate.rotated(Z, i * 2.0 * PI / 3.0).at(0.05 * X - 0.05 * Y),
             }};
             formulation {{ constraints: Reduced }} {solve}
             emit forward_dynamics, report;"
        );
        Built::new(&(limb.to_owned(), items))
    };
    let before = delta("");
    let (lines, figures) = before.structure.advice.as_ref().unwrap().solvable.clone().expect("formulas");
    let text = "solve (moves.roll, moves.pitch, moves.yaw) = (0.0, 0.0, 0.0);";
    assert_eq!(lines.iter().map(|line| line.text.as_str()).collect::<Vec<_>>(), [text]);
    let report = before.report();
    assert!(report.contains(&format!("`{text}` leaves less to Newton's method: ")), "{report}");
    let after = delta(text);
    let advice = after.structure.advice.as_ref().unwrap();
    assert_eq!(advice.own, Some(figures));
    assert!(3 * figures.work < 2 * before.structure.advice.as_ref().unwrap().own.unwrap().work);
    assert!(advice.solvable.is_none());
}

/// What a screw carries doesn't come again after a turn: its length is zero ten turns away, where nothing is assumed.
#[test]
fn what_is_assumed_on_one_side_is_open_on_the_other() {
    let jack = |assume: &str| {
        let leg = format!(
            "mod leg {{ port base: Frame; port tip: Frame;
                body cylinder {{ mass: 0.1, com: 0.5 * Z, inertia: diag(0.00625, 0.00625, 0.001) }}
                body piston {{ mass: 0.1, com: -0.5 * Z, inertia: diag(0.00625, 0.00625, 0.001) }}
                joint gimbal: Universal {{ parent: base, child: cylinder, axes: [X, Y] }}
                joint thread: Screw {{ parent: cylinder.at(Z), child: piston, axis: Z, pitch: 0.1 }}
                #[cut] joint ball: Ball {{ parent: piston, child: tip }}
                {assume} }}"
        );
        let plate = "const FEET: [Vec3; 3] = [[-0.2, 0.1, -1.0], [0.2, 0.15, -1.0], [0.03, -0.25, -1.0]];
            const PINS: [Vec3; 3] = [[-0.2, 0.1, 0.0], [0.2, 0.15, 0.0], [0.03, -0.25, 0.0]];
            body plate { mass: 1.5, inertia: diag(0.08, 0.08, 0.08), coordinates: Absolute(RollPitchYaw) }
            part legs: [leg; 3] = |i| leg { base: ground.at(FEET[i]), tip: plate.at(PINS[i]) };
            emit forward_dynamics, report;";
        Built::new(&(leg, plate.to_owned())).pivoted().0
    };
    let plain = jack("");
    assert_eq!(jack("assume thread < 6.0; assume cos(gimbal.second) > 0.3;"), plain);
    assert!(jack("assume thread > -3.0; assume cos(gimbal.second) > 0.5;") > plain);
    // So is what lies behind what is ruled out: there a strut has the length zero.
    let plain = Built::new(&struts("Z", "")).pivoted();
    assert_eq!(Built::new(&struts("Z", "assume stroke > -0.7 || stroke < -0.9;")).pivoted(), plain);
    assert!(Built::new(&struts("Z", "assume stroke > -0.7;")).pivoted().0 > plain.0);
}

/// A relation that holds in one part of a type and not in the others is no line of the part.
#[test]
fn what_differs_between_parts_is_not_told() {
    let bars = "mod bars { port left: Frame; port right: Frame; param far = 1.0;
        body a { mass: 1.0, com: 0.1 * X, inertia: rod(1.0, 0.3, X) }
        body b { mass: 1.0, com: 0.1 * X, inertia: rod(1.0, 1.0, X) }
        body c { mass: 1.0, com: 0.1 * X, inertia: rod(1.0, 1.0, X) }
        joint p: Revolute { parent: left, child: a, axis: Z }
        joint q: Revolute { parent: a.at(1.1 * X), child: b, axis: Z }
        joint r: Revolute { parent: right, child: c, axis: Z }
        #[cut] joint pin: Revolute { parent: b.at(0.7 * X), child: c.at(far * X), axis: Z } }";
    let items = "part one: bars { left: ground, right: ground.at(0.7 * X), far: 1.1 };
        part two: bars { left: ground.at(3.0 * X), right: ground.at(3.7 * X), far: 1.0 };
        formulation { constraints: Reduced, independent: [one.p, two.p] } emit forward_dynamics, report;";
    let built = Built::new(&(bars.to_owned(), items.to_owned()));
    assert!(built.structure.advice.as_ref().unwrap().solvable.is_none());
}
