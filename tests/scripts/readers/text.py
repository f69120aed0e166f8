"""Plain text: factors stand side by side, `/` binds as a product does and is read from the left, superscripts are powers, a
bracket right behind a word is its argument, `x˙` is a name like any other."""

import re

import sympy

from . import meaning
from .meaning import Unreadable

SUPERSCRIPTS = "⁰¹²³⁴⁵⁶⁷⁸⁹"
LETTER = rf"[^\W\d{SUPERSCRIPTS}]"
INDEX = r"(?:\[(?:[^\[\]]|\[[^\[\]]*\])*\])"
NAME = rf"(?:{LETTER}[^\W{SUPERSCRIPTS}]*{INDEX}*)"
TOKEN = re.compile(
    rf"(?P<number>\d+(?:\.\d+)?)|(?P<call>{LETTER}\w*)\((?!\))|(?P<constant>eps|undefined)\(\)"
    rf"|(?P<name>{NAME}(?:\.{NAME})*[˙¨]?)"
    rf"|(?P<power>[{SUPERSCRIPTS}]+)|(?P<sign>\^\(|<=|==|[-+/()<,∧∨¬])|(?P<space> )"
)
RELATIONS = {"<": sympy.Lt, "<=": sympy.Le, "==": sympy.Eq, "∧": meaning.BOTH, "∨": meaning.EITHER}


def name(source):
    """The name that is all of the source, as a key; None where it is something else."""
    found = TOKEN.fullmatch(source)
    return source if found and found["name"] else None


def read(source, names):
    reader = Reader(source, names)
    value = reader.relation()
    if reader.at != len(reader.tokens):
        raise Unreadable(f"{reader.rest()} is left of {source}")
    return value


class Reader:
    def __init__(self, source, names):
        self.names, self.tokens, self.at = names, [], 0
        at = 0
        while at < len(source):
            found = TOKEN.match(source, at)
            if not found:
                raise Unreadable(f"{source[at:at + 20]!r} in {source}")
            if found.lastgroup != "space":
                self.tokens.append((found.lastgroup, found[found.lastgroup]))
            at = found.end()

    def rest(self):
        return self.tokens[self.at :][:8]

    def peek(self, *signs):
        token = self.tokens[self.at] if self.at < len(self.tokens) else ("end", "")
        return token[0] in ("sign", "name") and token[1] in signs

    def take(self, *signs):
        taken = self.tokens[self.at][1] if self.peek(*signs) else None
        self.at += taken is not None
        return taken

    def demand(self, sign):
        if not self.take(sign):
            raise Unreadable(f"no {sign} before {self.rest()}")

    def relation(self):
        left = self.sum()
        relation = self.take(*RELATIONS)
        return RELATIONS[relation](left, self.sum()) if relation else left

    def sum(self):
        first = self.take("-", "+")
        terms = [(first == "-", self.product())]
        if not first and not self.peek("+", "-"):
            return terms[0][1]
        while sign := self.take("+", "-"):
            terms.append((sign == "-", self.product()))
        return meaning.total(terms)

    def product(self):
        value = self.power()
        while True:
            if self.take("/"):
                value = value / self.power()
            elif self.starts():
                value = value * self.power()
            else:
                return value

    def starts(self):
        """Whether what follows is a factor."""
        if self.at == len(self.tokens) or self.peek("if", "else"):
            return False
        kind, _ = self.tokens[self.at]
        return kind in ("number", "call", "constant", "name") or self.peek("(", "¬")

    def power(self):
        base = self.atom()
        if self.at < len(self.tokens) and self.tokens[self.at][0] == "power":
            digits = self.tokens[self.at][1]
            self.at += 1
            return base ** int("".join(str(SUPERSCRIPTS.index(digit)) for digit in digits))
        if self.take("^("):
            exponent = self.relation()
            self.demand(")")
            return base**exponent
        return base

    def atom(self):
        if self.take("¬"):
            return meaning.NEGATION(self.atom())
        if self.take("("):
            value = self.relation()
            if self.take("if"):
                condition = self.relation()
                self.demand("else")
                value = meaning.cases(value, condition, self.relation())
            self.demand(")")
            return value
        if self.at == len(self.tokens):
            raise Unreadable("the end, where a factor must stand")
        kind, word = self.tokens[self.at]
        self.at += 1
        if kind == "number":
            return meaning.number(word)
        if kind == "constant":
            return meaning.ROUNDING if word == "eps" else meaning.UNDEFINED
        if kind == "call":
            arguments = [self.relation()]
            while self.take(","):
                arguments.append(self.relation())
            self.demand(")")
            return meaning.FUNCTIONS[word](*arguments)
        if kind == "name" and word in self.names:
            return self.names[word]
        if word == "π":
            return sympy.pi
        raise Unreadable(f"nothing is called {word}")
