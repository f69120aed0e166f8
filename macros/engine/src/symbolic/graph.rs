//! Stage `symbolic`: the expression graph and its normal form.
//!
//! In: operations. Out: handles of nodes. Scalars, 3-vectors and rotations are nodes of their own; vectors are lowered
//! to scalars late, by [`super::lower`].
//!
//! The normal form is the value. Every node has a [`Print`], its exact value at a random point, and a node is looked up
//! by its print before it is made: expressions that are equal by the field laws, the circle (sin^2 + cos^2 = 1,
//! addition theorems) or the unit sphere of a quaternion are one node, in whatever form they were derived first. Signs
//! belong to edges, not to nodes: of x and -x only one is a node, so a - b and b - a are one node and a sign. In the same way a rotation and its transpose are one node and a flag. What the prints cannot see
//! (the order of terms, zeros inside sums, common angles) the constructors in `scalar` and `vector`
//! normalise: sums and products are n-ary and sorted, and not distributed.

use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};
use std::ops::Neg;
use std::sync::Arc;

use crate::contracts::call::Call;

use super::fingerprint::Print;
use super::number::Number;

/// A scalar: node and sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Scalar(pub(super) u32);

/// A 3-vector: node and sign. Its components are those in one frame, which its maker knows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Vector(pub(super) u32);

/// A rotation: node and transposition. It maps child components to parent components.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Rotation(pub(super) u32);

macro_rules! handle {
    ($name:ident, $flag:ident) => {
        impl $name {
            pub(super) fn new(index: usize, flag: bool) -> Self {
                $name((index as u32) << 1 | u32::from(flag))
            }
            /// Position of the node.
            pub fn index(self) -> usize {
                (self.0 >> 1) as usize
            }
            /// The flag that the edge carries.
            pub fn $flag(self) -> bool {
                self.0 & 1 == 1
            }
            pub(super) fn flip_if(self, flip: bool) -> Self {
                $name(self.0 ^ u32::from(flip))
            }
        }
    };
}
handle!(Scalar, is_negative);
handle!(Vector, is_negative);
handle!(Rotation, is_transposed);

impl Scalar {
    pub const ZERO: Scalar = Scalar(0);
    pub const ONE: Scalar = Scalar(2);

    /// The node without its sign.
    pub fn positive(self) -> Scalar {
        Scalar(self.0 & !1)
    }
}

impl std::ops::Neg for Scalar {
    type Output = Scalar;
    fn neg(self) -> Scalar {
        if self == Scalar::ZERO { self } else { self.flip_if(true) }
    }
}

impl Vector {
    pub const ZERO: Vector = Vector(0);
}

impl std::ops::Neg for Vector {
    type Output = Vector;
    fn neg(self) -> Vector {
        if self == Vector::ZERO { self } else { self.flip_if(true) }
    }
}

impl Rotation {
    pub const IDENTITY: Rotation = Rotation(0);

    pub fn transpose(self) -> Rotation {
        if self == Rotation::IDENTITY { self } else { self.flip_if(true) }
    }
}

/// A symbol of the graph, numbered by its owner.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct SymbolId(pub usize);

/// Scalar nodes. Operands of products, roots and angles are positive edges.
#[derive(Clone, Debug, PartialEq)]
pub enum ScalarNode {
    Literal(Number),
    Symbol(SymbolId),
    Sum(Box<[Scalar]>),
    /// A literal stands first.
    Product(Box<[Scalar]>),
    Reciprocal(Scalar),
    Sqrt(Scalar),
    Sin(Scalar),
    Cos(Scalar),
    Call(Call, Box<[Scalar]>),
    Component(Vector, usize),
    Dot(Vector, Vector),
    /// The angle of a point on the unit circle, given as cosine and sine. Its own sine and cosine are these two, so that
    /// no inverse function is computed unless the angle itself is asked for.
    Angle(Scalar, Scalar),
    /// One result of a [`Block`].
    Output(BlockId, usize),
}

/// A [`Block`] of the graph, numbered in the order of making.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct BlockId(pub usize);

