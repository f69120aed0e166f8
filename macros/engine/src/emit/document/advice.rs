//! Stage `emit`: what the ways to close loops cost, in sentences.
//!
//! In: the structure with its advice, the programs. Out: a sentence for each thing that there is to say.

use crate::contracts::function::FunctionKind;
use crate::emit::Context;
use crate::mechanics::loops::advice::{Advice, Assumable, Closing, Figures, Pivoted, Solvable};
use crate::mechanics::loops::structure::Row;

use super::alike;
use super::loops::quoted;

/// As many names are told.
const MOST_NAMES: usize = 18;

pub(super) fn items(context: &Context<'_>) -> Vec<String> {
    let Some(advice) = &context.layout.structure.advice else { return Vec::new() };
    let mut items: Vec<String> = choice(advice).into_iter().collect();
    items.extend(pivoted(context));
    if let (Some((assumable, figures)), Some(own)) = (&advice.assumable, &advice.own) {
        items.push(assumption(assumable, figures, own));
    }
    if let (Some((solvable, figures)), Some(own)) = (&advice.solvable, &advice.own) {
        items.push(match &advice.other {
            Some(Ok(other)) if own.closing == Closing::Multipliers => {
                let choice = if figures.reduces(own) { "be `Reduced`" } else { "still be `Multipliers`" };
                format!("{}; `constraints: Auto` would {choice} with that", formulas(solvable, figures, other))
            }
            _ => formulas(solvable, figures, own),
        });
    }
    items
}

/// The choice beside the other one.
fn choice(advice: &Advice) -> Option<String> {
    let own = advice.own.as_ref()?;
    let what = if advice.is_forward { "forward dynamics takes" } else { "all functions together take" };
    let head = if advice.is_chosen { format!("`constraints: Auto` is `{}`: ", word(own)) } else { String::new() };
    let rest = match &advice.other {
        None => String::new(),
        Some(Ok(other)) => format!("; {}", amount(other)),
        Some(Err(reason)) => {
            let refused = if own.closing == Closing::Multipliers { "Reduced" } else { "Multipliers" };
            format!("; `{refused}` is refused, since {reason}")
        }
    };
    Some(format!("{head}{what} {}{rest}", amount(own)))
}

fn word(figures: &Figures) -> &'static str {
    match figures.closing {
        Closing::ClosedForm | Closing::Newton => "Reduced",
        Closing::Multipliers => "Multipliers",
    }
}

/// `345/678/9 1 sqrt by multipliers, work 1200`
fn amount(figures: &Figures) -> String {
    let how = match figures.closing {
        Closing::ClosedForm => "in closed form",
        Closing::Newton => "by Newton's method with all its rounds",
        Closing::Multipliers => "with multipliers",
    };
    format!("{} {how}, work {}", figures.operations.words(), figures.work)
}

/// What becomes of equations with multipliers in forward dynamics.
fn pivoted(context: &Context<'_>) -> Option<String> {
    let function = context.function(FunctionKind::ForwardDynamics)?;
    let Pivoted { absorbed, cores } = context.layout.structure.pivoted.get(function.candidate)?;
    let left: usize = cores.iter().map(Vec::len).sum();
    let all = absorbed.len() + left;
    if all == 0 {
        return None;
    }
    let name = |row: &Row| quoted(&context.layout.row(*row));
    let [gone, left_over] = apart([absorbed.iter().map(name).collect(), cores.iter().flatten().map(name).collect()]);
    let mut sentence = match absorbed.len() {
        0 => format!("none of the {all} equations with multipliers is absorbed by coordinates of its limb"),
        n => format!("of {all} equations with multipliers {n} are absorbed by coordinates of their limbs: {gone}"),
    };
    if left > 0 {
        let sizes = listed_sizes(cores);
        sentence += &format!("; {left} are left to pivoted solutions of {sizes}: {left_over}");
    }
    Some(sentence)
}

/// Names of two kinds, each once, where `legs[_]` is one that has the same name in all of both.
fn apart(kinds: [Vec<String>; 2]) -> [String; 2] {
    const MARKS: [&str; 2] = ["0 ", "1 "];
    let marked =
        kinds.iter().zip(MARKS).flat_map(|(names, mark)| names.iter().map(move |name| format!("{mark}{name}")));
    let unique = alike::once(marked.collect());
    MARKS.map(|mark| {
        let names: Vec<&str> = unique.iter().filter_map(|name| name.strip_prefix(mark)).collect();
        match names.len().checked_sub(MOST_NAMES) {
            None | Some(0) => names.join(", "),
            Some(more) => format!("{} and {more} more", names[..MOST_NAMES].join(", ")),
        }
    })
}

/// `2 systems with 3 unknowns and 1 with 4`
fn listed_sizes(cores: &[Vec<Row>]) -> String {
    let mut sizes: Vec<(usize, usize)> = Vec::new();
    for core in cores {
        match sizes.iter_mut().find(|known| known.0 == core.len()) {
            Some(known) => known.1 += 1,
            None => sizes.push((core.len(), 1)),
        }
    }
    let counted = |n: usize, what: &str| format!("{n} {what}{}", if n == 1 { "" } else { "s" });
    let sizes =
        sizes.iter().map(|&(size, count)| format!("{} with {}", counted(count, "system"), counted(size, "unknown")));
    sizes.collect::<Vec<_>>().join(", ")
}

fn assumption(assumable: &[Assumable], with: &Figures, own: &Figures) -> String {
    let lines: Vec<String> =
        assumable.iter().map(|one| line(&format!("assume {};", one.condition), one.part.as_deref())).collect();
    let (holds, lets) = if lines.len() == 1 { ("it holds", "lets") } else { ("they hold", "let") };
    format!("where {holds}, {} {lets} more equations be absorbed: {}", lines.join(" and "), change(with, own))
}

/// Formulas that leave Newton's method less to find.
fn formulas(solvable: &[Solvable], with: &Figures, own: &Figures) -> String {
    let lines: Vec<String> = solvable.iter().map(|one| line(&one.text, one.part.as_deref())).collect();
    let leaves = if lines.len() == 1 { "leaves" } else { "leave" };
    let how = match with.closing {
        Closing::Newton => "less to Newton's method",
        Closing::ClosedForm | Closing::Multipliers => "nothing to Newton's method",
    };
    format!(
        "on the branch where the mechanism stands by default, {} {leaves} {how}: {}",
        lines.join(" and "),
        change(with, own)
    )
}

/// As the user writes it, and where.
fn line(text: &str, part: Option<&str>) -> String {
    match part {
        Some(part) => format!("`{text}` in `{part}`"),
        None => format!("`{text}`"),
    }
}

fn change(with: &Figures, own: &Figures) -> String {
    let [now, before] = [with, own].map(|figures| figures.operations.words());
    format!("{now} in place of {before}, work {} in place of {}", with.work, own.work)
}
