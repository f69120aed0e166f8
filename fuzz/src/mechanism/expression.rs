//! Expressions with a text for the language and a value of their own.

/// A scalar.
#[derive(Clone, Debug)]
pub enum Expr {
    /// As written, and what it is.
    Number(String, f64),
    /// `p0`, ..
    Param(usize),
    /// `u0`, ..
    Input(usize),
    /// `s0`, ..
    State(usize),
    /// `t`
    Time,
    /// A coordinate of a joint.
    Position(usize, usize, &'static str),
    /// Its rate; the name is needed where there are several.
    Rate(usize, usize, Option<&'static str>),
    /// Sum.
    Add(Box<Expr>, Box<Expr>),
    /// Product.
    Mul(Box<Expr>, Box<Expr>),
    /// A function that every point of the line has a value of.
    Call(Function, Box<Expr>),
}

/// Functions of forces.
#[derive(Clone, Copy, Debug)]
pub enum Function {
    /// sin
    Sin,
    /// tanh
    Tanh,
    /// sqrt(1 + x^2)
    Root,
    /// max(x, 0)
    Ramp,
    /// select(x > 0.1, x * x, -x)
    Bent,
}

/// A vector.
#[derive(Clone, Debug)]
pub enum Vector {
    /// As written, and what it is.
    Whole(String, [f64; 3]),
    /// Component by component.
    Parts([Expr; 3]),
}

/// What expressions depend on.
#[derive(Clone, Debug, Default)]
pub struct Point {
    /// s
    pub time: f64,
    /// Values of the parameters.
    pub params: Vec<f64>,
    /// Values of the inputs.
    pub inputs: Vec<f64>,
    /// Values of the states that bodies follow.
    pub states: Vec<f64>,
    /// Joint by joint, component by component.
    pub q: Vec<Vec<f64>>,
    /// Rates.
    pub v: Vec<Vec<f64>>,
    /// Accelerations.
    pub a: Vec<Vec<f64>>,
}

impl Expr {
    /// A literal as Rust prints it.
    pub fn literal(value: f64) -> Expr {
        Expr::Number(format!("{value:?}"), value)
    }

    /// Sum.
    pub fn plus(self, other: Expr) -> Expr {
        Expr::Add(Box::new(self), Box::new(other))
    }

    /// Product.
    pub fn times(self, other: Expr) -> Expr {
        Expr::Mul(Box::new(self), Box::new(other))
    }

    /// The value at a point.
    pub fn value(&self, at: &Point) -> f64 {
        match self {
            Expr::Number(_, x) => *x,
            Expr::Param(k) => at.params[*k],
            Expr::Input(k) => at.inputs[*k],
            Expr::State(k) => at.states[*k],
            Expr::Time => at.time,
            Expr::Position(joint, k, _) => at.q[*joint][*k],
            Expr::Rate(joint, k, _) => at.v[*joint][*k],
            Expr::Add(a, b) => a.value(at) + b.value(at),
            Expr::Mul(a, b) => a.value(at) * b.value(at),
            Expr::Call(function, x) => {
                let x = x.value(at);
                match function {
                    Function::Sin => x.sin(),
                    Function::Tanh => x.tanh(),
                    Function::Root => (1.0 + x * x).sqrt(),
                    Function::Ramp => x.max(0.0),
                    Function::Bent => {
                        if x > 0.1 {
                            x * x
                        } else {
                            -x
                        }
                    }
                }
            }
        }
    }

    /// In the language, ready to stand in any place.
    pub fn text(&self) -> String {
        match self {
            Expr::Number(text, _) => text.clone(),
            Expr::Param(k) => format!("p{k}"),
            Expr::State(k) => format!("s{k}"),
            Expr::Input(k) => format!("u{k}"),
            Expr::Time => "t".into(),
            Expr::Position(joint, _, name) => format!("j{joint}.{name}"),
            Expr::Rate(joint, _, None) => format!("j{joint}.rate"),
            Expr::Rate(joint, _, Some(name)) => format!("j{joint}.{name}.rate"),
            Expr::Add(a, b) => format!("({} + {})", a.text(), b.text()),
            Expr::Mul(a, b) => format!("({} * {})", a.text(), b.text()),
            Expr::Call(function, x) => {
                let x = x.text();
                match function {
                    Function::Sin => format!("sin({x})"),
                    Function::Tanh => format!("tanh({x})"),
                    Function::Root => format!("sqrt(1 + powi({x}, 2))"),
                    Function::Ramp => format!("max({x}, 0)"),
                    Function::Bent => format!("select({x} > 0.1, {x} * {x}, -{x})"),
                }
            }
        }
    }

    /// Calls `f` with every expression inside, itself included.
    pub fn visit(&mut self, f: &mut dyn FnMut(&mut Expr)) {
        match self {
            Expr::Add(a, b) | Expr::Mul(a, b) => {
                a.visit(f);
                b.visit(f);
            }
            Expr::Call(_, x) => x.visit(f),
            _ => {}
        }
        f(self);
    }
}

impl Vector {
    /// Of numbers alone.
    pub fn literal(value: [f64; 3]) -> Vector {
        Vector::Parts(value.map(Expr::literal))
    }

    /// The value at a point.
    pub fn value(&self, at: &Point) -> [f64; 3] {
        match self {
            Vector::Whole(_, value) => *value,
            Vector::Parts(parts) => [0, 1, 2].map(|k| parts[k].value(at)),
        }
    }

    /// In the language.
    pub fn text(&self) -> String {
        match self {
            Vector::Whole(text, _) => text.clone(),
            Vector::Parts([x, y, z]) => format!("[{}, {}, {}]", x.text(), y.text(), z.text()),
        }
    }

    /// Calls `f` with every expression inside.
    pub fn visit(&mut self, f: &mut dyn FnMut(&mut Expr)) {
        if let Vector::Parts(parts) = self {
            parts.iter_mut().for_each(|e| e.visit(f));
        }
    }
}