/// Several results of one piece of work that is not a formula.
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    pub kind: BlockKind,
    /// What it reads; the kind tells in which order.
    pub operands: Box<[Scalar]>,
}

#[derive(Clone, Debug, PartialEq)]
pub enum BlockKind {
    /// The solution of A x = b by a pivoted, branch-free factorisation in the runtime. Operands: A row by row (size^2),
    /// b (size), and of a symmetric system what its pivots are measured by (size), where that is not the diagonal.
    /// Results: x (size), then the numerical rank as a scalar. Rows and columns beyond the rank are left out:
    /// then x is one solution with zeros there. Of a symmetric system `groups` tells by equal numbers which equations have
    /// one unit and are compared with each other, so that what rounding leaves of one is not taken for one; empty where
    /// each stands for itself.
    Solve { size: usize, symmetric: bool, groups: Box<[usize]> },
    /// The solution of A x = b where nobody asks for the rank. Operands and unknowns as above. It is written out when vectors
    /// become scalars ([`super::sparse_factors`]), unless it is too large; systems of one matrix share what is done to that. Where the
    /// matrix is singular it is finite, or, if `strict`, no number.
    Eliminate { size: usize, strict: bool },
    /// x = next(x), a fixed number of times. Operands: starting values (one per unknown), then next values, which depend
    /// on the symbols `unknowns` and on other nodes, then the size of the residual, a scalar that depends on them too.
    /// Results: the unknowns after the last round, then the residual of the values with which that round began. The
    /// symbols mean nothing outside.
    Iterate { unknowns: Box<[SymbolId]>, count: usize },
}

/// Vector nodes.
#[derive(Clone, Debug, PartialEq)]
pub enum VectorNode {
    Triple([Scalar; 3]),
    Sum(Box<[Vector]>),
    Scale(Scalar, Vector),
    Cross(Vector, Vector),
    Rotate(Rotation, Vector),
}

/// Rotation nodes.
#[derive(Clone, Debug, PartialEq)]
pub enum RotationNode {
    Identity,
    /// About a coordinate axis.
    Axis(usize, Scalar),
    /// Row by row, orthogonal.
    Matrix(Box<[[Scalar; 3]; 3]>),
    /// w, i, j, k; unit.
    Quaternion([Scalar; 4]),
    Product(Rotation, Rotation),
}

/// Most nodes that one graph may hold: a bound, so that a model too large ends in an error and not in a hang.
pub const MOST_NODES: usize = 2_000_000;

/// A node of any kind, by its position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AnyNode {
    Scalar(usize),
    Vector(usize),
    Rotation(usize),
}

/// Prints are random words already.
#[derive(Default)]
pub struct PassHasher(u64);

impl Hasher for PassHasher {
    fn finish(&self) -> u64 {
        self.0
    }
    fn write(&mut self, bytes: &[u8]) {
        for &b in bytes {
            self.0 = self.0.rotate_left(8) ^ u64::from(b);
        }
    }
    fn write_u64(&mut self, word: u64) {
        self.0 = self.0.rotate_left(21) ^ word;
    }
    fn write_usize(&mut self, _: usize) {}
}

/// Places of nodes are small numbers in no order: one product spreads them, and in a debug build costs a tenth of what the
/// standard hasher does.
#[derive(Default)]
pub struct PlaceHasher(u64);

impl Hasher for PlaceHasher {
    fn finish(&self) -> u64 {
        self.0
    }
    fn write(&mut self, bytes: &[u8]) {
        for &b in bytes {
            self.write_u64(u64::from(b));
        }
    }
    fn write_u32(&mut self, place: u32) {
        self.write_u64(u64::from(place));
    }
    fn write_usize(&mut self, place: usize) {
        self.write_u64(place as u64);
    }
    fn write_u64(&mut self, word: u64) {
        self.0 = (self.0 ^ word).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    }
}

/// By the place of a node among those of its kind.
pub(crate) type PlaceMap<T> = HashMap<usize, T, BuildHasherDefault<PlaceHasher>>;

