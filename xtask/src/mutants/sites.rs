//! Places of a source file where one operator can be another, and the source with both in it.

use proc_macro2::Span;
use quote::ToTokens;
use std::fmt::Write as _;
use std::ops::Range;
use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{BinOp, Expr, Lit, UnOp};

/// One place and what would stand there.
#[derive(Debug)]
pub(super) struct Site {
    /// Bytes of the expression in the file.
    pub(super) range: Range<usize>,
    pub(super) line: usize,
    /// What changes, for a reader.
    pub(super) change: String,
    /// The whole expression with the change, on one line.
    mutated: String,
}

/// All sites of a source, those outside before those within them.
pub(super) fn find(source: &str) -> syn::Result<Vec<Site>> {
    let mut finder = Finder { sites: Vec::new() };
    finder.visit_file(&syn::parse_file(source)?);
    finder.sites.sort_by_key(|site| (site.range.start, std::cmp::Reverse(site.range.end)));
    Ok(finder.sites)
}

/// The source with a switch at each numbered site, and where in it the mutated text of each stands. Lines stay lines. The
/// original branch holds further sites, the mutated one none: only one mutant runs at a time.
pub(super) fn rewrite(source: &str, sites: &[(u32, &Site)]) -> (String, Vec<(u32, Range<usize>)>) {
    let mut writer = Writer { source, text: String::new(), ranges: Vec::new() };
    writer.write(0..source.len(), sites);
    (writer.text, writer.ranges)
}

struct Writer<'a> {
    source: &'a str,
    text: String,
    ranges: Vec<(u32, Range<usize>)>,
}

impl Writer<'_> {
    fn write(&mut self, range: Range<usize>, mut sites: &[(u32, &Site)]) {
        let mut from = range.start;
        while let Some(((number, site), rest)) = sites.split_first() {
            let within = rest.partition_point(|(_, other)| other.range.start < site.range.end);
            self.text.push_str(&self.source[from..site.range.start]);
            let start = self.text.len();
            let _ = write!(self.text, "(if crate::mutant::is({number}) {{ {} }}", site.mutated);
            self.ranges.push((*number, start..self.text.len()));
            self.text.push_str(" else { ");
            self.write(site.range.clone(), &rest[..within]);
            self.text.push_str(" })");
            from = site.range.end;
            sites = &rest[within..];
        }
        self.text.push_str(&self.source[from..range.end]);
    }
}

struct Finder {
    sites: Vec<Site>,
}

impl Finder {
    fn add(&mut self, span: Span, change: impl Into<String>, mutated: impl ToTokens) {
        let mutated = mutated.to_token_stream().to_string();
        // A line break in a literal would move all lines below it.
        if !mutated.contains('\n') {
            self.sites.push(Site { range: span.byte_range(), line: span.start().line, change: change.into(), mutated });
        }
    }

    fn unary(&mut self, expr: &syn::ExprUnary) {
        let sign = match expr.op {
            UnOp::Neg(_) => "-",
            UnOp::Not(_) => "!",
            _ => return,
        };
        self.add(expr.span(), format!("{sign} removed"), &expr.expr);
    }

    fn binary(&mut self, expr: &syn::ExprBinary) {
        if holds_let(&expr.left) || holds_let(&expr.right) {
            return;
        }
        let Some(op) = other(&expr.op) else { return };
        let change = format!("{} -> {}", expr.op.to_token_stream(), op.to_token_stream());
        self.add(expr.span(), change, syn::ExprBinary { op, ..expr.clone() });
    }

    /// Mathematics on the graph is calls.
    fn method(&mut self, call: &syn::ExprMethodCall) {
        let name = call.method.to_string();
        let mut mutated = call.clone();
        if name == "cross" && call.args.len() == 2 {
            let (a, b) = (call.args[0].clone(), call.args[1].clone());
            mutated.args = [b, a].into_iter().collect();
            return self.add(call.span(), "cross: operands exchanged", mutated);
        }
        let pair = METHODS.iter().find_map(|&(a, b)| if name == a { Some(b) } else { (name == b).then_some(a) });
        let Some(pair) = pair else { return };
        mutated.method = syn::Ident::new(pair, call.method.span());
        self.add(call.span(), format!("{name} -> {pair}"), mutated);
    }
}

/// Methods that take each other's arguments; where they don't, rustc says so and the mutant is left out.
const METHODS: [(&str, &str); 9] = [
    ("add", "sub"),
    ("add_vectors", "sub_vectors"),
    ("mul", "div"),
    ("sin", "cos"),
    ("min", "max"),
    ("any", "all"),
    ("is_some", "is_none"),
    ("first", "last"),
    ("floor", "ceil"),
];

fn other(op: &BinOp) -> Option<BinOp> {
    Some(match op {
        BinOp::Add(_) => syn::parse_quote!(-),
        BinOp::Sub(_) => syn::parse_quote!(+),
        BinOp::Mul(_) => syn::parse_quote!(/),
        BinOp::Div(_) => syn::parse_quote!(*),
        BinOp::Lt(_) => syn::parse_quote!(<=),
        BinOp::Le(_) => syn::parse_quote!(<),
        BinOp::Gt(_) => syn::parse_quote!(>=),
        BinOp::Ge(_) => syn::parse_quote!(>),
        BinOp::Eq(_) => syn::parse_quote!(!=),
        BinOp::Ne(_) => syn::parse_quote!(==),
        BinOp::And(_) => syn::parse_quote!(||),
        BinOp::Or(_) => syn::parse_quote!(&&),
        BinOp::AddAssign(_) => syn::parse_quote!(-=),
        BinOp::SubAssign(_) => syn::parse_quote!(+=),
        BinOp::MulAssign(_) => syn::parse_quote!(/=),
        BinOp::DivAssign(_) => syn::parse_quote!(*=),
        _ => return None,
    })
}

