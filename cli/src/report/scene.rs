//! The mechanism in numbers where it stands by default: what there is to draw.

use multibody_engine::emit::Facts;
use multibody_engine::mechanics::Reads;
use multibody_engine::mechanics::loops::structure::Structure;
use multibody_engine::mechanics::poses::{Pose, Still, still};
use multibody_engine::model::joint_kinds::Motion;
use multibody_engine::model::types::{
    BodyId, BodyRef, ConstraintKind, Directions, Expr, ForceKind, Frame, FrameStep, Joint, JointId, Model,
};
use proc_macro2::Span;

use super::space::{AXES, Point, sub, unit};

pub(super) struct Scene {
    pub(super) bodies: Vec<Body>,
    pub(super) joints: Vec<Mark>,
    /// Points of joints and rods on the ground.
    pub(super) ground: Vec<Point>,
    /// Rods, and springs between points.
    pub(super) rods: Vec<[Point; 2]>,
    pub(super) springs: Vec<[Point; 2]>,
    /// From the parent's frame to the child's of joints that slide.
    pub(super) guides: Vec<[Point; 2]>,
    pub(super) up: Point,
    pub(super) is_closed: bool,
}

pub(super) struct Body {
    pub(super) name: String,
    pub(super) pose: Pose,
    pub(super) centre: Point,
    /// Where joints, rods and springs hold it, the joint that carries it first, and points of outputs.
    pub(super) anchors: Vec<Point>,
}

pub(super) struct Mark {
    pub(super) name: String,
    pub(super) at: Point,
    /// Directions of turns, and of slides.
    pub(super) turns: Vec<Point>,
    pub(super) slides: Vec<Point>,
    pub(super) closes: bool,
    /// Whether it has freedoms.
    pub(super) moves: bool,
}

/// Frames that are asked for together.
#[derive(Default)]
struct Frames(Vec<Frame>);

impl Frames {
    fn push(&mut self, frame: Frame) -> usize {
        self.0.push(frame);
        self.0.len() - 1
    }

    fn on(&mut self, body: BodyRef, steps: Vec<FrameStep>) -> usize {
        self.push(Frame { body, steps, span: Span::call_site() })
    }

    /// A frame, moved along a vector of its own axes.
    fn moved(&mut self, frame: &Frame, way: &Expr) -> usize {
        let mut frame = frame.clone();
        frame.steps.push(FrameStep::At(way.clone()));
        self.push(frame)
    }
}

/// Numbers of a joint's frames, of frames a way along each written direction, and whether that one is the child's.
struct Asked {
    parent: usize,
    child: usize,
    directions: Vec<(usize, bool)>,
}

