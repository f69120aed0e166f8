//! [`Columns`] of what fields of generated structs are made of. The names are those by which Rust reads the scalars, but
//! for matrices, whose entries are `[row][column]`, counted from zero and row by row.

use super::{Column, Columns};
use crate::{
    Cylindrical, FreeRollPitchYaw, PinSlot, Placement, Planar, Pose, Real, RollPitchYaw, Twist, Universal, Wrench,
};
use nalgebra::{Rotation3, SMatrix, UnitQuaternion, Vector3};

type Visit<'a, T> = &'a mut dyn FnMut(&Column<'_>, T);

impl<T: Real> Columns<T> for T {
    fn columns(&self, place: &Column<'_>, f: Visit<'_, T>) {
        f(place, *self);
    }
}

impl<T> Columns<T> for () {
    fn columns(&self, _: &Column<'_>, _: Visit<'_, T>) {}
}

impl<T, A: Columns<T>, B: Columns<T>> Columns<T> for (A, B) {
    fn columns(&self, place: &Column<'_>, f: Visit<'_, T>) {
        self.0.columns(place, f);
        self.1.columns(place, f);
    }
}

impl<T, A: Columns<T>, const N: usize> Columns<T> for [A; N] {
    fn columns(&self, place: &Column<'_>, f: Visit<'_, T>) {
        for (index, element) in self.iter().enumerate() {
            element.columns(&place.index(index), f);
        }
    }
}

impl<T: Real> Columns<T> for Vector3<T> {
    fn columns(&self, place: &Column<'_>, f: Visit<'_, T>) {
        f(&place.component("x"), self.x);
        f(&place.component("y"), self.y);
        f(&place.component("z"), self.z);
    }
}

impl<T: Real> Columns<T> for UnitQuaternion<T> {
    fn columns(&self, place: &Column<'_>, f: Visit<'_, T>) {
        f(&place.component("w"), self.w);
        f(&place.component("i"), self.i);
        f(&place.component("j"), self.j);
        f(&place.component("k"), self.k);
    }
}

impl<T: Real> Columns<T> for Rotation3<T> {
    fn columns(&self, place: &Column<'_>, f: Visit<'_, T>) {
        entries(self.matrix(), place, f);
    }
}

/// Jacobians.
impl<T: Real, const N: usize> Columns<T> for SMatrix<T, 6, N> {
    fn columns(&self, place: &Column<'_>, f: Visit<'_, T>) {
        entries(self, place, f);
    }
}

fn entries<T: Real, const R: usize, const C: usize>(matrix: &SMatrix<T, R, C>, place: &Column<'_>, f: Visit<'_, T>) {
    for (number, row) in matrix.row_iter().enumerate() {
        for (column, entry) in row.iter().enumerate() {
            f(&place.index(number).index(column), *entry);
        }
    }
}

/// Structs whose fields have units of their own, whatever is declared of the whole.
macro_rules! of_fields {
    ($($name:ident { $($field:ident: $position:literal $rate:literal),+ })+) => {$(
        impl<T: Real> Columns<T> for $name<T> {
            fn columns(&self, place: &Column<'_>, f: Visit<'_, T>) {
                $(Columns::columns(&self.$field, &place.coordinate(stringify!($field), [$position, $rate]), f);)+
            }
        }
    )+};
}

of_fields! {
    Universal { first: "rad" "rad/s", second: "rad" "rad/s" }
    Cylindrical { travel: "m" "m/s", angle: "rad" "rad/s" }
    Planar { x: "m" "m/s", y: "m" "m/s", angle: "rad" "rad/s" }
    PinSlot { travel: "m" "m/s", angle: "rad" "rad/s" }
    RollPitchYaw { roll: "rad" "rad/s", pitch: "rad" "rad/s", yaw: "rad" "rad/s" }
    FreeRollPitchYaw { position: "m" "m/s", orientation: "" "" }
    Pose { position: "m" "m", orientation: "" "" }
    Placement { position: "m" "m", rotation: "" "" }
    Twist { linear: "m/s" "m/s", angular: "rad/s" "rad/s" }
    Wrench { force: "N" "N", moment: "N m" "N m" }
}
