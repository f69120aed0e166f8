//! How formulas are set, against textbooks.

use std::collections::BTreeSet;

use multibody_engine::mechanics;
use multibody_engine::mechanics::written::Subject;
use multibody_engine::symbolic::write::formula::{Formula, Identifier};
use multibody_engine::symbolic::write::{latex, mathml, text};

use crate::corpus;

/// Right sides with a subject, as text.
fn lines(model: &str, wanted: impl Fn(Subject) -> bool) -> Vec<String> {
    let model = corpus::model(model);
    let structure = mechanics::analysis::analyse(&model).ok().unwrap();
    let page = mechanics::page(&model, &structure).ok().unwrap();
    let lines = page.sections.iter().flat_map(|section| &section.lines);
    lines.filter(|line| wanted(line.subject)).map(|line| text::equation(&line.equation)).collect()
}

const PENDULUM: &str = "pub mod pendulum {
    param m1 = 1.0;
    param m2 = 2.0;
    param l1 = 1.0;
    param l2 = 0.5;
    param g = 9.81;
    world { gravity: -g * Y }
    body upper { mass: m1, com: -l1 * Y }
    body lower { mass: m2, com: -l2 * Y }
    joint phi: Revolute { parent: ground, child: upper, axis: Z }
    joint psi: Revolute { parent: upper.at(-l1 * Y), child: lower, axis: Z }
    emit forward_dynamics;
}";

/// Two point masses, relative angles: Craig, Introduction to Robotics, with angles from the vertical.
#[test]
fn double_pendulum() {
    let motion = |s| matches!(s, Subject::Mass(..) | Subject::Inertial(_) | Subject::Gravity(_));
    let found = lines(PENDULUM, motion);
    let textbook = [
        "M[phi, phi] = m2 l2 (2 l1 cos(psi) + l2) + l1² (m1 + m2)",
        "M[phi, psi] = m2 l2 (l1 cos(psi) + l2)",
        "M[psi, psi] = m2 l2²",
        "c[phi] = -m2 l1 l2 sin(psi) psi˙ (2 phi˙ + psi˙)",
        "c[psi] = m2 l1 l2 sin(psi) (phi˙)²",
        "g[phi] = g (l1 sin(phi) (m1 + m2) + m2 l2 sin(phi + psi))",
        "g[psi] = m2 l2 g sin(phi + psi)",
    ];
    assert_eq!(found, textbook);
}

/// Names that a letter with an index would make alike, and words that mean something else.
#[test]
fn names_are_told_apart() {
    let model = corpus::model(
        "pub mod alike {
            param l1 = 1.0;
            param l_1 = 2.0;
            param arcsin = 3.0;
            param pi = 0.5;
            param phi = 0.25;
            param φ = 0.125;
            param g_q = 0.75;
            world { gravity: -9.81 * Y }
            body rod { mass: arcsin + pi, com: (l1 + l_1 + phi + φ + g_q) * X }
            joint q: Revolute { parent: ground, child: rod, axis: Z }
            emit forward_dynamics;
        }",
    );
    let structure = mechanics::analysis::analyse(&model).ok().unwrap();
    let page = mechanics::page(&model, &structure).ok().unwrap();
    let lefts = page.sections.iter().flat_map(|section| &section.lines).filter_map(|line| match &line.equation.left {
        Formula::Name(name) => Some(name),
        _ => None,
    });
    let names: BTreeSet<&Identifier> = page.symbols.iter().map(|(name, _)| name).chain(lefts).collect();
    for set in [text::name, latex::name, mathml::name] {
        let looks: BTreeSet<String> = names.iter().map(|name| set(name)).collect();
        assert_eq!(looks.len(), names.len(), "{looks:#?}");
    }
    let sine = names.iter().find(|name| name.text == "arcsin").unwrap();
    assert_eq!((latex::name(sine), mathml::name(sine)), ("\\mathtt{arcsin}".into(), "<mtext>arcsin</mtext>".into()));
}

