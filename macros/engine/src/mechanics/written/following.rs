//! Room `written`: how coordinates that follow move with those of the state.
//!
//! In: definitions of dependent coordinates. Out: [`Following`]: slopes and what is left of accelerations, each with a symbol of its
//! own, and by these the efforts and the mass matrix of the state.

use std::collections::HashMap;
use std::rc::Rc;

use crate::mechanics::equations::Equations;
use crate::mechanics::loops::constraints::coordinate_name;
use crate::mechanics::loops::reduction::{Definition, Map};
use crate::symbolic::fingerprint::Print;
use crate::symbolic::graph::{Graph, Scalar, ScalarNode};
use crate::symbolic::write::formula::Identifier;

use super::Subject;
use super::letters::Letters;

/// How coordinates of the tree move with those of the state: slopes and rests of accelerations as symbols of their own, so that
/// equations are written with their names.
pub(super) struct Following {
    /// Whose rates follow, each behind those that it reads.
    pub(super) definitions: Vec<Definition>,
    pub(super) named: Vec<Named>,
    /// Slopes by the state's velocities, row by row of the tree's coordinates.
    pub(super) map: Vec<Vec<Scalar>>,
    /// Accelerations where those of the state are zero.
    pub(super) still: Map,
}

/// A symbol with what it stands for.
pub(super) struct Named {
    pub(super) subject: Subject,
    pub(super) name: Identifier,
    pub(super) symbol: Scalar,
    pub(super) value: Scalar,
}

impl Following {
    pub(super) fn new(e: &mut Equations<'_>, definitions: Vec<Definition>, letters: &Letters) -> Following {
        let structure = Rc::clone(&e.scene.structure);
        let places = e.speeds();
        let mut map = vec![vec![Scalar::ZERO; places.len()]; e.scene.symbols.places()];
        for (j, &place) in places.iter().enumerate() {
            if let Some(row) = map.get_mut(place) {
                row[j] = Scalar::ONE;
            }
        }
        let speeds = structure.speeds();
        let mut following = Following { definitions: Vec::new(), named: Vec::new(), map, still: Map::new() };
        // All symbols first: a coupling stands before what it is coupled to.
        let mut slopes = Vec::new();
        for (k, definition) in definitions.iter().enumerate() {
            let place = e.freedom(definition.coordinate);
            for j in 0..places.len() {
                following.map[place][j] = e.g.symbol();
                slopes.push((k, j));
            }
        }
        for (k, j) in slopes {
            let definition = &definitions[k];
            let seeds = following.along(e, j);
            let slope = e.g.derivative(definition.rate, &seeds);
            let value = e.put_in_stand_ins(&[slope])[0];
            let model = e.scene.model;
            let index = [definition.coordinate, speeds[j]].map(|c| coordinate_name(model, c)).join(", ");
            let subject = Subject::Follows(definition.coordinate, j);
            following.named.push(Named {
                subject,
                name: letters.entry("S", index),
                symbol: following.map[e.freedom(definition.coordinate)][j],
                value,
            });
        }
        let rest: Vec<(Scalar, Scalar)> = speeds.iter().map(|&c| (e.velocity_symbols(c)[1], Scalar::ZERO)).collect();
        following.still = e.map(&rest);
        let symbols: Vec<Scalar> = definitions.iter().map(|_| e.g.symbol()).collect();
        for (definition, &symbol) in definitions.iter().zip(&symbols) {
            let acceleration = e.coordinate_symbols(definition.coordinate)[2];
            let put_in = e.map(&[(acceleration, symbol)]);
            following.still.extend(put_in);
        }
        for (definition, symbol) in definitions.iter().zip(symbols) {
            let value = e.put_in_stand_ins(&[definition.acceleration])[0];
            let value = e.g.substitute(&[value], &following.still)[0];
            let name = letters.entry("gamma", coordinate_name(e.scene.model, definition.coordinate));
            following.named.push(Named { subject: Subject::Rest(definition.coordinate), name, symbol, value });
        }
        following.settle(e);
        following.definitions = definitions;
        following
    }

    /// How the tree moves with one velocity coordinate.
    pub(super) fn along(&self, e: &Equations<'_>, j: usize) -> Vec<(Scalar, Scalar)> {
        let of_joints = e.scene.symbols.velocities.concat().into_iter();
        let mut seeds: Vec<(Scalar, Scalar)> = of_joints.zip(self.map.iter().map(|row| row[j])).collect();
        let speed = e.scene.structure.speeds()[j];
        seeds.extend(e.model_speed(speed).map(|speed| (speed, Scalar::ONE)));
        seeds
    }

    /// Symbols of what is a number or a name already, or its sine or cosine, go again.
    fn settle(&mut self, e: &mut Equations<'_>) {
        let angles = e.scene.symbols.positions.concat();
        let points: Vec<Scalar> = angles.iter().flat_map(|&angle| [e.g.cos(angle), e.g.sin(angle)]).collect();
        let points: HashMap<Print, Scalar> =
            points.into_iter().flat_map(|x| [x, -x]).map(|x| (e.g.print(x), x)).collect();
        let short = |g: &Graph, value: Scalar| match g.node(value) {
            ScalarNode::Literal(_) | ScalarNode::Symbol(_) => Some(value),
            _ => points.get(&g.print(value)).copied(),
        };
        loop {
            let found = self.named.iter().enumerate().find_map(|(at, named)| Some((at, short(&e.g, named.value)?)));
            let Some((at, value)) = found else { return };
            let Named { symbol, .. } = self.named.remove(at);
            let put_in = e.map(&[(symbol, value)]);
            for named in &mut self.named {
                named.value = e.g.substitute(&[named.value], &put_in)[0];
            }
            for row in &mut self.map {
                *row = e.g.substitute(row, &put_in);
            }
            let entries: Vec<_> = self.still.iter().map(|(&id, &value)| (id, value)).collect();
            for (id, value) in entries {
                let value = e.g.substitute(&[value], &put_in)[0];
                self.still.insert(id, value);
            }
        }
    }

    /// Efforts of the tree on the state.
    pub(super) fn project(&self, e: &mut Equations<'_>, efforts: &[Scalar]) -> Vec<Scalar> {
        let size = e.scene.structure.freedoms();
        let efforts = e.put_in_stand_ins(efforts);
        let columns = (0..size).map(|j| {
            let terms: Vec<Scalar> =
                self.map.iter().zip(&efforts).map(|(row, &effort)| e.g.mul(row[j], effort)).collect();
            e.g.sum(&terms)
        });
        columns.collect()
    }

    /// S^T M S.
    pub(super) fn mass_matrix(&self, e: &mut Equations<'_>) -> Vec<Vec<Scalar>> {
        let entries = e.mass_matrix();
        let entries = e.put_in_stand_ins(&entries);
        let n = self.map.len();
        let size = e.scene.structure.freedoms();
        let columns: Vec<Vec<Scalar>> = (0..size)
            .map(|j| {
                let column = entries.chunks(n.max(1)).map(|row| {
                    let terms: Vec<Scalar> = row.iter().zip(&self.map).map(|(&m, s)| e.g.mul(m, s[j])).collect();
                    e.g.sum(&terms)
                });
                column.collect()
            })
            .collect();
        let mut matrix = vec![vec![Scalar::ZERO; size]; size];
        for (j, column) in columns.iter().enumerate() {
            let projected = self.project(e, column);
            for (i, entry) in projected.into_iter().enumerate() {
                matrix[i][j] = entry;
            }
        }
        matrix
    }
}
