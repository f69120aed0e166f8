//! Stage `emit`: what the ways to close loops cost, in sentences.
//!
//! In: the structure with its advice. Out: a sentence for each thing that there is to say.

use crate::emit::layout::Layout;
use crate::mechanics::loops::advice::{Advice, Closing, Figures};

use super::cost;

pub(super) fn items(layout: &Layout<'_>) -> Vec<String> {
    let Some(advice) = &layout.structure.advice else { return Vec::new() };
    choice(advice).into_iter().collect()
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
    format!("{} {how}, work {}", cost(&figures.operations), figures.work)
}
