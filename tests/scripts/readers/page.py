"""A page of equations: its names, its lines one after the other, and what they come to."""

import re

import numpy
import sympy

from . import latex, mathml, text
from .meaning import UNDEFINED, Unreadable

FORMS = {"text": text, "latex": latex, "mathml": mathml}
TOLERANCE = 1e-12
# Lines that say what others give.
IMPLICIT = ("speed", "rolling")


class Page:
    """Reads a page and compares it; `wrong` has what is found."""

    def __init__(self, model):
        self.model, self.wrong, self.worst = model, [], (0.0, "nothing")
        # Values of each form by line and side, once for velocities as they are drawn and once for the motion.
        self.sides = {}
        self.names = {form: {} for form in FORMS}
        self.legend()
        lines = [self.line(k, line) for k, line in enumerate(model["lines"])]
        if model["states"] and not self.wrong:
            with numpy.errstate(all="ignore"):
                self.compare([line for line in lines if line])

    def say(self, what):
        self.wrong.append(what)

    def call(self, symbol, printed, what):
        """A name in three forms; it must be no other's."""
        for form in FORMS:
            key = FORMS[form].name(printed[form])
            if key is None:
                self.say(f"{what}: {printed[form]} is no name in {form}")
            elif self.names[form].setdefault(key, symbol) != symbol:
                self.say(f"{what}: {printed['text']} looks like another in {form}: {printed[form]}")

    def legend(self):
        self.symbols = [sympy.Symbol(f"s{k}", real=True) for k in range(len(self.model["symbols"]))]
        for symbol, printed in zip(self.symbols, self.model["symbols"]):
            self.call(symbol, printed, "legend")
        # Names of left sides first: a line may read what stands below it.
        self.defined = {}
        given = {symbol for symbol, printed in zip(self.symbols, self.model["symbols"]) if printed["given"]}
        for k, line in enumerate(self.model["lines"]):
            left = line["left"]
            if line["subject"] in ("motion", "cosine", "sine", "speed"):
                continue
            if line["subject"] == "rolling":
                self.call(sympy.Symbol(f"d{k}", real=True), left, f"line {k}")
                continue
            known = self.names["text"].get(text.name(left["text"]))
            if known in given or known in self.defined.values():
                self.say(f"line {k}: {left['text']} is told twice")
            self.defined[k] = known or sympy.Symbol(f"d{k}", real=True)
            self.call(self.defined[k], left, f"line {k}")

    def line(self, k, line):
        """Both sides by form."""
        try:
            sides = {
                side: {form: reader.read(line[side][form], self.names[form]) for form, reader in FORMS.items()}
                for side in ("left", "right")
            }
        except (Unreadable, KeyError, IndexError, ValueError, SyntaxError) as error:
            self.say(f"line {k}: {type(error).__name__} {error}")
            return None
        return k, line["subject"], line["at"], sides

    def compare(self, lines):
        states = self.model["states"]
        still = self.evaluate(lines, [state["values"] for state in states])
        self.against(still, states)
        if None not in states[0]["moving"]:
            moving = self.evaluate(lines, [state["moving"] for state in states])
            self.last(moving, states)

    def evaluate(self, lines, states):
        """Values of right sides by subject, and of both sides of equations of motion."""
        table = numpy.array(states, dtype=numpy.longdouble).T
        given = zip(self.symbols, self.model["symbols"], table)
        values = {symbol: list_ for symbol, printed, list_ in given if printed["given"]}
        values[UNDEFINED] = numpy.full(len(states), numpy.nan)
        found = {"cosine": {}, "sine": {}}
        for k, subject, at, sides in sorted(lines, key=lambda line: line[1] in ("motion", *IMPLICIT)):
            right = self.value(k, "right", sides["right"], values, len(states))
            if subject in IMPLICIT:
                # What rates obey that other lines give: what a speed stands for, an equation of velocities.
                left = self.value(k, "left", sides["left"], values, len(states)) if subject == "speed" else 0 * right
                self.check(f"line {k}, {subject}", [right], [left], numpy.maximum(1, numpy.abs(left)))
            elif subject == "motion":
                found[subject, *at] = self.value(k, "left", sides["left"], values, len(states)), right
            elif subject in ("cosine", "sine"):
                angle = self.angle(k, subject, sides["left"])
                found[subject][angle] = k, sides["left"], right
                if subject == "sine" and angle in found["cosine"]:
                    values[angle] = numpy.arctan2(right, found["cosine"][angle][2])
            else:
                values[self.defined[k]] = right
                found[subject, *at] = right
        # The angle has its direction from both; their length must be one.
        for subject in ("cosine", "sine"):
            for k, left, right in found[subject].values():
                got = self.value(k, "left", left, values, len(states))
                self.check(f"line {k}, {self.model['lines'][k]['left']['text']}", [got], [right], numpy.ones(len(states)))
        return found | {"values": values}

    def angle(self, k, subject, forms):
        """The name whose cosine or sine stands on the left, which is no sum."""
        left = forms["text"]
        function = {"cosine": sympy.cos, "sine": sympy.sin}[subject]
        if not isinstance(left, function) or not left.args[0].is_Symbol:
            self.say(f"line {k}: the left side is not the {subject} of one name: {left}")
        return left.args[0] if left.args else left

    def value(self, k, side, forms, values, size):
        """Of one side: the forms must agree."""
        results = {}
        for form, expression in forms.items():
            if expression not in results:
                arguments = sorted(expression.free_symbols, key=str)
                missing = [str(symbol) for symbol in arguments if symbol not in values]
                if missing:
                    self.say(f"line {k}: {missing} have no value in {form}")
                    return numpy.full(size, numpy.nan)
                function = sympy.lambdify(arguments, expression, modules=MODULES)
                result = numpy.asarray(function(*(values[symbol] for symbol in arguments)), dtype=numpy.longdouble)
                results[expression] = numpy.broadcast_to(result, size)
        for form, expression in forms.items():
            self.sides.setdefault((k, side, form), []).append(results[expression])
        if len(results) > 1:
            self.agree(k, list(results), list(results.values()))
        return results[forms["text"]]

    def agree(self, k, expressions, here):
        """Expressions that SymPy has not made the same must have the same values, whatever their symbols stand for, and here, at
        the states: elsewhere they may have none."""
        symbols = sorted(set().union(*(expression.free_symbols for expression in expressions)), key=str)
        points = numpy.random.default_rng(1).uniform(0.1, 0.9, (len(symbols), 8)).astype(numpy.longdouble)
        functions = (sympy.lambdify(symbols, expression, modules=MODULES) for expression in expressions)
        there = (numpy.broadcast_to(numpy.asarray(function(*points), dtype=numpy.longdouble), 8) for function in functions)
        if not all(is_same(first, other) for first, *others in (there, here) for other in others):
            self.say(f"line {k}: text, LaTeX and MathML differ: {self.model['lines'][k]}")

    def check(self, what, got, want, scale):
        """Entries by states, to a tolerance of the scale by states."""
        got, want = numpy.array(got, dtype=numpy.longdouble), numpy.array(want, dtype=numpy.longdouble)
        if got.shape != want.shape:
            return self.say(f"{what}: {got.shape} entries on the page and {want.shape} compiled")
        if got.size == 0:
            return None
        # What is undefined on both sides is said alike, but where it is so at all states nothing is compared.
        for entry in numpy.argwhere(~numpy.any(numpy.isfinite(got) & numpy.isfinite(want), axis=-1)):
            self.say(f"{what} {entry} is finite at none of {got.shape[-1]} states: {got[*entry, 0]} and {want[*entry, 0]} compiled")
        error = numpy.where(numpy.isnan(got) & numpy.isnan(want), 0, numpy.abs(got - want) / scale)
        self.worst = max(self.worst, (float(numpy.nanmax(error, initial=0)), what))
        if not numpy.all(error <= TOLERANCE):
            entry, state = numpy.argwhere(~(error <= TOLERANCE))[0]
            self.say(f"{what} {entry} is {got[entry, state]} on the page and {want[entry, state]} compiled, state {state}")

    def against(self, found, states):
        """Of what does not depend on how the mechanism accelerates."""

        def results(name):
            return numpy.array([state[name] for state in states], dtype=numpy.longdouble).T

        def entries(subject):
            return numpy.array([found[key] for key in sorted(key for key in found if key[0] == subject)])

        size, count = self.model["freedoms"], len(states)
        if size == 0:
            return
        mass = results("mass").reshape(size, size, count)
        upper = [mass[i, j] for i in range(size) for j in range(i, size)]
        biggest = numpy.maximum(1, numpy.abs(mass).max(axis=(0, 1)))
        self.check("mass matrix", entries("mass"), upper, biggest)
        parts = [entries(subject) for subject in ("inertial", "gravity", "force")]
        scale = numpy.maximum(1, numpy.abs(parts).max(axis=(0, 1)))
        self.check("bias", parts[0] + parts[1] - parts[2], results("bias"), scale)
        motion = entries("motion")
        scale = numpy.maximum(numpy.maximum(biggest, scale), numpy.abs(motion).max(axis=(0, 1)))
        self.check("equation of motion", motion[:, 0] - motion[:, 1], results("motion"), scale)
        if states[0]["constraints"] is not None:
            gaps = results("constraints")
            self.check("constraint", entries("constraint"), gaps, numpy.maximum(1, numpy.abs(gaps).max(axis=0)))
            slopes = results("jacobian")
            own = numpy.zeros_like(slopes)
            for key in found:
                if key[0] == "slope":
                    own[key[1] * size + key[2]] = found[key]
            self.check("Jacobian", own, slopes, numpy.maximum(1, numpy.abs(slopes).max(axis=0)))

    def last(self, found, states):
        """Of what reads accelerations and multipliers as the motion has them."""
        for name, subject in (("outputs", "output"), ("rates", "state rate")):
            for key in found:
                if key[0] == subject:
                    want = numpy.array([state[name][key[1]] for state in states], dtype=numpy.longdouble)
                    self.check(f"{subject} {key[1]}", [found[key]], [want], numpy.maximum(1, numpy.abs(want)))
        self.rests(found["values"], states)
        # Coordinates that follow, their rates and accelerations, as far as they have lines.
        for place, (number, _) in enumerate(states[0].get("followed", [])):
            got = found["values"].get(self.symbols[number])
            if got is not None:
                want = numpy.array([state["followed"][place][1] for state in states], dtype=numpy.longdouble)
                # An angle and the same some turns away are one.
                turns = 2 * numpy.pi * numpy.round((got - want) / (2 * numpy.pi))
                got = numpy.where(self.symbols[number] in found["sine"], got - turns, got)
                name = self.model["symbols"][number]["text"]
                self.check(name, [got], [want], numpy.maximum(1, numpy.abs(want)))

    def rests(self, values, states):
        """What is left of accelerations that nothing reads: with x' = S q' on the page, x'' is S q'' and the rest."""
        numbers = {printed["text"]: number for number, printed in enumerate(self.model["symbols"])}
        followed = {number: place for place, (number, _) in enumerate(states[0].get("followed", []))}
        slopes = {self.defined[k] for k, line in enumerate(self.model["lines"]) if line["subject"] == "follows"}
        rates = {line["left"]["text"]: line for line in self.model["lines"] if line["subject"] == "rate"}
        for k, line in enumerate(self.model["lines"]):
            name = re.fullmatch(r"[^[]*\[(.*)\]", line["left"]["text"])
            if line["subject"] != "rest" or not name or name[1] + "˙" not in rates:
                continue
            rate = text.read(rates[name[1] + "˙"]["right"]["text"], self.names["text"])
            # Where a drive moves the loop too, the rate is more than these.
            speeds = [printed for printed in numbers if printed + "˙" in numbers and printed + "¨" not in numbers]
            velocities = speeds + [printed for printed in numbers if printed.endswith("˙") or ".omega[" in printed]
            at = {self.symbols[numbers[v]]: after(v) for v in velocities if after(v) in numbers}
            moving = list(rate.free_symbols - slopes)
            place = followed.get(numbers.get(name[1] + "¨"))
            if place is None or any(symbol not in at for symbol in moving):
                continue
            given = [values[self.symbols[numbers[at[symbol]]]] for symbol in moving]
            others = sorted(rate.free_symbols & slopes, key=str)
            function = sympy.lambdify([*moving, *others], rate, modules=MODULES)
            got = function(*given, *(values[symbol] for symbol in others)) + values[self.defined[k]]
            want = numpy.array([state["followed"][place][1] for state in states], dtype=numpy.longdouble)
            self.check(line["left"]["text"], [got], [want], numpy.maximum(1, numpy.abs(want)))


def is_same(first, second):
    return numpy.allclose(first, second, rtol=TOLERANCE, atol=TOLERANCE, equal_nan=True)


def after(printed):
    """The name of the rate of a velocity, as text."""
    return printed[:-1] + "¨" if printed.endswith("˙") else printed + "˙"


def greatest(list_, axis=0):
    return reduced(numpy.maximum, list_)


def least(list_, axis=0):
    return reduced(numpy.minimum, list_)


def reduced(choice, list_):
    first, *others = list_
    for other in others:
        first = choice(first, other)
    return first


def holds(condition):
    """A condition that was chosen comes as numbers; what is undefined holds nowhere."""
    return numpy.nan_to_num(condition).astype(bool)


def chosen(condition, value, otherwise):
    return numpy.where(holds(condition), value, otherwise)


CONDITIONS = {
    "choice": chosen,
    "negation": lambda condition: ~holds(condition),
    "both": lambda a, b: holds(a) & holds(b),
    "either": lambda a, b: holds(a) | holds(b),
}
MODULES = [{"amax": greatest, "amin": least, **CONDITIONS}, "numpy"]
