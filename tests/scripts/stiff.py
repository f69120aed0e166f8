"""Solutions of stiff systems to more than 20 digits, written into `data/motion`: the governor of `models/stiff.rs` and Van
der Pol's oscillator.

Equations are Lagrange's, written by hand here. Collocation at s Radau points (order 2s - 1) in 40 digits; each step's
equations are solved by Newton's method with a double-precision factorisation, until nothing changes in 32 digits. Steps
follow the size of the polynomial's highest Chebyshev-like coefficient. The whole is done twice, with different s and
tolerance; what both agree in is reported and decides how many digits are written.

Run it in `tests/`: `python3 scripts/stiff.py` (needs mpmath; with gmpy2 it takes a few minutes)
"""

import json
import sys
from pathlib import Path

from mpmath import mp, mpf, matrix, lu_solve, sin, cos, sqrt, polyroots, nstr

mp.dps = 40
HERE = Path(__file__).resolve().parent.parent


def radau(s):
    """Nodes and matrix of the method: Radau points on the right."""
    # Roots of d^(s-1)/dx^(s-1) (x^(s-1) (x-1)^s).
    coefficients = [mpf(1)]
    for _ in range(s):
        coefficients = [a - b for a, b in zip(coefficients + [mpf(0)], [mpf(0)] + coefficients)]
    degree = 2 * s - 1
    coefficients += [mpf(0)] * (s - 1)
    for _ in range(s - 1):
        coefficients = [c * (degree - k) for k, c in enumerate(coefficients[:-1])]
        degree -= 1
    c = sorted((r.real for r in polyroots(coefficients, maxsteps=500, extraprec=400)))
    c[-1] = mpf(1)
    vandermonde = matrix(s, s)
    for i in range(s):
        for j in range(s):
            vandermonde[i, j] = c[i] ** j
    inverse = vandermonde ** -1
    integral = matrix(s, s)
    for i in range(s):
        for j in range(s):
            integral[i, j] = c[i] ** (j + 1) / (j + 1)
    a = integral * inverse
    # Weights of the highest coefficient of the polynomial of the slope.
    top = [inverse[s - 1, j] for j in range(s)]
    return c, [[a[i, j] for j in range(s)] for i in range(s)], top


def factor(m):
    """LU in double precision, in place, with row pivots."""
    n = len(m)
    order = list(range(n))
    for k in range(n):
        p = max(range(k, n), key=lambda i: abs(m[i][k]))
        m[k], m[p] = m[p], m[k]
        order[k], order[p] = order[p], order[k]
        pivot, row = m[k][k], m[k]
        for i in range(k + 1, n):
            other = m[i]
            if other[k] != 0.0:
                f = other[k] / pivot
                other[k] = f
                for j in range(k + 1, n):
                    other[j] -= f * row[j]
    return m, order


def back(lu, b):
    m, order = lu
    n = len(m)
    x = [b[o] for o in order]
    for i in range(n):
        row = m[i]
        x[i] -= sum(row[j] * x[j] for j in range(i))
    for i in reversed(range(n)):
        row = m[i]
        x[i] = (x[i] - sum(row[j] * x[j] for j in range(i + 1, n))) / row[i]
    return x


def jacobian(f, y):
    """By central differences in 40 digits."""
    n = len(y)
    columns = []
    for j in range(n):
        d = mpf(10) ** -18 * (1 + abs(y[j]))
        right, left = list(y), list(y)
        right[j] += d
        left[j] -= d
        columns.append([float((a - b) / (2 * d)) for a, b in zip(f(right), f(left))])
    return [[columns[j][i] for j in range(n)] for i in range(n)]


def solve(f, y, points, s, tolerance, h, scale):
    """The states at the points in time; f does not depend on time."""
    c, a, top = radau(s)
    n = len(y)
    t, found, steps = mpf(0), [list(y)], 0
    for end in points:
        end = mpf(end)
        while t < end:
            last = end - t <= h * mpf("1.0001")
            step = end - t if last else min(h, (end - t) / 2)
            jac = jacobian(f, y)
            hf = float(step)
            size = n * s
            m = [[0.0] * size for _ in range(size)]
            for i in range(s):
                for k in range(n):
                    row = m[i * n + k]
                    for j in range(s):
                        w = -hf * float(a[i][j])
                        for l in range(n):
                            row[j * n + l] = w * jac[k][l]
                    row[i * n + k] += 1.0
            lu = factor(m)
            z = [[mpf(0)] * n for _ in range(s)]
            good, before = False, None
            for k in range(60):
                slopes = [f([y0 + dz for y0, dz in zip(y, zi)]) for zi in z]
                r = []
                for i in range(s):
                    for l in range(n):
                        r.append(step * sum(a[i][j] * slopes[j][l] for j in range(s)) - z[i][l])
                greatest = max(abs(x) for x in r)
                unit = greatest if greatest > 0 else mpf(1)
                d = back(lu, [float(x / unit) for x in r])
                change = mpf(0)
                for i in range(s):
                    for l in range(n):
                        dz = unit * mpf(d[i * n + l])
                        z[i][l] += dz
                        change = max(change, abs(dz) / scale[l])
                if change < mpf(10) ** -31:
                    good = True
                    break
                if change > 1e3 or (before is not None and change > before and k > 3):
                    break
                before = change
            if good:
                slopes = [f([y0 + dz for y0, dz in zip(y, zi)]) for zi in z]
                error = max(
                    abs(step * sum(top[j] * slopes[j][l] for j in range(s))) / mpf(4) ** (s - 1) / scale[l]
                    for l in range(n)
                )
                good = error < tolerance
                factor_h = (tolerance / (error + mpf(10) ** -60)) ** (mpf(1) / s) * mpf("0.9")
            else:
                factor_h = mpf("0.4")
            if not good:
                h = step * min(factor_h, mpf("0.7"))
                continue
            y = [y0 + dz for y0, dz in zip(y, z[-1])]
            t = end if last else t + step
            h = max(step, h if last else 0) if last and factor_h >= 1 else step * min(factor_h, mpf(3))
            steps += 1
        found.append(list(y))
    return found, steps


