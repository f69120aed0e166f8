//! Stage `solve`: a body where the distances of its points from others leave it, in all the ways that there are.
//!
//! In: as many distances |p + R b - a| = r as the body has freedoms, six, or three in a plane. Out: a [`Placement`], which kind of robot
//! this is, and of it the pose (R, p) up to square roots, each with a *side*, and one *point* of the circle that a condition
//! tells. With all that is in it a polynomial in that point, the condition has as many roots as the robot has assembly modes,
//! each choice of sides for itself; roots are looked for by the runtime. What kind it is depends on how many distances have an end
//! in common on the body, or on what is beside it: then the one moves against the other, and the pose is inverted.
//!
//! | ends in common | condition | modes | |
//! |---|---|---|---|
//! | 3, 2, 1 | none: three points in turn, each where three spheres meet | 8 | `spheres` |
//! | 3, 1, 1, 1 | one point where three spheres meet; a turn about it | 2 x 8 | `about_point` |
//! | 2, 2, 2 | three points on circles, with given distances | 16 | `circles` |
//! | 2, 1 in a plane | none: two points in turn, each where two circles meet | 4 | `plane` |
//! | 1, 1, 1 in a plane | the body's own turn | 6 | `plane` |
//!
//! Numbers of modes: Merlet 2006, Parallel Robots, chapter 4; Innocenti and Parenti-Castelli 1990 (2, 2, 2); Innocenti 1998.

mod about_point;
mod circles;
mod improved;
mod plane;
mod spheres;

use crate::contracts::call::Call;
use crate::symbolic::graph::{Graph, Rotation, Scalar, Vector};

use super::chain::{Link, unit};
use super::distances::{self, Distance, Held};
use super::system::{Cycle, System, Unknown};
use super::{KinematicLoop, Plan, Solved, Value, plan};

use improved::Twist;

/// What tells one mode from the others, as symbols.
#[derive(Clone, Copy, Debug)]
pub struct Alternative {
    /// Cosine and sine of an angle.
    pub point: [Scalar; 2],
    /// One or minus one.
    pub sides: [Scalar; 3],
}

/// Which kind of robot it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Spheres,
    AboutPoint,
    Circles,
    PlanePairs,
    Plane,
}

impl Kind {
    /// By the number of freedoms, and how many distances have each of their ends in common.
    fn of(freedoms: usize, counts: &[usize]) -> Option<Kind> {
        match (freedoms, counts) {
            (6, [3, 2, 1]) => Some(Kind::Spheres),
            (6, [3, 1, 1, 1]) => Some(Kind::AboutPoint),
            (6, [2, 2, 2]) => Some(Kind::Circles),
            (3, [2, 1]) => Some(Kind::PlanePairs),
            (3, [1, 1, 1]) => Some(Kind::Plane),
            _ => None,
        }
    }

    /// Twice the degree of the condition.
    fn roots(self) -> usize {
        match self {
            Kind::Spheres | Kind::PlanePairs => 0,
            Kind::Plane => 6,
            Kind::AboutPoint => 8,
            Kind::Circles => 16,
        }
    }
}

/// A body that is placed by distances.
pub struct Placement {
    kind: Kind,
    held: Held,
    /// Distances by ends in common, the most first.
    groups: Vec<Vec<Distance>>,
    /// Whether ends in common are beside the body.
    is_inverted: bool,
    chain: Vec<Scalar>,
}

/// One mode.
pub struct Placed {
    /// Vanishes there, by the point; nothing where no point tells a mode.
    pub condition: Option<Scalar>,
    /// Coordinates of the chain, in their order.
    pub values: Vec<Scalar>,
    /// Errors of the distances' squares with these coordinates, each relative to what it is made of.
    pub errors: Vec<Scalar>,
    /// Between this pose and the one that the symbols of the coordinates stand for: all vanish where it is this mode.
    pub between: Vec<Scalar>,
}

/// Why a body is not placed.
pub enum Unplaced {
    /// A cycle says something else than one distance of two points.
    Unmeasured,
    /// So many ends in common on the body, and beside it.
    Unknown { body: Vec<usize>, base: Vec<usize> },
    /// The coordinates don't follow from the pose in closed form.
    Untold,
}

/// R by rows, and p.
struct Pose {
    rows: [[Scalar; 3]; 3],
    position: Vector,
    condition: Option<Scalar>,
}

