//! Stage `mechanics`: which equations a group needs, and how sure that is.
//!
//! In: what was found about a group. Out: [`Ranked`]. The rank is the greatest at any closed configuration. An equation is
//! left out if it depends on others at every closed configuration that was found, and these agree: they have the same
//! rank, and the same equations carry it. Where they don't (a loop that can collapse has branches on which less is left to
//! hold), or where all equations can be met beside zero at once and so are independent somewhere, only what depends on
//! others at points that close nothing is left out, which is so everywhere. The multipliers' rank sees to the rest. An
//! exception is what vanishes wherever the others do: a distance along the normal of a plane that others hold is constant
//! as soon as they are closed, and changes where they are not.

use super::configurations::{Configuration, Found};
use super::rank;

pub(super) struct Ranked {
    pub rank: usize,
    /// The least at any: a coupler on three equal parallel bars moves, though it can also be put together so that it can't.
    pub least: usize,
    /// Rows that carry the rank.
    pub independent: Vec<usize>,
    /// Rows that multipliers keep, before other parameters are looked at.
    pub staying: Vec<usize>,
    /// Rows and formulas that are not implied by those before them.
    pub kept: Vec<usize>,
    /// Whether everything agrees.
    pub agreed: bool,
    /// Whether equations are independent somewhere near, but at no closed configuration that was found.
    pub elusive: bool,
    /// What it rests on.
    pub evidence: String,
}

/// Keeps the configurations of the greatest rank in `found`. `rows` are places of equations, those first that are kept rather than others,
/// `formulas` those of formulas.
/// `follows` tells whether all rows vanish wherever some of them do.
pub(super) fn ranked(
    found: &mut Found,
    rows: &[usize],
    formulas: &[usize],
    follows: impl Fn(&[usize]) -> bool,
) -> Ranked {
    let closed = found.configurations.iter().any(|configuration| configuration.closed);
    let ranks: Vec<usize> = found.configurations.iter().map(|c| rank::of(&c.jacobian, rows)).collect();
    let greatest = ranks.iter().copied().max().unwrap_or(0);
    let least = ranks.iter().copied().min().unwrap_or(0);
    let beside = found.beside.iter().map(|jacobian| rank::of(jacobian, rows)).max().unwrap_or(0);
    let everywhere: Vec<&[Vec<f64>]> = found.configurations.iter().map(|c| c.jacobian.as_slice()).collect();
    let mut order = rows.to_vec();
    let mut union = rank::kept(&everywhere, &order);
    let same = ranks.iter().all(|&rank| rank == greatest);
    let mut agreed = closed && same && union.len() == greatest;
    if agreed && beside > greatest && !follows(&union) {
        // A distance may follow from directions, and these not from it. Beside formulas the declared order counts.
        order.reverse();
        union = rank::kept(&everywhere, &order);
        agreed = formulas.is_empty() && union.len() == greatest && follows(&union);
        union.sort_unstable();
    }
    let mut staying = if agreed {
        union.clone()
    } else {
        let others = found.anywhere.iter().chain(&found.beside).map(Vec::as_slice);
        let all: Vec<&[Vec<f64>]> = everywhere.into_iter().chain(others).collect();
        rank::kept(&all, rows)
    };
    staying.sort_unstable();
    let mut numbers = ranks.iter();
    let count = found.configurations.len();
    let configurations = &mut found.configurations;
    configurations.retain(|_| numbers.next() == Some(&greatest));
    let regular: Vec<&[Vec<f64>]> = configurations.iter().map(|c| c.jacobian.as_slice()).collect();
    let mut independent = rank::kept(&regular, if agreed { &order } else { rows });
    if independent.len() > greatest {
        independent = rank::kept(&regular[..1], rows);
    }
    independent.sort_unstable();
    let kept = if formulas.is_empty() {
        independent.clone()
    } else {
        let mut all: Vec<usize> = rows.iter().chain(formulas).copied().collect();
        all.sort_unstable();
        rank::kept(&regular, &all)
    };
    let followed = agreed && beside > greatest;
    let mut evidence = evidence(configurations, count, &ranks, if followed { 0 } else { beside });
    if followed {
        evidence += "; what is left out vanishes wherever the others do";
    }
    Ranked {
        rank: greatest,
        least,
        independent,
        staying,
        kept,
        agreed,
        elusive: beside > greatest && !agreed,
        evidence,
    }
}

impl Ranked {
    /// Which equations follow from the others changes with the pose: all stay that say anything at some.
    pub(super) fn keep_all(&mut self, found: &Found, rows: &[usize]) {
        let jacobians =
            || found.configurations.iter().map(|one| &one.jacobian).chain(&found.anywhere).chain(&found.beside);
        let says = |row: &usize| jacobians().any(|jacobian| jacobian[*row].iter().any(|&x| x != 0.0));
        self.staying = rows.iter().copied().filter(says).collect();
        self.agreed = false;
        self.evidence = "which of them follow from others changes with the pose".to_owned();
    }
}

fn evidence(configurations: &[Configuration], count: usize, ranks: &[usize], beside: usize) -> String {
    let (least, most) = (ranks.iter().min().copied().unwrap_or(0), ranks.iter().max().copied().unwrap_or(0));
    if least < most {
        return format!("of {count} closed configurations some leave {least} equations independent and some {most}");
    }
    if beside > most {
        return format!(
            "{most} are independent at {count} closed configurations, but {beside} where all are off by a little"
        );
    }
    let kept = configurations.iter().map(|c| c.gap.0).fold(f64::INFINITY, f64::min);
    let left = configurations.iter().map(|c| c.gap.1).fold(0.0, f64::max);
    format!("at {count} closed configurations singular values are at least {kept:.0e} and then at most {left:.0e}")
}
