//! Models of a file, through the stages of the engine.

use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::diagnostics::Diagnostics;
use multibody_engine::emit::function_name;
use multibody_engine::invariant::fault::guard;
use multibody_engine::mechanics::loops::structure::Structure;
use multibody_engine::model::Soundness;
use multibody_engine::model::types::Model;
use multibody_engine::optimize::program::Compiled;
use multibody_engine::{compile, model, syntax};

use crate::Stop;
use crate::arguments::Subject;
use crate::progress;
use crate::said::Mistake;
use crate::source::{Call, File, Found};

/// A model with its functions.
pub(crate) struct Built {
    pub(crate) model: Model,
    pub(crate) structure: Structure,
    pub(crate) compiled: Compiled,
}

impl Built {
    pub(crate) fn name(&self) -> String {
        self.model.name.to_string()
    }

    /// The name of a function's method.
    pub(crate) fn function(&self, kind: FunctionKind) -> String {
        function_name(kind).into_owned()
    }
}

/// All models of a file, or the one that was asked for. Mistakes are told, and then there are none.
pub(crate) fn models(subject: &Subject) -> Result<Vec<Built>, Stop> {
    let (file, found) = open(subject)?;
    let mut models = Vec::new();
    let mut mistakes = Vec::new();
    for call in &found.calls {
        let (built, wrong) = compiled(call, subject);
        models.extend(built);
        mistakes.extend(wrong);
    }
    tell(&file, &mistakes)?;
    some(&models, subject, &file)?;
    Ok(models)
}

/// The file and its calls, with a word about what is left out.
pub(crate) fn open(subject: &Subject) -> Result<(File, Found), Stop> {
    let file = File::read(&subject.file).map_err(Stop::Usage)?;
    let found = file.calls();
    if let Some(at) = found.unreadable {
        let message = "this is not Rust: the tokens end here".to_owned();
        tell(&file, &[Mistake { start: at, end: at, message, help: None }])?;
    }
    for at in &found.templates {
        eprintln!(
            "note: {}:{}:{} is left out: a declarative macro writes this call, and its `$` have values where that is used",
            file.name,
            at.line,
            at.column + 1
        );
    }
    if found.calls.is_empty() {
        return Err(Stop::Usage(format!("{} holds no call of `multibody!` that can be read", file.name)));
    }
    Ok((file, found))
}

/// Ends where there are mistakes.
pub(crate) fn tell(file: &File, mistakes: &[Mistake]) -> Result<(), Stop> {
    if mistakes.is_empty() {
        return Ok(());
    }
    mistakes.iter().for_each(|mistake| eprintln!("{}", mistake.text(file)));
    eprintln!("{} {}", mistakes.len(), if mistakes.len() == 1 { "error" } else { "errors" });
    Err(Stop::Mistakes)
}

/// Ends where no model is left to look at.
pub(crate) fn some<T>(models: &[T], subject: &Subject, file: &File) -> Result<(), Stop> {
    match &subject.model {
        _ if !models.is_empty() => Ok(()),
        Some(name) => Err(Stop::Usage(format!("{} has no model `{name}`", file.name))),
        None => Err(Stop::Usage(format!("{} has parts, and no model", file.name))),
    }
}

/// Models of a call, and what is wrong with others.
fn compiled(call: &Call, subject: &Subject) -> (Vec<Built>, Vec<Mistake>) {
    let mut diagnostics = Diagnostics::default();
    let source = syntax::parse(call.tokens.clone(), &mut diagnostics);
    let mut built = Vec::new();
    for model in checked(&source, &mut diagnostics) {
        let name = model.name.to_string();
        if subject.model.as_ref().is_some_and(|only| *only != name) {
            continue;
        }
        match progress::during(&format!("deriving `{name}`"), || compile(&model)) {
            Ok((structure, compiled)) => built.push(Built { model, structure, compiled }),
            Err(trouble) => trouble.report(&model, &mut diagnostics),
        }
    }
    (built, mistakes(&diagnostics, call))
}

/// Models without mistakes.
pub(crate) fn checked(source: &syntax::tree::Source, diagnostics: &mut Diagnostics) -> Vec<Model> {
    match guard("model", || model::check_all(source, diagnostics)) {
        Ok(all) => {
            let sound = all.into_iter().filter(|checked| checked.state == Soundness::Sound);
            sound.map(|checked| checked.model).collect()
        }
        Err(fault) => {
            let message = format!("the stage `{}` has failed: {}", fault.stage, fault.what);
            diagnostics.error(proc_macro2::Span::call_site(), message);
            Vec::new()
        }
    }
}

pub(crate) fn mistakes(diagnostics: &Diagnostics, call: &Call) -> Vec<Mistake> {
    diagnostics.errors().iter().map(|error| Mistake::of(error, call.at)).collect()
}
