//! All real roots of a sum of sines and cosines of multiples of one angle, without a heap and without a branch on a number.
//!
//! The sum of degree `n` is known by its values at `2 n + 1` points in equal distances, from which its coefficients follow by
//! Fourier's sums. Seen from the point where its value is greatest, as which infinity is taken, the half angle's tangent x obeys a
//! polynomial of degree `2 n` whose first coefficient is that greatest value: no root lies far out. Between two neighbouring roots
//! of its derivative it has at most one root (Rolle), which is found where the sign changes, by Newton's method that is kept
//! in its bracket; these in turn come of the next derivative, down to the straight line. Each root is then improved on the circle by
//! what the sum is there itself.
//!
//! Double roots lie at the rounding of the sum: where it comes within that of zero and turns back, that is one root. The number of
//! operations is the same for all sums of one degree.

use crate::Real;

/// Rounds of Newton's method in its bracket. Where a step is no shorter than half of the one before the last, the bracket is halved
/// instead (Press et al. 2007, section 9.4).
const ROUNDS: usize = 32;

/// Rounds of Newton's method on the circle behind that.
const IMPROVEMENTS: usize = 2;

/// Largest step of those: beyond it, two roots are about to meet, and the step says nothing.
const LARGEST: f64 = 0.001;

/// How many roundings of its greatest value the sum may stay away from zero where it touches it.
const ROUNDINGS: f64 = 65_536.0;

/// Where the points of equal distances begin: at no angle that a symmetric mechanism is symmetric about.
const FIRST: f64 = 0.377;

/// The points of the circle, as cosine and sine, where a sum of sines and cosines of multiples up to `ROOTS / 2` of its angle vanishes.
/// `SAMPLES` is `ROOTS + 1`. Real ones stand first, in the order of the angle from some point on; the others are NaN.
///
/// ```
/// use multibody::assembly::roots::on_circle;
///
/// // cos(2 t) = 1/2
/// let roots = on_circle::<f64, 5, 4>(|[c, s]| c * c - s * s - 0.5);
/// assert!(roots.iter().all(|[c, s]| (c.abs() - 0.75_f64.sqrt()).abs() < 1e-15 && (s.abs() - 0.5).abs() < 1e-15));
///
/// // cos(t) = 2
/// let roots = on_circle::<f64, 3, 2>(|[c, _]| c - 2.0);
/// assert!(roots.iter().flatten().all(|x| x.is_nan()));
/// ```
#[must_use]
pub fn on_circle<T: Real, const SAMPLES: usize, const ROOTS: usize>(value: impl Fn([T; 2]) -> T) -> [[T; 2]; ROOTS] {
    const { assert!(SAMPLES == ROOTS + 1, "as many samples as coefficients") };
    let series = Series::<T, SAMPLES>::new(&value);
    let (tangents, real) = real_roots::<T, SAMPLES, ROOTS>(&series.polynomial(), series.greatest);
    let nan = T::lit(f64::NAN);
    let mut points = [[nan; 2]; ROOTS];
    let mut next = T::lit(0.0);
    for (&x, &is_real) in tangents.iter().zip(&real) {
        let mut point = turned(series.origin, x);
        for _ in 0..IMPROVEMENTS {
            let step = value(point) / series.slope(point);
            let small = Real::le(Real::abs(step), T::lit(LARGEST));
            let half = Real::select(small, T::lit(-0.5) * step, T::lit(0.0));
            point = turned(point, half);
        }
        // To the next free place.
        for (place, slot) in points.iter_mut().enumerate() {
            let here = is_real & Real::eq(next, T::lit(place as f64));
            *slot = [0, 1].map(|k| Real::select(here, point[k], slot[k]));
        }
        next += Real::select(is_real, T::lit(1.0), T::lit(0.0));
    }
    points
}

/// A point of the circle, turned by twice the angle whose tangent is x.
fn turned<T: Real>([c, s]: [T; 2], x: T) -> [T; 2] {
    let one = T::lit(1.0);
    let inverse = one / (one + x * x);
    let (cos, sin) = ((one - x * x) * inverse, (x + x) * inverse);
    [c * cos - s * sin, s * cos + c * sin]
}

/// The product of two complex numbers.
fn product<T: Real>([a, b]: [T; 2], [c, d]: [T; 2]) -> [T; 2] {
    [a * c - b * d, b * c + a * d]
}

