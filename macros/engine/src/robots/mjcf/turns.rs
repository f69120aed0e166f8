//! Stage `robots`, MJCF: rotations, and where bodies are while all coordinates are zero.

use super::super::robot::{Number, Origin};

pub(super) type Vector = [f64; 3];
pub(super) type Matrix = [Vector; 3];
/// w, x, y, z
pub(super) type Quaternion = [f64; 4];

pub(super) const NONE: Quaternion = [1.0, 0.0, 0.0, 0.0];

/// Below it an angle is what the arithmetic of `f64` has left.
const SMALLEST: f64 = 1e-14;

pub(super) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Nothing if it has no direction.
pub(super) fn unit(a: Vector) -> Option<Vector> {
    let length = dot(a, a).sqrt();
    (length > 0.0).then(|| a.map(|x| x / length))
}

pub(super) fn about(axis: Vector, angle: f64) -> Option<Quaternion> {
    let [x, y, z] = unit(axis)?;
    let (sine, cosine) = (angle / 2.0).sin_cos();
    Some([cosine, sine * x, sine * y, sine * z])
}

pub(super) fn product(a: Quaternion, b: Quaternion) -> Quaternion {
    [
        a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
        a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
        a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
        a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
    ]
}

/// The shortest turn that takes Z along `to`, a unit vector.
pub(super) fn from_z(to: Vector) -> Quaternion {
    let axis = cross([0.0, 0.0, 1.0], to);
    let angle = dot(axis, axis).sqrt().atan2(to[2]);
    // Along Z there is nothing to turn about; against it, any axis across does.
    about(axis, angle).or_else(|| about([1.0, 0.0, 0.0], angle)).unwrap_or(NONE)
}

/// Of axes x, y, z that are at right angles and of length one.
pub(super) fn of_axes([x, y, z]: [Vector; 3]) -> Quaternion {
    // The largest of the four squares, so that no small number divides.
    let squares =
        [1.0 + x[0] + y[1] + z[2], 1.0 + x[0] - y[1] - z[2], 1.0 - x[0] + y[1] - z[2], 1.0 - x[0] - y[1] + z[2]];
    let sums = [
        [squares[0], y[2] - z[1], z[0] - x[2], x[1] - y[0]],
        [y[2] - z[1], squares[1], x[1] + y[0], z[0] + x[2]],
        [z[0] - x[2], x[1] + y[0], squares[2], y[2] + z[1]],
        [x[1] - y[0], z[0] + x[2], y[2] + z[1], squares[3]],
    ];
    let largest = (0..4).fold(0, |best, k| if squares[k] > squares[best] { k } else { best });
    normal(sums[largest]).unwrap_or(NONE)
}

pub(super) fn normal(q: Quaternion) -> Option<Quaternion> {
    let length = q.iter().map(|x| x * x).sum::<f64>().sqrt();
    (length > 0.0).then(|| q.map(|x| x / length))
}

pub(super) fn matrix([w, x, y, z]: Quaternion) -> Matrix {
    [
        [w * w + x * x - y * y - z * z, 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
        [2.0 * (x * y + w * z), w * w - x * x + y * y - z * z, 2.0 * (y * z - w * x)],
        [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), w * w - x * x - y * y + z * z],
    ]
}

/// Roll, pitch and yaw.
pub(super) fn rpy(q: Quaternion) -> [Number; 3] {
    let m = matrix(q);
    let across = m[2][1].hypot(m[2][2]);
    let pitch = (-m[2][0]).atan2(across);
    // With the pitch at a quarter turn, roll and yaw turn about one axis: all of it is yaw.
    let (roll, yaw) = match across > 1e-12 {
        true => (m[2][1].atan2(m[2][2]), m[1][0].atan2(m[0][0])),
        false => (0.0, (-m[0][1]).atan2(m[1][1])),
    };
    [roll, pitch, yaw].map(|angle| Number::of(if angle.abs() < SMALLEST { 0.0 } else { angle }))
}

/// Of a frame in another one.
#[derive(Clone, Copy)]
pub(super) struct Pose {
    pub(super) position: Vector,
    pub(super) turn: Quaternion,
}

impl Pose {
    pub(super) const NONE: Pose = Pose { position: [0.0; 3], turn: NONE };

    pub(super) fn point(self, inside: Vector) -> Vector {
        let turned = matrix(self.turn).map(|row| dot(row, inside));
        [0, 1, 2].map(|k| self.position[k] + turned[k])
    }

    pub(super) fn then(self, inner: Pose) -> Pose {
        Pose { position: self.point(inner.position), turn: product(self.turn, inner.turn) }
    }

    pub(super) fn inverse(self) -> Pose {
        let [w, x, y, z] = self.turn;
        let back = Pose { position: [0.0; 3], turn: [w, -x, -y, -z] };
        Pose { position: back.point(self.position.map(|x| -x)), ..back }
    }

    pub(super) fn origin(self) -> Origin {
        Origin { xyz: self.position.map(Number::of), rpy: rpy(self.turn) }
    }
}
