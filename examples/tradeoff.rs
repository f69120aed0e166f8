//! What accuracy costs: every method on every kind of scene, against true references; tables, plots, recommendations.
//!
//! `cargo run --release --example tradeoff [-- --quick] [scene ..] [directory]`
//!
//! Writes `tradeoff.csv`, `summary.md` and a plot of each scene into the directory, `target/tradeoff` unless another is
//! given. Errors are those at the end against solutions of 25 digits, relative, and divided by the problem's own growth of
//! errors; times are the least of several rounds through all runs of a scene, so that their ratios mean something. `--quick`
//! takes few points of each curve and shows that all of this works.

#[path = "tradeoff/advice.rs"]
mod advice;
#[path = "tradeoff/analysis.rs"]
mod analysis;
#[path = "tradeoff/bench.rs"]
mod bench;
#[path = "tradeoff/growth.rs"]
mod growth;
#[path = "tradeoff/judge.rs"]
mod judge;
#[path = "tradeoff/mechanisms.rs"]
mod mechanisms;
#[path = "tradeoff/models.rs"]
mod models;
#[path = "tradeoff/plot.rs"]
mod plot;
#[path = "tradeoff/reference.rs"]
mod reference;
#[path = "tradeoff/scenes.rs"]
mod scenes;
#[path = "tradeoff/subject.rs"]
mod subject;
#[path = "tradeoff/svg.rs"]
mod svg;
#[path = "tradeoff/table.rs"]
mod table;
#[path = "tradeoff/timing.rs"]
mod timing;

use std::path::PathBuf;
use std::time::Instant;

use bench::{Bench, Effort};

fn main() -> Result<(), std::io::Error> {
    let start = Instant::now();
    let (mut effort, mut directory, mut wanted) = (Effort::FULL, PathBuf::from("target/tradeoff"), Vec::new());
    for argument in std::env::args().skip(1) {
        match scenes::NAMES.into_iter().find(|name| **name == argument) {
            Some(name) => wanted.push(name),
            None if argument == "--quick" => effort = Effort::QUICK,
            None => directory = PathBuf::from(argument),
        }
    }
    if wanted.is_empty() {
        wanted.extend(scenes::NAMES);
    }
    std::fs::create_dir_all(&directory)?;

    println!("Scenes: {}\n", wanted.join(", "));
    let mut benches: Vec<Bench> = Vec::new();
    for name in wanted {
        let bench = scenes::run(name, effort);
        std::fs::write(directory.join(format!("{name}.svg")), plot::picture(&bench))?;
        benches.push(bench);
    }
    std::fs::write(directory.join("tradeoff.csv"), table::csv(&benches))?;
    let summary = summary(&benches);
    std::fs::write(directory.join("summary.md"), &summary)?;
    println!("\n{summary}\nPlots, table and this summary: {}", directory.display());
    println!("{:.0} s in all", start.elapsed().as_secs_f64());
    Ok(())
}

/// What the summary starts with.
const INTRODUCTION: &str = "\
# What accuracy costs

Written by `cargo run --release --example tradeoff`, with a picture of each scene and every run in `tradeoff.csv`. Errors are
those at the end, relative, divided by the problem's own growth of errors. An accuracy is reached where no finer setting has
a greater error; orders are those along the curve, over steps where steps are fixed and over evaluations where they are not.
Times are those of one core, per simulated second.

";

fn summary(benches: &[Bench]) -> String {
    let scenes: Vec<String> = benches.iter().map(table::scene).collect();
    format!(
        "{INTRODUCTION}## Scenes\n\n{}\n## The choice of `simulate`\n\n{}\n## Recommendation\n\n\
         In brackets: cost over that of the best in each scene, the mean over evaluations and time.\n\n{}\n\
         ## Single precision\n\n{}",
        scenes.join("\n"),
        judge::judged(benches),
        table::advice(&advice::advice(benches)),
        table::single(&advice::single(benches)),
    )
}
