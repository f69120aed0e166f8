//! What a file has beside its tree, by a reader of its own: loops of URDF+, couplings and mimicking joints as rows of velocities,
//! and dense elimination.

use roxmltree::{Document, Node};

use crate::recursion::{Link, Matrix, Motion, Vector, add, apply, child, cross, dot, numbers, product, rpy, scaled};

/// A link and the frame of a joint in it.
struct End {
    link: usize,
    at: Vector,
    turned: Matrix,
}

/// A revolute joint that closes a loop.
struct Loop {
    ends: [End; 2],
    axis: Vector,
}

pub(crate) struct Ties {
    loops: Vec<Loop>,
    /// `sum of factor * coordinate = offset`
    linear: Vec<(Vec<(usize, f64)>, f64)>,
}

/// Rows that the velocities are orthogonal to, what is wrong with the positions, and the accelerations that the rows give while no
/// coordinate accelerates.
pub(crate) struct Rows {
    pub(crate) jacobian: Vec<Vec<f64>>,
    pub(crate) error: Vec<f64>,
    pub(crate) acceleration: Vec<f64>,
}

impl Ties {
    /// `joints` names each coordinate.
    pub(crate) fn read(text: &str, links: &[Link], joints: &[String]) -> Ties {
        let document = Document::parse(text).unwrap();
        let all = |tag| document.root_element().children().filter(move |node| node.has_tag_name(tag));
        let find =
            |node: Node| links.iter().position(|link| Some(link.name.as_str()) == node.attribute("link")).unwrap();
        let coordinate = |name: &str| joints.iter().position(|joint| joint == name).unwrap();
        let end = |tie: Node, name| {
            let node = child(tie, name).unwrap();
            let origin = child(node, "origin");
            End { link: find(node), at: numbers(origin, "xyz"), turned: rpy(numbers(origin, "rpy")) }
        };
        let loops = all("loop").map(|tie| Loop {
            ends: [end(tie, "predecessor"), end(tie, "successor")],
            axis: numbers(child(tie, "axis"), "xyz"),
        });
        let couplings = all("coupling").map(|tie| {
            let [a, b] = ["predecessor", "successor"].map(|name| way(links, end(tie, name).link));
            let ratio = numbers::<1>(child(tie, "ratio"), "value")[0];
            let side = |own: &[usize], other: &[usize], factor: f64| -> Vec<(usize, f64)> {
                let moves = |link: &&usize| !other.contains(link) && links[**link].kind != "fixed";
                own.iter().filter(moves).map(|link| (coordinate(&links[*link].joint), factor)).collect()
            };
            ([side(&a, &b, ratio), side(&b, &a, -1.0)].concat(), 0.0)
        });
        let mimics = all("joint").filter_map(|joint| {
            let mimic = child(joint, "mimic")?;
            let number = |name| mimic.attribute(name).unwrap().parse::<f64>().unwrap();
            let own = (coordinate(joint.attribute("name").unwrap()), 1.0);
            let leader = (coordinate(mimic.attribute("joint").unwrap()), -number("multiplier"));
            Some((vec![own, leader], number("offset")))
        });
        Ties { linear: couplings.chain(mimics).collect(), loops: loops.collect() }
    }

