//! Stage `solve`: where two or three successive slides lead together.
//!
//! In: cycles that hold such unknowns, with nothing open between them. Out: their travels, found from as many measures across them,
//! such as the lengths of three rods, of which no two need belong to one cycle, and the equations that their rates obey together.
//! The measures are those of characteristic pairs.
//!
//! With slides along a, b, c, orthogonal or not, the travels are coordinates of p = q1 a + q2 b + q3 c; of two slides c is a x b,
//! and the plane n . p = 0 across it stands for what a third one would tell. The distance of two points is a sphere about the one
//! as the slides see it, |p - c| = r, whichever cycle it is of; what is linear in p is a plane. Differences of spheres are
//! planes, so two planes n1 . x = h1, n2 . x = h2 and one sphere |x| = r are left, with x = p - c. With
//! N = n1 x n2 and m = h1 n2 - h2 n1
//!
//! x = (m x N + rho N) / N^2, rho^2 = r^2 N^2 - m^2.
//!
//! rho = x . N is the volume of the three gradients, by which rates are divided: where it vanishes two solutions meet. Where all centres
//! lie on a line N is zero, and rho with it if the point exists at all.

use crate::dynamics::tree::Motion;
use crate::invariant::injection::{Break, broken};
use crate::symbolic::graph::{Graph, Rotation, Scalar, Vector};

use super::chain::{Link, Side, unit};
use super::measures::Measure;
use super::pairs::{Opened, Run, pairs};
use super::system::{Part, System};
use super::{Balance, Root, Solved, Value};

/// Most sets of measures that are looked at for the same slides.
const MOST_SETS: usize = 200;

/// A cycle, two groups of it, and what is measured between them across the slides.
type Place = (usize, Run, Run, Measure);

/// Where travels come from.
#[derive(Clone, Copy, Debug)]
pub(super) struct Translation {
    /// Two or three, by number.
    pub(super) unknowns: Few<usize>,
    /// As many. The first one is a distance of two points.
    measures: Few<Place>,
}

/// Two, or three.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Few<T> {
    two: [T; 2],
    third: Option<T>,
}

impl<T: Copy> Few<T> {
    fn new(list: &[T]) -> Option<Few<T>> {
        match *list {
            [a, b] => Some(Few { two: [a, b], third: None }),
            [a, b, c] => Some(Few { two: [a, b], third: Some(c) }),
            _ => None,
        }
    }

    pub(super) fn list(&self) -> Vec<T> {
        self.two.into_iter().chain(self.third).collect()
    }
}

/// The slides of a cycle as the frame on their left sees them, and the dual vectors.
struct Axes {
    directions: [Vector; 3],
    duals: [Vector; 3],
    volume: Scalar,
}

/// What a measure says of p.
#[derive(Clone, Copy)]
enum Surface {
    /// |p - centre|^2 = square
    Sphere { centre: Vector, square: Scalar },
    /// normal . p = place
    Plane { normal: Vector, place: Scalar },
}

/// All that is said of p.
struct Conditions {
    axes: Axes,
    /// Three, with what vanishes; the first is a sphere, the last one the plane of the slides if these are two.
    surfaces: [(Surface, Scalar); 3],
}

/// Two planes and a sphere, x from its centre.
#[derive(Clone, Copy)]
struct Meeting {
    centre: Vector,
    square: Scalar,
    planes: [(Vector, Scalar); 2],
    /// The planes' common direction, and its square.
    normal: Vector,
    area: Scalar,
}

/// Travels that were found.
#[derive(Clone)]
pub(super) struct Found {
    pub(super) solved: Vec<Solved>,
    /// What everything was found from.
    pub(super) coefficients: Vec<Scalar>,
}

impl Translation {
    /// All that can be found with what is known.
    pub(super) fn candidates(g: &mut Graph, system: &System) -> Vec<Translation> {
        let mut list = Vec::new();
        for unknowns in neighbours(system) {
            let places = places(g, system, &unknowns);
            let sets = sets(&places, unknowns.len());
            let found = sets.into_iter().filter_map(|set| {
                let translation = Translation { unknowns: Few::new(&unknowns)?, measures: Few::new(&set)? };
                translation.meeting(g, system).is_some().then_some(translation)
            });
            list.extend(found);
        }
        list
    }

