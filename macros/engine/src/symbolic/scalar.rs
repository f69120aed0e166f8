//! Stage `symbolic`: constructors of scalars, where the normal form is made.
//!
//! In: operands. Out: the one node that has the value. Each constructor computes the print first; if a node with that
//! value exists, it is the result. Else literals fold, zeros and ones go, operands are sorted.

use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::contracts::call::Call;
use crate::invariant::fault::OrFault;

use super::elementary;
use super::fingerprint::{Print, mix, reconstruct};
use super::graph::{Block, BlockId, BlockKind, Graph, Scalar, ScalarNode, SymbolId, Vector, VectorNode};
use super::number::{Number, Root};
use super::radical::gcd;

impl Graph {
    /// A literal, read as the decimal that the user wrote. One with all digits of a multiple of pi / 2 means that, wherever it
    /// stands: in a sum of angles its digits would leave a remainder that is no quarter turn.
    pub fn decimal(&mut self, x: f64) -> Scalar {
        let n = Number::decimal(x);
        let quarters = elementary::quarters(n).filter(|_| n.is_rounded_decimal());
        self.number(quarters.map_or(n, |quarters| Number::ratio(quarters, 2) * Number::pi()))
    }

    pub fn integer(&mut self, n: i64) -> Scalar {
        self.number(Number::integer(n))
    }

    pub fn pi(&mut self) -> Scalar {
        self.number(Number::pi())
    }

    pub fn number(&mut self, n: Number) -> Scalar {
        let print = n.print();
        if let Some(found) = self.find(print) {
            return found;
        }
        let negative = n.is_negative();
        let print = if negative { print.neg() } else { print };
        self.insert_scalar(ScalarNode::Literal(n.abs()), print).flip_if(negative)
    }

    /// A new symbol.
    pub fn symbol(&mut self) -> Scalar {
        let id = self.symbols.len();
        self.symbol_with(Print::draw(mix(0x5_1B01 + id as u64)))
    }

    /// Four new symbols that are the components w, i, j, k of a unit quaternion.
    pub fn unit_quaternion(&mut self) -> [Scalar; 4] {
        self.quaternions.push(SymbolId(self.symbols.len()));
        let base = self.symbols.len() as u64;
        let draw = |attempt: u64| -> [Print; 3] {
            std::array::from_fn(|k| Print::draw(mix(0x0A7E_0000 + 4 * base + k as u64 + (attempt << 32))))
        };
        let square_of = |t: [Print; 3]| t.iter().fold(Print::ZERO, |sum, t| sum.add(t.mul(*t)));
        // By chance 1 + t^2 vanishes: then another is drawn.
        let lies = |&attempt: &u64| !Print::ONE.add(square_of(draw(attempt))).is_zero();
        let t = draw((0..8).find(lies).or_fault("one of eight draws is no pole of the sphere"));
        let square = square_of(t);
        let scale = Print::ONE.add(square).inverse();
        let vector = t.map(|t| t.add(t).mul(scale));
        let scalar = Print::ONE.sub(square).mul(scale);
        [scalar, vector[0], vector[1], vector[2]].map(|print| self.symbol_with(print))
    }

    /// Two new symbols that are cosine and sine of an angle.
    pub fn unit_circle(&mut self) -> [Scalar; 2] {
        let id = self.symbols.len();
        self.circles.push(SymbolId(id));
        circle(Print::draw(mix(0xC1_4C1E + id as u64))).map(|print| self.symbol_with(print))
    }

    fn symbol_with(&mut self, print: Print) -> Scalar {
        let id = SymbolId(self.symbols.len());
        let s = self.insert_scalar(ScalarNode::Symbol(id), print);
        self.symbols.push(s);
        s
    }

    /// The handle of a symbol.
    pub fn symbol_handle(&self, id: SymbolId) -> Option<Scalar> {
        self.symbols.get(id.0).copied()
    }

    pub fn add(&mut self, a: Scalar, b: Scalar) -> Scalar {
        self.sum(&[a, b])
    }

    pub fn sub(&mut self, a: Scalar, b: Scalar) -> Scalar {
        self.sum(&[a, -b])
    }

