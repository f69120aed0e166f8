//! Stage `solve`: the orientation that three successive turns about axes through one point have together.
//!
//! In: cycles that hold three such unknowns, with nothing open between them. Out: a cycle of these three alone and of their
//! orientation, from which they follow as any unknowns do, and the equations that their rates obey together. Needed are a
//! vector that is known on both sides of the three, R e = d (two equations), and a measure across them that is one product,
//! u . R c = k (the third). The measures are those of characteristic pairs; they may come from another cycle.
//!
//! With x = R c it is x . d = c . e, x . u = k and |x| = |c|: two planes and a sphere. With E = e^2, N = (d x u)^2,
//! M = (e x c)^2, P = d . u, s = c . e and kappa = E k - s P
//!
//! x = (kappa u + rho (d x u)) / N + (s - kappa P / N) / E d, rho^2 = (M N - kappa^2) / E,
//!
//! and R takes e, c and e x c to d, x and d x x. -rho is the change of u . x per turn about d: where it vanishes two solutions
//! meet. Of the angular velocity omega, d leaves open what lies along it, and u . x tells that.

use crate::dynamics::tree::Motion;
use crate::invariant::fault::OrFault;
use crate::invariant::injection::{Break, broken};
use crate::symbolic::graph::{Graph, Rotation, Scalar, Vector};

use super::Balance;
use super::chain::{Kind, Link, Side, unit};
use super::elements::{JointGroup, Seen};
use super::measures::Measure;
use super::pairs::{Opened, Run, Source, Taken, pairs};
use super::system::{Cycle, System};

/// Where an orientation comes from.
#[derive(Clone, Copy, Debug)]
pub(super) struct Orientation {
    /// In the order in which the vector's cycle meets them.
    pub(super) unknowns: [usize; 3],
    /// A cycle, and the group whose point or direction is known on both sides.
    vector: (usize, Source),
    /// A cycle, two groups, and what is measured between them.
    product: (usize, Run, Run, Measure),
    /// It is sought as what takes vectors from the left to the right.
    back: bool,
}

/// R e = d, u . R c = k
#[derive(Clone, Copy)]
struct Conditions {
    e: Vector,
    d: Vector,
    u: Vector,
    c: Vector,
    k: Scalar,
}

/// Three neighbouring turns of a cycle about axes through one point.
struct Spherical {
    unknowns: [usize; 3],
    /// From the first of them to the last.
    links: Vec<Link>,
    /// From their right side round to their left.
    rest: Vec<Link>,
    centre: Seen,
}

/// An orientation that was found.
#[derive(Clone)]
pub(super) struct Found {
    pub(super) unknowns: [usize; 3],
    pub(super) root: Scalar,
    pub(super) parts: Vec<(&'static str, Scalar)>,
    links: Vec<Link>,
    back: bool,
    conditions: Conditions,
    /// R c
    x: Vector,
    /// The change of u . x per turn about d.
    slope: Scalar,
    /// The square of d.
    square: Scalar,
    /// Its matrix.
    pub(super) rows: [[Scalar; 3]; 3],
}

impl Orientation {
    /// All that can be found with what is known.
    pub(super) fn candidates(g: &mut Graph, system: &System) -> Vec<Orientation> {
        let mut list = Vec::new();
        for unknowns in triples(g, system) {
            let cycles = 0..system.cycles.len();
            let groups: Vec<(usize, Vec<Taken>)> = cycles
                .filter_map(|cycle| {
                    let spherical = Spherical::new(g, &system.cycles[cycle], unknowns)?;
                    Some((cycle, Opened::around(&spherical.rest).groups(g)))
                })
                .collect();
            for (cycle, taken) in &groups {
                let vectors = taken.iter().flat_map(|group| {
                    let directions = 0..group.features.directions.len();
                    directions.map(|k| Source::Direction(group.run, k)).chain([Source::Point(group.run)])
                });
                for vector in vectors {
                    for (other, taken) in &groups {
                        for (first, second, measure) in pairs(taken) {
                            let product = (*other, first.run, second.run, measure);
                            let sides = [false, true].map(|back| {
                                let found = Orientation { unknowns, vector: (*cycle, vector), product, back };
                                found.ordered(g, system)
                            });
                            list.extend(sides.into_iter().flatten());
                        }
                    }
                }
            }
        }
        list
    }

