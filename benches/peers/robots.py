"""The robots of the comparison, from one source of numbers, in the forms that the programs read.

`robots.py OUT` needs Pinocchio's Python package, and robot descriptions beside it. The arms come from `tests/data/robots`,
which the project's own tests read; the legged robots from published descriptions, their fixed joints merged by Pinocchio.
Of every robot it writes into OUT:

  NAME.robot   numbers as words: for Pinocchio, CasADi and the crates of `neighbours`
  NAME.urdf    for what reads nothing else
  NAME.mjb     a model of MuJoCo
  models.rs    macro calls of all robots
"""

import json
import math
import re
import sys
from pathlib import Path

import mujoco
import numpy as np
import pinocchio

HERE = Path(__file__).resolve().parent
DESCRIPTIONS = Path(sys.prefix) / "lib"
# [m/s^2] of all robots, whatever their data say: one of the crates of `neighbours` knows no other.
GRAVITY = [0.0, 0.0, -9.80665]
# Published data with inertias that no rigid body has.
UNPHYSICAL = {"puma560": [0, 2]}
# What each robot's modules emit: without inputs, and with an input for every joint.
EMITTED = {
    "puma560": ("inverse_dynamics, mass_matrix", "forward_dynamics"),
    "panda": ("inverse_dynamics, mass_matrix", "forward_dynamics, derivatives"),
    "four_legged": (None, "forward_dynamics, derivatives"),
    "humanoid": ("mass_matrix", "forward_dynamics"),
}
# What is emitted of robots whose limbs are computed together too, four or two at a time.
PACKED = {"four_legged": "forward_dynamics, derivatives", "humanoid": "forward_dynamics, mass_matrix"}


class Link:
    """A body with the joint that carries it: the joint's frame in its parent's, inertia about the centre of mass."""

    def __init__(self, parent, kind, axis, turn, place, mass, com, inertia):
        self.parent, self.kind, self.axis = parent, kind, np.array(axis, float)
        self.turn, self.place = np.array(turn, float), np.array(place, float)
        self.mass, self.com, self.inertia = float(mass), np.array(com, float), np.array(inertia, float)

    def entries(self):
        return [self.inertia[a, b] for a, b in [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)]]


class Robot:
    """A tree of links, parents first; the first one may float."""

    def __init__(self, name, links):
        self.name, self.gravity, self.links = name, GRAVITY, links
        self.floats = links[0].kind == "free"
        self.joints = len(links) - self.floats


def arm(name):
    """One of the project's arms."""
    data = json.loads((HERE / f"../../tests/data/robots/{name}.model.json").read_text())
    kinds = {"R": "revolute", "P": "prismatic"}
    return Robot(name, [
        Link(
            joint["parent"], kinds[joint["type"][0]], joint["axis"], joint["placement"]["R"], joint["placement"]["p"],
            joint["mass"], joint["com"], joint["inertia_com"],
        )
        for joint in data["joints"]
    ])


def exact_quarters(text):
    """A description with all digits of quarter turns: Talos has 3.14159265359 and 1.57079632679, whose cosines are not zero.
    This library's own reader of such files does the same where it is asked to; here it is done for everybody."""

    def angles(found):
        return 'rpy="' + " ".join(map(quarter, found.group(1).split())) + '"'

    def quarter(word):
        nearest = round(float(word) / (math.pi / 2)) * math.pi / 2
        return repr(nearest) if len(word) > 6 and abs(float(word) - nearest) < 1e-10 else word

    return re.sub(r'rpy="([^"]*)"', angles, text)


def without_rounding(values):
    """What products of quarter turns leave in the place of zero."""
    return np.where(np.abs(values) < 1e-15, 0.0, values)


def described(name, file):
    """A floating robot out of the descriptions."""
    path = next(DESCRIPTIONS.glob(f"python3*/site-packages/cmeel.prefix/share/example-robot-data/robots/{file}"))
    model = pinocchio.buildModelFromXML(exact_quarters(path.read_text()), pinocchio.JointModelFreeFlyer())
    axes = {"JointModelRX": [1, 0, 0], "JointModelRY": [0, 1, 0], "JointModelRZ": [0, 0, 1]}
    links = []
    for k in range(1, model.njoints):
        kind, body, frame = model.joints[k].shortname(), model.inertias[k], model.jointPlacements[k]
        free = kind == "JointModelFreeFlyer"
        links.append(Link(
            model.parents[k] - 1, "free" if free else "revolute", [0, 0, 0] if free else axes[kind],
            without_rounding(frame.rotation), without_rounding(frame.translation), body.mass, body.lever, body.inertia,
        ))
    return Robot(name, links)


def number(value):
    """The shortest decimal that reads back as the same f64; zero has no sign."""
    return repr(float(value) + 0.0)


def vector(values):
    return "[" + ", ".join(number(value) for value in values) + "]"


def words(robot):
    lines = [f"{robot.name} {len(robot.links)} " + " ".join(number(g) for g in robot.gravity)]
    for link in robot.links:
        numbers = [*link.axis, *link.turn.flatten(), *link.place, link.mass, *link.com, *link.entries()]
        lines.append(" ".join([str(link.parent), link.kind, *(number(value) for value in numbers)]))
    return "\n".join(lines) + "\n"


