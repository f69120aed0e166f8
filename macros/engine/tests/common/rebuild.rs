//! From the form in which passes rewrite back to a graph.

use multibody_engine::optimize::dag::{Dag, Id, Kind};
use multibody_engine::symbolic::graph::{Graph, Scalar};
use multibody_engine::symbolic::number::Number;

/// The roots of a DAG in a graph with the symbols of the one it was imported from. Nodes are not merged by their prints:
/// each is made of the operands that it has in the DAG.
pub(crate) fn rebuild(from: &Graph, dag: &Dag) -> (Graph, Vec<Scalar>) {
    let mut g = from.empty_copy();
    let mut made = vec![Scalar::ZERO; dag.nodes.len()];
    for id in dag.order() {
        g.forget();
        made[id] = match &dag.nodes[id].kind {
            Kind::One => Scalar::ONE,
            Kind::Symbol(symbol) => g.symbol_handle(*symbol).expect("a symbol of the graph"),
            Kind::Sum(terms) => {
                let terms: Vec<Scalar> = terms.iter().map(|&(c, id)| multiple(&mut g, c, made[id])).collect();
                g.sum(&terms)
            }
            Kind::Product(factors) => {
                let factors = of(&made, factors);
                g.product(&factors)
            }
            Kind::Reciprocal(x) => g.reciprocal(made[*x]),
            Kind::Sqrt(x) => g.sqrt(made[*x]),
            Kind::Sin(angle) => g.sin(made[*angle]),
            Kind::Cos(angle) => g.cos(made[*angle]),
            Kind::Call(call, arguments) => {
                let arguments = of(&made, arguments);
                g.call(*call, &arguments)
            }
            Kind::Stored => unreachable!("passes know no stored values"),
            Kind::Output { block, index } => {
                let block = &dag.blocks[*block];
                let operands = of(&made, &block.operands);
                g.block_outputs(block.kind.clone(), &operands)[*index]
            }
        };
    }
    let roots = dag.roots.iter().map(|&(c, id)| multiple(&mut g, c, made[id])).collect();
    (g, roots)
}

fn of(made: &[Scalar], list: &[Id]) -> Vec<Scalar> {
    list.iter().map(|&id| made[id]).collect()
}

fn multiple(g: &mut Graph, c: Number, x: Scalar) -> Scalar {
    let c = g.number(c);
    g.mul(c, x)
}
