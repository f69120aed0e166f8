//! `compare`: a model in every choice of coordinates and constraints, with what each costs, and which to take.

mod choice;
mod measure;
mod page;
mod parallel;

use std::time::{Duration, Instant};

use multibody_engine::contracts::cost::Cost;
use multibody_engine::contracts::function::{Asked, FunctionKind};
use multibody_engine::diagnostics::Diagnostics;
use multibody_engine::mechanics::loops::advice::{Closing, Figures as Closed, Pivoted};
use multibody_engine::optimize::effort::Effort;
use multibody_engine::syntax::tree::Source;
use multibody_engine::{compile, emit};
use syn::Meta;

use self::choice::{Choice, Constraints, Coordinates, choices, is_part, rewrite, written};
use self::measure::{Code, Package, Times};
use crate::Stop;
use crate::arguments::{Extent, Subject};
use crate::build;
use crate::progress;
use crate::source::{Call, File};

/// The function by which choices are judged.
const JUDGED: &str = "forward_dynamics";

/// What has become of a model in one choice.
struct Row {
    choice: Choice,
    result: Result<Figures, String>,
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
    /// What a good part of it goes into.
    burden: Option<String>,
    /// Of the other functions that the model asks for.
    others: Vec<(String, u32)>,
    has_dead_centres: bool,
    /// How loops are closed, with the same work.
    closed: Closed,
    /// Equations that limbs absorb, and the sizes of systems that are left.
    pivoted: (usize, Vec<usize>),
    derived: Duration,
    /// What is compiled where times are asked for.
    code: Option<Code>,
    /// Nanoseconds of functions, where they are measured.
    times: Times,
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

impl Figures {
    /// Coordinates and multipliers.
    fn equations(&self) -> usize {
        self.state + self.multipliers
    }

    /// Nanoseconds of a function.
    fn time(&self, function: &str) -> Option<f64> {
        self.times.iter().find(|(name, _)| name == function).map(|(_, time)| *time)
    }
}

pub(crate) fn run(subject: &Subject, extent: Extent) -> Result<String, Stop> {
    let (file, found) = build::open(subject)?;
    // What stands in its way is told before anything is derived.
    let package = extent.measure.then(|| Package::beside(&subject.file));
    let mut package = package.transpose().map_err(Stop::Usage)?;
    let mut mistakes = Vec::new();
    let mut models = Vec::new();
    for (number, call) in found.calls.iter().enumerate() {
        let mut diagnostics = Diagnostics::default();
        let source = build::source(&file, call, &mut diagnostics);
        // What is wrong whatever the formulation.
        build::checked(&source, &mut diagnostics);
        mistakes.extend(build::mistakes(&diagnostics, call));
        let all = source.modules.iter().enumerate().filter(|(_, module)| !is_part(module));
        let asked = all.filter(|(_, module)| subject.model.as_ref().is_none_or(|only| module.name == only));
        models.extend(asked.map(|(module, _)| Subjected {
            call: number,
            module,
            title: title(&source, module),
            written: written(&source, module),
            choices: choices(&source, module),
        }));
    }
    build::tell(&file, &mistakes)?;
    build::some(&models, subject, &file)?;
    let tasks: Vec<Task<'_>> = models
        .iter()
        .flat_map(|model| model.choices.iter().map(|&coordinates| Task { file: &file, model, coordinates, extent }))
        .collect();
    let mut done = parallel::map(&tasks, Task::rows).into_iter();
    let mut texts = Vec::new();
    for model in &models {
        let mut rows: Vec<Row> = done.by_ref().take(model.choices.len()).flatten().collect();
        if let Some(package) = &mut package {
            timed(package, &model.title, &mut rows).map_err(Stop::Usage)?;
        }
        let own = settled(model.written, &rows);
        texts.push(page::text(&model.title, model.written, own, &rows));
    }
    Ok(texts.join("\n"))
}

/// The written choice, with what `Auto` stands for.
fn settled(written: Choice, rows: &[Row]) -> Choice {
    if written.constraints != Constraints::Auto {
        return written;
    }
    let closed = |constraints| {
        let row = rows.iter().find(|row| row.choice == Choice { constraints, ..written });
        row.and_then(|row| Some(row.result.as_ref().ok()?.closed))
    };
    let reduces = match (closed(Constraints::Reduced), closed(Constraints::Multipliers)) {
        (Some(reduced), Some(held)) => reduced.reduces(&held),
        (reduced, _) => reduced.is_some(),
    };
    Choice { constraints: if reduces { Constraints::Reduced } else { Constraints::Multipliers }, ..written }
}

/// Compiles and times what is there of one model. No derivation runs beside it.
fn timed(package: &mut Package, name: &str, rows: &mut [Row]) -> Result<(), String> {
    let mut figures: Vec<&mut Figures> = rows.iter_mut().filter_map(|row| row.result.as_mut().ok()).collect();
    let codes: Vec<&Code> = figures.iter().filter_map(|figures| figures.code.as_ref()).collect();
    if codes.is_empty() {
        return Ok(());
    }
    let times = measure::measure(package, name, &codes)?;
    for (figures, times) in figures.iter_mut().zip(times) {
        figures.times = times;
    }
    Ok(())
}

/// A model that is compared.
struct Subjected {
    /// The number of its call in the file: tokens do not go from thread to thread.
    call: usize,
    /// Its number in the call: `cfg` lets two have one name.
    module: usize,
    title: String,
    /// The choice that its text has made.
    written: Choice,
    choices: Vec<Coordinates>,
}

/// The name, with its `cfg` where another module has it too.
fn title(source: &Source, module: usize) -> String {
    let Some(this) = source.modules.get(module) else { return String::new() };
    if source.modules.iter().filter(|other| other.name == this.name).count() < 2 {
        return this.name.to_string();
    }
    let conditions = this.attrs.iter().filter_map(|attr| match &attr.meta {
        Meta::List(list) if list.path.is_ident("cfg") => Some(list.tokens.to_string()),
        _ => None,
    });
    format!("{} where {}", this.name, conditions.collect::<Vec<_>>().join(", "))
}

/// One model in one choice of coordinates.
struct Task<'a> {
    file: &'a File,
    model: &'a Subjected,
    coordinates: Coordinates,
    extent: Extent,
}

