//! What is said of equations that are taken apart, and of formulas of other models: underlined text, message, help.

use multibody_engine::diagnostics::Diagnostics;
use multibody_engine::{Trouble, compile, model, syntax};

/// A planar four-bar in a model of its own; what stands behind it is replaced.
const FOUR_BAR: &str = "
    input torque;
    param reach = 4.0;
    body arm { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
    body link { mass: 3.5, com: 1.75 * X, inertia: rod(3.5, 3.5, X) }
    body lever { mass: 3.0, com: 1.5 * X, inertia: rod(3.0, 3.0, X) }
    joint crank: Revolute { parent: ground, child: arm, axis: Z }
    joint coupler: Revolute { parent: arm.at(X), child: link, axis: Z }
    joint rocker: Revolute { parent: ground.at(reach * X), child: lever, axis: Z }
    #[cut]
    joint pin: Revolute { parent: link.at(3.5 * X), child: lever.at(3.0 * X), axis: Z }
    force motor: Effort { joint: crank, value: torque }
    let swing = rocker.angle;
    output lean = swing + 0.5;
    formulation { constraints: Reduced }
";
const SOLVED: &str = "solve (coupler, rocker) from pin { sin(rocker.angle - crank.angle - coupler.angle) > 0.0 }";

/// A cart that asks the four-bar.
fn asking(bars: &str, items: &str) -> String {
    format!(
        "mod bars {{ {FOUR_BAR} {bars} }} mod m {{ body b {{ mass: 1.0 }} input push; param p = 1.0;
         joint j: Prismatic {{ parent: ground, child: b, axis: X }}
         body c {{ mass: 1.0, inertia: diag(1.0, 1.0, 1.0) }} joint k: Revolute {{ parent: b, child: c, axis: Z }} {items} }}"
    )
}

/// One line per error: the underlined text, the message, the help.
fn said(call: &str) -> Vec<String> {
    let mut diagnostics = Diagnostics::default();
    let source = syntax::parse(call.parse().unwrap(), &mut diagnostics);
    let models = model::check(&source, &mut diagnostics);
    for model in &models {
        if let Err(trouble) = compile(model) {
            assert!(matches!(trouble, Trouble::Complaints(_)), "no refusal of a whole model");
            trouble.report(model, &mut diagnostics);
        }
    }
    let line = |span: proc_macro2::Span, message: &str, help: Option<&str>| {
        let text = span.source_text().unwrap_or_default();
        format!("{text} | {message}{}", help.map_or_else(String::new, |help| format!(" | {help}")))
    };
    diagnostics.errors().iter().map(|e| line(e.span, &e.message, e.help.as_deref())).collect()
}

fn assert_said(call: &str, expected: &[&str]) {
    assert_eq!(said(call), expected, "{call}");
}

