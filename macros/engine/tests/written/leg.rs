//! The three equations of a leg of a Stewart-Gough platform, every dimension a parameter. A symbolic commercial tool has published
//! them with 35 additions, 87 products and 82 sines and cosines, and with 14, 12 and 6 once common subexpressions are taken out;
//! the compiled function takes 9, 8 and 4. What is printed says the same in as many operations, each counted in the text.

use multibody_engine::mechanics;
use multibody_engine::mechanics::written::Subject;
use multibody_engine::symbolic::write::text;

use crate::{corpus, reader};

const LEG: &str = "pub mod one_leg {
    param foot: Vec3 = [-2.12, 1.374, 0.0];
    param heading = -0.75;
    body cylinder { mass: 0.1, com: 0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }
    body piston { mass: 0.1, com: -0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }
    body plate { mass: 1.0, inertia: diag(0.1, 0.1, 0.1), coordinates: Absolute(RollPitchYaw) }
    joint gimbal: Universal { parent: ground.at(foot).rotated(Z, heading), child: cylinder, axes: [X, Y] }
    joint stroke: Prismatic { parent: cylinder.at(1.0 * Z), child: piston, axis: Z }
    #[cut]
    joint ball: Ball { parent: piston, child: plate }
    formulation { constraints: Multipliers }
    emit constraints;
}";

#[test]
fn a_leg_takes_eight_lines_and_seventeen_operations() {
    let model = corpus::model(LEG);
    let structure = mechanics::analysis::analyse(&model).ok().unwrap();
    let page = mechanics::page(&model, &structure).ok().unwrap();
    let section = page.sections.iter().find(|section| section.title == "Constraints").unwrap();
    let is_row = |subject: Subject| matches!(subject, Subject::Constraint(_));
    let last = section.lines.iter().rposition(|line| is_row(line.subject)).unwrap();
    let lines: Vec<String> = section.lines[..=last].iter().map(|line| text::equation(&line.equation)).collect();
    assert_eq!(section.lines.iter().filter(|line| is_row(line.subject)).count(), 3);
    assert!(lines.len() <= 8, "{lines:#?}");
    let counts: Vec<(usize, usize)> = lines.iter().map(|line| reader::equation(line).right.operations()).collect();
    let counted = counts.iter().fold((0, 0), |sum, line| (sum.0 + line.0, sum.1 + line.1));
    assert!(counted.0 <= 9 && counted.1 <= 8, "{counted:?}: {lines:#?}");
}