    /// With the unknowns in order, if it determines them.
    pub(super) fn ordered(mut self, g: &mut Graph, system: &System) -> Option<Orientation> {
        let (spherical, Conditions { e, d, u, c, .. }) = self.derive(g, system)?;
        let other = Spherical::new(g, &system.cycles[self.product.0], self.unknowns)?;
        let determined = [(e, c), (d, u)].into_iter().all(|(a, b)| g.cross(a, b) != Vector::ZERO);
        self.unknowns = spherical.unknowns;
        (determined && spherical.turns_as(g, system, &other)).then_some(self)
    }

    fn derive(&self, g: &mut Graph, system: &System) -> Option<(Spherical, Conditions)> {
        let spherical = Spherical::new(g, &system.cycles[self.vector.0], self.unknowns)?;
        let rest = Opened::around(&spherical.rest);
        let (e, d) = match self.vector.1 {
            Source::Direction(run, k) => {
                let group = rest.take(g, run);
                let at = |list: &[Option<Vector>]| list.get(k).copied().flatten();
                (at(group.near.directions())?, at(group.far.directions())?)
            }
            Source::Point(run) => {
                let group = rest.take(g, run);
                let (near, far) = (group.near.point()?, group.far.point()?);
                (g.sub_vectors(near, spherical.centre.right), g.sub_vectors(far, spherical.centre.left))
            }
            _ => return None,
        };
        let (cycle, first, second, measure) = self.product;
        let other = Spherical::new(g, &system.cycles[cycle], self.unknowns)?;
        let rest = Opened::around(&other.rest);
        let (first, second) = (rest.take(g, first), rest.take(g, second));
        let product = measure.product(g, &second.far, other.centre, &first.near)?;
        let along = rest.along_rest(g, &first, &second, measure)?;
        let k = g.sub(along, product.rest);
        let (u, c) = match other.unknowns == spherical.unknowns {
            true => (product.far, product.near),
            // Walked the other way: u . R^T c = c . R u.
            false => {
                let [left, right] = spherical.half_turns(g, system);
                (g.rotate(left, product.near), g.rotate(right, product.far))
            }
        };
        Some((spherical, Conditions { e, d, u, c, k }))
    }

    /// Whether the equations tell the orientation: all of these must differ from zero.
    pub(super) fn leading(&self, g: &mut Graph, system: &System) -> Option<[Scalar; 2]> {
        let (_, Conditions { e, d, u, c, .. }) = self.derive(g, system)?;
        Some([(e, c), (d, u)].map(|(a, b)| {
            let normal = g.cross(a, b);
            g.dot(normal, normal)
        }))
    }

    /// For the report.
    pub(super) fn describe(&self) -> String {
        let vector = match self.vector.1 {
            Source::Direction(..) => "a direction",
            _ => "a point",
        };
        format!("orientation from {vector} on both sides and {}", self.product.3.describe())
    }

