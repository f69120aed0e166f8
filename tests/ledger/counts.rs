//! The operation ledger: counts per model and function, compared with the committed `ledger.md` to the last operation, and
//! with the bars that this project has set itself. `UPDATE_LEDGER=1` writes the file anew: a change that raises a count
//! must say why.

use std::fmt::Write;
use std::sync::OnceLock;

use multibody_engine::contracts::cost::Cost;
use multibody_tests::models::{arms, motion, small};
use multibody_tests::support::data::path;
use multibody_tests::support::ledger::{Behind, InSpeeds, Packed, Row, Written, all, flops, in_speeds, once, packed};
use multibody_tests::support::required::{CASES, Case};

/// Additions, products, quotients that others need, for arms whose every number is a literal.
struct Bar {
    model: &'static str,
    function: &'static str,
    /// A pruned recursion in body frames, written by hand; where there is none, Pinocchio's algorithms on CasADi.
    hand: [u32; 3],
    /// Zeros pruned, common subexpressions, base inertial parameters.
    prototype: [u32; 3],
    /// Not a bar yet.
    goal: [u32; 3],
}

const BARS: [Bar; 9] = [
    bar("double_pendulum", "inverse_dynamics", [24, 35, 0], [15, 23, 0], [10, 16, 0]),
    bar("double_pendulum", "forward_dynamics", [31, 45, 3], [19, 28, 1], [14, 20, 1]),
    bar("cart5", "inverse_dynamics", [105, 134, 0], [56, 74, 0], [48, 62, 0]),
    bar("cart5", "forward_dynamics", [190, 246, 14], [153, 185, 15], [110, 140, 6]),
    bar("puma560", "inverse_dynamics", [191, 269, 0], [151, 199, 0], [125, 165, 0]),
    bar("puma560", "forward_dynamics", [342, 439, 15], [263, 327, 10], [215, 270, 6]),
    bar("panda", "inverse_dynamics", [375, 479, 0], [288, 360, 0], [250, 305, 0]),
    bar("panda", "mass_matrix", [218, 249, 0], [178, 193, 0], [140, 160, 0]),
    bar("panda", "forward_dynamics", [680, 820, 21], [556, 650, 21], [450, 540, 7]),
];

const fn bar(model: &'static str, function: &'static str, hand: [u32; 3], prototype: [u32; 3], goal: [u32; 3]) -> Bar {
    Bar { model, function, hand, prototype, goal }
}

/// At most the sum of the bar, and no column above 1.1 times it.
fn met(cost: &Cost, bar: [u32; 3]) -> bool {
    let columns = [cost.add, cost.mul, cost.div + cost.sqrt];
    let within = columns.iter().zip(bar).all(|(got, bar)| 10 * got <= 11 * bar);
    flops(cost) <= bar.iter().sum() && within
}

fn rows() -> &'static [Row] {
    static ROWS: OnceLock<Vec<Row>> = OnceLock::new();
    ROWS.get_or_init(all)
}

fn literals(model: &str, function: &str) -> &'static Cost {
    let row = rows().iter().find(|row| row.model == model && row.function == function && !row.params);
    &row.unwrap_or_else(|| panic!("no row for {model}, {function}")).after
}

