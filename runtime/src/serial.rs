//! Generated structs for serde, with the feature `serde`, without heap.
//!
//! Structs are written as structs under the names of their fields, arrays and vectors as sequences, matrices as sequences of rows,
//! quaternions as `w`, `i`, `j`, `k`. Every field has to be there when they are read, and nothing else. Traits and functions serve
//! generated code alone.

mod leaves;
mod structs;

pub use structs::{Name, element, once, there};

use core::marker::PhantomData;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::Real;

/// Scalars that serde knows: `f64`, `f32`.
pub trait Number: Real + Serialize + DeserializeOwned {}

impl<T: Real + Serialize + DeserializeOwned> Number for T {}

/// What fields of scalars `T` are made of: types of other crates have serde's own traits in other forms, or for short arrays only.
pub trait Serial<T>: Copy {
    /// Writes it.
    ///
    /// # Errors
    ///
    /// Those of the serializer.
    fn write<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error>;

    /// Reads it.
    ///
    /// # Errors
    ///
    /// Those of the deserializer, and of what does not fit.
    fn read<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error>;
}

/// What serde writes by [`Serial::write`].
pub struct Written<'a, V, T> {
    value: &'a V,
    scalar: PhantomData<T>,
}

impl<'a, V, T> Written<'a, V, T> {
    /// Of a field.
    pub fn new(value: &'a V) -> Self {
        Written { value, scalar: PhantomData }
    }
}

impl<V: Serial<T>, T> Serialize for Written<'_, V, T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.value.write(serializer)
    }
}

/// What serde reads by [`Serial::read`].
pub struct Read<V, T> {
    /// What has been read.
    pub value: V,
    scalar: PhantomData<T>,
}

impl<'de, V: Serial<T>, T> Deserialize<'de> for Read<V, T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Ok(Read { value: V::read(deserializer)?, scalar: PhantomData })
    }
}
