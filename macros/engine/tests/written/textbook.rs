//! Equations of four mechanisms as textbooks have them, beside those that are printed: the same in numbers at random states, and none
//! longer, counted in names, numbers and functions, and in operations.
//!
//! A book's form is typed here in the book's steps and in the names of the model. What a book defines on the way (a radius, a
//! ratio) counts as a line of its own, as it does here.

use std::collections::HashMap;
use std::f64::consts::TAU;

use multibody_engine::mechanics;
use multibody_engine::mechanics::written::{Page, Subject};
use multibody_engine::symbolic::write::formula::{Class, Equation, Formula, Identifier};
use multibody_engine::symbolic::write::text;

use crate::corpus;
use crate::pages::Random;
use crate::reader::{self, named};
use crate::values::{Known, value};

/// States at which a book and a page are compared.
const STATES: usize = 20;
/// Of one and the value.
const TOLERANCE: f64 = 1e-12;

/// Names, numbers and functions, and operations.
fn size(formula: &Formula) -> (usize, usize) {
    fn symbols(formula: &Formula) -> usize {
        let mut count = match formula {
            Formula::Number(_) | Formula::Pi | Formula::Name(_) | Formula::Apply(..) | Formula::Root(_) => 1,
            _ => 0,
        };
        formula.each_part(&mut |part| count += symbols(part));
        count
    }
    let (sums, products) = formula.operations();
    (symbols(formula), sums + products)
}

fn size_of(lines: &[Equation]) -> (usize, usize) {
    let sides = lines.iter().flat_map(|line| [&line.left, &line.right]);
    sides.map(size).fold((0, 0), |sum, one| (sum.0 + one.0, sum.1 + one.1))
}

/// The value of a left side as lines go on: a name that is given, or a cosine and a sine that give an angle.
fn take(known: &mut Known, cosines: &mut HashMap<String, f64>, line: &Equation) {
    let right = value(&line.right, known);
    match &line.left {
        Formula::Name(name) => drop(known.insert(name.clone(), right)),
        Formula::Apply(function, angle) => {
            let key = format!("{angle:?}");
            match (function.word(), &angle[..]) {
                ("cos", _) => drop(cosines.insert(key, right)),
                ("sin", [Formula::Name(angle)]) => drop(known.insert(angle.clone(), right.atan2(cosines[&key]))),
                other => panic!("{other:?}"),
            }
        }
        other => panic!("{other:?} on the left"),
    }
}

struct Compared {
    page: Page,
    lines: Vec<(Subject, Equation)>,
}

/// What a book has.
struct Book<'t> {
    /// Its lines, each after those that it reads; an equation of motion has a sum on the left.
    lines: &'t [&'t str],
    /// What its names are in ours; the book has no such lines.
    translated: &'t [&'t str],
    /// Left sides of the page that say the same, with nothing for equations of motion.
    ours: &'t [&'t str],
}

impl Compared {
    fn new(model: &str) -> Compared {
        let model = corpus::model(model);
        let structure = mechanics::analysis::analyse(&model).ok().unwrap();
        let page = mechanics::page(&model, &structure).ok().unwrap();
        let lines = page.sections.iter().flat_map(|section| &section.lines);
        // As printed, and read again.
        let lines = lines.map(|line| (line.subject, reader::equation(&text::equation(&line.equation)))).collect();
        Compared { page, lines }
    }

    /// Symbols with what they are at a state: parameters near lengths at which a four-bar closes for every angle of its crank.
    fn state(&self, random: &mut Random) -> Known {
        let mut known = Known::new();
        for (name, _) in &self.page.symbols {
            let text = text::name(name);
            let given = match text.as_str() {
                "d" => 4.0,
                "b" => 3.5,
                "c" | "l" => 3.0,
                _ => 1.0,
            };
            let x = if name.class == Class::Parameter { given * (1.0 + 0.1 * random.unit()) } else { random.unit() };
            known.insert(named(&text), x);
        }
        known
    }

