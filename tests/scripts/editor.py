"""Names in a model behave as names in an editor: rust-analyzer is asked, over its protocol, about a crate with models.

    python3 tests/scripts/editor.py [PATH OF RUST-ANALYZER]

It expands the macro with the server of macros that comes with the toolchain, so both must speak one protocol: a rust-analyzer
not older than the toolchain does, such as that of Debian's package `rust-web-analyzer`. The crate stands in `target/editor`.
"""

import json
import os
import pathlib
import queue
import re
import subprocess
import sys
import threading
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
CRATE = ROOT / "target" / "editor"

MODELS = """//! Models for an editor.
multibody::multibody! {
    /// A thigh with a shank.
    mod leg {
        port hip: Frame;
        /// [m] from the hip to the foot
        param length = 1.0;
        body shank { mass: 1.0, com: 0.5 * length * X, inertia: rod(1.0, length, X) }
        /// [rad] bends the leg
        joint knee: Revolute { parent: hip, child: shank, axis: Z }
        output foot = shank.at(length * X).position;
    }
    /// Walks.
    pub mod walker {
        const N = 2;
        /// [N m] at the first knee
        input torque;
        /// [m] of the trunk
        let width = 0.2;
        body trunk { mass: 3.0, inertia: sphere(3.0, 0.2) }
        joint float: Planar { parent: ground, child: trunk, axis: Z }
        part legs: [leg; N] = |i| leg { hip: trunk.at(width * i * X) };
        force motor: Effort { joint: legs[0].knee, value: torque }
        output bend = legs[0].knee + float.angle;
        emit forward_dynamics, energy;
    }
    /// Swings.
    pub mod pendulum {
        body rod { mass: 1.0, com: -1.0 * Y, inertia: rod(1.0, 2.0, Y) }
        joint hinge: Revolute { parent: ground, child: rod, axis: Z }
    }
    /// A load that follows the pendulum's tip.
    pub mod follower {
        body load { mass: 1.0 }
        joint rail: Prismatic { parent: ground, child: load, axis: X }
        input swing;
        output tip_at = pendulum(rod.at(Y).position.x, hinge = swing);
    }
}

/// Reads what is generated.
pub fn user(model: &walker::Model) -> f64 {
    let mut state: walker::State = walker::State::default();
    state.q.legs[0].knee = 0.3;
    state.v.legs[1].knee = 0.1;
    let mut input: walker::Input = walker::Input::default();
    input.torque = 2.0;
    let energy = model.kinetic_energy(&state);
    energy + model.forward_dynamics(0.0, &state, &input).float.angle
}
"""

MANIFEST = f"""[package]
name = "editor"
version = "0.0.0"
edition = "2024"
publish = false

[workspace]

[dependencies]
multibody = {{ path = "{ROOT}/runtime" }}

[profile.dev]
debug = false
"""

SETTINGS = {
    "checkOnSave": False,
    "cachePriming": {"enable": False},
    "procMacro": {"enable": True},
    "completion": {"callable": {"snippets": "none"}, "postfix": {"enable": False}, "autoimport": {"enable": False}},
}