    pub(crate) fn rows(&self, motions: &[Motion], q: &[f64]) -> Rows {
        let mut rows = Rows { jacobian: Vec::new(), error: Vec::new(), acceleration: Vec::new() };
        for Loop { ends, axis } in &self.loops {
            let arms = ends.each_ref().map(|end| apply(&motions[end.link].turned, end.at));
            let [a, b] = ends.each_ref().map(|end| &motions[end.link]);
            let points = [add(a.place, arms[0]), add(b.place, arms[1])];
            let axes = ends.each_ref().map(|end| apply(&product(&motions[end.link].turned, &end.turned), *axis));
            let lengths = axes.map(|axis| dot(axis, axis).sqrt());
            let axes = [0, 1].map(|k| scaled(axes[k], 1.0 / lengths[k]));
            let columns = [a.columns(points[0]), b.columns(points[1])];
            let mut row = |direction: Vector, is_turn: bool, error: f64, acceleration: f64| {
                let mut row = vec![0.0; q.len()];
                for (columns, sign) in columns.iter().zip([-1.0, 1.0]) {
                    for &(number, linear, angular) in columns {
                        row[number] += sign * dot(direction, if is_turn { angular } else { linear });
                    }
                }
                rows.jacobian.push(row);
                rows.error.push(error);
                rows.acceleration.push(acceleration);
            };
            let minus = |a: Vector, b: Vector| add(a, scaled(b, -1.0));
            let apart = minus(points[1], points[0]);
            let pulled = minus(b.acceleration_at(arms[1]), a.acceleration_at(arms[0]));
            for k in 0..3 {
                let direction = [0, 1, 2].map(|i| f64::from(i == k));
                row(direction, false, apart[k], pulled[k]);
            }
            // The joint turns about an axis that the first link carries: alpha_b - alpha_a = theta'' n + theta' omega_a x n.
            let rate = dot(axes[0], minus(b.omega, a.omega));
            let turned = minus(minus(b.alpha, a.alpha), scaled(cross(a.omega, axes[0]), rate));
            let least = (0..3).min_by(|i, j| axes[0][*i].abs().total_cmp(&axes[0][*j].abs())).unwrap();
            let first = cross(axes[0], [0, 1, 2].map(|i| f64::from(i == least)));
            for direction in [first, cross(axes[0], first)] {
                row(direction, true, dot(direction, cross(axes[0], axes[1])), dot(direction, turned));
            }
        }
        for (terms, offset) in &self.linear {
            let mut row = vec![0.0; q.len()];
            terms.iter().for_each(|(number, factor)| row[*number] += factor);
            rows.error.push(row.iter().zip(q).map(|(factor, q)| factor * q).sum::<f64>() - offset);
            rows.jacobian.push(row);
            rows.acceleration.push(0.0);
        }
        rows
    }
}

/// Links from one to the root.
fn way(links: &[Link], link: usize) -> Vec<usize> {
    std::iter::successors(Some(link), |link| links[*link].parent).collect()
}

/// Solves a system that has solutions, by Gauss' elimination with pivots from all that is left. What no equation determines is
/// zero.
pub(crate) fn gauss(mut matrix: Vec<Vec<f64>>, mut right: Vec<f64>) -> Vec<f64> {
    let columns = matrix.first().map_or(0, Vec::len);
    let largest = matrix.iter().flatten().fold(0.0_f64, |largest, x| largest.max(x.abs()));
    let mut pivots: Vec<usize> = Vec::new();
    for step in 0..matrix.len().min(columns) {
        let places = (step..matrix.len()).flat_map(|row| (0..columns).map(move |column| (row, column)));
        let free = places.filter(|(_, column)| !pivots.contains(column));
        let size = |(row, column): (usize, usize)| matrix[row][column].abs();
        let Some((row, column)) = free.max_by(|a, b| size(*a).total_cmp(&size(*b))) else { break };
        if size((row, column)) < 1e-12 * largest {
            break;
        }
        matrix.swap(step, row);
        right.swap(step, row);
        pivots.push(column);
        let (pivot, head) = (matrix[step].clone(), right[step]);
        for (other, value) in
            matrix.iter_mut().zip(&mut right).enumerate().filter(|(k, _)| *k != step).map(|(_, rest)| rest)
        {
            let factor = other[column] / pivot[column];
            other.iter_mut().zip(&pivot).for_each(|(x, p)| *x -= factor * p);
            *value -= factor * head;
        }
    }
    let mut solution = vec![0.0; columns];
    for (step, column) in pivots.into_iter().enumerate() {
        solution[column] = right[step] / matrix[step][column];
    }
    solution
}
