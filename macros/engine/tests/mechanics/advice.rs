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
        let [(Some(part), condition)] = &lines[..] else { panic!("{lines:?}") };
        // A strut ends at the length zero, which is one beyond where it stands by default, on the side of its own axis.
        assert!(part == "leg" && condition.starts_with(sign), "{condition}");
        let bound: f64 = condition.split(' ').next_back().unwrap().parse().unwrap();
        assert!(bound.abs() > 0.5 && bound.abs() < 1.0, "{condition}");
        let after = Built::new(&struts(axis, &format!("assume {condition};")));
        assert_eq!(after.forward().after, promised);
        let ((few, left), (many, rest)) = (before.pivoted(), after.pivoted());
        assert!(many > few && rest.iter().sum::<usize>() < left.iter().sum(), "{few} {left:?}, {many} {rest:?}");
        let report = before.report();
        assert!(
            report.contains(&format!("`assume {condition};` in `leg` lets more equations be absorbed")),
            "{report}"
        );
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
    assert!(lines[0].1.starts_with("stroke > -0.") && promised != built.forward().after, "{lines:?}");
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