class Server:
    """rust-analyzer, and what it has said so far."""

    def __init__(self, path):
        self.process = subprocess.Popen(
            [path], cwd=CRATE, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL
        )
        self.answers, self.diagnostics, self.number = {}, {}, 0
        self.status = {}
        self.said = queue.Queue()
        threading.Thread(target=self.listen, daemon=True).start()

    def listen(self):
        stream = self.process.stdout
        while True:
            length = None
            while (line := stream.readline()) not in (b"\r\n", b""):
                if line.lower().startswith(b"content-length:"):
                    length = int(line.split(b":")[1])
            if length is None:
                return
            self.said.put(json.loads(stream.read(length)))

    def send(self, message):
        body = json.dumps({"jsonrpc": "2.0", **message}).encode()
        self.process.stdin.write(b"Content-Length: %d\r\n\r\n" % len(body) + body)
        self.process.stdin.flush()

    def notify(self, method, params):
        self.send({"method": method, "params": params})

    def hear(self, timeout):
        """One message, answered where it is a request."""
        message = self.said.get(timeout=timeout)
        method = message.get("method")
        if method == "textDocument/publishDiagnostics":
            self.diagnostics[message["params"]["uri"]] = message["params"]["diagnostics"]
        elif method == "experimental/serverStatus":
            self.status = message["params"]
        elif method == "workspace/configuration":
            self.send({"id": message["id"], "result": [SETTINGS for _ in message["params"]["items"]]})
        elif method and "id" in message:
            self.send({"id": message["id"], "result": None})
        elif "id" in message:
            self.answers[message["id"]] = message

    def ask(self, method, params, timeout=300):
        self.number += 1
        number = self.number
        self.send({"id": number, "method": method, "params": params})
        until = time.monotonic() + timeout
        while number not in self.answers:
            self.hear(max(until - time.monotonic(), 0.1))
        answer = self.answers.pop(number)
        error = answer.get("error")
        # Content has changed, or the server is busy: once more.
        if error and error["code"] in (-32801, -32802):
            time.sleep(0.2)
            return self.ask(method, params, timeout)
        return answer.get("result"), error

    def wait(self, timeout):
        """Until everything is built and read."""
        until = time.monotonic() + timeout
        quiet = 0
        while quiet < 3:
            assert time.monotonic() < until, f"rust-analyzer is not ready: {self.status}"
            try:
                self.hear(2.0)
                quiet = 0
            except queue.Empty:
                quiet += self.status.get("quiescent", False)
        assert self.status.get("health") != "error", self.status


class Document:
    """One file, as the editor has it."""

    def __init__(self, server, path, text):
        self.server, self.uri, self.text, self.version = server, path.as_uri(), text, 1
        item = {"uri": self.uri, "languageId": "rust", "version": 1, "text": text}
        server.notify("textDocument/didOpen", {"textDocument": item})

    def change(self, text):
        self.text, self.version = text, self.version + 1
        document = {"uri": self.uri, "version": self.version}
        self.server.notify("textDocument/didChange", {"textDocument": document, "contentChanges": [{"text": text}]})

    def at(self, context):
        """The place of `¦` in a piece of the text."""
        before, after = context.split("¦", 1)
        offset = self.text.index(before + after) + len(before)
        lines = self.text[:offset].split("\n")
        return {"line": len(lines) - 1, "character": len(lines[-1])}

    def word(self, span):
        start, end = span["start"], span["end"]
        assert start["line"] == end["line"], span
        return self.text.split("\n")[start["line"]][start["character"] : end["character"]]

    def line(self, span):
        return self.text.split("\n")[span["start"]["line"]].strip()

    def ask(self, method, context, **more):
        params = {"textDocument": {"uri": self.uri}, "position": self.at(context), **more}
        return self.server.ask("textDocument/" + method, params)

    def definition(self, context):
        """The lines where what stands there is declared."""
        found, _ = self.ask("definition", context)
        found = found if isinstance(found, list) else [found] if found else []
        places = {(link.get("targetUri", link.get("uri")), json.dumps(link.get("targetSelectionRange", link.get("range"))))
                  for link in found}
        return [(pathlib.Path(uri).name, json.loads(span)) for uri, span in sorted(places)]

    def hover(self, context):
        found, _ = self.ask("hover", context)
        return found["contents"]["value"] if found else ""

    def highlights(self, context):
        found, _ = self.ask("documentHighlight", context)
        return sorted({(one["range"]["start"]["line"], one["range"]["start"]["character"]) for one in found or []})

    def renamed(self, context, name):
        """The text with another name, or the error."""
        edit, error = self.ask("rename", context, newName=name)
        if error:
            return error["message"]
        changes = edit.get("documentChanges") or [{"edits": edits} for edits in edit["changes"].values()]
        edits = {(e["range"]["start"]["line"], e["range"]["start"]["character"], e["range"]["end"]["character"], e["newText"])
                 for change in changes for e in change["edits"]}
        lines = self.text.split("\n")
        for line, start, end, new in sorted(edits, reverse=True):
            lines[line] = lines[line][:start] + new + lines[line][end:]
        return "\n".join(lines)

    def completed(self, old, new):
        """What is offered at `¦` where `new` stands in the place of `old`."""
        text = self.text
        self.change(text.replace(old, new.replace("¦", ""), 1))
        found, _ = self.ask("completion", new)
        self.change(text)
        items = found["items"] if isinstance(found, dict) else found or []
        return [item["label"].split("(")[0].strip() for item in items]

    def errors(self):
        """Mistakes that the server finds itself."""
        report, _ = self.server.ask("textDocument/diagnostic", {"textDocument": {"uri": self.uri}})
        items = report.get("items", []) if report else []
        return [(self.line(item["range"]), item["message"]) for item in items if item.get("severity", 1) == 1]


