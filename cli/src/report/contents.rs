//! What a report says of a model, section by section.

use multibody_engine::emit::{self, Declared, Facts, Form, Shown};
use multibody_engine::mechanics::written;
use multibody_engine::optimize::program::{Function, Rival};
use multibody_engine::symbolic::write::{latex, text};

use super::Material;
use super::document::{Block, Document, Line, Section, Table};
use super::graph::Graph;
use super::scene::Scene;
use super::{drawing, matrix};
use crate::commands::counts::{KINDS, numbers};

/// A graph of more nodes is folded, and so are a matrix of more rows and a table of more rows.
const MOST_NODES: usize = 90;
const MOST_ROWS: usize = 40;

pub(super) fn document(material: &Material<'_>) -> Document {
    let sections = [
        mechanism(material),
        in_space(material),
        parameters(material),
        bodies(material),
        loops(material),
        matrices(material),
        costs(material),
        equations(material),
        remarks(material),
    ];
    Document {
        title: material.name(),
        lead: lead(material),
        sections: sections.into_iter().flatten().collect(),
        colophon: format!("`cargo multibody report {}`, version {}", material.file, env!("CARGO_PKG_VERSION")),
    }
}

fn section(title: &'static str, blocks: Vec<Block>) -> Option<Section> {
    (!blocks.is_empty()).then_some(Section { title, blocks })
}

/// The user's text, and sizes.
fn lead(material: &Material<'_>) -> Vec<String> {
    let (model, structure, facts) = (material.model, material.structure, &material.facts);
    let mut lead: Vec<String> = facts
        .text
        .split(|line| line.trim().is_empty())
        .map(|paragraph| paragraph.join(" "))
        .filter(|paragraph| !paragraph.is_empty())
        .collect();
    let counted = |count: usize, one: &str, many: &str| format!("{count} {}", if count == 1 { one } else { many });
    let mut sizes = vec![
        counted(model.bodies.len(), "body", "bodies"),
        counted(model.joints.len(), "joint", "joints"),
        counted(structure.state.len(), "velocity coordinate", "velocity coordinates"),
    ];
    if !facts.closings.is_empty() {
        sizes.push(counted(facts.closings.len(), "loop closure", "loop closures"));
        sizes.push(counted(structure.rows.len(), "equation with a multiplier", "equations with multipliers"));
    }
    if !model.states.is_empty() {
        sizes.push(counted(model.states.len(), "state of its own", "states of its own"));
    }
    lead.push(format!("{}.", sizes.join(", ")));
    lead
}

fn mechanism(material: &Material<'_>) -> Option<Section> {
    let graph = Graph::new(material.model, material.structure, &material.facts);
    let figure = Block::Figure(graph.figure(material.model));
    let block = match graph.len() > MOST_NODES {
        true => Block::Folded(format!("the graph of {} bodies and joints", graph.len() - 1), vec![figure]),
        false => figure,
    };
    let mut blocks = vec![block];
    if !material.facts.repeated.is_empty() {
        blocks.push(Block::Words("What stands in it several times, identical up to parameters:".to_owned()));
        blocks.push(Block::List(material.facts.repeated.clone()));
    }
    section("Mechanism", blocks)
}

fn in_space(material: &Material<'_>) -> Option<Section> {
    let scene = Scene::new(material.model, material.structure, &material.facts);
    let table = Block::Table(drawing::table(&scene));
    let blocks = vec![
        Block::Figure(drawing::figure(&material.name(), &scene)),
        Block::Folded("Where frames and joints stand".to_owned(), vec![table]),
    ];
    section("Default position", blocks)
}

/// Rows that are alike for all elements of an array stand once.
fn alike(mut table: Table) -> Table {
    const BETWEEN: &str = "\u{1f}";
    let lines = table.rows.iter().map(|row| row.join(BETWEEN)).collect();
    let lines = emit::alike(lines);
    table.rows = lines.iter().map(|line| line.split(BETWEEN).map(str::to_owned).collect()).collect();
    table.without_empty_columns()
}

