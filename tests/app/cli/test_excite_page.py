"""The page about excitations keeps its promises."""

import re
from pathlib import Path

import pytest

from rotemina.app.cli.main import main
from rotemina.sim.excitation.generator import KINDS

PAGE = (Path(__file__).parents[3] / "docs" / "excitations.md").read_text("utf-8")
COMMANDS = re.findall(r"^ +(?:\$ )?rotemina (excite .+)$", PAGE, re.MULTILINE)


@pytest.mark.parametrize("command", COMMANDS)
def test_its_commands_work(command, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(command.split()) == 0


def test_it_names_every_kind():
    assert [kind for kind in KINDS if f"| `{kind}` |" not in PAGE] == []


def test_its_program_runs():
    (program,) = re.findall(r"```python\n(.+?)```", PAGE, re.DOTALL)
    names = {}
    exec(program, names)  # noqa: S102 the page's own text
    assert names["made"].record.axes == ("thx", "x")
