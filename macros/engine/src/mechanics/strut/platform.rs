//! Stage `mechanics`: bodies on struts, found in a model.
//!
//! In: a derivation whose dependent coordinates are all those of struts (see [`super::detect`]) that end in balls on one
//! floating body. Out: the body as a [`Carrier`], and equations of motion in both directions without an angle of a strut.
//!
//! Nothing else may hang on the mechanism, and nothing act on the struts but efforts along their slides; where anything
//! differs the general way remains.

use std::rc::Rc;

use crate::contracts::results::{Results, Slot};
use crate::dynamics::tree::{Motion, Orientation, Tree};
use crate::mechanics::equations::Equations;
use crate::mechanics::loops::reduction::{Map, Reduction};
use crate::mechanics::loops::structure::{Means, Role};
use crate::mechanics::translate::forces::LoadCase;
use crate::model::joint_kinds::Hold;
use crate::model::types::{Comparison, ExprNode, Joint, LoopClosure, Packs};
use crate::symbolic::graph::{Graph, Scalar, Vector};
use crate::symbolic::inputs::Known;
use crate::symbolic::signs::is_positive;

use super::carrier::{Axes, Carrier};
use super::detect::{Chain, detect};
use super::triple::Triple;
use super::{apart, forward, inverse, motion};

/// A body that stands on struts and on nothing else.
pub(in crate::mechanics) struct Platform {
    pub carrier: Carrier,
    /// The tree with driven coordinates put in.
    tree: Tree,
    link: usize,
    /// By strut: the link that slides, the distance where its coordinate is zero, whether it reaches along its axis.
    slides: Vec<(usize, Scalar, bool)>,
    /// By strut: the declared effort that lengthens it.
    efforts: Vec<Scalar>,
    /// Expressions that the user vouches for not to vanish.
    nonzero: Vec<Scalar>,
}

impl Platform {
    /// Whether the user vouches for anything.
    pub(in crate::mechanics) fn assumed(&self) -> bool {
        !self.nonzero.is_empty()
    }
}

