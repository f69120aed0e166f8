//! [`Serial`] of what fields of generated structs are made of.

use core::fmt;
use core::marker::PhantomData;

use nalgebra::{Quaternion, Rotation3, SMatrix, UnitQuaternion};
use serde::de::{Error, SeqAccess, Visitor};
use serde::ser::SerializeTuple;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::{Number, Serial, Written, element};
use crate::{
    Cylindrical, FreeRollPitchYaw, PinSlot, Placement, Planar, Pose, RollPitchYaw, Twist, Universal, Wrench, all,
    serialised,
};

serialised! { Universal { first: "first", second: "second" } }
serialised! { Cylindrical { travel: "travel", angle: "angle" } }
serialised! { Planar { x: "x", y: "y", angle: "angle" } }
serialised! { PinSlot { travel: "travel", angle: "angle" } }
serialised! { RollPitchYaw { roll: "roll", pitch: "pitch", yaw: "yaw" } }
serialised! { FreeRollPitchYaw { position: "position", orientation: "orientation" } }
serialised! { Pose { position: "position", orientation: "orientation" } }
serialised! { Placement { position: "position", rotation: "rotation" } }
serialised! { Twist { linear: "linear", angular: "angular" } }
serialised! { Wrench { force: "force", moment: "moment" } }

impl<T: Number> Serial<T> for T {
    fn write<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.serialize(serializer)
    }

    fn read<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        T::deserialize(deserializer)
    }
}

impl<T: Number, V: Serial<T>, const N: usize> Serial<T> for [V; N] {
    fn write<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut list = serializer.serialize_tuple(N)?;
        for element in self {
            list.serialize_element(&Written::<V, T>::new(element))?;
        }
        list.end()
    }

    fn read<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_tuple(N, Elements::<V, T, N>(PhantomData))
    }
}

struct Elements<V, T, const N: usize>(PhantomData<(V, T)>);

impl<'de, V: Serial<T>, T, const N: usize> Visitor<'de> for Elements<V, T, N> {
    type Value = [V; N];

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "an array of length {N}")
    }

    // The language has no array without elements, so that there is a first one to fill it with.
    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<[V; N], A::Error> {
        let mut count = 0;
        let mut array = [element::<V, T, A>(&mut list, &mut count, &self)?; N];
        for place in array.iter_mut().skip(1) {
            *place = element::<V, T, A>(&mut list, &mut count, &self)?;
        }
        Ok(array)
    }
}

/// A column as its entries, another matrix row by row.
impl<T: Number, const R: usize, const C: usize> Serial<T> for SMatrix<T, R, C> {
    fn write<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut list = serializer.serialize_tuple(R)?;
        for row in self.row_iter() {
            if C == 1 {
                list.serialize_element(&row[0])?;
            } else {
                let row: [T; C] = core::array::from_fn(|column| row[column]);
                list.serialize_element(&Written::<_, T>::new(&row))?;
            }
        }
        list.end()
    }

    fn read<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_tuple(R, Rows::<T, R, C>(PhantomData))
    }
}

struct Rows<T, const R: usize, const C: usize>(PhantomData<T>);

impl<'de, T: Number, const R: usize, const C: usize> Visitor<'de> for Rows<T, R, C> {
    type Value = SMatrix<T, R, C>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if C == 1 { write!(f, "an array of length {R}") } else { write!(f, "{R} rows of {C} numbers") }
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<SMatrix<T, R, C>, A::Error> {
        let (mut matrix, mut count) = (SMatrix::<T, R, C>::zeros(), 0);
        for mut row in matrix.row_iter_mut() {
            let entries = if C == 1 {
                [element::<T, T, A>(&mut list, &mut count, &self)?; C]
            } else {
                element::<[T; C], T, A>(&mut list, &mut count, &self)?
            };
            row.iter_mut().zip(entries).for_each(|(place, entry)| *place = entry);
        }
        Ok(matrix)
    }
}

impl<T: Number> Serial<T> for Rotation3<T> {
    fn write<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.matrix().write(serializer)
    }

    fn read<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let matrix = SMatrix::<T, 3, 3>::read(deserializer)?;
        let product = matrix * matrix.transpose() - SMatrix::<T, 3, 3>::identity();
        if product.iter().any(|entry| is_far(*entry)) {
            return Err(D::Error::custom("the matrix is no rotation"));
        }
        Ok(Rotation3::from_matrix_unchecked(matrix))
    }
}

/// Under the names by which Rust reads the components.
#[derive(Clone, Copy)]
struct Components<T> {
    w: T,
    i: T,
    j: T,
    k: T,
}

serialised! { Components { w: "w", i: "i", j: "j", k: "k" } }

impl<T: Number> Serial<T> for UnitQuaternion<T> {
    fn write<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        Components { w: self.w, i: self.i, j: self.j, k: self.k }.serialize(serializer)
    }

    /// As it was written, to the bit: it is checked, and not normalised.
    fn read<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let Components { w, i, j, k } = Components::<T>::deserialize(deserializer)?;
        if is_far(w * w + i * i + j * j + k * k - T::lit(1.0)) {
            return Err(D::Error::custom("the quaternion is not of unit length"));
        }
        Ok(UnitQuaternion::new_unchecked(Quaternion::new(w, i, j, k)))
    }
}

/// Whether it is further from zero than integration without renormalising takes a rotation.
fn is_far<T: Number>(error: T) -> bool {
    !all(error.simd_abs().simd_le(T::lit(1e-3)))
}