    /// N-ary sum.
    pub fn sum(&mut self, terms: &[Scalar]) -> Scalar {
        let print = terms.iter().fold(Print::ZERO, |sum, &t| sum.add(self.print(t)));
        if let Some(found) = self.find(print) {
            return found;
        }
        let (mut constant, mut literals) = (Number::ZERO, false);
        let mut list: Vec<Scalar> = Vec::with_capacity(terms.len());
        for &t in terms {
            match self.literal(t) {
                Some(n) => {
                    literals |= !n.is_zero();
                    constant = constant.add(n);
                }
                None => list.push(t),
            }
        }
        if list.is_empty() {
            return self.number(constant);
        }
        if literals && constant.is_zero() {
            // What opaque literals leave may be zero by its value alone: then the rest has another print.
            return self.sum(&list);
        }
        if let Some(known) = self.known(print) {
            return known;
        }
        list.sort_unstable();
        self.gather_equal_terms(&mut list);
        if !constant.is_zero() {
            list.push(self.number(constant));
        }
        match list[..] {
            [] => return Scalar::ZERO,
            [single] => return single,
            _ => {}
        }
        let flip = list[0].is_negative();
        for t in &mut list {
            *t = t.flip_if(flip);
        }
        self.insert_scalar(ScalarNode::Sum(list.into()), if flip { print.neg() } else { print }).flip_if(flip)
    }

    /// x + x becomes 2 x, x - x goes.
    fn gather_equal_terms(&mut self, list: &mut Vec<Scalar>) {
        let mut i = 0;
        while i < list.len() {
            let node = list[i].positive();
            let end = list[i..].iter().position(|t| t.positive() != node).map_or(list.len(), |k| i + k);
            if end - i > 1 {
                let count: i64 = list[i..end].iter().map(|t| if t.is_negative() { -1 } else { 1 }).sum();
                let factor = self.integer(count);
                let merged = self.mul(factor, node);
                list.splice(i..end, (merged != Scalar::ZERO).then_some(merged));
            } else {
                i += 1;
            }
        }
    }

    /// A node that exists already, or a simple literal that an expression of symbols has turned out to be.
    fn known(&mut self, print: Print) -> Option<Scalar> {
        if let Some(found) = self.find(print) {
            return Some(found);
        }
        if print.is_constant()
            && let Some((n, d)) = reconstruct(print)
        {
            return Some(self.number(Number::ratio(n, d)));
        }
        None
    }

    pub fn mul(&mut self, a: Scalar, b: Scalar) -> Scalar {
        self.product(&[a, b])
    }

    /// N-ary product.
    pub fn product(&mut self, factors: &[Scalar]) -> Scalar {
        let print = factors.iter().fold(Print::ONE, |product, &f| product.mul(self.print(f)));
        if let Some(found) = self.find(print) {
            return found;
        }
        let mut constant = Number::ONE;
        let mut list: Vec<Scalar> = Vec::with_capacity(factors.len());
        for &f in factors {
            self.gather_factor(f, &mut constant, &mut list);
        }
        if list.is_empty() {
            return self.number(constant);
        }
        if let Some(known) = self.known(print) {
            return known;
        }
        list.sort_unstable();
        self.cancel_pairs(&mut list);
        if list.is_empty() {
            return self.number(constant);
        }
        let negative = constant.is_negative();
        let magnitude = constant.abs();
        if !magnitude.is_one() {
            let literal = self.number(magnitude);
            list.insert(0, literal);
        } else if let [single] = list[..] {
            return single.flip_if(negative);
        }
        let print = if negative { print.neg() } else { print };
        self.insert_scalar(ScalarNode::Product(list.into()), print).flip_if(negative)
    }

    /// Literal factors of a factor fold too: 2 * (3 x) = 6 x; signs go into the constant.
    fn gather_factor(&mut self, f: Scalar, constant: &mut Number, list: &mut Vec<Scalar>) {
        if f.is_negative() && self.literal(f).is_none() {
            *constant = constant.neg();
        }
        match self.node(f.positive()) {
            ScalarNode::Literal(_) => {
                if let Some(n) = self.literal(f) {
                    *constant = constant.mul(n);
                }
            }
            ScalarNode::Product(inner) if self.literal(inner[0]).is_some() => {
                if let Some(n) = self.literal(inner[0]) {
                    *constant = constant.mul(n);
                }
                let rest = inner[1..].to_vec();
                // The rest of the product is a node of its own, so that scaled and unscaled uses share it.
                list.push(if let [single] = rest[..] { single } else { self.product(&rest) });
                if let Some(last) = list.last_mut()
                    && last.is_negative()
                {
                    *last = last.positive();
                    *constant = constant.neg();
                }
            }
            _ => list.push(f.positive()),
        }
    }

