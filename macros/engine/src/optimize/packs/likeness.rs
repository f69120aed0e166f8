//! Stage `optimize`, packs: which statements do the same work for different limbs.
//!
//! In: statements, and which coordinates belong to limbs that are alike. Out: [`Group`]s of statements, one of each limb at most.
//!
//! A statement belongs to a limb if it reads what belongs to that limb, and to no other. What is common to several limbs, as the acceleration of
//! the trunk, is as a number to each: on the way back from the trunk limbs are alike again. Statements are alike if they have a
//! *signature* in common: their operations, without signs and without an order of terms and factors, on leaves of one kind: a
//! literal, a stored field, the same coordinate of the limb, the same statement of the limb, or values of one form that are shared.
//! Statements that are alike are equally deep, so they are looked at by depth, and what is read is in its group before. Of several
//! that one limb has with a signature, those go together that read the same literals and shared values, then those that stand in
//! the same order.
//!
//! Limbs of a platform have no coordinates of their own where their equations are solved for the platform's (`nameless`). They are looked for
//! where limbs with coordinates do less than half of the work: hinges of a spine are as alike as such legs. Their number is one by
//! which much work is repeated: not always most, since what each leg does twice is repeated twelve times by six; from the results down, statements that stand there as often are taken for the limbs' in their order, and
//! what only one of them reads is that one's.

use std::collections::hash_map::DefaultHasher;
use std::collections::{BTreeMap, HashMap};
use std::hash::{Hash, Hasher};

use crate::contracts::call::Call;
use crate::contracts::symbol::Symbol;
use crate::mechanics::limbs::Limbs;
use crate::optimize::program::{Expression, Local, Statement};

/// Fewer without coordinates are no limbs, nor are more.
const NAMELESS_LIMBS: std::ops::RangeInclusive<usize> = 3..=16;
/// So many numbers of such limbs are tried.
const COUNTS: usize = 3;
/// The set of limbs without coordinates.
const NAMELESS: usize = usize::MAX;

/// A limb among those that are alike.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) struct Limb {
    pub(super) set: usize,
    pub(super) number: usize,
}

/// What a value depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Owner {
    /// What limbs share.
    Nobody,
    Limb(Limb),
    /// Several limbs.
    Several,
}

/// Statements with the same work, by limb: the number of each.
pub(super) type Group = BTreeMap<Limb, usize>;

/// What is known of statements.
pub(super) struct Likeness<'a> {
    limbs: &'a Limbs,
    pub(super) owners: Vec<Owner>,
    pub(super) groups: Vec<Group>,
    /// Of each statement.
    group: Vec<Option<usize>>,
    /// The signature of each.
    forms: Vec<Option<u64>>,
    /// Where each local is defined: the statement, and which of its locals it is.
    defined: HashMap<Local, (usize, usize)>,
}

/// Whom the leaves of a statement belong to.
#[derive(Default)]
struct Leaves {
    with_coordinates: Which,
    /// These count where there are none with coordinates.
    without: Which,
    /// Whether there is anything that several limbs have in common.
    shared: bool,
}

/// Limbs that have leaves.
#[derive(Clone, Copy, Default)]
enum Which {
    #[default]
    None,
    One(Limb),
    Several,
}

impl Leaves {
    fn add(&mut self, owner: Owner) {
        match owner {
            Owner::Nobody => {}
            Owner::Several => self.shared = true,
            Owner::Limb(limb) => {
                let found = if limb.set == NAMELESS { &mut self.without } else { &mut self.with_coordinates };
                *found = match *found {
                    Which::None => Which::One(limb),
                    Which::One(known) if known == limb => Which::One(limb),
                    Which::One(_) | Which::Several => Which::Several,
                };
            }
        }
    }

    /// What is common to several limbs is as a number to one of them: the acceleration of the trunk to the leg that it carries.
    fn owner(&self) -> Owner {
        match (self.with_coordinates, self.without) {
            (Which::One(limb), _) | (Which::None, Which::One(limb)) => Owner::Limb(limb),
            (Which::Several, _) | (Which::None, Which::Several) => Owner::Several,
            (Which::None, Which::None) if self.shared => Owner::Several,
            (Which::None, Which::None) => Owner::Nobody,
        }
    }
}