/// A chain of conditions with a pattern in it cannot become an `if` of its own.
fn holds_let(expr: &Expr) -> bool {
    match expr {
        Expr::Let(_) => true,
        Expr::Binary(binary) => holds_let(&binary.left) || holds_let(&binary.right),
        _ => false,
    }
}

fn is_test(attributes: &[syn::Attribute]) -> bool {
    let test = |attribute: &syn::Attribute| {
        attribute.path().is_ident("cfg") && attribute.to_token_stream().to_string().contains("test")
    };
    attributes.iter().any(test)
}

impl<'ast> Visit<'ast> for Finder {
    fn visit_expr(&mut self, expr: &'ast Expr) {
        match expr {
            Expr::Binary(binary) => self.binary(binary),
            Expr::Unary(unary) => self.unary(unary),
            Expr::MethodCall(call) => self.method(call),
            Expr::Lit(literal) => {
                if let Lit::Bool(value) = &literal.lit {
                    let mutated = syn::LitBool::new(!value.value, value.span);
                    self.add(value.span, format!("{} -> {}", value.value, mutated.value), mutated);
                }
            }
            Expr::Repeat(repeat) => return self.visit_expr(&repeat.expr), // the length is constant
            Expr::Const(_) => return,
            _ => {}
        }
        visit::visit_expr(self, expr);
    }

    fn visit_item_fn(&mut self, item: &'ast syn::ItemFn) {
        if item.sig.constness.is_none() && !is_test(&item.attrs) {
            visit::visit_item_fn(self, item);
        }
    }

    fn visit_impl_item_fn(&mut self, item: &'ast syn::ImplItemFn) {
        if item.sig.constness.is_none() && !is_test(&item.attrs) {
            visit::visit_impl_item_fn(self, item);
        }
    }

    fn visit_item_mod(&mut self, item: &'ast syn::ItemMod) {
        if !is_test(&item.attrs) {
            visit::visit_item_mod(self, item);
        }
    }

    // What the compiler evaluates, and what isn't an expression.
    fn visit_item_const(&mut self, _: &'ast syn::ItemConst) {}
    fn visit_item_static(&mut self, _: &'ast syn::ItemStatic) {}
    fn visit_impl_item_const(&mut self, _: &'ast syn::ImplItemConst) {}
    fn visit_trait_item_const(&mut self, _: &'ast syn::TraitItemConst) {}
    fn visit_item_enum(&mut self, _: &'ast syn::ItemEnum) {}
    fn visit_type(&mut self, _: &'ast syn::Type) {}
    fn visit_generic_argument(&mut self, _: &'ast syn::GenericArgument) {}
    fn visit_pat(&mut self, _: &'ast syn::Pat) {}
    fn visit_attribute(&mut self, _: &'ast syn::Attribute) {}
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mutate(source: &str) -> (Vec<String>, String) {
        let sites = find(source).expect("the source parses");
        let numbered: Vec<(u32, &Site)> = (0..).zip(&sites).collect();
        let (text, ranges) = rewrite(source, &numbered);
        for (number, range) in ranges {
            assert!(text[range].starts_with(&format!("(if crate::mutant::is({number}) {{")));
        }
        (sites.iter().map(|site| format!("{}: {}", site.line, site.change)).collect(), text)
    }

    #[test]
    fn sites_stand_within_sites() {
        let (changes, text) = mutate("fn f(a: f64) -> bool {\n    -a + 1.0\n        < 2.0\n}\n");
        assert_eq!(changes, ["2: < -> <=", "2: + -> -", "2: - removed"]);
        let expected = "fn f(a: f64) -> bool {\n    (if crate::mutant::is(0) { - a + 1.0 <= 2.0 } else { \
                        (if crate::mutant::is(1) { - a - 1.0 } else { \
                        (if crate::mutant::is(2) { a } else { -a }) + 1.0 })\n        < 2.0 })\n}\n";
        assert_eq!(text, expected);
    }

    #[test]
    fn calls_and_literals() {
        let (changes, _) = mutate("fn f() { g.add(a, b); g.cross(v, w); if v.iter().all(|x| true) {} c += 1; }");
        let expected = ["add -> sub", "cross: operands exchanged", "all -> any", "true -> false", "+= -> -="]
            .map(|c| format!("1: {c}"));
        assert_eq!(changes, expected);
    }

    #[test]
    fn what_is_left_alone() {
        let source = "const A: f64 = 1.0 + 2.0;\nconst fn f() -> bool { true }\n#[cfg(test)]\nmod tests { fn g() -> bool { 1 < 2 } }\n\
                      fn h(x: [f64; 1 + 1]) { if let -1 = y && z {} assert!(1 < 2); let p = [0; 1 + 2]; }\n";
        assert_eq!(mutate(source), (vec![], source.to_string()));
    }
}
