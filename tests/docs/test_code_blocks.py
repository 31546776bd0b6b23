"""Every block of code in README and docs: read in the quick run, run by the slow one.

The blocks of a page run from top to bottom in a folder of their own; names in Python live on to
the next block. What cannot be run says so above it: ``<!-- not run: REASON -->``.
"""

import ast
import contextlib
import io
import json
import os
import shlex
import shutil
import tomllib
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest
import tifffile

from rotemina.app.cli.main import build_parser, main
from rotemina.app.motion.recording.session_recorder import SessionRecorder
from rotemina.app.motion.session import MotionSession
from rotemina.drivers.clock import VirtualClock
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.robot.file import load_robot

_THX = "excite multisine --axes thx --duration 5"
_HYSTERESIS = '[[axis.thx.effect]]\nid = "hysteresis"\nwidth = 1.1e-4\n'
# What a page takes for granted, made by commands: files that a reader has.
PREPARED = {
    "command-line.md": (
        "simulate reference.csv --robot emps -o emps_train.csv",
        f"{_THX} -o new.csv",
        f"{_THX} --seed 1 -o first.csv",
        f"{_THX} --seed 2 -o second.csv",
        "simulate first.csv --robot worn.toml -o day1.csv",
        "simulate second.csv --robot worn.toml -o day2.csv --seed 2",
    ),
    "compensation.md": ("compensate train --simulate --axis zn -o zn.json",),
    "effects.md": ("excite sine --axes thx -o try.csv",),
    "file-formats.md": ("excite sine --axes zn -o zn.csv", "simulate zn.csv -o run.csv.gz"),
    "gap-diagnosis.md": (
        f"{_THX} -o new.csv",
        "excite multisine --axes thx,zn --seed 2 -o second.csv",
        "play second.csv -o day2.csv",
    ),
    # The page makes emps.csv anew of the real data, where those are.
    "tutorial-machine.md": ("simulate reference.csv --robot emps -o emps.csv",),
    "identification.md": ("excite multisine --axes x -o x.csv", "play x.csv -o run.csv"),
}


@pytest.fixture
def folder(root, tmp_path, monkeypatch):
    """The reader's folder: the examples of the repository, a worn robot, a robot of his own."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / ".config"))
    shutil.copytree(root / "resources", tmp_path / "resources")
    robot = (root / "resources" / "robots" / "rotemina.toml").read_text("utf-8")
    (tmp_path / "lab.toml").write_text(robot, "utf-8")
    (tmp_path / "worn.toml").write_text(robot + _HYSTERESIS, "utf-8")
    way = 0.1 - 0.1 * np.cos(2.0 * np.pi * np.arange(2000) / 1000.0)
    rows = "".join(f"{row / 1000},{position:.6f}\n" for row, position in enumerate(way))
    head = "# rotemina-record: 1\n# mode: closed_loop\nt [s],q.cmd [m]\n"
    (tmp_path / "reference.csv").write_text(head + rows, "utf-8")
    (tmp_path / "FOLDER").mkdir()
    shared = Path(os.environ.get("ROTEMINA_SHARED", root.parent / "shared"))
    measured = shared / "data" / "emps" / "DATA_EMPS.mat"
    if measured.exists():
        shutil.copy(measured, tmp_path)
    return tmp_path


@pytest.fixture
def recorded(folder):
    """A recording of 25 s with a jog of x in it, ``run.arrows`` and ``today.arrows``."""
    clock = VirtualClock(7.0)
    session = MotionSession(Simulator(load_robot("rotemina"), clock=clock))
    session.connect()
    session.run_once()
    recorder = SessionRecorder(
        session, folder / "run.arrows", began="2026-03-04T05:06:07+01:00", clock=clock
    )
    recorder.start(thread=False)
    for step in range(1250):
        if step == 700:
            session.jog("x", 5e-4)
        clock.advance(0.02)
        session.run_once()
    recorder.writer.run_once()
    recorder.close()
    session.close()
    shutil.copy(folder / "run.arrows", folder / "today.arrows")


@pytest.fixture
def filmed(folder):
    """Two pictures with their times, ``video.tif``."""
    with tifffile.TiffWriter(folder / "video.tif") as file:
        for time_s in (0.0, 0.1):
            picture = np.zeros((8, 8), np.uint8)
            file.write(picture, description=json.dumps({"host_time_s": time_s}), metadata=None)


def is_command(line):
    return line.startswith("rotemina ") or line == "rotemina"


def words_of(line):
    return shlex.split(line, comments=True)[1:]


def run_command(line):
    """Run a command as a reader would and return what it printed."""
    said = io.StringIO()
    with contextlib.redirect_stdout(said):
        status = main(words_of(line))
    assert status == 0, f"{line}: status {status}"
    return said.getvalue()


def test_blocks_are_found_with_their_kinds_and_reasons(parse_blocks):
    text = (
        "Text\n\n    rotemina effect list   # all\n\n    H = 1\n\nMore\n"
        "```python\nx = 1\n\ny = 2\n```\n"
        "<!-- not run: takes hours -->\n\n```sh\nmake soak\n```\n"
        "    no block, for a line stands above\n"
        "\n    a + b\n"
    )
    first, python, marked, equation = parse_blocks(text)
    assert (first.line, first.kind, first.commands[1]) == (3, "sh", "H = 1")
    assert (python.kind, python.text, python.not_run) == ("python", "x = 1\n\ny = 2\n", "")
    assert (marked.kind, marked.not_run) == ("sh", "takes hours")
    assert equation.kind == "text"


def test_commands_are_understood(blocks):
    parser = build_parser()
    for block in blocks:
        if block.kind != "sh" or block.not_run:
            continue
        for line in block.commands:
            assert is_command(line), f"line {block.line}: {line}: say why it is not run"
            try:
                parser.parse_args(words_of(line))
            except SystemExit:
                pytest.fail(f"line {block.line}: {line}")


def test_python_names_what_there_is(blocks):
    for block in blocks:
        if block.kind != "python":
            continue
        for node in ast.walk(ast.parse(block.text)):
            if isinstance(node, ast.ImportFrom) and node.module.startswith("rotemina."):
                module = import_module(node.module)
                missing = [one.name for one in node.names if not hasattr(module, one.name)]
                assert missing == [], f"line {block.line}: {node.module}"


def test_tables_are_well_formed(blocks):
    read = {"toml": tomllib.loads, "json": json.loads}
    for block in blocks:
        if block.kind in read:
            read[block.kind](block.text)


@pytest.mark.slow
@pytest.mark.usefixtures("recorded", "filmed")
def test_blocks_run_from_top_to_bottom(page, blocks, folder):
    for line in PREPARED.get(page.name, ()):
        run_command(f"rotemina {line}")
    names = {"__name__": "page", "desired": 1e-5, "positions": np.linspace(0.0, 1e-5, 9)}
    for block in blocks:
        if block.not_run:
            continue
        if block.kind == "python":
            code = compile("\n" * block.line + block.text, page.name, "exec")
            exec(code, names)  # noqa: S102 - the page's own code
        if block.kind == "sh":
            for line in block.commands:
                answered = run_command(line)
                if f"$ {line}\n" in block.text:
                    assert block.text.endswith(answered), f"line {block.line}: {answered}"