    /// Lines with these left sides, and the definitions that they read. Which sign a root has a book leaves to the reader; here it is
    /// a line, `branch`, which is not counted.
    fn with_definitions(&self, lefts: &[&str]) -> Vec<Equation> {
        let mut taken: Vec<bool> = self
            .lines
            .iter()
            .map(|(subject, line)| match subject {
                Subject::Motion(_) => lefts.is_empty(),
                _ => lefts.contains(&text::formula(&line.left).as_str()),
            })
            .collect();
        assert!(lefts.is_empty() || taken.iter().filter(|taken| **taken).count() == lefts.len(), "{lefts:?}");
        for at in (0..taken.len()).rev() {
            let (subject, line) = &self.lines[at];
            let Formula::Name(name) = &line.left else { continue };
            let readers = (at + 1..taken.len()).filter(|&reader| taken[reader]);
            if *subject == Subject::Definition && name.text != "branch" {
                taken[at] |= readers.into_iter().any(|reader| reads(&self.lines[reader].1.right, name));
            }
        }
        self.lines.iter().zip(taken).filter(|entry| entry.1).map(|entry| entry.0.1.clone()).collect()
    }

    /// What has the same left side has the same value, an equation of motion is worth the same, and the page takes no more symbols
    /// and operations.
    fn with(&self, book: &Book<'_>) {
        let own = self.with_definitions(book.ours);
        let parsed = |lines: &[&str]| -> Vec<Equation> { lines.iter().map(|line| reader::equation(line)).collect() };
        let (lines, translated) = (parsed(book.lines), parsed(book.translated));
        let (here, there) = (size_of(&own), size_of(&lines));
        println!("{here:?} symbols and operations here, {there:?} in the book");
        assert!(here.0 <= there.0 && here.1 <= there.1, "{here:?} here, {there:?} in the book:\n{}", shown(&own));
        let mut random = Random(5);
        for _ in 0..STATES {
            let given = self.state(&mut random);
            let (mut known, mut cosines) = (given.clone(), HashMap::new());
            let mut angles = Vec::new();
            for (subject, line) in self.lines.iter().filter(|line| !matches!(line.0, Subject::Motion(_))) {
                take(&mut known, &mut cosines, line);
                if let (Subject::Sine(_), Formula::Apply(_, angle)) = (subject, &line.left)
                    && let [Formula::Name(angle)] = &angle[..]
                {
                    angles.push(angle.clone());
                }
            }
            let mut rows = self.lines.iter().filter(|line| matches!(line.0, Subject::Motion(_))).map(|line| &line.1);
            // The book has what follows from its own lines alone.
            let mut told = given.clone();
            for angle in &angles {
                told.remove(angle);
            }
            let mut compared = 0;
            for line in lines.iter().chain(&translated) {
                let Formula::Name(name) = &line.left else {
                    let ours = rows.next().expect("an equation of motion");
                    let gap = |line: &Equation, known: &Known| value(&line.left, known) - value(&line.right, known);
                    same(gap(ours, &known), gap(line, &told), line);
                    compared += 1;
                    continue;
                };
                let right = value(&line.right, &told);
                told.insert(name.clone(), right);
                if let Some(&ours) = known.get(name) {
                    // An angle and the same some turns away are one.
                    let turns = if angles.contains(name) { ((ours - right) / TAU).round() * TAU } else { 0.0 };
                    same(ours - turns, right, line);
                    compared += 1;
                }
            }
            assert!(compared >= book.ours.len().min(1), "nothing is compared");
        }
    }
}

fn reads(formula: &Formula, name: &Identifier) -> bool {
    let mut found = matches!(formula, Formula::Name(own) if own == name);
    formula.each_part(&mut |part| found |= reads(part, name));
    found
}

fn shown(lines: &[Equation]) -> String {
    let lines: Vec<String> = lines.iter().map(text::equation).collect();
    lines.join("\n")
}