impl Equations<'_> {
    /// The body on struts that the whole model is, if it is one.
    pub(in crate::mechanics) fn platform(&mut self, reduction: &Reduction) -> Option<Platform> {
        let model = self.scene.model;
        let structure = Rc::clone(&self.scene.structure);
        // Motions to first order are no motions of a body on struts, and speeds are not the rates that these are written in.
        if !model.small.is_empty()
            || structure.has_speeds()
            || !structure.rows.is_empty()
            || structure.steps.is_empty()
            || !self.rotors().is_empty()
        {
            return None;
        }
        let mut chains: Vec<(Chain, Triple)> = Vec::with_capacity(structure.steps.len());
        let mut held = None;
        for step in &structure.steps {
            let Means::Solve(item) = step.means else { return None };
            let mut closings = model.solves.get(item)?.closings();
            let (Some(LoopClosure::Cut(ball)), None) = (closings.next(), closings.next()) else { return None };
            // Here each line keeps its sense.
            if !self.decided.branches.is_fixed(item) {
                return None;
            }
            let (chain, link, pin) = self.chain(&model.joints[ball])?;
            if *held.get_or_insert(link) != link {
                return None;
            }
            chains.push((chain, pin));
        }
        let link = held?;
        let mechanism = Rc::clone(&self.scene.mechanism);
        let own: usize = chains.iter().map(|(chain, _)| chain.links.len()).sum();
        if mechanism.tree.links.len() != mechanism.tree.path(None, Some(link)).len() + own {
            return None;
        }
        let efforts = self.strut_efforts(&chains, link)?;
        let mut legs = Vec::with_capacity(chains.len());
        let mut lengthening = Vec::with_capacity(chains.len());
        let mut slides = Vec::with_capacity(chains.len());
        for ((chain, pin), effort) in chains.into_iter().zip(efforts) {
            let positive = self.points_along(&chain, reduction)?;
            slides.push((chain.slide, chain.zero, positive));
            legs.push((chain, pin, positive));
            lengthening.push(if positive { effort } else { -effort });
        }
        // The loops' closed forms hold the same values in other axes; here everything is derived in its own form.
        self.g.forget();
        // Driven coordinates are put in before anything is derived: what is constant must be seen.
        let mut tree = mechanism.tree.clone();
        tree.velocity = self.finish(reduction, &tree.velocity);
        tree.acceleration = self.finish(reduction, &tree.acceleration);
        for at in mechanism.tree.path(None, Some(link)) {
            let q = tree.links[at].q;
            tree.links[at].q = self.finish(reduction, &[q])[0];
            if let Motion::Ball(Orientation::Quaternion(quaternion)) = tree.links[at].motion {
                let quaternion = self.finish(reduction, &quaternion);
                tree.links[at].motion = Motion::Ball(Orientation::Quaternion([0, 1, 2, 3].map(|k| quaternion[k])));
            }
        }
        let mut carrier = Carrier::of(&mut self.g, &tree, link, &legs)?;
        let load = self.loads(LoadCase::Declared).applied[link];
        // It may depend on driven and dependent coordinates.
        let load = [load.force, load.moment].map(|v| self.g.components(v));
        let load = self.finish(reduction, &load.concat());
        carrier.load = ([load[0], load[1], load[2]], [load[3], load[4], load[5]]);
        let nonzero = self.vouched(reduction);
        Some(Platform { carrier, tree, link, slides, efforts: lengthening, nonzero })
    }

    /// The strut that a ball ends, the link of the body there and the ball's place on it.
    fn chain(&mut self, ball: &Joint) -> Option<(Chain, usize, Triple)> {
        if ball.kind.holds != [Hold::Point] {
            return None;
        }
        let mechanism = Rc::clone(&self.scene.mechanism);
        let ends = [self.place(&ball.parent), self.place(&ball.child)];
        let mut found = [(0, 1), (1, 0)].into_iter().filter_map(|(tip, body)| {
            let (tip, body) = (ends[tip], ends[body]);
            let point = self.g.components(tip.offset);
            let chain = detect(&mut self.g, &mechanism.tree, tip.link?, point)?;
            Some((chain, body.link?, self.g.components(body.offset)))
        });
        found.next()
    }

    /// Declared efforts along the slides; nothing if anything else acts than these and a load on the body.
    fn strut_efforts(&mut self, chains: &[(Chain, Triple)], body: usize) -> Option<Vec<Scalar>> {
        let mechanism = Rc::clone(&self.scene.mechanism);
        let loads = self.loads(LoadCase::Declared);
        let free = |k: usize| loads.applied[k].moment == Vector::ZERO && loads.applied[k].force == Vector::ZERO;
        let slides: Vec<usize> = chains.iter().map(|(chain, _)| mechanism.tree.links[chain.slide].freedom).collect();
        let idle = (0..loads.efforts.len()).all(|k| slides.contains(&k) || loads.efforts[k] == Scalar::ZERO);
        let alone = (0..mechanism.tree.links.len()).all(|k| k == body || free(k));
        (idle && alone).then(|| slides.iter().map(|&freedom| loads.efforts[freedom]).collect())
    }

    /// Whether the strut reaches along the positive axis of its slide on the chosen branch; nothing if that changes.
    fn points_along(&mut self, chain: &Chain, reduction: &Reduction) -> Option<bool> {
        let travel = self.scene.mechanism.tree.links.get(chain.slide)?.q;
        let reach = self.g.add(chain.zero, travel);
        let reach = self.finish(reduction, &[reach]);
        let parameters = self.scene.symbols.parameters();
        let adjustable = self.g.depends_on(reach[0], &parameters);
        if adjustable && !is_positive(&self.g, reach[0]) && !is_positive(&self.g, -reach[0]) {
            return None;
        }
        let reaches: Vec<f64> = self.samples(&reach, &reduction.map).into_iter().flatten().collect();
        let first = *reaches.first()?;
        reaches.iter().all(|x| x * first > 0.0).then_some(first > 0.0)
    }

    /// Second derivatives of the state's coordinates from the declared efforts; `at` is the way among
    /// [`forward::ways`].
    pub(in crate::mechanics) fn platform_accelerations(
        &mut self,
        platform: &Platform,
        reduction: &Reduction,
        at: usize,
    ) -> Option<Vec<Scalar>> {
        // A drive may hold all of the rotation, and nothing else.
        let held = self.scene.structure.roles.iter().flatten().any(|role| matches!(role, Role::Driven(_)));
        let path = platform.tree.path(None, Some(platform.link));
        let moves = |at: &usize| self.speeds().contains(&platform.tree.links[*at].freedom);
        let (translations, turns) = path.split_at_checked(3)?;
        if held && (!translations.iter().all(moves) || turns.iter().any(moves)) {
            return None;
        }
        let &(_, way, reference) = forward::ways(&platform.carrier, self.is_packed()).get(at)?;
        let carrier = &self.carrier(platform, way.apart);
        let travels = self.travels(platform, carrier, Axes::Body, &reference);
        let efforts = self.g.substitute(&platform.efforts, &travels);
        let efforts = self.finish(reduction, &efforts);
        let g = &mut self.g;
        let (a, dw) = forward::accelerations(g, carrier, &efforts, (&reference, way), held);
        let found = motion::coordinates(g, &platform.tree, platform.link, &a, &dw)?;
        let mut of_tree = vec![None; self.scene.symbols.freedoms];
        for (freedom, value) in found {
            let flipped = self.scene.mechanism.flipped.get(freedom) == Some(&true);
            *of_tree.get_mut(freedom)? = Some(if flipped { -value } else { value });
        }
        self.speeds().into_iter().map(|freedom| of_tree[freedom]).collect()
    }

    /// What efforts may depend on, the coordinates of the slides and their rates, by the lengths of the struts.
    fn travels(&mut self, platform: &Platform, carrier: &Carrier, axes: Axes, reference: &Triple) -> Map {
        let view = carrier.view(&mut self.g, axes, reference);
        let mut travels = Vec::new();
        for (at, (&(slide, zero, positive), leg)) in platform.slides.iter().zip(&carrier.legs).enumerate() {
            let g = &mut self.g;
            let (d, rate) = (view.line(g, at), view.pin_velocity(g, at));
            let line = leg.strut.moving(g, d, rate);
            let sign = |s: Scalar| if positive { s } else { -s };
            let travel = g.sub(sign(line.length), zero);
            let link = &self.scene.mechanism.tree.links[slide];
            travels
                .extend([(link.q, travel), (self.scene.mechanism.tree.velocity[link.freedom], sign(line.length_rate))]);
        }
        let travels: Vec<(Scalar, Scalar)> =
            travels.into_iter().map(|(s, x)| if s.is_negative() { (-s, -x) } else { (s, x) }).collect();
        self.map(&travels)
    }

    /// The inputs that produce the motion, then the rank of their system; `at` is the way among [`inverse::ways`].
    pub(in crate::mechanics) fn platform_inputs(
        &mut self,
        platform: &Platform,
        reduction: &Reduction,
        at: usize,
    ) -> Option<Results<Scalar>> {
        let model = self.scene.model;
        let inputs: Vec<Scalar> = model
            .solve_for
            .iter()
            .filter_map(|wanted| self.scene.symbols.inputs.get(wanted.input.0)?.get(wanted.element).copied())
            .collect();
        let (force, moment) = &platform.carrier.load;
        let loaded = force.iter().chain(moment).any(|&c| self.g.depends_on(c, &inputs));
        if inputs.len() != platform.efforts.len() || loaded {
            return None;
        }
        let parameters: Vec<_> =
            self.scene.symbols.params.concat().iter().filter_map(|&p| self.g.symbol_id(p)).collect();
        let known = Known {
            parameter: &|id| parameters.contains(&id),
            nonzero: &|g: &Graph, s: Scalar| {
                platform.nonzero.contains(&s.positive()) || g.literal(s).is_some_and(|n| !n.is_zero())
            },
        };
        let &(_, way, reference) = inverse::ways(&platform.carrier, platform.assumed(), self.is_packed()).get(at)?;
        let carrier = self.carrier(platform, way.apart);
        let found = inverse::forces(&mut self.g, &carrier, way, &reference, &known)?;
        let travels = self.travels(platform, &carrier, way.axes, &reference);
        let mut results = vec![None; inputs.len()];
        for (&effort, &force) in platform.efforts.iter().zip(&found.forces) {
            // Each effort is an input of its own, times a number, plus what is given.
            let slopes: Vec<Scalar> = inputs.iter().map(|&u| self.g.derivative(effort, &[(u, Scalar::ONE)])).collect();
            let mut acting = (0..inputs.len()).filter(|&k| slopes[k] != Scalar::ZERO);
            let (at, None) = (acting.next()?, acting.next()) else { return None };
            self.g.literal(slopes[at])?;
            let off = self.map(&[(inputs[at], Scalar::ZERO)]);
            let given = self.g.substitute(&[effort], &off)[0];
            if self.g.depends_on(given, &inputs) {
                return None;
            }
            let given = self.g.substitute(&[given], &travels)[0];
            let given = self.finish(reduction, &[given])[0];
            let rest = self.g.sub(force, given);
            *results.get_mut(at)? = Some(self.g.div(rest, slopes[at]));
        }
        let inputs: Vec<Scalar> = results.into_iter().collect::<Option<_>>()?;
        Some(Results::default().with(Slot::Inputs, inputs).with_scalar(Slot::Rank, found.rank))
    }

    /// Whether the model asks for packs of limbs.
    pub(in crate::mechanics) fn is_packed(&self) -> bool {
        self.scene.model.packs == Packs::Four
    }

    /// The body on its struts, with symbols for the struts' numbers or not.
    fn carrier(&mut self, platform: &Platform, apart: bool) -> Carrier {
        match apart {
            true => apart::apart(&mut self.g, &platform.carrier, &mut self.decided.numbers),
            false => platform.carrier.clone(),
        }
    }

    /// Results in which symbols stand for numbers, with these put in, and apart from them as they came.
    pub(in crate::mechanics) fn with_numbers(&mut self, results: Results<Scalar>) -> Results<Scalar> {
        let numbers = self.map(&self.decided.numbers);
        let list = self.g.substitute(&results.list, &numbers);
        let apart = if list == results.list { Vec::new() } else { results.list };
        Results { list, apart, ..results }
    }

    /// Differences that `assume` items say do not vanish.
    fn vouched(&mut self, reduction: &Reduction) -> Vec<Scalar> {
        let model = self.scene.model;
        let mut list = Vec::new();
        for condition in &model.assumptions {
            if let ExprNode::Compare(Comparison::Less | Comparison::Greater | Comparison::NotEqual, a, b) =
                &*condition.node
            {
                let (a, b) = (self.scalar(a), self.scalar(b));
                let difference = self.g.sub(a, b);
                list.push(self.finish(reduction, &[difference])[0].positive());
            }
        }
        list
    }
}
