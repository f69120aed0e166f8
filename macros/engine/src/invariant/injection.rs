//! Stages broken on purpose: the tests switch one break on at a time and demand that it is told.
//!
//! Only the tests inside the library can break anything; everywhere else every hook is `false` at compile time. So these tests, in
//! `tests/faults`, are the library's own, and no engine has to be compiled for them alone.

/// One line of one stage that is wrong while its break is on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Break {
    /// Newton-Euler: the sign of what the acceleration of a link's origin asks of its moment.
    LeverSign,
    /// Newton-Euler: the sign of what squares of angular velocities ask of a product of inertia.
    CentrifugalSign,
    /// Articulated bodies: the sign of what an eliminated freedom hands on to its parent.
    HandedSign,
    /// Factorised matrices: the sign of what a solved row takes from those before it.
    BackwardSign,
    /// Systems with multipliers: what is left of the second derivatives of the constraints has the wrong sign.
    HeldSign,
    /// Composite bodies: the sign of a component of the way by which they are shifted to their parent.
    CompositeShift,
    /// Derivatives: the last factor of a product has none.
    ProductRule,
    /// Reverse accumulation: the first term of a sum is passed nothing.
    AdjointTerm,
    /// Lowering finds no symbol.
    LoweredSymbol,
    /// A pass: terms of a common factor have the wrong sign.
    FactoredSign,
    /// A pass that the identity test does not see: a term of a sum within a sum is dropped.
    FlattenedTerm,
    /// Fields of `Model` that depend on parameters are one.
    FieldOfParameters,
    /// Results of a program stand in the wrong order.
    ResultSlots,
    /// Closed forms take the other root of the one that the conditions choose.
    ClosedFormSign,
    /// Rates of three turns that are found together: what lies along the known vector has the wrong sign.
    OrientationShare,
    /// Rates of slides that are found together: what the last measure tells has the wrong sign.
    TranslationShare,
    /// The last equation of a closing is lost.
    LostRow,
    /// A parameter is one in expressions.
    LostParameter,
    /// Frames are turned the other way.
    FrameTurn,
    /// An axis that is none of the frame's own is turned into place the other way.
    AxisTurn,
    /// A screw travels the other way.
    Pitch,
    /// Stiffness and damping change places.
    SpringData,
    /// `Model::at`: later work reads another one of the values that are stored.
    StoredSlot,
    /// `Model::at`: what depends on velocities counts as known with the position.
    EarlyVelocity,
    /// Packs: a member that is minus what its lane gives is taken as it is.
    LaneSign,
    /// Packs: a scalar is put into the lane next to its own.
    LaneIndex,
    /// Packs: a sum over several limbs forgets what the second one has in it.
    LostShare,
    /// Assembly modes: the sign of a part of the point where three spheres meet.
    MeetingSign,
    /// Assembly modes: two square roots have one side in common, so half of the modes are lost.
    LostSide,
    /// Arguments of functions are printed in the wrong order.
    PrintedArguments,
}

impl Break {
    pub const ALL: [Break; 30] = [
        Break::LeverSign,
        Break::CentrifugalSign,
        Break::HandedSign,
        Break::BackwardSign,
        Break::HeldSign,
        Break::CompositeShift,
        Break::ProductRule,
        Break::AdjointTerm,
        Break::LoweredSymbol,
        Break::FactoredSign,
        Break::FlattenedTerm,
        Break::FieldOfParameters,
        Break::ResultSlots,
        Break::ClosedFormSign,
        Break::OrientationShare,
        Break::TranslationShare,
        Break::LostRow,
        Break::LostParameter,
        Break::FrameTurn,
        Break::AxisTurn,
        Break::Pitch,
        Break::SpringData,
        Break::StoredSlot,
        Break::EarlyVelocity,
        Break::LaneSign,
        Break::LaneIndex,
        Break::LostShare,
        Break::MeetingSign,
        Break::LostSide,
        Break::PrintedArguments,
    ];
}

/// Whether this line is to be wrong.
#[cfg(not(test))]
#[inline(always)]
pub(crate) const fn broken(_: Break) -> bool {
    false
}

#[cfg(test)]
pub(crate) use on::{broken, reached_by, with};

#[cfg(test)]
mod on {
    use std::cell::Cell;

    use super::Break;

    thread_local! {
        static ON: Cell<Option<Break>> = const { Cell::new(None) };
        /// A bit for each break whose line was run.
        static REACHED: Cell<u64> = const { Cell::new(0) };
    }

    pub(crate) fn broken(line: Break) -> bool {
        REACHED.set(REACHED.get() | 1 << line as u32);
        ON.get() == Some(line)
    }

    /// Does this work without a break, and says whose lines it runs: of no other break can anything become of it.
    pub(crate) fn reached_by<T>(work: impl FnOnce() -> T) -> (T, Vec<Break>) {
        REACHED.set(0);
        let result = with(None, work);
        let reached = REACHED.get();
        (result, Break::ALL.into_iter().filter(|line| reached >> *line as u32 & 1 == 1).collect())
    }

    /// Does this work with a break, or with none.
    pub(crate) fn with<T>(line: Option<Break>, work: impl FnOnce() -> T) -> T {
        let before = ON.replace(line);
        let result = work();
        ON.set(before);
        result
    }
}

#[cfg(test)]
#[path = "../../tests/faults/mod.rs"]
mod faults;
