"""Reference motions for `examples/tradeoff`: writes `../examples/tradeoff/data/references.txt`.

Computed here, from published equations and not from this project's code: the arm (recursive Newton-Euler and composite
rigid body after Featherstone, Rigid Body Dynamics Algorithms, 2008), the four-bar (Lagrange's equation in the crank's
angle), and the platform (Newton's and Euler's equations of the plate, Lagrange's of each leg in the vector along it).
Copied from `data`, each with its own verification: the pendulum, both double pendulums, the free body, Andrews' squeezer,
the governor.

Integration: extrapolation of the modified midpoint rule (Gragg, Bulirsch, Stoer), 160 bits, in two runs of different steps
that must agree to 25 digits.

Run it in `tests/`: `python3 scripts/tradeoff.py` (takes minutes; needs gmpy2).
"""

import json
import sys
from pathlib import Path

import gmpy2
from gmpy2 import mpfr

gmpy2.get_context().precision = 160
HERE = Path(__file__).resolve().parent.parent
DIGITS = 28


# Extrapolation.

def midpoint(f, y, length, parts, start):
    """The modified midpoint rule with Gragg's smoothing left out: `parts` is even."""
    h = length / parts
    before, now = y, [a + h * b for a, b in zip(y, start)]
    double = 2 * h
    for _ in range(parts - 1):
        slope = f(now)
        before, now = now, [a + double * b for a, b in zip(before, slope)]
    return now


def extrapolated(f, y, length, columns):
    """One step: columns 2, 4, 6, .. of the harmonic sequence, by Aitken and Neville."""
    start = f(y)
    row = []
    for k in range(columns):
        parts = 2 * (k + 1)
        new = [midpoint(f, y, length, parts, start)]
        for j in range(1, k + 1):
            ratio = mpfr(parts) / (parts - 2 * j)
            weight = 1 / (ratio * ratio - 1)
            new.append([a + (a - b) * weight for a, b in zip(new[j - 1], row[j - 1])])
        row = new
    return row[-1]


def motion(f, y, times, step, columns):
    """States at the times, the first of which is the start."""
    states = [y]
    for begin, end in zip(times, times[1:]):
        count = int(gmpy2.ceil((end - begin) / step))
        for _ in range(count):
            y = extrapolated(f, y, (end - begin) / count, columns)
        states.append(y)
    return states


def verified(name, f, y, times, step, columns):
    coarse = motion(f, y, times, step, columns)
    fine = motion(f, y, times, step * mpfr("0.7"), columns)
    differences = [abs(a - b) / (1 + abs(b)) for u, v in zip(coarse, fine) for a, b in zip(u, v)]
    print(f"{name}: two runs agree to {float(max(differences)):.1e}", flush=True)
    if not all(difference <= 1e-25 for difference in differences):
        sys.exit("not enough")
    return fine


# The arm.

def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def add(a, b):
    return [a[0] + b[0], a[1] + b[1], a[2] + b[2]]


def scaled(a, s):
    return [a[0] * s, a[1] * s, a[2] * s]


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def times_vector(m, v):
    return [dot(row, v) for row in m]


def transposed_times(m, v):
    return [m[0][k] * v[0] + m[1][k] * v[1] + m[2][k] * v[2] for k in range(3)]


