//! What holds a mechanism beside joints and rods: wheels, blades, sums of rates, couplings of coordinates, drives; and what outputs
//! read of their forces.

use super::{Expr, Frame, Mechanism, Vector};

/// A joint of the tree, and which of its coordinates that are numbers.
pub type At = (usize, usize);

/// An equation of velocities, or a wheel with its equation of positions.
#[derive(Clone, Debug)]
pub enum Held {
    /// Rolls on the plane of a frame.
    Ball {
        /// About its centre.
        wheel: Frame,
        /// m
        radius: Expr,
        /// Whose plane.
        on: Frame,
    },
    /// A thin disc rolls on the plane of a frame.
    Disc {
        /// At its centre.
        wheel: Frame,
        /// Its axle.
        axis: Vector,
        /// m
        radius: Expr,
        /// Whose plane.
        on: Frame,
    },
    /// Holds across its edge in the plane of a frame.
    Blade {
        /// Where it is.
        blade: Frame,
        /// Its edge.
        along: Vector,
        /// Whose plane.
        on: Frame,
    },
    /// `(factor + wave * sin(of)) * rate + .. + drift * sin(t)`
    Rates {
        /// What moves.
        terms: Vec<Term>,
        /// By time.
        drift: f64,
    },
}

/// A rate with its factor.
#[derive(Clone, Debug)]
pub struct Term {
    /// Whose rate.
    pub rate: At,
    /// Its factor where `of` is zero.
    pub factor: f64,
    /// How much of that comes with the sine of `of`.
    pub wave: f64,
    /// What the factor depends on.
    pub of: At,
}

/// `factor * q + wave * sin(q) + .. + product * q * q + drift * sin(t) + offset` of coordinates is zero.
#[derive(Clone, Debug)]
pub struct Coupling {
    /// Coordinates with factor and wave.
    pub terms: Vec<(At, f64, f64)>,
    /// Of two coordinates.
    pub product: Option<(At, At, f64)>,
    /// By time.
    pub drift: f64,
    /// So that it holds where it was drawn.
    pub offset: f64,
}

/// A coordinate is `centre + speed * t + size * sin(pace * t)`.
#[derive(Clone, Debug)]
pub struct Drive {
    /// Which one.
    pub of: At,
    /// Where it begins.
    pub centre: f64,
    /// Per second.
    pub speed: f64,
    /// How far it swings.
    pub size: f64,
    /// rad/s
    pub pace: f64,
}

/// An output that reads multipliers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Load {
    /// All of a wheel or blade, as a vector.
    Force(usize),
    /// Of one equation of what is held.
    Row(usize, usize),
    /// Of a rod.
    Rod(usize),
    /// Of a coupling.
    Coupling(usize),
    /// What a drive exerts.
    Drive(usize),
}

impl Held {
    /// Names of the equations; none where the item is the equation.
    pub fn rows(&self) -> &'static [&'static str] {
        match self {
            Held::Ball { .. } | Held::Disc { .. } => &[".touch", ".along", ".across"],
            Held::Blade { .. } => &[".across"],
            Held::Rates { .. } => &[""],
        }
    }

    /// Frames of what is held and of what holds it.
    pub fn frames(&self) -> Option<[&Frame; 2]> {
        match self {
            Held::Ball { wheel, on, .. } | Held::Disc { wheel, on, .. } => Some([wheel, on]),
            Held::Blade { blade, on, .. } => Some([blade, on]),
            Held::Rates { .. } => None,
        }
    }

    /// The same, to change them.
    pub fn frames_mut(&mut self) -> Option<[&mut Frame; 2]> {
        match self {
            Held::Ball { wheel, on, .. } | Held::Disc { wheel, on, .. } => Some([wheel, on]),
            Held::Blade { blade, on, .. } => Some([blade, on]),
            Held::Rates { .. } => None,
        }
    }
}

impl Coupling {
    /// With numbers for factors.
    pub fn is_linear(&self) -> bool {
        self.product.is_none() && self.terms.iter().all(|term| term.2 == 0.0)
    }

    /// What it names.
    pub fn coordinates(&self) -> impl Iterator<Item = At> + '_ {
        let of_product = self.product.iter().flat_map(|(a, b, _)| [*a, *b]);
        self.terms.iter().map(|term| term.0).chain(of_product)
    }
}

impl Mechanism {
    /// Whether anything moves by time alone.
    pub fn goes_by_time(&self) -> bool {
        !self.drives.is_empty()
            || self.couplings.iter().any(|coupling| coupling.drift != 0.0)
            || self.held.iter().any(|held| matches!(held, Held::Rates { drift, .. } if *drift != 0.0))
    }

    /// Coordinates whose value counts, and not their sine alone.
    pub fn counts(&self, at: At) -> bool {
        self.couplings.iter().any(|coupling| coupling.coordinates().any(|other| other == at))
            || self.drives.iter().any(|drive| drive.of == at)
    }
}
