//! Stage `solve`: pairs of joint groups, taken out of the cycle.
//!
//! In: the cycle, opened at one unknown motion. Out: every equation that holds that unknown and no other one. Two groups
//! of neighbouring unknowns are taken out; what they leave free between them is measured across the unknown and along
//! the rest of the cycle, and both must agree (Woernle 1988). With one group alone its points and directions are known
//! on both sides of the unknown: the triangular part.

use crate::dynamics::tree::{Motion, Orientation};
use crate::symbolic::graph::{Graph, Scalar, ScalarNode, Vector};

use super::chain::{Link, Side};
use super::elements::{Features, JointGroup};
use super::measures::{Form, Measure, View};
use super::primitives::Primitive;

/// Where an equation comes from: runs of links in the opened cycle, and what is measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Source {
    /// A direction, by its number, of one group that is taken out.
    Direction(Run, usize),
    Point(Run),
    /// A point's place along the motion's axis.
    Along(Run),
    /// The sum of all angles.
    Winding,
    /// The first group is met first when going right from the unknown.
    Pair(Run, Run, Measure),
}

/// Links taken out: the first, and the one behind the last. None at all is a place between two links.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Run {
    from: usize,
    to: usize,
}

/// An equation and where it comes from.
#[derive(Clone, Copy, Debug)]
pub(super) struct Candidate {
    pub(super) primitive: Primitive,
    pub(super) source: Source,
}

impl Candidate {
    /// For the report.
    pub(super) fn describe(&self) -> String {
        let what = match self.source {
            Source::Direction(..) => "a direction on both sides",
            Source::Point(_) => "a point on both sides",
            Source::Along(_) => "a point along the axis",
            Source::Winding => "the sum of all angles",
            Source::Pair(_, _, measure) => measure.describe(),
        };
        format!("{what}: {}", self.primitive.describe())
    }
}

/// The cycle opened at one unknown motion: the rest of it, from its right side round to its left.
pub(super) struct Opened<'c> {
    pub(super) motion: Motion,
    pub(super) rest: &'c [Link],
    pub(super) winding: Option<Winding>,
    /// Whether one turn more is another solution.
    pub(super) counted: bool,
}

/// The sum of the cycle's angles, where it holds the unknown.
#[derive(Clone, Copy)]
pub(super) enum Winding {
    /// It holds other unknowns that are open.
    Open,
    /// slope x + rest = 0
    Known { slope: Scalar, rest: Scalar },
}

/// A group taken out, as seen from the unknown.
pub(super) struct Taken {
    pub(super) run: Run,
    pub(super) features: Features,
    /// On the right of the motion, going back to it from the group's left side.
    pub(super) near: View,
    /// On the left of the motion, going on to it from the group's right side.
    pub(super) far: View,
}

