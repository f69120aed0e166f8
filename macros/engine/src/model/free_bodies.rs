//! Stage `model`: bodies that turn freely, and speeds that go with them.
//!
//! In: a checked model. Out: its [`FreeBody`]s, and the model with components of their velocities as `speed` items of the user's.

use proc_macro2::Span;
use syn::Ident;
use syn::ext::IdentExt;

use super::types::{
    Body, BodyId, BodyRef, Docs, Expr, ExprNode, Frame, FrameQuantity, Joint, Model, Place, Speed, Type,
};

/// A body with the joints between it and what carries it, where nothing in between has a mass.
pub struct FreeBody {
    pub body: BodyId,
    /// What has a mass, or the ground.
    base: BodyRef,
    /// The same, or the ground where nothing turns the base.
    turns_against: BodyRef,
    /// Without mass, behind the last hinge.
    carrier: Option<BodyRef>,
    turns: usize,
    slides: usize,
    /// Whether its rates of turning are components in its own axes already.
    by_quaternion: bool,
}

/// The components that are taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Speeds {
    /// Of turns against what carries a body, in its own axes.
    Turns,
    /// The same in axes of the body without mass that carries its last hinge.
    TurnsOfCarrier,
    /// The same as the first, with travels of bodies on the ground.
    TurnsAndTravels,
    /// Of turns against the ground, in own axes.
    TurnsOnGround,
}

const AXES: [&str; 3] = ["x", "y", "z"];

impl FreeBody {
    /// Quantities of this body whose components are speeds: the axes, what it moves against, the word for names, and the quantity.
    fn taken(&self, speeds: Speeds) -> Vec<(BodyRef, BodyRef, &'static str, FrameQuantity)> {
        let own = BodyRef::Body(self.body);
        let turning = |axes, base| (axes, base, "omega", FrameQuantity::AngularVelocity);
        let is_free = self.turns == 3;
        let mut taken = Vec::new();
        let by_rates = self.by_quaternion;
        match speeds {
            Speeds::TurnsOfCarrier => {
                taken.extend(self.carrier.filter(|_| is_free).map(|carrier| turning(carrier, self.turns_against)));
            }
            Speeds::TurnsOnGround if is_free && (!by_rates || self.turns_against != BodyRef::Ground) => {
                taken.push(turning(own, BodyRef::Ground));
            }
            Speeds::Turns | Speeds::TurnsAndTravels if is_free && !by_rates => {
                taken.push(turning(own, self.turns_against))
            }
            _ => {}
        }
        if speeds == Speeds::TurnsAndTravels && self.base == BodyRef::Ground && self.slides > 1 && self.turns > 0 {
            taken.push((own, self.base, "velocity", FrameQuantity::Velocity));
        }
        taken
    }
}

impl Model {
    /// Bodies with several freedoms against the nearest one that has a mass; and what slides and turns on one joint, though nothing is
    /// fixed to it.
    pub fn free_bodies(&self) -> Vec<FreeBody> {
        let wide = |id: BodyId| {
            let carried =
                self.tree.iter().map(|&joint| &self.joints[joint]).find(|joint| joint.child.body == BodyRef::Body(id));
            carried.is_some_and(|joint| joint.kind.slides() > 1 && joint.kind.freedoms() > joint.kind.slides())
        };
        let counts = |&(id, body): &(BodyId, &Body)| wide(id) || !is_weightless(body);
        self.bodies.iter_ids().filter(counts).filter_map(|(id, _)| self.free_body(id)).collect()
    }

    fn free_body(&self, body: BodyId) -> Option<FreeBody> {
        let carried = |of: BodyRef| self.tree.iter().map(|&id| &self.joints[id]).find(|joint| joint.child.body == of);
        let last = carried(BodyRef::Body(body))?;
        let (mut turns, mut slides, mut joint) = (0, 0, last);
        let base = loop {
            slides += joint.kind.slides();
            turns += joint.kind.freedoms() - joint.kind.slides();
            match joint.parent.body {
                BodyRef::Body(id) if is_weightless(&self.bodies[id]) => joint = carried(joint.parent.body)?,
                base => break base,
            }
        };
        let (mut still, mut turns_against) = (base, BodyRef::Ground);
        while still != BodyRef::Ground {
            let below = carried(still)?;
            if below.kind.freedoms() > below.kind.slides() {
                turns_against = base;
            }
            still = below.parent.body;
        }
        let is_hinge = |joint: &Joint| joint.kind.freedoms() == 1 && joint.kind.slides() == 0;
        let carrier = Some(last.parent.body).filter(|&carrier| is_hinge(last) && carrier != base);
        let by_quaternion = last.kind.has_quaternion() && last.child.steps.is_empty();
        (turns + slides > 1).then_some(FreeBody { body, base, turns_against, carrier, turns, slides, by_quaternion })
    }

