"""MathML: operators are `mo`, factors are parted by the invisible sign of multiplication or a dot, a function's name has the
sign of application behind it, a name is an `mi`, with `mover` for dots and `msub` for an index. A function of one name has no brackets."""

import xml.etree.ElementTree as Tree

import sympy

from . import meaning
from .meaning import Unreadable

TIMES, OF = "\N{INVISIBLE TIMES}", "\N{FUNCTION APPLICATION}"
RELATIONS = {"<": sympy.Lt, "≤": sympy.Le, "=": sympy.Eq, "∧": meaning.BOTH, "∨": meaning.EITHER}


def content(source):
    root = Tree.fromstring(source)
    return list(root) if root.tag in ("math", "mrow") else [root]


def key(element):
    return Tree.tostring(element, encoding="unicode")


def is_name(element):
    if element.tag in ("msub", "mover"):
        return is_name(element[0])
    return element.tag in ("mi", "mtext")


def name(source):
    """The name that is all of the source, as a key; None where it is something else."""
    elements = content(source)
    while len(elements) == 1 and elements[0].tag == "mrow":
        elements = list(elements[0])
    return key(elements[0]) if len(elements) == 1 and is_name(elements[0]) else None


def read(source, names):
    return row(content(source), names)


def row(elements, names):
    reader = Reader(elements, names)
    value = reader.relation()
    if reader.at != len(elements):
        raise Unreadable(f"{reader.shown()} is left")
    return value


class Reader:
    def __init__(self, elements, names):
        self.elements, self.names, self.at = elements, names, 0

    def shown(self):
        return " ".join(key(element) for element in self.elements[self.at :][:8])

    def peek(self, *signs):
        if self.at == len(self.elements) or self.elements[self.at].tag != "mo":
            return None
        sign = (self.elements[self.at].text or "").replace("\N{MINUS SIGN}", "-")
        return sign if sign in signs else None

    def take(self, *signs):
        taken = self.peek(*signs)
        self.at += taken is not None
        return taken

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
        value = self.atom()
        while self.take(TIMES, "·"):
            value = value * self.atom()
        return value

    def next(self):
        if self.at == len(self.elements):
            raise Unreadable("the end, where a factor must stand")
        self.at += 1
        return self.elements[self.at - 1]

    def atom(self):
        if self.take("¬"):
            return meaning.NEGATION(self.atom())
        element = self.next()
        if element.tag == "mi" and self.take(OF):
            return meaning.FUNCTIONS[element.text](*arguments(self.next(), self.names))
        return value(element, self.names)


def value(element, names):
    parts = list(element)
    if element.tag == "mrow":
        return bracket(parts, names)
    if element.tag == "mn":
        return meaning.number(element.text)
    if element.tag == "mfrac":
        return value(parts[0], names) / value(parts[1], names)
    if element.tag == "msup":
        return value(parts[0], names) ** value(parts[1], names)
    if element.tag == "msqrt":
        return sympy.sqrt(row(parts, names))
    if is_name(element):
        if key(element) in names:
            return names[key(element)]
        constants = {"π": sympy.pi, "eps": meaning.ROUNDING, "undefined": meaning.UNDEFINED}
        if element.tag == "mi" and element.text in constants:
            return constants[element.text]
    raise Unreadable(f"nothing is called {key(element)}")


def bracket(parts, names):
    signs = [part.text if part.tag == "mo" else None for part in (parts[0], parts[-1])]
    if signs == ["(", ")"]:
        return row(parts[1:-1], names)
    if signs == ["|", "|"]:
        return sympy.Abs(row(parts[1:-1], names))
    if signs[0] == "{":
        (yes, condition), (no, _) = (list(line) for line in parts[1])
        return meaning.cases(row(list(yes), names), row(list(condition)[1:], names), row(list(no), names))
    return row(parts, names)


def arguments(element, names):
    """Of a function: a row in brackets, parted by commas, or one name."""
    if is_name(element):
        return [value(element, names)]
    parts, lists = list(element)[1:-1], [[]]
    for part in parts:
        if part.tag == "mo" and part.text == ",":
            lists.append([])
        else:
            lists[-1].append(part)
    return [row(part, names) for part in lists]
