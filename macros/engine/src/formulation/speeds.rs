//! Stage `formulation`: what `speeds: Auto` stands for.
//!
//! In: a checked model. Out: the model with the speeds of the cheapest choice. Forward dynamics is derived and counted in rates of
//! coordinates and in components of velocities of bodies ([`Speeds`]; Kane and Levinson 1985, Mitiguy and Kane 1996). Of each choice
//! those are taken that are independent wherever loops and equations of velocities leave the mechanism, the clearest first, so what
//! wheels and blades hold is cleared; rates stay where there is nothing else. Rates come first among equals.

use crate::mechanics::analysis::{analyse, clear_speeds};
use crate::model::free_bodies::Speeds;
use crate::model::types::{Handling, Model, SpeedChoice};

use super::{Figures, choose, figures};

/// Choices beside the rates, as they are told.
const CHOICES: [(Speeds, &str); 4] = [
    (Speeds::Turns, "turns of bodies about their own axes"),
    (Speeds::TurnsOfCarrier, "turns of bodies about axes of what carries their last hinge"),
    (Speeds::TurnsAndTravels, "turns and travels of bodies along their own axes"),
    (Speeds::TurnsOnGround, "turns of bodies against the ground about their own axes"),
];

struct Choice {
    told: &'static str,
    model: Model,
    figures: Result<Figures, String>,
}

/// The model with its speeds, and a remark on the choice.
pub fn with_speeds(model: &Model) -> Model {
    let plain = Model { speed_choice: SpeedChoice::Written, ..model.clone() };
    let handling = match plain.handling {
        Handling::Auto => choose(&plain).0[0].clone(),
        _ => plain.handling.clone(),
    };
    let mut choices =
        vec![Choice { told: "rates of coordinates", figures: figures(&plain, &handling), model: plain.clone() }];
    let bodies = plain.free_bodies();
    for (speeds, told) in CHOICES {
        let Some(offered) = plain.with_speeds(&bodies, speeds) else { continue };
        let judged = Model { handling: handling.clone(), ..offered.clone() };
        let Some(clear) = clear_speeds(&judged) else { continue };
        let list = clear.into_iter().map(|k| offered.speeds[k].clone()).collect();
        let with = Model { speeds: list, ..plain.clone() }.alike_in_parts();
        if with.speeds.is_empty() || choices.iter().any(|known| known.model.has_speeds_of(&with)) {
            continue;
        }
        // Of what is not counted something may be known in rates alone.
        let whole = Model { handling: handling.clone(), ..with.clone() };
        let found = match analyse(&whole) {
            Ok(_) => figures(&with, &handling),
            Err(complaints) => {
                Err(complaints.into_iter().next().map(|complaint| complaint.message).unwrap_or_default())
            }
        };
        choices.push(Choice { told, figures: found, model: with });
    }
    let work = |choice: &Choice| choice.figures.as_ref().map_or(u32::MAX, |figures| figures.work);
    let best = (0..choices.len()).min_by_key(|&k| work(&choices[k])).unwrap_or(0);
    let remark = remark(&choices, best);
    let mut chosen = choices.swap_remove(best).model;
    chosen.speed_choice = SpeedChoice::Made;
    chosen.remarks.extend(remark);
    chosen
}

/// The choice beside the others; nothing where there were none.
fn remark(choices: &[Choice], best: usize) -> Option<String> {
    if choices.len() == 1 {
        return None;
    }
    let amount = |choice: &Choice| match &choice.figures {
        Ok(figures) => format!("{}: {}, work {}", choice.told, figures.operations.words(), figures.work),
        Err(reason) => format!("{}: refused, since {reason}", choice.told),
    };
    let others: Vec<String> = (0..choices.len()).filter(|&k| k != best).map(|k| amount(&choices[k])).collect();
    Some(format!("`speeds: Auto` takes {}; {}", amount(&choices[best]), others.join("; ")))
}