    /// The same with velocities of bodies as speeds; nothing where there are none.
    pub fn with_speeds(&self, bodies: &[FreeBody], speeds: Speeds) -> Option<Model> {
        let mut list = Vec::new();
        for body in bodies {
            for (axes, base, word, quantity) in body.taken(speeds) {
                list.extend((0..3).map(|k| self.component(body.body, axes, base, word, quantity, k)));
            }
        }
        (!list.is_empty()).then(|| Model { speeds: list, ..self.clone() })
    }

    /// The same without speeds that not all instances of a part have.
    pub fn alike_in_parts(mut self) -> Model {
        let kind = |speed: &Speed| self.instances[speed.place.instance].part_type;
        let count = |speed: &Speed| match kind(speed) {
            None => 1,
            part => self.instances.iter().filter(|instance| instance.part_type == part).count(),
        };
        let has = |speed: &&Speed| {
            let same = |other: &&Speed| kind(other) == kind(speed) && other.place.field == speed.place.field;
            self.speeds.iter().filter(same).count() == count(speed)
        };
        let list: Vec<Speed> = self.speeds.iter().filter(has).cloned().collect();
        self.speeds = list;
        self
    }

    /// Whether it has the same speeds as another one, made by the same choice of components or by another.
    pub fn has_speeds_of(&self, other: &Model) -> bool {
        let docs = |model: &Model| -> Vec<(usize, String, Vec<String>)> {
            let of = |speed: &Speed| (speed.place.instance.0, speed.place.field.to_string(), speed.docs.text.clone());
            model.speeds.iter().map(of).collect()
        };
        docs(self) == docs(other)
    }

    fn component(
        &self,
        body: BodyId,
        axes: BodyRef,
        base: BodyRef,
        word: &str,
        quantity: FrameQuantity,
        k: usize,
    ) -> Speed {
        let span = self.name.span();
        let at = &self.bodies[body].place;
        let frame = |body: BodyRef| Frame { body, steps: Vec::new(), span };
        let vector = |node: ExprNode| Expr::new(node, Type::Vec3, span);
        let of = |body: BodyRef| vector(ExprNode::OfFrame(frame(body), quantity));
        let own = of(BodyRef::Body(body));
        let relative = match base {
            BodyRef::Ground => own,
            base => vector(ExprNode::Sub(own, of(base))),
        };
        let seen = vector(ExprNode::Express { frame: frame(axes), vector: relative });
        let value = Expr::new(ExprNode::Component(seen, k), Type::Scalar, span);
        let field = self.free_name(at, &format!("{}_{word}_{}", at.field.unraw(), AXES[k]), span);
        let unit = if quantity == FrameQuantity::Velocity { "m/s" } else { "rad/s" };
        let name = |body: BodyRef| match body {
            BodyRef::Ground => "the ground".to_owned(),
            BodyRef::Body(id) => format!("`{}`", self.bodies[id].place.field),
        };
        let what = if quantity == FrameQuantity::Velocity { "velocity" } else { "angular velocity" };
        let (against, along) = (name(base), name(axes));
        let text = format!("{} component of the {what} against {against}, in axes of {along}.", AXES[k]);
        let docs = Docs { unit: Some(unit.to_owned()), text: vec![text] };
        Speed { place: Place { instance: at.instance, field }, value, docs, span }
    }

    /// A name that no velocity of an instance has.
    fn free_name(&self, at: &Place, wanted: &str, span: Span) -> Ident {
        let joints = self.joints.iter().map(|joint| &joint.place);
        let parts =
            self.instances.iter().filter(|part| part.parent == Some(at.instance)).map(|part| part.field.to_string());
        let taken: Vec<String> = joints
            .filter(|place| place.instance == at.instance)
            .map(|place| place.field.to_string())
            .chain(parts)
            .collect();
        let mut name = wanted.to_owned();
        while taken.contains(&name) {
            name.push('_');
        }
        Ident::new(&name, span)
    }
}

/// Whether a body is a frame and nothing else.
fn is_weightless(body: &Body) -> bool {
    let is_zero = |value: &Expr| matches!(&*value.node, ExprNode::Number(x) if *x == 0.0);
    let inertia = body.inertia.as_deref();
    is_zero(&body.mass) && inertia.is_none_or(|entries| entries.iter().all(is_zero))
}