/// A sum of sines and cosines: the real part of c_0 + c_1 z + c_2 z^2 + .. at a point z = e^(i t) of the circle, where angles
/// begin at the origin. The second half of the coefficients is not used.
struct Series<T, const SAMPLES: usize> {
    origin: [T; 2],
    /// Of the samples' sizes.
    greatest: T,
    coefficients: [[T; 2]; SAMPLES],
}

impl<T: Real, const SAMPLES: usize> Series<T, SAMPLES> {
    const DEGREE: usize = SAMPLES / 2;

    fn new(value: impl Fn([T; 2]) -> T) -> Self {
        let zero = T::lit(0.0);
        let step = core::f64::consts::TAU / SAMPLES as f64;
        let point = |k: usize| {
            let (sin, cos) = Real::sin_cos(T::lit(FIRST + k as f64 * step));
            [cos, sin]
        };
        let values: [T; SAMPLES] = core::array::from_fn(|k| value(point(k)));
        let (mut greatest, mut far) = (Real::abs(values[0]), point(0));
        for (k, &value) in values.iter().enumerate().skip(1) {
            let greater = Real::gt(Real::abs(value), greatest);
            greatest = Real::select(greater, Real::abs(value), greatest);
            let other = point(k);
            far = [0, 1].map(|k| Real::select(greater, other[k], far[k]));
        }
        // What is not finite leaves nothing finite.
        let sum = values.iter().fold(zero, |sum, &value| sum + value * zero);
        let origin = far.map(|x| sum - x);
        let scale = T::lit(2.0 / SAMPLES as f64);
        let mut coefficients = [[zero; 2]; SAMPLES];
        for (k, &value) in values.iter().enumerate() {
            let [c, s] = point(k);
            // Clockwise, from the origin.
            let back = product([c, -s], origin);
            let mut power = [value * scale, zero];
            for coefficient in coefficients.iter_mut().take(Self::DEGREE + 1) {
                *coefficient = [coefficient[0] + power[0], coefficient[1] + power[1]];
                power = product(power, back);
            }
        }
        coefficients[0] = [coefficients[0][0] * T::lit(0.5), zero];
        Series { origin, greatest, coefficients }
    }

    /// The derivative by the angle.
    fn slope(&self, point: [T; 2]) -> T {
        let [c, s] = self.origin;
        let z = product(point, [c, -s]);
        let (mut power, mut sum) = ([T::lit(1.0), T::lit(0.0)], T::lit(0.0));
        for (k, &coefficient) in self.coefficients.iter().enumerate().take(Self::DEGREE + 1).skip(1) {
            power = product(power, z);
            sum -= T::lit(k as f64) * product(coefficient, power)[1];
        }
        sum
    }

    /// Coefficients by rising powers of x = tan(t / 2): the series times (1 + x^2)^n, where z = (1 + i x) / (1 - i x).
    fn polynomial(&self) -> [T; SAMPLES] {
        let (zero, n) = (T::lit(0.0), Self::DEGREE);
        // With u = 1 + i x, w = 1 - i x it is the sum of c_j u^(n + j) w^(n - j) over j from -n to n, c_j and c_-j conjugate and halved;
        // by Horner's rule in u, with the power of w beside it.
        let mut sum = [[zero; 2]; SAMPLES];
        let mut power = [[zero; 2]; SAMPLES];
        power[0] = [T::lit(1.0), zero];
        for step in 0..=2 * n {
            let coefficient = match step {
                step if step < n => self.coefficients[n - step].map(|x| x * T::lit(0.5)),
                step if step == n => self.coefficients[0],
                step => {
                    let [a, b] = self.coefficients[step - n];
                    [a * T::lit(0.5), -b * T::lit(0.5)]
                }
            };
            if step > 0 {
                times_line(&mut sum, T::lit(1.0));
                times_line(&mut power, T::lit(-1.0));
            }
            for (sum, &power) in sum.iter_mut().zip(&power) {
                let term = product(coefficient, power);
                *sum = [sum[0] + term[0], sum[1] + term[1]];
            }
        }
        sum.map(|[real, _]| real)
    }
}

/// A polynomial times 1 + i slope x.
fn times_line<T: Real, const SIZE: usize>(polynomial: &mut [[T; 2]; SIZE], slope: T) {
    for k in (1..SIZE).rev() {
        let [a, b] = polynomial[k - 1];
        polynomial[k] = [polynomial[k][0] - slope * b, polynomial[k][1] + slope * a];
    }
}