type PrintMap<K> = HashMap<K, u32, BuildHasherDefault<PassHasher>>;

/// What a value is called in generated code.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Name {
    pub text: String,
    /// Whether it gets a statement because it has a name.
    pub stands_alone: bool,
    /// Whether the name is that of minus the value.
    pub is_minus: bool,
    /// What was being derived when it was named: the heading of a paragraph of statements.
    pub heading: Option<Arc<str>>,
}

impl Name {
    /// As it is written where minus the value, or the value itself, stands.
    pub fn of_sign(&self, is_minus: bool) -> String {
        if is_minus == self.is_minus { self.text.clone() } else { format!("minus_{}", self.text) }
    }
}

/// Nodes by value, as they are found when equal ones are asked for.
#[derive(Clone)]
pub struct Sharing {
    scalars: PrintMap<Print>,
    vectors: PrintMap<[Print; 3]>,
    rotations: PrintMap<[Print; 9]>,
}

/// Expressions with shared subexpressions.
#[derive(Clone)]
pub struct Graph {
    pub(super) scalars: Vec<ScalarNode>,
    pub(super) prints: Vec<Print>,
    scalar_index: PrintMap<Print>,
    pub(super) vectors: Vec<VectorNode>,
    pub(super) vector_prints: Vec<[Print; 3]>,
    vector_index: PrintMap<[Print; 3]>,
    pub(super) rotations: Vec<RotationNode>,
    pub(super) rotation_prints: Vec<[[Print; 3]; 3]>,
    rotation_index: PrintMap<[Print; 9]>,
    pub(super) symbols: Vec<Scalar>,
    pub(super) blocks: Vec<Block>,
    /// First symbols of the unit quaternions, four in a row each.
    pub(super) quaternions: Vec<SymbolId>,
    /// First symbols of points on the unit circle, two in a row each.
    pub(super) circles: Vec<SymbolId>,
    /// All nodes in the order of their making, operands before users.
    pub(super) order: Vec<AnyNode>,
    /// Places in that order: of scalars, vectors, rotations.
    places: [Vec<u32>; 3],
    /// Which marked symbols a node reads, by kind of node; see [`Graph::mark`].
    reads: [Vec<u128>; 3],
    /// Nodes that read these are not looked up.
    pub(super) shunned: u128,
    /// Whether something was divided by zero: what that is multiplied by zero with would be zero, and its slopes nothing.
    pub(super) has_pole: bool,
    /// Large numbers whose square roots are literals.
    pub(super) radicands: Vec<u128>,
    /// Sine and cosine of literal angles that are no exact numbers, but whose points are; see [`Graph::literal_sin_cos`].
    pub(super) exact_points: HashMap<Print, [Number; 2]>,
    names: PlaceMap<Name>,
    vector_names: PlaceMap<Name>,
    heading: Option<Arc<str>>,
}

impl Default for Graph {
    fn default() -> Self {
        Graph::new()
    }
}

impl Graph {
    pub fn new() -> Graph {
        let mut graph = Graph {
            scalars: Vec::new(),
            prints: Vec::new(),
            scalar_index: HashMap::default(),
            vectors: Vec::new(),
            vector_prints: Vec::new(),
            vector_index: HashMap::default(),
            rotations: Vec::new(),
            rotation_prints: Vec::new(),
            rotation_index: HashMap::default(),
            symbols: Vec::new(),
            blocks: Vec::new(),
            quaternions: Vec::new(),
            circles: Vec::new(),
            order: Vec::new(),
            places: Default::default(),
            reads: Default::default(),
            shunned: 0,
            has_pole: false,
            radicands: Vec::new(),
            exact_points: HashMap::new(),
            names: PlaceMap::default(),
            vector_names: PlaceMap::default(),
            heading: None,
        };
        graph.insert_scalar(ScalarNode::Literal(Number::ZERO), Print::ZERO);
        graph.insert_scalar(ScalarNode::Literal(Number::ONE), Print::ONE);
        graph.insert_vector(VectorNode::Triple([Scalar::ZERO; 3]), [Print::ZERO; 3]);
        let (o, i) = (Print::ZERO, Print::ONE);
        graph.insert_rotation(RotationNode::Identity, [[i, o, o], [o, i, o], [o, o, i]]);
        graph
    }

