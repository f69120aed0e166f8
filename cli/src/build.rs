//! Models of a file, through the stages of the engine.

use std::fs;
use std::path::Path;

use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::diagnostics::Diagnostics;
use multibody_engine::emit::function_name;
use multibody_engine::invariant::fault::guard;
use multibody_engine::mechanics::loops::structure::Structure;
use multibody_engine::mechanics::written::Page;
use multibody_engine::model::Soundness;
use multibody_engine::model::types::Model;
use multibody_engine::optimize::program::Compiled;
use multibody_engine::optimize::{Excess, Refusal};
use multibody_engine::{Trouble, chosen, compile, mechanics, model, settled, syntax};
use proc_macro2::TokenStream;

use crate::Stop;
use crate::arguments::Subject;
use crate::parts;
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
        function_name(&self.model, kind).into_owned()
    }
}

/// All models of a file, or the one that was asked for. Mistakes are told, and then there are none.
pub(crate) fn models(subject: &Subject) -> Result<Vec<Built>, Stop> {
    let models = each(subject, "deriving", compile)?;
    Ok(models.into_iter().map(|(model, (structure, compiled))| Built { model, structure, compiled }).collect())
}

/// The same with what other ways to close loops cost.
pub(crate) fn advised_models(subject: &Subject) -> Result<Vec<Built>, Stop> {
    let models = each(subject, "deriving", advised)?;
    Ok(models.into_iter().map(|(_, built)| built).collect())
}

/// A model as `Auto` has it, with what the choice costs beside the other one.
pub(crate) fn advised(model: &Model) -> Result<Built, Trouble> {
    let (model, advice, (structure, compiled)) = settled(model, compile)?;
    let is_told = structure.advice.as_ref().is_some_and(|_| advice.is_none());
    let structure = Structure { advice: advice.map(Box::new).or(structure.advice), ..structure };
    let structure = if is_told { structure } else { multibody_engine::advised(&model, structure, &compiled)? };
    Ok(Built { model: model.into_owned(), structure, compiled })
}

/// Equations of the same, by name.
pub(crate) fn pages(subject: &Subject) -> Result<Vec<(String, Page)>, Stop> {
    let models = each(subject, "writing", |model| Ok(settled(model, page)?.2))?;
    Ok(models.into_iter().map(|(model, page)| (model.name.to_string(), page)).collect())
}

fn page(model: &Model) -> Result<Page, Trouble> {
    let freedoms = mechanics::freedoms(model);
    if freedoms > mechanics::MOST_FREEDOMS {
        return Err(Trouble::Refused(Refusal::TooLarge(Excess::Coordinates(freedoms))));
    }
    let written = guard("mechanics", || {
        let structure = mechanics::analysis::analyse(model)?;
        mechanics::page(model, &structure)
    });
    written.map_err(Trouble::Fault)?.map_err(Trouble::Complaints)
}

/// Models with what the work makes of them.
pub(crate) fn each<T>(
    subject: &Subject,
    verb: &str,
    work: impl Fn(&Model) -> Result<T, Trouble>,
) -> Result<Vec<(Model, T)>, Stop> {
    let (file, found) = open(subject)?;
    let mut models = Vec::new();
    let mut wrong = Vec::new();
    for call in &found.calls {
        let mut diagnostics = Diagnostics::default();
        let source = source(&file, call, &mut diagnostics);
        for model in checked(&source, &mut diagnostics) {
            let name = model.name.to_string();
            if subject.model.as_ref().is_some_and(|only| *only != name) {
                continue;
            }
            let worked: Result<_, Trouble> = progress::during(&format!("{verb} `{name}`"), || {
                let chosen = chosen(&model)?.into_owned();
                let made = work(&chosen)?;
                Ok((chosen, made))
            });
            match worked {
                Ok((chosen, made)) => models.push((chosen, made)),
                Err(trouble) => trouble.report(&model, &mut diagnostics),
            }
        }
        wrong.extend(mistakes(&diagnostics, call));
    }
    tell(&file, &wrong)?;
    some(&models, subject, &file)?;
    Ok(models)
}

/// What a call says, with the robots whose files lie beside this one.
pub(crate) fn source(file: &File, call: &Call, diagnostics: &mut Diagnostics) -> syntax::tree::Source {
    let folder = Path::new(&file.name).parent().unwrap_or(Path::new(""));
    let read = |name: &syn::LitStr| fs::read_to_string(folder.join(name.value())).map_err(|error| error.to_string());
    multibody_engine::parse_reading(call.tokens.clone(), &read, diagnostics)
}

/// The file and its calls, with a word about what is left out.
pub(crate) fn open(subject: &Subject) -> Result<(File, Found), Stop> {
    let file = File::read(&subject.file).map_err(Stop::Usage)?;
    let mut found = file.calls();
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
    let mut calls: Vec<TokenStream> = found.calls.iter().map(|call| call.tokens.clone()).collect();
    for path in &subject.parts {
        calls.extend(File::read(path).map_err(Stop::Usage)?.calls().calls.into_iter().map(|call| call.tokens));
    }
    let mut wrong = Vec::new();
    for call in &mut found.calls {
        match parts::linked(&call.tokens, &calls) {
            Ok(tokens) => call.tokens = tokens,
            Err(diagnostics) => wrong.extend(mistakes(&diagnostics, call)),
        }
    }
    tell(&file, &wrong)?;
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
