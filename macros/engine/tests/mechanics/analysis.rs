//! What the analysis says about loops whose structure is known.

use multibody_engine::mechanics::analysis::{Complaint, analyse};
use multibody_engine::mechanics::loops::constraints::{coordinate_name, row_name};
use multibody_engine::mechanics::loops::structure::{Means, Role, Row, Structure};
use multibody_engine::model::types::{Coordinate, JointId, Model};

use super::support::{Random, case, model_with};

fn body(name: &str) -> String {
    format!("body {name} {{ mass: 1.0, inertia: diag(1.0, 1.0, 1.0) }}")
}

fn bodies(names: &[&str]) -> String {
    names.iter().map(|name| body(name)).collect::<Vec<_>>().join(" ")
}

fn model(text: &str) -> Model {
    model_with("", text)
}

fn sound(model: &Model) -> Structure {
    analyse(model).unwrap_or_else(|complaints| panic!("{:?}", messages(&complaints)))
}

fn messages(complaints: &[Complaint]) -> Vec<&str> {
    complaints.iter().map(|complaint| complaint.message.as_str()).collect()
}

fn complaint(text: &str) -> String {
    match analyse(&model(text)) {
        Ok(structure) => panic!("no complaint: {structure:?}"),
        Err(complaints) => messages(&complaints).join("; "),
    }
}

fn rows(model: &Model, rows: &[Row]) -> Vec<String> {
    rows.iter().map(|row| row_name(model, row.closing, row.index)).collect()
}

fn coordinates(model: &Model, list: &[Coordinate]) -> Vec<String> {
    list.iter().map(|&coordinate| coordinate_name(model, coordinate)).collect()
}

/// Each step as its means and unknowns.
fn steps(model: &Model, structure: &Structure) -> Vec<String> {
    let step = |step: &multibody_engine::mechanics::loops::structure::Step| {
        let means = match &step.means {
            Means::Linear(_) => "linear".to_owned(),
            Means::Explicit(_) => "explicit".to_owned(),
            Means::Solve(k) => format!("solve {k}"),
            Means::Newton { rows, guess } => {
                assert_eq!(rows.len(), step.unknowns.len());
                format!("newton {guess}")
            }
        };
        format!("{means}: {}", coordinates(model, &step.unknowns).join(" "))
    };
    structure.steps.iter().map(step).collect()
}

fn four_bar(items: &str) -> String {
    format!(
        "{} {items}
        joint crank: Revolute {{ parent: ground, child: one, axis: Z }}
        joint coupler: Revolute {{ parent: one.at(X), child: two, axis: Z }}
        joint rocker: Revolute {{ parent: ground.at(3.0 * X), child: three, axis: Z }}
        #[cut]
        joint pin: Revolute {{ parent: two.at(2.5 * X), child: three.at(2.0 * X), axis: Z }}",
        bodies(&["one", "two", "three"])
    )
}

#[test]
fn trees_need_no_analysis() {
    let m = model(&format!("{} joint j: Free {{ parent: ground, child: a }}", body("a")));
    let structure = sound(&m);
    assert_eq!(structure.freedoms(), 6);
    assert_eq!(structure.role(structure.state[3]), Role::State);
    assert!(structure.rows.is_empty() && structure.notes.is_empty());
}

#[test]
fn planar_loops_have_two_equations() {
    let m = model(&four_bar(""));
    let structure = sound(&m);
    assert_eq!(rows(&m, &structure.rows), ["pin.x", "pin.y"]);
    assert_eq!(rows(&m, &structure.dropped), ["pin.z", "pin.turn_y", "pin.turn_x"]);
    assert_eq!(structure.freedoms(), 3);
    assert!(structure.steps.is_empty());
}