    /// Ends the sharing with what was made so far: equal expressions that follow are new nodes, in their own form. Only
    /// symbols and the constants that the handles know stay the same.
    pub fn forget(&mut self) {
        self.scalar_index.clear();
        self.vector_index.clear();
        self.rotation_index.clear();
        for s in [Scalar::ZERO, Scalar::ONE].into_iter().chain(self.symbols.iter().copied()) {
            self.scalar_index.insert(self.prints[s.index()].canonical(), s.index() as u32);
        }
        self.vector_index.insert(vector_key(self.vector_prints[0]), 0);
        self.rotation_index.insert(rotation_key(&self.rotation_prints[0], false), 0);
    }

    /// What expressions are shared with now.
    pub fn sharing(&self) -> Sharing {
        Sharing {
            scalars: self.scalar_index.clone(),
            vectors: self.vector_index.clone(),
            rotations: self.rotation_index.clone(),
        }
    }

    /// Shares with what was shared with when this was taken, and with nothing made since.
    pub fn share(&mut self, sharing: &Sharing) {
        self.scalar_index.clone_from(&sharing.scalars);
        self.vector_index.clone_from(&sharing.vectors);
        self.rotation_index.clone_from(&sharing.rotations);
        for &s in &self.symbols {
            self.scalar_index.insert(self.prints[s.index()].canonical(), s.index() as u32);
        }
    }

    /// Nodes of all kinds.
    pub fn size(&self) -> usize {
        self.order.len()
    }

    /// Marks a symbol that is to be replaced later (see [`Graph::substitute`]) with one of 128 bits. Expressions are looked up
    /// by value, and one that merely looks as if it depended on the symbol, since the symbol cancels in it, has the
    /// value of its replacement too: without the mark it would be found and the symbol would stay.
    pub fn mark(&mut self, symbol: Scalar, bit: usize) {
        self.reads[0][symbol.index()] |= 1 << (bit % 128);
    }

    /// Takes a mark away again, from what is made later.
    pub fn unmark(&mut self, symbol: Scalar, bit: usize) {
        self.reads[0][symbol.index()] &= !(1 << (bit % 128));
    }

    /// The marks that a scalar reads.
    pub fn marks(&self, s: Scalar) -> u128 {
        self.reads[0][s.index()]
    }

    /// The marks that a node reads.
    pub(super) fn reads(&self, node: AnyNode) -> u128 {
        match node {
            AnyNode::Scalar(i) => self.reads[0][i],
            AnyNode::Vector(i) => self.reads[1][i],
            AnyNode::Rotation(i) => self.reads[2][i],
        }
    }

    fn reads_of_operands(&self, node: AnyNode) -> u128 {
        let mut reads = 0;
        self.each_operand(node, &mut |operand| reads |= self.reads(operand));
        reads
    }

    /// Where a node stands in the order of making.
    pub(super) fn position(&self, node: AnyNode) -> u32 {
        match node {
            AnyNode::Scalar(i) => self.places[0][i],
            AnyNode::Vector(i) => self.places[1][i],
            AnyNode::Rotation(i) => self.places[2][i],
        }
    }

    /// Whether the bound on nodes is reached: results made since are worthless, and the model is to be refused.
    pub fn is_full(&self) -> bool {
        self.order.len() >= MOST_NODES
    }

    /// Number of scalar nodes made so far.
    pub fn len(&self) -> usize {
        self.scalars.len()
    }

    /// Never: zero and one are always there.
    pub fn is_empty(&self) -> bool {
        self.scalars.is_empty()
    }

    pub fn node(&self, s: Scalar) -> &ScalarNode {
        &self.scalars[s.index()]
    }

    pub fn block(&self, id: BlockId) -> &Block {
        &self.blocks[id.0]
    }

