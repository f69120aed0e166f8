//! The table of figures.

use std::fmt::Write;

use super::judge::Figures;

/// One function in one form.
pub(crate) fn line(figures: &Figures) -> String {
    let Figures { model, function, variant, scalar, greatest, componentwise, left_out, .. } = figures;
    let (median, numbers, states) = (figures.median(), numbers(figures), figures.states);
    format!(
        "{model} ({numbers}), {function}, {variant}, {scalar}: median {median:.2}, greatest over condition {greatest:.2} \
         (componentwise {componentwise:.2}), {states} states, {left_out} left out"
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
            median: worst.median.max(figures.median()),
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
    let mut text = format!(
        "# Accuracy\n\n\
         Every function of every model of the ledger at {states} random states, against its equations as derived, evaluated in\n\
         67 digits. `tests/accuracy` says what is measured and demands it; this page is written by\n\n\
         ```\n\
         STATES=1000 UPDATE_ACCURACY=1 cargo test --release -p multibody-tests --test accuracy -- --ignored\n\
         ```\n\n\
         *Median*: the greatest among the functions of the median error of a result, in units in the last place of the greatest.\n\
         *Greatest*: the greatest error in these units over the condition number. *By component*: the greatest error of a\n\
         single result, over what one rounding of each datum leaves in it, or of itself where that is more. States are left out\n\
         where the equations have no clear value (a root of what is negative, a comparison of equal numbers), and where 64 units\n\
         times the condition number are a tenth of the result.\n\n\
         Wanted are medians of at most 4 and greatest errors of at most 64. What misses that stands at the end.\n\n\
         ## By optimisation\n\n\
         | | {heading}\n|---|{rule}\n"
    );
    for variant in variants(figures) {
        let of = |scalar| Worst::of(figures.iter().filter(move |f| f.variant == variant && f.scalar == scalar)).cells();
        writeln!(text, "| {variant} | {} | {} |", of("f64"), of("f32")).unwrap();
    }
    write!(text, "\n## By model, as emitted\n\n| model | numbers | {heading}\n|---|---|{rule}\n").unwrap();
    let mut rest = figures;
    while let Some(first) = rest.first() {
        let is_other = |f: &Figures| (&f.model, f.params) != (&first.model, first.params);
        let (own, others) = rest.split_at(rest.iter().position(is_other).unwrap_or(rest.len()));
        let of = |scalar| Worst::of(own.iter().filter(move |f| f.variant == "all" && f.scalar == scalar)).cells();
        writeln!(text, "| {} | `{}` | {} | {} |", first.model, numbers(first), of("f64"), of("f32")).unwrap();
        rest = others;
    }
    text += "\n## Beyond the bounds\n\n";
    for missed in figures.iter().filter(|figures| !figures.within()) {
        writeln!(text, "- {}", line(missed)).unwrap();
    }
    text
}