#[test]
fn the_crank_stays() {
    let m = model(&four_bar("formulation { constraints: Reduced }"));
    let structure = sound(&m);
    assert_eq!(steps(&m, &structure), ["newton 0: coupler rocker"]);
    assert_eq!(coordinates(&m, &structure.state), ["crank"]);
    assert_eq!((structure.freedoms(), structure.guesses()), (1, 2));
    let m = model(&four_bar("formulation { constraints: Reduced, independent: [rocker] }"));
    let structure = sound(&m);
    assert_eq!(coordinates(&m, &structure.state), ["rocker"]);
    let m = model(&four_bar("formulation { constraints: Reduced } drive rocker = t;"));
    let structure = sound(&m);
    assert_eq!(steps(&m, &structure), ["newton 0: crank coupler"]);
    assert_eq!(structure.freedoms(), 0);
    let m = model(&four_bar("drive crank = t;"));
    let structure = sound(&m);
    assert_eq!(structure.rows.len(), 2);
    assert_eq!(coordinates(&m, &structure.state), ["coupler", "rocker"]);
}

#[test]
fn solve_items_come_first() {
    let m = model(&four_bar(
        "formulation { constraints: Reduced } solve (coupler, rocker) from pin { sin(coupler) > 0.0 }",
    ));
    let structure = sound(&m);
    assert_eq!(steps(&m, &structure), ["solve 0: coupler rocker"]);
    let m =
        model(&four_bar("formulation { constraints: Reduced } solve (crank, coupler) from pin { sin(coupler) > 0.0 }"));
    assert_eq!(coordinates(&m, &sound(&m).state), ["rocker"]);
    let text = four_bar("formulation { constraints: Reduced } solve (coupler) from pin { sin(coupler) > 0.0 }");
    assert_eq!(complaint(&text), "`solve` names 1 unknowns, but the loop gives 2 equations for them");
    let text = four_bar("formulation { constraints: Reduced, independent: [crank, rocker] }");
    assert!(complaint(&text).contains("`crank`, `rocker`"), "{}", complaint(&text));
}

#[test]
fn formulas_cover_their_loop() {
    let parallelogram = |items: &str| {
        format!(
            "{} formulation {{ constraints: Reduced }} {items}
            joint crank: Revolute {{ parent: ground, child: one, axis: Z }}
            joint coupler: Revolute {{ parent: one.at(X), child: two, axis: Z }}
            joint rocker: Revolute {{ parent: ground.at(3.0 * X), child: three, axis: Z }}
            #[cut]
            joint pin: Revolute {{ parent: two.at(3.0 * X), child: three.at(X), axis: Z }}",
            bodies(&["one", "two", "three"])
        )
    };
    let m = model(&parallelogram("solve (coupler, rocker) = (-crank, crank);"));
    let structure = sound(&m);
    assert_eq!(steps(&m, &structure), ["solve 0: coupler rocker"]);
    assert_eq!(structure.dropped.len(), 3);
    let message = complaint(&parallelogram("solve (coupler, rocker) = (crank, crank);"));
    assert_eq!(message, "the formulas of `coupler`, `rocker` do not close their loop");
}

#[test]
fn couplings_are_eliminated() {
    let gears = |items: &str| {
        format!(
            "{} {items}
            joint a: Revolute {{ parent: ground, child: one, axis: Z }}
            joint b: Revolute {{ parent: ground.at(X), child: two, axis: Z }}
            joint c: Prismatic {{ parent: ground, child: three, axis: Y }}",
            bodies(&["one", "two", "three"])
        )
    };
    let m = model(&gears("param ratio = 3.0; constraint gear = a * ratio + b; constraint rack = b * 0.1 - c + 0.2;"));
    let structure = sound(&m);
    assert_eq!(steps(&m, &structure), ["linear: b", "linear: c"]);
    assert_eq!(coordinates(&m, &structure.state), ["a"]);
    assert!(structure.rows.is_empty());
    // A parameter may be zero.
    let m = model(&gears("param ratio = 3.0; constraint gear = a + b * ratio;"));
    assert_eq!(steps(&m, &sound(&m)), ["linear: a"]);
    let m = model(&gears("drive b = t; constraint gear = a + 2.0 * b;"));
    assert_eq!(steps(&m, &sound(&m)), ["linear: a"]);
    let m = model(&gears("constraint gear = sin(a) + 2.0 * b;"));
    let structure = sound(&m);
    assert_eq!((structure.steps.len(), rows(&m, &structure.rows)), (0, vec!["gear".to_owned()]));
    let m = model(&gears("constraint gear = a + 2.0 * b; constraint again = 3.0 * a + 6.0 * b;"));
    let structure = sound(&m);
    assert_eq!((steps(&m, &structure), rows(&m, &structure.dropped)), (vec!["linear: b".into()], vec!["again".into()]));
    let text = gears("drive a = t; drive b = 2.0 * t; constraint gear = a + 2.0 * b;");
    assert_eq!(complaint(&text), "the drive prescribes what follows from the loops and other drives: `b`");
    // What a coupling gives counts as known in loops.
    let text = gears(
        "formulation { constraints: Reduced } constraint gear = a - b; constraint link: Rod { between: [one.at(X), three], length: 2.0 }",
    );
    let m = model(&text);
    assert_eq!(steps(&m, &sound(&m)), ["linear: b", "newton 0: c"]);
}

