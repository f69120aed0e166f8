"""Writes the serial arms of `data/robots/*.model.json` as MJCF into `data/robots/*.xml`.

A frame's matrix becomes a quaternion, principal and other inertias are `fullinertia`. The base is the world, the tool a site.

Run it in `tests/`: `python3 scripts/mjcf.py`
"""

import json
import math
from pathlib import Path

HERE = Path(__file__).resolve().parent.parent
ARMS = ["double_pendulum", "cart5", "puma560", "panda"]


def vector(values):
    """The shortest decimals that read back as the same f64."""
    return " ".join(repr(float(value)) for value in values)


def quaternion(rows):
    """w, x, y, z by the largest of the four, so that no small number divides."""
    trace = [1 + rows[0][0] + rows[1][1] + rows[2][2]]
    trace += [1 + 2 * rows[k][k] - rows[0][0] - rows[1][1] - rows[2][2] for k in range(3)]
    off = [rows[2][1] - rows[1][2], rows[0][2] - rows[2][0], rows[1][0] - rows[0][1]]
    sums = [[trace[0], *off]]
    for k in range(3):
        sums.append([off[k]] + [trace[k + 1] if i == k else rows[i][k] + rows[k][i] for i in range(3)])
    chosen = sums[max(range(4), key=lambda k: trace[k])]
    length = math.sqrt(sum(value * value for value in chosen))
    return vector(value / length for value in chosen)


def place(placement):
    return f'pos="{vector(placement["p"])}" quat="{quaternion(placement["R"])}"'


def bodies(data, parent, indent):
    lines = []
    for k, joint in enumerate(data["joints"]):
        if joint["parent"] != parent:
            continue
        pad = "  " * indent
        inertia = joint["inertia_com"]
        full = vector(inertia[a][b] for a, b in [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)])
        axis = vector([1 if joint["type"][1] == letter else 0 for letter in "XYZ"])
        kind = {"R": "hinge", "P": "slide"}[joint["type"][0]]
        lines += [f'{pad}<body name="link{k + 1}" {place(joint["placement"])}>']
        lines += [f'{pad}  <inertial pos="{vector(joint["com"])}" mass="{joint["mass"]!r}" fullinertia="{full}"/>']
        lines += [f'{pad}  <joint name="joint{k + 1}" type="{kind}" axis="{axis}"/>']
        lines += [f'{pad}  <geom type="sphere" size="0.05"/>']
        if data["ee"]["parent"] == k:
            lines += [f'{pad}  <site name="tool" {place(data["ee"])}/>']
        lines += bodies(data, k, indent + 1) + [f"{pad}</body>"]
    return lines


def arm(data):
    head = [f'<mujoco model="{data["name"]}">', '  <compiler angle="radian"/>', "  <worldbody>"]
    return "\n".join(head + bodies(data, -1, 2) + ["  </worldbody>", "</mujoco>"]) + "\n"


def main():
    for name in ARMS:
        data = json.loads((HERE / f"data/robots/{name}.model.json").read_text())
        (HERE / f"data/robots/{name}.xml").write_text(arm(data))


main()