class Arm:
    """Revolute joints about the z axes of their frames; gravity along -z of the world."""

    def __init__(self, file):
        model = json.loads(file.read_text())
        decimal = lambda value: mpfr(repr(round(value, 16)))  # the decimals that the file's numbers come from
        vector = lambda values: [decimal(value) for value in values]
        self.joints = [
            (
                [vector(row) for row in joint["placement"]["R"]],
                vector(joint["placement"]["p"]),
                decimal(joint["mass"]),
                vector(joint["com"]),
                [vector(row) for row in joint["inertia_com"]],
            )
            for joint in model["joints"]
        ]
        self.gravity = mpfr("9.81")
        # [N m s/rad] in the joints
        self.damping = [mpfr(text) for text in "2 2 1 1 0.4 0.4 0.2".split()]

    def frames(self, q):
        """Rotation from each link to its parent."""
        rotations = []
        for (placement, *_), angle in zip(self.joints, q):
            s, c = gmpy2.sin_cos(angle)
            rotations.append([[r[0] * c + r[1] * s, r[1] * c - r[0] * s, r[2]] for r in placement])
        return rotations

    def bias(self, rotations, v):
        """Recursive Newton-Euler without accelerations of the joints: table 5.1."""
        zero = mpfr(0)
        w, dw, a = [zero] * 3, [zero] * 3, [zero, zero, self.gravity]
        forces, moments = [], []
        for (_, place, mass, com, inertia), r, rate in zip(self.joints, rotations, v):
            a = add(a, add(cross(dw, place), cross(w, cross(w, place))))
            w, dw, a = (transposed_times(r, x) for x in (w, dw, a))
            # The joint turns about z: w x z * rate, and no acceleration of its own.
            dw = add(dw, [w[1] * rate, -w[0] * rate, zero])
            w = [w[0], w[1], w[2] + rate]
            centre = add(a, add(cross(dw, com), cross(w, cross(w, com))))
            force = scaled(centre, mass)
            moment = add(times_vector(inertia, dw), cross(w, times_vector(inertia, w)))
            forces.append(force)
            moments.append(add(moment, cross(com, force)))
        efforts = [None] * len(v)
        force, moment = [zero] * 3, [zero] * 3
        for k in reversed(range(len(v))):
            force, moment = add(forces[k], force), add(moments[k], moment)
            efforts[k] = moment[2]
            place = self.joints[k][1]
            force, moment = times_vector(rotations[k], force), times_vector(rotations[k], moment)
            moment = add(moment, cross(place, force))
        return efforts

    def mass_matrix(self, rotations):
        """Composite rigid body: table 6.2, with (mass, first moment, inertia about the link's origin)."""
        n = len(rotations)
        zero = mpfr(0)
        composite = []
        for _, _, mass, com, inertia in self.joints:
            composite.append((mass, scaled(com, mass), shifted(inertia, com, mass)))
        matrix = [[zero] * n for _ in range(n)]
        for k in reversed(range(n)):
            mass, first, inertia = composite[k]
            # Force and moment about the origin for a unit acceleration about z.
            force, moment = cross([zero, zero, mpfr(1)], first), [row[2] for row in inertia]
            matrix[k][k] = moment[2]
            for j in reversed(range(k)):
                place, r = self.joints[j + 1][1], rotations[j + 1]
                force, moment = times_vector(r, force), times_vector(r, moment)
                moment = add(moment, cross(place, force))
                matrix[k][j] = matrix[j][k] = moment[2]
            if k:
                r, place = rotations[k], self.joints[k][1]
                first = times_vector(r, first)
                turned = [times_vector(r, column) for column in zip(*[times_vector(r, row) for row in inertia])]
                # About the parent's origin: I - m (terms of com) + m (terms of com + place).
                inertia = moved(turned, first, place, mass)
                m0, f0, i0 = composite[k - 1]
                first = add(first, scaled(place, mass))
                total = [[a + b for a, b in zip(u, v)] for u, v in zip(i0, inertia)]
                composite[k - 1] = (m0 + mass, add(f0, first), total)
        return matrix

    def slope(self, y):
        n = len(y) // 2
        q, v = y[:n], y[n:]
        rotations = self.frames(q)
        efforts = [-b - d * rate for b, d, rate in zip(self.bias(rotations, v), self.damping, v)]
        return v + solved(self.mass_matrix(rotations), efforts)


def shifted(inertia, com, mass):
    """About a point from which the centre of mass is at `com`."""
    square = dot(com, com)
    return [
        [inertia[i][j] + mass * ((square if i == j else 0) - com[i] * com[j]) for j in range(3)] for i in range(3)
    ]


def moved(inertia, first, place, mass):
    """About the origin at `-place`: the first moment is about the old one."""
    along = 2 * dot(first, place) + mass * dot(place, place)
    return [
        [
            inertia[i][j] + (along if i == j else 0) - first[i] * place[j] - place[i] * first[j] - mass * place[i] * place[j]
            for j in range(3)
        ]
        for i in range(3)
    ]


def solved(matrix, right):
    """By Cholesky's factors without roots, in place."""
    n = len(right)
    a, x = [row[:] for row in matrix], right[:]
    for k in range(n):
        for i in range(k + 1, n):
            factor = a[i][k] / a[k][k]
            for j in range(k + 1, n):
                a[i][j] -= factor * a[k][j]
            x[i] -= factor * x[k]
    for k in reversed(range(n)):
        for j in range(k + 1, n):
            x[k] -= a[k][j] * x[j]
        x[k] /= a[k][k]
    return x