impl Scene {
    pub(super) fn new(model: &Model, structure: &Structure, facts: &Facts) -> Scene {
        let mut frames = Frames::default();
        let bodies: Vec<[usize; 2]> = (0..model.bodies.len())
            .map(|number| {
                let body = BodyRef::Body(BodyId(number));
                [
                    frames.on(body, Vec::new()),
                    frames.on(body, vec![FrameStep::At(model.bodies[BodyId(number)].com.clone())]),
                ]
            })
            .collect();
        let joints: Vec<Asked> = model.joints.iter().map(|joint| asked(&mut frames, joint)).collect();
        let mut held: Vec<(BodyRef, usize)> = Vec::new();
        // The joint that carries a body comes first.
        let order = model.tree.iter().chain(&model.cuts);
        for &id in order {
            held.push((model.joints[id].child.body, joints[id.0].child));
            held.push((model.joints[id].parent.body, joints[id.0].parent));
        }
        let mut ends = |frames: &mut Frames, between: &[Frame; 2]| {
            between.each_ref().map(|frame| {
                let number = frames.push(frame.clone());
                held.push((frame.body, number));
                number
            })
        };
        let mut rods = Vec::new();
        for constraint in &model.constraints {
            if let ConstraintKind::Rod { between, .. } = &constraint.kind {
                rods.push(ends(&mut frames, between));
            }
        }
        let mut springs = Vec::new();
        for force in &model.forces {
            if let ForceKind::LineSpring { between, .. } = &force.kind {
                springs.push(ends(&mut frames, between));
            }
        }
        for frame in Reads::of(model.outputs.iter().map(|output| &output.value)).frames {
            let body = frame.body;
            if body != BodyRef::Ground {
                held.push((body, frames.push(frame)));
            }
        }
        let gravity: Vec<&Expr> = model.gravity.iter().collect();
        let Still { poses, vectors, is_closed } = still(model, structure, &frames.0, &gravity);
        let origin = |number: usize| poses[number].origin;
        let line = |[a, b]: [usize; 2]| [origin(a), origin(b)];
        let anchors =
            |body: BodyRef| held.iter().filter(move |(other, _)| *other == body).map(|&(_, number)| origin(number));
        let body = |(number, [frame, centre]): (usize, &[usize; 2])| Body {
            name: facts.bodies[number].name.clone(),
            pose: poses[*frame],
            centre: origin(*centre),
            anchors: anchors(BodyRef::Body(BodyId(number))).collect(),
        };
        let joint = |(number, asked): (usize, &Asked)| {
            let fact = &facts.joints[number];
            let joint = &model.joints[JointId(number)];
            let (turns, slides) = directions(joint, asked, &poses);
            let moves = joint.kind.freedoms() > 0;
            Mark { name: fact.name.clone(), at: origin(asked.child), turns, slides, closes: fact.closes, moves }
        };
        let slides = |asked: &(&Joint, &Asked)| asked.0.kind.slides() == 1;
        let guides = model.joints.iter().zip(&joints).filter(slides);
        let guides = guides.map(|(_, asked)| line([asked.parent, asked.child])).collect();
        let up = vectors.first().and_then(|&[x, y, z]| unit([-x, -y, -z])).unwrap_or(AXES[2]);
        Scene {
            bodies: bodies.iter().enumerate().map(body).collect(),
            joints: joints.iter().enumerate().map(joint).collect(),
            ground: anchors(BodyRef::Ground).collect(),
            rods: rods.into_iter().map(line).collect(),
            springs: springs.into_iter().map(line).collect(),
            guides,
            up,
            is_closed,
        }
    }

    /// Everything that the drawing must hold.
    pub(super) fn points(&self) -> Vec<Point> {
        self.frames().into_iter().chain(self.bodies.iter().map(|body| body.centre)).collect()
    }

    /// What the mechanism's shape is told by: centres of mass seldom stand in its plane.
    pub(super) fn frames(&self) -> Vec<Point> {
        let lines = self.rods.iter().chain(&self.springs).flatten();
        let bodies = self.bodies.iter().flat_map(|body| body.anchors.iter().chain([&body.pose.origin]));
        let joints = self.joints.iter().map(|joint| &joint.at);
        [[0.0; 3]].iter().chain(lines).chain(bodies).chain(joints).chain(&self.ground).copied().collect()
    }
}

fn asked(frames: &mut Frames, joint: &Joint) -> Asked {
    let parent = frames.push(joint.parent.clone());
    let child = frames.push(joint.child.clone());
    let written = joint.directions.written().into_iter().enumerate();
    let directions = written.map(|(number, way)| {
        let of_child = joint.directions.is_of_child(number);
        (frames.moved(if of_child { &joint.child } else { &joint.parent }, way), of_child)
    });
    Asked { parent, child, directions: directions.collect() }
}

/// Unit vectors of a joint's turns and slides that are written.
fn directions(joint: &Joint, asked: &Asked, poses: &[Pose]) -> (Vec<Point>, Vec<Point>) {
    let ways = asked.directions.iter().map(|&(number, of_child)| {
        let from = if of_child { asked.child } else { asked.parent };
        unit(sub(poses[number].origin, poses[from].origin))
    });
    let ways: Vec<Option<Point>> = ways.collect();
    let way = |number: usize| ways.get(number).copied().flatten();
    let all = |motion: Motion| {
        let freedoms = joint.kind.freedoms.iter().filter(move |freedom| freedom.motion == motion);
        match &joint.directions {
            // The normal of a plane is not written, and its slides are all that is.
            Directions::Plane(_) if motion == Motion::Slides => ways.iter().copied().flatten().collect(),
            Directions::Plane(_) => {
                let normal = way(0).zip(way(1)).and_then(|(a, b)| unit(super::space::cross(a, b)));
                normal.into_iter().collect()
            }
            _ => freedoms.filter_map(|freedom| way(freedom.direction)).collect(),
        }
    };
    (all(Motion::Turns), all(Motion::Slides))
}