    /// x * (1 / x) goes, sqrt(x) * sqrt(x) becomes x.
    fn cancel_pairs(&mut self, list: &mut Vec<Scalar>) {
        let mut i = 0;
        while i < list.len() {
            let partner = match *self.node(list[i]) {
                ScalarNode::Reciprocal(x) => list.iter().position(|&y| y == x).map(|j| (j, None)),
                ScalarNode::Sqrt(x) if list.get(i + 1) == Some(&list[i]) => Some((i + 1, Some(x))),
                _ => None,
            };
            if let Some((j, replacement)) = partner {
                list.remove(i.max(j));
                list.remove(i.min(j));
                if let Some(x) = replacement {
                    list.push(x);
                    list.sort_unstable();
                }
                i = 0;
            } else {
                i += 1;
            }
        }
    }

    pub fn div(&mut self, a: Scalar, b: Scalar) -> Scalar {
        let r = self.reciprocal(b);
        self.mul(a, r)
    }

    /// Whether anything was divided by zero, or is another pole of a function: no result can be trusted then.
    pub fn has_pole(&self) -> bool {
        self.has_pole
    }

    /// 1 / x. Of zero it stays a node, infinite when evaluated.
    pub fn reciprocal(&mut self, x: Scalar) -> Scalar {
        let node = x.positive();
        let print = self.print(node);
        self.has_pole |= print.is_zero();
        let inverse = if print.is_zero() { Print::opaque(0xD1, &[print]) } else { print.inverse() };
        if let Some(found) = self.find(inverse) {
            return found.flip_if(x.is_negative());
        }
        if let (Some(n), false) = (self.literal(node), print.is_zero()) {
            let number = self.number(Number::ONE.div(n));
            return number.flip_if(x.is_negative());
        }
        self.insert_scalar(ScalarNode::Reciprocal(node), inverse).flip_if(x.is_negative())
    }

    /// The root that is not negative; |y| of the square of a y that is at hand, such as 1 - sin^2.
    pub fn sqrt(&mut self, x: Scalar) -> Scalar {
        if x == Scalar::ZERO || x == Scalar::ONE {
            return x;
        }
        let literal = self.literal(x);
        if let Some(root) = literal.and_then(elementary::root).and_then(|root| self.admitted(root)) {
            return self.number(root);
        }
        let print = Print::opaque(0x59, &[self.print(x)]);
        if let Some(found) = self.find(print) {
            return found;
        }
        // A root that isn't exact is a number all the same: what cancels against it lies below its rounding.
        if let Some(root) = literal.and_then(elementary::opaque_root) {
            return self.number(root);
        }
        if let Some(square) = self.print(x).root().and_then(|root| self.find(root)).filter(|&y| self.is_at_hand(y)) {
            return self.call(Call::Abs, &[square]);
        }
        self.insert_scalar(ScalarNode::Sqrt(x), print)
    }

    /// Whether a node costs nothing or is there whatever else is made: a number, a symbol, a sine, a result, or one product of such.
    pub(super) fn is_at_hand(&self, s: Scalar) -> bool {
        match self.node(s) {
            ScalarNode::Literal(_) | ScalarNode::Symbol(_) | ScalarNode::Sin(_) | ScalarNode::Cos(_) => true,
            ScalarNode::Output(..) => true,
            ScalarNode::Product(factors) => {
                factors.iter().all(|&f| !matches!(self.node(f), ScalarNode::Product(_)) && self.is_at_hand(f))
            }
            _ => false,
        }
    }

    /// The length of a vector.
    pub fn length(&mut self, components: [Scalar; 3]) -> Scalar {
        let literals: Option<Vec<Number>> = components.iter().map(|&c| self.literal(c)).collect();
        if let Some(root) = literals.and_then(|list| Number::length(&list)).and_then(|root| self.admitted(root)) {
            return self.number(root);
        }
        let squares = components.map(|c| self.mul(c, c));
        let square = self.sum(&squares);
        self.sqrt(square)
    }

    /// A root of a literal. Radicands too large to be taken apart may share factors, and then the signs of their roots
    /// are not known to agree: such a root is opaque.
    fn admitted(&mut self, root: Root) -> Option<Number> {
        let apart = |&a: &u128| self.radicands.iter().all(|&b| a == b || gcd(a, b) == 1);
        if !root.large.iter().all(apart) {
            return None;
        }
        for n in root.large {
            if !self.radicands.contains(&n) {
                self.radicands.push(n);
            }
        }
        Some(root.number)
    }

    /// Integer power by repeated squaring.
    pub fn powi(&mut self, x: Scalar, n: i32) -> Scalar {
        let mut power = n.unsigned_abs();
        let (mut base, mut result) = (x, Scalar::ONE);
        while power > 0 {
            if power & 1 == 1 {
                result = self.mul(result, base);
            }
            power >>= 1;
            if power > 0 {
                base = self.mul(base, base);
            }
        }
        if n < 0 { self.reciprocal(result) } else { result }
    }

