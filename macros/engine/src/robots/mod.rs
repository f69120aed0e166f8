//! Stage `robots`: parts that stand in a robot's file.
//!
//! In: the syntax tree of a call, and a reader of files. Out: the same tree, in which `part arm: Urdf { file: ".." };` is a use
//! of a part that the file has been written out as, in the language and at the user's literal: all that comes behind knows
//! nothing of robots. The files that were read.

mod angles;
mod mistake;
mod mjcf;
mod names;
mod options;
mod robot;
mod urdf;
mod write;
mod xml;

use std::collections::HashMap;

use proc_macro2::{Ident, Span};
use syn::{Expr, LitStr};

use crate::diagnostics::{Diagnostics, nearest};
use crate::syntax;
use crate::syntax::tree::{Field, ItemKind, Module, Part, Source};
use crate::syntax::{MJCF, URDF};

use mistake::Mistake;
use options::{Base, Options};
use robot::Robot;
use write::{Fault, Written};

/// The text of the file that a literal names, or why there is none.
pub type Reader<'a> = dyn Fn(&LitStr) -> Result<String, String> + 'a;

/// For calls that have no file system about them.
pub fn no_file(_: &LitStr) -> Result<String, String> {
    Err("no files are read here".to_owned())
}

/// Of robots' files.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Format {
    Urdf,
    Mjcf,
}

impl Format {
    /// By the kind of a part that stands in such a file.
    fn named(kind: &Ident) -> Option<Format> {
        match kind.to_string().as_str() {
            URDF => Some(Format::Urdf),
            MJCF => Some(Format::Mjcf),
            _ => None,
        }
    }

    /// By the root element.
    fn of(text: &str) -> Format {
        let document = xml::parse(text);
        let is_mjcf = document.is_ok_and(|document| document.root_element().has_tag_name("mujoco"));
        if is_mjcf { Format::Mjcf } else { Format::Urdf }
    }

    /// What files of it are called.
    fn extension(self) -> &'static str {
        match self {
            Format::Urdf => "urdf",
            Format::Mjcf => "xml",
        }
    }

    fn read(self, text: &str, is_friction_ignored: bool) -> Result<Robot, Mistake> {
        match self {
            Format::Urdf => urdf::read(text, is_friction_ignored),
            Format::Mjcf => mjcf::read(text, is_friction_ignored),
        }
    }
}

/// Replaces every robot by a part of its own; those with a mistake are reported and taken away.
pub fn place(source: &mut Source, reader: &Reader, diagnostics: &mut Diagnostics) -> Vec<LitStr> {
    let mut names: Vec<String> = source.modules.iter().map(|module| module.name.to_string()).collect();
    // A part of the user's that is called as a format comes first.
    let own = names.clone();
    let mut files = Vec::new();
    let mut parts = Vec::new();
    let mut known = HashMap::new();
    for module in &mut source.modules {
        let owner = module.name.to_string();
        let mut lost = Vec::new();
        for (at, item) in module.items.iter_mut().enumerate() {
            let ItemKind::Part(part) = &mut item.kind else { continue };
            let Some(format) = Format::named(&part.kind).filter(|_| !own.iter().any(|name| part.kind == name)) else {
                continue;
            };
            let before = diagnostics.errors().len();
            let placed = options::read(part, format.extension(), diagnostics).and_then(|options| {
                of_file(part, (format, &owner), &options, reader, &mut names, &mut known, diagnostics)
            });
            match placed {
                Some(placed) => {
                    files.push(placed.file);
                    parts.extend(placed.module);
                }
                None => {
                    debug_assert!(part.fields.broken || diagnostics.errors().len() > before);
                    lost.push(at);
                }
            }
        }
        module.broken |= !lost.is_empty();
        for at in lost.into_iter().rev() {
            module.items.remove(at);
        }
    }
    source.modules.extend(parts);
    files
}

