//! Stage `robots`, MJCF: classes of defaults, and elements with all that they say.

use super::super::mistake::Mistake;
use super::super::robot::Number;
use super::super::xml::Element;
use crate::diagnostics::nearest;

/// Actuators, whose defaults are one set in every class: what one of them says holds for all.
const ACTUATORS: [&str; 12] = [
    "general",
    "position",
    "velocity",
    "intvelocity",
    "damper",
    "cylinder",
    "muscle",
    "adhesion",
    "dcmotor",
    "pid",
    "orientation",
    "plugin",
];

/// The class of what names none.
const MAIN: &str = "main";

struct Class<'a, 'input> {
    name: &'a str,
    parent: Option<usize>,
    elements: Vec<Element<'a, 'input>>,
}

pub(super) struct Classes<'a, 'input> {
    list: Vec<Class<'a, 'input>>,
}

impl<'a, 'input> Classes<'a, 'input> {
    pub(super) fn none() -> Self {
        Classes { list: vec![Class { name: MAIN, parent: None, elements: Vec::new() }] }
    }

    /// Takes in a `<default>`, and those within it.
    pub(super) fn enter(&mut self, element: Element<'a, 'input>, parent: Option<usize>) -> Result<(), Mistake> {
        element.only(&["class"])?;
        let name = match (element.attribute("class"), parent) {
            (Some(name), _) => name,
            (None, None) => MAIN,
            (None, Some(_)) => return Err(element.mistake("`<default>` within another one has no `class`")),
        };
        let number = match parent {
            // The outermost has the name it is given, or `main`.
            None => {
                self.list[0].name = name;
                0
            }
            Some(_) if self.list.iter().any(|class| class.name == name) => {
                return Err(element.mistake(format!("two classes are called `{name}`")));
            }
            Some(_) => {
                self.list.push(Class { name, parent, elements: Vec::new() });
                self.list.len() - 1
            }
        };
        for child in element.children() {
            match child.name() {
                "default" => self.enter(child, Some(number))?,
                "equality" if child.attribute("active").is_some_and(|text| text != "true") => {
                    return Err(child.mistake("`active` of `<equality>` in `<default>` is not supported"));
                }
                name if ACTUATORS.contains(&name) && child.attribute("gear").is_some() => {
                    let mistake = child.mistake(format!("`gear` of `<{name}>` in `<default>` is not supported"));
                    return Err(mistake.help("it would be that of motors too: give it to `<motor>`"));
                }
                _ => self.list[number].elements.push(child),
            }
        }
        Ok(())
    }

    /// The element with the defaults of its own class, or of the body's.
    pub(super) fn of(&self, element: Element<'a, 'input>, class: Option<&str>) -> Result<Said<'a, 'input>, Mistake> {
        let mut holders = vec![element];
        let mut next = match element.attribute("class").or(class) {
            Some(name) => Some(self.find(element, name)?),
            None => Some(0),
        };
        while let Some(number) = next {
            let class = &self.list[number];
            holders.extend(class.elements.iter().rev().filter(|other| other.name() == element.name()));
            next = class.parent;
        }
        Ok(Said { element, holders })
    }

    pub(super) fn find(&self, element: Element, name: &str) -> Result<usize, Mistake> {
        self.list.iter().position(|class| class.name == name).ok_or_else(|| {
            let mistake = element.mistake(format!("there is no class `{name}`"));
            match nearest(name, self.list.iter().map(|class| class.name)) {
                Some(near) => mistake.help(format!("did you mean `{near}`?")),
                None => mistake,
            }
        })
    }
}

/// An element, then those that hold its defaults, nearest first.
pub(super) struct Said<'a, 'input> {
    pub(super) element: Element<'a, 'input>,
    holders: Vec<Element<'a, 'input>>,
}

impl<'a, 'input> Said<'a, 'input> {
    /// What says this attribute.
    pub(super) fn holder(&self, name: &str) -> Option<Element<'a, 'input>> {
        self.holders.iter().find(|holder| holder.attribute(name).is_some()).copied()
    }

    pub(super) fn text(&self, name: &str) -> Option<&'a str> {
        self.holder(name).and_then(|holder| holder.attribute(name))
    }

    pub(super) fn numbers<const N: usize>(&self, name: &str) -> Result<Option<[Number; N]>, Mistake> {
        self.holder(name).map_or(Ok(None), |holder| holder.numbers(name))
    }

    pub(super) fn number(&self, name: &str) -> Result<Option<Number>, Mistake> {
        self.holder(name).map_or(Ok(None), |holder| holder.number(name))
    }

    /// As many as there are.
    pub(super) fn list(&self, name: &str) -> Result<Vec<f64>, Mistake> {
        let list = self.holder(name).map_or(Ok(Vec::new()), |holder| holder.list(name))?;
        Ok(list.iter().map(|number| number.value).collect())
    }

    /// Refuses what is neither mechanics that are read nor known to have none, of the element and of its defaults.
    pub(super) fn only(&self, read: &[&str], over: &[&str]) -> Result<(), Mistake> {
        self.holders.iter().try_for_each(|holder| known(*holder, read, over))
    }

    /// Refuses mechanics that the language has not, unless they are nothing.
    pub(super) fn zero(&self, name: &str, why: &str) -> Result<(), Mistake> {
        match self.holder(name) {
            Some(holder) if holder.list(name)?.iter().any(|number| number.value != 0.0) => {
                Err(holder.mistake(format!("`{name}` of `<{}>` is not supported: {why}", holder.name())))
            }
            _ => Ok(()),
        }
    }
}

pub(super) fn known(element: Element, read: &[&str], over: &[&str]) -> Result<(), Mistake> {
    let is_known = |name: &str| read.contains(&name) || over.contains(&name);
    let Some(other) = element.node.attributes().find(|attribute| !is_known(attribute.name())) else { return Ok(()) };
    let mistake = element.mistake(format!("`{}` of `<{}>` is not supported", other.name(), element.name()));
    Err(match nearest(other.name(), read.iter().chain(over).copied()) {
        Some(near) => mistake.help(format!("did you mean `{near}`?")),
        None => mistake,
    })
}
