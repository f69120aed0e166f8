"""Signs flipped in what was printed: each flip must be found, by the other forms where one form alone has it, by the compiled
functions where all have it."""

import copy
import random
import re

from .page import Page

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
    for forms in (["text"], ["latex"], ["mathml"], list(SIGN)):
        for number, side, sign in chance.sample(places, min(MOST, len(places))):
            broken = copy.deepcopy(model)
            printed = broken["lines"][number][side]
            for form in forms:
                printed[form] = flipped(form, printed[form], sign)
            if Page(broken).wrong:
                found += 1
            else:
                missed.append(f"sign {sign} of line {number} flipped in {', '.join(forms)}: not found in {printed}")
    return found, missed


def flipped(form, printed, number):
    at = list(SIGN[form].finditer(printed))[number].start()
    return printed[:at] + (MINUS[form] if printed[at] == "+" else "+") + printed[at + 1 :]
