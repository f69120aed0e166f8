//! Nothing: the package holds targets of its own.
