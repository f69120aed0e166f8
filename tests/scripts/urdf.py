"""Writes the serial arms of `data/robots/*.model.json` as URDF into `data/robots/*.urdf`.

A frame's matrix becomes roll, pitch and yaw; whole quarter turns have eleven digits, as files in the wild have them. The base
and the tool are links without inertia.

Run it in `tests/`: `python3 scripts/urdf.py`
"""

import json
import math
from pathlib import Path

HERE = Path(__file__).resolve().parent.parent
ARMS = ["double_pendulum", "cart5", "puma560", "panda"]


def number(value):
    """The shortest decimal that reads back as the same f64."""
    return repr(float(value))


def vector(values):
    return " ".join(number(value) for value in values)


def angle(value):
    turns = round(value / (math.pi / 2))
    if turns and abs(value - turns * math.pi / 2) < 1e-12:
        return f"{value:.11f}"
    return number(value)


def origin(placement):
    rows = placement["R"]
    roll = math.atan2(rows[2][1], rows[2][2])
    pitch = math.atan2(-rows[2][0], math.hypot(rows[2][1], rows[2][2]))
    yaw = math.atan2(rows[1][0], rows[0][0])
    rpy = " ".join(angle(value) for value in (roll, pitch, yaw))
    return f'<origin xyz="{vector(placement["p"])}" rpy="{rpy}"/>'


def link(name, joint):
    inertia = joint["inertia_com"]
    places = {"ixx": (0, 0), "ixy": (0, 1), "ixz": (0, 2), "iyy": (1, 1), "iyz": (1, 2), "izz": (2, 2)}
    entries = " ".join(f'{key}="{number(inertia[a][b])}"' for key, (a, b) in places.items())
    return [
        f'  <link name="{name}">',
        "    <inertial>",
        f'      <origin xyz="{vector(joint["com"])}"/>',
        f'      <mass value="{number(joint["mass"])}"/>',
        f"      <inertia {entries}/>",
        "    </inertial>",
        "    <visual><geometry><sphere radius=\"0.05\"/></geometry></visual>",
        "  </link>",
    ]


def arm(data):
    lines = ['<?xml version="1.0"?>', f'<robot name="{data["name"]}">', '  <link name="base"/>']
    for k, joint in enumerate(data["joints"], 1):
        kind = {"R": "continuous", "P": "prismatic"}[joint["type"][0]]
        parent = "base" if joint["parent"] < 0 else f"link{joint['parent'] + 1}"
        axis = vector([1 if joint["type"][1] == letter else 0 for letter in "XYZ"])
        lines += link(f"link{k}", joint)
        lines += [f'  <joint name="joint{k}" type="{kind}">', f"    {origin(joint['placement'])}"]
        lines += [f'    <parent link="{parent}"/>', f'    <child link="link{k}"/>', f'    <axis xyz="{axis}"/>', "  </joint>"]
    ee = data["ee"]
    lines += ['  <link name="tool"/>', '  <joint name="flange" type="fixed">', f"    {origin(ee)}"]
    lines += [f'    <parent link="link{ee["parent"] + 1}"/>', '    <child link="tool"/>', "  </joint>", "</robot>"]
    return "\n".join(lines) + "\n"


def main():
    for name in ARMS:
        data = json.loads((HERE / f"data/robots/{name}.model.json").read_text())
        (HERE / f"data/robots/{name}.urdf").write_text(arm(data))


main()