FAILURES = []


def expect(what, held, found=""):
    print(("ok    " if held else "WRONG ") + what + ("" if held else f": {found!r}"), flush=True)
    if not held:
        FAILURES.append(what)


def leads(document, context, declaration, file="lib.rs"):
    found = document.definition(context)
    lines = [document.line(span) if name == "lib.rs" else name for name, span in found]
    held = len(found) == 1 and found[0][0] == file and (file != "lib.rs" or declaration in lines[0])
    expect(f"`{context}` leads to `{declaration}`", held, lines)


def check(document):
    # Going to definitions.
    leads(document, "0.5 * len¦gth * X", "param length")
    leads(document, "parent: h¦ip", "port hip")
    leads(document, "child: sh¦ank", "body shank")
    leads(document, "joint: legs[0].kn¦ee", "joint knee")
    leads(document, "joint: le¦gs[0]", "part legs")
    leads(document, "[le¦g; N]", "mod leg")
    leads(document, "[leg; ¦N]", "const N")
    leads(document, "le¦g { hip", "mod leg")
    leads(document, "value: tor¦que", "input torque")
    leads(document, "at(wid¦th", "let width")
    leads(document, "+ flo¦at.angle;", "joint float")
    leads(document, "joint float: Pla¦nar", "struct Planar", "words.rs")
    leads(document, "child: trunk, ax¦is", "axis", "words.rs")
    found = {name for name, _ in document.definition("emit forw¦ard_dynamics")}
    expect("a word of `emit` leads to the language and to the method", found == {"words.rs", "lib.rs"}, found)
    leads(document, "= pend¦ulum(rod", "pub mod pendulum")
    leads(document, "(ro¦d.at(Y)", "body rod")
    leads(document, "hin¦ge = swing", "joint hinge")
    # From code of the user's.
    leads(document, "state.q.legs[0].kn¦ee", "joint knee")
    leads(document, "state.v.le¦gs[1]", "part legs")
    leads(document, "input.tor¦que = 2.0", "input torque")
    leads(document, "model.kinetic_en¦ergy", "emit forward_dynamics, energy")
    leads(document, "model.forward_dyn¦amics", "emit forward_dynamics, energy")

    # What is said of them.
    for context, words in [
        ("0.5 * len¦gth * X", ["[m]", "from the hip to the foot"]),
        ("joint: legs[0].kn¦ee", ["[rad]", "bends the leg", "Revolute"]),
        ("value: tor¦que", ["[N m]", "at the first knee"]),
        ("at(wid¦th", ["[m]", "of the trunk", "Let"]),
        ("joint knee: Rev¦olute", ["Turns about an axis"]),
        ("shank, ax¦is: Z", ["right-hand rule", "Vec3"]),
        ("body shank { ma¦ss", ["[kg]"]),
        ("[le¦g; N]", ["A thigh with a shank."]),
        ("dynamics, en¦ergy;", ["potential_energy"]),
        ("force motor: Eff¦ort", ["Acts on a coordinate"]),
    ]:
        found = document.hover(context)
        expect(f"`{context}` tells {words}", all(word in found for word in words), found)

    # Highlights and renaming. In code that reads the structs a name is a field of one of them: renaming starts in the model.
    for places, code in [
        (["joint kn¦ee:", "joint: legs[0].kn¦ee", "bend = legs[0].kn¦ee"], ["q.legs[0].kn¦ee", "v.legs[1].kn¦ee"]),
        (["input tor¦que", "value: tor¦que"], ["input.tor¦que"]),
        (["param len¦gth", "0.5 * len¦gth", "rod(1.0, len¦gth", "at(len¦gth"], []),
        (["port h¦ip", "parent: h¦ip", "leg { h¦ip"], []),
        (["let wid¦th", "at(wid¦th"], []),
        (["part le¦gs", "joint: le¦gs", "bend = le¦gs"], ["q.le¦gs", "v.le¦gs"]),
        (["body tr¦unk", "child: tr¦unk", "hip: tr¦unk"], []),
        (["joint flo¦at", "+ flo¦at.angle"], [").flo¦at.angle"]),
    ]:
        own = {document.at(place)["line"] for place in places}
        all_lines = own | {document.at(place)["line"] for place in code}
        want = document.text
        name = re.search(r"\w*¦\w*", places[0]).group().replace("¦", "")
        for place in places + code:
            want = want.replace(place.replace("¦", ""), re.sub(r"\w*¦\w*", "renamed", place), 1)
        for place in places:
            found = {line for line, _ in document.highlights(place)}
            expect(f"`{place}` highlights all of `{name}`", found == all_lines, found)
            found = document.renamed(place, "renamed")
            differing = [a + " <> " + b for a, b in zip(found.split("\n"), want.split("\n")) if a != b]
            expect(f"`{place}` renames all of `{name}`", found == want, differing[:5])
        for place in code:
            found = {line for line, _ in document.highlights(place)}
            expect(f"`{place}` highlights `{name}` in the model", found >= own, found)

    # Completion.
    for old, new, word in [
        ("joint knee: Revolute", "joint knee: Rev¦", "Revolute"),
        ("joint float: Planar", "joint float: Pla¦", "Planar"),
        ("child: shank, axis: Z", "child: shank, ax¦: Z", "axis"),
        ("child: shank, axis: Z", "child: shank, ax¦", "axis"),
        ("mass: 1.0, com: 0.5 * length", "mass: 1.0, com: 0.5 * len¦", "length"),
        ("body shank { mass: 1.0", "body shank { mas¦", "mass"),
        ("force motor: Effort", "force motor: Eff¦", "Effort"),
        ("value: torque", "value: tor¦", "torque"),
        ("joint: legs[0].knee", "joint: legs[0].kn¦", "knee"),
        ("emit forward_dynamics, energy", "emit forw¦", "forward_dynamics"),
        ("part legs: [leg; N]", "part legs: [le¦; N]", "leg"),
    ]:
        found = document.completed(old, new)
        expect(f"`{new}` offers `{word}`", word in found, found[:20])

    # One mistake is one error, and the models beside it stay as they are.
    expect("no error", document.errors() == [], document.errors())
    text = document.text
    document.change(text.replace("value: torque }", "value: torqe }"))
    found = document.errors()
    expect("one mistake is one error", len(found) == 1 and "torqe" in found[0][0], found)
    found = document.hover("let energy = model.kinetic_en¦ergy")
    expect("a model with a mistake has its methods", "-> T" in found or "-> f64" in found, found)
    found = document.hover("joint hi¦nge")
    expect("a model beside a mistake is there in full", "hinge" in found, found)
    document.change(text)


