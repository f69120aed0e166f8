"""Writes the serial arms of `data/robots/*.model.json` as macro calls into `models/arms.rs`.

Four modules per arm: `NAME` with every number a literal, `NAME_params` with every number a field of `Params`, and of each
a `_driven` one with an input for the effort of every joint. Rotation matrices of frames are structure and stay literals.

Run it in `tests/`: `python3 scripts/arms.py`
"""

import json
from pathlib import Path

HERE = Path(__file__).resolve().parent.parent
ARMS = ["double_pendulum", "cart5", "puma560", "panda"]
# Published data with inertias that no rigid body has.
UNPHYSICAL = {"puma560": [1, 3]}

HEAD = """\
//! Serial arms as macro calls, written by `scripts/arms.py` from `data/robots`.

use multibody::multibody;
"""


def number(value):
    """The shortest decimal that reads back as the same f64."""
    return repr(float(value))


def vector(values):
    return "[" + ", ".join(number(value) for value in values) + "]"


def matrix(rows):
    return "[" + ", ".join(vector(row) for row in rows) + "]"


class Writer:
    """One module. `place` either writes a number where it is used or declares a param and writes its name."""

    def __init__(self, arm, params, driven):
        self.arm, self.params, self.driven = arm, params, driven
        self.declared = []

    def place(self, name, doc, text):
        if not self.params:
            return text
        self.declared += [f"/// {doc}", f"param {name} = {text};"]
        return name

    def frame(self, base, name, placement):
        frame = base
        identity = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
        if any(placement["p"]):
            at = self.place(f"{name}_at", f"[m] origin of `{name}`'s frame", vector(placement["p"]))
            frame += f".at({at})"
        if placement["R"] != identity:
            frame += f".oriented({matrix(placement['R'])})"
        return frame

    def link(self, k, joint):
        inertia = joint["inertia_com"]
        entries = [inertia[a][b] for a, b in [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)]]
        mass = self.place(f"m{k}", "[kg] mass", number(joint["mass"]))
        com = self.place(f"c{k}", "[m] centre of mass", vector(joint["com"]))
        values = self.place(f"i{k}", "[kg m^2] xx, yy, zz, xy, xz, yz", vector(entries))
        if self.params:
            values = ", ".join(f"{values}[{n}]" for n in range(6))
        else:
            values = values[1:-1]
        waiver = "#[allow(unphysical_inertia)]\n" if k in UNPHYSICAL.get(self.arm["name"], []) else ""
        return f"{waiver}body link{k} {{ mass: {mass}, com: {com}, inertia: inertia({values}) }}"

    def joint(self, k, joint):
        kind = {"R": "Revolute", "P": "Prismatic"}[joint["type"][0]]
        parent = "ground" if joint["parent"] < 0 else f"link{joint['parent'] + 1}"
        frame = self.frame(parent, f"joint{k}", joint["placement"])
        return f"joint joint{k}: {kind} {{ parent: {frame}, child: link{k}, axis: {joint['type'][1]} }}"

    def module(self):
        name = self.arm["name"] + ("_driven" if self.driven else "") + ("_params" if self.params else "")
        items = []
        joints = self.arm["joints"]
        gravity = self.place("gravity", "[m/s^2] gravity", vector(self.arm["gravity"]))
        items.append(f"world {{ gravity: {gravity} }}")
        for k, joint in enumerate(joints, 1):
            items += [*self.link(k, joint).splitlines(), self.joint(k, joint)]
        if self.driven:
            for k in range(1, len(joints) + 1):
                items += [f"/// effort of `joint{k}`", f"input tau{k};"]
                items.append(f"force drive{k}: Effort {{ joint: joint{k}, value: tau{k} }}")
            items.append("emit forward_dynamics, derivatives;")
        else:
            ee = self.arm["ee"]
            frame = self.frame(f"link{ee['parent'] + 1}", "tool", ee)
            items += ["/// tool frame", f"output pose = {frame}.pose;"]
            items += ["/// columns are the tool's axes", f"output rotation = {frame}.rotation;"]
            items += ["/// of the tool", f"output jacobian = {frame}.jacobian;"]
            items += ["/// of the tool", f"output twist = {frame}.twist;"]
            items.append("emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;")
        what = "every number a param" if self.params else "every number a literal"
        lines = ["multibody! {", f"    /// The arm `{self.arm['name']}`, {what}.", f"    pub mod {name} {{"]
        lines += ["        " + line for line in self.declared + items]
        return "\n".join(lines + ["    }", "}"]) + "\n"


def main():
    text = HEAD
    for name in ARMS:
        arm = json.loads((HERE / f"data/robots/{name}.model.json").read_text())
        for params in [False, True]:
            for driven in [False, True]:
                text += "\n" + Writer(arm, params, driven).module()
    (HERE / "models/arms.rs").write_text(text)


main()