/// A table under a heading, folded where it is long.
fn listed(blocks: &mut Vec<Block>, heading: &str, table: Table) {
    let table = alike(table);
    if table.rows.is_empty() {
        return;
    }
    blocks.push(Block::Heading(heading.to_owned()));
    let rows = table.rows.len();
    let table = Block::Table(table);
    blocks.push(if rows > MOST_ROWS { Block::Folded(format!("{rows} rows"), vec![table]) } else { table });
}

fn code(text: &str) -> String {
    if text.is_empty() { String::new() } else { format!("`{}`", text.replace('`', "'")) }
}

fn declared(heads: [&str; 4], list: &[Declared], value: fn(&str) -> String) -> Table {
    let mut table = Table::new(heads, 4);
    let unit = |one: &Declared| one.unit.as_deref().map_or_else(String::new, code);
    table.rows.extend(list.iter().map(|one| vec![code(&one.name), unit(one), value(&one.value), one.text.clone()]));
    table
}

fn parameters(material: &Material<'_>) -> Option<Section> {
    let facts = &material.facts;
    let mut blocks = Vec::new();
    listed(&mut blocks, "Parameters", declared(["parameter", "unit", "default", ""], &facts.params, code));
    let unused = &material.unused.params;
    if !unused.is_empty() {
        blocks.push(Block::Words(
            "Unused parameters: no generated function reads them, or they cancel in all of them.".to_owned(),
        ));
        blocks.push(Block::List(emit::alike(unused.clone())));
    }
    listed(&mut blocks, "Inputs", declared(["input", "unit", "type", ""], &facts.inputs, str::to_owned));
    let unused = &material.unused.inputs;
    if !unused.is_empty() {
        blocks.push(Block::Words(format!("No function reads the inputs {}.", emit::alike(unused.clone()).join(", "))));
    }
    listed(&mut blocks, "States", declared(["state", "unit", "start", ""], &facts.states, code));
    listed(&mut blocks, "Outputs", declared(["output", "unit", "type", ""], &facts.outputs, str::to_owned));
    section("Parameters, inputs, outputs", blocks)
}

fn frame(body: Option<&String>) -> String {
    body.map_or_else(|| "ground".to_owned(), |name| code(name))
}

fn bodies(material: &Material<'_>) -> Option<Section> {
    let facts = &material.facts;
    let mut blocks = Vec::new();
    let mut table = Table::new(["body", "inertia", "mass [kg]", ""], 4);
    table.rows.extend(
        facts
            .bodies
            .iter()
            .map(|body| vec![code(&body.name), body.inertia.to_owned(), code(&body.mass), body.text.clone()]),
    );
    listed(&mut blocks, "Bodies", table);
    let mut table = Table::new(["joint", "kind", "parent", "child", "freedoms", ""], 6);
    table.rows.extend(facts.joints.iter().map(|joint| {
        let freedoms = if joint.closes { "closes a loop".to_owned() } else { joint.freedoms.clone() };
        let [parent, child] = [&joint.parent, &joint.child].map(|body| frame(body.as_ref()));
        vec![code(&joint.name), joint.kind.to_owned(), parent, child, freedoms, joint.text.clone()]
    }));
    listed(&mut blocks, "Joints", table);
    let mut table = Table::new(["force", "kind", "on", ""], 4);
    table.rows.extend(
        facts
            .forces
            .iter()
            .map(|force| vec![code(&force.name), force.kind.to_owned(), force.on.clone(), force.text.clone()]),
    );
    listed(&mut blocks, "Forces", table);
    section("Bodies, joints, forces", blocks)
}