/// A robot's file as a call, with a part that is the robot and a model in which it stands on the ground.
pub fn import(text: &str, file: &str) -> Result<String, String> {
    let whole = |fault| match fault {
        Fault::Of(mistake) => match &mistake.help {
            Some(help) => format!("{}\n  help: {help}", mistake.text(file)),
            None => mistake.text(file),
        },
        Fault::At(_, message, _) => message,
    };
    let robot = Format::of(text).read(text, false).map_err(|mistake| whole(Fault::Of(mistake)))?;
    let name = names::module(&robot.name);
    let Written { text, port } = write::part(&robot, &name, file, &Options::plain(file)).map_err(whole)?;
    let mut call = "multibody! {\n".to_owned();
    let mut depth = 1;
    for line in text.lines() {
        depth -= usize::from(line == "}");
        call.push_str(&format!("{}{line}\n", "    ".repeat(depth)));
        depth += usize::from(line.starts_with("mod "));
    }
    call.push_str(&format!(
        "    pub mod model {{\n        world {{ gravity: -9.81 * Z }}\n        part robot: {name} {{ {port}: ground }};\n        \
         emit forward_dynamics, inverse_dynamics;\n    }}\n}}\n"
    ));
    Ok(call)
}

struct Placed {
    file: LitStr,
    /// Nothing if another part is the same.
    module: Option<Module>,
}

fn of_file(
    part: &mut Part,
    (format, owner): (Format, &str),
    options: &Options,
    reader: &Reader,
    names: &mut Vec<String>,
    known: &mut HashMap<String, (String, String)>,
    diagnostics: &mut Diagnostics,
) -> Option<Placed> {
    let (file, span) = (options.file.value(), options.file.span());
    let text = match reader(&options.file) {
        Ok(text) => text,
        Err(why) => {
            diagnostics.error(span, format!("{file}: {why}"));
            return None;
        }
    };
    // Called as the part that it is, and where that name is gone, as the module and the part.
    let own = part.name.to_string();
    let mut name = if names.contains(&own) { format!("{owner}_{own}") } else { own };
    while names.contains(&name) {
        name.push('_');
    }
    let robot = format.read(&text, options.is_friction_ignored).map_err(Fault::Of);
    let written = robot.and_then(|robot| {
        let Written { text, port } = write::part(&robot, "_", &file, options)?;
        Ok((text, port))
    });
    let (text, port) = match written {
        Ok(written) => written,
        Err(fault) => {
            report(fault, &file, span, diagnostics);
            return None;
        }
    };
    let module = match known.get(&text) {
        Some((first, _)) => {
            name.clone_from(first);
            None
        }
        None => {
            let whole = text.replacen("mod _ {", &format!("mod {name} {{"), 1);
            known.insert(text, (name.clone(), port.clone()));
            names.push(name.clone());
            Some(module(&whole, span, diagnostics)?)
        }
    };
    let mounted = match &options.base {
        Base::Frame(expr) => expr.clone(),
        Base::Free(word) => {
            Expr::Path(syn::ExprPath { attrs: Vec::new(), qself: None, path: Ident::new("ground", word.span()).into() })
        }
    };
    part.kind = Ident::new(&name, part.kind.span());
    part.again = part.again.as_ref().map(|again| Ident::new(&name, again.span()));
    part.fields.list = vec![Field { name: Ident::new(&port, span), value: mounted }];
    Some(Placed { file: options.file.clone(), module })
}

/// Reads what has been written.
fn module(text: &str, span: Span, diagnostics: &mut Diagnostics) -> Option<Module> {
    let module = syntax::written(text, span);
    let report = |why| diagnostics.error(span, format!("this robot can't be written in the language: {why}"));
    module.map_err(report).ok()
}

fn report(fault: Fault, file: &str, span: Span, diagnostics: &mut Diagnostics) {
    match fault {
        Fault::Of(mistake) => match &mistake.help {
            Some(help) => diagnostics.error_help(span, mistake.text(file), help.clone()),
            None => diagnostics.error(span, mistake.text(file)),
        },
        Fault::At(name, message, all) => match nearest(&name.to_string(), all.iter().map(String::as_str)) {
            Some(near) => diagnostics.error_help(name.span(), message, format!("did you mean `{near}`?")),
            None => diagnostics.error(name.span(), message),
        },
    }
}
