//! Stage `model`: units as numbers.
//!
//! In: nothing. Out: a unit is a dimension, powers of the base units of the SI, and a scale, how much of the SI unit it
//! is. The radian is the number one, as in the SI, so `N m/rad` is `N m` and `rad/s` is `1/s`; a degree is pi / 180 of
//! one.

/// m, kg, s, A, K, mol, cd
const BASES: usize = 7;

/// Exponents count in these parts of one: roots up to the sixth have exact dimensions.
const PARTS: i32 = 60;

/// Largest exponent, in parts: what is larger is no unit that anybody writes.
const MOST: i32 = 1000 * PARTS;

/// How far two scales may be apart, relative: decimals and pi are rounded.
const ROUNDING: f64 = 1e-9;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Dimension([i32; BASES]);

#[derive(Clone, Copy, Debug)]
pub(super) struct Unit {
    pub(super) dimension: Dimension,
    /// Of the SI unit of this dimension; positive and finite.
    pub(super) scale: f64,
}

impl Dimension {
    pub(super) const NONE: Dimension = Dimension([0; BASES]);

    pub(super) fn is_none(self) -> bool {
        self == Dimension::NONE
    }

    fn times(self, other: Dimension, sign: i32) -> Option<Dimension> {
        let mut sum = self.0;
        for (mine, theirs) in sum.iter_mut().zip(other.0) {
            *mine += sign * theirs;
        }
        sum.iter().all(|exponent| exponent.abs() <= MOST).then_some(Dimension(sum))
    }

    /// Exponents of the bases that are there, in parts of one.
    pub(super) fn exponents(self) -> impl Iterator<Item = (&'static str, i32)> {
        ["m", "kg", "s", "A", "K", "mol", "cd"].into_iter().zip(self.0).filter(|(_, exponent)| *exponent != 0)
    }
}

impl Unit {
    pub(super) const ONE: Unit = Unit { dimension: Dimension::NONE, scale: 1.0 };

    /// Of the SI, by whole exponents of m, kg, s, A, K, mol, cd.
    pub(super) const fn si(exponents: [i32; BASES]) -> Unit {
        let [m, kg, s, a, k, mol, cd] = exponents;
        let dimension = Dimension([m * PARTS, kg * PARTS, s * PARTS, a * PARTS, k * PARTS, mol * PARTS, cd * PARTS]);
        Unit { dimension, scale: 1.0 }
    }

    pub(super) const fn scaled(self, scale: f64) -> Unit {
        Unit { dimension: self.dimension, scale: self.scale * scale }
    }

    /// `None` where the numbers leave their range.
    pub(super) fn times(self, other: Unit) -> Option<Unit> {
        Unit { dimension: self.dimension.times(other.dimension, 1)?, scale: self.scale * other.scale }.finite()
    }

    pub(super) fn over(self, other: Unit) -> Option<Unit> {
        Unit { dimension: self.dimension.times(other.dimension, -1)?, scale: self.scale / other.scale }.finite()
    }

    /// `None` also where an exponent is no fraction that dimensions have.
    pub(super) fn power(self, exponent: f64) -> Option<Unit> {
        let parts = exponent * f64::from(PARTS);
        let whole = parts.round();
        if !(parts.abs() <= f64::from(MOST) && (parts - whole).abs() < 1e-6) {
            return None;
        }
        let mut dimension = self.dimension.0;
        for base in &mut dimension {
            let power = i64::from(*base) * (whole as i64);
            if power % i64::from(PARTS) != 0 {
                return None;
            }
            *base = i32::try_from(power / i64::from(PARTS)).ok().filter(|power| power.abs() <= MOST)?;
        }
        Unit { dimension: Dimension(dimension), scale: self.scale.powf(exponent) }.finite()
    }

    fn finite(self) -> Option<Unit> {
        (self.scale.is_normal() && self.scale > 0.0).then_some(self)
    }

    /// Whether it is the same unit, however it is written.
    pub(super) fn is(self, other: Unit) -> bool {
        self.dimension == other.dimension && (self.scale / other.scale - 1.0).abs() < ROUNDING
    }

    /// As people write it, where no text of the user's is at hand.
    pub(super) fn text(self) -> String {
        let known = super::table::COMMON.iter().find(|(_, unit)| unit.dimension == self.dimension);
        let name = known.map_or_else(|| bases(self.dimension), |(name, _)| (*name).to_string());
        if (self.scale - 1.0).abs() < ROUNDING { name } else { format!("{} {name}", number(self.scale)) }
    }
}

/// `kg m^2/s^3`
fn bases(dimension: Dimension) -> String {
    let power = |(name, exponent): (&str, i32)| match exponent {
        PARTS => name.to_string(),
        _ => format!("{name}^{}", number(f64::from(exponent) / f64::from(PARTS))),
    };
    let (mut above, below): (Vec<_>, Vec<_>) = dimension.exponents().partition(|(_, exponent)| *exponent > 0);
    // As in kg m^2.
    above.sort_by_key(|(name, _)| *name != "kg");
    let above: Vec<String> = above.into_iter().map(power).collect();
    let mut text = if above.is_empty() { "1".to_string() } else { above.join(" ") };
    for (name, exponent) in below {
        text += "/";
        text += &power((name, -exponent));
    }
    text
}

/// Six digits are enough to tell what is meant.
pub(super) fn number(value: f64) -> String {
    let rounded: f64 = format!("{value:.5e}").parse().unwrap_or(value);
    if (1e-4..1e7).contains(&rounded) { format!("{rounded}") } else { format!("{rounded:e}") }
}