fn same(ours: f64, book: f64, line: &Equation) {
    let scale = 1.0 + book.abs();
    let error = (ours - book).abs() / scale;
    assert!(error <= TOLERANCE, "{ours} here, {book} in the book: {}", text::equation(line));
}

/// Two point masses on massless rods, the second angle relative to the first: the two-link arm of Craig, Introduction to Robotics,
/// chapter 6, "an example of closed-form dynamic equations", with angles from the vertical.
///
/// | | book | printed |
/// |---|---|---|
/// | `M[phi, phi]` | `l2² m2 + 2 l1 l2 m2 cos(psi) + l1² (m1 + m2)` | `m2 l2 (2 l1 cos(psi) + l2) + l1² (m1 + m2)` |
/// | `M[phi, psi]` | `l2² m2 + l1 l2 m2 cos(psi)` | `m2 l2 (l1 cos(psi) + l2)` |
/// | `M[psi, psi]` | `l2² m2` | `m2 l2²` |
/// | `c[phi]` | `-m2 l1 l2 sin(psi) psi˙² - 2 m2 l1 l2 sin(psi) phi˙ psi˙` | `-m2 l1 l2 sin(psi) psi˙ (2 phi˙ + psi˙)` |
/// | `c[psi]` | `m2 l1 l2 sin(psi) phi˙²` | `m2 l1 l2 sin(psi) phi˙²` |
/// | `g[phi]` | `m2 l2 g sin(phi + psi) + (m1 + m2) l1 g sin(phi)` | `g (l1 sin(phi) (m1 + m2) + m2 l2 sin(phi + psi))` |
/// | `g[psi]` | `m2 l2 g sin(phi + psi)` | `m2 l2 g sin(phi + psi)` |
#[test]
fn double_pendulum() {
    let compared = Compared::new(
        "pub mod pendulum {
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
        }",
    );
    let book = [
        "M[phi, phi] = l2² m2 + 2 l1 l2 m2 cos(psi) + l1² (m1 + m2)",
        "M[phi, psi] = l2² m2 + l1 l2 m2 cos(psi)",
        "M[psi, psi] = l2² m2",
        "c[phi] = -m2 l1 l2 sin(psi) (psi˙)² - 2 m2 l1 l2 sin(psi) phi˙ psi˙",
        "c[psi] = m2 l1 l2 sin(psi) (phi˙)²",
        "g[phi] = m2 l2 g sin(phi + psi) + (m1 + m2) l1 g sin(phi)",
        "g[psi] = m2 l2 g sin(phi + psi)",
    ];
    let ours: Vec<&str> = book.iter().map(|line| line.split(" = ").next().unwrap()).collect();
    compared.with(&Book { lines: &book, translated: &[], ours: &ours });
}

/// A cart with an inverted pendulum: the balance system of Åström and Murray, Feedback Systems, chapter 2, with its friction.
///
/// The book:
///
/// ```text
/// (M + m) p¨ - m l cos(theta) theta¨ + c p˙ + m l sin(theta) theta˙² = F
/// -m l cos(theta) p¨ + (J + m l²) theta¨ + gamma theta˙ - m g l sin(theta) = 0
/// ```
///
/// Printed, with what is declared as a force on the right:
///
/// ```text
/// p¨ (M + m) - m l cos(theta) theta¨ + m l sin(theta) (theta˙)² = F - c p˙
/// -m l cos(theta) p¨ + theta¨ (m l² + J) - m l g sin(theta) = -gamma theta˙
/// ```
#[test]
fn cart_pole() {
    let compared = Compared::new(
        "pub mod cart {
            param M = 1.0;
            param m = 0.2;
            param l = 0.6;
            param J = 0.01;
            param g = 9.81;
            param c = 0.1;
            param gamma = 0.01;
            input F;
            world { gravity: -g * Y }
            body carriage { mass: M }
            body pole { mass: m, com: l * Y, inertia: diag(J, J, J) }
            joint p: Prismatic { parent: ground, child: carriage, axis: X }
            joint theta: Revolute { parent: carriage, child: pole, axis: Z }
            force motor: Effort { joint: p, value: F }
            force rail: Damper { joint: p, damping: c }
            force hinge: Damper { joint: theta, damping: gamma }
            emit forward_dynamics;
        }",
    );
    let book = [
        "(M + m) p¨ - m l cos(theta) theta¨ + c p˙ + m l sin(theta) (theta˙)² = F",
        "-m l cos(theta) p¨ + (J + m l²) theta¨ + gamma theta˙ - m g l sin(theta) = 0",
    ];
    compared.with(&Book { lines: &book, translated: &[], ours: &[] });
}

