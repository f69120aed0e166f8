//! The table of figures.

use std::fmt::Write;

use super::judge::{Figures, Miss};

/// One function in one form.
pub(crate) fn line(figures: &Figures) -> String {
    let Figures {
        model,
        function,
        variant,
        scalar,
        greatest,
        componentwise,
        left_out,
        at_worst,
        operations,
        condition,
        ..
    } = figures;
    let (median, numbers, states) = (figures.median, numbers(figures), figures.states);
    format!(
        "{model} ({numbers}), {function}, {variant}, {scalar}: median {median:.2} where the condition is {condition:.1}, greatest over condition {greatest:.2} \
         at one of {at_worst:.0} (componentwise {componentwise:.2}), over roundings {operations:.2}, {states} states, {left_out} left out"
    )
}

fn numbers(figures: &Figures) -> &'static str {
    if figures.params { "param" } else { "const" }
}

/// In the order in which they come.
pub(crate) fn variants(figures: &[Figures]) -> Vec<&str> {
    let mut names: Vec<&str> = Vec::new();
    for figures in figures {
        if !names.contains(&&*figures.variant) {
            names.push(&figures.variant);
        }
    }
    names
}

/// The greatest of medians, the greatest errors, the share of states that are left out.
struct Worst {
    median: f64,
    greatest: f64,
    componentwise: f64,
    left_out: usize,
    states: usize,
}

impl Worst {
    fn of<'a>(figures: impl Iterator<Item = &'a Figures>) -> Worst {
        let nothing = Worst { median: 0.0, greatest: 0.0, componentwise: 0.0, left_out: 0, states: 0 };
        figures.fold(nothing, |worst, figures| Worst {
            median: worst.median.max(figures.median),
            greatest: worst.greatest.max(figures.greatest),
            componentwise: worst.componentwise.max(figures.componentwise),
            left_out: worst.left_out + figures.left_out,
            states: worst.states + figures.left_out + figures.states,
        })
    }

    fn cells(&self) -> String {
        let Worst { median, greatest, componentwise, left_out, states } = self;
        let share = 100.0 * *left_out as f64 / (*states).max(1) as f64;
        format!("{median:.1} | {greatest:.1} | {componentwise:.1} | {share:.1}")
    }
}

/// The whole page.
pub(crate) fn written(figures: &[Figures], states: usize) -> String {
    let heading =
        "median f64 | greatest | by component | left out, % | median f32 | greatest | by component | left out, % |";
    let rule = "---|---|---|---|---|---|---|---|";
    let mut text = summary(figures, states);
    write!(text, "\n## By optimisation\n\n| | {heading}\n|---|{rule}\n").unwrap();
    for variant in variants(figures) {
        let of = |scalar| Worst::of(figures.iter().filter(move |f| f.variant == variant && f.scalar == scalar)).cells();
        writeln!(text, "| {variant} | {} | {} |", of("f64"), of("f32")).unwrap();
    }
    write!(text, "\n## By model, as emitted\n\n| model | numbers | states | {heading}\n|---|---|---|{rule}\n").unwrap();
    for own in figures.chunk_by(|a, b| (&a.model, a.params) == (&b.model, b.params)) {
        let of = |scalar| Worst::of(own.iter().filter(move |f| f.variant == "all" && f.scalar == scalar)).cells();
        let states = own.iter().map(|f| f.states + f.left_out).max().unwrap_or(0);
        let (model, numbers) = (&own[0].model, numbers(&own[0]));
        writeln!(text, "| {model} | `{numbers}` | {states} | {} | {} |", of("f64"), of("f32")).unwrap();
    }
    text += &misses(figures);
    text
}

