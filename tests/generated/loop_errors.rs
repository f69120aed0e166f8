//! What is said about loops that can't be, through the whole engine: underlined text, message, help.

use multibody_engine::diagnostics::Diagnostics;
use multibody_engine::{Trouble, compile, model, syntax};

/// A planar four-bar; its parts may be replaced.
const FOUR_BAR: &str = "
    body arm { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
    body link { mass: 3.5, com: 1.75 * X, inertia: rod(3.5, 3.5, X) }
    body lever { mass: 3.0, com: 1.5 * X, inertia: rod(3.0, 3.0, X) }
    joint crank: Revolute { parent: ground, child: arm, axis: Z }
    joint coupler: Revolute { parent: arm.at(X), child: link, axis: Z }
    joint rocker: Revolute { parent: ground.at(4.0 * X), child: lever, axis: Z }
    #[cut]
    joint pin: Revolute { parent: link.at(3.5 * X), child: lever.at(3.0 * X), axis: Z }
";

/// Bennett's four-bar, which only moves with these angles and lengths.
const BENNETT: &str = "
    const B = sin(1.1) / sin(0.6);
    const K = sin(0.85) / sin(0.25);
    formulation { constraints: Reduced }
    body one { mass: 1.0, inertia: diag(0.1, 0.1, 0.1) }
    body two { mass: 1.5, inertia: diag(0.1, 0.1, 0.1) }
    body three { mass: 1.0, inertia: diag(0.1, 0.1, 0.1) }
    joint first: Revolute { parent: ground, child: one, axis: Z }
    joint second: Revolute { parent: one.at(X).rotated(X, 0.6), child: two, axis: Z }
    joint third: Revolute { parent: two.at(B * X).rotated(X, 1.1), child: three, axis: Z }
    #[cut]
    joint fourth: Revolute { parent: three.at(X).rotated(X, 0.6), child: ground.rotated(X, -1.1).at(-B * X), axis: Z }
";

const REDUCED: &str = "formulation { constraints: Reduced }";
const SOLVED: &str = "solve (coupler, rocker) from pin { sin(rocker.angle - crank.angle - coupler.angle) > 0.0 }";

/// One line per error: the underlined text, the message, the help.
fn said(items: &str) -> Vec<String> {
    let mut diagnostics = Diagnostics::default();
    let source = syntax::parse(format!("mod m {{ {items} }}").parse().unwrap(), &mut diagnostics);
    let models = model::check(&source, &mut diagnostics);
    let line = |span: proc_macro2::Span, message: &str, help: Option<&str>| {
        let text = span.source_text().unwrap_or_default();
        format!("{text} | {message}{}", help.map_or_else(String::new, |help| format!(" | {help}")))
    };
    let mut lines: Vec<String> =
        diagnostics.errors().iter().map(|e| line(e.span, &e.message, e.help.as_deref())).collect();
    for model in &models {
        match compile(model) {
            Err(Trouble::Complaints(list)) => {
                lines.extend(list.iter().map(|c| line(c.at.span(), &c.message, c.help.as_deref())))
            }
            Err(Trouble::Refused(refusal)) => lines.push(format!("{refusal:?}")),
            Err(Trouble::Fault(fault)) => lines.push(format!("{fault:?}")),
            Ok(_) => {}
        }
    }
    lines
}

/// What is said begins with this.
fn assert_said(items: &str, expected: &str) {
    let lines = said(items);
    println!("{lines:#?}");
    assert!(lines.len() == 1 && lines[0].starts_with(expected), "{lines:#?} instead of {expected}");
}

#[test]
fn nothing_is_said_about_what_is_right() {
    let nothing = Vec::<String>::new();
    assert_eq!(said(FOUR_BAR), nothing);
    assert_eq!(said(&format!("{FOUR_BAR} {REDUCED} {SOLVED}")), nothing);
    assert_eq!(said(&format!("{FOUR_BAR} {REDUCED} {SOLVED} drive crank = t;")), nothing);
    let right =
        "solve (second, third) = (2.0 * atan2(K * cos(0.5 * first.angle), sin(0.5 * first.angle)), -first.angle);";
    assert_eq!(said(&format!("{BENNETT} {right}")), nothing);
}

#[test]
fn a_loop_that_cannot_close() {
    let far = FOUR_BAR.replace("4.0 * X", "9.0 * X");
    assert_said(&far, "pin | the loop that `pin` closes cannot close: the smallest gap found is 1.5 m");
    assert_said(&format!("{far} {REDUCED} {SOLVED}"), "pin | the loop that `pin` closes cannot close");
    // Out of its plane.
    let lifted = FOUR_BAR.replace("link.at(3.5 * X)", "link.at([3.5, 0.0, 0.1])");
    assert_said(&lifted, "pin | the loop that `pin` closes cannot close: the smallest gap found is 0.1 m");
    // A rod that is too long.
    let rod =
        FOUR_BAR.replace("#[cut]", "constraint bar: Rod { between: [arm.at(X), lever.at(3.0 * X)], length: 8.5 }");
    let rod =
        rod.replace("lever.at(3.0 * X), axis", "ground.at(3.0 * X), axis").replace("joint pin", "#[cut] joint pin");
    assert_said(&rod, "bar | the constraint `bar` cannot close: the smallest gap found is 0.5 m");
    // Parameters are the user's choice at run time: that loop is for `assemble`.
    let adjustable = FOUR_BAR.replace("4.0 * X", "foot * X");
    assert_eq!(said(&format!("param foot = 4.0; {adjustable}")), Vec::<String>::new());
    assert_eq!(said(&format!("param foot = 9.0; {adjustable}")), Vec::<String>::new());
}

#[test]
fn jumps_and_momenta_that_cannot_be() {
    let body = "body b { mass: 1.0, inertia: diag(1.0, 1.0, 2.0) }";
    let help = "take a symmetric method, which integrates positions and velocities";
    let ball = "joint eye: Ball { parent: ground, child: b }";
    assert_said(
        &format!("{body} {ball} emit forward_dynamics, momentum;"),
        &format!(
            "momentum | the velocities of `eye` are no rates of coordinates, so they have no momenta \
             | write `coordinates: RollPitchYaw` there, or {help}"
        ),
    );
    let angles = ball.replace("child: b", "child: b, coordinates: RollPitchYaw");
    assert_eq!(said(&format!("{body} {angles} emit momentum, impulse;")), Vec::<String>::new());
    assert_eq!(said(&format!("{body} {ball} emit impulse;")), Vec::<String>::new());
    let hinge = "joint hinge: Revolute { parent: ground, child: b, axis: X }";
    let state = "state current: rate = -current, start: 1.0;";
    assert_eq!(said(&format!("{body} {hinge} {state} emit impulse;")), Vec::<String>::new());
    assert_said(
        &format!("{body} {hinge} {state} emit impulse, momentum;"),
        &format!("momentum | `momentum` has no place for states of your own | {help}"),
    );
    assert_said(
        &format!("{FOUR_BAR} emit momentum, impulse;"),
        &format!("momentum | `momentum` has no place for multipliers | write `constraints: Reduced`, or {help}"),
    );
    assert_eq!(said(&format!("{FOUR_BAR} {REDUCED} {SOLVED} emit momentum, impulse;")), Vec::<String>::new());
    let newton = "knows no guess, and a loop of this model is closed by Newton's method | write a `solve` for the loop";
    assert_said(&format!("{FOUR_BAR} {REDUCED} emit momentum;"), &format!("momentum | `momentum` {newton}"));
    assert_said(
        &format!("{FOUR_BAR} {REDUCED} emit impulse;"),
        &format!("impulse | `impulse` {newton}, or `constraints: Multipliers`"),
    );
    // What moves by itself has a momentum of its own.
    let carried = "body arm { mass: 1.0, com: X } joint crank: Revolute { parent: ground, child: arm, axis: Z }
        joint hang: Revolute { parent: arm.at(X), child: b, axis: Z } emit impulse, momentum;";
    assert_said(
        &format!("{body} {carried} drive crank = 2.0 * t;"),
        &format!("momentum | `momentum` belongs to coordinates alone, and some of this model follow the time | {help}"),
    );
    assert_eq!(said(&format!("{body} {carried} drive crank = 0.3;")), Vec::<String>::new());
    assert_said(&format!("{body} {hinge} emit impulse {{ of: hinge }};"), "of | `impulse` has no options");
    assert_said(&format!("{body} {hinge} emit momentum, momentum;"), "momentum | `momentum` is asked for twice");
}

#[test]
fn a_loop_with_too_many_equations() {
    let triangle = "
        body a { mass: 1.0, inertia: diag(1.0, 1.0, 1.0) }
        body b { mass: 1.0, inertia: diag(1.0, 1.0, 1.0) }
        joint one: Revolute { parent: ground, child: a, axis: Z }
        joint two: Revolute { parent: a.at(X), child: b, axis: Z }
        #[cut]
        joint three: Revolute { parent: b.at(X), child: ground.at(X), axis: Z }
    ";
    let locked = "three | the loop that `three` closes leaves no freedom: nothing can move among `one`, `two`";
    assert_said(triangle, locked);
    assert_said(&format!("{triangle} {REDUCED}"), locked);
    // Out of the plane by an angle: it neither closes nor moves.
    let twisted = FOUR_BAR.replace("ground.at(4.0 * X)", "ground.at(4.0 * X).rotated(X, 0.3)");
    assert_said(&twisted, "pin | the loop that `pin` closes cannot close");
    // The last freedom, taken by a rod.
    let held = format!("{FOUR_BAR} constraint held: Rod {{ between: [arm.at(X), ground.at(3.0 * Y)], length: 2.5 }}");
    let lines = said(&held);
    assert!(lines.len() == 1 && lines[0].contains("leaves no freedom"), "{lines:#?}");
}

#[test]
fn solutions() {
    let of = |text: &str| format!("{FOUR_BAR} {REDUCED} {text}");
    let two = "solve | this loop has 2 solutions | choose one by conditions that hold on its branch alone, `solve .. from \
        .. { sin(a) > 0.0 }`; at one configuration they are (coupler = ";
    let none = "solve | no solution of this loop satisfies the conditions everywhere | choose one by conditions";
    for (text, expected) in [
        ("solve (coupler, rocker) from pin {}", two),
        (
            "solve (coupler, rocker) from pin { 1.0 > 0.0 }",
            "solve | 2 solutions of this loop satisfy the conditions | ",
        ),
        ("solve (coupler, rocker) from pin { sin(crank.angle) > 2.0 }", none),
        ("solve (coupler, rocker) from pin { sin(coupler.angle) > 0.0 }", none),
        (
            "solve (coupler) from pin { sin(coupler.angle) > 0.0 }",
            "solve | `solve` names 1 unknowns, but the loop gives 2 equations for them | name all coordinates",
        ),
        (
            "solve (coupler, rocker) = (-crank, crank);",
            "solve | the formulas of `coupler`, `rocker` do not close their loop | check signs and branches",
        ),
        ("solve (coupler, rocker) = (-crank);", "-crank | 2 unknown coordinates but 1 formula | "),
        ("solve (coupler, rocker) from pins { sin(rocker) > 0.0 }", "pins | unknown name `pins` | did you mean `pin`?"),
    ] {
        assert_said(&of(text), expected);
    }
    // Six revolute joints in general position: an equation of degree sixteen.
    let general = "
        body a { mass: 1.0, inertia: diag(1.0, 1.0, 1.0) } body b { mass: 1.0, inertia: diag(1.0, 1.0, 1.0) }
        body c { mass: 1.0, inertia: diag(1.0, 1.0, 1.0) } body d { mass: 1.0, inertia: diag(1.0, 1.0, 1.0) }
        body e { mass: 1.0, inertia: diag(1.0, 1.0, 1.0) } body f { mass: 1.0, inertia: diag(1.0, 1.0, 1.0) }
        joint j1: Revolute { parent: ground, child: a, axis: Z }
        joint j2: Revolute { parent: a.at([1.0, 0.1, 0.2]).rotated(X, 0.9), child: b, axis: Z }
        joint j3: Revolute { parent: b.at([0.8, 0.2, -0.1]).rotated(X, -1.1), child: c, axis: Z }
        joint j4: Revolute { parent: c.at([1.1, -0.1, 0.3]).rotated(X, 0.7), child: d, axis: Z }
        joint j5: Revolute { parent: d.at([0.9, 0.2, 0.1]).rotated(X, 1.3), child: e, axis: Z }
        joint j6: Revolute { parent: e.at([0.7, 0.0, 0.2]).rotated(X, -0.8), child: f, axis: Z }
        #[cut]
        joint j7: Revolute { parent: f.at([0.8, 0.3, 0.0]).rotated(X, 0.6), child: ground.at(X), axis: Z }
        formulation { constraints: Reduced }
        solve (j2, j3, j4, j5, j6) from j7 { sin(j3) > 0.0 }
    ";
    assert_said(general, "solve | no closed form was found for this loop: ");
}

/// Mistakes in a plate on slides and rods, whose place is found from three of them.
#[test]
fn rods_that_give_no_place() {
    let plate = "
        body plate { mass: 2.5 } body along { mass: 0.2 } body across { mass: 0.3 }
        body one { mass: 1.0, com: 0.1 * X, inertia: diag(0.01, 0.01, 0.01) }
        body two { mass: 1.0, com: 0.1 * X, inertia: diag(0.01, 0.01, 0.01) }
        joint x: Prismatic { parent: ground, child: along, axis: X }
        joint y: Prismatic { parent: along, child: across, axis: Y }
        joint z: Prismatic { parent: across, child: plate, axis: Z }
        joint a: Revolute { parent: ground.at(0.2 * X), child: one, axis: Y }
        joint b: Revolute { parent: ground.at(-0.2 * X), child: two, axis: Y }
        constraint first: Rod { between: [one.at(0.3 * X), plate], length: 0.8 }
        constraint second: Rod { between: [two.at(-0.3 * X), plate], length: 0.8 }
        constraint third: Rod { between: [ground.at(0.4 * Y), plate.at(0.1 * Y)], length: 0.7 }";
    let of = |text: &str| format!("{plate} {REDUCED} {text}");
    for (text, expected) in [
        (
            "solve (x, y, z) from (first, second, third) {}",
            "solve | these loops have 2 solutions | choose one by conditions that hold on its branch alone",
        ),
        (
            "solve (x, y, z) from (first, second, third) { z < 0.0 }",
            "solve | no solution of these loops satisfies the conditions everywhere | choose one by conditions",
        ),
        (
            "solve (x, y, z) from (first, second) { z < 0.0 }",
            "solve | `solve` names 3 unknowns, but the loops give 2 equations for them | name as many coordinates",
        ),
        (
            "constraint fourth: Rod { between: [ground, plate.at(0.1 * X)], length: 0.6 }
            solve (x, y, z) from (first, second, third, fourth) { z < 0.0 }",
            "solve | `solve` names 3 unknowns, but the loops give 4 equations for them | name all coordinates",
        ),
        // Something else stands beside it: one mistake, one error.
        (
            "body four { mass: 1.0, com: 0.1 * X, inertia: diag(0.01, 0.01, 0.01) }
            body five { mass: 1.0, com: 0.1 * X, inertia: diag(0.01, 0.01, 0.01) }
            joint c: Revolute { parent: ground.at(2.0 * X), child: four, axis: Y }
            joint d: Revolute { parent: ground.at(3.0 * X), child: five, axis: Y }
            constraint beside: Rod { between: [four.at(0.3 * X), five.at(0.3 * X)], length: 1.01 }
            solve (x, y, z) from (first, second, beside) { z < 0.0 }",
            "beside | the constraint `beside` has no coordinate in common with the others | write a `solve` of its own",
        ),
    ] {
        assert_said(&of(text), expected);
    }
    // Three balls on a line, from which the same two points have their distances, wherever the line is.
    let line = plate
        .replace("one.at(0.3 * X), plate], length: 0.8", "one.at(0.3 * X), plate], length: 0.7745966692414834")
        .replace("two.at(-0.3 * X), plate], length: 0.8", "one.at(0.1 * X), plate], length: 0.7211102550927979")
        .replace(
            "ground.at(0.4 * Y), plate.at(0.1 * Y)], length: 0.7",
            "one.at(-0.1 * X), plate], length: 0.7211102550927979",
        );
    let text = format!("{line} {REDUCED} solve (x, y, z) from (first, second, third) {{ z < 0.0 }}");
    assert_said(&text, "solve | `solve` names 3 unknowns, but the loops give 2 equations for them | ");
}

#[test]
fn formulas_with_one_wrong_sign() {
    let expected = "solve | the formulas of `second`, `third` do not close their loop";
    for wrong in [
        "solve (second, third) = (2.0 * atan2(-K * cos(0.5 * first.angle), sin(0.5 * first.angle)), -first.angle);",
        "solve (second, third) = (2.0 * atan2(K * cos(0.5 * first.angle), sin(0.5 * first.angle)), first.angle);",
        "solve (second, third) = (2.0 * atan2(K * cos(0.5 * first.angle), -sin(0.5 * first.angle)), -first.angle);",
        "solve (second, third) = (-2.0 * atan2(K * cos(0.5 * first.angle), sin(0.5 * first.angle)), -first.angle);",
    ] {
        assert_said(&format!("{BENNETT} {wrong}"), expected);
    }
}

#[test]
fn drives_of_what_depends() {
    let twice = "rocker | the drive prescribes what follows from the loops and other drives: `rocker` | drive as many";
    for (text, expected) in [
        (
            format!("{REDUCED} {SOLVED} drive rocker = 0.1 * t;"),
            "rocker | `rocker` is dependent, it follows from a `solve`: a drive can't prescribe it | drive an independent",
        ),
        (format!("{REDUCED} drive crank = t; drive rocker = t;"), twice),
        ("drive crank = t; drive rocker = 2.0 * t;".to_owned(), twice),
        ("drive pin = t;".to_owned(), "pin | the joint `pin` closes a loop and has no coordinates"),
    ] {
        assert_said(&format!("{FOUR_BAR} {text}"), expected);
    }
}

#[test]
fn inputs_to_solve_for() {
    let bar = |text: &str| format!("{FOUR_BAR} input u; input w; force f: Effort {{ joint: crank, value: u }} {text}");
    let pair = "force g: Effort { joint: rocker, value: w } emit inverse_dynamics { solve_for: [u, w] };";
    let many = "u | too many inputs to solve for: 2 where 1 are needed | ";
    assert_said(&bar(&format!("{REDUCED} {SOLVED} {pair}")), many);
    assert_said(&bar(pair), many);
    let idle = "w | these inputs cannot produce every motion: ";
    assert_said(&bar(&format!("{REDUCED} {SOLVED} emit inverse_dynamics {{ solve_for: w }};")), idle);
    assert_eq!(said(&bar("emit inverse_dynamics { solve_for: u };")), Vec::<String>::new());
    assert_eq!(
        said(&bar(&format!("{REDUCED} {SOLVED} emit inverse_dynamics {{ solve_for: u }};"))),
        Vec::<String>::new()
    );

    let arm = |text: &str| {
        format!(
            "body a {{ mass: 1.0, inertia: diag(1.0, 1.0, 1.0) }} body b {{ mass: 1.0, inertia: diag(1.0, 1.0, 1.0) }}
            joint one: Revolute {{ parent: ground, child: a, axis: Z }}
            joint two: Revolute {{ parent: a.at(X), child: b, axis: Z }}
            input u; input w; force f: Effort {{ joint: one, value: u }} {text}"
        )
    };
    assert_said(
        &arm("emit inverse_dynamics { solve_for: u };"),
        "u | too few inputs to solve for: 1 where 2 are needed | ",
    );
    let both = |joint: &str| {
        format!("force g: Effort {{ joint: {joint}, value: w }} emit inverse_dynamics {{ solve_for: [u, w] }};")
    };
    assert_said(&arm(&both("one")), "u | these inputs cannot produce every motion: ");
    assert_eq!(said(&arm(&both("two"))), Vec::<String>::new());
}