impl<'c> Opened<'c> {
    /// A cycle as it is seen from several unknowns that are taken out together.
    pub(super) fn around(rest: &'c [Link]) -> Opened<'c> {
        Opened { motion: Motion::Ball(Orientation::Quaternion([Scalar::ZERO; 4])), rest, winding: None, counted: false }
    }

    /// All equations in this unknown alone.
    pub(super) fn candidates(&self, g: &mut Graph) -> Vec<Candidate> {
        let groups = self.groups(g);
        let mut list = Vec::new();
        let mut add = |source: Source, primitive: Option<Primitive>| {
            // Where turns count, nothing serves that gives an angle up to whole turns: it would be off by some of them.
            let primitive = primitive.filter(|primitive| !(primitive.is_angle() && self.counted));
            list.extend(primitive.map(|primitive| Candidate { primitive, source }));
        };
        add(Source::Winding, self.by_winding());
        for group in &groups {
            for k in 0..group.features.directions.len() {
                add(Source::Direction(group.run, k), self.direction(g, group, k));
            }
            add(Source::Point(group.run), self.point(g, group));
            add(Source::Along(group.run), self.along(g, group));
        }
        for (first, second, measure) in pairs(&groups) {
            let primitive = self.between(g, first, second, measure);
            add(Source::Pair(first.run, second.run, measure), primitive);
        }
        list
    }

    /// All groups that can be taken out.
    pub(super) fn groups(&self, g: &mut Graph) -> Vec<Taken> {
        self.runs(g).into_iter().map(|run| self.take(g, run)).collect()
    }

    /// One of these equations, derived alone.
    pub(super) fn derive(&self, g: &mut Graph, source: Source) -> Option<Primitive> {
        match source {
            Source::Direction(run, k) => {
                let group = self.take(g, run);
                self.direction(g, &group, k)
            }
            Source::Point(run) => {
                let group = self.take(g, run);
                self.point(g, &group)
            }
            Source::Along(run) => {
                let group = self.take(g, run);
                self.along(g, &group)
            }
            Source::Winding => self.by_winding(),
            Source::Pair(first, second, measure) => {
                let (first, second) = (self.take(g, first), self.take(g, second));
                self.between(g, &first, &second, measure)
            }
        }
    }

    /// All runs of neighbouring unknowns that leave something fixed, and nothing on either side of the unknown.
    fn runs(&self, g: &mut Graph) -> Vec<Run> {
        let end = self.rest.len();
        let mut list = vec![Run { from: 0, to: 0 }, Run { from: end, to: end }];
        for from in 0..end {
            if !matches!(self.rest[from], Link::Free { .. }) {
                continue;
            }
            let mut group = JointGroup::new();
            for (at, &link) in self.rest.iter().enumerate().skip(from) {
                group.append(g, link);
                if group.is_useless() {
                    break;
                }
                if matches!(link, Link::Free { .. }) {
                    list.push(Run { from, to: at + 1 });
                }
            }
        }
        list
    }

    fn by_winding(&self) -> Option<Primitive> {
        match self.winding? {
            Winding::Known { slope, rest } => Some(Primitive::Linear { slope, one: rest }),
            Winding::Open => None,
        }
    }

    pub(super) fn take(&self, g: &mut Graph, run: Run) -> Taken {
        let mut group = JointGroup::new();
        for &link in &self.rest[run.from..run.to] {
            group.append(g, link);
        }
        let features = group.features(g);
        let near = View::new(&features, Side::Left).carry_all(g, &self.rest[..run.from], Side::Left);
        let far = View::new(&features, Side::Right).carry_all(g, &self.rest[run.to..], Side::Right);
        Taken { run, features, near, far }
    }

    fn direction(&self, g: &mut Graph, group: &Taken, k: usize) -> Option<Primitive> {
        let (w, v) = (*group.near.directions().get(k)?, *group.far.directions().get(k)?);
        match self.motion {
            Motion::Revolute(axis) | Motion::Screw(axis, _) => turn(g, axis, w?, v?),
            _ => None,
        }
    }

    fn point(&self, g: &mut Graph, group: &Taken) -> Option<Primitive> {
        match self.motion {
            Motion::Revolute(axis) => turn(g, axis, group.near.point()?, group.far.point()?),
            _ => None,
        }
    }

    fn along(&self, g: &mut Graph, group: &Taken) -> Option<Primitive> {
        let (axis, slope) = match self.motion {
            Motion::Prismatic(axis) => (axis, Scalar::ONE),
            Motion::Screw(axis, pitch) => (axis, pitch),
            _ => return None,
        };
        let (w, v) = (g.component(group.near.point()?, axis), g.component(group.far.point()?, axis));
        Some(Primitive::Linear { slope, one: g.sub(w, v) })
    }

    /// Two groups taken out: what is measured across the unknown is what is measured along the rest.
    fn between(&self, g: &mut Graph, first: &Taken, second: &Taken, measure: Measure) -> Option<Primitive> {
        let across = measure.value(g, &second.far, Some(self.motion), &first.near)?;
        if across.is_constant() {
            return None;
        }
        let along = self.along_rest(g, first, second, measure)?;
        classify(g, across, along)
    }

    /// What is measured between two groups along the rest of the cycle.
    pub(super) fn along_rest(&self, g: &mut Graph, first: &Taken, second: &Taken, measure: Measure) -> Option<Scalar> {
        let (left, right) = (View::new(&second.features, Side::Left), View::new(&first.features, Side::Right));
        let links = &self.rest[first.run.to..second.run.from];
        let mut at = |place: usize| {
            let far = left.carry_all(g, &links[place..], Side::Left);
            let near = right.carry_all(g, &links[..place], Side::Right);
            measure.value(g, &far, None, &near)
        };
        // A ball's point is carried to the other group, so that it is seen in a frame that later steps use too.
        let ball = |run: Run| matches!(self.rest[run.from..run.to], [Link::Free { motion: Motion::Ball(_), .. }]);
        let places = if ball(first.run) { [links.len(), 0] } else { [0, links.len()] };
        let along = at(places[0]).or_else(|| at(places[1]))?;
        Some(along.one)
    }
}

/// Two groups at a time with what can be measured between them. The first one is met first when going right.
pub(super) fn pairs(groups: &[Taken]) -> impl Iterator<Item = (&Taken, &Taken, Measure)> {
    let empty = |run: Run| run.from == run.to;
    let firsts = groups.iter().filter(|group| !group.near.is_empty());
    let both = firsts.flat_map(move |first| {
        let seconds = groups.iter().filter(|group| !group.far.is_empty());
        // Two empty ones: the directions of one frame, which need no pair.
        let apart = move |second: &&Taken| second.run.from >= first.run.to && !(empty(first.run) && empty(second.run));
        seconds.filter(apart).map(move |second| (first, second))
    });
    both.flat_map(|(first, second)| {
        let measures = Measure::all(&second.features, &first.features);
        measures.into_iter().map(move |measure| (first, second, measure))
    })
}

fn turn(g: &mut Graph, axis: usize, w: Vector, v: Vector) -> Option<Primitive> {
    let plane = [1, 2].map(|k| (axis + k) % 3);
    let (near, far) = (plane.map(|k| g.component(w, k)), plane.map(|k| g.component(v, k)));
    let zero = [Scalar::ZERO; 2];
    (near != zero && far != zero).then_some(Primitive::Turn { near, far })
}

/// What is measured across the unknown, less what is measured elsewhere, as an equation that can be solved.
fn classify(g: &mut Graph, form: Form, other: Scalar) -> Option<Primitive> {
    let zero = Scalar::ZERO;
    if form.turns() {
        if form.travel != zero || form.square != zero {
            return None;
        }
        // Nothing is left of a length of a link that all terms have in common.
        let scale = common_factor(g, form.cos, form.sin).unwrap_or(Scalar::ONE);
        let [a, b] = [form.cos, form.sin].map(|s| g.mul(s, scale));
        let c = difference(g, other, form.one, scale);
        return Some(Primitive::Root { a, b, c });
    }
    if form.square == zero {
        let one = difference(g, form.one, other, Scalar::ONE);
        return (form.travel != zero).then_some(Primitive::Linear { slope: form.travel, one });
    }
    // Squares of distances come halved.
    let two = g.integer(2);
    let one = difference(g, form.one, other, two);
    Some(Primitive::Quadratic { square: g.mul(two, form.square), half: form.travel, one })
}

/// (a - b) times a literal, which goes to the terms: they bear literals themselves.
fn difference(g: &mut Graph, a: Scalar, b: Scalar, scale: Scalar) -> Scalar {
    let terms_of = |s: Scalar| match g.node(s) {
        ScalarNode::Sum(terms) => terms.iter().map(|&t| if s.is_negative() { -t } else { t }).collect(),
        _ => vec![s],
    };
    let mut terms = terms_of(a);
    terms.extend(terms_of(b).into_iter().map(|t| -t));
    for term in &mut terms {
        *term = g.mul(*term, scale);
    }
    g.sum(&terms)
}

/// One over a literal that two coefficients have in common.
fn common_factor(g: &mut Graph, a: Scalar, b: Scalar) -> Option<Scalar> {
    let literal = |s: Scalar| match g.node(s) {
        ScalarNode::Product(factors) => factors.first().and_then(|&f| g.literal(f)),
        ScalarNode::Literal(n) => Some(*n),
        _ => None,
    };
    let factor = match (literal(a), literal(b)) {
        (Some(m), Some(n)) if m == n => m,
        (Some(n), _) if b == Scalar::ZERO => n,
        (_, Some(n)) if a == Scalar::ZERO => n,
        _ => return None,
    };
    let factor = g.number(factor.is_sharp().then_some(factor)?);
    Some(g.reciprocal(factor))
}