impl<'a> Likeness<'a> {
    /// With limbs that have coordinates, and with so many that have none.
    pub(super) fn new(statements: &[Statement], limbs: &'a Limbs, without: Option<usize>) -> Likeness<'a> {
        let by_coordinates = Likeness::with(statements, limbs, &vec![None; statements.len()]);
        match without.map(|count| by_coordinates.nameless(statements, count)) {
            Some(given) => Likeness::with(statements, limbs, &given),
            None => by_coordinates,
        }
    }

    /// How many limbs without coordinates there may be, the likeliest first; none where limbs with coordinates do most of the work: what looks
    /// like others may be a spine's, on which these stand.
    pub(super) fn counts_without(statements: &[Statement], limbs: &'a Limbs) -> Vec<usize> {
        let by_coordinates = Likeness::new(statements, limbs, None);
        let all: usize = statements.iter().map(leaves).sum();
        if 2 * by_coordinates.work(statements) > all {
            return Vec::new();
        }
        let mut work: BTreeMap<usize, usize> = BTreeMap::new();
        for members in by_coordinates.alike_without().values().filter(|list| NAMELESS_LIMBS.contains(&list.len())) {
            let each = members.iter().map(|&number| leaves(&statements[number]));
            *work.entry(members.len()).or_default() += each.sum::<usize>();
        }
        let mut counts: Vec<usize> = work.keys().copied().collect();
        counts.sort_by_key(|count| std::cmp::Reverse(work[count]));
        counts.truncate(COUNTS);
        counts
    }

    /// Statements that belong to nobody, by their signatures.
    fn alike_without(&self) -> BTreeMap<u64, Vec<usize>> {
        let mut alike: BTreeMap<u64, Vec<usize>> = BTreeMap::new();
        for (number, form) in self.forms.iter().enumerate() {
            if let (Some(form), Owner::Nobody) = (form, self.owners[number]) {
                alike.entry(*form).or_default().push(number);
            }
        }
        alike
    }

    /// How much stands in groups.
    fn work(&self, statements: &[Statement]) -> usize {
        self.groups.iter().flat_map(BTreeMap::values).map(|&number| leaves(&statements[number])).sum()
    }

    /// With limbs of which statements are known to be.
    fn with(statements: &[Statement], limbs: &'a Limbs, given: &[Option<Limb>]) -> Likeness<'a> {
        let mut defined = HashMap::new();
        for (number, statement) in statements.iter().enumerate() {
            defined.extend(statement.defined().into_iter().enumerate().map(|(k, local)| (local, (number, k))));
        }
        let count = statements.len();
        let owners = given.iter().map(|limb| limb.map_or(Owner::Nobody, Owner::Limb)).collect();
        let (groups, group, forms) = (Vec::new(), vec![None; count], vec![None; count]);
        let mut found = Likeness { limbs, owners, groups, group, forms, defined };
        for level in found.levels(statements) {
            found.level(statements, &level);
        }
        found
    }

    /// The limbs of statements, if so many have no coordinates of their own.
    fn nameless(&self, statements: &[Statement], count: usize) -> Vec<Option<Limb>> {
        let alike = self.alike_without();
        let mut readers: Vec<Vec<usize>> = vec![Vec::new(); statements.len()];
        for (number, statement) in statements.iter().enumerate() {
            for expression in statement.expressions() {
                expression.each_local(&mut |local| {
                    if let Some(&(by, _)) = self.defined.get(&local) {
                        readers[by].push(number);
                    }
                });
            }
        }
        let mut given: Vec<Option<Limb>> = vec![None; statements.len()];
        for level in self.levels(statements).iter().rev() {
            for &number in level.iter().filter(|&&number| self.owners[number] == Owner::Nobody) {
                let first = readers[number].first().and_then(|&reader| given[reader]);
                if readers[number].iter().all(|&reader| given[reader] == first) {
                    given[number] = first;
                }
            }
            for number in level {
                let Some(members) = self.forms[*number].and_then(|form| alike.get(&form)) else { continue };
                if members.len() == count && members.iter().all(|&member| given[member].is_none()) {
                    for (limb, &member) in members.iter().enumerate() {
                        given[member] = Some(Limb { set: NAMELESS, number: limb });
                    }
                }
            }
        }
        given
    }

    /// Statements by depth, in their order.
    fn levels(&self, statements: &[Statement]) -> Vec<Vec<usize>> {
        let mut depth = vec![0; statements.len()];
        let mut levels: Vec<Vec<usize>> = Vec::new();
        for (number, statement) in statements.iter().enumerate() {
            let mut least = 0;
            for expression in statement.expressions() {
                expression.each_local(&mut |local| {
                    // What is defined inside of an iteration is read there alone.
                    if let Some(&(by, _)) = self.defined.get(&local).filter(|(by, _)| *by < number) {
                        least = least.max(depth[by] + 1);
                    }
                });
            }
            depth[number] = least;
            if levels.len() <= least {
                levels.resize(least + 1, Vec::new());
            }
            levels[least].push(number);
        }
        levels
    }

    fn level(&mut self, statements: &[Statement], level: &[usize]) {
        let mut alike: BTreeMap<u64, Vec<usize>> = BTreeMap::new();
        for &number in level {
            let statement = &statements[number];
            let mut leaves = Leaves::default();
            leaves.add(self.owners[number]);
            statement.expressions().for_each(|expression| self.add_leaves(&mut leaves, expression));
            self.owners[number] = leaves.owner();
            self.forms[number] = self.of_statement(statement);
            if let (Some(signature), false) = (self.forms[number], self.owners[number] == Owner::Several) {
                alike.entry(signature).or_default().push(number);
            }
        }
        // In the order of the program, whatever the signatures are.
        let mut alike: Vec<Vec<usize>> = alike.into_values().collect();
        alike.sort_unstable();
        for members in alike {
            self.matched(statements, &members);
        }
    }

    /// Groups of what limbs have, with one signature.
    fn matched(&mut self, statements: &[Statement], members: &[usize]) {
        let mut sets: BTreeMap<usize, BTreeMap<Limb, Vec<usize>>> = BTreeMap::new();
        for &number in members {
            if let Owner::Limb(limb) = self.owners[number] {
                sets.entry(limb.set).or_default().entry(limb).or_default().push(number);
            }
        }
        for mut limbs in sets.into_values() {
            // The limb with the most of them goes first.
            while let Some((first, mut own)) = limbs
                .iter()
                .max_by_key(|(limb, list)| (list.len(), std::cmp::Reverse(**limb)))
                .map(|(limb, list)| (*limb, list.clone()))
                .filter(|(_, list)| !list.is_empty())
            {
                let model = own.remove(0);
                let common = self.all_common(&statements[model]);
                let mut group = Group::from([(first, model)]);
                for (&limb, list) in limbs.iter_mut() {
                    if limb == first {
                        list.retain(|&number| number != model);
                        continue;
                    }
                    let place = list.iter().position(|&number| self.all_common(&statements[number]) == common);
                    if !list.is_empty() {
                        group.insert(limb, list.remove(place.unwrap_or(0)));
                    }
                }
                if group.len() > 1 {
                    self.add(group);
                }
            }
        }
    }

    fn add(&mut self, group: Group) {
        for &number in group.values() {
            self.group[number] = Some(self.groups.len());
        }
        self.groups.push(group);
    }

    /// Whom a value belongs to.
    pub(super) fn owner(&self, expression: &Expression) -> Owner {
        let mut leaves = Leaves::default();
        self.add_leaves(&mut leaves, expression);
        leaves.owner()
    }

    fn add_leaves(&self, leaves: &mut Leaves, expression: &Expression) {
        expression.each_leaf(&mut |leaf| {
            leaves.add(match leaf {
                Expression::Local(local) => {
                    self.defined.get(local).map_or(Owner::Several, |&(number, _)| self.owners[number])
                }
                Expression::Symbol(symbol) => self
                    .limbs
                    .place(*symbol)
                    .map_or(Owner::Nobody, |place| Owner::Limb(Limb { set: place.set, number: place.limb })),
                _ => Owner::Nobody,
            });
        });
    }

    /// What limbs may have in common beside the form: literals without signs, and shared values, in an order of their own.
    pub(super) fn common(&self, expression: &Expression) -> Vec<(u8, u64)> {
        let mut found = Vec::new();
        expression.each_leaf(&mut |leaf| match leaf {
            Expression::Literal(value) => found.push((0, value.abs().to_bits())),
            Expression::Local(local) => {
                let number = self.defined.get(local).map(|place| place.0);
                if number.is_some_and(|number| !matches!(self.owners[number], Owner::Limb(_))) {
                    found.push((1, local.0 as u64));
                }
            }
            _ => {}
        });
        found.sort_unstable();
        found
    }

    fn all_common(&self, statement: &Statement) -> Vec<(u8, u64)> {
        statement.expressions().flat_map(|expression| self.common(expression)).collect()
    }

    fn of_statement(&self, statement: &Statement) -> Option<u64> {
        match statement {
            Statement::Let { value, .. } => Some(hash(&(0, self.signature(value)?))),
            Statement::SinCos(sines) => match &sines[..] {
                [sine] => Some(hash(&(1, self.signature(&sine.angle)?))),
                _ => None,
            },
            _ => None,
        }
    }

    /// The form of an expression; nothing where it has operations that packs have not.
    pub(super) fn signature(&self, expression: &Expression) -> Option<u64> {
        let all = |list: &[Expression]| -> Option<Vec<u64>> {
            let mut found: Vec<u64> = list.iter().map(|item| self.signature(item)).collect::<Option<_>>()?;
            found.sort_unstable();
            Some(found)
        };
        Some(match expression {
            Expression::Literal(_) => hash(&"literal"),
            Expression::Field(_) => hash(&"field"),
            Expression::Symbol(symbol) => match (self.limbs.place(*symbol), symbol) {
                (Some(place), _) => hash(&("own", coordinate(*symbol), place.set, place.joint)),
                (None, Symbol::Input { .. }) => hash(&"input"),
                (None, symbol) => hash(&("shared", symbol)),
            },
            Expression::Local(local) => {
                let &(number, which) = self.defined.get(local)?;
                match (self.group[number], self.owners[number]) {
                    (Some(group), _) => hash(&("alike", group, which)),
                    (None, Owner::Limb(_)) => hash(&"alone"),
                    (None, _) => match self.forms[number] {
                        Some(form) => hash(&("like", form, which)),
                        None => hash(&("local", local)),
                    },
                }
            }
            Expression::Neg(inner) => self.signature(inner)?,
            Expression::Sum(terms) => {
                let mut found: Vec<u64> = terms.iter().map(|(_, term)| self.signature(term)).collect::<Option<_>>()?;
                found.sort_unstable();
                hash(&("sum", found))
            }
            Expression::Product(list) => hash(&("product", all(list)?)),
            Expression::Quotient(above, below) => hash(&("quotient", self.signature(above)?, self.signature(below)?)),
            Expression::Call(Call::Sqrt, list) => hash(&("root", all(list)?)),
            Expression::Fused(_) | Expression::Call(..) | Expression::Pack(_) => return None,
        })
    }
}

/// Which coordinate of its joint, of which kind.
fn coordinate(symbol: Symbol) -> (u8, usize) {
    match symbol {
        Symbol::Position { component, .. } => (0, component),
        Symbol::Velocity { component, .. } => (1, component),
        Symbol::Acceleration { component, .. } => (2, component),
        Symbol::Impulse { component, .. } => (3, component),
        Symbol::Momentum { component, .. } => (4, component),
        _ => (5, 0),
    }
}

/// A measure of its work.
fn leaves(statement: &Statement) -> usize {
    let mut count = 0;
    for expression in statement.expressions() {
        expression.each_leaf(&mut |_| count += 1);
    }
    count
}

/// The same in every build.
fn hash<T: Hash>(value: &T) -> u64 {
    let mut hasher = DefaultHasher::new();
    value.hash(&mut hasher);
    hasher.finish()
}