impl Placement {
    /// Recognises what cycles through the same chain of motions are.
    pub fn new(g: &mut Graph, cycles: &[KinematicLoop], chain: &[Scalar]) -> Result<Placement, Unplaced> {
        let held = distances::distances(g, cycles, chain).ok_or(Unplaced::Unmeasured)?;
        let ends: [fn(&Distance) -> Vector; 2] = [|distance| distance.body, |distance| distance.base];
        let sides = ends.map(|end| {
            let mut groups: Vec<Vec<Distance>> = Vec::new();
            for &distance in &held.distances {
                match groups.iter_mut().find(|group| end(&group[0]) == end(&distance)) {
                    Some(group) => group.push(distance),
                    None => groups.push(vec![distance]),
                }
            }
            groups.sort_by_key(|group| std::cmp::Reverse(group.len()));
            groups
        });
        let counts = sides.each_ref().map(|groups| groups.iter().map(Vec::len).collect::<Vec<usize>>());
        let kinds = counts.each_ref().map(|counts| Kind::of(chain.len(), counts));
        // The side that leaves the lower degree.
        let is_inverted = match kinds {
            [Some(body), Some(base)] => base.roots() < body.roots(),
            [None, Some(_)] => true,
            _ => false,
        };
        let ([body_groups, base_groups], [body_kind, base_kind]) = (sides, kinds);
        let (kind, groups) = if is_inverted { (base_kind, base_groups) } else { (body_kind, body_groups) };
        let [body, base] = counts;
        let kind = kind.ok_or(Unplaced::Unknown { body, base })?;
        Ok(Placement { kind, held, groups, is_inverted, chain: chain.to_vec() })
    }

    /// Number of square roots whose sides are open before a point is looked for.
    pub fn sides(&self) -> usize {
        match self.kind {
            Kind::Spheres => 3,
            Kind::AboutPoint => 1,
            Kind::PlanePairs => 2,
            Kind::Circles | Kind::Plane => 0,
        }
    }

    /// Number of square roots whose sides belong to a point, and are not in the condition.
    pub fn choices(&self) -> usize {
        match self.kind {
            Kind::Spheres | Kind::PlanePairs => 0,
            Kind::AboutPoint | Kind::Plane => 1,
            Kind::Circles => 2,
        }
    }

    /// Most points for each choice of sides; none where no point is open.
    pub fn roots(&self) -> usize {
        self.kind.roots()
    }

