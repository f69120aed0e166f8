"""Writes four robots as URDF into `data/robots/*.urdf`, and the same typed in into `data/robots/typed_in.rs`.

A four-legged robot, a humanoid of thirty joints with oblique axes, a biped whose ankles are four-bar linkages (URDF+), and an
arm on a rail whose second finger mimics the first. Numbers come from a seeded generator and have few digits.

Run it in `tests/`: `python3 scripts/robots.py`
"""

import random
from pathlib import Path

DATA = Path(__file__).resolve().parent.parent / "data/robots"
KINDS = {"continuous": "Revolute", "prismatic": "Prismatic", "fixed": "Fixed"}


class Robot:
    """Links and joints in both languages at once. A link is placed by `xyz` and `rpy` in its parent."""

    def __init__(self, name, seed, floats):
        self.name, self.floats, self.draw = name, floats, random.Random(seed)
        self.urdf, self.typed, self.ties = [f'<robot name="{name}">'], [], []

    def numbers(self, scale):
        return [round(scale * self.draw.uniform(-1, 1), 4) for _ in range(3)]

    def link(self, name, mass, size):
        """Some inertia that a body of this size may have."""
        com = self.numbers(0.2 * size)
        xx, yy, zz = (round(mass * size**2 * self.draw.uniform(0.1, 0.14), 7) for _ in range(3))
        xy, xz, yz = (round(mass * size**2 * self.draw.uniform(-0.01, 0.01), 7) for _ in range(3))
        self.urdf += [
            f'  <link name="{name}">',
            "    <inertial>",
            f'      <origin xyz="{words(com)}"/>',
            f'      <mass value="{mass}"/>',
            f'      <inertia ixx="{xx!r}" ixy="{xy!r}" ixz="{xz!r}" iyy="{yy!r}" iyz="{yz!r}" izz="{zz!r}"/>',
            "    </inertial>",
            "  </link>",
        ]
        entries = ", ".join(repr(entry) for entry in (xx, yy, zz, xy, xz, yz))
        self.typed += [f"body {name} {{ mass: {mass}, com: {com}, inertia: inertia({entries}) }}"]

    def joint(self, name, kind, parent, child, xyz, rpy=(0, 0, 0), axis=(0, 1, 0), more="", independent=None):
        flag = "" if independent is None else f' independent="{str(independent).lower()}"'
        self.urdf += [
            f'  <joint name="{name}" type="{kind}"{flag}>',
            f'    <origin xyz="{words(xyz)}" rpy="{words(rpy)}"/>',
            f'    <parent link="{parent}"/>',
            f'    <child link="{child}"/>',
        ]
        self.urdf += [f'    <axis xyz="{words(axis)}"/>'] if kind != "fixed" else []
        self.urdf += [f"    {more}"] if more else []
        self.urdf += ["  </joint>"]
        along = f", axis: {direction(axis)}"
        self.typed += [f"joint {name}: {KINDS[kind]} {{ parent: {frame(parent, xyz, rpy)}, child: {child}{along} }}"]

    def damped(self, name, *joint, **more):
        damping = round(self.draw.uniform(0.05, 0.5), 3)
        self.joint(name, *joint, **more, more=f'<dynamics damping="{damping}"/>')
        self.typed += [f"force {name}_damper: Damper {{ joint: {name}, damping: {damping} }}"]

    def tool(self, name, parent, xyz, rpy=(0, 0, 0)):
        """A frame: a link without inertia on a fixed joint."""
        self.urdf += [f'  <link name="{name}"/>', f'  <joint name="{name}_mount" type="fixed">']
        self.urdf += [f'    <origin xyz="{words(xyz)}" rpy="{words(rpy)}"/>']
        self.urdf += [f'    <parent link="{parent}"/>', f'    <child link="{name}"/>', "  </joint>"]
        self.typed += [f"let {name} = {frame(parent, xyz, rpy)};"]

    def loop(self, name, ends, axis):
        (predecessor, first), (successor, second) = ends
        self.urdf += [
            f'  <loop name="{name}" type="revolute">',
            f'    <predecessor link="{predecessor}"><origin xyz="{words(first)}"/></predecessor>',
            f'    <successor link="{successor}"><origin xyz="{words(second)}"/></successor>',
            f'    <axis xyz="{words(axis)}"/>',
            "  </loop>",
        ]
        ends = f"parent: {frame(predecessor, first)}, child: {frame(successor, second)}"
        self.ties += [f"#[cut] joint {name}: Revolute {{ {ends}, axis: {direction(axis)} }}"]

    def coupling(self, name, ratio, leading, following):
        """Each end is a link with the joint that it hangs on."""
        self.urdf += [
            f'  <coupling name="{name}">',
            f'    <predecessor link="{leading[0]}"/>',
            f'    <successor link="{following[0]}"/>',
            f'    <ratio value="{ratio}"/>',
            "  </coupling>",
        ]
        self.ties += [f"constraint {name} = ({ratio}) * {leading[1]}.angle - {following[1]}.angle;"]

    def write(self):
        (DATA / f"{self.name}.urdf").write_text("\n".join(['<?xml version="1.0"?>', *self.urdf, "</robot>", ""]))
        items = [f"pub mod {self.name} {{", "    world { gravity: -9.81 * Z }"]
        items += [f"    {line}" for line in self.typed + self.ties]
        return ["multibody! {", *(f"    {line}" for line in items), "        {functions}", "    }", "}"]