#[test]
fn independent_systems_are_solved_one_by_one() {
    // Two four-bars in a row: the second is driven by the rocker of the first.
    let text = format!(
        "{} formulation {{ constraints: Reduced }}
        joint crank: Revolute {{ parent: ground, child: one, axis: Z }}
        joint coupler: Revolute {{ parent: one.at(X), child: two, axis: Z }}
        joint rocker: Revolute {{ parent: ground.at(3.0 * X), child: three, axis: Z }}
        joint link: Revolute {{ parent: three.at(2.0 * X), child: four, axis: Z }}
        joint last: Revolute {{ parent: ground.at(6.0 * X), child: five, axis: Z }}
        #[cut]
        joint pin: Revolute {{ parent: two.at(2.5 * X), child: three.at(2.0 * X), axis: Z }}
        #[cut]
        joint pan: Revolute {{ parent: four.at(3.0 * X), child: five.at(2.2 * X), axis: Z }}",
        bodies(&["one", "two", "three", "four", "five"])
    );
    let m = model(&text);
    let structure = sound(&m);
    assert_eq!(steps(&m, &structure), ["newton 0: coupler rocker", "newton 2: link last"]);
    assert_eq!(coordinates(&m, &structure.state), ["crank"]);
}

#[test]
fn loops_that_cannot_be() {
    let bars = |length: f64, more: &str| {
        format!(
            "{} {more}
            joint crank: Revolute {{ parent: ground, child: one, axis: Z }}
            joint coupler: Revolute {{ parent: one.at(X), child: two, axis: Z }}
            #[cut]
            joint pin: Ball {{ parent: two.at(X), child: ground.at([{length:?}, 0.0, 0.0]) }}",
            bodies(&["one", "two"])
        )
    };
    let message = complaint(&bars(2.5, ""));
    assert_eq!(message, "the loop that `pin` closes cannot close: the smallest gap found is 0.5 m");
    let message = complaint(&bars(1.5, ""));
    assert_eq!(message, "the loop that `pin` closes leaves no freedom: nothing can move among `crank`, `coupler`");
    // With a parameter in it, it may close for other values.
    let m = model(&bars(2.5, "param p = 1.0;").replace("one.at(X)", "one.at(p * X)"));
    let structure = sound(&m);
    assert!(structure.notes.iter().any(|note| note.contains("did not close")), "{:?}", structure.notes);
    // What kind of gap it is.
    let crank = |closing: &str| {
        format!(
            "{} joint crank: Revolute {{ parent: ground, child: a, axis: Z }} joint slide: Prismatic {{ parent: ground, child: b, axis: X }} {closing}",
            bodies(&["a", "b"])
        )
    };
    let message = complaint(&crank("constraint link: Rod { between: [a.at(X), ground.at(4.0 * X)], length: 1.5 }"));
    assert_eq!(message, "the constraint `link` cannot close: the smallest gap found is 1.5 m");
    let message = complaint(&crank("#[cut] joint pin: Revolute { parent: a, child: ground.rotated(X, 0.3), axis: Z }"));
    assert_eq!(message, "the loop that `pin` closes cannot close: its axes miss each other by 0.3 rad at least");
    let message =
        complaint(&crank("#[cut] joint pin: Cylindrical { parent: a, child: ground.rotated(X, PI), axis: Z }"));
    assert_eq!(message, "the loop that `pin` closes cannot close: only with axes that point the wrong way does it");
    let message = complaint(&crank("constraint sine = sin(crank) + 1.25;"));
    assert_eq!(message, "the constraint `sine` cannot close: the smallest value found is 0.25");
    let message = complaint(&crank("#[cut] joint pin: Revolute { parent: a, child: ground.at(0.2 * Z), axis: Z }"));
    assert_eq!(message, "the loop that `pin` closes cannot close: the smallest gap found is 0.2 m");
    let text = format!(
        "{} joint slide: Prismatic {{ parent: ground, child: a, axis: X }}
        #[cut] joint weld: Prismatic {{ parent: ground, child: a, axis: Y }}",
        body("a")
    );
    assert!(complaint(&text).contains("leaves no freedom"), "{}", complaint(&text));
}

