"""Writes twelve seeded random mechanisms: as macro calls into `models/random.rs`, as numbers into `data/random.json`.

Trees of three to eight bodies, all joint kinds, axes and frames at random on both sides of every joint. Half of the frames
turn by quarters, as most drawings do.

Run it in `tests/`: `python3 scripts/random_models.py`
"""

import json
import math
from pathlib import Path
from random import Random

HERE = Path(__file__).resolve().parent.parent
KINDS = ["Revolute", "Revolute", "Prismatic", "Screw", "Cylindrical", "Universal", "Planar", "Ball", "BallAngles", "Fixed"]
AXES = {"X": [1.0, 0.0, 0.0], "Y": [0.0, 1.0, 0.0], "Z": [0.0, 0.0, 1.0]}

HEAD = """\
//! Random mechanisms as macro calls, written by `scripts/random_models.py`.

use multibody::multibody;
"""


def decimal(rng, size):
    return round(rng.uniform(-size, size), 3)


def sparse(rng, size):
    """Zeros are common in what people write."""
    return [0.0 if rng.random() < 0.4 else decimal(rng, size) for _ in range(3)]


def times(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def apply(r, v):
    return [sum(r[i][k] * v[k] for k in range(3)) for i in range(3)]


def unit(v):
    length = math.sqrt(sum(x * x for x in v))
    return [x / length for x in v]


def about(axis, angle):
    """Rodrigues' formula."""
    x, y, z = unit(axis)
    c, s = math.cos(angle), math.sin(angle)
    cross = [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]]
    outer = [[a * b for b in (x, y, z)] for a in (x, y, z)]
    return [[(c if i == j else 0.0) + (1 - c) * outer[i][j] + s * cross[i][j] for j in range(3)] for i in range(3)]


def vector(v):
    return "[" + ", ".join(repr(x) for x in v) + "]"


def some_axis(rng):
    """As text and as numbers."""
    if rng.random() < 0.6:
        name = rng.choice("XYZ")
        return name, AXES[name]
    v = [0.0, 0.0, 0.0]
    while sum(abs(x) for x in v) < 0.1:
        v = sparse(rng, 2.0)
    return vector(v), v


def frame(rng, base):
    """Steps applied to a frame, as text and as rotation and place."""
    text, rotation, place = base, about([0.0, 0.0, 1.0], 0.0), [0.0, 0.0, 0.0]
    for _ in range(rng.randrange(4)):
        kind = rng.randrange(3)
        if kind == 0:
            offset = sparse(rng, 0.6)
            text += f".at({vector(offset)})"
            place = [p + d for p, d in zip(place, apply(rotation, offset))]
        elif kind == 1:
            name, axis = some_axis(rng)
            angle = decimal(rng, 2.0)
            text += f".rotated({name}, {angle})"
            rotation = times(rotation, about(axis, angle))
        else:
            name = rng.choice("XYZ")
            turn = [[float(round(x)) for x in row] for row in about(AXES[name], rng.choice([1, 2, 3]) * math.pi / 2)]
            turn = [[x + 0.0 for x in row] for row in turn]
            text += f".oriented([{', '.join(vector(row) for row in turn)}])"
            rotation = times(rotation, turn)
    return text, rotation, place


def inertia(rng):
    d = [round(rng.uniform(0.02, 0.2), 3) for _ in range(3)]
    principal = [d[1] + d[2], d[0] + d[2], d[0] + d[1]]
    if rng.random() < 0.5:
        entries = [round(x, 6) for x in principal] + [0.0, 0.0, 0.0]
        return f"diag({', '.join(repr(x) for x in entries[:3])})", entries
    r = about([rng.gauss(0, 1) for _ in range(3)], rng.uniform(0, 3))
    tensor = lambda i, j: round(sum(r[i][k] * principal[k] * r[j][k] for k in range(3)), 6)
    entries = [tensor(0, 0), tensor(1, 1), tensor(2, 2), tensor(0, 1), tensor(0, 2), tensor(1, 2)]
    return f"inertia({', '.join(repr(x) for x in entries)})", entries