fn loops(material: &Material<'_>) -> Option<Section> {
    let facts = &material.facts;
    let mut blocks = Vec::new();
    let mut table = Table::new(["closed by", "kind", "between", "and", "equations", ""], 6);
    table.rows.extend(facts.closings.iter().map(|closing| {
        let [a, b] = closing.between.each_ref().map(|body| match body {
            Some(name) if name.is_empty() => String::new(),
            body => frame(body.as_ref()),
        });
        vec![code(&closing.name), closing.kind.to_owned(), a, b, closing.equations.clone(), closing.text.clone()]
    }));
    let table = alike(table);
    if !table.rows.is_empty() {
        blocks.push(Block::Table(table));
    }
    if !facts.loops.is_empty() {
        blocks.push(Block::Heading("What was solved, driven, left out and assumed".to_owned()));
        blocks.push(Block::List(facts.loops.clone()));
    }
    section("Loops and drives", blocks)
}

fn matrices(material: &Material<'_>) -> Option<Section> {
    let (patterns, facts) = (&material.patterns, &material.facts);
    let mut blocks = Vec::new();
    let mut add = |heading: &str, entries: &[multibody_engine::mechanics::Entry], rows: &[String]| {
        if entries.is_empty() {
            return;
        }
        blocks.push(Block::Heading(heading.to_owned()));
        let title = format!("{heading} of {}", material.name());
        let figure = Block::Figure(matrix::figure(&title, entries, rows, &facts.coordinates));
        let summary = format!("{} rows", rows.len());
        blocks.push(if rows.len() > MOST_ROWS { Block::Folded(summary, vec![figure]) } else { figure });
    };
    add("Mass matrix", &patterns.mass, &facts.coordinates);
    add("Constraint Jacobian", &patterns.jacobian, &facts.equations);
    section("Structure of matrices", blocks)
}

fn costs(material: &Material<'_>) -> Option<Section> {
    let compiled = material.compiled;
    let name = |function: &Function| code(&emit::function_name(material.model, function.kind));
    let told: Vec<&Function> = material.facts.functions.iter().map(|&number| &compiled.functions[number]).collect();
    let heads = ["function"].into_iter().chain(KINDS).chain(["work"]).chain(KINDS).chain(["work", "of derived"]);
    let mut table = Table::new(heads, 1);
    table.titles = vec![(1, ""), (7, "as derived"), (7, "as emitted"), (1, "")];
    let cells = |cost| numbers(&cost).map(|n| n.to_string());
    let prelude = compiled.prelude_cost;
    let new = ["`new`".to_owned()].into_iter().chain([const { String::new() }; 7]).chain(cells(prelude));
    table.rows.push(new.chain([prelude.weight().to_string(), String::new()]).collect());
    let at = compiled.at.as_ref();
    if let Some(at) = at {
        let own = ["`at`".to_owned()].into_iter().chain([const { String::new() }; 7]).chain(cells(at.cost));
        table.rows.push(own.chain([at.cost.weight().to_string(), String::new()]).collect());
    }
    let of_at = at.iter().flat_map(|at| &at.functions).map(|f| (format!("`at` {}", name(f)), f));
    for (name, function) in told.iter().map(|f| (name(f), *f)).chain(of_at) {
        let (before, after) = (function.before, function.after);
        let left = match before.weight() {
            0 => String::new(),
            weight => format!("{:.0} %", 100.0 * f64::from(after.weight()) / f64::from(weight)),
        };
        let row = [name].into_iter().chain(cells(before)).chain([before.weight().to_string()]);
        table.rows.push(row.chain(cells(after)).chain([after.weight().to_string(), left]).collect());
    }
    let mut says =
        "Work counts additions, products, selections and comparisons as 1, quotients and roots as 8, sines with their \
                    cosines and other functions as 20. What parameters alone decide is done once, in `new`."
            .to_owned();
    if at.is_some() {
        says.push_str(" What a position decides is done once for several functions, in `at`.");
    }
    if material.structure.guesses() > 0 {
        says.push_str(" Of Newton's method one round counts.");
    }
    let mut blocks = vec![Block::Words(says), Block::Table(table), Block::Heading("Candidates".to_owned())];
    let mut table = Table::new(["function", "method", "work", "against the one taken"], 2);
    for function in &told {
        let taken = function.after.weight();
        let row = [name(function), function.method.to_owned(), taken.to_string(), "taken".to_owned()];
        table.rows.push(row.to_vec());
        let mut rivals: Vec<&Rival> = function.rivals.iter().collect();
        rivals.sort_by_key(|rival| rival.cost.weight());
        for rival in rivals {
            let work = rival.cost.weight();
            table.rows.push(vec![String::new(), rival.method.to_owned(), work.to_string(), against(taken, work)]);
        }
    }
    let rows = table.rows.len();
    let table = Block::Table(table);
    blocks.push(if rows > MOST_ROWS { Block::Folded(format!("{rows} candidates"), vec![table]) } else { table });
    section("Costs", blocks)
}

