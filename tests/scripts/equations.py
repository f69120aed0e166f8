#!/usr/bin/env python3
"""Reads printed equations back, as text, LaTeX and MathML, and holds them against what compiled functions give.

    cargo run --release -p multibody-fuzz -- written > target/written.jsonl     # all models of the project, 100 states
    python3 tests/scripts/equations.py target/written.jsonl [--break] [--verbose]

Nothing of the engine is used: `readers` has a parser for each form, made from what the documentation of the printers says, and
SymPy does the mathematics. A page is followed line by line: each gives the value of its left side, by the names that are
printed, and what comes out must be what the functions give, to 1e-12 of its scale. All three forms must say the same.
What is undefined on both sides agrees, but each entry must be finite at one state at least. `--break` flips signs in what is read,
in one form or in all three, and demands that each flip that changes a value of these forms is found.

SymPy and NumPy come into an environment of their own, `target/equations`."""

import json
import os
import subprocess
import sys
import time
from pathlib import Path

TOLERANCE = 1e-12
ENVIRONMENT = Path(__file__).resolve().parents[2] / "target" / "equations"


def in_environment():
    """Starts again where SymPy is."""
    python = ENVIRONMENT / "bin" / "python"
    if Path(sys.prefix).resolve() == ENVIRONMENT.resolve():
        return
    if not python.exists() or subprocess.run([python, "-c", "import sympy, numpy"], stderr=subprocess.DEVNULL).returncode:
        subprocess.run([sys.executable, "-m", "venv", "--clear", ENVIRONMENT], check=True)
        subprocess.run([python, "-m", "pip", "install", "--quiet", "sympy==1.14.*", "numpy>=1.24"], check=True)
    os.execv(python, [str(python), *sys.argv])


if __name__ == "__main__":
    in_environment()

from readers.page import Page  # noqa: E402
from readers import breaks  # noqa: E402


def main():
    options = {word for word in sys.argv[1:] if word.startswith("--")}
    files = [word for word in sys.argv[1:] if not word.startswith("--")]
    start, models, lines, states, worst, wrong, flips = time.time(), 0, 0, 0, (0.0, ""), [], [0, 0]
    for line in (line for file in files for line in open(file, encoding="utf-8")):
        since = time.time()
        model = json.loads(line)
        label = f"{model['file']}: {model['model']}"
        page = Page(model)
        if "--break" in options:
            found, missed = breaks.run(model)
            flips[0] += found
            flips[1] += len(missed)
            wrong += [f"{label}: {text}" for text in missed]
        models, lines, states = models + 1, lines + len(model["lines"]), states + len(model["states"])
        worst = max(worst, (page.worst[0], f"{page.worst[1]} of {label}"))
        wrong += [f"{label}: {text}" for text in page.wrong]
        if "--verbose" in options:
            print(f"{label}: {len(model['lines'])} lines, {page.worst[0]:.1e}, {time.time() - since:.1f} s", flush=True)
    for text in wrong[:40]:
        print(text)
    print(f"{models} models, {lines} lines, {states} states, worst {worst[0]:.1e} ({worst[1]}), {time.time() - start:.0f} s")
    if "--break" in options:
        print(f"{flips[0]} of {sum(flips)} signs that were flipped are found")
    if models == 0 or wrong:
        sys.exit(f"{len(wrong)} findings")


if __name__ == "__main__":
    main()