def joint(rng, kind):
    """Fields beside the frames, as text and as numbers."""
    data, text = {"kind": kind}, ""
    if kind in ["Revolute", "Prismatic", "Screw", "Cylindrical"]:
        name, axis = some_axis(rng)
        data["axis"], text = unit(axis), f", axis: {name}"
    if kind == "Planar":
        name = rng.choice("XYZ")
        data["index"], text = "XYZ".index(name), f", axis: {name}"
    if kind == "Universal":
        one, two = rng.sample("XYZ", 2)
        data["axes"], text = [AXES[one], AXES[two]], f", axes: [{one}, {two}]"
    if kind == "Screw":
        data["pitch"] = decimal(rng, 0.3)
        text += f", pitch: {data['pitch']}"
    if kind in ["Revolute", "Prismatic", "Screw"] and rng.random() < 0.25:
        data["armature"] = round(rng.uniform(0.01, 0.2), 3)
        text += f", armature: {data['armature']}"
    if kind.endswith("Angles"):
        text += ", coordinates: RollPitchYaw"
    return kind.removesuffix("Angles"), text, data


def model(number):
    rng = Random(1000 + number)
    quaternions = number < 8
    lines, bodies = [], []
    gravity = sparse(rng, 10.0) if rng.random() < 0.8 else [0.0, 0.0, 0.0]
    if any(gravity):
        lines.append(f"world {{ gravity: {vector(gravity)} }}")
    count = rng.randrange(3, 9)
    special = rng.randrange(count)
    for k in range(count):
        parent = -1 if k == 0 or rng.random() < 0.1 else rng.choice([k - 1, k - 1, rng.randrange(k)])
        kind = rng.choice(KINDS)
        if k == special:
            kind = ("Free" if parent < 0 else "Ball") if quaternions else ("FreeAngles" if parent < 0 else "BallAngles")
        elif not quaternions and kind == "Ball":
            kind = "Universal"
        mass, com = round(rng.uniform(0.5, 3.0), 3), sparse(rng, 0.5)
        shape, tensor = inertia(rng)
        lines.append(f"body b{k} {{ mass: {mass}, com: {vector(com)}, inertia: {shape} }}")
        word, fields, data = joint(rng, kind)
        before, *at = frame(rng, "ground" if parent < 0 else f"b{parent}")
        after, *on = frame(rng, f"b{k}")
        lines.append(f"joint j{k}: {word} {{ parent: {before}, child: {after}{fields} }}")
        bodies.append({"parent": parent, "mass": mass, "com": com, "inertia": tensor, "joint": data, "at": at, "on": on})
    last, first = count - 1, rng.randrange(count)
    lines += [
        "/// [m]", f"output place = b{last}.position;",
        "/// [m/s]", f"output velocity = b{last}.velocity;",
        "/// [rad/s]", f"output omega = b{last}.angular_velocity;",
        "/// [m/s^2]", f"output acceleration = b{last}.acceleration;",
        f"/// at the child's frame of `j{first}`, in world axes", f"output reaction = j{first}.reaction;",
        "emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;",
    ]
    name = f"tree{number}"
    text = ["multibody! {", f"    /// Random mechanism number {number}.", f"    pub mod {name} {{"]
    text += ["        " + line for line in lines] + ["    }", "}"]
    return "\n".join(text) + "\n", {"gravity": gravity, "reaction": first, "bodies": bodies}


def main():
    models = [model(number) for number in range(12)]
    (HERE / "models/random.rs").write_text("\n".join([HEAD] + [text for text, _ in models]))
    (HERE / "data/random.json").write_text("[\n" + ",\n".join(json.dumps(data) for _, data in models) + "\n]\n")


main()
