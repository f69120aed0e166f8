"""Signs flipped in what was printed: each flip must be found, by the other forms where one form alone has it, by the compiled
functions where all have it. A sign that changes nothing at any state says nothing and does not count: that of a term which is zero
because a drive holds what it is about, because links of a parallelogram keep their direction, or because a parameter is zero. What a
condition compares is told by its truth alone."""

import copy
import random
import re

from .page import Page, is_same

MINUS = {"text": "-", "latex": "-", "mathml": "\u2212"}
SIGN = {"text": re.compile("[+-]"), "latex": re.compile("[+-]"), "mathml": re.compile("(?<=<mo>)[+\u2212](?=</mo>)")}
# Of each model, for each form and for all at once.
MOST = 4


def run(model, seed=1):
    """How many flips were found, and those that were not."""
    chance = random.Random(seed)
    places = [
        (number, side, sign)
        for number, line in enumerate(model["lines"])
        for side in ("left", "right")
        for sign in range(len(SIGN["text"].findall(line[side]["text"])))
    ]
    found, missed = 0, []
    whole = Page(model)
    for forms in (["text"], ["latex"], ["mathml"], list(SIGN)):
        for number, side, sign in chance.sample(places, min(MOST, len(places))):
            broken = copy.deepcopy(model)
            printed = broken["lines"][number][side]
            for form in forms:
                printed[form] = flipped(form, printed[form], sign)
            page = Page(broken)
            if page.wrong:
                found += 1
            elif not is_silent(whole, page, number, side, forms):
                missed.append(f"sign {sign} of line {number} flipped in {', '.join(forms)}: not found in {printed}")
    return found, missed


def is_silent(whole, broken, number, side, forms):
    """Whether the side of a line comes to the same at all states with a sign flipped, in each form that has it so."""
    return all(is_as_before(whole, broken, (number, side, form)) for form in forms)


def is_as_before(whole, broken, place):
    before, after = (page.sides.get(place, []) for page in (whole, broken))
    return len(before) == len(after) > 0 and all(map(is_same, before, after))


def flipped(form, printed, number):
    at = list(SIGN[form].finditer(printed))[number].start()
    return printed[:at] + (MINUS[form] if printed[at] == "+" else "+") + printed[at + 1 :]
