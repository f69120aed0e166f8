//! What `emit report` and `emit equations` put into a module.

use crate::corpus;

const CRANE: &str = "pub mod crane {
    param m = 200.0;
    param length = 8.0;
    input drive;
    world { gravity: -9.81 * Y }
    body trolley { mass: 2.0 * m }
    body load { mass: m, com: -length * Y }
    joint rail: Prismatic { parent: ground, child: trolley, axis: X }
    joint theta: Revolute { parent: trolley, child: load, axis: Z }
    force motor: Effort { joint: rail, value: drive }
    output height = load.at(-length * Y).position.y;
    emit forward_dynamics, mass_matrix, bias REQUESTS;
}";

fn module(requests: &str) -> String {
    multibody_engine::expand(CRANE.replace("REQUESTS", requests).parse().unwrap()).to_string()
}

/// Lines of the documentation that stands before the module.
fn documentation(module: &str) -> Vec<String> {
    let head = module.split("pub mod crane").next().unwrap();
    let file: syn::File = syn::parse_str(&format!("{head} mod m {{}}")).unwrap();
    // What editors follow stands before it.
    let Some(syn::Item::Mod(item)) = file.items.last() else { panic!("no module") };
    item.attrs
        .iter()
        .filter_map(|attr| match &attr.meta {
            syn::Meta::NameValue(pair) => match &pair.value {
                syn::Expr::Lit(syn::ExprLit { lit: syn::Lit::Str(text), .. }) => Some(text.value().trim().to_owned()),
                _ => None,
            },
            _ => None,
        })
        .collect()
}

/// Every tag is closed in its order.
pub(crate) fn is_balanced(html: &str) -> bool {
    let mut open: Vec<&str> = Vec::new();
    for tag in html.split('<').skip(1).filter_map(|rest| rest.split('>').next()) {
        match tag.strip_prefix('/') {
            Some(name) if open.pop() == Some(name) => {}
            Some(_) => return false,
            None => open.push(tag.split(' ').next().unwrap()),
        }
    }
    open.is_empty()
}

#[test]
fn the_page_has_equations_that_markdown_leaves_alone() {
    let lines = documentation(&module(", report"));
    let start = lines.iter().position(|line| line == "### Equations of motion").expect("a section");
    let block: Vec<&String> = lines[start..].iter().skip_while(|line| !line.starts_with("<div")).collect();
    let end = block.iter().position(|line| line.ends_with("</div>")).expect("its end");
    assert!(block[..=end].iter().all(|line| !line.is_empty()), "an empty line ends the block of HTML: {block:#?}");
    let html: String = block[..=end].iter().map(|line| line.as_str()).collect();
    assert!(is_balanced(&html), "{html}");
    assert!(!html.contains(['*', '_', '`']), "{html}");
    assert_eq!(html.matches("<math").count(), 2);
}

#[test]
fn functions_have_what_they_compute() {
    let module = module(", report");
    for line in ["M[rail, rail] = 3 m", "M[rail, theta] = m length cos(theta)", "height = -length cos(theta)"] {
        assert!(module.contains(line), "{line}");
    }
}

#[test]
fn constants_are_there_when_asked_for() {
    let with = module(", equations");
    assert!(
        with.contains("FORMULAS") && with.contains("section : \"Outputs\" , text : \"height = -length cos(theta)\"")
    );
    assert!(!with.contains("<math"));
    let without = module("");
    assert!(!without.contains("FORMULAS") && !without.contains("<math"));
}

/// Names of constraint equations are a constant of their own.
#[test]
fn constants_of_a_model_with_multipliers_have_names_of_their_own() {
    let text = "pub mod ring {
        body bead { mass: 1.0, coordinates: Absolute(RollPitchYaw) }
        body other { mass: 1.0, inertia: diag(1.0, 1.0, 1.0) }
        joint hinge: Revolute { parent: ground, child: other, axis: Z }
        joint slide: Revolute { parent: ground, child: bead.at(-X), axis: Z }
        formulation { constraints: Multipliers }
        emit forward_dynamics, equations;
    }";
    let file: syn::File = syn::parse_str(&multibody_engine::expand(text.parse().unwrap()).to_string()).unwrap();
    let module = file.items.iter().find_map(|item| match item {
        syn::Item::Mod(module) if module.ident == "ring" => module.content.as_ref(),
        _ => None,
    });
    let constants = module.unwrap().1.iter().filter_map(|item| match item {
        syn::Item::Const(constant) => Some(constant.ident.to_string()),
        _ => None,
    });
    let mut constants: Vec<String> = constants.filter(|name| name != "_").collect();
    constants.sort();
    assert!(["EQUATIONS", "FORMULAS"].iter().all(|name| constants.iter().any(|own| own == name)), "{constants:?}");
    let all = constants.len();
    constants.dedup();
    assert_eq!(constants.len(), all, "{constants:?}");
}