    /// For the report.
    pub(super) fn describe(&self) -> String {
        let spheres = self.measures.list().iter().filter(|place| place.3 == Measure::Points).count();
        let what = match (spheres, self.unknowns.third.is_some()) {
            (3, _) => "the distances of three points",
            (2, true) => "the distances of two points and a plane",
            (_, true) => "the distance of a point and two planes",
            (2, false) => "the distances of two points in the plane of the slides",
            (_, false) => "the distance of a point in the plane of the slides and a line",
        };
        format!("slides together from {what}")
    }

    /// Whether the equations tell the travels: all of these must differ from zero.
    pub(super) fn leading(&self, g: &mut Graph, system: &System) -> Option<[Scalar; 2]> {
        self.meeting(g, system).map(|(conditions, meeting)| [conditions.axes.volume, meeting.area])
    }

    fn meeting(&self, g: &mut Graph, system: &System) -> Option<(Conditions, Meeting)> {
        let conditions = self.derive(g, system)?;
        let [(first, _), others @ ..] = conditions.surfaces;
        let Surface::Sphere { centre, square } = first else { return None };
        let half = g.decimal(0.5);
        let planes = others.map(|(surface, _)| match surface {
            Surface::Sphere { centre: other, square: its } => {
                let normal = g.sub_vectors(other, centre);
                let apart = g.dot(normal, normal);
                let sum = g.sum(&[apart, square, -its]);
                (normal, g.mul(half, sum))
            }
            Surface::Plane { normal, place } => {
                let at = g.dot(normal, centre);
                (normal, g.sub(place, at))
            }
        });
        let normal = g.cross(planes[0].0, planes[1].0);
        let area = g.dot(normal, normal);
        (area != Scalar::ZERO).then_some((conditions, Meeting { centre, square, planes, normal, area }))
    }

    fn derive(&self, g: &mut Graph, system: &System) -> Option<Conditions> {
        let unknowns = self.unknowns.list();
        let [first, ..] = self.measures.two;
        let axes = Axes::new(g, &system.cycles[first.0].parts(&unknowns).next()?, &unknowns)?;
        let mut surfaces = Vec::with_capacity(3);
        for place in self.measures.list() {
            surfaces.push(surface(g, system, &unknowns, &axes, place)?);
        }
        if self.unknowns.third.is_none() {
            let plane = Surface::Plane { normal: axes.directions[2], place: Scalar::ZERO };
            surfaces.push((plane, Scalar::ZERO));
        }
        Some(Conditions { axes, surfaces: surfaces.try_into().ok()? })
    }

    /// The travels. `sign`, one or minus one, chooses between two.
    pub(super) fn solve(&self, g: &mut Graph, system: &System, sign: Scalar) -> Option<Found> {
        let (conditions, meeting) = self.meeting(g, system)?;
        let Conditions { axes, surfaces } = conditions;
        let Meeting { centre, square, planes: [(n, h), (m, k)], normal, area } = meeting;
        let (first, second) = (g.scale(h, m), g.scale(k, n));
        let across = g.sub_vectors(first, second);
        let (whole, part) = (g.mul(square, area), g.dot(across, across));
        let discriminant = g.sub(whole, part);
        let root = g.sqrt(discriminant);
        let rho = g.mul(sign, root);
        let (flat, height) = (g.cross(across, normal), g.scale(rho, normal));
        let sum = g.add_vectors(flat, height);
        let inverse = g.reciprocal(area);
        let x = g.scale(inverse, sum);
        let p = g.add_vectors(centre, x);
        // Changes of the equations by p, and their volume.
        let (mut gradients, mut volume) = ([x; 3], rho);
        for ((gradient, plane), (surface, _)) in gradients[1..].iter_mut().zip([n, m]).zip(&surfaces[1..]) {
            match surface {
                Surface::Sphere { .. } => {
                    *gradient = g.sub_vectors(x, plane);
                    volume = -volume;
                }
                Surface::Plane { .. } => *gradient = plane,
            }
        }
        let slope = g.reciprocal(volume);
        // Directions that may come to lie in a plane are a dead centre too.
        let told = if g.literal(axes.volume).is_some() { root } else { g.mul(root, axes.volume) };
        let unknowns = self.unknowns.list();
        let together: Vec<Scalar> = unknowns.iter().map(|&number| system.unknowns[number].symbol).collect();
        let solved = together.iter().zip(axes.duals).enumerate().map(|(number, (&symbol, dual))| {
            let mut balances = Vec::with_capacity(3);
            for (at, &(_, equation)) in surfaces.iter().enumerate() {
                let side = g.cross(gradients[(at + 1) % 3], gradients[(at + 2) % 3]);
                let share = g.dot(dual, side);
                let inverse_slope = g.mul(share, slope);
                if equation != Scalar::ZERO && inverse_slope != Scalar::ZERO {
                    balances.push(Balance { equation, inverse_slope });
                }
            }
            if broken(Break::TranslationShare)
                && let Some(balance) = balances.last_mut()
            {
                balance.inverse_slope = -balance.inverse_slope;
            }
            let is_first = number == 0;
            Solved {
                symbol,
                value: Value::Length(g.dot(dual, p)),
                balances,
                together: together.clone(),
                how: if is_first { self.describe() } else { "found together with the slide before it".to_owned() },
                roots: if is_first { vec![Root { value: told, sign: 0 }] } else { Vec::new() },
                parts: if is_first { vec![("normal", area), ("gap", discriminant)] } else { Vec::new() },
            }
        });
        let solved = solved.collect();
        let vectors = [centre, n, m].map(|v| g.components(v)).into_iter().flatten();
        let coefficients = vectors.chain([square, h, k]).collect();
        Some(Found { solved, coefficients })
    }
}

