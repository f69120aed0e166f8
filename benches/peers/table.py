"""The table of a run, and its picture: `table.py WORK` reads WORK/times.tsv and WORK/machine, which `run` has written.

Rows are functions of robots. Of every program: its least time over this library's least time, and in brackets the median of
the ratios within one round with the quartiles around it.
"""

import math
import sys
from pathlib import Path

FUNCTIONS = {"inverse": "inverse dynamics", "forward": "forward dynamics", "mass": "mass matrix",
             "derivatives": "derivatives of forward dynamics", "forward, lanes of four": "forward dynamics, lanes of four"}
ROBOTS = {"four_legged": "four-legged robot", "stewart": "Stewart-Gough platform", "delta": "Delta robot"}
COLOURS = {"CasADi": "#4c78a8", "CasADi, any processor": "#9ecae9", "Pinocchio": "#f58518", "MuJoCo": "#54a24b",
           "Pinocchio, constraintDynamics": "#f58518", "Pinocchio, lcaba": "#ffbf79"}
OTHERS = "#79706e"
# This library with limbs together.
PACKS = "ours, packs"


class Row:
    def __init__(self, line):
        self.robot, self.function, self.program, *numbers = line.rstrip("\n").split("\t")
        self.error, self.least, _, self.median, _, self.ratio, self.low, self.middle, self.high = map(float, numbers)

        self.any, self.ours = self.program.endswith("any processor"), self.program in ("ours", "ours, any processor")

    def key(self):
        return self.robot, self.function

    def title(self):
        return f"{ROBOTS.get(self.robot, self.robot)}, {FUNCTIONS.get(self.function, self.function)}"


def read(file):
    """All rows by robot and function, this library's first."""
    groups = {}
    for line in file.read_text().splitlines():
        row = Row(line)
        groups.setdefault(row.key(), []).append(row)
    for rows in groups.values():
        # For this processor first; for any, where there are two to compare.
        rows.sort(key=lambda row: row.any)
        if not any(row.any and not row.program.startswith("ours") for row in rows):
            rows[:] = [row for row in rows if not row.any]
    return groups


def table(groups, unit):
    yield "| mechanism, function | program | least time | in sin_cos | over ours | within a round: median (quartiles) | differs by |"
    yield "|---|---|---|---|---|---|---|"
    for rows in groups.values():
        for k, row in enumerate(rows):
            first = k == 0
            ratio = "1" if row.ours else f"{row.ratio:.2f}"
            spread = "" if row.ours else f"{row.middle:.2f} ({row.low:.2f} to {row.high:.2f})"
            error = "" if first else f"{row.error:.0e}"
            yield (
                f"| {row.title() if first else ''} | {row.program} | {row.least:.1f} ns | {row.least / unit:.1f} | {ratio} "
                f"| {spread} | {error} |"
            )


def summary(groups):
    """README's table: ratios of least times for this processor."""
    programs = ["CasADi", "Pinocchio", "MuJoCo", "dynibo", "phyz"]
    yield f"| mechanism, function | ours | {' | '.join(programs)} |"
    yield "|---|---|" + "---|" * len(programs)
    for rows in groups.values():
        ratios = {}
        for row in rows:
            # Of several methods of one program the fastest.
            name = row.program.split(", ")[0]
            if not (row.any or row.program == PACKS):
                ratios[name] = min(row.ratio, ratios.get(name, math.inf))
        if len(ratios) > 1:
            for ours in rows:
                if ours.program in ("ours", PACKS):
                    others = (f"{ratios[name] / ours.ratio:.2f}" if name in ratios else "" for name in programs)
                    packed = "" if ours.program == "ours" else ", in packs"
                    yield f"| {ours.title()}{packed} | {ours.least:.0f} ns | {' | '.join(others)} |"


def picture(groups):
    """A line for each program's ratio on a logarithmic scale: a dot for least times, a bar from quartile to quartile."""
    shown = {key: rows for key, rows in groups.items() if len(rows) > 1}
    left, width, height, top = 330, 560, 15, 40
    ratios = [row.ratio for rows in shown.values() for row in rows] + [1.0] + [
        x for rows in shown.values() for row in rows if not row.ours for x in (row.low, row.high)]
    low, high = math.log10(min(ratios) * 0.9), math.log10(max(ratios) * 1.1)
    at = lambda ratio: left + width * (math.log10(ratio) - low) / (high - low)
    lines, y = [], top
    for rows in shown.values():
        lines.append(f'<text x="8" y="{y + 11}" class="title">{rows[0].title()}</text>')
        for row in rows:
            if row.ours:
                continue
            colour, middle = COLOURS.get(row.program, OTHERS), y + height / 2
            lines.append(f'<line x1="{at(row.low):.1f}" x2="{at(row.high):.1f}" y1="{middle}" y2="{middle}" '
                         f'stroke="{colour}" stroke-width="4" stroke-opacity="0.45"/>')
            lines.append(f'<circle cx="{at(row.ratio):.1f}" cy="{middle}" r="4" fill="{colour}"/>')
            lines.append(f'<text x="{max(at(row.high), at(row.ratio)) + 8:.1f}" y="{y + 11}">{row.program} {row.ratio:.1f}</text>')
            y += height
        y += 8
    marks = [mark for mark in (0.5, 1, 2, 5, 10, 20, 50, 100, 200) if low <= math.log10(mark) <= high]
    grid = [
        f'<line x1="{at(mark):.1f}" x2="{at(mark):.1f}" y1="{top - 6}" y2="{y}" stroke="{"#333" if mark == 1 else "#ccc"}"/>'
        f'<text x="{at(mark):.1f}" y="{top - 12}" text-anchor="middle">{mark}</text>'
        for mark in marks
    ]
    return "\n".join([
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{left + width + 220}" height="{y + 10}" '
        'font-family="sans-serif" font-size="11">',
        "<style>text { fill: #222 } .title { font-weight: bold }</style>",
        '<rect width="100%" height="100%" fill="white"/>',
        '<text x="8" y="16" class="title">Time of others over ours (dots: least times; bars: quartiles of rounds)</text>',
        *grid, *lines, "</svg>",
    ]) + "\n"


def main():
    work = Path(sys.argv[1])
    groups = read(work / "times.tsv")
    unit, once = (groups[(name, "sin_cos")][0].least for name in ("unit", "unit, arguments that come once"))
    text = "\n".join([
        *(work / "machine").read_text().splitlines(), "",
        f"one sin_cos of f64: {unit:.1f} ns; of arguments that come once, whose branches no processor knows: {once:.1f} ns", "",
        *table(groups, unit),
    ]) + "\n"
    (work / "table.md").write_text(text)
    (work / "summary.md").write_text("\n".join(summary(groups)) + "\n")
    (work / "peers.svg").write_text(picture(groups))
    print(text, end="")


main()