/// Bennett's loop: four skew hinges, whose rows look independent anywhere but where the loop is closed.
#[test]
fn bennetts_loop_moves() {
    // sin(30 deg) / 1 = sin(90 deg) / 2
    let text = format!(
        "{}
        joint a: Revolute {{ parent: ground, child: one, axis: Z }}
        joint b: Revolute {{ parent: one.at(X).rotated(X, deg(30.0)), child: two, axis: Z }}
        joint c: Revolute {{ parent: two.at(2.0 * X).rotated(X, deg(90.0)), child: three, axis: Z }}
        #[cut]
        joint d: Revolute {{ parent: three.at(X).rotated(X, deg(30.0)),
            child: ground.rotated(X, deg(-90.0)).at(-2.0 * X), axis: Z }}",
        bodies(&["one", "two", "three"])
    );
    let m = model(&text);
    let structure = sound(&m);
    assert_eq!((structure.rows.len(), structure.dropped.len()), (2, 3));
}

pub(crate) fn stewart(formulation: &str, solve: &str) -> Model {
    let leg = format!(
        "mod leg {{
            port base: Frame; port tip: Frame; input thrust;
            body cylinder {{ mass: 0.1, com: 0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }}
            body piston {{ mass: 0.1, com: -0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }}
            joint gimbal: Universal {{ parent: base, child: cylinder, axes: [X, Y] }}
            joint stroke: Prismatic {{ parent: cylinder.at(1.0 * Z), child: piston, axis: Z }}
            #[cut]
            joint ball: Ball {{ parent: piston, child: tip }}
            {solve}
        }}"
    );
    let text = format!(
        "const FEET: [Vec3; 6] = [[-2.12, 1.374, 0.0], [-2.38, 1.224, 0.0], [-2.38, -1.224, 0.0], [-2.12, -1.374, 0.0],
            [0.0, -0.15, 0.0], [0.0, 0.15, 0.0]];
        const PINS: [Vec3; 6] = [[0.17, 0.595, -0.4], [-0.6, 0.15, -0.4], [-0.6, -0.15, -0.4], [0.17, -0.595, -0.4],
            [0.43, -0.445, -0.4], [0.43, 0.445, -0.4]];
        const HEADING: [Scalar; 6] = [-0.75, -0.55, 0.55, 0.75, -2.85, 2.85];
        formulation {{ {formulation} }}
        body platform {{ mass: 1.5, inertia: diag(0.08, 0.08, 0.08), coordinates: Absolute(RollPitchYaw) }}
        part legs: [leg; 6] = |i| leg {{ base: ground.at(FEET[i]).rotated(Z, HEADING[i]), tip: platform.at(PINS[i]) }};"
    );
    model_with(&leg, &text)
}

const SOLVE: &str = "solve (gimbal, stroke) from ball { stroke > -1.0, cos(gimbal.second) > 0.0 }";