#[test]
fn formulas_of_other_models() {
    let asked = |items: &str| asking(SOLVED, items);
    // What is right.
    for items in [
        "output y = bars(rocker, crank = 0.7);",
        "output y = bars([rocker, coupler.angle], crank = j.travel);",
        "output y: Vec3 = bars(link.at(X).position, crank = j, reach = 3.0 + p);",
        "output y = bars(rocker.rate, crank = 0.7, crank.rate = j.rate);",
        "output y = bars(kinetic() + swing * lean, crank = push, crank.rate = 2.0);",
        "output y = bars(diff(swing, crank), crank = t) + bars(mass_matrix[crank, crank], crank = push);",
        "output y = bars(torque * torque, torque = j.accel);",
        "drive j = bars(rocker, crank = 0.1 * t);",
        "constraint held = j - bars(rocker, crank = k, reach = 4.2);",
        "force f: Effort { joint: j, value: bars(lean, crank = push, reach = p + 3.0) }",
    ] {
        assert_said(&asked(items), &[]);
    }
    // What is not.
    assert_said(
        &asked("output y = bars(rocker);"),
        &["bars(rocker) | this needs values of `crank` in `bars` | write `bars(.., crank = ..)`"],
    );
    assert_said(
        &asked("output y = bars(rocker.rate * torque, crank = 0.7);"),
        &["bars(rocker.rate * torque, crank = 0.7) | this needs values of `crank.rate`, `torque` in `bars` | write \
           `bars(.., crank.rate = ..)`"],
    );
    assert_said(
        &asked("output y = bars(crank, rocker = 0.7);"),
        &["rocker | rocker follows from others in `bars`: it is not given"],
    );
    assert_said(
        &asked("output y = bars(rocker.accel, crank = 0.7);"),
        &[
            "accel | `rocker.accel` follows from the equations of motion of `bars`: there is no formula | positions and velocities are \
           formulas, and what is made of them",
        ],
    );
    assert_said(
        &asked("output y = bars(bias[crank], crank = 0.7);"),
        &[
            "bias | `bias` follows from the equations of motion of `bars`: there is no formula | positions and velocities are \
           formulas, and what is made of them",
        ],
    );
    assert_said(
        &asked("output y = bars(rocker, crank = 0.7, crank.angle = 0.2);"),
        &["crank.angle | this variable is named twice"],
    );
    assert_said(
        &asked("output y = bars(rockr, crank = 0.7);"),
        &["rockr | unknown name `rockr` | did you mean `rocker`?"],
    );
    assert_said(&asked("output y = bars(rocker, j = 0.7);"), &["j | unknown name `j`"]);
    assert_said(&asked("output y = bars(rocker, crank = crank);"), &["crank | unknown name `crank`"]);
    assert_said(&asked("output y = bars(rocker, crank = X);"), &["X | expected a scalar, found a Vec3"]);
    assert_said(
        &asked("output y = bars(rocker, 0.7);"),
        &[
            "0.7 | expected `variable = value` | write `bars(expression, variable = value)`, both in the terms of `bars`, the \
           value in those of this model",
        ],
    );
    assert_said(
        &asked("output y = bars();"),
        &[
            "bars | `bars` is a model: what of it? | write `bars(expression, variable = value)`, both in the terms of `bars`, \
           the value in those of this model",
        ],
    );
    assert_said(
        &asked("output y = bars(arm, crank = 0.7);"),
        &["arm | expected a value, found a frame | take `.position`, `.velocity`, `.pose`, .. of it"],
    );
    assert_said(
        &asked("output y = bars(arm.rotation, crank = 0.7);"),
        &[
            "arm.rotation | numbers and vectors are taken from `bars`, found a Rotation | take `.position`, an entry, or a \
           component of it",
        ],
    );
    assert_said(
        &asked("param q = bars(rocker, crank = 0.7);"),
        &[
            "bars | `bars` is a formula of another model; it may stand in drives, constraints, `solve`, `assume`, forces, \
           states, outputs, and the `let` that they use",
        ],
    );
    assert_said(
        &asked("output y = bars(pin.angle, crank = 0.7);"),
        &[
            "pin.angle | the joint `pin` closes a loop and has no coordinates | take coordinates of the joints in the tree, or \
           cut another joint of the loop",
        ],
    );
    assert_said(
        &asked("drive j = bars(rocker, crank = push);"),
        &["push | `push` is an input, whose rate nobody knows; a drive follows time and parameters"],
    );
    assert_said(
        &asked("output y = bars(diff(rocker, rocker), crank = push);"),
        &[
            "diff(rocker, rocker) | rocker follows from others: it is no variable | name one of those; this one moves with them",
        ],
    );
}