impl Axes {
    /// The directions are those of the unknowns in their order; nothing where they lie in a plane.
    fn new(g: &mut Graph, part: &Part, unknowns: &[usize]) -> Option<Axes> {
        let mut turn = Rotation::IDENTITY;
        let mut directions = [Vector::ZERO; 3];
        for &link in &part.links {
            match link {
                Link::Known { rotation, .. } => turn = g.compose(turn, rotation),
                Link::Free { motion: Motion::Prismatic(axis), unknown } => {
                    let along = unit(g, axis);
                    let at = unknowns.iter().position(|&number| number == unknown)?;
                    directions[at] = g.rotate(turn, along);
                }
                Link::Free { .. } => return None,
            }
        }
        if unknowns.len() == 2 {
            directions[2] = g.cross(directions[0], directions[1]);
        }
        let sides = [0, 1, 2].map(|k| g.cross(directions[(k + 1) % 3], directions[(k + 2) % 3]));
        let volume = g.dot(directions[0], sides[0]);
        if volume == Scalar::ZERO {
            return None;
        }
        let inverse = g.reciprocal(volume);
        Some(Axes { directions, duals: sides.map(|side| g.scale(inverse, side)), volume })
    }

    /// What these axes see as a vector, as others see it of which lengths and angles are the same.
    fn seen_by(&self, g: &mut Graph, other: &Axes, v: Vector) -> Vector {
        if self.directions == other.directions {
            return v;
        }
        let terms = [0, 1, 2].map(|k| {
            let along = g.dot(self.duals[k], v);
            g.scale(along, other.directions[k])
        });
        g.sum_vectors(&terms)
    }

    /// Whether lengths and angles are the same.
    fn is_like(&self, g: &mut Graph, other: &Axes) -> bool {
        let pairs = (0..3).flat_map(|a| (0..=a).map(move |b| (a, b)));
        let mut same = |axes: &Axes, (a, b): (usize, usize)| g.dot(axes.directions[a], axes.directions[b]);
        pairs.into_iter().all(|pair| same(self, pair) == same(other, pair))
    }
}