def words(values):
    return " ".join(repr(value) for value in values)


def direction(axis):
    for letter, unit in {"X": (1, 0, 0), "Y": (0, 1, 0), "Z": (0, 0, 1)}.items():
        if tuple(axis) == unit:
            return letter
    return str(list(axis))


def frame(parent, xyz, rpy=(0, 0, 0)):
    parent = "ground" if parent == "plate" else parent
    placed = f"{parent}.at({list(xyz)})" if any(xyz) else parent
    for letter, angle in zip("ZYX", reversed(rpy)):
        placed += f".rotated({letter}, {angle!r})" if angle else ""
    return placed


def quadruped():
    """The axes of a robot as it is built: across the trunk and along it."""
    robot = Robot("quadruped", 4, True)
    robot.link("trunk", 6.921, 0.35)
    for leg, front, side in [("fl", 1, 1), ("fr", 1, -1), ("rl", -1, 1), ("rr", -1, -1)]:
        for part, mass, size in [("hip", 0.678, 0.08), ("thigh", 1.152, 0.2), ("shank", 0.154, 0.2)]:
            robot.link(f"{leg}_{part}", mass, size)
        hip, thigh, knee = f"{leg}_abduction", f"{leg}_flexion", f"{leg}_knee"
        robot.damped(hip, "continuous", "trunk", f"{leg}_hip", [0.1934 * front, 0.0465 * side, 0.0], axis=(1, 0, 0))
        robot.damped(thigh, "continuous", f"{leg}_hip", f"{leg}_thigh", [0.0, 0.0955 * side, 0.0])
        robot.joint(knee, "continuous", f"{leg}_thigh", f"{leg}_shank", [0.0, 0.0, -0.213])
        robot.tool(f"{leg}_foot", f"{leg}_shank", [0.0, 0.0, -0.211])
    return robot


def humanoid():
    """Nothing is parallel to anything."""
    robot = Robot("humanoid", 30, True)
    robot.link("pelvis", 8.337, 0.3)

    def chain(parent, names, mass, size):
        for name in names:
            link = f"{name}_link"
            robot.link(link, round(mass * robot.draw.uniform(0.7, 1.3), 3), size)
            place, turn, axis = robot.numbers(size), robot.numbers(0.6), robot.numbers(1.0)
            robot.damped(name, "continuous", parent, link, place, turn, axis)
            parent = link
        return parent

    chest = chain("pelvis", ["waist_yaw", "waist_roll", "waist_pitch"], 4.1, 0.2)
    chain(chest, ["neck"], 2.3, 0.15)
    for side in ["left", "right"]:
        leg = ["hip_yaw", "hip_roll", "hip_pitch", "knee", "ankle_pitch", "ankle_roll"]
        arm = ["shoulder_pitch", "shoulder_roll", "shoulder_yaw", "elbow", "forearm", "wrist_pitch", "wrist_roll"]
        robot.tool(f"{side}_sole", chain("pelvis", [f"{side}_{name}" for name in leg], 2.7, 0.25), [0.03, -0.01, -0.05])
        robot.tool(f"{side}_palm", chain(chest, [f"{side}_{name}" for name in arm], 1.2, 0.18), [0.01, 0.02, 0.09], [0.3, 0.0, -0.2])
    return robot