/// What is asked of a model that asks another one is looked at as well.
#[test]
fn formulas_of_formulas() {
    let call = |between: &str, items: &str| {
        format!(
            "mod bars {{ {FOUR_BAR} {SOLVED} }}
             mod between {{ body b {{ mass: 1.0 }} joint r: Prismatic {{ parent: ground, child: b, axis: X }} {between} }}
             mod m {{ body b {{ mass: 1.0 }} joint j: Prismatic {{ parent: ground, child: b, axis: X }} {items} }}"
        )
    };
    assert_said(&call("", "output y = between(bars(rocker, crank = r), r = j);"), &[]);
    assert_said(
        &call("", "output y = between(bars(rocker, crank = r, rocker = 0.7), r = j);"),
        &["rocker | rocker follows from others in `bars`: it is not given"],
    );
    assert_said(
        &call("", "output y = between(bars(rocker), r = j);"),
        &["bars(rocker) | this needs values of `crank` in `bars` | write `bars(.., crank = ..)`"],
    );
    assert_said(
        &call("let seen = bars(rocker);", "output y = between(seen);"),
        &["seen | this needs values of `crank` in `bars` | write `bars(.., crank = ..)`"],
    );
}

/// What another model says may follow from functions of Rust, though the question names none: no drive or constraint may rest on it.
#[test]
fn formulas_that_call_functions_of_rust_decide_nothing() {
    let call = |items: &str| {
        format!(
            "mod leg {{
                extern f(x) = crate::F;
                body tip {{ mass: 1.0, com: -Y }}
                joint turn: Revolute {{ parent: ground, child: tip, axis: Z }}
                force spring: Spring {{ joint: turn, stiffness: 2.0 + f(0.2) }}
             }}
             mod m {{ body b {{ mass: 1.0 }} joint j: Prismatic {{ parent: ground, child: b, axis: X }} {items} }}"
        )
    };
    let direct = "`f` is a function of Rust, whose values are not known while the model is checked";
    let indirect = " | this calls `f`, a function of Rust, whose values are not known while the model is derived";
    let is_said = |items: &str, what: &str| {
        let said = said(&call(items));
        assert!(said.len() == 1 && said[0].contains(what), "{items}: {said:?}");
    };
    for question in ["potential()", "diff(potential(), turn)"] {
        is_said(&format!("drive j = leg({question}, turn = t);"), indirect);
        is_said(&format!("constraint c = j - leg({question}, turn = 0.3);"), indirect);
        is_said(&format!("let x = leg({question}, turn = 0.3); drive j = 2.0 * x;"), indirect);
        assert_said(&call(&format!("force f: Effort {{ joint: j, value: leg({question}, turn = j) }}")), &[]);
    }
    is_said("drive j = leg(f(turn), turn = t);", direct);
    assert_said(&call("output y = leg(f(turn) + diff(f(turn), turn), turn = j.rate);"), &[]);
    assert_said(&call("drive j = leg(tip.position.x, turn = t);"), &[]);
    is_said("output y = diff(leg(diff(f(turn), turn), turn = j), j);", "slopes of the slopes of `f`");
}