def panda():
    robot = Arm(HERE / "data/robots/panda.model.json")
    sample = json.loads((HERE / "data/robots/panda.samples.json").read_text())
    check(robot, sample)
    start = [mpfr(text) for text in "0 -0.785 0 -2.356 0 1.571 0.785".split()]
    start += [mpfr(text) for text in "0.5 -0.3 0.2 0.4 -0.6 0.3 0.1".split()]
    times = [mpfr(k) / 4 for k in range(9)]
    return times, verified("panda", robot.slope, start, times, mpfr(1) / 96, 14)


def check(robot, samples):
    """Against the samples of another library."""
    listed = samples if isinstance(samples, list) else samples["samples"]
    worst = 0
    for sample in listed:
        q, v = ([mpfr(x) for x in sample[name]] for name in ("q", "v"))
        rotations = robot.frames(q)
        bias, mass = robot.bias(rotations, v), robot.mass_matrix(rotations)
        worst = max(worst, max(abs(a - b) for a, b in zip(bias, sample["nle"])) / max(map(abs, sample["nle"])))
        flat = [(a - b) for u, w in zip(mass, sample["M"]) for a, b in zip(u, w)]
        worst = max(worst, max(map(abs, flat)))
    print(f"panda: bias and mass matrix agree with the samples to {float(worst):.1e}")


# The four-bar: crank 1, coupler 3.5, rocker 3, base 4; uniform rods of one kilogram per metre; gravity along -y.

class FourBar:
    CRANK, COUPLER, ROCKER, BASE = mpfr(1), mpfr("3.5"), mpfr(3), mpfr(4)
    GRAVITY = mpfr("9.81")

    def angles(self, crank):
        """Of coupler and rocker in the plane, the open branch: circles about the crank's tip and the rocker's pivot."""
        s, c = gmpy2.sin_cos(crank)
        dx, dy = self.BASE - self.CRANK * c, -self.CRANK * s
        square = dx * dx + dy * dy
        along = (square + self.COUPLER**2 - self.ROCKER**2) / 2
        aside = gmpy2.sqrt(self.COUPLER**2 * square - along**2)
        pin = ((along * dx - aside * dy) / square, (along * dy + aside * dx) / square)
        return gmpy2.atan2(pin[1], pin[0]), gmpy2.atan2(pin[1] - dy, pin[0] - dx)

    def ratios(self, crank):
        """Derivatives of these angles by the crank's, first and second."""
        coupler, rocker = self.angles(crank)
        (s1, c1), (s2, c2), (s3, c3) = map(gmpy2.sin_cos, (crank, coupler, rocker))
        a, b, c = self.CRANK, self.COUPLER, self.ROCKER
        # a e(crank) + b e(coupler) = base + c e(rocker), differentiated: b k2 e'(coupler) - c k3 e'(rocker) = -a e'(crank)
        det = b * c * (s2 * c3 - c2 * s3)
        def solve(x, y):
            return (c * (x * c3 + y * s3)) / -det, (b * (x * c2 + y * s2)) / -det
        k2, k3 = solve(a * s1, -a * c1)
        # And once more: -a e(crank) - b k2^2 e(coupler) + c k3^2 e(rocker) is left over.
        x = a * c1 + b * k2 * k2 * c2 - c * k3 * k3 * c3
        y = a * s1 + b * k2 * k2 * s2 - c * k3 * k3 * s3
        l2, l3 = solve(x, y)
        return coupler, rocker, k2, k3, l2, l3

    def quantities(self, crank):
        """Inertia seen by the crank, its derivative by the crank's angle, potential energy and its derivative."""
        coupler, rocker, k2, k3, l2, l3 = self.ratios(crank)
        a, b, c = self.CRANK, self.COUPLER, self.ROCKER
        ma, mb, mc = a, b, c
        (s1, c1), (s2, c2), (s3, c3) = map(gmpy2.sin_cos, (crank, coupler, rocker))
        turn = gmpy2.cos(coupler - crank)
        bend = -gmpy2.sin(coupler - crank) * (k2 - 1)
        inertia = ma * a**2 / 3 + mc * c**2 / 3 * k3**2 + mb * (a**2 + a * b * k2 * turn + b**2 / 3 * k2**2)
        change = 2 * mc * c**2 / 3 * k3 * l3 + mb * (a * b * (l2 * turn + k2 * bend) + 2 * b**2 / 3 * k2 * l2)
        g = self.GRAVITY
        height = ma * a / 2 * s1 + mc * c / 2 * s3 + mb * (a * s1 + b / 2 * s2)
        slope = ma * a / 2 * c1 + mc * c / 2 * c3 * k3 + mb * (a * c1 + b / 2 * c2 * k2)
        return inertia, change, g * height, g * slope

    def slope(self, y):
        inertia, change, _, fall = self.quantities(y[0])
        return [y[1], -(change * y[1] ** 2 / 2 + fall) / inertia]

    def energy(self, y):
        inertia, _, potential, _ = self.quantities(y[0])
        return inertia * y[1] ** 2 / 2 + potential