/// Whatever reads the constant beside a mistake has it.
#[test]
fn beside_errors_the_name_is_there() {
    let text = CRANE.replace("REQUESTS", ", equations").replace("mass: 2.0 * m", "mass: 2.0 * n");
    let module = multibody_engine::expand(text.parse().unwrap()).to_string();
    assert!(module.contains("compile_error") && module.contains("FORMULAS"));
}

/// Only what is asked for is derived.
#[test]
fn pages_are_made_when_asked_for() {
    let page = |requests: &str| {
        let model = corpus::model(&CRANE.replace("REQUESTS", requests));
        multibody_engine::compile(&model).ok().unwrap().0.page.is_some()
    };
    assert!(!page("") && page(", report") && page(", equations"));
}

/// What is found together reads each other, and stands before what reads it all the same.
#[test]
fn a_coupling_stands_behind_what_is_found_together() {
    let module = multibody_engine::expand(GEARED_DELTA.parse().unwrap()).to_string();
    let [place, coupled] =
        ["\"z = ", "\"w = 2 z\""].map(|line| module.find(line).unwrap_or_else(|| panic!("no {line}")));
    assert!(place < coupled);
}

const GEARED_DELTA: &str = "pub mod geared_delta {
        body along { mass: 0.2 } body across { mass: 0.3 } body arm { mass: 1.0, com: 0.1*X, inertia: diag(0.1,0.1,0.1) }
        body plate { mass: 2.5 } body cpl { mass: 0.2 }
        joint d: Revolute { parent: ground, child: arm, axis: Z }
        joint x: Prismatic { parent: ground, child: along, axis: X }
        joint y: Prismatic { parent: along, child: across, axis: Y }
        joint z: Prismatic { parent: across, child: plate, axis: Z }
        joint w: Prismatic { parent: ground, child: cpl, axis: X }
        constraint gear = w.travel - 2.0 * z.travel;
        constraint first: Rod { between: [arm.at(0.3 * X), plate], length: 0.8 }
        constraint second: Rod { between: [ground.at([-0.2, 0.3, 0.1]), plate], length: 0.79 }
        constraint third: Rod { between: [ground.at([-0.2, -0.28, 0.0]), plate], length: 0.81 }
        assume cos(d) > 0.5;
        solve (x, y, z) from (first, second, third) { z < 0.0 }
        formulation { constraints: Reduced }
        emit equations;
    }";

/// An equation of velocities stands where its value is given: with the rates of those of positions.
#[test]
fn equations_of_velocities_stand_with_rates() {
    let text = "pub mod sled {
        body sled { mass: 1.0, inertia: diag(1.0, 1.0, 1.0) }
        joint plane: Planar { parent: ground, child: sled, axis: Z }
        constraint rail = plane.y - sin(plane.x);
        constraint blade = sled.express(sled.velocity).y;
        emit forward_dynamics, constraints, report;
    }";
    let module = multibody_engine::commented(text.parse().unwrap()).to_string();
    let before = |name: &str| {
        let end = module.find(&format!("pub fn {name} (")).unwrap_or_else(|| panic!("no {name}"));
        let start = module[..end].rfind("pub fn ").map_or(0, |at| at);
        module[start..end].to_owned()
    };
    let (gaps, rates) = (before("constraints"), before("constraint_rate"));
    assert!(gaps.contains("Phi[rail]") && !gaps.contains("Phi[blade]"), "{gaps}");
    assert!(rates.contains("Phi[blade]") && !rates.contains("Phi[rail]"), "{rates}");
}
