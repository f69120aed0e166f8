//! Mechanisms with closed loops.