def biped():
    """The four bars move in a plane of the shank, which is oblique to the thigh. Knees have rotors behind a gear."""
    robot = Robot("biped", 7, True)
    robot.link("pelvis", 5.713, 0.25)
    for side, sign in [("left", 1), ("right", -1)]:
        parent = "pelvis"
        place = [0.0131, 0.0952 * sign, -0.0512]
        for name, mass in [("yaw", 0.913), ("roll", 1.127), ("thigh", 2.461)]:
            link = f"{side}_{name}"
            robot.link(link, mass, 0.2)
            turn, axis = robot.numbers(0.4), robot.numbers(1.0)
            robot.damped(f"{side}_hip_{name}", "continuous", parent, link, place, turn, axis, independent=True)
            parent, place = link, robot.numbers(0.1)
        rotor, shank, foot, crank, rod = (f"{side}_{name}" for name in ["rotor", "shank", "foot", "crank", "rod"])
        robot.link(shank, 1.318, 0.25)
        robot.link(rotor, 0.214, 0.05)
        tilt = [0.031 * sign, 0.117, -0.052 * sign]
        knee, spin = f"{side}_knee", f"{side}_knee_rotor"
        robot.damped(knee, "continuous", parent, shank, [0.0123, 0.0071 * sign, -0.231], tilt, (1, 8, -2), independent=True)
        robot.joint(spin, "continuous", parent, rotor, [0.013, -0.0497, -0.0178], tilt, (1, 8, -2), independent=False)
        robot.coupling(f"{side}_gear", -6.25, (shank, knee), (rotor, spin))
        robot.link(crank, 0.107, 0.06)
        robot.link(rod, 0.093, 0.24)
        robot.link(foot, 0.571, 0.12)
        robot.damped(f"{side}_crank_drive", "continuous", shank, crank, [0.0212, 0.03125, -0.0613], independent=True)
        robot.joint(f"{side}_rod_pivot", "continuous", crank, rod, [-0.0549, 0.015625, 0.0107], independent=False)
        robot.damped(f"{side}_ankle", "continuous", shank, foot, [0.0, 0.0, -0.2891], independent=False)
        # A little off the place where all coordinates are zero.
        robot.loop(f"{side}_pin", [(rod, [0.0, 0.0, -0.2357]), (foot, [-0.0317, 0.046875, 0.0])], (0, 1, 0))
        robot.tool(f"{side}_sole", foot, [0.0271, 0.0, -0.0413])
    return robot


def rail_arm():
    """Seven joints on a slide, and a hand whose second finger follows the first."""
    robot = Robot("rail_arm", 8, False)
    # The root has no inertia: it is the ground.
    robot.urdf += ['  <link name="plate"/>']
    robot.link("carriage", 12.41, 0.3)
    robot.damped("rail", "prismatic", "plate", "carriage", [0.1, -0.2, 0.35], [0.02, -0.03, 0.4], (1, 0.1, 0))
    parent = "carriage"
    for k in range(1, 8):
        robot.link(f"link{k}", round(3.9 - 0.4 * k, 3), 0.25)
        place, turn = robot.numbers(0.2), robot.numbers(0.8)
        robot.damped(f"joint{k}", "continuous", parent, f"link{k}", place, turn, robot.numbers(1.0))
        parent = f"link{k}"
    for name, y in [("thumb", 0.02), ("finger", -0.02)]:
        robot.link(name, 0.083, 0.05)
        follows = '<mimic joint="thumb_slide" multiplier="-0.8" offset="0.0125"/>' if name == "finger" else ""
        robot.joint(f"{name}_slide", "prismatic", parent, name, [0.01, y, 0.11], [0.1, -0.2, 0.3], (0, 1, 0.05), follows)
    robot.typed += ["constraint finger_slide_mimic = finger_slide.travel - (-0.8) * thumb_slide.travel - (0.0125);"]
    return robot


def main():
    lines = ["// Robots typed in, written by `scripts/robots.py`; `{functions}` stands for what a test asks for.", ""]
    for robot in [quadruped(), humanoid(), biped(), rail_arm()]:
        if robot.floats:
            root = next(line for line in robot.typed if line.startswith("body")).split()[1]
            robot.typed.insert(1, f"joint floating: Free {{ parent: ground, child: {root} }}")
        lines += [*robot.write(), ""]
    (DATA / "typed_in.rs").write_text("\n".join(lines[:-1]) + "\n")


main()