/// Loops that close for the declared parameters alone, and formulas of the user, which were tested with these.
#[test]
fn formulas_keep_what_loops_rest_on() {
    let call = |loops: &str, items: &str| {
        format!(
            "mod bars {{
                formulation {{ constraints: Reduced }}
                param reach = 4.0;
                param weight = 1.0;
                body arm {{ mass: weight, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }}
                body link {{ mass: 3.5, com: 1.75 * X, inertia: rod(3.5, 4.0, X) }}
                body lever {{ mass: 3.0, com: 0.5 * X, inertia: rod(3.0, 1.0, X) }}
                joint crank: Revolute {{ parent: ground, child: arm, axis: Z }}
                joint coupler: Revolute {{ parent: arm.at(X), child: link, axis: Z }}
                joint rocker: Revolute {{ parent: ground.at(reach * X), child: lever, axis: Z }}
                #[cut]
                joint pin: Revolute {{ parent: link.at(4.0 * X), child: lever.at(X), axis: Z }}
                {loops}
            }}
            mod m {{ body b {{ mass: 1.0 }} joint j: Prismatic {{ parent: ground, child: b, axis: X }} {items} }}"
        )
    };
    let own = "solve (coupler, rocker) = (-crank, crank);";
    assert_said(&call(own, "output y = bars(rocker, crank = j);"), &[]);
    assert_said(
        &call(own, "output y = bars(rocker, crank = j, reach = 4.5);"),
        &[
            "reach | the loops of `bars` are known to close for the declared `reach` only | solve them by `solve (..) from ..`, \
           with equations that hold for any",
        ],
    );
    // A pin whose axis is that of the other joints for a tilt of zero alone.
    let tilted = format!("mod bars {{ param tilt = 0.0; {FOUR_BAR} {SOLVED} }}")
        .replace("parent: link.at(3.5 * X)", "parent: link.at(3.5 * X).rotated(X, tilt)");
    let cart = "body b { mass: 1.0 } joint j: Prismatic { parent: ground, child: b, axis: X }";
    assert_said(&format!("{tilted} mod m {{ {cart} output y = bars(rocker, crank = j, reach = 4.01); }}"), &[]);
    // Of an array of parts each element gives its own value.
    let pieces = "mod piece { port on: Frame; param lean = 0.0; body p { mass: 1.0 }
                  joint q: Prismatic { parent: on, child: p, axis: X } output y = bars(rocker, crank = q, tilt = lean); }";
    for (leans, mistakes) in [("[0.0, 0.0, 0.0]", 0), ("[0.0, 0.1, 0.2]", 1), ("[0.2, 0.1, 0.0]", 1)] {
        let all = format!("const L = {leans}; part all: [piece; 3] = |i| piece {{ on: ground, lean: L[i] }};");
        assert_eq!(said(&format!("{tilted} {pieces} mod m {{ {all} }}")).len(), mistakes, "{all}");
    }
    assert_said(
        &format!("{tilted} mod m {{ {cart} output y = bars(rocker, crank = j, tilt = 0.3); }}"),
        &[
            "tilt | the loops of `bars` are known to close for the declared `tilt` only | solve them by `solve (..) from ..`, \
           with equations that hold for any",
        ],
    );
}

#[test]
fn formulas_of_models_that_have_none() {
    // Newton's method.
    let lines = said(&asking("", "output y = bars(rocker, crank = 0.7);"));
    assert_eq!(
        lines,
        [
            "rocker | a loop of `bars` that this reads is closed by iteration: there is no formula | write `solve (..) from ..` \
          in `bars`"
        ]
    );
    // Which of its coordinates follow is decided by counts, behind this.
    let call = asking(SOLVED, "output y = bars(rocker, crank = 0.7);").replace("Reduced", "Auto");
    assert_said(
        &call,
        &[
            "bars | `bars` has `constraints: Auto`: which of its coordinates follow is not known here | write `Reduced` or \
           `Multipliers` there",
        ],
    );
    // Below, itself, a part, a mistake elsewhere.
    let body = "body b { mass: 1.0 } joint j: Prismatic { parent: ground, child: b, axis: X }";
    assert_said(
        &format!("mod m {{ {body} output y = n(j, j = 1.0); }} mod n {{ {body} }}"),
        &["n | `n` does not stand above | a formula is taken from a model that stands above in the same call"],
    );
    assert_said(
        &format!("mod m {{ {body} output y = m(j, j = 1.0); }}"),
        &["m | `m` does not stand above | a formula is taken from a model that stands above in the same call"],
    );
    assert_said(
        &format!(
            "mod p {{ port a: Frame; output y = 1.0; }} mod m {{ {body} output y = p(y); part q: p {{ a: b }}; }}"
        ),
        &[
            "p | `p` is a part: it has no equations of its own | formulas are taken from models, which are modules without \
           ports",
        ],
    );
    assert_said(
        &format!("mod n {{ {body} output y = nothing; }} mod m {{ {body} output y = n(j, j = 1.0); }}"),
        &["nothing | unknown name `nothing`"],
    );
    let lines = said(&asking(
        "solve (coupler, rocker) from pin { sin(rocker.angle) > 5.0 }",
        "output y = bars(rocker, crank = 0.7);",
    ));
    assert_eq!(lines.len(), 1, "one mistake is reported once: {lines:#?}");
    assert_said(
        &format!(
            "#[cfg(any())] mod n {{ {body} }} #[cfg(not(any()))] mod n {{ {body} }} mod m {{ {body} output y = n(j, j = 1.0); }}"
        ),
        &["n | there are two modules `n`: which one is meant is not known here"],
    );
}