/// A vector of the user's with the name of a term, whose component is named as a coordinate is.
#[test]
fn letters_of_terms_keep_off_names_of_users() {
    let model = corpus::model(
        "pub mod letters {
            param c: Vec3 = [0.1, 0.2, 0.3];
            param r#g: [Scalar; 2] = [1.0, 2.0];
            world { gravity: -9.81 * Y }
            body block { mass: r#g[0], com: c }
            joint x: Prismatic { parent: ground, child: block, axis: X }
            joint y: Revolute { parent: block, child: arm, axis: Z }
            body arm { mass: r#g[1], com: c }
            emit forward_dynamics;
        }",
    );
    let structure = mechanics::analysis::analyse(&model).ok().unwrap();
    let page = mechanics::page(&model, &structure).ok().unwrap();
    let lefts = page.sections.iter().flat_map(|section| &section.lines).filter_map(|line| match &line.equation.left {
        Formula::Name(name) => Some(text::name(name)),
        _ => None,
    });
    let lefts: Vec<String> = lefts.collect();
    let own: BTreeSet<String> = page.symbols.iter().map(|(name, _)| text::name(name)).collect();
    assert!(own.contains("c[x]") && own.contains("g[1]"), "{own:?}");
    assert!(lefts.contains(&"c_1[x]".to_owned()) && lefts.contains(&"g_1[y]".to_owned()), "{lefts:?}");
    assert!(lefts.iter().all(|left| !own.contains(left)), "{lefts:?}");
    let says: Vec<&String> = page.sections.iter().flat_map(|section| &section.says).collect();
    assert!(says.iter().any(|says| says.ends_with("M a + c_1 + g_1 = Q.")), "{says:?}");
}

/// Equations with what is said of each.
fn said(text: &str) -> Vec<(String, String)> {
    let model = corpus::model(text);
    let structure = mechanics::analysis::analyse(&model).ok().unwrap();
    let page = mechanics::page(&model, &structure).ok().unwrap();
    let lines = page.sections.iter().flat_map(|section| &section.lines);
    lines.map(|line| (text::equation(&line.equation), line.says.clone().unwrap_or_default())).collect()
}

const LEVER: &str = "pub mod lever {
    PARAMS
    formulation { constraints: Reduced }
    body disc { mass: 1.0, com: 0.25 * X, inertia: diag(0.1, 0.1, 0.1) }
    body lever { mass: 2.0, com: 0.35 * Y, inertia: diag(0.1, 0.1, 0.1) }
    joint driver: Revolute { parent: ground, child: disc, axis: Z }
    joint shaft: Revolute { parent: ground.at([1.0, 0.3, 0.2]), child: lever, axis: X }
    constraint link: Rod { between: [disc.at(0.5 * X), lever.at(0.7 * Y)], length: 1.0 }
    solve (shaft) from link { 0.2 * cos(shaft.angle) - (0.3 - 0.5 * sin(driver.angle)) * sin(shaft.angle) > 0.0 }
    OUTPUTS
    emit forward_dynamics;
}";

/// What a closed form is made of has the letter that its equation has in books, and says which equation that is.
#[test]
fn closed_forms_say_what_they_are_made_of() {
    let lines = said(&LEVER.replace("PARAMS", "").replace("OUTPUTS", ""));
    let (equation, says) = &lines[0];
    assert!(equation.starts_with("Delta[shaft] = 0.435 cos(driver) - 0.200525"), "{equation}");
    assert_eq!(says, "A^2 + B^2 - C^2, of A cos x + B sin x = C, where x is `shaft`");
    let says = &lines.iter().find(|line| line.0.starts_with("cos(shaft) = ")).unwrap().1;
    assert!(says.ends_with("; real where `Delta[shaft] >= 0`, with dead centres where it is zero"), "{says}");
}

/// Where a user's vector has the letter, what is said of a line has the other one too.
#[test]
fn letters_are_others_in_what_is_said_of_a_line() {
    let params = "param Delta: Vec3 = [0.1, 0.2, 0.3]; param Delta_1 = 0.5; param A: [Scalar; 2] = [1.0, 2.0];";
    let outputs = "output Q = [Delta_1 * A[0], A[1], 0.0] + Delta;";
    let lines = said(&LEVER.replace("PARAMS", params).replace("OUTPUTS", outputs));
    let (equation, says) = &lines[0];
    assert!(equation.starts_with("Delta_2[shaft] = "), "{equation}");
    assert_eq!(says, "A_1^2 + B^2 - C^2, of A_1 cos x + B sin x = C, where x is `shaft`");
    let says = &lines.iter().find(|line| line.0.starts_with("cos(shaft) = ")).unwrap().1;
    assert!(says.contains("real where `Delta_2[shaft] >= 0`"), "{says}");
    // A vector that is put out is a vector of the user's.
    assert!(lines.iter().any(|line| line.0.starts_with("Q_1[driver] = ")), "{lines:#?}");
    assert!(lines.iter().any(|line| line.0.starts_with("Q[x] = ")), "{lines:#?}");
}

