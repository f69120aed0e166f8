//! Written by `are_as_the_generator_says`.