    /// For the documentation.
    pub fn describe(&self) -> &'static str {
        match (self.kind, self.is_inverted) {
            (Kind::Spheres, false) => "three points in turn, from three, two and one distances",
            (Kind::Spheres, true) => "three points beside the body in turn, from three, two and one distances",
            (Kind::AboutPoint, false) => "a point from three distances, a turn about it by a polynomial of degree 8",
            (Kind::AboutPoint, true) => {
                "a point beside the body from three distances, a turn about it by a polynomial of degree 8"
            }
            (Kind::Circles, false) => "three points on circles, by a polynomial of degree 16",
            (Kind::Circles, true) => "three points beside the body on circles, by a polynomial of degree 16",
            (Kind::PlanePairs, false) => "two points in a plane in turn, from two and one distances",
            (Kind::PlanePairs, true) => "two points beside the body in a plane in turn, from two and one distances",
            (Kind::Plane, _) => "a turn in a plane by a polynomial of degree 6",
        }
    }

    /// The square of one of the distances: what lengths are compared with.
    pub fn square(&self) -> Scalar {
        self.held.distances.first().map_or(Scalar::ONE, |distance| distance.square)
    }

    /// The mode that an alternative tells.
    pub fn place(&self, g: &mut Graph, at: &Alternative) -> Result<Placed, Unplaced> {
        let mut groups = self.groups.clone();
        if self.is_inverted {
            groups.iter_mut().flatten().for_each(|d| std::mem::swap(&mut d.base, &mut d.body));
        }
        let pose = match self.kind {
            Kind::Spheres => spheres::pose(g, &groups, at),
            Kind::AboutPoint => about_point::pose(g, &groups, at),
            Kind::Circles => circles::pose(g, &groups, at),
            Kind::PlanePairs | Kind::Plane => plane::pose(g, &self.held.links, &groups, self.is_inverted, at),
        }
        .ok_or(Unplaced::Untold)?;
        let pose = if self.is_inverted { pose.inverted(g) } else { pose };
        let twists = self.twists(g);
        let normal = self.normal(g);
        let pose = pose.improved(g, &self.held.distances, &twists, normal);
        let values = self.coordinates(g, &pose).ok_or(Unplaced::Untold)?;
        let (rotation, offset) = distances::moved(g, &self.held.links, &self.chain);
        let errors: Vec<Scalar> =
            self.held.distances.iter().map(|distance| distance.error(g, rotation, offset, normal)).collect();
        let put = self.chain.iter().zip(&values).filter_map(|(&symbol, &value)| Some((g.symbol_id(symbol)?, value)));
        let put = put.collect();
        let errors = g.substitute(&errors, &put);
        let mut between = vec![g.sub_vectors(pose.position, offset)];
        for axis in 0..3 {
            let v = unit(g, axis);
            let (here, there) = (turned(g, &pose.rows, v), g.rotate(rotation, v));
            between.push(g.sub_vectors(here, there));
        }
        let between = between.into_iter().flat_map(|v| g.components(v)).collect();
        Ok(Placed { condition: pose.condition, values, errors, between })
    }

    /// Across the plane in which the body moves, seen from the base.
    fn normal(&self, g: &mut Graph) -> Option<Vector> {
        let is_planar = matches!(self.kind, Kind::PlanePairs | Kind::Plane);
        is_planar.then(|| plane::twists(g, &self.held.links)).and_then(|twists| Some(twists.last()?.1))
    }

    /// How the body can move.
    fn twists(&self, g: &mut Graph) -> Vec<Twist> {
        match self.kind {
            Kind::PlanePairs | Kind::Plane => plane::twists(g, &self.held.links),
            Kind::Spheres | Kind::AboutPoint | Kind::Circles => {
                let axes = [0, 1, 2].map(|axis| unit(g, axis));
                let slides = axes.map(|axis| (axis, Vector::ZERO));
                slides.into_iter().chain(axes.map(|axis| (Vector::ZERO, axis))).collect()
            }
        }
    }

    /// Coordinates of the chain for a pose; of two solutions that with the pitch between quarters of a turn.
    fn coordinates(&self, g: &mut Graph, pose: &Pose) -> Option<Vec<Scalar>> {
        let rotation = g.matrix_rotation(pose.rows);
        let back = g.rotate(rotation.transpose(), pose.position);
        let closing = Link::Known { rotation: rotation.transpose(), offset: -back };
        let links = self.held.links.iter().copied().chain([closing]).collect();
        let motions = self.held.links.iter().filter_map(|link| match link {
            Link::Free { motion, .. } => Some(*motion),
            Link::Known { .. } => None,
        });
        let unknowns = motions.zip(&self.chain).map(|(motion, &symbol)| Unknown { motion, symbol, wanted: true });
        let unknowns = unknowns.collect();
        let system = System::alone(Cycle { links, winding: None }, unknowns);
        let plan = Plan { steps: plan::plan(&mut g.clone(), &system, &[]).ok()? };
        let positive = plan.solve_system(g, &mut system.clone(), &[]).ok()?;
        // The root is the cosine of the pitch.
        let turned = |one: &Solved| matches!(one.value, Value::Angle { cos, .. } if cos.is_negative());
        let solution = match positive.solved.iter().any(|one| !one.roots.is_empty() && turned(one)) {
            true => plan.solve_system(g, &mut system.clone(), &[-Scalar::ONE]).ok()?,
            false => positive,
        };
        // Each may read those before it.
        let mut found: Vec<(Scalar, Scalar)> = Vec::new();
        for one in solution.solved {
            let known = found.iter().filter_map(|&(symbol, value)| Some((g.symbol_id(symbol)?, value))).collect();
            let value = match one.value {
                Value::Angle { cos, sin } => {
                    let both = g.substitute(&[cos, sin], &known);
                    g.angle(both[0], both[1])
                }
                Value::Length(x) => g.substitute(&[x], &known)[0],
            };
            found.push((one.symbol, value));
        }
        let value = |symbol: &Scalar| found.iter().find(|one| one.0 == *symbol).map(|one| one.1);
        self.chain.iter().map(value).collect()
    }
}

