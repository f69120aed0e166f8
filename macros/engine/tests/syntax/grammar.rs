//! What the parser reads: every form of the grammar, and the tree that it becomes.

use multibody_engine::syntax::tree::{Fields, Item, ItemKind, Solution, Value};
use proc_macro2::{Delimiter, Group, Ident, Punct, Spacing, Span, TokenStream, TokenTree};
use quote::{ToTokens, quote};

use crate::{DOUBLE_PENDULUM, OTHERS, STEWART, parse_tokens, valid};

/// Text of tokens without any spaces.
fn text(tokens: impl ToTokens) -> String {
    tokens.to_token_stream().to_string().replace(char::is_whitespace, "")
}

fn list(exprs: &[syn::Expr]) -> String {
    exprs.iter().map(text).collect::<Vec<_>>().join("|")
}

fn fields(fields: &Fields) -> String {
    let broken = if fields.broken { "!" } else { "" };
    let list: Vec<String> = fields.list.iter().map(|field| format!("{}={}", field.name, text(&field.value))).collect();
    format!("{{{}}}{broken}", list.join("|"))
}

fn value(word: &str, value: &Value) -> String {
    let (ty, expr) = (value.ty.as_ref().map(text), value.value.as_ref().map(text));
    format!("{word} {} {} {}", value.name, ty.unwrap_or_default(), expr.unwrap_or_default())
}

/// An item in one line, for comparison.
fn line(item: &Item) -> String {
    let line = match &item.kind {
        ItemKind::Const(v) => value("const", v),
        ItemKind::Param(v) => value("param", v),
        ItemKind::Input(v) => value("input", v),
        ItemKind::Let(v) => value("let", v),
        ItemKind::Function(f) => {
            let parameters: Vec<String> = f.parameters.iter().map(ToString::to_string).collect();
            format!("let {}({}) {}", f.name, parameters.join(","), text(&f.value))
        }
        ItemKind::External(f) => {
            let parameters: Vec<String> = f.parameters.iter().map(ToString::to_string).collect();
            format!("extern {}({}) {}", f.name, parameters.join(","), text(&f.path))
        }
        ItemKind::Output(v) => value("output", v),
        ItemKind::Speed(v) => value("speed", v),
        ItemKind::State { name, rate, start } => {
            format!("state {name} {} {}", text(rate), text(start))
        }
        ItemKind::Port { name, ty, .. } => format!("port {name} {ty}"),
        ItemKind::World(f) => format!("world {}", fields(f)),
        ItemKind::Formulation(f) => format!("formulation {}", fields(f)),
        ItemKind::Body { name, fields: f } => format!("body {name} {}", fields(f)),
        ItemKind::Joint { name, kind, fields: f } => format!("joint {name} {kind} {}", fields(f)),
        ItemKind::Force { name, kind, fields: f } => format!("force {name} {kind} {}", fields(f)),
        ItemKind::Part(p) => {
            let (count, index) = (text(&p.count), text(&p.index));
            format!("part {} {} {count} {index} {}", p.name, p.kind, fields(&p.fields))
        }
        ItemKind::ConstraintValue { name, value } => format!("constraint {name} {}", text(value)),
        ItemKind::ConstraintKind { name, kind, fields: f } => format!("constraint {name} {kind} {}", fields(f)),
        ItemKind::Drive { target, value } => format!("drive {} {}", text(target), text(value)),
        ItemKind::Solve { unknowns, how: Solution::Formulas(formulas) } => {
            format!("solve {} {}", list(unknowns), list(formulas))
        }
        ItemKind::Solve { unknowns, how: Solution::From { closings, branches } } => {
            format!("solve {} from {} {}", list(unknowns), list(closings), list(branches))
        }
        ItemKind::System { unknowns, equations, branches } => {
            format!("system {} {} {}", list(unknowns), list(equations), list(branches))
        }
        ItemKind::Small(coordinates) => format!("small {}", list(coordinates)),
        ItemKind::Settled(state) => format!("settled {}", text(state)),
        ItemKind::Assume(condition) => format!("assume {}", text(condition)),
        ItemKind::Emit(requests) => {
            let options = |f: &Option<Fields>| f.as_ref().map(fields).unwrap_or_default();
            let names: Vec<String> = requests.iter().map(|r| format!("{}{}", r.name, options(&r.options))).collect();
            format!("emit {}", names.join(" "))
        }
    };
    let attrs: Vec<String> = item.attrs.iter().map(|attr| text(attr) + " ").collect();
    (attrs.concat() + &line).trim_end().to_owned()
}

