//! Stage `emit`: which field of which generated struct holds what.
//!
//! In: the checked model and its structure. Out: a [`Layout`]: for each group of structs (`Params`, `Position`, ..) the
//! leaves in the order of the model, and from them the fields of every struct, the path of every leaf, and values built
//! from leaves.
//!
//! A part's structs have the union of the fields of its instances, so that one type serves them all.

pub(super) mod groups;
pub(super) mod joints;
pub(super) mod leaf;
pub(super) mod places;
pub(super) mod values;

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;
use syn::Path;

use crate::mechanics::loops::structure::Structure;
use crate::model::types::{InstanceId, JointId, Model, PartTypeId, Place};

use self::joints::Piece;
use self::leaf::Leaf;
use super::{document, names};

/// The kinds of generated structs with fields of the model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum StructKind {
    Params,
    Position,
    Velocity,
    /// Rates of positions, where velocities are others.
    Rates,
    States,
    /// Where Newton's method starts to close loops.
    Guess,
    Input,
    Output,
    /// Where all bodies are.
    Poses,
}

impl StructKind {
    pub(super) const ALL: [StructKind; 9] = [
        StructKind::Params,
        StructKind::Position,
        StructKind::Velocity,
        StructKind::Rates,
        StructKind::States,
        StructKind::Guess,
        StructKind::Input,
        StructKind::Output,
        StructKind::Poses,
    ];

    /// Name of the struct.
    pub(super) fn name(self) -> Ident {
        names::ident(match self {
            StructKind::Params => "Params",
            StructKind::Position => "Position",
            StructKind::Velocity => "Velocity",
            StructKind::Rates => "Rates",
            StructKind::States => "States",
            StructKind::Guess => "Guess",
            StructKind::Input => "Input",
            StructKind::Output => "Output",
            StructKind::Poses => "Poses",
        })
    }

    /// Structs that stand in the module even where they are empty.
    pub(super) fn always(self) -> bool {
        matches!(self, StructKind::Params | StructKind::Position | StructKind::Velocity)
    }
}

/// One leaf of a group: what a joint, a param, .. has there.
pub(super) struct Entry {
    pub(super) instance: InstanceId,
    pub(super) field: Ident,
    pub(super) leaf: Leaf,
    /// Number of the first scalar within the group.
    pub(super) offset: usize,
    /// Declared values, where there are any.
    pub(super) default: Option<Vec<f64>>,
    pub(super) docs: Vec<String>,
    pub(super) unit: Option<String>,
}

/// The leaves of one group, in the model's order.
#[derive(Default)]
pub(super) struct Table {
    pub(super) entries: Vec<Entry>,
    /// Number of scalars.
    pub(super) size: usize,
}

/// A field of a generated struct.
pub(super) struct Field {
    pub(super) name: Ident,
    pub(super) docs: Vec<String>,
    pub(super) unit: Option<String>,
    pub(super) kind: FieldKind,
}

pub(super) enum FieldKind {
    Leaf(Leaf),
    /// The struct of a part, or an array of them.
    Part(PartTypeId, Option<usize>),
}

/// All groups of one model.
pub(super) struct Layout<'a> {
    pub(super) model: &'a Model,
    pub(super) structure: &'a Structure,
    params: Table,
    position: Table,
    velocity: Table,
    rates: Table,
    states: Table,
    guess: Table,
    input: Table,
    output: Table,
    poses: Table,
    /// By the number of an unknown in the guess: its leaf there, and the component.
    guessed: Vec<(usize, usize)>,
    /// By joint: numbers of its leaves in `position`, and what of the joint they hold.
    joints: Vec<Vec<(usize, Piece)>>,
    /// The same in `velocity`; behind joints speeds of the user's choice, which are scalars.
    velocities: Vec<Vec<(usize, Piece)>>,
}