#[test]
fn equations_taken_apart() {
    let apart = |items: &str| format!("mod bars {{ {FOUR_BAR} {SOLVED} {items} }}");
    assert_said(
        &apart("output y = diff(rocker, reach);"),
        &[
            "diff(rocker, reach) | this reads positions, and some coordinates follow from others by equations that parameters \
           are in: their derivatives by parameters are not known | differentiate a part that reads no positions",
        ],
    );
    assert_said(
        &apart("output y = diff(rocker, coupler);"),
        &[
            "diff(rocker, coupler) | coupler follows from others: it is no variable | name one of those; this one moves with \
           them",
        ],
    );
    assert_said(
        &apart("output y = substitute(rocker, crank = 0.3);"),
        &[
            "substitute(rocker, crank = 0.3) | this reads positions, and some coordinates follow from others by equations that \
           would have to be solved anew | inputs and states can be put in here; or substitute in a part that reads no \
           positions",
        ],
    );
    assert_said(
        &apart("output y = mass_matrix[crank, rocker];"),
        &[
            "mass_matrix[crank, rocker] | rocker follows from others: it is no variable | name one of those; this one moves \
           with them",
        ],
    );
    assert_said(
        &apart("output y = bias[coupler];"),
        &[
            "bias[coupler] | coupler follows from others: it is no variable | name one of those; this one moves with them",
        ],
    );
    assert_said(&apart("output y = closed(rocker) + diff(closed(rocker.angle), crank);"), &[]);
    let held = |items: &str| {
        let bars = FOUR_BAR.replace("formulation { constraints: Reduced }", "");
        format!("mod bars {{ {bars} {items} }}")
    };
    assert_said(
        &held(
            "output y = constraint[pin.x] + diff(constraint[pin.y], crank) + jacobian[pin.y, rocker] + constraint[pin.z];",
        ),
        &[],
    );
    for items in ["constraint[pin.x]", "jacobian[pin.y, crank]"] {
        assert_said(
            &apart(&format!("output y = {items};")),
            &[&format!(
                "{items} | no equation of `pin` keeps a multiplier: they are solved, and nothing is left of them | `formulation \
                 {{ constraints: Multipliers }}` keeps them"
            )],
        );
    }
    assert_said(
        &apart("output y = closed(crank);"),
        &[
            "closed(crank) | crank is in the state: nothing gives it | loops are solved by `formulation { constraints: Reduced \
           }`",
        ],
    );
    assert_said(
        &format!("mod bars {{ {FOUR_BAR} output y = closed(rocker) + closed(coupler); }}"),
        &[
            "closed(coupler) | coupler is found by iteration: there is no formula | write `solve (..) from ..`",
            "closed(rocker) | rocker is found by iteration: there is no formula | write `solve (..) from ..`",
        ],
    );
    assert_said(&apart("output y = closed(torque);"), &["torque | `torque` is no coordinate"]);
    assert_said(
        &apart("output y = constraint[pin.w];"),
        &[
            "constraint[pin.w] | the joint `pin` has no equation `w` | its equations are `pin.x`, `pin.y`, `pin.z`, `pin.turn_y`, \
           `pin.turn_x`",
        ],
    );
    assert_said(
        &apart("output y = constraint[crank.x];"),
        &["constraint[crank.x] | the joint `crank` closes no loop: it has no equations"],
    );
    assert_said(
        &apart("output y = constraint[pin];"),
        &["pin | `pin` closes its loop by several equations | name one, such as `pin.x`"],
    );
    assert_said(
        &apart("output y = jacobian[pin.x];"),
        &["[pin.x] | `jacobian` has no entry of 1 indices | write `jacobian[ball.x, hinge]`"],
    );
    assert_said(
        &apart("output y = jacobian[pin.x, rocker];"),
        &[
            "jacobian[pin.x, rocker] | no equation of `pin` keeps a multiplier: they are solved, and nothing is left of them | \
           `formulation { constraints: Multipliers }` keeps them",
        ],
    );
    assert_said(
        &apart("constraint gear = crank - constraint[pin.x];"),
        &[
            "constraint | `constraint` is made of finished equations; it may stand in outputs, forces, states, and the `let` \
           that they use",
        ],
    );
    let cart = "body b { mass: 1.0 } input u; joint j: Prismatic { parent: ground, child: b, axis: X }
                force s: Spring { joint: j, stiffness: u }";
    assert_said(
        &format!("mod m {{ {cart} output y = diff(potential(), t); }}"),
        &[
            "diff(potential(), t) | a spring's energy depends on an input: its rate is not known, so there is no derivative by \
           time | differentiate by coordinates, and multiply by their rates",
        ],
    );
}