/// The items of the one model in `source`.
fn lines(items: &str) -> Vec<String> {
    let source = valid(&format!("mod m {{ {items} }}"));
    assert!(!source.modules[0].broken);
    source.modules[0].items.iter().map(line).collect()
}

#[test]
fn double_pendulum() {
    let source = valid(DOUBLE_PENDULUM);
    assert!(source.krate.is_none());
    let [module] = source.modules.as_slice() else { panic!("one model") };
    assert_eq!(module.name, "double_pendulum");
    assert!(matches!(module.vis, syn::Visibility::Public(_)));
    assert_eq!(module.attrs.len(), 1);
    let lines: Vec<String> = module.items.iter().map(line).collect();
    let expected = "\
        #[doc=r\"[m/s^2]a`const`becomesaliteral\"] const G  9.81
        #[doc=r\"[kg]a`param`staysafieldof`Params`\"] param m1  1.0
        param m2  1.0
        #[doc=r\"[m]rodlengths\"] param l1  1.0
        param l2  1.0
        world {gravity=-G*Y}
        body upper {mass=m1|com=-0.5*l1*Y|inertia=rod(m1,l1,Y)}
        body lower {mass=m2|com=-0.5*l2*Y|inertia=rod(m2,l2,Y)}
        joint shoulder Revolute {parent=ground|child=upper|axis=Z}
        joint elbow Revolute {parent=upper.at(-l1*Y)|child=lower|axis=Z}
        force friction Effort {joint=elbow|value=-0.01*elbow.rate}
        #[doc=r\"[m]tipintheworldframe\"] output tip Vec3 lower.at(-l2*Y).position
        output energy  kinetic()+potential()
        emit forward_dynamics inverse_dynamics mass_matrix bias";
    let expected: Vec<&str> = expected.lines().map(str::trim).collect();
    let plain: Vec<String> = lines.iter().map(|line| line.replace("doc=\"", "doc=r\"")).collect();
    assert_eq!(plain, expected);
}

#[test]
fn functions_of_rust() {
    let expected = ["extern f(x,y) crate::a::B", "extern g(x) ::c::D<3>", "extern h(x) $crate::E"];
    assert_eq!(lines("extern f(x, y) = crate::a::B; extern g(x,) = ::c::D<3>; extern h(x) = $crate::E;"), expected);
}

#[test]
fn stewart() {
    let source = valid(STEWART);
    let [leg, stewart] = source.modules.as_slice() else { panic!("a part and a model") };
    assert!(matches!(leg.vis, syn::Visibility::Inherited));
    let lines: Vec<String> = leg.items.iter().chain(&stewart.items).map(line).collect();
    for expected in [
        "port base Frame",
        "#[cut] joint ball Ball {parent=piston|child=tip}",
        "joint gimbal Universal {parent=base|child=cylinder|axes=[X,Y]}",
        "solve gimbal|stroke from ball stroke>-1.0|cos(gimbal.second)>0.0",
        "const HEADING [Scalar;6] [-0.75]",
        "formulation {constraints=Reduced}",
        "part legs leg 6 i {base=ground.at(FEET[i]).rotated(Z,HEADING[i])|tip=platform.at(PINS[i])}",
        "output pose Pose platform.pose",
        "emit forward_dynamics inverse_dynamics{solve_for=legs.thrust}",
    ] {
        assert!(lines.iter().any(|line| line == expected), "{expected} in {lines:#?}");
    }
    assert_eq!((leg.items.len(), stewart.items.len()), (12, 9));
}