impl<'a> Layout<'a> {
    pub(super) fn new(model: &'a Model, structure: &'a Structure) -> Self {
        let mut layout = Layout {
            model,
            structure,
            params: Table::default(),
            position: Table::default(),
            velocity: Table::default(),
            rates: Table::default(),
            states: Table::default(),
            guess: Table::default(),
            guessed: Vec::new(),
            input: Table::default(),
            output: Table::default(),
            poses: Table::default(),
            joints: Vec::new(),
            velocities: Vec::new(),
        };
        layout.add_joints();
        layout.add_velocities();
        layout.add_guess();
        let dof = layout.dof();
        for param in &model.params {
            let leaf = Leaf::value(&param.ty, dof);
            let docs = document::param(param);
            layout.add(StructKind::Params, &param.place, leaf, docs, param.docs.unit.clone());
            layout.default(StructKind::Params, param.default.clone());
        }
        for state in &model.states {
            let docs = document::state(state);
            layout.add(StructKind::States, &state.place, Leaf::Scalar, docs, state.docs.unit.clone());
            layout.default(StructKind::States, vec![state.start]);
        }
        for input in &model.inputs {
            let leaf = Leaf::value(&input.ty, dof);
            let docs = document::item(&input.docs, "input");
            layout.add(StructKind::Input, &input.place, leaf, docs, input.docs.unit.clone());
        }
        for output in &model.outputs {
            let leaf = Leaf::value(&output.value.ty, dof);
            let docs = document::item(&output.docs, "output");
            layout.add(StructKind::Output, &output.place, leaf, docs, output.docs.unit.clone());
        }
        if model.shows_poses() {
            for body in model.bodies.iter() {
                let docs = document::item(&body.docs, "body");
                layout.add(StructKind::Poses, &body.place, Leaf::placement(), docs, None);
            }
        }
        layout
    }

    /// In the order of the state, coordinates of one joint together.
    fn add_joints(&mut self) {
        let (model, structure) = (self.model, self.structure);
        self.joints = model.joints.iter().map(|_| Vec::new()).collect();
        for coordinate in &structure.state {
            let id = coordinate.joint;
            let joint = &model.joints[id];
            if !self.joints[id.0].is_empty() {
                continue;
            }
            for piece in joints::pieces(joint.kind, &joints::held(model, &structure.state, id)) {
                let field = joints::field(model, &structure.state, id, joint, &piece);
                let place = Place { instance: joint.place.instance, field };
                let [of_position, of_velocity] = piece.docs(joint);
                let [unit, rate] = piece.units(joint);
                let index = self.add(StructKind::Position, &place, piece.position.clone(), of_position, unit);
                if structure.has_speeds() {
                    self.add(StructKind::Rates, &place, piece.velocity.clone(), of_velocity, rate);
                }
                self.joints[id.0].push((index, piece));
            }
        }
    }

    /// In the order of velocity coordinates, those of one joint together.
    fn add_velocities(&mut self) {
        let (model, structure) = (self.model, self.structure);
        let speeds = structure.speeds();
        self.velocities = (0..model.joints.len() + model.speeds.len()).map(|_| Vec::new()).collect();
        for coordinate in speeds {
            let id = coordinate.joint;
            if !self.velocities[id.0].is_empty() {
                continue;
            }
            if let Some(speed) = model.speed(id) {
                let (docs, unit) = (document::speed(speed), speed.docs.unit.clone());
                let index = self.add(StructKind::Velocity, &speed.place, Leaf::Scalar, docs, unit);
                self.velocities[id.0].push((index, Piece::of_speed()));
                continue;
            }
            let joint = &model.joints[id];
            for piece in joints::velocity_pieces(joint.kind, &joints::held(model, speeds, id)) {
                let field = joints::field(model, speeds, id, joint, &piece);
                let place = Place { instance: joint.place.instance, field };
                let ([_, docs], [_, rate]) = (piece.docs(joint), piece.units(joint));
                let index = self.add(StructKind::Velocity, &place, piece.velocity.clone(), docs, rate);
                self.velocities[id.0].push((index, piece));
            }
        }
    }

    /// What Newton's method finds, in its order, coordinates of one joint together; starts where the loops are closed.
    fn add_guess(&mut self) {
        let (model, structure) = (self.model, self.structure);
        let unknowns = structure.guessed();
        self.guessed = vec![(usize::MAX, 0); unknowns.len()];
        for (number, coordinate) in unknowns.iter().enumerate() {
            let id = coordinate.joint;
            let joint = &model.joints[id];
            if unknowns.iter().take(number).any(|other| other.joint == id) {
                continue;
            }
            for piece in joints::pieces(joint.kind, &joints::held(model, &unknowns, id)) {
                let field = joints::field(model, &unknowns, id, joint, &piece);
                let place = Place { instance: joint.place.instance, field };
                let ([docs, _], [unit, _]) = (piece.docs(joint), piece.units(joint));
                let entry = self.add(StructKind::Guess, &place, piece.position.clone(), docs, unit);
                let mut start = vec![0.0; piece.position.size()];
                for (known, unknown) in unknowns.iter().enumerate().filter(|(_, unknown)| unknown.joint == id) {
                    let Some(component) = piece.component(false, unknown.index) else { continue };
                    self.guessed[known] = (entry, component);
                    let closed = structure.closed.first().and_then(|closed| closed.value(model, *unknown));
                    if let Some((place, value)) = start.get_mut(component).zip(closed) {
                        *place = value;
                    }
                }
                self.default(StructKind::Guess, start);
            }
        }
    }