    /// Any other function.
    pub fn call(&mut self, call: Call, arguments: &[Scalar]) -> Scalar {
        let mut arguments = arguments.to_vec();
        let mut sign = false;
        match (call, &mut arguments[..]) {
            (Call::Sqrt, [x]) => return self.sqrt(*x),
            (Call::Abs, [x]) => *x = x.positive(),
            (Call::Tan | Call::Atan | Call::Asin | Call::Sinh | Call::Tanh | Call::Signum, [x]) => {
                if *x == Scalar::ZERO {
                    return Scalar::ZERO;
                }
                sign = x.is_negative();
                *x = x.positive();
            }
            (Call::Cosh, [x]) => *x = x.positive(),
            (Call::Min | Call::Max | Call::And | Call::Or | Call::Equal, [a, b]) => {
                if a == b && matches!(call, Call::Min | Call::Max | Call::And | Call::Or) {
                    return *a;
                }
                if a > b {
                    std::mem::swap(a, b);
                }
            }
            (Call::Select, [_, a, b]) if a == b => return *a,
            _ => {}
        }
        if self.is_pole(call, &arguments) {
            return self.reciprocal(Scalar::ZERO);
        }
        if let Some(folded) = self.fold_call(call, &arguments) {
            return folded.flip_if(sign);
        }
        let print = self.call_print(call, &arguments);
        let found = match self.find(print) {
            Some(found) => found,
            None => self.insert_scalar(ScalarNode::Call(call, arguments.into()), print),
        };
        found.flip_if(sign)
    }

    /// Whether a function is infinite for these arguments: a tangent of a right angle, a logarithm of zero, or a power of zero
    /// that isn't known to be positive.
    fn is_pole(&mut self, call: Call, arguments: &[Scalar]) -> bool {
        match (call, arguments) {
            (Call::Tan, &[x]) => self.literal(x).is_some_and(|angle| elementary::sin_cos(angle).1.is_zero()),
            (Call::Ln, &[x]) => x == Scalar::ZERO,
            (Call::Powf, &[x, power]) => x == Scalar::ZERO && self.literal(power).is_none_or(|n| n.is_negative()),
            _ => false,
        }
    }

    /// What tells a function's value: nothing of how its arguments' nodes came about, so that equal values have equal prints in all
    /// graphs of a model.
    fn call_print(&self, call: Call, arguments: &[Scalar]) -> Print {
        let mut prints: Vec<Print> = arguments.iter().map(|&a| self.print(a)).collect();
        let mut odd = false;
        match (call, &mut prints[..]) {
            (Call::Abs | Call::Cosh, [x]) => *x = x.canonical(),
            (Call::Tan | Call::Atan | Call::Asin | Call::Sinh | Call::Tanh | Call::Signum, [x]) => {
                odd = *x != x.canonical();
                *x = x.canonical();
            }
            (Call::Min | Call::Max | Call::And | Call::Or | Call::Equal, list) => list.sort_unstable(),
            _ => {}
        }
        let print = Print::opaque(0xCA_0000 + call.tag(), &prints);
        if odd { print.neg() } else { print }
    }

    /// A function of literals is a literal; a choice by a condition of literals is made.
    fn fold_call(&mut self, call: Call, arguments: &[Scalar]) -> Option<Scalar> {
        if matches!(call, Call::Epsilon | Call::Nan) || call.external().is_some() {
            return None;
        }
        if let (Call::Select, &[mask, a, b]) = (call, arguments) {
            let ScalarNode::Call(condition, inner) = self.node(mask) else { return None };
            let (Call::Less | Call::LessEqual | Call::Equal, [x, y]) = (condition, &inner[..]) else { return None };
            let difference = self.literal(*x)? - self.literal(*y)?;
            let holds = match condition {
                Call::Less => difference.is_negative(),
                Call::LessEqual => difference.is_negative() || difference.is_zero(),
                _ => difference.is_zero(),
            };
            return Some(if holds { a } else { b });
        }
        let values: Option<Vec<Number>> = arguments.iter().map(|&a| self.literal(a)).collect();
        let value = elementary::call(call, &values?)?;
        self.keep_point(value, call, arguments);
        Some(self.number(value))
    }