def four_bar():
    bar = FourBar()
    coupler, rocker = bar.angles(mpfr(1))
    print(f"four_bar: angles at 1 rad {coupler:.20f} {rocker:.20f}, to be 0.63894790778706746664 1.7892514033875247661")
    start = [mpfr(0), mpfr(6)]
    times = [mpfr(k) / 4 for k in range(17)]
    states = verified("four_bar", bar.slope, start, times, mpfr(1) / 128, 14)
    drift = abs(bar.energy(states[-1]) - bar.energy(start))
    print(f"four_bar: energy changes by {float(drift):.1e} J")
    full = []
    for crank, rate in states:
        coupler, rocker, k2, k3, _, _ = bar.ratios(crank)
        full.append([crank, coupler, rocker, rate, k2 * rate, k3 * rate])
    return times, full


# The Stewart-Gough platform on six springs with dampers.

class Platform:
    """A plate of isotropic inertia on straight legs without inertia about their axes, each a function of the vector d from
    its foot to its pin alone: with L = |d|, u = d / L, w = u . d', the energy is a (d'^2 - w^2) / 2 + m w^2 / 2, where
    a L^2 is the moment of inertia of cylinder and piston about the foot and m the piston's mass."""

    MASS, INERTIA, GRAVITY = mpfr("1.5"), mpfr("0.08"), mpfr("9.80665")
    PART, HALF, TURNING = mpfr("0.1"), mpfr("0.5"), mpfr("0.00625")
    THRUST, STIFFNESS, DAMPING, REST = mpfr("7.2"), mpfr(200), mpfr(5), mpfr("0.262")
    FEET = [
        [mpfr(text) for text in foot.split()]
        for foot in ("-2.12 1.374 0", "-2.38 1.224 0", "-2.38 -1.224 0", "-2.12 -1.374 0", "0 -0.15 0", "0 0.15 0")
    ]
    PINS = [
        [mpfr(text) for text in pin.split()]
        for pin in (
            "0.17 0.595 -0.4", "-0.6 0.15 -0.4", "-0.6 -0.15 -0.4", "0.17 -0.595 -0.4", "0.43 -0.445 -0.4", "0.43 0.445 -0.4"
        )
    ]

    def axes(self, angles):
        """World axes of the rates of roll, pitch and yaw, and the rotation."""
        (sr, cr), (sp, cp), (sy, cy) = map(gmpy2.sin_cos, angles)
        zero, one = mpfr(0), mpfr(1)
        rotation = [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]
        return [[cy * cp, sy * cp, -sp], [-sy, cy, zero], [zero, zero, one]], rotation

    def spin(self, angles, rates):
        """The angular velocity."""
        axes, _ = self.axes(angles)
        return transposed_times(axes, rates)

    def rates(self, angles, spin):
        """Of the angles."""
        axes, _ = self.axes(angles)
        return solved([[axes[j][i] for j in range(3)] for i in range(3)], spin)

    def slope(self, y):
        """Of place, angles, velocity and angular velocity."""
        place, angles, velocity, spin = (y[k : k + 3] for k in (0, 3, 6, 9))
        _, rotation = self.axes(angles)
        zero = mpfr(0)
        matrix = [[self.MASS if i == j else zero for j in range(3)] + [zero] * 3 for i in range(3)]
        matrix += [[zero] * 3 + [self.INERTIA if i == j else zero for j in range(3)] for i in range(3)]
        right = [zero, zero, -self.MASS * self.GRAVITY, zero, zero, zero]
        for foot, pin in zip(self.FEET, self.PINS):
            arm = times_vector(rotation, pin)
            d = [place[k] + arm[k] - foot[k] for k in range(3)]
            turning = cross(spin, arm)
            rate = add(velocity, turning)
            length = gmpy2.sqrt(dot(d, d))
            u = scaled(d, 1 / length)
            w = dot(u, rate)
            across = dot(rate, rate) - w * w
            beyond = length - self.HALF
            moment = 2 * self.TURNING + self.PART * (self.HALF**2 + beyond**2)
            a = moment / length**2
            slope = 2 * (self.PART * beyond - moment / length) / length**2
            push = self.THRUST - self.STIFFNESS * (length - 1 - self.REST) - self.DAMPING * w
            # Lagrange: a d'' + (m - a) u (u . d'') + rest = force at the pin.
            along = (self.PART - a) * across / length - slope * (w * w + across / 2) - push
            rest = [slope * w * rate[k] + along * u[k] for k in range(3)]
            rest[2] += self.PART * self.GRAVITY
            inertia = [
                [(a if i == j else zero) + (self.PART - a) * u[i] * u[j] for j in range(3)] for i in range(3)
            ]
            rest = add(rest, times_vector(inertia, cross(spin, turning)))
            for k, value in enumerate(rest + cross(arm, rest)):
                right[k] -= value
            # d'' = p'' + dw x arm: columns of the leg's inertia by both.
            x, y_, z = arm
            by = [[zero, z, -y_], [-z, zero, x], [y_, -x, zero]]
            for i in range(3):
                for j in range(3):
                    matrix[i][j] += inertia[i][j]
                    coupling = sum(inertia[i][k] * by[k][j] for k in range(3))
                    matrix[i][3 + j] += coupling
                    matrix[3 + j][i] += coupling
                    matrix[3 + i][3 + j] += sum(
                        by[k][i] * inertia[k][m] * by[m][j] for k in range(3) for m in range(3)
                    )
        return velocity + self.rates(angles, spin) + solved(matrix, right)