    /// The leaf and the component of an unknown of the guess.
    pub(super) fn guessed(&self, index: usize) -> Option<(&Entry, usize)> {
        let (entry, component) = *self.guessed.get(index)?;
        Some((self.guess.entries.get(entry)?, component))
    }

    /// The unknowns of the guess in the order of its leaves.
    pub(super) fn in_leaves(&self, unknowns: &[TokenStream]) -> Vec<TokenStream> {
        let mut list = vec![TokenStream::new(); self.guess.size];
        for (index, unknown) in unknowns.iter().enumerate() {
            let place = self.guessed(index).and_then(|(entry, component)| list.get_mut(entry.offset + component));
            if let Some(place) = place {
                place.clone_from(unknown);
            }
        }
        list
    }

    fn add(&mut self, group: StructKind, place: &Place, leaf: Leaf, docs: Vec<String>, unit: Option<String>) -> usize {
        let table = self.table_mut(group);
        let offset = table.size;
        table.size += leaf.size();
        table.entries.push(Entry {
            instance: place.instance,
            field: names::field(&place.field),
            leaf,
            offset,
            default: None,
            docs,
            unit,
        });
        table.entries.len() - 1
    }

    fn default(&mut self, group: StructKind, values: Vec<f64>) {
        if let Some(entry) = self.table_mut(group).entries.last_mut() {
            entry.default = Some(values);
        }
    }

    pub(super) fn table(&self, group: StructKind) -> &Table {
        match group {
            StructKind::Params => &self.params,
            StructKind::Position => &self.position,
            StructKind::Velocity => &self.velocity,
            StructKind::Rates => &self.rates,
            StructKind::States => &self.states,
            StructKind::Guess => &self.guess,
            StructKind::Input => &self.input,
            StructKind::Output => &self.output,
            StructKind::Poses => &self.poses,
        }
    }

    fn table_mut(&mut self, group: StructKind) -> &mut Table {
        match group {
            StructKind::Params => &mut self.params,
            StructKind::Position => &mut self.position,
            StructKind::Velocity => &mut self.velocity,
            StructKind::Rates => &mut self.rates,
            StructKind::States => &mut self.states,
            StructKind::Guess => &mut self.guess,
            StructKind::Input => &mut self.input,
            StructKind::Output => &mut self.output,
            StructKind::Poses => &mut self.poses,
        }
    }

    /// What displaces a position, and is its rate: the velocity, if that is the rates of all coordinates.
    pub(super) fn displacement(&self) -> StructKind {
        if self.structure.has_speeds() { StructKind::Rates } else { StructKind::Velocity }
    }

    /// Number of velocity coordinates.
    pub(super) fn dof(&self) -> usize {
        self.table(StructKind::Velocity).size
    }