fn written() -> String {
    let mut text = String::from(
        "# Operation ledger\n\n\
         Counts are `add/mul/div`, then what else there is. `tests/ledger.rs` derives every function anew and compares;\n\
         `UPDATE_LEDGER=1 cargo test -p multibody-tests --test ledger` writes this file. `new` is what the function alone\n\
         needs of `Model::new`.\n\n\
         | model | function | numbers | method | as derived | emitted | in `new` |\n\
         |---|---|---|---|---|---|---|\n",
    );
    for row in rows() {
        let numbers = if row.params { "`param`" } else { "`const`" };
        let new = if row.params { Written(&row.new).to_string() } else { String::new() };
        let (before, after) = (Written(&row.before), Written(&row.after));
        let Row { model, function, method, .. } = row;
        writeln!(text, "| {model} | {function} | {numbers} | {method} | {before} | {after} | {new} |").unwrap();
    }
    text += "\n## Once for a position\n\n\
             What `emit at` asks for: operations that are done once for a position, and those of each function behind them, beside\n\
             those of the function alone.\n\n\
             | model | function | alone | behind |\n\
             |---|---|---|---|\n";
    for once in once() {
        writeln!(text, "| {} | at |  | {} |", once.model, Written(&once.at)).unwrap();
        for Behind { model, function, alone, behind } in &once.functions {
            writeln!(text, "| {model} | {function} | {} | {} |", Written(alone), Written(behind)).unwrap();
        }
    }
    text += "\n## Limbs in packs\n\n\
             With `formulation { packs: Four }`: operations on packs of four or two, and on scalars beside them, sines counted as one with\n\
             their cosines. Functions that no packs pay for are left out.\n\n\
             | model | function | without packs | sum | on packs | on scalars |\n\
             |---|---|---|---|---|---|\n";
    for Packed { model, function, after, operations: [packed, scalar] } in packed() {
        let (after, sum) = (Written(&after), flops(&after) + after.sincos);
        writeln!(text, "| {model} | {function} | {after} | {sum} | {packed} | {scalar} |").unwrap();
    }
    text += "\n## In speeds\n\n\
             Forward dynamics with the velocities that `formulation { speeds: Auto }` takes, beside the rates of coordinates.\n\n\
             | model | in rates | sum | in speeds | sum | `position_rates` among them | speeds |\n\
             |---|---|---|---|---|---|---|\n";
    for InSpeeds { model, in_rates, in_speeds, speeds, position_rates } in in_speeds() {
        let speeds = if speeds.is_empty() { "rates of coordinates".to_owned() } else { speeds.join(", ") };
        let (rates, own, positions) = (Written(&in_rates), Written(&in_speeds), Written(&position_rates));
        let sums = [&in_rates, &in_speeds].map(flops);
        writeln!(text, "| {model} | {rates} | {} | {own} | {} | {positions} | {speeds} |", sums[0], sums[1]).unwrap();
    }
    text += "\n## Bars\n\n\
             Every number `const`; sums of additions, products, quotients and roots. Hand: a pruned recursion written by\n\
             hand (CasADi where there is none).\n\n\
             | model | function | emitted | sum | hand | prototype | goal |\n\
             |---|---|---|---|---|---|---|\n";
    for bar in &BARS {
        let cost = literals(bar.model, bar.function);
        let Bar { model, function, hand, prototype, goal } = bar;
        let column = |bar: &[u32; 3]| {
            let sign = if met(cost, *bar) { "met" } else { "open" };
            format!("{} {sign}", bar.iter().sum::<u32>())
        };
        let (hand, prototype, goal) = (column(hand), column(prototype), column(goal));
        let (after, sum) = (Written(cost), flops(cost));
        writeln!(text, "| {model} | {function} | {after} | {sum} | {hand} | {prototype} | {goal} |").unwrap();
    }
    text += "\n## Only what a scene requires\n\n\
             Mechanisms with things left out, beside what a person reduces them to by hand. Sums of additions, products,\n\
             quotients and roots; sines with their cosines.\n\n\
             | model | function | emitted | by hand | what is left by hand |\n\
             |---|---|---|---|---|\n";
    for case in CASES {
        let cost = literals(case.model, case.function);
        let Case { model, function, form, .. } = case;
        let (flops, sincos, hand, sines) = (flops(cost), cost.sincos, case.flops(), case.sincos());
        writeln!(text, "| {model} | {function} | {flops}, {sincos} | {hand}, {sines} | {form} |").unwrap();
    }
    text
}