/// What is measured and how, what is met, and what is missed.
fn summary(figures: &[Figures], states: usize) -> String {
    let (functions, forms, count) = (functions(figures).len(), variants(figures).len(), figures.len());
    let met = figures.iter().filter(|f| f.miss().is_none()).count();
    let emitted = || figures.iter().filter(|f| f.variant == "all");
    let (all, good) = (emitted().count(), emitted().filter(|f| f.miss().is_none()).count());
    let left_out: usize = figures.iter().map(|f| f.left_out).sum();
    let tried: usize = figures.iter().map(|f| f.left_out + f.states).sum();
    let share = 100.0 * left_out as f64 / tried.max(1) as f64;
    let most = figures.iter().map(|f| f.operations).fold(0.0, f64::max);
    format!(
        "# Accuracy\n\n\
         The {functions} functions of all models of the [operation ledger](../tests/ledger.md) are run in `f64` and `f32` at {states}\n\
         random states, in {forms} forms: as emitted, without any optimisation, with fused products and sums, with limbs in packs, and\n\
         with each optimisation left out. The truth is the equations as derived, before any optimisation, evaluated with 224 bits from\n\
         the numbers that the functions read. State n, from 0, is drawn from the seed 7919 n + 104729 k, where k is the first attempt,\n\
         0 to 5, at which the equations have a clear value; its numbers are of single precision, so that both scalars start from the\n\
         same. Wanted are a median error of at most 4 units in the last place (ulp), and a greatest error of at most 64 ulp times the\n\
         mixed condition number of the data. {met} of {count} combinations of function, form and scalar meet both, of those that are\n\
         emitted {good} of {all}. No error of any form is more than {most:.2} times what one rounding of each operation of the equations\n\
         as derived may leave. {share:.1} % of all evaluations are left out, for reasons that stand below{}.\n\n\
         {}\n\
         `tests/accuracy` says more of the measure. This page is written by\n\n\
         ```\n\
         STATES={states} UPDATE_ACCURACY=1 cargo test --release -p multibody-tests --test accuracy -- --ignored\n\
         ```\n\n\
         *Median*: the greatest among the functions of the median error of a result, in ulp of the greatest result of its kind.\n\
         *Greatest*: the greatest error in these units over the condition number. *By component*: the greatest error of a\n\
         single result, over what one rounding of each datum leaves in it, or of itself where that is more. States are left out\n\
         where loops don't close, where the equations have no clear value (a root of what is negative, a comparison of equal numbers),\n\
         where a rank has fallen, which the function tells, and where 64 ulp times the condition number are a tenth of the result.\n",
        mostly_left_out(figures),
        classes(figures)
    )
}

/// Emitted functions of which little is known.
fn mostly_left_out(figures: &[Figures]) -> String {
    let of = figures.iter().filter(|f| f.variant == "all" && f.left_out > f.states);
    let names: Vec<String> = of
        .map(|f| format!("{}, {} in `{}` ({} of {})", f.model, f.function, f.scalar, f.left_out, f.left_out + f.states))
        .collect();
    if names.is_empty() { String::new() } else { format!("; most states of {}", names.join("; ")) }
}

/// What each class of misses is.
const CLASSES: [(Miss, &str, &str); 3] = [
    (
        Miss::Data,
        "data",
        "The median error is above 4 ulp where the median condition number is above 1, and below 4 ulp times that: no algorithm knows \
         the results better from rounded data. These are linkages in closed form or by Newton's method, whose lengths and angles are the data, and long chains",
    ),
    (
        Miss::Equations,
        "elimination",
        "Accelerations, multipliers and projections of loops that keep multipliers are found by elimination in an order that is \
         fixed when the code is written, and by a Schur complement (G M^-1 G^T, for projections G G^T), which squares the condition of the \
         Jacobian. The condition number is that of masses, lengths and angles, and does not see that. So the method loses these \
         digits, not the problem, and not an optimisation: without any the same is lost. In `f64` the whole system with complete pivots was \
         within 0.9 ulp times the condition number in Sarrus' linkage and 4 in the Delta robot at 25 states, where the emitted forward dynamics \
         came to 1227 and 148; `linear::least_norm`, which forms no squares, within 1.7 for the Delta's projection at 30 states, where \
         `least_displacement` came to 5915. With roll, pitch and yaw for each body of the platform, complete pivots too lost up to 326 at 6 states: \
         there the system itself is near singular. `cart5_driven`, an open chain, is here for 65 ulp times the condition number in the form without \
         optimisation alone",
    ),
    (
        Miss::Form,
        "form",
        "More is lost than one rounding of each operation of the equations as derived may leave: an error of a pass",
    ),
];