    pub(super) fn krate(&self) -> &'a Path {
        &self.model.krate
    }

    /// The leaf in `Position` or `Velocity` that holds a component of a joint, and its number there.
    pub(super) fn joint(&self, group: StructKind, joint: JointId, component: usize) -> Option<(&Entry, usize)> {
        let is_velocity = group == StructKind::Velocity;
        let lists = if is_velocity { &self.velocities } else { &self.joints };
        let mut pieces = lists.get(joint.0)?.iter();
        let (index, component) =
            pieces.find_map(|(index, piece)| Some((*index, piece.component(is_velocity, component)?)))?;
        Some((self.table(group).entries.get(index)?, component))
    }

    /// Whether the structs of this group have nothing in them, in the model (`None`) or in a part.
    pub(super) fn is_empty(&self, group: StructKind, owner: Option<PartTypeId>) -> bool {
        let mut entries = self.table(group).entries.iter();
        !entries.any(|entry| owner.is_none() || self.is_within(entry.instance, owner))
    }

    /// Whether `instance` is one of this part, or stands inside one.
    fn is_within(&self, instance: InstanceId, part: Option<PartTypeId>) -> bool {
        let mut next = Some(instance);
        // Parents come before children, so that the walk ends; the bound is for a model that breaks the rule.
        for _ in 0..=self.model.instances.len() {
            let Some(instance) = next.and_then(|id| self.model.instances.get(id.0)) else {
                return false;
            };
            if instance.part_type == part {
                return true;
            }
            next = instance.parent;
        }
        false
    }

    /// Instances of a part; the model itself is the one of `None`.
    pub(super) fn instances(&self, owner: Option<PartTypeId>) -> Vec<InstanceId> {
        let all = self.model.instances.iter().enumerate();
        all.filter(|(index, instance)| instance.part_type == owner && (owner.is_some() || *index == 0))
            .map(|(index, _)| InstanceId(index))
            .collect()
    }

    /// Fields of a struct of the model (`None`) or of a part, in the order of their first scalars.
    pub(super) fn fields(&self, group: StructKind, owner: Option<PartTypeId>) -> Vec<Field> {
        let instances = self.instances(owner);
        let mut fields: Vec<Field> = Vec::new();
        for entry in &self.table(group).entries {
            let field = if instances.contains(&entry.instance) {
                Some(Field {
                    name: entry.field.clone(),
                    docs: entry.docs.clone(),
                    unit: entry.unit.clone(),
                    kind: FieldKind::Leaf(entry.leaf.clone()),
                })
            } else {
                self.part_field(entry.instance, &instances)
            };
            if let Some(field) = field
                && !fields.iter().any(|known| known.name == field.name)
            {
                fields.push(field);
            }
        }
        fields
    }

    /// The field of one of `owners` in which `inner` stands.
    fn part_field(&self, inner: InstanceId, owners: &[InstanceId]) -> Option<Field> {
        let mut next = self.model.instances.get(inner.0);
        for _ in 0..self.model.instances.len() {
            let instance = next?;
            let parent = instance.parent?;
            if owners.contains(&parent) {
                let part = instance.part_type?;
                return Some(Field {
                    name: names::field(&instance.field),
                    docs: document::item(&instance.docs, &self.part_doc(part)),
                    unit: None,
                    kind: FieldKind::Part(part, instance.index.map(|(_, count)| count)),
                });
            }
            next = self.model.instances.get(parent.0);
        }
        None
    }

    fn part_doc(&self, part: PartTypeId) -> String {
        let name = self.model.part_types.get(part.0);
        name.map_or_else(String::new, |part| format!("part `{}`", names::plain(&part.name)))
    }

    /// Expands to `leg::Position` as seen from the model's module, to `super::leg::Position` from that of a part.
    pub(super) fn path(&self, group: StructKind, owner: Option<PartTypeId>, in_part: bool) -> TokenStream {
        let name = group.name();
        let outer = in_part.then(|| quote!(super::));
        match owner.and_then(|part| self.model.part_types.get(part.0)) {
            Some(part) => {
                let part = names::field(&part.name);
                quote!(#outer #part::#name)
            }
            None => quote!(#name),
        }
    }

    /// Expands to a field's type.
    pub(super) fn field_type(&self, group: StructKind, kind: &FieldKind, in_part: bool) -> TokenStream {
        match kind {
            FieldKind::Leaf(leaf) => leaf.ty(self.krate()),
            FieldKind::Part(part, count) => {
                let path = self.path(group, Some(*part), in_part);
                match count {
                    Some(count) => {
                        let count = Literal::usize_unsuffixed(*count);
                        quote!([#path<T>; #count])
                    }
                    None => quote!(#path<T>),
                }
            }
        }
    }

    /// Expands to the fields that lead to a leaf of `instance`: `.legs[2].gimbal`.
    pub(super) fn leaf_path(&self, entry: &Entry) -> TokenStream {
        let field = &entry.field;
        let mut path = quote!(.#field);
        let mut next = self.model.instances.get(entry.instance.0);
        for _ in 0..self.model.instances.len() {
            let Some((instance, parent)) = next.and_then(|i| Some((i, i.parent?))) else {
                break;
            };
            let field = names::field(&instance.field);
            path = match instance.index {
                Some((index, _)) => {
                    let index = Literal::usize_unsuffixed(index);
                    quote!(.#field[#index] #path)
                }
                None => quote!(.#field #path),
            };
            next = self.model.instances.get(parent.0);
        }
        path
    }

    /// The same as text, for documentation: `legs[2].gimbal`.
    pub(super) fn name(&self, place: &Place) -> String {
        let mut name = names::plain(&place.field);
        let mut next = self.model.instances.get(place.instance.0);
        for _ in 0..self.model.instances.len() {
            let Some((instance, parent)) = next.and_then(|i| Some((i, i.parent?))) else {
                break;
            };
            let field = names::plain(&instance.field);
            name = match instance.index {
                Some((index, _)) => format!("{field}[{index}].{name}"),
                None => format!("{field}.{name}"),
            };
            next = self.model.instances.get(parent.0);
        }
        name
    }
}