#[test]
fn counts_are_those_of_the_ledger() {
    let file = path("ledger.md");
    let now = written();
    if std::env::var_os("UPDATE_LEDGER").is_some() {
        std::fs::write(&file, now).unwrap();
        return;
    }
    let committed = std::fs::read_to_string(&file).unwrap();
    let missing = |from: &str, to: &str| -> Vec<String> {
        from.lines().filter(|line| !to.lines().any(|other| other == *line)).map(str::to_owned).collect()
    };
    let (gone, came) = (missing(&committed, &now), missing(&now, &committed));
    assert!(
        now == committed,
        "the ledger has changed; if that is meant, UPDATE_LEDGER=1 and say why\nwas {gone:#?}\nis {came:#?}"
    );
}

/// What is chosen takes no more work than the rates do.
#[test]
fn chosen_speeds_are_no_dearer() {
    for row in in_speeds() {
        assert!(row.in_speeds.weight() <= row.in_rates.weight(), "{}", row.model);
    }
    let found = in_speeds();
    let of = |name: &str| found.iter().find(|row| row.model == name).unwrap();
    for name in ["rigid_body", "floating_body", "two_limbs", "three_limbs"] {
        assert!(flops(&of(name).in_speeds) < flops(&of(name).in_rates), "{name}");
    }
}

#[test]
fn bars_are_met() {
    let mut missed = Vec::new();
    for bar in &BARS {
        let cost = literals(bar.model, bar.function);
        let text = format!("{} {}: {} = {}", bar.model, bar.function, Written(cost), flops(cost));
        let sum = |bar: [u32; 3]| bar.iter().sum::<u32>();
        println!("{text}; hand {}, prototype {}, goal {}", sum(bar.hand), sum(bar.prototype), sum(bar.goal));
        for (what, limit) in [("hand recursion", bar.hand), ("prototype", bar.prototype)] {
            if !met(cost, limit) {
                missed.push(format!("{text}, above the {what}'s {limit:?}"));
            }
        }
    }
    assert!(missed.is_empty(), "{missed:#?}");
}

#[test]
fn one_sincos_per_coordinate() {
    for row in rows().iter().filter(|row| !row.function.contains("outputs")) {
        // A quaternion needs none at all. What Newton's method finds has one in a round, and one at its solution.
        let rounds = if row.model.ends_with("_newton") { 2 } else { 1 };
        assert!(row.after.sincos as usize <= rounds * row.dof, "{} {}", row.model, row.function);
    }
}

/// Sharing and factoring may only help.
#[test]
fn optimisation_costs_nothing() {
    for row in rows() {
        let (before, after) = (&row.before, &row.after);
        assert!(after.weight() <= before.weight(), "{} {}: {before:?} -> {after:?}", row.model, row.function);
    }
}

/// An input for each joint costs no more than the efforts, gears a product each.
#[test]
fn motors_cost_what_efforts_cost() {
    let efforts = flops(literals("puma560", "inverse_dynamics"));
    let direct = literals("puma560_direct", "inverse_dynamics");
    assert!(flops(direct) <= efforts + 6, "{} for {efforts}", Written(direct));
    let geared =
        rows().iter().find(|row| row.model == "puma560_geared" && row.function == "inverse_dynamics" && row.params);
    let geared = &geared.expect("a row").after;
    // Two systems of two, and a gear.
    assert!(flops(geared) <= efforts + 2 * 6 + 1, "{} for {efforts}", Written(geared));
}

/// Whipple's bicycle, all numbers parameters: other derivations take 1,900 to 2,367 operations for the mass matrix with what forces it, after
/// sharing. These are the bars that this project has set itself.
#[test]
fn a_bicycle_within_its_bars() {
    let of = |function: &str| {
        let row = rows().iter().find(|row| row.model == "bicycle, reduced" && row.function == function);
        flops(&row.unwrap_or_else(|| panic!("no row for {function}")).after)
    };
    let motion = of("forward_dynamics");
    let together = once().into_iter().find(|once| once.model == "bicycle, reduced").expect("what it asks for");
    let system = flops(&together.at) + together.functions.iter().map(|function| flops(&function.behind)).sum::<u32>();
    println!("forward dynamics {motion}, mass matrix with what forces it {system}");
    assert!(motion <= 1_500 && system <= 1_200, "{motion}, {system}");
}