/// A crank, a rod and a piston in line with it: position, velocity and acceleration at a constant speed of the crank in Norton, Design
/// of Machinery, chapter 13, and Shigley and Uicker, Theory of Machines and Mechanisms, chapter on engines.
///
/// The book:
///
/// ```text
/// x = r cos(theta) + sqrt(l² - r² sin(theta)²)
/// x˙ = -r theta˙ (sin(theta) + r sin(2 theta) / (2 sqrt(l² - r² sin(theta)²)))
/// x¨ = -r theta˙² (cos(theta) - r (l² (1 - 2 cos(theta)²) - r² sin(theta)⁴) / (l² - r² sin(theta)²)^(3/2))
/// ```
///
/// Printed, with a root that the three share and the sign that the book chooses by hand:
///
/// ```text
/// u_1 = branch sqrt(l² - r² sin(theta)²)
/// x = r cos(theta) + u_1
/// S[x, theta] = -r x sin(theta) / u_1
/// x˙ = S[x, theta] theta˙
/// gamma[x] = -(r theta˙ (x cos(theta) theta˙ + 2 sin(theta) x˙) + (x˙)²) / u_1
/// ```
#[test]
fn slider_crank() {
    let compared = Compared::new(
        "pub mod slider {
            param r = 1.0;
            param l = 3.0;
            body crank { mass: 2.0, inertia: diag(0.01, 0.01, 0.01) }
            body rod { mass: 0.3, com: 0.5 * l * X, inertia: rod(0.3, l, X) }
            body piston { mass: 0.4 }
            joint theta: Revolute { parent: ground, child: crank, axis: Z }
            joint phi: Revolute { parent: crank.at(r * X), child: rod, axis: Z }
            joint x: Prismatic { parent: ground, child: piston, axis: X }
            #[cut]
            joint pin: Revolute { parent: rod.at(l * X), child: piston, axis: Z }
            formulation { constraints: Reduced }
            solve (phi, x) from pin { x > 0.0 }
            emit forward_dynamics;
        }",
    );
    let lines = [
        "x = r cos(theta) + sqrt(l² - r² sin(theta)²)",
        "x˙ = -r theta˙ (sin(theta) + r sin(2 theta) / (2 sqrt(l² - r² sin(theta)²)))",
        "gamma[x] = -r (theta˙)² (cos(theta) - r (l² (1 - 2 cos(theta)²) - r² sin(theta)⁴) / sqrt(l² - r² sin(theta)²)³)",
    ];
    compared.with(&Book { lines: &lines, translated: &[], ours: &["x", "S[x, theta]", "x˙", "gamma[x]"] });
}