def module(robot, driven, packed=False):
    """A macro call."""
    lines = ["multibody! {", f"    pub mod {robot.name}{'_packed' if packed else '_driven' if driven else ''} {{"]
    items = [f"world {{ gravity: {vector(robot.gravity)} }}"]
    if packed:
        items.append("formulation { packs: Four }")
    if driven:
        items.append(f"input torque: [Scalar; {robot.joints}];")
    for k, link in enumerate(robot.links):
        if k in UNPHYSICAL.get(robot.name, []):
            items.append("#[allow(unphysical_inertia)]")
        inertia = ", ".join(number(value) for value in link.entries())
        items.append(
            f"body link{k} {{ mass: {number(link.mass)}, com: {vector(link.com)}, inertia: inertia({inertia}) }}"
        )
        parent = "ground" if link.parent < 0 else f"link{link.parent}"
        if link.kind == "free":
            items.append(f"joint float: Free {{ parent: {parent}, child: link{k} }}")
            continue
        if link.place.any():
            parent += f".at({vector(link.place)})"
        if (link.turn != np.eye(3)).any():
            parent += f".oriented([{', '.join(vector(row) for row in link.turn)}])"
        kind = link.kind.capitalize()
        items.append(f"joint joint{k}: {kind} {{ parent: {parent}, child: link{k}, axis: {vector(link.axis)} }}")
        if driven:
            items.append(f"force motor{k}: Effort {{ joint: joint{k}, value: torque[{k - robot.floats}] }}")
    items.append(f"emit {PACKED[robot.name] if packed else EMITTED[robot.name][driven]};")
    return "\n".join(lines + ["        " + item for item in items] + ["    }", "}"]) + "\n"


def models(robots):
    text = "// Written by `robots.py`.\n"
    for robot in robots:
        for driven in [False, True]:
            if EMITTED[robot.name][driven]:
                text += "\n" + module(robot, driven)
        if robot.name in PACKED:
            text += "\n" + module(robot, True, packed=True)
    return text


def urdf(robot):
    """Joints turn by roll, pitch and yaw there, so rotations come out with the rounding of three sines and cosines."""
    lines = [f'<robot name="{robot.name}">']
    if not robot.floats:
        lines.append('<link name="link-1"/>')
    for k, link in enumerate(robot.links):
        names = ["ixx", "iyy", "izz", "ixy", "ixz", "iyz"]
        inertia = " ".join(f'{name}="{number(value)}"' for name, value in zip(names, link.entries()))
        lines.append(
            f'<link name="link{k}"><inertial><origin xyz="{" ".join(map(number, link.com))}"/>'
            f'<mass value="{number(link.mass)}"/><inertia {inertia}/></inertial></link>'
        )
        if link.kind == "free":
            continue
        angles = pinocchio.rpy.matrixToRpy(link.turn)
        lines.append(
            f'<joint name="joint{k}" type="{"continuous" if link.kind == "revolute" else "prismatic"}">'
            f'<origin xyz="{" ".join(map(number, link.place))}" rpy="{" ".join(map(number, angles))}"/>'
            f'<parent link="link{link.parent}"/><child link="link{k}"/><axis xyz="{" ".join(map(number, link.axis))}"/>'
            '<limit lower="-10" upper="10" effort="1000" velocity="1000"/></joint>'
        )
    return "\n".join(lines + ["</robot>"]) + "\n"


def quaternion(turn):
    x, y, z, w = pinocchio.Quaternion(np.array(turn)).coeffs()
    return [w, x, y, z]


def mjb(robot, path):
    """Masses are set in the compiled model, whose compiler would refuse inertias that no rigid body has."""
    children = {k: [] for k in range(-1, len(robot.links))}
    for k, link in enumerate(robot.links):
        children[link.parent].append(k)

    def body(k):
        link = robot.links[k]
        joint = {"free": "<freejoint/>", "revolute": "hinge", "prismatic": "slide"}[link.kind]
        if link.kind != "free":
            joint = f'<joint type="{joint}" axis="{" ".join(map(number, link.axis))}"/>'
        inside = "".join(body(child) for child in children[k])
        return (
            f'<body pos="{" ".join(map(number, link.place))}" quat="{" ".join(map(number, quaternion(link.turn)))}">'
            f'{joint}<inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>{inside}</body>'
        )

    tree = "".join(body(k) for k in children[-1])
    gravity = " ".join(map(number, robot.gravity))
    model = mujoco.MjModel.from_xml_string(
        f'<mujoco><option gravity="{gravity}"/><worldbody>{tree}</worldbody></mujoco>'
    )
    # Bodies are numbered in depth-first order, behind the world; so are links of Pinocchio's trees.
    for k, link in enumerate(robot.links):
        assert model.body_parentid[k + 1] == link.parent + 1
        moments, axes = np.linalg.eigh(link.inertia)
        if np.linalg.det(axes) < 0:
            axes[:, 0] *= -1
        model.body_mass[k + 1], model.body_ipos[k + 1] = link.mass, link.com
        model.body_inertia[k + 1], model.body_iquat[k + 1] = moments, quaternion(axes)
    mujoco.mj_setConst(model, mujoco.MjData(model))
    mujoco.mj_saveModel(model, str(path))


def main():
    out = Path(sys.argv[1])
    out.mkdir(parents=True, exist_ok=True)
    robots = [
        arm("puma560"),
        arm("panda"),
        described("four_legged", "solo_description/robots/solo12.urdf"),
        described("humanoid", "talos_data/robots/talos_reduced.urdf"),
    ]
    for robot in robots:
        (out / f"{robot.name}.robot").write_text(words(robot))
        (out / f"{robot.name}.urdf").write_text(urdf(robot))
        mjb(robot, out / f"{robot.name}.mjb")
    text, file = models(robots), out / "models.rs"
    # Unchanged, it stays as old as it is: nothing is built anew.
    if not file.exists() or file.read_text() != text:
        file.write_text(text)


main()