    /// The orientation, which is a new cycle of the system. `sign`, one or minus one, chooses between two.
    pub(super) fn solve(&self, g: &mut Graph, system: &mut System, sign: Scalar) -> Option<Found> {
        let (spherical, conditions) = self.derive(g, system)?;
        let conditions = if self.back { conditions.transposed() } else { conditions };
        let Conditions { e, d, u, c, k } = conditions;
        let square = match [g.dot(e, e), g.dot(d, d)] {
            [near, far] if g.literal(near).is_none() && g.literal(far).is_some() => far,
            [near, _] => near,
        };
        let [normal, side] = [g.cross(d, u), g.cross(e, c)];
        let [n, m] = [normal, side].map(|v| g.dot(v, v));
        let (p, s) = (g.dot(d, u), g.dot(c, e));
        let [inverse_n, inverse_m, inverse] = [n, m, square].map(|x| g.reciprocal(x));
        let [whole, part] = [(square, k), (s, p)].map(|(a, b)| g.mul(a, b));
        let kappa = g.sub(whole, part);
        let [whole, part] = [(m, n), (kappa, kappa)].map(|(a, b)| g.mul(a, b));
        let rest = g.sub(whole, part);
        let discriminant = g.mul(rest, inverse);
        let root = g.sqrt(discriminant);
        let rho = g.mul(sign, root);
        // R c, and d x R c.
        let part = g.product(&[kappa, p, inverse_n]);
        let part = g.sub(s, part);
        let along = g.mul(part, inverse);
        let terms = [(kappa, u), (rho, normal)].map(|(a, v)| g.scale(a, v));
        let x = g.sum_vectors(&terms);
        let terms = [g.scale(inverse_n, x), g.scale(along, d)];
        let x = g.sum_vectors(&terms);
        let (turned, own) = (g.mul(rho, p), g.mul(rho, square));
        let terms = [(kappa, normal), (turned, d), (-own, u)].map(|(a, v)| g.scale(a, v));
        let y = g.sum_vectors(&terms);
        let y = g.scale(inverse_n, y);
        // The dual vectors of e, c and e x c.
        let duals = [g.cross(c, side), g.cross(side, e), side].map(|v| g.scale(inverse_m, v));
        let (images, duals) = ([d, x, y].map(|v| g.components(v)), duals.map(|v| g.components(v)));
        let rows = [0, 1, 2].map(|i| {
            [0, 1, 2].map(|j| {
                let terms = [0, 1, 2].map(|k| g.mul(images[k][i], duals[k][j]));
                g.sum(&terms)
            })
        });
        let rotation = g.matrix_rotation(rows);
        let rotation = if self.back { rotation } else { rotation.transpose() };
        // Where the three stand does not matter to how they turn.
        let turning = spherical.links.iter().map(|&link| match link {
            Link::Known { rotation, .. } => Link::Known { rotation, offset: Vector::ZERO },
            link => link,
        });
        let closing = Link::Known { rotation, offset: Vector::ZERO };
        system.cycles.push(Cycle { links: turning.chain([closing]).collect(), winding: None });
        let parts = vec![("product", kappa), ("area", n), ("gap", discriminant)];
        let Spherical { unknowns, links, .. } = spherical;
        Some(Found { unknowns, root, parts, links, back: self.back, conditions, x, slope: -rho, square, rows })
    }
}

impl Conditions {
    /// The same of the transposed rotation.
    fn transposed(self) -> Conditions {
        let Conditions { e, d, u, c, k } = self;
        Conditions { e: d, d: e, u: c, c: u, k }
    }
}

impl Found {
    /// What everything was found from.
    pub(super) fn coefficients(&self, g: &mut Graph) -> Vec<Scalar> {
        let Conditions { e, d, u, c, k } = self.conditions;
        let components = [e, d, u, c].map(|v| g.components(v));
        components.into_iter().flatten().chain([k]).collect()
    }

    /// The equations that the rates of the three obey, for each with what it moves them by. `unknowns` are moved.
    pub(super) fn balances(&self, g: &mut Graph, system: &System) -> [Vec<Balance>; 3] {
        let Conditions { e, d, u, c, k } = self.conditions;
        let moved: Vec<Link> = self.links.iter().map(|link| link.settled(g, system)).collect();
        let sees = |g: &mut Graph, links: &[Link], way: Side, v: Vector| {
            let carry = |g: &mut Graph, v: Vector, link: Link| {
                link.carry(g, way, Kind::Direction, v).or_fault("known links carry everything")
            };
            match way {
                Side::Left => links.iter().rev().fold(v, |v, &link| carry(g, v, link)),
                Side::Right => links.iter().fold(v, |v, &link| carry(g, v, link)),
            }
        };
        let way = if self.back { Side::Right } else { Side::Left };
        let [turned, seen] = [e, c].map(|v| sees(g, &moved, way, v));
        let open = g.sub_vectors(turned, d);
        let product = g.dot(u, seen);
        let equations = [0, 1, 2].map(|axis| g.component(open, axis));
        let last = g.sub(product, k);
        // Axes on the side of d, and in the middle for their volume.
        let places = self.unknowns.map(|number| {
            self.links.iter().position(|link| link.is_open(number)).or_fault("the three stand in their links")
        });
        let axes = places.map(|at| match self.links[at] {
            Link::Free { motion: Motion::Revolute(axis), .. } => unit(g, axis),
            _ => Vector::ZERO,
        });
        let [first, middle, third] = places;
        let before = sees(g, &moved[first..middle], Side::Right, axes[0]);
        let after = sees(g, &moved[middle..third], Side::Left, axes[2]);
        let across = g.cross(axes[1], after);
        let volume = g.dot(before, across);
        let [volume] = system.known.simplest(g, [volume]);
        let volume = if self.back { -volume } else { volume };
        let scale = g.reciprocal(volume);
        let seen = [0, 1, 2].map(|k| match way {
            Side::Left => sees(g, &moved[..places[k]], way, axes[k]),
            Side::Right => sees(g, &moved[places[k]..], way, axes[k]),
        });
        let [slope, inverse] = [self.slope, self.square].map(|s| g.reciprocal(s));
        let lever = g.cross(self.x, u);
        let lever = g.cross(lever, d);
        [0, 1, 2].map(|k| {
            // What the angular velocity is multiplied by for the rate.
            let dual = g.cross(seen[(k + 1) % 3], seen[(k + 2) % 3]);
            let dual = g.scale(scale, dual);
            let along = g.dot(dual, d);
            let share = g.mul(along, slope);
            let share = if broken(Break::OrientationShare) { -share } else { share };
            let (across, back) = (g.cross(dual, d), g.scale(share, lever));
            let across = g.sub_vectors(across, back);
            let shares = g.scale(inverse, across);
            let shares = g.components(shares);
            let vector = equations.into_iter().zip(shares);
            let both = vector.chain([(last, share)]);
            both.filter(|(equation, share)| *equation != Scalar::ZERO && *share != Scalar::ZERO)
                .map(|(equation, inverse_slope)| Balance { equation, inverse_slope })
                .collect()
        })
    }
}

impl Spherical {
    fn new(g: &mut Graph, cycle: &Cycle, unknowns: [usize; 3]) -> Option<Spherical> {
        cycle.parts(&unknowns).find_map(|part| {
            let mut group = JointGroup::new();
            part.links.iter().for_each(|&link| group.append(g, link));
            let centre = group.centre()?;
            let unknowns = part.unknowns.try_into().ok()?;
            Some(Spherical { unknowns, links: part.links, rest: part.rest, centre })
        })
    }

