//! Functions of Rust that lack what models need, or stand where they must not: one error for each mistake.
use multibody::{Function, Real, multibody};

pub struct Bare;

pub struct Narrow;

impl Function<f64, 1> for Narrow {
    fn value([x]: [f64; 1]) -> f64 {
        x
    }
    fn slopes(_: [f64; 1]) -> [f64; 1] {
        [1.0]
    }
}

pub struct Pair;

impl<T: Real> Function<T, 2> for Pair {
    fn value([x, y]: [T; 2]) -> T {
        x * y
    }
    fn slopes([x, y]: [T; 2]) -> [T; 2] {
        [y, x]
    }
}

multibody! {
    pub mod without_impl {
        extern bare(x, y) = crate::Bare;
        body a { mass: 1.0 }
        joint x: Prismatic { parent: ground, child: a, axis: X }
        force push: Effort { joint: x, value: bare(x, 1.0) + bare(x.rate, 2.0) * bare(1.0, 2.0) }
        emit forward_dynamics, derivatives, inverse_dynamics;
    }
}

multibody! {
    pub mod for_one_scalar {
        extern narrow(x) = crate::Narrow;
        body a { mass: 1.0 }
        joint x: Prismatic { parent: ground, child: a, axis: X }
        force push: Effort { joint: x, value: narrow(x) + narrow(2.0 * x) }
    }
}

multibody! {
    pub mod of_other_length {
        extern pair(x, y, z) = crate::Pair;
        body a { mass: 1.0 }
        joint x: Prismatic { parent: ground, child: a, axis: X }
        force push: Effort { joint: x, value: pair(x, 1.0, x.rate) }
    }
}

multibody! {
    pub mod nowhere {
        extern lost(x) = crate::Lost;
        body a { mass: 1.0 }
        joint x: Prismatic { parent: ground, child: a, axis: X }
        force push: Effort { joint: x, value: lost(x) + lost(x.rate) }
    }
}

multibody! {
    pub mod misplaced {
        extern pair(x, y) = crate::Pair;
        body a { mass: pair(1.0, 2.0) }
        joint x: Prismatic { parent: ground.at(pair(1.0, 1.0) * X), child: a, axis: X }
        drive x = pair(t, 1.0);
    }
}

multibody! {
    pub mod written {
        extern near(x) = Pair;
        body a { mass: 1.0 }
        joint x: Prismatic { parent: ground, child: a, axis: X }
        output twice = near(x);
    }
}

multibody! {
    pub mod bent {
        extern pair(x, y) = crate::Pair;
        body a { mass: 1.0 }
        joint x: Prismatic { parent: ground, child: a, axis: X }
        output slope = diff(pair(x, 2.0), x);
        emit forward_dynamics, linearize;
    }
}

fn main() {}