    /// The results of a block over these operands: unknown values, equal only for an equal block.
    pub fn block_outputs(&mut self, kind: BlockKind, operands: &[Scalar]) -> Vec<Scalar> {
        let count = match &kind {
            BlockKind::Solve { size, .. } => size + 1,
            BlockKind::Eliminate { size, .. } => *size,
            BlockKind::Iterate { unknowns, .. } => unknowns.len() + 1,
        };
        let tag = match &kind {
            BlockKind::Solve { symmetric, groups, .. } => {
                groups.iter().fold(0xB10C_u64 + u64::from(*symmetric), |tag, &group| {
                    tag.wrapping_mul(0x0001_0000_01B3) ^ (group as u64 + 1)
                })
            }
            BlockKind::Eliminate { .. } => 0xB10F,
            BlockKind::Iterate { count, .. } => 0xB10C_0000_u64 + *count as u64,
        };
        // Of all operands once: a block of n unknowns has n^2 of them and n outputs.
        let prints: Vec<Print> = operands.iter().map(|&s| self.print(s)).collect();
        let whole = Print::opaque(tag, &prints);
        let print = |k: usize| Print::opaque(tag ^ ((k as u64 + 1) << 40), &[whole]);
        let mut own: Vec<Print> = (0..count).map(print).collect();
        if let BlockKind::Iterate { unknowns, .. } = &kind {
            // Cosines and sines stay on their circle.
            for (k, _) in unknowns.iter().enumerate().filter(|(_, id)| self.circles.contains(id)) {
                let [cos, sin] = circle(own[k]);
                (own[k], own[k + 1]) = (cos, sin);
            }
        }
        // Nothing on the right is answered by nothing, whatever the rank.
        let nothing = match kind {
            BlockKind::Solve { size, .. } | BlockKind::Eliminate { size, .. }
                if operands[size * size..].iter().take(size).all(|&b| b == Scalar::ZERO) =>
            {
                size
            }
            _ => 0,
        };
        let known: Option<Vec<Scalar>> = own.iter().map(|&print| self.find(print)).collect();
        let mut outputs = known.unwrap_or_else(|| {
            let id = BlockId(self.blocks.len());
            self.blocks.push(Block { kind, operands: operands.into() });
            let outputs = own.into_iter().enumerate();
            outputs.map(|(k, print)| self.insert_scalar(ScalarNode::Output(id, k), print)).collect()
        });
        outputs[..nothing].fill(Scalar::ZERO);
        outputs
    }

    /// The components of a vector of literals.
    pub(super) fn literal_vector(&self, v: Vector) -> Option<[Number; 3]> {
        let VectorNode::Triple(components) = self.vector_node(v) else { return None };
        let [Some(x), Some(y), Some(z)] = components.map(|c| self.literal(c)) else { return None };
        Some(if v.is_negative() { [-x, -y, -z] } else { [x, y, z] })
    }

    /// x, y or z of a vector.
    pub fn component(&mut self, v: Vector, axis: usize) -> Scalar {
        let flip = v.is_negative();
        if let VectorNode::Triple(components) = self.vector_node(v) {
            let c = components[axis];
            return if flip { -c } else { c };
        }
        let print = self.vector_print(v)[axis];
        if let Some(known) = self.known(print) {
            return known;
        }
        let positive = if flip { -v } else { v };
        self.insert_scalar(ScalarNode::Component(positive, axis), self.vector_print(positive)[axis]).flip_if(flip)
    }

    pub fn dot(&mut self, a: Vector, b: Vector) -> Scalar {
        if let (Some(a), Some(b)) = (self.literal_vector(a), self.literal_vector(b)) {
            let products = [0, 1, 2].map(|k| a[k] * b[k]);
            return self.number(products[0] + products[1] + products[2]);
        }
        let (pa, pb) = (self.vector_print(a), self.vector_print(b));
        let print = (0..3).fold(Print::ZERO, |sum, k| sum.add(pa[k].mul(pb[k])));
        if let Some(known) = self.known(print) {
            return known;
        }
        let (a, b) = self.unturned(a, b);
        self.insert_scalar(ScalarNode::Dot(a, b), print)
    }

    /// Two vectors without the rotations that both are turned by last: their product is the same in any axes.
    fn unturned(&self, mut a: Vector, mut b: Vector) -> (Vector, Vector) {
        while let (&VectorNode::Rotate(r, x), &VectorNode::Rotate(s, y)) = (self.vector_node(a), self.vector_node(b))
            && r == s
        {
            (a, b) = (x.flip_if(a.is_negative()), y.flip_if(b.is_negative()));
        }
        (a, b)
    }
}

/// The point of the unit circle that a line of this slope from its far end meets.
fn circle(slope: Print) -> [Print; 2] {
    let square = slope * slope;
    let scale = (Print::ONE + square).inverse();
    [(Print::ONE - square) * scale, (slope + slope) * scale]
}