    /// Half turns that lead from the frame on the right of the same turns, walked the other way, to the one on the left here, and
    /// from the left one there to the right one here.
    fn half_turns(&self, g: &mut Graph, system: &System) -> [Rotation; 2] {
        [0, 2].map(|k| {
            let Motion::Revolute(axis) = system.unknowns[self.unknowns[k]].motion else { return Rotation::IDENTITY };
            let pi = g.pi();
            g.axis_rotation((axis + 1) % 3, pi)
        })
    }

    /// Whether these turns are those of another cycle, walked either way.
    fn turns_as(&self, g: &mut Graph, system: &System, other: &Spherical) -> bool {
        let turn = |g: &mut Graph, spherical: &Spherical| {
            let links: Vec<Link> = spherical.links.iter().map(|link| link.settled(g, system)).collect();
            links.iter().fold(Rotation::IDENTITY, |whole, link| match *link {
                Link::Known { rotation, .. } => g.compose(whole, rotation),
                Link::Free { .. } => whole,
            })
        };
        let (own, its) = (turn(g, self), turn(g, other));
        let reversed: Vec<usize> = other.unknowns.into_iter().rev().collect();
        let [left, right] = match self.unknowns {
            unknowns if unknowns == other.unknowns => [Rotation::IDENTITY; 2],
            unknowns if unknowns[..] == reversed[..] => self.half_turns(g, system),
            _ => return false,
        };
        let its = if self.unknowns == other.unknowns { its } else { its.transpose() };
        (0..3).all(|axis| {
            let v = unit(g, axis);
            let here = g.rotate(own, v);
            let there = g.rotate(right.transpose(), v);
            let there = g.rotate(its, there);
            here == g.rotate(left, there)
        })
    }
}

/// Three unknowns at a time that turn about one point.
fn triples(g: &mut Graph, system: &System) -> Vec<[usize; 3]> {
    let mut list: Vec<[usize; 3]> = Vec::new();
    for cycle in &system.cycles {
        let turns: Vec<Option<usize>> = cycle
            .links
            .iter()
            .filter_map(|link| match link {
                Link::Free { motion, unknown } => {
                    let wanted = system.unknowns[*unknown].wanted && matches!(motion, Motion::Revolute(_));
                    Some(wanted.then_some(*unknown))
                }
                Link::Known { .. } => None,
            })
            .collect();
        for start in 0..turns.len() {
            let [Some(a), Some(b), Some(c)] = [0, 1, 2].map(|k| turns[(start + k) % turns.len()]) else { continue };
            let mut own = [a, b, c];
            own.sort_unstable();
            let apart = a != b && b != c && a != c;
            let counted = own.iter().any(|&number| system.counts_turns(g, number));
            if apart && !counted && !list.contains(&own) && Spherical::new(g, cycle, own).is_some() {
                list.push(own);
            }
        }
    }
    list
}