/// By how much a candidate has lost. Where limbs go in packs it may take less work on scalars than the one that was taken.
fn against(taken: u32, work: u32) -> String {
    let more = i64::from(work) - i64::from(taken);
    match (taken, more) {
        (_, 0) => "as much".to_owned(),
        (_, ..0) => format!("{more}, and more in packs"),
        (0, _) => format!("+{more}"),
        (taken, _) => format!("+{more}, +{:.0} %", 100.0 * more as f64 / f64::from(taken)),
    }
}

fn equations(material: &Material<'_>) -> Option<Section> {
    let mut blocks = Vec::new();
    for part in &material.page.sections {
        blocks.push(Block::Heading(part.title.to_owned()));
        let shown = Shown::new(&material.page, part);
        blocks.extend(part.says.iter().map(|says| Block::Words(says.clone())));
        blocks.extend(shown.says().map(|says| Block::Words(says.to_owned())));
        if shown.count() == 0 {
            continue;
        }
        let mut lines = Vec::new();
        for form in &shown.lines {
            match (form, lines.last_mut()) {
                (Form::Set(mathml, of), Some(Block::Equations(set))) => set.push(line(mathml, of)),
                (Form::Set(mathml, of), _) => lines.push(Block::Equations(vec![line(mathml, of)])),
                (Form::Plain(text), Some(Block::Letters(plain))) => plain.push(text.clone()),
                (Form::Plain(text), _) => lines.push(Block::Letters(vec![text.clone()])),
            }
        }
        if !shown.rest.is_empty() {
            lines.push(Block::Folded(shown.over_rest(), vec![Block::Letters(shown.rest.clone())]));
        }
        lines.extend(shown.at_end().map(Block::Words));
        match shown.is_folded() {
            true => blocks.push(Block::Folded(format!("{} equations", shown.count() + shown.more), lines)),
            false => blocks.extend(lines),
        }
    }
    section("Equations", blocks)
}

fn line(mathml: &str, line: &written::Line) -> Line {
    let (latex, text) = (latex::equation(&line.equation), text::equation(&line.equation));
    Line { mathml: mathml.to_owned(), latex, text, says: line.says.clone() }
}

fn remarks(material: &Material<'_>) -> Option<Section> {
    let Facts { defaults, unchecked, beyond_single, is_separable, .. } = &material.facts;
    let mut blocks = Vec::new();
    if *is_separable {
        blocks.push(Block::Words("Accelerations do not depend on velocities: the model is `Separable`.".to_owned()));
    }
    if !defaults.is_empty() {
        blocks.push(Block::Words("Defaults in force:".to_owned()));
        blocks.push(Block::List(defaults.clone()));
    }
    if !beyond_single.is_empty() {
        let numbers: Vec<String> = beyond_single.iter().map(|x| code(x)).collect();
        blocks
            .push(Block::Words(format!("`f32` does not hold these numbers of the equations: {}.", numbers.join(", "))));
    }
    if !unchecked.is_empty() {
        blocks.push(Block::Words(
            "Not checked in numbers, since no state was found at which that says something:".to_owned(),
        ));
        blocks.push(Block::List(unchecked.clone()));
    }
    section("Remarks", blocks)
}
