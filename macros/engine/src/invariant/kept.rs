//! What a later stage works out of something, once.
//!
//! In: a way to work it out. Out: the same value each time. An earlier stage can hold the slot without knowing the type of what
//! a later one keeps in it.

use std::any::Any;
use std::cell::OnceCell;
use std::rc::Rc;

use super::fault::OrFault;

/// A slot for a value of one type, empty until it is asked for.
#[derive(Default)]
pub struct Kept(OnceCell<Rc<dyn Any>>);

impl Kept {
    /// The value, made at the first call.
    pub fn get_or<T: 'static>(&self, make: impl FnOnce() -> T) -> Rc<T> {
        let kept = self.0.get_or_init(|| Rc::new(make()));
        Rc::clone(kept).downcast().ok().or_fault("a slot is asked for one type")
    }
}