# The governor: see `models/stiff.rs`.
GOVERNOR = {
    "g": "9.81",  # m/s^2
    "inertia": "0.05",  # kg m^2, of the spindle
    "offset": "0.05",  # m, of the hinges from the axis
    "length": "0.3",  # m, of the arms
    "ball": "0.5",  # kg
    "sleeve": "1.0",  # kg
    "knee": "0.2",  # m, on the arm from its hinge to the link
    "link": "0.2",  # m, natural length of a link
    "stiffness": "1e7",  # N/m
    "damping": "5e4",  # N s/m
    "gain": "0.5",  # N m s, of the drive
    "speed": "9.0",  # rad/s
}
GOVERNOR_START = ["0.0", "0.3", "0.301", "-0.382", "6.0", "0.0", "0.0", "0.0"]
GOVERNOR_TIMES = ["1e-6", "1e-5", "1e-4", "1e-3", "0.01", "0.1", "0.25", "0.5", "0.75", "1.0", "1.5", "2.0"]


def governor(p):
    p = {k: mpf(v) for k, v in p.items()}
    g, e, l, m, a = p["g"], p["offset"], p["length"], p["ball"], p["knee"]

    def slope(y):
        _, th1, th2, s, w, w1, w2, vs = y
        inertia, rate, sleeve = p["inertia"], mpf(0), -p["sleeve"] * g
        accel = []
        for th, wt in ((th1, w1), (th2, w2)):
            sn, cs = sin(th), cos(th)
            rho = e + l * sn
            inertia += m * rho**2
            rate += 2 * m * rho * l * cs * wt * w
            # from the sleeve to the knee
            dr, dz = a * sn, -a * cs - s
            length = sqrt(dr * dr + dz * dz)
            by_th, by_s = (dr * a * cs + dz * a * sn) / length, -dz / length
            force = -p["stiffness"] * (length - p["link"]) - p["damping"] * (by_th * wt + by_s * vs)
            accel.append((m * rho * l * cs * w * w - m * g * l * sn + force * by_th) / (m * l * l))
            sleeve += force * by_s
        torque = p["gain"] * (p["speed"] - w)
        return [w, w1, w2, vs, (torque - rate) / inertia, accel[0], accel[1], sleeve / p["sleeve"]]

    return slope


VAN_DER_POL = {"mu": "1e-6", "q": "2.0", "v": "-0.66", "times": ["1.0", "2.0"]}


def van_der_pol(y):
    q, v = y
    return [v, ((1 - q * q) * v - q) / mpf(VAN_DER_POL["mu"])]


def twice(name, f, y, points, scale, h):
    y = [mpf(x) for x in y]
    runs = []
    for s, tolerance in ((9, mpf(10) ** -17), (11, mpf(10) ** -19)):
        found, steps = solve(f, y, points, s, tolerance, mpf(h), [mpf(x) for x in scale])
        print(name, "stages", s, "steps", steps, file=sys.stderr, flush=True)
        runs.append(found)
    worst = max(abs(a - b) / (1 + abs(b)) for one, two in zip(*runs) for a, b in zip(one, two))
    print(name, "both runs agree to", nstr(worst, 3), file=sys.stderr, flush=True)
    return runs[1], worst


def main():
    which = sys.argv[1:] or ["van_der_pol", "governor"]
    if "van_der_pol" in which:
        found, worst = twice("van_der_pol", van_der_pol, ["2.0", "-0.66"], VAN_DER_POL["times"], ["1", "1"], "1e-7")
        points = [{"t": t, "y": [nstr(x, 25) for x in y]} for t, y in zip(["0"] + VAN_DER_POL["times"], found)]
        data = {
            "problem": "Van der Pol's oscillator in slow time, mu q'' = (1 - q^2) q' - q, y = (q, v)",
            "parameters": {"mu": VAN_DER_POL["mu"]},
            "agreement": nstr(worst, 3),
            "points": points,
        }
        (HERE / "data/motion/van_der_pol.json").write_text(json.dumps(data, indent=1) + "\n")
    if "governor" in which:
        slope = governor(GOVERNOR)
        scale = ["1"] * 8
        found, worst = twice("governor", slope, GOVERNOR_START, GOVERNOR_TIMES, scale, "1e-8")
        points = [{"t": t, "y": [nstr(x, 25) for x in y]} for t, y in zip(["0"] + GOVERNOR_TIMES, found)]
        data = {
            "problem": "Centrifugal governor with stiff links, y = (spindle, arm 1, arm 2, sleeve, their rates)",
            "parameters": GOVERNOR,
            "agreement": nstr(worst, 3),
            "points": points,
        }
        (HERE / "data/motion/governor.json").write_text(json.dumps(data, indent=1) + "\n")


if __name__ == "__main__":
    main()