#[test]
fn other_items() {
    let expected = "\
        let reach  base.express(tip.position-base.position)
        state current (u-R*current-K*motor.rate)/L 0.0
        force bushing SpringDamper {between=[a.at(p),b]|stiffness=1e4|damping=20.0|length=0.1}
        force wind Force {at=wing.at(c)|value=[0.0,0.0,-lift]|axes=ground}
        constraint rack gear.angle*0.05-slide.travel
        constraint link Rod {between=[crank.at(p),slider.at(c)]|length=0.8}
        drive crank.angle omega*t
        drive platform.orientation identity()
        solve coupler|follower -crank|crank
        solve coupler|follower from closing sin(coupler)>0.0
        assume pin.position.z>0.0
        formulation {coordinates=Joint|constraints=Reduced|independent=[crank]}
        part left leg   {base=ground|tip=plate|m_piston=0.2}
        emit kinematics{given=platform.pose|find=legs.stroke} residual derivatives energy";
    let expected: Vec<&str> = expected.lines().map(str::trim).collect();
    assert_eq!(lines(OTHERS), expected);
}

#[test]
fn trailing_commas_are_optional() {
    assert_eq!(lines("body b { mass: 1.0, }"), lines("body b { mass: 1.0 }"));
    assert_eq!(lines("emit a, b,;"), lines("emit a, b;"));
    assert_eq!(lines("emit a { x: 1, }, b;"), lines("emit a { x: 1 }, b;"));
    assert_eq!(lines("state x: rate = 1, start: 0,;"), lines("state x: rate = 1, start: 0;"));
    assert_eq!(lines("solve (a, b,) = (c, d,);"), lines("solve (a, b) = (c, d);"));
    assert_eq!(lines("solve (a) from j { a > 0, }"), lines("solve (a) from j { a > 0 }"));
    assert_eq!(lines("let v = [a, b,];"), ["let v  [a,b]"]);
    assert_eq!(lines("let v = f(a, b,);").len(), 1);
}

#[test]
fn optional_things() {
    assert_eq!(
        lines("input u; input v: Vec3; input w: [Scalar; N];"),
        ["input u", "input v Vec3", "input w [Scalar;N]"]
    );
    assert_eq!(lines("let x: Scalar = 1;"), ["let x Scalar 1"]);
    assert_eq!(lines("state x: rate = 1;"), ["state x 1"]);
    assert_eq!(lines("param k: [[Vec3; 2]; 3] = m;"), ["param k [[Vec3;2];3] m"]);
    assert_eq!(lines("emit forward_dynamics;"), ["emit forward_dynamics"]);
    assert_eq!(lines("body b {} world {}"), ["body b {}", "world {}"]);
    assert_eq!(lines("part p: [leg; n + 1] = leg { base: ground };"), ["part p leg n+1  {base=ground}"]);
    assert_eq!(lines("part p: [leg; 2] = |_| leg {};"), ["part p leg 2  {}"]);
    assert_eq!(lines("solve (a) from j {}"), ["solve a from j"]);
    assert_eq!(lines("solve (a, b) from (j, k) { a > 0 }"), ["solve a|b from j|k a>0"]);
    assert_eq!(lines("solve (a) from (j) {}"), ["solve a from j"]);
    assert_eq!(lines(""), [""; 0]);
}

/// Keywords are words like others where no item starts.
#[test]
fn keywords_may_be_names() {
    assert_eq!(lines("param force = 1; let state = force + port;"), ["param force  1", "let state  force+port"]);
    assert_eq!(lines("force drive: Effort { joint: joint, value: solve(a) }").len(), 1);
    assert_eq!(lines("let x = assume; let y = f(x) - world;").len(), 2);
    assert_eq!(lines("param r#type = 1;"), ["param r#type  1"]);
}

