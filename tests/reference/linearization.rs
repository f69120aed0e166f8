//! `emit linearize`: A, B, C and D against dual numbers put through the equations and the outputs, against textbooks, and the
//! turning of axes against rotations that are carried on.

use multibody::nalgebra::{Matrix3, Vector3};
use multibody::{Configuration, Linearization, Real, StateSpace, System, Tangent};
use multibody_tests::models::state_space;
use multibody_tests::support::compare::{relative, worse};
use multibody_tests::support::random::Random;
use num_dual::Dual64;

/// Of max |x - ref| over max |ref| per matrix.
const TOLERANCE: f64 = 1e-12;

/// A model, its matrices and its outputs as a list.
trait Linearized: System {
    fn matrices(&self, t: Self::Scalar, state: &Self::State, input: &Self::Input) -> [Vec<Vec<Self::Scalar>>; 4];
    fn shown(&self, t: Self::Scalar, state: &Self::State, input: &Self::Input) -> Vec<Self::Scalar>;
}

/// Rows of A, B, C and D.
fn rows<T: Real, const X: usize, const U: usize, const Y: usize>(of: &Linearization<T, X, U, Y>) -> [Vec<Vec<T>>; 4] {
    let a = (0..X).map(|i| (0..X).map(|j| of.a[(i, j)]).collect()).collect();
    let b = (0..X).map(|i| (0..U).map(|j| of.b[(i, j)]).collect()).collect();
    let c = (0..Y).map(|i| (0..X).map(|j| of.c[(i, j)]).collect()).collect();
    let d = (0..Y).map(|i| (0..U).map(|j| of.d[(i, j)]).collect()).collect();
    [a, b, c, d]
}

macro_rules! linearized {
    ($($module:ident: $list:expr;)*) => {$(
        impl<T: Real> Linearized for state_space::$module::Model<T> {
            fn matrices(&self, t: T, state: &Self::State, input: &Self::Input) -> [Vec<Vec<T>>; 4] {
                rows(&self.linearize(t, state, input))
            }
            fn shown(&self, t: T, state: &Self::State, input: &Self::Input) -> Vec<T> {
                let list: fn(&state_space::$module::Output<T>) -> Vec<T> = $list;
                list(&self.outputs(t, state, input))
            }
        }
    )*};
}

linearized! {
    cart_pole: |y| [y.tip.as_slice(), y.bearing.as_slice()].concat();
    wheel_pendulum: |y| vec![y.angle, y.torque, y.power];
    craft: |y| {
        let turns = [&y.hull_turn, &y.head_turn].map(|turn| turn.matrix().transpose().as_slice().to_vec());
        let [hull, head] = turns;
        let seen = [y.seen.position.as_slice(), &{
            let q = y.seen.orientation.quaternion();
            [q.w, q.i, q.j, q.k]
        }].concat();
        let load = [y.load.force.as_slice(), y.load.moment.as_slice()].concat();
        [hull, head, seen, y.felt.as_slice().to_vec(), load].concat()
    };
    solved: |y| [y.top.as_slice(), y.load.as_slice(), &[y.angle, y.turning]].concat();
    iterated: |y| [y.top.as_slice(), y.load.as_slice(), &[y.angle, y.turning]].concat();
    held: |y| [y.top.as_slice(), y.load.as_slice(), &[y.angle, y.turning]].concat();
}

fn filled<T: Real, V: Tangent<T>>(values: &[f64]) -> V {
    let mut values = values.iter();
    V::zero().map(&mut |_| T::lit(*values.next().expect("a value for each component")))
}

fn components<T: Real, V: Tangent<T>>(v: &V) -> Vec<T> {
    v.fold(Vec::new(), &mut |mut list: Vec<T>, x: T| {
        list.push(x);
        list
    })
}

/// With a derivative of one along a component.
fn seeded<V: Tangent<Dual64>>(v: &V, at: Option<usize>) -> V {
    let mut place = 0;
    v.map(&mut |x| {
        let eps = if at == Some(place) { 1.0 } else { 0.0 };
        place += 1;
        Dual64::new(x.re, x.eps + eps)
    })
}

/// Where equations are linearised: displacement from the start, velocities, own states, inputs.
struct Point([Vec<f64>; 4]);

impl Point {
    fn state<S: System>(&self, start: &S::State) -> S::State {
        let [q, v, x, _] = &self.0;
        start.join(start.split().0.displace(&filled(q)), filled(v), filled(x))
    }
}

