//! `compare`: a model in every choice of coordinates and constraints, with what each costs, and which to take.

mod choice;
mod parallel;
mod rounds;

use std::fmt::Write;
use std::time::{Duration, Instant};

use multibody_engine::contracts::cost::Cost;
use multibody_engine::contracts::function::{Asked, FunctionKind};
use multibody_engine::diagnostics::Diagnostics;
use multibody_engine::syntax::{self, tree::Source};
use multibody_engine::{compile, emit};

use self::choice::{Choice, Constraints, Coordinates, choices, is_part, rewrite, written};
use super::counts::{KINDS, numbers};
use crate::Stop;
use crate::arguments::Subject;
use crate::build;
use crate::progress;
use crate::source::{Call, File};
use crate::table::Table;

/// What has become of a model in one choice.
struct Row {
    choice: Choice,
    result: Result<Figures, String>,
}

impl Row {
    /// What is written in `formulation`.
    fn words(&self) -> String {
        match &self.result {
            Ok(figures) if figures.multipliers == 0 && self.choice.constraints == Constraints::Multipliers => {
                format!("coordinates {}", self.choice.coordinates.word())
            }
            _ => self.choice.words(),
        }
    }
}

struct Figures {
    /// Velocity coordinates of the state.
    state: usize,
    /// Equations that keep a multiplier.
    multipliers: usize,
    /// Of forward dynamics.
    cost: Cost,
    /// The same weighted, iterations with all their rounds.
    work: u32,
    /// Of the other functions that the model asks for.
    others: Vec<(String, u32)>,
    has_dead_centres: bool,
    time: Duration,
}

pub(crate) fn run(subject: &Subject, all: bool) -> Result<String, Stop> {
    let (file, found) = build::open(subject)?;
    let mut mistakes = Vec::new();
    let mut models = Vec::new();
    for (number, call) in found.calls.iter().enumerate() {
        let mut diagnostics = Diagnostics::default();
        let source = syntax::parse(call.tokens.clone(), &mut diagnostics);
        // What is wrong whatever the formulation.
        build::checked(&source, &mut diagnostics);
        mistakes.extend(build::mistakes(&diagnostics, call));
        let names = source.modules.iter().filter(|module| !is_part(module)).map(|module| module.name.to_string());
        let asked = names.filter(|name| subject.model.as_ref().is_none_or(|only| only == name));
        models.extend(asked.map(|name| {
            let source = alone(call, &name);
            (number, name.clone(), written(&source, &name), choices(&source))
        }));
    }
    build::tell(&file, &mistakes)?;
    build::some(&models, subject, &file)?;
    let tasks: Vec<Task<'_>> = models
        .iter()
        .flat_map(|(call, name, _, choices)| {
            choices.iter().map(|&coordinates| Task { file: &file, call: *call, name, coordinates, all })
        })
        .collect();
    let mut done = parallel::map(&tasks, Task::rows).into_iter();
    let texts = models.iter().map(|(_, name, own, choices)| {
        let rows: Vec<Row> = done.by_ref().take(choices.len()).flatten().collect();
        told(name, *own, &rows)
    });
    Ok(texts.collect::<Vec<String>>().join("\n"))
}

/// One model in one choice of coordinates.
struct Task<'a> {
    file: &'a File,
    /// The number of its call in the file: tokens do not go from thread to thread.
    call: usize,
    name: &'a str,
    coordinates: Coordinates,
    /// With all functions that the model asks for.
    all: bool,
}

impl Task<'_> {
    fn rows(&self) -> Vec<Row> {
        let found = self.file.calls();
        let call = &found.calls[self.call];
        let of = |constraints| {
            let choice = Choice { coordinates: self.coordinates, constraints };
            let what = format!("deriving `{}` with {}", self.name, choice.words());
            Row { choice, result: progress::during(&what, || figures(call, self.name, choice, self.all)) }
        };
        let held = of(Constraints::Multipliers);
        // Without equations there is nothing to choose.
        let is_open = held.result.as_ref().is_ok_and(|figures| figures.multipliers == 0);
        if is_open { vec![held] } else { vec![held, of(Constraints::Reduced)] }
    }
}

/// All choices of one model.
fn told(name: &str, own: Choice, rows: &[Row]) -> String {
    let mut text = format!("{name}\n{}", table(rows, own));
    if rows.iter().any(|row| row.choice == own) {
        text.push_str("  * as it is written\n");
    }
    for row in rows {
        if let Err(reason) = &row.result {
            let _ = writeln!(text, "  {} is refused: {reason}", row.choice.words());
        }
    }
    text.push_str(&advice(rows, own));
    text
}

/// The call without its other models.
fn alone(call: &Call, name: &str) -> Source {
    let mut source = syntax::parse(call.tokens.clone(), &mut Diagnostics::default());
    source.modules.retain(|module| is_part(module) || module.name == name);
    source
}