/// Real roots of a polynomial by rising powers, rising themselves, with whether each is one. Its first coefficient is not small beside
/// the others, so that none lies beyond a bound; `greatest` is its value beside (1 + x^2)^n.
fn real_roots<T: Real, const SIZE: usize, const ROOTS: usize>(
    polynomial: &[T; SIZE],
    greatest: T,
) -> ([T; ROOTS], [T::Mask; ROOTS]) {
    let zero = T::lit(0.0);
    let bound = T::lit(4.0 * SIZE as f64);
    let mut roots = [-bound; ROOTS];
    let mut real = [Real::lt(zero, zero); ROOTS];
    let mut wide = real;
    for degree in 1..=ROOTS {
        let derivative = derivative::<T, SIZE>(polynomial, ROOTS - degree);
        let separators = roots;
        let mut low = -bound;
        let mut below = evaluate(&derivative[..=degree], low)[0];
        for k in 0..degree {
            let high = if k + 1 < degree { separators[k] } else { bound };
            let above = evaluate(&derivative[..=degree], high)[0];
            let up = Real::le(below, zero) & Real::ge(above, zero);
            let down = Real::ge(below, zero) & Real::le(above, zero);
            wide[k] = Real::lt(low, high);
            real[k] = (up | down) & wide[k];
            let found = in_bracket(&derivative[..=degree], low, high, below);
            roots[k] = Real::select(real[k], found, low);
            (low, below) = (high, above);
        }
    }
    // Where the value turns back from zero, both sides have the same sign, and the place is still that of the derivative.
    let rounding = T::lit(ROUNDINGS) * T::epsilon() * greatest;
    for k in 1..ROOTS {
        let x = roots[k];
        let value = evaluate(polynomial, x)[0];
        let scale = Real::powi(T::lit(1.0) + x * x, (ROOTS / 2) as i32);
        real[k] = real[k] | (wide[k] & Real::le(Real::abs(value), rounding * scale));
    }
    (roots, real)
}

/// The derivative of some order, divided by the factorial of the order.
fn derivative<T: Real, const SIZE: usize>(polynomial: &[T; SIZE], order: usize) -> [T; SIZE] {
    let mut list = [T::lit(0.0); SIZE];
    let mut binomial = 1.0;
    for k in 0..SIZE - order {
        list[k] = T::lit(binomial) * polynomial[k + order];
        binomial = binomial * (k + order + 1) as f64 / (k + 1) as f64;
    }
    list
}

/// Value and slope.
fn evaluate<T: Real>(polynomial: &[T], x: T) -> [T; 2] {
    let zero = T::lit(0.0);
    polynomial.iter().rev().fold([zero, zero], |[value, slope], &c| [value * x + c, slope * x + value])
}

/// The root between two places of which the first one has the value `below`, and the other one the other sign. Steps and brackets
/// are those on the circle: of the polynomial over the power of 1 + x^2 that leaves it bounded, and halved by angle.
fn in_bracket<T: Real>(polynomial: &[T], mut low: T, mut high: T, below: T) -> T {
    let (zero, one) = (T::lit(0.0), T::lit(1.0));
    let degree = T::lit((polynomial.len() - 1) as f64);
    let falls = Real::gt(below, zero);
    let mut x = middle(low, high);
    // The last two steps.
    let (mut before_last, mut last) = (T::lit(core::f64::consts::PI), T::lit(core::f64::consts::PI));
    for _ in 0..ROUNDS {
        let [value, slope] = evaluate(polynomial, x);
        let short = Real::eq(value, zero) | (Real::gt(value, zero) & falls) | (Real::lt(value, zero) & !falls);
        low = Real::select(short, x, low);
        high = Real::select(short, high, x);
        let scale = one / (one + x * x);
        let step = value / (slope - degree * x * scale * value);
        let inside = Real::ge(x - step, low) & Real::le(x - step, high);
        let fast = Real::le(Real::abs(step + step) * scale, Real::abs(before_last));
        let next = Real::select(inside & fast, x - step, middle(low, high));
        (before_last, last) = (last, (next - x) * scale);
        x = next;
    }
    x
}

/// The tangent of the angle halfway between those of two tangents.
fn middle<T: Real>(a: T, b: T) -> T {
    let one = T::lit(1.0);
    (a + b) / (one - a * b + Real::sqrt((one + a * a) * (one + b * b)))
}