/// What a measure says of p, and what vanishes.
fn surface(
    g: &mut Graph,
    system: &System,
    unknowns: &[usize],
    axes: &Axes,
    (cycle, first, second, measure): Place,
) -> Option<(Surface, Scalar)> {
    let part = system.cycles[cycle].parts(unknowns).next()?;
    let own = Axes::new(g, &part, unknowns)?;
    if !own.is_like(g, axes) {
        return None;
    }
    let rest = Opened::around(&part.rest);
    let (first, second) = (rest.take(g, first), rest.take(g, second));
    let along = rest.along_rest(g, &first, &second, measure)?;
    // With the slides where they begin, and where they are.
    let [still, moved] = [false, true].map(|is_moved| {
        let links: Vec<Link> = part.links.iter().map(|link| link.placed(g, system, is_moved)).collect();
        first.near.carry_all(g, &links, Side::Left)
    });
    let open =
        |g: &mut Graph, near| Some(measure.value(g, &second.far, None, near)?.one).map(|value| g.sub(value, along));
    let equation = open(g, &moved)?;
    if measure == Measure::Points {
        let centre = g.sub_vectors(second.far.point()?, still.point()?);
        let centre = own.seen_by(g, axes, centre);
        let two = g.integer(2);
        return Some((Surface::Sphere { centre, square: g.mul(two, along) }, equation));
    }
    let symbols: Vec<Scalar> = unknowns.iter().map(|&number| system.unknowns[number].symbol).collect();
    let slopes: Vec<Scalar> = symbols.iter().map(|&symbol| g.derivative(equation, &[(symbol, Scalar::ONE)])).collect();
    if slopes.iter().all(|&slope| slope == Scalar::ZERO) || slopes.iter().any(|&slope| g.depends_on(slope, &symbols)) {
        return None;
    }
    let terms: Vec<Vector> = slopes.iter().zip(axes.duals).map(|(&slope, dual)| g.scale(slope, dual)).collect();
    let normal = g.sum_vectors(&terms);
    let place = -open(g, &still)?;
    Some((Surface::Plane { normal, place }, equation))
}

impl Link {
    /// A known link in place of a slide: where it begins, or where it is.
    fn placed(self, g: &mut Graph, system: &System, is_moved: bool) -> Link {
        match self {
            Link::Free { .. } if !is_moved => Link::Known { rotation: Rotation::IDENTITY, offset: Vector::ZERO },
            link => link.settled(g, system),
        }
    }
}

/// Three slides, then two, that follow each other in a cycle.
fn neighbours(system: &System) -> Vec<Vec<usize>> {
    let mut list: Vec<Vec<usize>> = Vec::new();
    for count in [3, 2] {
        for cycle in &system.cycles {
            let free = cycle.free();
            for start in 0..free.len() {
                let mut own: Vec<usize> = (0..count).map(|k| free[(start + k) % free.len()].1).collect();
                let slides = own.iter().all(|&number| {
                    let unknown = &system.unknowns[number];
                    unknown.wanted && matches!(unknown.motion, Motion::Prismatic(_))
                });
                own.sort_unstable();
                if slides && own.windows(2).all(|pair| pair[0] != pair[1]) && !list.contains(&own) {
                    list.push(own);
                }
            }
        }
    }
    list
}

/// All that is measured across slides, distances of points first.
fn places(g: &mut Graph, system: &System, unknowns: &[usize]) -> Vec<Place> {
    let mut list: Vec<Place> = Vec::new();
    for (number, cycle) in system.cycles.iter().enumerate() {
        let Some(part) = cycle.parts(unknowns).next() else { continue };
        let Some(axes) = Axes::new(g, &part, unknowns) else { continue };
        let taken = Opened::around(&part.rest).groups(g);
        for (first, second, measure) in pairs(&taken) {
            let place = (number, first.run, second.run, measure);
            if surface(g, system, unknowns, &axes, place).is_some() {
                list.push(place);
            }
        }
    }
    list.sort_by_key(|place| place.3 != Measure::Points);
    list
}

/// Choices of as many measures, each first one a distance of two points.
fn sets(places: &[Place], count: usize) -> Vec<Vec<Place>> {
    let is_sphere = |place: &Place| place.3 == Measure::Points;
    let mut sets: Vec<Vec<usize>> = (0..places.len()).filter(|&k| is_sphere(&places[k])).map(|k| vec![k]).collect();
    for chosen in 1..count {
        let longer = sets.iter().flat_map(|set| {
            // What follows the first one has no order.
            let from = if chosen == 1 { 0 } else { set[chosen - 1] + 1 };
            (from..places.len()).filter(|k| !set.contains(k)).map(|k| [&set[..], &[k]].concat())
        });
        sets = longer.take(MOST_SETS).collect();
    }
    sets.into_iter().map(|set| set.into_iter().map(|k| places[k]).collect()).collect()
}
