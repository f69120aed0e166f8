"""LaTeX: factors are parted by `\\,` or `\\cdot`, a name is a letter, a Greek one or an upright word, with dots on it and an
index below."""

import re

import sympy

from . import meaning
from .meaning import Unreadable

TOKEN = re.compile(r"\\(?:left|right)[(|)]|\\[A-Za-z]+|\\[,_\\ ]|\d+(?:\.\d+)?|\s+|.")
GREEK = "alpha beta gamma delta epsilon zeta eta theta iota kappa lambda mu nu xi rho sigma tau upsilon phi chi psi omega"
CAPITALS = "Gamma Delta Theta Lambda Xi Sigma Upsilon Phi Psi Omega"
GREEK = {f"\\{word}" for word in GREEK.split() + CAPITALS.split()}
WORDS = r"\mathrm", r"\mathtt"
FUNCTIONS = {f"\\{word}" for word in meaning.FUNCTIONS} - {r"\sqrt", r"\abs", r"\atan2", r"\sign"}
RELATIONS = {"<": sympy.Lt, r"\le": sympy.Le, "=": sympy.Eq, r"\land": meaning.BOTH, r"\lor": meaning.EITHER}


def name(source):
    """The name that is all of the source, as a key; None where it is something else."""
    reader = Reader(source, {})
    key = reader.name() if reader.starts_name() else None
    return key if reader.at == len(reader.tokens) else None


def read(source, names):
    reader = Reader(source, names)
    value = reader.relation()
    if reader.at != len(reader.tokens):
        raise Unreadable(f"{reader.tokens[reader.at:][:8]} is left of {source}")
    return value


class Reader:
    def __init__(self, source, names):
        # Spaces count inside of words alone.
        self.names, self.tokens, self.at, depth, word = names, [], 0, 0, None
        for token in TOKEN.findall(source):
            depth += (token == "{") - (token == "}")
            if word is None and token.isspace():
                continue
            if token in WORDS or token == r"\text":
                word = depth
            elif token == "}" and word == depth:
                word = None
            self.tokens.append(token)

    def peek(self, *tokens):
        return self.at < len(self.tokens) and self.tokens[self.at] in tokens

    def take(self, *tokens):
        taken = self.tokens[self.at] if self.peek(*tokens) else None
        self.at += taken is not None
        return taken

    def demand(self, *tokens):
        for token in tokens:
            if not self.take(token):
                raise Unreadable(f"no {token} before {self.tokens[self.at:][:8]}")

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
        while self.take(r"\,", r"\cdot"):
            value = value * self.power()
        return value

    def power(self):
        base = self.atom()
        return base ** self.group() if self.take("^") else base

    def group(self):
        self.demand("{")
        value = self.relation()
        self.demand("}")
        return value

    def inside(self, closing):
        values = [self.relation()]
        while self.take(","):
            values.append(self.relation())
        self.demand(closing)
        return values

    def word(self):
        """What stands in braces, letter by letter."""
        self.demand("{")
        start = self.at
        while not self.peek("}"):
            self.at += 1
        self.at += 1
        return "".join(self.tokens[start : self.at - 1])

    def starts_name(self):
        if self.at == len(self.tokens):
            return False
        token = self.tokens[self.at]
        return token in GREEK or token in WORDS or token in (r"\dot", r"\ddot") or len(token) == 1 and token.isalpha()

    def name(self):
        start = self.at
        self.stem()
        if self.take("_"):
            self.demand("{", r"\mathrm")
            self.word()
            self.demand("}")
        return "".join(self.tokens[start : self.at])

    def stem(self):
        token = self.tokens[self.at]
        self.at += 1
        if token in WORDS:
            self.word()
        elif token in (r"\dot", r"\ddot"):
            self.demand("{")
            self.stem()
            self.demand("}")

    def atom(self):
        if self.at == len(self.tokens):
            raise Unreadable("the end, where a factor must stand")
        if self.starts_name():
            key = self.name()
            if key == r"\mathrm{undefined}":
                return meaning.UNDEFINED
            if key not in self.names:
                raise Unreadable(f"nothing is called {key}")
            return self.names[key]
        token = self.tokens[self.at]
        self.at += 1
        if token[0].isdigit():
            return meaning.number(token)
        if token == r"\pi":
            return sympy.pi
        if token == r"\varepsilon":
            self.demand("_", "{", r"\mathrm")
            self.word()
            self.demand("}")
            return meaning.ROUNDING
        if token == r"\left(":
            return self.inside(r"\right)")[0]
        if token == r"\left|":
            return sympy.Abs(self.inside(r"\right|")[0])
        if token == r"\lnot":
            return meaning.NEGATION(self.atom())
        if token == r"\frac":
            return self.group() / self.group()
        if token == r"\sqrt":
            return sympy.sqrt(self.group())
        if token in FUNCTIONS or token == r"\operatorname":
            word = self.word() if token == r"\operatorname" else token[1:]
            self.demand(r"\left(")
            return meaning.FUNCTIONS[word](*self.inside(r"\right)"))
        if token == r"\begin":
            return self.cases()
        raise Unreadable(f"{token} in {''.join(self.tokens)}")

    def cases(self):
        self.word()
        value = self.relation()
        self.demand("&", r"\text")
        self.word()
        condition = self.relation()
        self.demand("\\\\")
        otherwise = self.relation()
        self.demand("&", r"\text")
        self.word()
        self.demand(r"\end")
        self.word()
        return meaning.cases(value, condition, otherwise)