/// Errors of A (accelerations and own states), B, C and D.
fn errors<M, D>(model: &M, dual: &D, starts: (&M::State, &D::State), point: &Point) -> [f64; 4]
where
    M: Linearized<Scalar = f64>,
    D: Linearized<Scalar = Dual64>,
    M::Input: Tangent<f64>,
    D::Input: Tangent<Dual64>,
{
    let t = 0.3;
    let input: M::Input = filled(&point.0[3]);
    let twin_input: D::Input = filled(&point.0[3]);
    let twin = point.state::<D>(starts.1);
    let close = |state: D::State| (0..4).fold(state, |state, _| dual.accepted(Dual64::lit(t), &state, &twin_input));
    let state = (0..4).fold(point.state::<M>(starts.0), |state, _| model.accepted(t, &state, &input));
    let got = model.matrices(t, &state, &input);
    let counts = [point.0[0].len(), point.0[1].len(), point.0[2].len(), point.0[3].len()];
    let n = counts[0];
    // Columns of the matrices in the order of x and u.
    let (mut rates, mut outputs) = (Vec::new(), Vec::new());
    for (kind, count) in counts.into_iter().enumerate() {
        for at in 0..count {
            let along = |of: usize| (of == kind).then_some(at);
            let (q, v, x) = twin.split();
            let moved =
                twin.join(q.displace(&seeded(&Tangent::zero(), along(0))), seeded(&v, along(1)), seeded(&x, along(2)));
            let moved = close(moved);
            let input = seeded(&twin_input, along(3));
            let (v, x) = dual.derivative(Dual64::lit(t), &moved, &input);
            let slopes = |list: Vec<Dual64>| -> Vec<f64> { list.iter().map(|x| x.eps).collect() };
            rates.push(slopes([components(&v), components(&x)].concat()));
            outputs.push(slopes(dual.shown(Dual64::lit(t), &moved, &input)));
        }
    }
    let size = n + counts[1] + counts[2];
    let error = |got: &[Vec<f64>], columns: &[Vec<f64>]| {
        let got: Vec<f64> = got.iter().flatten().copied().collect();
        let height = columns.first().map_or(0, Vec::len);
        let want: Vec<f64> = (0..height).flat_map(|row| columns.iter().map(move |column| column[row])).collect();
        assert_eq!(got.len(), want.len());
        relative(&got, &want)
    };
    assert!(got[1][..n].iter().flatten().all(|entry| *entry == 0.0), "inputs move no position at once");
    [
        error(&got[0][n..], &rates[..size]),
        error(&got[1][n..], &rates[size..]),
        error(&got[2], &outputs[..size]),
        error(&got[3], &outputs[size..]),
    ]
}

macro_rules! models {
    ($($module:ident: $q:expr, $spread:expr;)*) => {$(
        #[test]
        fn $module() {
            use state_space::$module::{Input, Model, State};
            let (model, dual) = (Model::<f64>::default(), Model::<Dual64>::default());
            let (start, twin) = (State::default(), State::default());
            let (_, v, x) = start.split();
            let (n, x) = (components::<f64, _>(&v).len(), components::<f64, _>(&x).len());
            let u = components(&<Input<f64> as Tangent<f64>>::zero()).len();
            let mut random = Random::new(11);
            let mut worst = [0.0; 4];
            let rough: &[f64] = &$q;
            for _ in 0..12 {
                let mut draw = |count: usize| -> Vec<f64> { (0..count).map(|_| random.unit()).collect() };
                let mut q = draw(n);
                q.iter_mut().enumerate().for_each(|(k, x)| *x = rough.get(k).unwrap_or(&0.0) + $spread * *x);
                let point = Point([q, draw(n), draw(x), draw(u)]);
                let errors = errors(&model, &dual, (&start, &twin), &point);
                worst = std::array::from_fn(|k| worse(worst[k], errors[k]));
            }
            println!("{}: {worst:?}", stringify!($module));
            assert!(worst.iter().all(|error| *error <= TOLERANCE), "{worst:?}");
        }
    )*};
}

models! {
    cart_pole: [], 3.0;
    wheel_pendulum: [], 3.0;
    craft: [], 1.0;
    solved: [0.9], 0.6;
    iterated: [0.9], 0.3;
    held: [0.9, -0.4, 1.2], 0.4;
}

