//! The module as a whole: what is in it, its documentation, its names, and that it comes out the same every time.

use crate::parsed;
use crate::samples::*;
use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::mechanics::loops::structure::Structure;
use multibody_engine::model::types::{Model, Type};
use multibody_engine::optimize::program::Compiled;
use proc_macro2::{TokenStream, TokenTree};
use syn::{Attribute, ImplItem, Item, Visibility};

fn samples() -> [(Model, Compiled); 4] {
    [pendulum(), zoo(), nothing(), long(300)]
}

#[test]
fn the_same_model_gives_the_same_code() {
    for ((model, compiled), (again, compiled_again)) in samples().into_iter().zip(samples()) {
        let first = emit(&model, &compiled).to_string();
        assert_eq!(first, emit(&model, &compiled).to_string());
        assert_eq!(first, emit(&again, &compiled_again).to_string());
        assert_eq!(report(&model, &compiled), report(&again, &compiled_again));
    }
}

fn report(model: &Model, compiled: &Compiled) -> String {
    multibody_engine::emit::report(model, &Structure::open(model), compiled)
}

fn documented(attrs: &[Attribute]) -> bool {
    attrs.iter().any(|attr| attr.path().is_ident("doc"))
}

fn is_public(vis: &Visibility) -> bool {
    matches!(vis, Visibility::Public(_))
}

fn check_documented(items: &[Item]) {
    for item in items {
        let (attrs, name) = match item {
            Item::Struct(item) => {
                for field in &item.fields {
                    assert!(!is_public(&field.vis) || documented(&field.attrs), "{}", item.ident);
                }
                (&item.attrs, item.ident.to_string())
            }
            Item::Const(item) => (&item.attrs, item.ident.to_string()),
            Item::Type(item) => (&item.attrs, item.ident.to_string()),
            Item::Mod(item) => {
                check_documented(&item.content.as_ref().unwrap().1);
                (&item.attrs, item.ident.to_string())
            }
            Item::Impl(item) => {
                for method in &item.items {
                    if let ImplItem::Fn(method) = method {
                        let name = method.sig.ident.to_string();
                        assert!(!is_public(&method.vis) || documented(&method.attrs), "{name}");
                        assert!(method.sig.inputs.len() <= 6, "{name}");
                    }
                }
                continue;
            }
            Item::Use(item) => {
                assert!(!is_public(&item.vis));
                continue;
            }
            _ => panic!("what is this?"),
        };
        assert!(documented(attrs), "{name}");
    }
}

#[test]
fn everything_public_is_documented() {
    for (model, compiled) in samples() {
        check_documented(&[Item::Mod(parsed::module(&model, &compiled))]);
    }
}

fn each_word(tokens: TokenStream, visit: &mut dyn FnMut(&str)) {
    for token in tokens {
        match token {
            TokenTree::Group(group) => each_word(group.stream(), visit),
            TokenTree::Ident(ident) => visit(&ident.to_string()),
            _ => {}
        }
    }
}

#[test]
fn no_words_that_users_forbid() {
    for (model, compiled) in samples() {
        each_word(emit(&model, &compiled), &mut |word| {
            let forbidden = ["allow", "unsafe", "std", "unwrap", "expect", "panic", "for_each", "loop", "while"];
            assert!(!forbidden.contains(&word), "{word}");
        });
    }
}

#[test]
fn parts_have_modules_with_those_structs_that_have_fields() {
    let (model, compiled) = zoo();
    let module = parsed::module(&model, &compiled);
    let items = &module.content.as_ref().unwrap().1;
    let structs = |name: &str| -> Vec<String> {
        let mut modules = items.iter().filter_map(|item| match item {
            Item::Mod(part) if part.ident == name => part.content.as_ref(),
            _ => None,
        });
        let (_, items) = modules.next().expect("a module");
        let names = items.iter().filter_map(|item| match item {
            Item::Struct(item) => Some(item.ident.to_string()),
            _ => None,
        });
        names.collect()
    };
    let all = ["Params", "Position", "Velocity", "States", "Input", "Output"];
    assert_eq!(structs("leg"), all);
    assert_eq!(structs("foot"), ["Params", "Position", "Velocity"]);
}

/// Fields stand in the order of the coordinates, as vectors have them.
#[test]
fn fields_are_in_the_order_of_coordinates() {
    let (model, compiled) = zoo();
    let module = parsed::module(&model, &compiled);
    let position = module.content.as_ref().unwrap().1.iter().find_map(|item| match item {
        Item::Struct(item) if item.ident == "Position" => Some(item),
        _ => None,
    });
    let fields: Vec<String> = position.unwrap().fields.iter().map(|f| f.ident.as_ref().unwrap().to_string()).collect();
    assert_eq!(fields, ["legs", "base", "float", "neck", "slide", "rod", "pin", "thread", "type_"]);
}