/// Loops with multipliers cost what their zeros leave, where the user says that limbs keep away from their singular poses.
#[test]
fn limbs_that_stay_regular_absorb_their_equations() {
    for (model, most) in [("assumed_hybrid", 3_600), ("assumed_joints", 3_700)] {
        let cost = literals(&format!("stewart, {model}"), "forward_dynamics");
        assert!(flops(cost) <= most, "{model}: {} above {most}", Written(cost));
    }
}

/// What the macro has emitted into this build is what the ledger counts.
#[test]
fn compiled_models_are_those_of_the_ledger() {
    let mut compared = 0;
    let mut check = |model: &str, params: bool, costs: &[multibody::Cost]| {
        for row in rows().iter().filter(|row| row.model == model && row.params == params) {
            let cost = costs.iter().find(|cost| cost.function == row.function).unwrap();
            let counts = [cost.add, cost.mul, cost.div, cost.sqrt, cost.sincos, cost.other];
            let Cost { add, mul, div, sqrt, sincos, compare, other } = row.after;
            assert_eq!(counts, [add, mul, div, sqrt, sincos, other + compare], "{model} {}", row.function);
            compared += 1;
        }
    };
    check("double_pendulum", false, arms::double_pendulum::COSTS);
    check("cart5", false, arms::cart5::COSTS);
    check("puma560", false, arms::puma560::COSTS);
    check("panda", false, arms::panda::COSTS);
    check("cart5", true, arms::cart5_params::COSTS);
    check("puma560", true, arms::puma560_params::COSTS);
    check("panda", true, arms::panda_params::COSTS);
    check("chain", true, motion::chain::COSTS);
    check("top", true, motion::top::COSTS);
    check("cart_pole", true, small::cart_pole::COSTS);
    assert!(compared >= 50, "only {compared} rows");
}

/// What is done once for a position pays for itself where all that it is done for is asked for, and costs no function anything.
#[test]
fn work_for_a_position_is_shared() {
    for once in once() {
        let all: u32 = once.functions.iter().map(|function| function.behind.weight()).sum();
        let alone: u32 = once.functions.iter().map(|function| function.alone.weight()).sum();
        println!("{}: {} + {all} instead of {alone}", once.model, once.at.weight());
        assert!(once.at.weight() + all < alone, "{}", once.model);
        for Behind { model, function, alone, behind } in &once.functions {
            assert!(behind.weight() <= alone.weight(), "{model}, {function}: {behind:?} behind, {alone:?} alone");
        }
    }
}

/// Half of a symmetric matrix takes no operation that all of it doesn't.
#[test]
fn half_a_mass_matrix_costs_no_more() {
    let lower: Vec<&Row> = rows().iter().filter(|row| row.function == "mass_matrix_lower").collect();
    assert!(!lower.is_empty());
    for row in lower {
        let whole = literals(&row.model, "mass_matrix");
        assert!(row.after.weight() <= whole.weight(), "{}: {:?}, of {whole:?}", row.model, row.after);
    }
}

/// Four limbs do in packs what takes one of them, beside what they share.
#[test]
fn packs_save_operations() {
    let rows = packed();
    for function in ["forward_dynamics", "inverse_dynamics", "mass_matrix", "mass_matrix_lower", "bias"] {
        assert!(rows.iter().any(|row| row.model == "quadruped" && row.function == function), "{function} has no packs");
    }
    for Packed { model, function, after, operations } in rows {
        let (sum, packed) = ((flops(&after) + after.sincos) as usize, operations.iter().sum::<usize>());
        println!("{model}, {function}: {packed} instead of {sum}");
        assert!(10 * packed <= 9 * sum, "{model}, {function}: {packed} instructions instead of {sum}");
    }
}
