"""Times of the flips in data/motion/rigid_dzhanibekov.json, to 30 digits.

omega_2 = A sn(p t + phase | m) with A, p and m as they stand there (closed_form), and the phase from omega_2 at the
start. It is zero wherever p t + phase is a multiple of 2 K(m). Checked against omega_2 at the points of the file.
"""

import json
import pathlib

from mpmath import asin, ellipf, ellipfun, ellipk, mp, mpf, nstr

mp.dps = 50
data = pathlib.Path(__file__).parent.parent / "data" / "motion"
file = json.loads((data / "rigid_dzhanibekov.json").read_text())
form = file["closed_form"]
a, p, m = mpf(form["A"][1]), mpf(form["p"]), mpf(form["m"])
phase = ellipf(asin(mpf(file["omega0_body"][1]) / a), m)
for point in file["points"]:
    assert abs(a * ellipfun("sn", p * mpf(point["t"]) + phase, m) - mpf(point["omega"][1])) < mpf("1e-25")
flips = [(2 * k * ellipk(m) - phase) / p for k in range(1, 5)]
flips = [nstr(t, 30) for t in flips if t < 20]
(data / "rigid_dzhanibekov_flips.json").write_text(json.dumps({"flips": flips}, indent=1) + "\n")