#[test]
fn the_platform_in_its_coordinates() {
    for (formulation, coordinates, rows) in [
        ("constraints: Multipliers", 24, 18),
        ("constraints: Multipliers, coordinates: Absolute(RollPitchYaw)", 78, 72),
        ("constraints: Multipliers, coordinates: Absolute(Quaternion)", 78, 72),
        ("constraints: Multipliers, coordinates: Joint", 21, 15),
    ] {
        let m = stewart(formulation, "");
        let start = std::time::Instant::now();
        let structure = sound(&m);
        println!("{formulation}: {:?}", start.elapsed());
        assert_eq!((structure.state.len(), structure.rows.len()), (coordinates, rows), "{formulation}");
        assert!(structure.dropped.is_empty(), "{formulation}: {:?}", structure.notes);
        assert!(structure.notes.is_empty(), "{formulation}: {:?}", structure.notes);
    }
}

#[test]
fn the_platform_reduced() {
    let m = stewart("constraints: Reduced", SOLVE);
    let start = std::time::Instant::now();
    let structure = sound(&m);
    println!("reduced: {:?}", start.elapsed());
    let all = steps(&m, &structure);
    assert_eq!(all.len(), 6);
    assert_eq!(all[0], "solve 0: legs[0].gimbal.first legs[0].gimbal.second legs[0].stroke");
    let of_platform = ["x", "y", "z", "roll", "pitch", "yaw"].map(|name| format!("platform.{name}"));
    assert_eq!(coordinates(&m, &structure.state), of_platform);
    let m = stewart("constraints: Reduced", "");
    let structure = sound(&m);
    let all = steps(&m, &structure);
    assert_eq!(all.len(), 6);
    assert_eq!(all[1], "newton 3: legs[1].gimbal.first legs[1].gimbal.second legs[1].stroke");
    assert_eq!(coordinates(&m, &structure.state), of_platform);
    // In joint coordinates one leg carries the platform; the strokes of the others follow one by one.
    let m = stewart("constraints: Reduced, coordinates: Joint", SOLVE);
    let structure = sound(&m);
    assert_eq!((structure.freedoms(), structure.steps.len()), (6, 5));
}

/// Rows kept and dropped, and freedoms.
fn counts(structure: &Structure) -> (usize, usize, usize) {
    (structure.rows.len(), structure.dropped.len(), structure.freedoms())
}

#[test]
fn redundancy_is_found_in_any_axes() {
    // The same four-bar with its plane in general position: no row vanishes by structure.
    let text = four_bar("").replace("axis: Z", "axis: [2.0, 1.0, 2.0]").replace("* X", "* [-1.0, 2.0, 0.0]");
    let text = text.replace("one.at(X)", "one.at([0.0, -2.0, 1.0])").replace("3.0 *", "1.4 *");
    let m = model(&text);
    assert_eq!(counts(&sound(&m)), (2, 3, 3));
    // In absolute coordinates every hinge is one too many in its own way: 20 rows on 18 coordinates, one freedom.
    for kind in ["RollPitchYaw", "Quaternion"] {
        let m = model(&four_bar(&format!("formulation {{ coordinates: Absolute({kind}) }}")));
        assert_eq!(counts(&sound(&m)), (17, 3, 18), "{kind}");
    }
    // A general loop of seven hinges has five good rows.
    let mut text = bodies(&["b1", "b2", "b3", "b4", "b5", "b6"]);
    let place = |k: usize| {
        let x = k as f64;
        format!("at([{:?}, {:?}, {:?}]).rotated(X, {:?})", 0.5 + 0.1 * x, 0.3 - 0.1 * x, 0.2 * x, 0.9 + 0.2 * x)
    };
    let parent = |k: usize| if k == 1 { "ground".to_owned() } else { format!("b{}", k - 1) };
    for k in 1..=6 {
        text += &format!("joint j{k}: Revolute {{ parent: {}.{}, child: b{k}, axis: Z }}", parent(k), place(k));
    }
    text += &format!("#[cut] joint j7: Revolute {{ parent: b6.{}, child: ground, axis: Z }}", place(7));
    assert_eq!(counts(&sound(&model(&text))), (5, 0, 6));
}