/// A paragraph for each class of misses.
fn classes(figures: &[Figures]) -> String {
    let mut text = String::from("What misses a bound is of one of these classes:\n\n");
    for (class, name, why) in CLASSES {
        let of = || figures.iter().filter(|f| f.miss() == Some(class));
        let most = |of_one: fn(&Figures) -> f64| of().map(of_one).fold(0.0, f64::max);
        if of().next().is_none() {
            writeln!(text, "- *{name}*: none. {why}.").unwrap();
            continue;
        }
        let mut models: Vec<&str> = of().map(|f| &*f.model).collect();
        models.dedup();
        writeln!(
            text,
            "- *{name}*: {} combinations, {} of them emitted; medians up to {:.1} ulp where the median condition number is up to \
             {:.0}, greatest errors up to {:.0} ulp times the condition number. {why}. Models: {}.",
            of().count(),
            of().filter(|f| f.variant == "all").count(),
            most(|f| f.median),
            most(|f| f.condition),
            most(|f| f.greatest),
            models.join("; ")
        )
        .unwrap();
    }
    text
}

fn key(figures: &Figures) -> (&str, bool, &str) {
    (&figures.model, figures.params, &figures.function)
}

/// All forms of each function, however it was derived for them.
fn functions(figures: &[Figures]) -> Vec<Vec<&Figures>> {
    let mut found: Vec<Vec<&Figures>> = Vec::new();
    for figures in figures {
        match found.iter_mut().find(|own| key(own[0]) == key(figures)) {
            Some(own) => own.push(figures),
            None => found.push(vec![figures]),
        }
    }
    found
}

/// A row for each function and scalar that misses a bound in some form.
fn misses(figures: &[Figures]) -> String {
    let mut text = String::from(
        "\n## Beyond the bounds\n\n\
         Forms: how many miss a bound, of how many. *Emitted* and *plain* (without any optimisation): median, and greatest error over the\n\
         condition number. *Any*: the greatest of all forms, and the condition number at that state. *Roundings*: the greatest error of any\n\
         form over what one rounding of each operation of the equations as derived leaves.\n\n\
         | model | numbers | function | | class | forms | condition, median | emitted | plain | any | roundings |\n\
         |---|---|---|---|---|---|---|---|---|---|---|\n",
    );
    for own in functions(figures) {
        for scalar in ["f64", "f32"] {
            let forms: Vec<&Figures> = own.iter().copied().filter(|f| f.scalar == scalar).collect();
            let missed: Vec<Miss> = forms.iter().filter_map(|f| f.miss()).collect();
            let (Some(first), false) = (forms.first(), missed.is_empty()) else { continue };
            let class =
                CLASSES.iter().rev().find(|(class, ..)| missed.contains(class)).map_or("", |&(_, name, _)| name);
            let of = |name: &str| {
                let found = forms.iter().find(|f| f.variant == name);
                found.map_or_else(String::new, |f| format!("{:.1}, {:.1}", f.median, f.greatest))
            };
            let worst = forms.iter().max_by(|a, b| a.greatest.total_cmp(&b.greatest)).unwrap_or(first);
            let most = forms.iter().map(|f| f.operations).fold(0.0, f64::max);
            writeln!(
                text,
                "| {} | `{}` | {} | {scalar} | {class} | {} of {} | {:.1} | {} | {} | {:.1} ({}) at {:.0} | {most:.3} |",
                first.model,
                numbers(first),
                first.function,
                missed.len(),
                forms.len(),
                first.condition,
                of("all"),
                of("none"),
                worst.greatest,
                worst.variant,
                worst.at_worst
            )
            .unwrap();
        }
    }
    text
}