#[test]
fn arguments_are_as_few_as_can_be() {
    let (model, compiled) = pendulum();
    let module = parsed::module(&model, &compiled);
    let signature = |name: &str| parsed::text(&parsed::method(&module, name).sig.inputs);
    assert_eq!(signature("new"), "params:&Params<T>");
    assert_eq!(signature("mass_matrix"), "&self,_q:&Position<T>");
    assert_eq!(signature("kinetic_energy"), "&self,state:&State<T>");
    assert_eq!(signature("potential_energy"), "&self,q:&Position<T>");
    assert_eq!(signature("bias"), "&self,_t:T,state:&State<T>,_input:&()");
    assert_eq!(signature("inverse_dynamics"), "&self,_t:T,state:&State<T>,_input:&(),accel:&Velocity<T>");
}

/// Names of programs that mean something else in the function, or are no names at all.
#[test]
fn locals_never_hide_anything() {
    let names = ["q", "state", "self", "type", "1st", "q", "a b", ""];
    let statements =
        (0..names.len()).map(|i| set(i, if i == 0 { q(0, 0) } else { sum(&[local(i - 1), q(0, 0)]) })).collect();
    let results = vec![mul(&[local(names.len() - 1), lit(2.0)])];
    let method = parsed::scalar_function(program(&names, statements, results));
    let text = parsed::text(&method.block);
    let expected = "{letq=&state.q;letq_2=q.hinge;letstate_2=q_2+q.hinge;letself_=state_2+q.hinge;\
        lettype_=self_+q.hinge;letn_1st=type_+q.hinge;letq_3=n_1st+q.hinge;leta_b=q_3+q.hinge;\
        letn_=a_b+q.hinge;n_*T::lit(2.0)}";
    assert_eq!(text, expected.replace("leta_b=", "letn_a_b=").replace("=a_b+", "=n_a_b+"));
}

#[test]
fn symbols_are_paths() {
    let (model, mut compiled) = zoo();
    let symbols = [q(2, 3), q(0, 1), q(7, 4), v(7, 4), u(1, 0), u(2, 2), x(1), time()];
    compiled.functions = vec![derived(FunctionKind::PotentialEnergy, program(&[], vec![], vec![sum(&symbols)]))];
    let method = parsed::method(&parsed::module(&model, &compiled), "potential_energy");
    assert_eq!(
        parsed::text(&method.block),
        "{letq=&state.q;letv=&state.v;letx=&state.x;q.legs[0].foot.sole.k+q.legs[0].gimbal.second\
         +q.base.orientation.i+v.base.angular.y+input.legs[1].thrust+input.wind.z+x.legs[1].current+t}"
    );
    assert_eq!(parsed::text(&method.sig.inputs), "&self,t:T,state:&State<T>,input:&Input<T>");
}

#[test]
fn matrices_are_written_by_columns() {
    let (mut model, mut compiled) = pendulum();
    add_joint(&mut model, place(0, "elbow"), revolute());
    add_output(&mut model, place(0, "turn"), Type::Rotation, docs("", ""));
    let numbers = |count: usize| (1..=count).map(|i| lit(i as f64)).collect::<Vec<_>>();
    compiled.functions = vec![
        derived(FunctionKind::MassMatrix, program(&[], vec![], numbers(4))),
        derived(FunctionKind::Outputs, program(&[], vec![], numbers(10))),
    ];
    let module = parsed::module(&model, &compiled);
    let strip = |text: String| text.replace("T::lit", "").replace(".0", "");
    let text = strip(parsed::text(&parsed::method(&module, "mass_matrix").block));
    assert!(text.contains("SMatrix::from([[(1),(3)],[(2),(4)]])"), "{text}");
    let text = strip(parsed::text(&parsed::method(&module, "outputs").block));
    assert!(text.contains("[[(2),(5),(8)],[(3),(6),(9)],[(4),(7),(10)]]"), "{text}");
}

#[test]
fn the_report_says_it_all() {
    let (model, compiled) = zoo();
    let text = report(&model, &compiled);
    for line in [
        "# `zoo`",
        "A model made by hand.",
        "| `legs[0].m` | `kg` | `0.1` |  |",
        "| `legs[1].m` | `kg` | `1.1` |  |",
        "| `legs[_].foot.R` | `m` | `0.2` | radius \\| of the foot |",
        "| `legs[_].thrust` | `N` | scalar | pushes |",
        "| `base` | free | `body_of_mount` | `body_of_base` | 6 |  |",
        "| `forward_dynamics` | articulated body | 1 mul, 1 sincos | 7 add, 9 mul, 1 div, 1 sincos |",
        "- no gravity",
        "- orientation by quaternions: `legs[_].foot.sole`, `base`",
    ] {
        assert!(text.lines().any(|found| found == line), "{line}\nis not in\n{text}");
    }
}