#[test]
fn attributes_go_before_everything() {
    let source = valid(
        "#![krate(::mb)] /// D\n #[cfg(feature = \"x\")] pub(crate) mod m { //! inner\n #![allow(x)]\n
        /// doc\n const A = 1; /// doc\n param a = 1; /// doc\n input b; /// doc\n let c = 1; /// doc\n world {}
        /// doc\n formulation {} /// doc\n #[allow(unphysical_inertia)] body d {} /// doc\n #[cut] joint e: Ball {}
        /// doc\n force f: Effort {} /// doc\n constraint g = 1; /// doc\n drive h = 1; /// doc\n solve (i) = (1);
        /// doc\n port j: Frame; /// doc\n part k: leg {}; /// doc\n state l: rate = 1; /// doc\n assume n > 1;
        /// doc\n output o = 1; /** doc */ emit p; }
        mod n {}",
    );
    assert_eq!(source.krate.map(text).as_deref(), Some("::mb"));
    let [m, n] = source.modules.as_slice() else { panic!("two models") };
    let attrs: Vec<String> = m.attrs.iter().map(text).collect();
    assert_eq!(attrs.len(), 4);
    assert_eq!(attrs[1], "#[cfg(feature=\"x\")]");
    assert!(attrs.iter().all(|attr| attr.starts_with("#[")), "inner ones become outer ones: {attrs:?}");
    assert_eq!(text(&m.vis), "pub(crate)");
    assert_eq!(m.items.len(), 18);
    assert!(m.items.iter().all(|item| item.attrs[0].path().is_ident("doc")));
    assert!(n.items.is_empty());
}

#[test]
fn the_crate_may_be_renamed() {
    for path in ["::mb", "::a::b", "crate::a", "crate"] {
        let source = valid(&format!("#![krate({path})] mod m {{}}"));
        assert_eq!(source.krate.map(text).as_deref(), Some(path));
    }
    assert!(valid("mod m {}").krate.is_none());
}

/// A documentation that a macro puts together.
#[test]
fn computed_documentation() {
    let source = valid("#[doc = concat!(\"a\", \"b\")] #[doc = include_str!(\"x\")] mod m {}");
    assert_eq!(source.modules[0].attrs.len(), 2);
}

/// `$name`, `$value`, `$vis` of a `macro_rules!` around the call come in groups without visible brackets.
#[test]
fn fragments_of_other_macros() {
    let hidden = |tokens: TokenStream| TokenTree::Group(Group::new(Delimiter::None, tokens));
    let (vis, none) = (hidden(quote!(pub(crate))), hidden(TokenStream::new()));
    let (name, expr) = (hidden(hidden(quote!(a)).into()), hidden(quote!(1 + x)));
    let ty = hidden(quote!([Vec3; 2]));
    let tokens = quote! { #vis mod m { param #name: #ty = 2 * #expr; } #none mod n { let b = #name.x; } };
    let (source, diagnostics) = parse_tokens(tokens);
    assert!(diagnostics.is_empty(), "{:?}", diagnostics.errors());
    let [m, n] = source.modules.as_slice() else { panic!("two models") };
    assert_eq!(text(&m.vis), "pub(crate)");
    assert_eq!(line(&m.items[0]), "param a [Vec3;2] 2*(1+x)");
    assert_eq!(line(&n.items[0]), "let b  a.x");
}

/// Joint punctuation is read as Rust's lexer reads it, whatever the spacing says about brackets.
#[test]
fn punctuation_from_a_compiler() {
    let mut tokens = quote! { param a };
    tokens
        .extend([TokenTree::Punct(Punct::new('=', Spacing::Joint)), TokenTree::Punct(Punct::new('-', Spacing::Alone))]);
    tokens.extend([TokenTree::Ident(Ident::new("b", Span::call_site()))]);
    tokens.extend([TokenTree::Punct(Punct::new(';', Spacing::Joint))]);
    let (source, diagnostics) = parse_tokens(quote! { mod m { #tokens } });
    assert!(diagnostics.is_empty(), "{:?}", diagnostics.errors());
    assert_eq!(line(&source.modules[0].items[0]), "param a  -b");
}
