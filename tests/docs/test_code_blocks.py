"""Every block of code in README and docs: the quick tests read it, the slow test runs it.

The blocks of a page run from top to bottom in a separate folder. Python names remain defined in
the blocks that follow. A block that cannot be run has a comment above it:
``<!-- not run: REASON -->``.
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
from rotemina.app.motion.recording import SessionRecorder
from rotemina.app.motion.session import MotionSession
from rotemina.drivers.contract import VirtualClock
from rotemina.drivers.simulator import Simulator
from rotemina.sim.robot_files import load_robot

_THX = "excite multisine --axes thx --duration 5"
_HYSTERESIS = '[[axis.thx.effect]]\nid = "hysteresis"\nwidth = 1.1e-4\n'
# Commands that make the files which a page assumes its reader to have.
PREPARATION_COMMANDS = {
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
        f"{_THX} --seed 2 -o second.csv",
        "play second.csv -o day2.csv",
    ),
    "gap-json.md": (
        f"{_THX} -o new.csv",
        "play new.csv -o day1.csv",
        f"{_THX} --seed 2 -o second.csv",
        "play second.csv -o day2.csv",
        "gap diagnose day1.csv day2.csv --json out.json",
    ),
    # The page makes emps.csv again from the real data, if they are available.
    "tutorial-machine.md": ("simulate reference.csv --robot emps -o emps.csv",),
    "identification.md": ("excite multisine --axes x -o x.csv", "play x.csv -o run.csv"),
}


@pytest.fixture
def folder(files, tmp_path, monkeypatch):
    """A copy of the reader's files, in which the commands run."""
    folder = shutil.copytree(files, tmp_path / "reader")
    monkeypatch.chdir(folder)
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / ".config"))


@pytest.fixture(scope="session")
def files(root, tmp_path_factory):
    """The files of a reader: examples of the repository, robots, records, a recording, a video."""
    folder = tmp_path_factory.mktemp("reader")
    shutil.copytree(root / "resources", folder / "resources")
    robot = (root / "resources" / "robots" / "rotemina.toml").read_text("utf-8")
    (folder / "lab.toml").write_text(robot, "utf-8")
    (folder / "worn.toml").write_text(robot + _HYSTERESIS, "utf-8")
    path = 0.1 - 0.1 * np.cos(2.0 * np.pi * np.arange(2000) / 1000.0)
    rows = "".join(f"{row / 1000},{position:.6f}\n" for row, position in enumerate(path))
    head = "# rotemina-record: 1\n# mode: closed_loop\nt [s],q.cmd [m]\n"
    (folder / "reference.csv").write_text(head + rows, "utf-8")
    (folder / "FOLDER").mkdir()
    shared = Path(os.environ.get("ROTEMINA_SHARED", root.parent / "shared"))
    measured_file = shared / "data" / "emps" / "DATA_EMPS.mat"
    if measured_file.exists():
        shutil.copy(measured_file, folder)
    record_jog(folder)
    write_video(folder)
    return folder


def record_jog(folder):
    """Record 25 s with a jog of x: ``run.arrows`` and ``today.arrows``."""
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


def write_video(folder):
    """Write two pictures with their times: ``video.tif``."""
    with tifffile.TiffWriter(folder / "video.tif") as file:
        for time_s in (0.0, 0.1):
            picture = np.zeros((8, 8), np.uint8)
            file.write(picture, description=json.dumps({"host_time_s": time_s}), metadata=None)


def is_command(line):
    return line.startswith("rotemina ") or line == "rotemina"


def split_arguments(line):
    return shlex.split(line, comments=True)[1:]


def run_command(line):
    """Run a command as a reader would and return what it printed."""
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        status = main(split_arguments(line))
    assert status == 0, f"{line}: status {status}"
    return printed.getvalue()


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


def test_commands_can_be_parsed(blocks_of_pages):
    parser = build_parser()
    for page, blocks in blocks_of_pages.items():
        for block in blocks:
            if block.kind != "sh" or block.not_run:
                continue
            for line in block.commands:
                place = f"{page}, line {block.line}: {line}"
                assert is_command(line), f"{place}: say why it is not run"
                try:
                    parser.parse_args(split_arguments(line))
                except SystemExit:
                    pytest.fail(place)


def test_imported_names_exist(blocks_of_pages):
    for page, blocks in blocks_of_pages.items():
        for block in blocks:
            tree = ast.parse(block.text if block.kind == "python" else "")
            for node in ast.walk(tree):
                if isinstance(node, ast.ImportFrom) and node.module.startswith("rotemina."):
                    module = import_module(node.module)
                    names = [alias.name for alias in node.names]
                    missing = [name for name in names if not hasattr(module, name)]
                    assert missing == [], f"{page}, line {block.line}: {node.module}"


def test_toml_and_json_blocks_are_valid(blocks_of_pages):
    parsers = {"toml": tomllib.loads, "json": json.loads}
    for page, blocks in blocks_of_pages.items():
        for block in blocks:
            if block.kind in parsers:
                try:
                    parsers[block.kind](block.text)
                except ValueError as error:
                    pytest.fail(f"{page}, line {block.line}: {error}")


@pytest.mark.slow
@pytest.mark.usefixtures("folder")
def test_blocks_run_from_top_to_bottom(page_to_run, blocks_of_pages):
    for line in PREPARATION_COMMANDS.get(Path(page_to_run).name, ()):
        run_command(f"rotemina {line}")
    names = {"__name__": "page", "desired": 1e-5, "positions": np.linspace(0.0, 1e-5, 9)}
    for block in blocks_of_pages[page_to_run]:
        if block.not_run:
            continue
        if block.kind == "python":
            code = compile("\n" * block.line + block.text, page_to_run, "exec")
            exec(code, names)  # noqa: S102 - the page's own code
        if block.kind == "sh":
            for line in block.commands:
                output = run_command(line)
                if f"$ {line}\n" in block.text:
                    assert block.text.endswith(output), f"line {block.line}: {output}"