/// The model in this choice, or the first thing that is said against it.
fn figures(call: &Call, name: &str, choice: Choice, all: bool) -> Result<Figures, String> {
    let mut source = alone(call, name);
    rewrite(&mut source, choice, all);
    let mut diagnostics = Diagnostics::default();
    let model = build::checked(&source, &mut diagnostics).pop();
    let begin = Instant::now();
    let compiled = model.as_ref().filter(|_| diagnostics.is_empty()).map(|model| (model, compile(model)));
    let time = begin.elapsed();
    let (structure, compiled) = match compiled {
        Some((_, Ok(done))) => done,
        Some((model, Err(trouble))) => {
            trouble.report(model, &mut diagnostics);
            return Err(first(&diagnostics));
        }
        None => return Err(first(&diagnostics)),
    };
    let asked = compiled.functions.iter().filter(|function| matches!(function.kind.row().asked, Asked::By { .. }));
    let mut others = Vec::new();
    let mut forward = None;
    for function in asked {
        let work = rounds::work(function);
        match function.kind {
            FunctionKind::ForwardDynamics => forward = Some((function.after, work)),
            kind => others.push((emit::function_name(kind).into_owned(), work)),
        }
    }
    let (cost, work) = forward.ok_or("it has no forward dynamics")?;
    let has_dead_centres = !structure.dead_centres.is_empty();
    let (state, multipliers) = (structure.state.len(), structure.rows.len());
    Ok(Figures { state, multipliers, cost, work, others, has_dead_centres, time })
}

fn first(diagnostics: &Diagnostics) -> String {
    let first = diagnostics.errors().first();
    first.map_or_else(|| "the model is not what was written".to_owned(), |error| error.message.clone())
}

fn table(rows: &[Row], own: Choice) -> String {
    let mut functions: Vec<&String> = Vec::new();
    for (name, _) in rows.iter().filter_map(|row| row.result.as_ref().ok()).flat_map(|figures| &figures.others) {
        if !functions.contains(&name) {
            functions.push(name);
        }
    }
    let heads = ["coordinates", "constraints", "state", "multipliers", "equations"].into_iter();
    let heads = heads.chain(KINDS).chain(["work"]).map(String::from);
    let heads = heads.chain(functions.iter().map(|name| (*name).clone())).chain(["derived".to_owned()]);
    let mut titles = vec![(5, "forward_dynamics")];
    titles.extend((!functions.is_empty()).then_some((12, "work of the other functions")));
    let mut table = Table::new(2, heads).titled(titles);
    for Row { choice, result } in rows {
        let mark = if *choice == own { "*" } else { "" };
        let held = match (choice.constraints, result) {
            (Constraints::Multipliers, Ok(figures)) if figures.multipliers == 0 => "no equations",
            (constraints, _) => constraints.word(),
        };
        let words = [format!("{}{mark}", choice.coordinates.word()), held.to_owned()];
        let Ok(figures) = result else {
            table.row(words.into_iter().chain(["refused".to_owned()]));
            continue;
        };
        let sizes = [figures.state, figures.multipliers, figures.state + figures.multipliers].map(|n| n.to_string());
        let counts = numbers(&figures.cost).map(|n| n.to_string());
        let others = functions.iter().map(|name| {
            let work = figures.others.iter().find(|(other, _)| other == *name);
            work.map_or_else(|| "-".to_owned(), |(_, work)| work.to_string())
        });
        let time = format!("{:.0} ms", figures.time.as_secs_f64() * 1e3);
        let cells = words.into_iter().chain(sizes).chain(counts).chain([figures.work.to_string()]);
        table.row(cells.chain(others).chain([time]));
    }
    table.text()
}

/// The choice of least work, and why.
fn advice(rows: &[Row], own: Choice) -> String {
    let mut good: Vec<(&Row, &Figures)> =
        rows.iter().filter_map(|row| Some((row, row.result.as_ref().ok()?))).collect();
    good.sort_by_key(|(_, figures)| (figures.work, figures.state + figures.multipliers));
    let Some((best, figures)) = good.first() else { return "  no choice is admitted\n".to_owned() };
    let same = if best.choice == own { ", as it is written" } else { "" };
    let mut text = format!("  recommended: {}{same}\n", best.words());
    let reason = match good.get(1) {
        Some((next, other)) => format!(
            "forward dynamics takes least work, {}; next are {} with {:.2} times as much",
            figures.work,
            next.words(),
            f64::from(other.work) / f64::from(figures.work.max(1))
        ),
        None => "no other choice is admitted".to_owned(),
    };
    let _ = writeln!(text, "    since {reason}");
    if figures.multipliers > 0 {
        let _ = writeln!(text, "    loops drift: they are kept closed by projection or by Baumgarte's terms");
    } else if figures.has_dead_centres {
        let _ = writeln!(text, "    loops cannot drift; motions end at the dead centres of their solution");
    }
    text
}
