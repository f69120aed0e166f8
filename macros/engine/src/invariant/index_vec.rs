//! A vector that is indexed by ids of one type: the number of a joint finds no body, and an id that is of no element is a
//! fault of this compiler.

use std::fmt;
use std::marker::PhantomData;
use std::ops::{Deref, DerefMut, Index, IndexMut};

use super::fault::raise;

/// The position of an element in the vector that it belongs to.
pub trait Id: Copy {
    fn of(index: usize) -> Self;
    fn index(self) -> usize;
}

/// Makes a type with one public number an [`Id`].
macro_rules! id {
    ($($name:ty),* $(,)?) => {$(
        impl $crate::invariant::index_vec::Id for $name {
            fn of(index: usize) -> Self {
                Self(index)
            }
            fn index(self) -> usize {
                self.0
            }
        }
    )*};
}
pub(crate) use id;

/// A vector of `T` whose elements are known by `I`. As a slice it has everything that needs no id.
pub struct IndexVec<I, T> {
    list: Vec<T>,
    id: PhantomData<fn(I) -> I>,
}

impl<I: Id, T> IndexVec<I, T> {
    pub const fn new() -> Self {
        IndexVec { list: Vec::new(), id: PhantomData }
    }

    /// The id of the new element.
    pub fn push(&mut self, element: T) -> I {
        self.list.push(element);
        I::of(self.list.len() - 1)
    }

    /// Takes the last element away.
    pub fn pop(&mut self) -> Option<T> {
        self.list.pop()
    }

    /// The id that the next element will have.
    pub fn next(&self) -> I {
        I::of(self.list.len())
    }

    pub fn ids(&self) -> impl ExactSizeIterator<Item = I> + DoubleEndedIterator + use<I, T> {
        (0..self.list.len()).map(I::of)
    }

    pub fn iter_ids(&self) -> impl ExactSizeIterator<Item = (I, &T)> + DoubleEndedIterator {
        self.list.iter().enumerate().map(|(index, element)| (I::of(index), element))
    }
}

impl<I: Id, T> Index<I> for IndexVec<I, T> {
    type Output = T;

    #[track_caller]
    #[inline]
    fn index(&self, id: I) -> &T {
        match self.list.get(id.index()) {
            Some(element) => element,
            None => missing::<T>(id.index(), self.list.len()),
        }
    }
}

impl<I: Id, T> IndexMut<I> for IndexVec<I, T> {
    #[track_caller]
    #[inline]
    fn index_mut(&mut self, id: I) -> &mut T {
        let len = self.list.len();
        match self.list.get_mut(id.index()) {
            Some(element) => element,
            None => missing::<T>(id.index(), len),
        }
    }
}

#[track_caller]
#[cold]
fn missing<T>(index: usize, len: usize) -> ! {
    let name = std::any::type_name::<T>().rsplit("::").next().unwrap_or("element");
    raise(&format!("an id of a `{name}` is below {len}, and {index} is not"))
}

impl<I, T> Deref for IndexVec<I, T> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        &self.list
    }
}

impl<I, T> DerefMut for IndexVec<I, T> {
    fn deref_mut(&mut self) -> &mut [T] {
        &mut self.list
    }
}

impl<I, T> From<Vec<T>> for IndexVec<I, T> {
    fn from(list: Vec<T>) -> Self {
        IndexVec { list, id: PhantomData }
    }
}

impl<I, T> FromIterator<T> for IndexVec<I, T> {
    fn from_iter<L: IntoIterator<Item = T>>(list: L) -> Self {
        IndexVec::from(Vec::from_iter(list))
    }
}

impl<'a, I, T> IntoIterator for &'a IndexVec<I, T> {
    type Item = &'a T;
    type IntoIter = std::slice::Iter<'a, T>;

    fn into_iter(self) -> Self::IntoIter {
        self.list.iter()
    }
}

impl<I, T> IntoIterator for IndexVec<I, T> {
    type Item = T;
    type IntoIter = std::vec::IntoIter<T>;

    fn into_iter(self) -> Self::IntoIter {
        self.list.into_iter()
    }
}

impl<I, T> Default for IndexVec<I, T> {
    fn default() -> Self {
        IndexVec::from(Vec::new())
    }
}

impl<I, T: Clone> Clone for IndexVec<I, T> {
    fn clone(&self) -> Self {
        IndexVec::from(self.list.clone())
    }
}

impl<I, T: fmt::Debug> fmt::Debug for IndexVec<I, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.list.fmt(f)
    }
}

impl<I, T: PartialEq> PartialEq for IndexVec<I, T> {
    fn eq(&self, other: &Self) -> bool {
        self.list == other.list
    }
}

#[cfg(test)]
mod tests {
    use super::{Id, IndexVec};
    use crate::invariant::fault::guard;

    #[derive(Clone, Copy, Debug, PartialEq)]
    struct LegId(usize);
    super::id!(LegId);

    #[test]
    fn an_id_of_no_element_is_a_fault() {
        let mut legs: IndexVec<LegId, char> = IndexVec::new();
        let a = legs.push('a');
        assert_eq!((legs[a], legs.next()), ('a', LegId(1)));
        let fault = guard("model", || legs[LegId::of(1)]).unwrap_err();
        assert_eq!(fault.what, "an id of a `char` is below 1, and 1 is not");
        assert!(fault.place.is_some_and(|place| place.starts_with("index_vec.rs:")));
    }
}