/// A four-bar linkage: positions and velocities in Norton, Design of Machinery, chapters 4 and 6, where `T` is the coupler's angle from
/// the ground, here `theta + knee`.
///
/// The book:
///
/// ```text
/// K1 = d / a    K2 = d / c    K3 = (a² - b² + c² + d²) / (2 a c)    K4 = d / b    K5 = (c² - d² - a² - b²) / (2 a b)
/// A = cos(theta) - K1 - K2 cos(theta) + K3    B = -2 sin(theta)    C = K1 - (K2 + 1) cos(theta) + K3
/// D = cos(theta) - K1 + K4 cos(theta) + K5    E = -2 sin(theta)    F = K1 + (K4 - 1) cos(theta) + K5
/// psi = 2 arctan((-B - sqrt(B² - 4 A C)) / (2 A))    T = 2 arctan((-E - sqrt(E² - 4 D F)) / (2 D))
/// T˙ = a theta˙ sin(psi - theta) / (b sin(T - psi))    psi˙ = a theta˙ sin(theta - T) / (c sin(psi - T))
/// ```
///
/// Printed, without an arc tangent:
///
/// ```text
/// u_7 = 2 a d cos(theta)
/// knee_c = -(a² + b² + d² - u_7 - c²) / 2
/// u_8 = b² (a² + d² - u_7)
/// knee_discriminant = u_8 - knee_c²
/// cos(knee) = b (a knee_c + d branch sqrt(knee_discriminant) sin(theta) - d knee_c cos(theta)) / u_8
/// sin(knee) = b (d knee_c sin(theta) - branch sqrt(knee_discriminant) (a - d cos(theta))) / u_8
/// cos(psi) = (a cos(theta) + b cos(theta + knee) - d) / c
/// u_10 = a sin(theta) + b sin(theta + knee)
/// sin(psi) = u_10 / c
/// S[knee, theta] = -d u_10 / (branch sqrt(knee_discriminant))
/// S[psi, theta] = (b cos(theta + knee - psi) (1 + S[knee, theta]) + a cos(theta - psi)) / c
/// knee˙ = S[knee, theta] theta˙
/// psi˙ = S[psi, theta] theta˙
/// ```
#[test]
fn four_bar() {
    let compared = Compared::new(
        "pub mod four_bar {
            param a = 1.0;
            param b = 3.5;
            param c = 3.0;
            param d = 4.0;
            body crank { mass: 1.0, com: 0.5 * a * X, inertia: rod(1.0, a, X) }
            body coupler { mass: 3.5, com: 0.5 * b * X, inertia: rod(3.5, b, X) }
            body rocker { mass: 3.0, com: 0.5 * c * X, inertia: rod(3.0, c, X) }
            joint theta: Revolute { parent: ground, child: crank, axis: Z }
            joint knee: Revolute { parent: crank.at(a * X), child: coupler, axis: Z }
            joint psi: Revolute { parent: ground.at(d * X), child: rocker, axis: Z }
            #[cut]
            joint pin: Revolute { parent: coupler.at(b * X), child: rocker.at(c * X), axis: Z }
            formulation { constraints: Reduced }
            solve (knee, psi) from pin { sin(psi - theta - knee) > 0.0 }
            emit forward_dynamics;
        }",
    );
    let lines = [
        "K1 = d / a",
        "K2 = d / c",
        "K3 = (a² - b² + c² + d²) / (2 a c)",
        "K4 = d / b",
        "K5 = (c² - d² - a² - b²) / (2 a b)",
        "A = cos(theta) - K1 - K2 cos(theta) + K3",
        "B = -2 sin(theta)",
        "C = K1 - (K2 + 1) cos(theta) + K3",
        "D = cos(theta) - K1 + K4 cos(theta) + K5",
        "E = -2 sin(theta)",
        "F = K1 + (K4 - 1) cos(theta) + K5",
        "psi = 2 arctan((-B - sqrt(B² - 4 A C)) / (2 A))",
        "T = 2 arctan((-E - sqrt(E² - 4 D F)) / (2 D))",
        "T˙ = a theta˙ sin(psi - theta) / (b sin(T - psi))",
        "psi˙ = a theta˙ sin(theta - T) / (c sin(psi - T))",
    ];
    let translated = ["knee = T - theta", "knee˙ = T˙ - theta˙"];
    let ours = ["cos(knee)", "sin(knee)", "cos(psi)", "sin(psi)", "S[knee, theta]", "S[psi, theta]", "knee˙", "psi˙"];
    compared.with(&Book { lines: &lines, translated: &translated, ours: &ours });
}
