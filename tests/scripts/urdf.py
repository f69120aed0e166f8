"""Writes the serial arms of `data/robots/*.model.json` as URDF into `../cli/tests/data/urdf`.

Two files per arm. `NAME.urdf` has the numbers of the data, digit for digit. `NAME_oblique.urdf` is the same arm in other
frames: every link's frame is turned by random angles, and every inertia stands in a frame of its own, so that no
axis and no angle is a round one. The zero of every coordinate is the same.

Run it in `tests/`: `python3 scripts/urdf.py`
"""

import json
import math
import random
from pathlib import Path

HERE = Path(__file__).resolve().parent.parent
TO = HERE.parent / "cli/tests/data/urdf"
ARMS = ["double_pendulum", "cart5", "puma560", "panda"]
IDENTITY = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]


def times(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def transposed(a):
    return [list(column) for column in zip(*a)]


def applied(a, v):
    return [sum(a[i][k] * v[k] for k in range(3)) for i in range(3)]


def matrix(rpy):
    """Rz(yaw) Ry(pitch) Rx(roll)"""
    (sr, cr), (sp, cp), (sy, cy) = [(math.sin(a), math.cos(a)) for a in rpy]
    x = [[1, 0, 0], [0, cr, -sr], [0, sr, cr]]
    y = [[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]]
    z = [[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]]
    return times(z, times(y, x))


def angles(r):
    return [math.atan2(r[2][1], r[2][2]), math.atan2(-r[2][0], math.hypot(r[0][0], r[1][0])), math.atan2(r[1][0], r[0][0])]


def numbers(values):
    return " ".join(repr(float(value) + 0.0) for value in values)


def origin(p, r):
    return f'<origin xyz="{numbers(p)}" rpy="{numbers(angles(r))}"/>'


def arm(model, turn):
    """`turn()` is the orientation of a link's new frame in the old one, or of an inertia's in the link's."""
    lines = ['<?xml version="1.0"?>', f'<robot name="{model["name"]}">', '  <link name="base"/>']
    turns = []
    for k, joint in enumerate(model["joints"], 1):
        own, principal = turn(), turn()
        turns.append(own)
        back = transposed(own)
        com = applied(back, joint["com"])
        inertia = times(times(back, joint["inertia_com"]), own)
        inertia = times(times(transposed(principal), inertia), principal)
        entries = [("ixx", 0, 0), ("iyy", 1, 1), ("izz", 2, 2), ("ixy", 0, 1), ("ixz", 0, 2), ("iyz", 1, 2)]
        entries = " ".join(f'{name}="{numbers([inertia[a][b]])}"' for name, a, b in entries)
        before, parent = IDENTITY, "base"
        if joint["parent"] >= 0:
            before, parent = transposed(turns[joint["parent"]]), f"link{joint['parent'] + 1}"
        place = applied(before, joint["placement"]["p"])
        rotation = times(times(before, joint["placement"]["R"]), own)
        axis = applied(back, joint["axis"])
        kind = {"R": "revolute", "P": "prismatic"}[joint["type"][0]]
        lines += [
            f'  <link name="link{k}">',
            "    <inertial>",
            f"      {origin(com, principal)}",
            f'      <mass value="{numbers([joint["mass"]])}"/>',
            f"      <inertia {entries}/>",
            "    </inertial>",
            "  </link>",
            f'  <joint name="joint{k}" type="{kind}">',
            f"    {origin(place, rotation)}",
            f'    <parent link="{parent}"/>',
            f'    <child link="link{k}"/>',
            f'    <axis xyz="{numbers(axis)}"/>',
            '    <limit lower="-3" upper="3" effort="100" velocity="2"/>',
            "  </joint>",
        ]
    return "\n".join([*lines, "</robot>", ""])


def main():
    TO.mkdir(exist_ok=True)
    for name in ARMS:
        model = json.loads((HERE / f"data/robots/{name}.model.json").read_text())
        (TO / f"{name}.urdf").write_text(arm(model, lambda: IDENTITY))
        rng = random.Random(name)
        (TO / f"{name}_oblique.urdf").write_text(arm(model, lambda: matrix([rng.uniform(-1.5, 1.5) for _ in range(3)])))


main()