/// Loops in a row, each with hinges in space.
#[test]
fn many_four_bars_in_a_row() {
    let count = 10;
    let mut text = "formulation { constraints: Reduced } body c0 { mass: 1.0, inertia: diag(1.0, 1.0, 1.0) }
        joint crank: Revolute { parent: ground, child: c0, axis: Z }"
        .to_owned();
    for k in 0..count {
        text += &format!(
            "{} {}
            joint rod{k}: Revolute {{ parent: c{k}.at(X), child: r{k}, axis: Z }}
            joint next{k}: Revolute {{ parent: ground.at({:?} * X), child: c{n}, axis: Z }}
            #[cut] joint pin{k}: Revolute {{ parent: r{k}.at(X), child: c{n}.at(X), axis: Z }}",
            body(&format!("r{k}")),
            body(&format!("c{}", k + 1)),
            (k + 1) as f64,
            n = k + 1,
        );
    }
    let m = model(&text);
    let start = std::time::Instant::now();
    let structure = sound(&m);
    println!("{count} four-bars: {:?}", start.elapsed());
    assert_eq!(coordinates(&m, &structure.state), ["crank"]);
    let all = steps(&m, &structure);
    assert_eq!(all.len(), count);
    assert_eq!(all[3], "newton 6: rod3 next3");
}

#[test]
fn what_stands_alone_is_solved_for() {
    let three = "joint a: Prismatic { parent: ground, child: one, axis: X }
        joint b: Prismatic { parent: ground, child: two, axis: [1.0, 2.0, 0.3] }
        joint c: Revolute { parent: two, child: three, axis: Z }";
    let of = |constraints: &str, more: &str| {
        let m = model(&format!(
            "{} {three} {constraints} formulation {{ constraints: Reduced {more} }}",
            bodies(&["one", "two", "three"])
        ));
        let structure = sound(&m);
        (steps(&m, &structure), structure.guesses())
    };
    let explicit = |text: &str| (vec![text.to_owned()], 0);
    let newton = |text: &str| (vec![text.to_owned()], 1);
    assert_eq!(of("constraint e = 2.0 * b + sin(a) * cos(c);", ", independent: [a, c]"), explicit("explicit: b"));
    assert_eq!(of("constraint e = two.position.z - a * a;", ", independent: [a, c]"), explicit("explicit: b"));
    // Before what is farther from the ground, unless it is to be independent.
    assert_eq!(of("constraint e = 2.0 * b + sin(a) * cos(c);", ""), explicit("explicit: b"));
    // Of two that do, the one that also does where the motion begins.
    assert_eq!(of("constraint e = 2.0 * b + sin(a) * cos(c);", ", independent: [b]").0, ["newton 0: a"]);
    assert_eq!(of("constraint e = a + 0.1 * sin(a) + b * c;", ""), newton("newton 0: a"));
    assert_eq!(of("constraint e = a + 0.1 * sin(a) + b * c + 1e-10;", ""), newton("newton 0: a"));
    assert_eq!(of("constraint e = a + 0.1 * sin(a) + b * c;", ", independent: [a]").0, ["newton 0: c"]);
    // Drives stand where they begin, not at zero.
    for drive in ["1.0", "1.0 + 0.3 * sin(t)"] {
        let text = format!("constraint e = a + 0.1 * sin(a) + (b - 1.0) * c; drive b = {drive};");
        assert_eq!(of(&text, ""), newton("newton 0: a"), "{drive}");
    }
    let (all, _) = of("constraint e = a + 0.1 * sin(a) + b * c; drive b = 1.0 + t;", "");
    assert_eq!(all, ["newton 0: c"]);
    // A pose where nothing follows has no say.
    assert_eq!(of("constraint e = sin(a) * sin(b) + c * c * a;", "").0, ["newton 0: c"]);
    // Its factor depends on another coordinate, or on a parameter that may be zero, or it stands elsewhere too.
    assert_eq!(of("constraint e = a * b + cos(c) - 0.5;", ", independent: [a, c]"), newton("newton 0: b"));
    assert_eq!(of("param k = 2.0; constraint e = k * b + cos(c);", ", independent: [a, c]"), newton("newton 0: b"));
    assert_eq!(of("constraint e = b + 0.1 * sin(b) + cos(c);", ", independent: [a, c]"), newton("newton 0: b"));
    // Slopes that don't change, of what is not affine: steps, choices, angles that wrap around.
    for text in [
        "constraint e = b + 0.1 * signum(b - 0.3) - sin(a) - cos(c);",
        "constraint e = b + select(b > 0.3, 0.1, -0.1) - sin(a) - cos(c);",
        "constraint e = b + atan2(sin(b), cos(b)) - sin(a) - cos(c);",
    ] {
        assert_eq!(of(text, ", independent: [a, c]"), newton("newton 0: b"), "{text}");
    }
    let (all, _) = of("constraint e = b + 0.1 * signum(b - 0.3) - a;", ", independent: [a, c]");
    assert_eq!(all, ["newton 0: b"]);
    let (all, _) = of("constraint e = b - 0.1 * a;", ", independent: [a, c]");
    assert_eq!(all, ["linear: b"]);
    // A coupling puts the coordinate there too.
    let (all, guesses) = of("constraint l = a - 3.0 * b; constraint e = b + sin(a) + cos(c);", ", independent: [c]");
    assert_eq!((all.len(), guesses), (2, 1), "{all:?}");
    // One gives what another one reads.
    let (all, guesses) = of("constraint e = b + sin(c); constraint f = a + b * b - c;", ", independent: [c]");
    assert_eq!((all, guesses), (vec!["explicit: b".to_owned(), "explicit: a".to_owned()], 0));
}