def stewart():
    platform = Platform()
    pose = [mpfr(text) for text in "-1.45 0.05 1.05 0.1 -0.05 0.15".split()]
    rates = [mpfr(text) for text in "0.3 -0.2 0.4 0.5 -0.4 0.3".split()]
    start = pose + rates[:3] + platform.spin(pose[3:], rates[3:])
    times = [mpfr(k) / 4 for k in range(5)]
    states = verified("stewart", platform.slope, start, times, mpfr(1) / 128, 14)
    full = [y[:9] + platform.rates(y[3:6], y[9:]) for y in states]
    # Against the 16 digits of another derivation.
    listed = json.loads((HERE / "data/stewart/forward.json").read_text())["trajectories"]
    case = next(case for case in listed if case["name"] == "spring_damper")
    other = case["pose"][-1] + case["vel"][-1]
    apart = max(abs(float(a - b)) for a, b in zip(full[-1], other))
    print(f"stewart: 16 digits of another derivation differ by {apart:.1e}")
    if apart > 1e-13:
        sys.exit("the equations differ")
    return times, full


# What there is already.

def copied():
    """Name, time, positions and velocities, as in the files."""
    read = lambda name: json.loads((HERE / f"data/{name}.json").read_text())
    at = lambda points, t: next(point for point in points if float(point["t"]) == t)
    point = at(read("motion/a1_pendulum")["points"], 10.0)
    yield "pendulum", point["t"], [point["theta_from_down"]], [point["omega"]]
    for name, file, t in (("mild", "double_pendulum_mild", 10.0), ("chaotic", "double_pendulum", 5.0)):
        point = at(read(f"motion/{file}")["points"], t)
        yield name, point["t"], point["theta"], point["omega"]
    point = at(read("motion/rigid_dzhanibekov")["points"], 20.0)
    yield "free_body", point["t"], point["q"], point["omega"]
    point = at(read("motion/andrews")["points"], 0.05)
    yield "andrews", point["t"], point["q"], point["v"]
    state = at(read("motion/governor")["points"], 2.0)["y"]
    yield "governor", 2.0, state[:4], state[4:]


def line(name, t, q, v):
    digits = lambda value: f"{value:.{DIGITS}e}" if isinstance(value, type(mpfr(0))) else str(value)
    return f"{name} {float(t)} | {' '.join(map(digits, q))} | {' '.join(map(digits, v))}\n"


def main():
    text = "# name, time [s] | positions | velocities, in the coordinates of `tests/scripts/tradeoff.py`, which wrote this\n"
    for point in copied():
        text += line(*point)
    for name in ("stewart", "four_bar", "panda"):
        times, states = globals()[name]()
        half = len(states[0]) // 2
        text += line(name, times[-1], states[-1][:half], states[-1][half:])
    file = HERE.parent / "examples/tradeoff/data/references.txt"
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text)


if __name__ == "__main__":
    main()
