"""What words of printed mathematics mean to SymPy, whatever form they are printed in."""

import sympy

FUNCTIONS = {
    "sin": sympy.sin,
    "cos": sympy.cos,
    "tan": sympy.tan,
    "arcsin": sympy.asin,
    "arccos": sympy.acos,
    "arctan": sympy.atan,
    "atan2": sympy.atan2,
    "sinh": sympy.sinh,
    "cosh": sympy.cosh,
    "tanh": sympy.tanh,
    "exp": sympy.exp,
    "ln": sympy.log,
    "sign": sympy.sign,
    "min": sympy.Min,
    "max": sympy.Max,
    "sqrt": sympy.sqrt,
    "abs": sympy.Abs,
}

# The rounding unit of double precision, and no number.
ROUNDING = sympy.Rational(1, 2**52)
UNDEFINED = sympy.Symbol("undefined")


class Unreadable(Exception):
    """The text is none that the printer's documentation describes."""


def number(digits):
    """Exact, so that nothing is rounded before SymPy's function runs."""
    return sympy.Rational(digits)


# Conditions stay as they are printed: of `not a < b` SymPy makes `b <= a`, which says something else of what is undefined.
CHOICE, NEGATION, BOTH, EITHER = (sympy.Function(name, real=True) for name in ("choice", "negation", "both", "either"))


def cases(value, condition, otherwise):
    return CHOICE(condition, value, otherwise)


def total(terms):
    """Terms with whether each is subtracted."""
    return sympy.Add(*(-term if minus else term for minus, term in terms))
