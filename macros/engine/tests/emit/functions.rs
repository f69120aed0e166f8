//! Functions of the user's own: what they come to is what the text comes to that stands in their place.

use multibody_engine::diagnostics::Diagnostics;
use multibody_engine::{compile, emit, model};

/// A rod on a hinge of an oblique axis that carries a slide, with a part beside it; `items` behind.
fn code(items: &str, of_leg: &str) -> String {
    let text = format!(
        "mod leg {{
            port hip: Frame;
            param l = 0.7;
            body shank {{ mass: 1.3, com: l * Z }}
            joint knee: Revolute {{ parent: hip, child: shank, axis: [0.3713906763541037, 0.5570860145311556, 0.7427813527082074] }}
            {of_leg}
        }}
        pub mod m {{
            input push;
            param c = -0.35;
            body rod {{ mass: 2.5, com: [0.1, -0.2, 0.3], inertia: diag(0.3, 0.4, 0.5) }}
            body bead {{ mass: 0.5 }}
            joint hinge: Revolute {{ parent: ground, child: rod, axis: [0.6, 0.0, -0.8] }}
            joint slide: Prismatic {{ parent: rod.at([0.0, 0.1, -0.4]), child: bead, axis: [0.0, 0.6, 0.8] }}
            {items}
        }}"
    );
    let mut diagnostics = Diagnostics::default();
    let source = multibody_engine::parse(text.parse().expect("tokens"), &mut diagnostics);
    let models = model::check(&source, &mut diagnostics);
    let said: Vec<String> = diagnostics.errors().iter().map(|error| error.message.clone()).collect();
    assert!(said.is_empty(), "{said:?}");
    let model = models.last().expect("a model");
    let Ok((structure, compiled)) = compile(model) else { panic!("no programs: {items}") };
    emit::emit(model, &structure, &compiled).to_string()
}

#[test]
fn a_call_is_the_text_in_its_place() {
    let calls = "
        let cubic(k, x) = k * x + c * powi(x, 3);
        let steep(k, x) = cubic(cubic(k, x), x) + cubic(1.0, 2.0 * x);
        let about(point) = cross(point.position, point.velocity);
        let tip(along) = bead.at(along * X);
        let rate(q) = q.rate * cos(q);
        let slope(y, q) = diff(y, q);
        let hand(leg, n) = leg + n * Y;
        part legs: [leg; 2] = |i| leg { hip: rod.at(hand([0.1, 0.2, 0.3], i)) };
        state s: rate = steep(s, -0.5 * s) - s, start: 0.25;
        force spring: Effort { joint: slide, value: -steep(push, slide) - rate(slide) }
        output a = slope(steep(2.0, hinge), hinge) + slope(cubic(c, slide), c);
        output b: Vec3 = about(tip(0.2)) + about(rod);
        output d = rate(hinge) + legs[0].reach(slide) * legs[1].reach(-2.0);
        emit forward_dynamics;";
    let written = "
        part legs: [leg; 2] = |i| leg { hip: rod.at([0.1, 0.2, 0.3] + i * Y) };
        state s: rate = (s * (-0.5 * s) + c * powi(-0.5 * s, 3)) * (-0.5 * s) + c * powi(-0.5 * s, 3)
            + (1.0 * (2.0 * (-0.5 * s)) + c * powi(2.0 * (-0.5 * s), 3)) - s, start: 0.25;
        force spring: Effort { joint: slide, value:
            -((push * slide + c * powi(slide, 3)) * slide + c * powi(slide, 3)
            + (1.0 * (2.0 * slide) + c * powi(2.0 * slide, 3))) - slide.rate * cos(slide) }
        output a = diff((2.0 * hinge + c * powi(hinge, 3)) * hinge + c * powi(hinge, 3)
            + (1.0 * (2.0 * hinge) + c * powi(2.0 * hinge, 3)), hinge) + diff(c * slide + c * powi(slide, 3), c);
        output b: Vec3 = cross(bead.at(0.2 * X).position, bead.at(0.2 * X).velocity) + cross(rod.position, rod.velocity);
        output d = hinge.rate * cos(hinge) + (legs[0].l * slide + sin(legs[0].knee)) * (legs[1].l * -2.0 + sin(legs[1].knee));
        emit forward_dynamics;";
    let called = code(calls, "let reach(x) = l * x + sin(knee);");
    assert_eq!(called, code(written, ""));
    // Another function is other code.
    let other = calls.replace("c * powi(x, 3)", "c * powi(x, 5)");
    assert_ne!(called, code(&other, "let reach(x) = l * x + sin(knee);"));
}
