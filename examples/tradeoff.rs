//! What accuracy costs.

#[path = "tradeoff/bench.rs"]
mod bench;
#[path = "tradeoff/growth.rs"]
mod growth;
#[path = "tradeoff/mechanisms.rs"]
mod mechanisms;
#[path = "tradeoff/models.rs"]
mod models;
#[path = "tradeoff/reference.rs"]
mod reference;
#[path = "tradeoff/scenes.rs"]
mod scenes;
#[path = "tradeoff/subject.rs"]
mod subject;

fn main() {
    let quick = std::env::args().any(|a| a == "--quick");
    for name in scenes::NAMES {
        let bench = scenes::run(name, if quick { bench::Effort::QUICK } else { bench::Effort::FULL });
        println!("growth {}", bench.growth);
        for p in &bench.points { println!("{:20} {:?} {:10} {} {:9.2e} {:9} {:9.2e} {:9.2e} {:9.2e} {:9.2e}", p.series.method, p.series.steps, p.series.handling, p.series.scalar, p.setting, p.evaluations, p.own, p.gap, p.drift, p.seconds); }
    }
}
