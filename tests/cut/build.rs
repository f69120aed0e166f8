//! Each of `models` as two files: whole, and with its functions cut into parts.

use std::path::{Path, PathBuf};
use std::{env, fs};

use multibody_engine::diagnostics::Diagnostics;
use multibody_engine::model::types::Model;
use multibody_engine::{compile, emit, model, syntax};

/// Operations of a part: few, so that small models have many parts, and values pass from each to several others.
const PART: usize = 25;

/// The one model of a text.
fn read(text: &str) -> Model {
    let mut diagnostics = Diagnostics::default();
    let source = syntax::parse(text.parse().expect("tokens"), &mut diagnostics);
    let models = model::check(&source, &mut diagnostics);
    let errors: Vec<&str> = diagnostics.errors().iter().map(|error| error.message.as_str()).collect();
    let [model] = <[Model; 1]>::try_from(models).unwrap_or_else(|_| panic!("one model, {errors:#?}"));
    assert!(errors.is_empty(), "{errors:#?}");
    model
}

fn main() {
    println!("cargo::rerun-if-changed=models");
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets it"));
    for name in ["walker", "linkage"] {
        let text = fs::read_to_string(Path::new("models").join(name).with_extension("txt")).expect("a model");
        let model = read(&text);
        let (structure, compiled) = compile(&model).unwrap_or_else(|_| panic!("{name} compiles"));
        let whole = emit::emit(&model, &structure, &compiled);
        let cut = emit::in_parts(&model, &structure, &compiled, PART);
        for (folder, code) in [("whole", whole), ("cut", cut)] {
            fs::create_dir_all(out.join(folder)).expect("a folder");
            fs::write(out.join(folder).join(name).with_extension("rs"), code.to_string()).expect("a file");
        }
    }
}