/// Upright, a pole and its cart obey (M + m) x'' - m l th'' = u and (J + m l^2) th'' - m l x'' = m g l th, with half the
/// length for l and th counted against x: Ogata, Modern Control Engineering, section 3-5.
#[test]
fn cart_pole_of_the_textbook() {
    use state_space::cart_pole::{Input, Model, Params, State};
    let p: Params<f64> = Params::default();
    let (m, l, g) = (p.pole_mass, 0.5 * p.length, p.g);
    let (total, about) = (p.cart_mass + m, m * p.length * p.length / 3.0);
    let det = total * about - m * m * l * l;
    let linear = Model::default().linearize(0.0, &State::default(), &Input { push: 0.0 });
    let mut a = [[0.0; 4]; 4];
    (a[0][2], a[1][3]) = (1.0, 1.0);
    (a[2][1], a[3][1]) = (m * l * m * g * l / det, total * m * g * l / det);
    let b = [0.0, 0.0, about / det, m * l / det];
    for row in 0..4 {
        for column in 0..4 {
            assert!((linear.a[(row, column)] - a[row][column]).abs() <= 1e-13 * a[3][1], "A[{row}, {column}]");
        }
        assert!((linear.b[(row, 0)] - b[row]).abs() <= 1e-13, "B[{row}]");
    }
    // The tip's acceleration is x'' - l th'' across; what the bearing bears upwards is the pole's weight.
    for (column, [x, th]) in [[0.0, 0.0], [a[2][1], a[3][1]], [0.0, 0.0], [0.0, 0.0]].into_iter().enumerate() {
        assert!((linear.c[(0, column)] - (x - p.length * th)).abs() <= 1e-12 * a[3][1]);
        assert!(linear.c[(4, column)].abs() <= 1e-12);
    }
    assert!((linear.d[(0, 0)] - (b[2] - p.length * b[3])).abs() <= 1e-12);
}

/// A displacement is an angle about the body's own axes, which turn on: carried on with the velocities, the turn between two
/// neighbours changes as A says.
#[test]
fn displacements_in_axes_that_turn() {
    use state_space::craft::{Input, Model, State};
    let model = Model::<f64>::default();
    let mut random = Random::new(3);
    let mut draw = |count: usize| -> Vec<f64> { (0..count).map(|_| random.unit()).collect() };
    let point = Point([draw(10), draw(10), vec![0.2], vec![0.0; 5]]);
    let state: State<f64> = point.state::<Model<f64>>(&State::default());
    let input: Input<f64> = filled(&point.0[3]);
    let linear = model.linearize(0.0, &state, &input);
    // Places of the first component of each rotation among the displacements, and its turn among the outputs, relative to
    // the frame that it turns in.
    let relative_turns = |state: &State<f64>| {
        let y = model.outputs(0.0, state, &input);
        let (hull, head): (Matrix3<f64>, Matrix3<f64>) = (*y.hull_turn.matrix(), *y.head_turn.matrix());
        [(3, hull), (6, hull.transpose() * head)]
    };
    let (eps, h) = (1e-4, 1e-4);
    for column in 0..10 {
        let mut unit = [0.0; 10];
        unit[column] = eps;
        let beside = |sign: f64| {
            let unit = unit.map(|x| sign * x);
            State { q: state.q.displace(&filled(&unit)), ..state }
        };
        let later = |state: &State<f64>, h: f64| {
            let moved = components::<f64, _>(&state.v).iter().map(|v| h * v).collect::<Vec<f64>>();
            relative_turns(&State { q: state.q.displace(&filled(&moved)), ..*state })
        };
        let between = |h: f64| -> [(usize, Vector3<f64>); 2] {
            let (right, left) = (later(&beside(1.0), h), later(&beside(-1.0), h));
            std::array::from_fn(|k| {
                let turn = left[k].1.transpose() * right[k].1;
                let axial =
                    Vector3::new(turn[(2, 1)] - turn[(1, 2)], turn[(0, 2)] - turn[(2, 0)], turn[(1, 0)] - turn[(0, 1)]);
                (left[k].0, axial / (4.0 * eps))
            })
        };
        let (before, after) = (between(-h), between(h));
        for ((first, before), (_, after)) in before.into_iter().zip(after) {
            let rate = (after - before) / (2.0 * h);
            for k in 0..3 {
                let got = linear.a[(first + k, column)];
                assert!((got - rate[k]).abs() <= 1e-6, "A[{}, {column}]: {got} for {}", first + k, rate[k]);
            }
        }
    }
}