impl Task<'_> {
    fn rows(&self) -> Vec<Row> {
        let found = self.file.calls();
        let call = &found.calls[self.model.call];
        let of = |constraints| {
            let choice = Choice { coordinates: self.coordinates, constraints };
            let what = format!("deriving `{}` with {}", self.model.title, choice.words());
            Row {
                choice,
                result: progress::during(&what, || figures(self.file, call, self.model.module, choice, self.extent)),
            }
        };
        let held = of(Constraints::Multipliers);
        // Without equations there is nothing to choose.
        let is_open = held.result.as_ref().is_ok_and(|figures| figures.multipliers == 0);
        if is_open { vec![held] } else { vec![held, of(Constraints::Reduced)] }
    }
}

/// The call without the models below, of which this one cannot ask for formulas.
fn until(file: &File, call: &Call, model: usize) -> Source {
    let mut source = build::source(file, call, &mut Diagnostics::default());
    let mut number = 0..;
    source.modules.retain(|module| number.next().is_some_and(|number| number <= model) || is_part(module));
    source
}

/// The model in this choice, or the first thing that is said against it.
fn figures(file: &File, call: &Call, model: usize, choice: Choice, extent: Extent) -> Result<Figures, String> {
    let mut source = until(file, call, model);
    rewrite(&mut source, model, choice, extent.all);
    let mut diagnostics = Diagnostics::default();
    // The last one: of those without a mistake it may be another, but then there are diagnostics.
    let model = build::checked(&source, &mut diagnostics).pop();
    let begin = Instant::now();
    let Some(model) = model.filter(|_| diagnostics.is_empty()) else { return Err(first(&diagnostics)) };
    let (structure, compiled) = match compile(&model) {
        Ok(done) => done,
        Err(trouble) => {
            trouble.report(&model, &mut diagnostics);
            return Err(first(&diagnostics));
        }
    };
    let derived = begin.elapsed();
    let asked = compiled.functions.iter().filter(|function| matches!(function.kind.row().asked, Asked::By { .. }));
    let mut others = Vec::new();
    let mut forward = None;
    for function in asked {
        let effort = Effort::of(function);
        let work = effort.work();
        match function.kind {
            FunctionKind::ForwardDynamics => {
                let closed = Closed { closing: Closing::of(&structure), operations: effort.operations(), work };
                let pivoted = structure.pivoted.get(function.candidate);
                let sizes = |of: &Pivoted| (of.absorbed.len(), of.cores.iter().map(Vec::len).collect());
                forward = Some((function.after, closed, effort.burden(), pivoted.map_or_else(Default::default, sizes)));
            }
            kind => others.push((emit::function_name(&model, kind).into_owned(), work)),
        }
    }
    let (cost, closed, burden, pivoted) = forward.ok_or("it has no forward dynamics")?;
    let work = closed.work;
    let has_dead_centres = !structure.dead_centres.is_empty();
    let (state, multipliers) = (structure.state.len(), structure.rows.len());
    let functions: Vec<String> = others.iter().map(|(name, _)| name.clone()).chain([JUDGED.to_owned()]).collect();
    let code = extent.measure.then(|| Code::new(model, &structure, &compiled, &functions)).transpose()?;
    let times = Times::new();
    Ok(Figures {
        state,
        multipliers,
        cost,
        work,
        burden,
        others,
        has_dead_centres,
        closed,
        pivoted,
        derived,
        code,
        times,
    })
}

fn first(diagnostics: &Diagnostics) -> String {
    let first = diagnostics.errors().first();
    first.map_or_else(|| "the model is not what was written".to_owned(), |error| error.message.clone())
}