/// What newcomers write first: one message each, at the token.
#[test]
fn first_mistakes() {
    let arm = |items: &str| {
        format!(
            "mod arm {{
                #[doc = \" [m] of the lower link\"] param l = 0.4;
                #[doc = \" [s] of a filter\"] param delay = 0.1;
                #[doc = \" [N m]\"] input torque;
                world {{ gravity: -9.81 * Z }}
                body lower {{ mass: 1.0, com: 0.2 * X, inertia: rod(1.0, 0.4, X) }}
                body upper {{ mass: 0.6, com: 0.2 * X, inertia: rod(0.6, 0.4, X) }}
                joint base: Revolute {{ parent: ground, child: lower, axis: Y }}
                joint elbow: Revolute {{ parent: lower.at(l * X), child: upper, axis: Y }}
                force motor: Effort {{ joint: base, value: torque }}
                {items}
            }}"
        )
    };
    for (items, expected) in [
        ("output x = l + delay;", "delay | `l` is in m, `delay` in s: a sum needs one unit"),
        ("output x = sin(l);", "l | `sin` takes an angle in rad, `l` is in m"),
        (
            "force f: Effort { joint: elbow, value: torque * l }",
            "torque * l | a torque is in N m, this is in kg m^3/s^2",
        ),
        ("output x = diff(potential(), elbw);", "elbw | unknown name `elbw` | did you mean `elbow`?"),
        (
            "output x = der(elbow);",
            "der | unknown function `der` | write `diff(x, t)`; the rate of a coordinate is `joint.rate`, of a point \
             `frame.velocity`",
        ),
        (
            "output x = diff(potential(), 2.0 * elbow);",
            "2.0 * elbow | this expression is no variable | there are coordinates, their rates, states, parameters, inputs, \
             and `t`",
        ),
        (
            "output x = diff(elbow.accel, t);",
            "accel | `elbow.accel` follows from the equations of motion: `diff` can't take it apart | `emit linearize` \
             differentiates outputs, accelerations and reactions too",
        ),
        ("output x = mass_matrix[0, 1];", "0 | `0` is no coordinate: entries of `mass_matrix` are named by them"),
        (
            "output x = substitute(potential(), elbow == 0.0);",
            "elbow == 0.0 | expected `variable = value` | write `substitute(expression, hinge.rate = 0.0)`",
        ),
        (
            "force f: Effort { joint: elbow, value: bias[elbow] }",
            "bias | `bias` follows from the forces, so no force or state may use it",
        ),
        (
            "output x = diff(torque * elbow, t);",
            "torque | `torque` is an input: its rate is not known, so there is no derivative by time",
        ),
        (
            "simplify small(l);",
            "l | expected a coordinate | write a joint's name, or one coordinate such as `gimbal.first`",
        ),
        (
            "solve (x) from x + 1.0 = torque;",
            "= | an equation is written with `==` | write `solve (x) from a * x == b;`",
        ),
        (
            "output x = arm(elbow, elbow = 1.0);",
            "arm | `arm` does not stand above | a formula is taken from a model that stands above in the same call",
        ),
    ] {
        assert_said(&arm(items), &[expected]);
    }
}