/// Three arms with parallelograms of ball joints: idle spins of the rods, and three freedoms of the plate.
#[test]
fn delta_robot() {
    let arm = "mod arm { port base: Frame; port tip: Frame;
        body upper { mass: 1.0, inertia: diag(1.0, 1.0, 1.0) }
        joint hip: Revolute { parent: base, child: upper, axis: Y }
        constraint left: Rod { between: [upper.at([0.5, 0.1, 0.0]), tip.at(0.1 * Y)], length: 1.1 }
        constraint right: Rod { between: [upper.at([0.5, -0.1, 0.0]), tip.at(-0.1 * Y)], length: 1.1 }
    }";
    let text = "const AT: [Scalar; 3] = [0.0, 2.1, -2.1]; formulation { constraints: Reduced }
        body plate { mass: 1.0, inertia: diag(1.0, 1.0, 1.0), coordinates: Absolute(RollPitchYaw) }
        part arms: [arm; 3] = |i| arm { base: ground.rotated(Z, AT[i]).at(0.3 * X), tip: plate.rotated(Z, AT[i]).at(0.1 * X) };";
    let m = model_with(arm, text);
    let structure = sound(&m);
    assert_eq!((structure.freedoms(), structure.guesses()), (3, 6));
    assert_eq!(coordinates(&m, &structure.state), ["plate.x", "plate.y", "plate.z"]);
    let m = model_with(arm, &text.replace("Reduced }", "Reduced, independent: [arms.hip] }"));
    assert_eq!(coordinates(&m, &sound(&m).state), ["arms[0].hip", "arms[1].hip", "arms[2].hip"]);
    // A quaternion can't be found coordinate by coordinate.
    let complaints = analyse(&model_with(arm, &text.replace("RollPitchYaw", "Quaternion"))).expect_err("a complaint");
    assert!(messages(&complaints)[0].contains("makes an orientation depend on other coordinates"));
}

