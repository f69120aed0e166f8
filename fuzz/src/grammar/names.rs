//! What has been declared so far, for expressions to speak of.

use std::rc::Rc;

use crate::random::Random;

/// What a name stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// `const`
    Const,
    /// `param`
    Param,
    /// `input`
    Input,
    /// `state`
    State,
    /// A `let` of positions at most.
    LetPosition,
    /// A `let` of what forces may depend on.
    LetForce,
}

/// Declared names, of a module and of its parts.
#[derive(Clone, Debug, Default)]
pub struct Names {
    /// Scalars, elements of arrays included.
    pub scalars: Vec<(Shape, String)>,
    /// Vectors.
    pub vectors: Vec<(Shape, String)>,
    /// Frames: bodies, ports, steps on them.
    pub frames: Vec<String>,
    /// Bodies alone.
    pub bodies: Vec<String>,
    /// Scalar coordinates that have rates and efforts.
    pub coordinates: Vec<String>,
    /// Joints of any kind.
    pub joints: Vec<String>,
    /// Forces.
    pub forces: Vec<String>,
    /// Coordinates that should be in the state.
    pub variables: Vec<String>,
    /// Coordinates that should have a formula.
    pub closed: Vec<String>,
    /// Equations that should keep a multiplier.
    pub rows: Vec<String>,
    /// Another model, which can be asked.
    pub aid: Option<Rc<Aid>>,
}

/// A model that stands above.
#[derive(Debug)]
pub struct Aid {
    /// Of the module.
    pub name: String,
    /// What is known inside.
    pub names: Names,
    /// All that must be given.
    pub given: Vec<String>,
}

fn any(random: &mut Random, list: &[String]) -> Option<String> {
    if list.is_empty() { None } else { Some(random.pick(list).clone()) }
}

fn of(random: &mut Random, list: &[(Shape, String)], shape: Shape) -> Option<String> {
    let found: Vec<&String> = list.iter().filter(|(s, _)| *s == shape).map(|(_, name)| name).collect();
    if found.is_empty() { None } else { Some((*random.pick(&found)).clone()) }
}

impl Names {
    /// Some scalar of a kind.
    pub fn scalar(&self, random: &mut Random, shape: Shape) -> Option<String> {
        of(random, &self.scalars, shape)
    }

    /// Some vector of a kind.
    pub fn vector(&self, random: &mut Random, shape: Shape) -> Option<String> {
        of(random, &self.vectors, shape)
    }

    /// Some frame, perhaps a step further.
    pub fn frame(&self, random: &mut Random) -> Option<String> {
        let frame = any(random, &self.frames)?;
        Some(match random.below(5) {
            0 => format!("{frame}.at([0.1, -0.2, 0.3])"),
            1 => format!("{frame}.rotated([1, 1, 0], deg(40)).at(0.5 * Z)"),
            _ => frame,
        })
    }

    /// Some coordinate.
    pub fn coordinate(&self, random: &mut Random) -> Option<String> {
        any(random, &self.coordinates)
    }

    /// Some coordinate of the state.
    pub fn variable(&self, random: &mut Random) -> Option<String> {
        any(random, &self.variables)
    }

    /// Some coordinate that follows from others.
    pub fn closed(&self, random: &mut Random) -> Option<String> {
        any(random, &self.closed)
    }

    /// Some equation of a loop.
    pub fn row(&self, random: &mut Random) -> Option<String> {
        any(random, &self.rows)
    }

    /// Some joint.
    pub fn joint(&self, random: &mut Random) -> Option<String> {
        any(random, &self.joints)
    }

    /// Some force.
    pub fn force(&self, random: &mut Random) -> Option<String> {
        any(random, &self.forces)
    }

    /// The names as they are seen from outside of a part.
    pub fn within(&self, part: &str) -> Names {
        let inside = |list: &[String]| -> Vec<String> { list.iter().map(|name| format!("{part}.{name}")).collect() };
        let local = |s: Shape| matches!(s, Shape::State | Shape::Input);
        Names {
            scalars: self.scalars.iter().filter(|s| local(s.0)).map(|(s, n)| (*s, format!("{part}.{n}"))).collect(),
            vectors: Vec::new(),
            frames: inside(&self.bodies),
            bodies: inside(&self.bodies),
            coordinates: inside(&self.coordinates),
            joints: inside(&self.joints),
            forces: inside(&self.forces),
            variables: inside(&self.variables),
            ..Names::default()
        }
    }

    /// Both.
    pub fn join(&mut self, other: Names) {
        self.scalars.extend(other.scalars);
        self.vectors.extend(other.vectors);
        self.frames.extend(other.frames);
        self.bodies.extend(other.bodies);
        self.coordinates.extend(other.coordinates);
        self.joints.extend(other.joints);
        self.forces.extend(other.forces);
        self.variables.extend(other.variables);
    }
}