def main():
    path = sys.argv[1] if len(sys.argv) > 1 else "rust-analyzer"
    (CRATE / "src").mkdir(parents=True, exist_ok=True)
    (CRATE / "Cargo.toml").write_text(MANIFEST)
    (CRATE / "src" / "lib.rs").write_text(MODELS)
    lock = CRATE / "Cargo.lock"
    if not lock.exists():
        lock.write_bytes((ROOT / "Cargo.lock").read_bytes())
    os.environ.setdefault("CARGO_TARGET_DIR", str(ROOT / "target" / "tests" / "trybuild"))
    server = Server(path)
    capabilities = {
        "experimental": {"serverStatusNotification": True},
        "textDocument": {
            "definition": {"linkSupport": True},
            "hover": {"contentFormat": ["markdown"]},
            "diagnostic": {},
            "completion": {"completionItem": {"snippetSupport": False}},
        },
        "workspace": {"configuration": True, "workspaceEdit": {"documentChanges": True}},
    }
    server.ask(
        "initialize",
        {"processId": os.getpid(), "rootUri": CRATE.as_uri(), "capabilities": capabilities,
         "initializationOptions": SETTINGS, "workspaceFolders": [{"uri": CRATE.as_uri(), "name": "editor"}]},
    )
    server.notify("initialized", {})
    document = Document(server, CRATE / "src" / "lib.rs", MODELS)
    server.wait(1200)
    check(document)
    server.ask("shutdown", None)
    server.notify("exit", None)
    print(f"{len(FAILURES)} failed")
    return 1 if FAILURES else 0


if __name__ == "__main__":
    sys.exit(main())