/// Loops of random joints that close by construction: each is found closed, with the freedoms that it has in general.
#[test]
fn random_loops_close() {
    let mut random = Random(2026);
    let mut full = 0;
    for _ in 0..40 {
        let mut text = String::new();
        let mut freedoms = 0;
        let mut count = 0;
        let number = |random: &mut Random| format!("{:?}", (random.next() * 1e3).round() / 1e3);
        let frame = |random: &mut Random| {
            let x: Vec<String> = (0..7).map(|_| number(random)).collect();
            format!("at([{}, {}, {}]).rotated([{}, {}, 0.7], {})", x[0], x[1], x[2], x[3], x[4], x[5])
        };
        let kind = |random: &mut Random| {
            [
                ("Revolute", ", axis: Z", 1),
                ("Prismatic", ", axis: [1.0, 2.0, -2.0]", 1),
                ("Universal", ", axes: [X, Y]", 2),
                ("Cylindrical", ", axis: X", 2),
                ("Screw", ", axis: Y, pitch: 0.3", 1),
                ("Planar", ", axis: Y", 3),
                ("PinSlot", ", axis: Y, slide: [1.0, 0.0, 2.0]", 2),
                ("Ball", "", 3),
                ("Ball", ", coordinates: RollPitchYaw", 3),
            ][((random.next() + 1.0) * 4.499) as usize]
        };
        let last = kind(&mut random);
        while freedoms + last.2 < 7 {
            let (kind, rest, own) = kind(&mut random);
            let parent = if count == 0 { "ground".to_owned() } else { format!("b{}", count - 1) };
            let (from, to) = (frame(&mut random), frame(&mut random));
            text += &body(&format!("b{count}"));
            text += &format!("joint j{count}: {kind} {{ parent: {parent}.{from}, child: b{count}.{to}{rest} }}");
            freedoms += own;
            count += 1;
        }
        let tip = format!("b{}.{}", count - 1, frame(&mut random));
        let case = case(&format!("{text} output p = {tip}.position; output r = {tip}.rotation;"));
        let point = case.random(77);
        let (p, r) = (case.output("p", &point), case.output("r", &point));
        let (kind, rest, own) = last;
        let rest = if kind == "Ball" { "" } else { rest };
        text += &format!(
            "#[cut] joint closing: {kind} {{ parent: {tip}, child: ground.at({p:?}).oriented([{:?}, {:?}, {:?}]){rest} }}",
            &r[..3],
            &r[3..6],
            &r[6..]
        );
        let m = model(&text);
        match analyse(&m) {
            Ok(structure) => {
                // Few turns in a loop leave an equation too many: between two planes the orientation is fixed.
                full += usize::from(structure.rows.len() == 6 - own);
                assert_eq!(structure.rows.len() + structure.dropped.len(), 6 - own, "{text}");
                assert!(structure.notes.iter().all(|note| note.starts_with("redundant")), "{:?}", structure.notes);
            }
            Err(complaints) => panic!("{text}: {:?}", messages(&complaints)),
        }
    }
    assert!(full >= 35, "{full}");
}

#[test]
fn closed_configurations_are_handed_on() {
    // The residuals of the pin, by hand.
    let open = |m: &Model, positions: &[Vec<f64>]| {
        let q = |name: &str| {
            let joint = m.joints.iter().position(|joint| joint.place.field == name).expect("a joint");
            positions[joint][0]
        };
        let (one, two, three) = (q("crank"), q("crank") + q("coupler"), q("rocker"));
        let x = one.cos() + 2.5 * two.cos() - 3.0 - 2.0 * three.cos();
        let y = one.sin() + 2.5 * two.sin() - 2.0 * three.sin();
        x.hypot(y)
    };
    let reduced = "formulation { constraints: Reduced }";
    for (items, start) in [("", None), (reduced, Some(0.0)), (&format!("{reduced} drive crank = 0.4 + t;"), Some(0.4))]
    {
        let m = model(&four_bar(items));
        let structure = sound(&m);
        assert!(structure.closed.len() >= 3, "{}", structure.closed.len());
        for closed in &structure.closed {
            assert!(closed.residual < 1e-10 && open(&m, &closed.positions) < 1e-9, "{closed:?}");
        }
        let crank = m.joints.iter().position(|joint| joint.place.field == "crank").expect("a joint");
        let crank = structure.closed[0].value(&m, Coordinate { joint: JointId(crank), index: 0 });
        assert!(start.is_none_or(|start| crank == Some(start)), "{crank:?}");
    }
}
