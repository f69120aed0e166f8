//! What work costs.
//!
//! In: operations. Out: one number by which candidates are compared.

/// Operations by the counting rule: sign changes and factors of one are free; `min`, `max` and a selection count as
/// additions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cost {
    pub add: u32,
    pub mul: u32,
    pub div: u32,
    pub sqrt: u32,
    pub sincos: u32,
    /// Comparisons, what is done with masks, absolute values and signs.
    pub compare: u32,
    /// Any other function.
    pub other: u32,
}

impl Cost {
    /// What choices between candidates compare: additions, products, selections, comparisons 1, quotients and roots 8,
    /// sincos and other functions 20.
    pub fn weight(&self) -> u32 {
        self.add + self.mul + self.compare + 8 * (self.div + self.sqrt) + 20 * (self.sincos + self.other)
    }

    /// `12 add, 7 mul, 1 div`
    pub fn words(&self) -> String {
        let Cost { add, mul, div, sqrt, sincos, compare, other } = *self;
        let other = compare + other;
        let all = [(add, "add"), (mul, "mul"), (div, "div"), (sqrt, "sqrt"), (sincos, "sincos"), (other, "other")];
        let some: Vec<String> =
            all.iter().filter(|(count, _)| *count > 0).map(|(count, name)| format!("{count} {name}")).collect();
        if some.is_empty() { "none".to_owned() } else { some.join(", ") }
    }

    /// The sum of both.
    pub fn plus(self, other: Cost) -> Cost {
        Cost {
            add: self.add + other.add,
            mul: self.mul + other.mul,
            div: self.div + other.div,
            sqrt: self.sqrt + other.sqrt,
            sincos: self.sincos + other.sincos,
            compare: self.compare + other.compare,
            other: self.other + other.other,
        }
    }
}