impl Pose {
    /// R = E F^T: what takes three unit vectors of the body to their images.
    fn of_frames(g: &mut Graph, images: [Vector; 3], own: [Vector; 3]) -> [[Scalar; 3]; 3] {
        let (images, own) = (images.map(|v| g.components(v)), own.map(|v| g.components(v)));
        [0, 1, 2].map(|i| {
            [0, 1, 2].map(|j| {
                let terms = [0, 1, 2].map(|k| g.mul(images[k][i], own[k][j]));
                g.sum(&terms)
            })
        })
    }

    /// By where three points of the body are. It is a rotation also where their distances from each other are off by something.
    fn of_points(g: &mut Graph, body: [Vector; 3], there: [Vector; 3], condition: Option<Scalar>) -> Pose {
        let [own, images] = [body, there].map(|points| {
            let [u, w] = [1, 2].map(|k| g.sub_vectors(points[k], points[0]));
            frame(g, u, w).0
        });
        let rows = Pose::of_frames(g, images, own);
        Pose::through(g, rows, body[0], there[0], condition)
    }

    /// With this orientation, and a point of the body where it is.
    fn through(g: &mut Graph, rows: [[Scalar; 3]; 3], body: Vector, there: Vector, condition: Option<Scalar>) -> Pose {
        let turned = turned(g, &rows, body);
        Pose { rows, position: g.sub_vectors(there, turned), condition }
    }

    /// The pose of the base as the body sees it.
    fn inverted(self, g: &mut Graph) -> Pose {
        let rows = [0, 1, 2].map(|i| [0, 1, 2].map(|j| self.rows[j][i]));
        let back = turned(g, &rows, self.position);
        Pose { rows, position: -back, condition: self.condition }
    }
}

impl Distance {
    /// What lies between the ends, of a distance in the plane without what lies across it.
    fn seen(&self, g: &mut Graph, normal: Option<Vector>, between: Vector) -> Vector {
        let Some(normal) = normal.filter(|_| self.is_flat) else { return between };
        let height = g.dot(normal, between);
        let part = g.scale(height, normal);
        g.sub_vectors(between, part)
    }

    /// The error of its square in a pose, relative to the squares that it is made of.
    fn error(&self, g: &mut Graph, rotation: Rotation, offset: Vector, normal: Option<Vector>) -> Scalar {
        let arm = g.rotate(rotation, self.body);
        let from = g.sub_vectors(offset, self.base);
        let between = g.add_vectors(arm, from);
        let between = self.seen(g, normal, between);
        let [square, arm, from] = [between, arm, from].map(|v| g.dot(v, v));
        let error = g.sub(square, self.square);
        let scale = g.sum(&[self.square, arm, from]);
        g.div(error, scale)
    }
}

/// R v
fn turned(g: &mut Graph, rows: &[[Scalar; 3]; 3], v: Vector) -> Vector {
    let v = g.components(v);
    let components = rows.map(|row| {
        let terms = [0, 1, 2].map(|k| g.mul(row[k], v[k]));
        g.sum(&terms)
    });
    g.vector(components)
}

/// Three unit vectors, the first one along a vector, the second one in a plane with another; and one over the vector's length.
fn frame(g: &mut Graph, v: Vector, other: Vector) -> ([Vector; 3], Scalar) {
    let (first, inverse) = unit_of(g, v);
    let normal = g.cross(first, other);
    let (third, _) = unit_of(g, normal);
    ([first, g.cross(third, first), third], inverse)
}

/// The same with the other two anywhere.
fn frame_along(g: &mut Graph, v: Vector) -> ([Vector; 3], Scalar) {
    let (first, inverse) = unit_of(g, v);
    let normal = beside(g, first);
    let (third, _) = unit_of(g, normal);
    ([first, g.cross(third, first), third], inverse)
}

/// A vector across another one, across X or across Y too, whichever is farther from it.
fn beside(g: &mut Graph, v: Vector) -> Vector {
    let [x, y, z] = g.components(v);
    let [xx, yy] = [x, y].map(|s| g.mul(s, s));
    let is_nearer = g.call(Call::Less, &[yy, xx]);
    let zero = Scalar::ZERO;
    let components = [(-z, zero), (zero, z), (x, -y)].map(|(a, b)| g.call(Call::Select, &[is_nearer, a, b]));
    g.vector(components)
}

fn unit_of(g: &mut Graph, v: Vector) -> (Vector, Scalar) {
    let components = g.components(v);
    let length = g.length(components);
    let inverse = g.reciprocal(length);
    (g.scale(inverse, v), inverse)
}