/// Of one root what stands under it, of several none alone, and nothing where another factor may vanish.
#[test]
fn dead_centres_of_several_roots_are_not_those_of_the_first() {
    use multibody_engine::mechanics::written::domains::radicand;
    use multibody_engine::symbolic::graph::{Graph, Scalar};
    let mut g = Graph::default();
    let symbols: Vec<Scalar> = (0..3).map(|_| g.symbol()).collect();
    let [x, y, z] = symbols[..] else { unreachable!() };
    let roots = [x, y].map(|s| g.sqrt(s));
    assert_eq!(radicand(&mut g, roots[0]), Some(x));
    let twice = g.add(roots[0], roots[0]);
    assert_eq!(radicand(&mut g, -twice), Some(x));
    let two = g.mul(roots[0], roots[1]);
    assert_eq!(radicand(&mut g, two), None);
    let scaled = g.mul(z, roots[0]);
    assert_eq!(radicand(&mut g, scaled), None);
    let square = g.mul(z, z);
    assert_eq!(radicand(&mut g, z), Some(square));
}

/// What has no formula is said to be solved for: a system of four unknowns, and a loop that iterates.
#[test]
fn what_is_solved_in_numbers_is_said() {
    let said = |text: &str| -> (String, Vec<String>) {
        let model = corpus::model(text);
        let structure = mechanics::analysis::analyse(&model).ok().unwrap();
        let page = mechanics::page(&model, &structure).ok().unwrap();
        let says: Vec<String> = page.sections.iter().flat_map(|section| section.says.clone()).collect();
        let lines = page.sections.iter().flat_map(|section| &section.lines);
        (says.join(" "), lines.map(|line| text::equation(&line.equation)).collect())
    };
    let (says, _) = said(
        "pub mod system {
            param k = 2.0;
            body arm { mass: 1.0, com: X }
            joint q: Revolute { parent: ground, child: arm, axis: Z }
            solve (a, b, c, d) from [
                k * a + b == q.angle, a - b + c == 1.0, b + 3.0 * c - d == 0.0, a + d * cos(q.angle) == 2.0,
            ];
            output first = a;
            emit forward_dynamics;
        }",
    );
    assert!(says.contains("Solved for, without a formula, by elimination with pivots: `first`."), "{says}");
    let (says, lines) = said(
        "pub mod iterated {
            body crank { mass: 1.0, com: 0.5 * X }
            body coupler { mass: 3.5, com: 1.75 * X }
            body rocker { mass: 3.0, com: 1.5 * X }
            joint theta: Revolute { parent: ground, child: crank, axis: Z }
            joint knee: Revolute { parent: crank.at(X), child: coupler, axis: Z }
            joint psi: Revolute { parent: ground.at(4.0 * X), child: rocker, axis: Z }
            #[cut]
            joint pin: Revolute { parent: coupler.at(3.5 * X), child: rocker.at(3.0 * X), axis: Z }
            formulation { constraints: Reduced, independent: [theta] }
            emit forward_dynamics;
        }",
    );
    assert!(says.contains("Newton's method finds `knee`, `psi`: with them `Phi` of their loops is zero"), "{says}");
    let zeros: Vec<&String> = lines.iter().filter(|line| line.starts_with("Phi[")).collect();
    assert_eq!(
        zeros,
        [
            "Phi[pin.x] = 4 + 3 cos(psi) - 7 cos(theta + knee) / 2 - cos(theta)",
            "Phi[pin.y] = 3 sin(psi) - 7 sin(theta + knee) / 2 - sin(theta)",
        ]
    );
}

/// One name in each of the three ways.
#[test]
fn names() {
    let model = corpus::model(PENDULUM);
    let structure = mechanics::analysis::analyse(&model).ok().unwrap();
    let page = mechanics::page(&model, &structure).ok().unwrap();
    let set: Vec<[String; 3]> =
        page.symbols.iter().map(|(name, _)| [text::name(name), latex::name(name), mathml::name(name)]).collect();
    assert!(
        set.contains(&["m1".into(), "m_{\\mathrm{1}}".into(), "<msub><mi>m</mi><mn>1</mn></msub>".into()]),
        "{set:#?}"
    );
    let delta = multibody_engine::symbolic::write::formula::Identifier {
        text: "Delta".into(),
        index: Some("shaft".into()),
        ..page.symbols[0].0.clone()
    };
    assert_eq!(latex::name(&delta), "\\Delta_{\\mathrm{shaft}}");
    assert_eq!(mathml::name(&delta), "<msub><mi>Δ</mi><mi>shaft</mi></msub>");
    assert!(
        set.contains(&["phi˙".into(), "\\dot{\\phi}".into(), "<mover><mi>φ</mi><mo>˙</mo></mover>".into()]),
        "{set:#?}"
    );
}