    pub fn vector_node(&self, v: Vector) -> &VectorNode {
        &self.vectors[v.index()]
    }

    /// The vector at a position.
    pub(crate) fn vector_node_at(&self, index: usize) -> &VectorNode {
        &self.vectors[index]
    }

    pub fn rotation_node(&self, r: Rotation) -> &RotationNode {
        &self.rotations[r.index()]
    }

    /// The value at the random point.
    pub fn print(&self, s: Scalar) -> Print {
        let print = self.prints[s.index()];
        if s.is_negative() { print.neg() } else { print }
    }

    pub fn vector_print(&self, v: Vector) -> [Print; 3] {
        let print = self.vector_prints[v.index()];
        if v.is_negative() { print.map(Print::neg) } else { print }
    }

    pub fn rotation_print(&self, r: Rotation) -> [[Print; 3]; 3] {
        let m = self.rotation_prints[r.index()];
        if r.is_transposed() { std::array::from_fn(|i| std::array::from_fn(|j| m[j][i])) } else { m }
    }

    /// The literal that this is, sign included.
    pub fn literal(&self, s: Scalar) -> Option<Number> {
        match self.node(s) {
            ScalarNode::Literal(n) => Some(if s.is_negative() { n.neg() } else { *n }),
            _ => None,
        }
    }

    /// The node with this value or its negative, if there is one.
    pub(super) fn find(&self, print: Print) -> Option<Scalar> {
        let index = *self.scalar_index.get(&print.canonical())? as usize;
        if self.reads[0][index] & self.shunned != 0 {
            return None;
        }
        Some(Scalar::new(index, self.prints[index] != print))
    }

    /// Makes a node; its value must be new.
    pub(super) fn insert_scalar(&mut self, node: ScalarNode, print: Print) -> Scalar {
        if self.is_full() {
            return Scalar::ZERO;
        }
        let index = self.scalars.len();
        self.scalars.push(node);
        self.places[0].push(self.order.len() as u32);
        self.reads[0].push(0);
        let reads = self.reads_of_operands(AnyNode::Scalar(index));
        self.reads[0][index] = reads;
        self.order.push(AnyNode::Scalar(index));
        self.prints.push(print);
        self.scalar_index.insert(print.canonical(), index as u32);
        Scalar::new(index, false)
    }

    pub(super) fn find_vector(&self, print: [Print; 3]) -> Option<Vector> {
        let index = *self.vector_index.get(&vector_key(print))? as usize;
        if self.reads[1][index] & self.shunned != 0 {
            return None;
        }
        Some(Vector::new(index, self.vector_prints[index] != print))
    }

    pub(super) fn insert_vector(&mut self, node: VectorNode, print: [Print; 3]) -> Vector {
        if self.is_full() {
            return Vector::ZERO;
        }
        let index = self.vectors.len();
        self.vectors.push(node);
        self.places[1].push(self.order.len() as u32);
        self.reads[1].push(0);
        let reads = self.reads_of_operands(AnyNode::Vector(index));
        self.reads[1][index] = reads;
        self.order.push(AnyNode::Vector(index));
        self.vector_prints.push(print);
        self.vector_index.insert(vector_key(print), index as u32);
        Vector::new(index, false)
    }

    pub(super) fn find_rotation(&self, print: &[[Print; 3]; 3]) -> Option<Rotation> {
        let look = |transposed| {
            let key = rotation_key(print, transposed);
            let found = self.rotation_index.get(&key).map(|&index| index as usize);
            let found = found.filter(|&index| self.reads[2][index] & self.shunned == 0);
            found.map(|index| Rotation::new(index, transposed))
        };
        look(false).or_else(|| look(true))
    }

    pub(super) fn insert_rotation(&mut self, node: RotationNode, print: [[Print; 3]; 3]) -> Rotation {
        if self.is_full() {
            return Rotation::IDENTITY;
        }
        let index = self.rotations.len();
        self.rotations.push(node);
        self.places[2].push(self.order.len() as u32);
        self.reads[2].push(0);
        let reads = self.reads_of_operands(AnyNode::Rotation(index));
        self.reads[2][index] = reads;
        self.order.push(AnyNode::Rotation(index));
        self.rotation_prints.push(print);
        self.rotation_index.insert(rotation_key(&print, false), index as u32);
        Rotation::new(index, false)
    }

    /// Derives something under a heading, for what is named there and has none: paragraphs of statements bear it.
    pub fn under<R>(&mut self, heading: &str, derive: impl FnOnce(&mut Graph) -> R) -> R {
        let before = self.begin(Some(heading.into()));
        let result = derive(self);
        self.heading = before;
        result
    }

    /// Changes the heading; gives back what it was.
    pub fn begin(&mut self, heading: Option<Arc<str>>) -> Option<Arc<str>> {
        std::mem::replace(&mut self.heading, heading)
    }

    /// Gives a node a readable name, unless it has one or needs none.
    pub fn name(&mut self, s: Scalar, name: impl FnOnce() -> String) -> Scalar {
        self.named(s, true, name)
    }

    /// Says what a value is, should it get a statement; a statement of its own it has only for other reasons.
    pub fn label(&mut self, s: Scalar, name: impl FnOnce() -> String) -> Scalar {
        self.named(s, false, name)
    }

    /// Names a vector; its components get the name with `_x`, `_y`, `_z`.
    pub fn name_vector(&mut self, v: Vector, name: impl FnOnce() -> String) -> Vector {
        self.named_vector(v, true, name)
    }

    /// Says what a vector is, should components of it get statements.
    pub fn label_vector(&mut self, v: Vector, name: impl FnOnce() -> String) -> Vector {
        self.named_vector(v, false, name)
    }

    fn named_vector(&mut self, v: Vector, stands_alone: bool, text: impl FnOnce() -> String) -> Vector {
        let index = v.index();
        if self.vector_names.get(&index).is_none_or(|known| stands_alone && !known.stands_alone) {
            let heading = self.heading.clone();
            self.vector_names.insert(index, Name { text: text(), stands_alone, is_minus: v.is_negative(), heading });
        }
        v
    }

    fn named(&mut self, s: Scalar, stands_alone: bool, text: impl FnOnce() -> String) -> Scalar {
        let index = s.index();
        let vacant = self.names.get(&index).is_none_or(|known| stands_alone && !known.stands_alone);
        if vacant && !matches!(self.node(s), ScalarNode::Literal(_) | ScalarNode::Symbol(_)) {
            let heading = self.heading.clone();
            self.names.insert(index, Name { text: text(), stands_alone, is_minus: s.is_negative(), heading });
        }
        s
    }

    /// Gives a value the name of another that it takes the place of.
    pub fn name_like(&mut self, s: Scalar, name: &Name) {
        let s = s.flip_if(name.is_minus);
        let before = self.begin(name.heading.clone());
        self.named(s, name.stands_alone, || name.text.clone());
        self.heading = before;
    }

    /// The same of a vector.
    pub fn name_vector_like(&mut self, v: Vector, name: &Name) {
        let before = self.begin(name.heading.clone());
        self.named_vector(v.flip_if(name.is_minus), name.stands_alone, || name.text.clone());
        self.heading = before;
    }

    /// What the value at this handle's place is called, whatever the handle's sign.
    pub fn name_of(&self, s: Scalar) -> Option<&Name> {
        self.names.get(&s.index())
    }

    pub fn vector_name_of(&self, v: Vector) -> Option<&Name> {
        self.vector_names.get(&v.index())
    }
}

/// The first component that isn't zero decides the sign of the key.
fn vector_key(print: [Print; 3]) -> [Print; 3] {
    let flip = print.iter().find(|p| !p.is_zero()).is_some_and(|p| *p != p.canonical());
    if flip { print.map(Print::neg) } else { print }
}

fn rotation_key(m: &[[Print; 3]; 3], transposed: bool) -> [Print; 9] {
    std::array::from_fn(|k| if transposed { m[k % 3][k / 3] } else { m[k / 3][k % 3] })
}
