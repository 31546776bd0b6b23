"""The commands and the program on the page about excitations work."""

import re
from pathlib import Path

import pytest

from rotemina.app.cli.main import main
from rotemina.sim.excitation import EXCITATION_KINDS

PAGE = (Path(__file__).parents[4] / "docs" / "excitations.md").read_text("utf-8")
COMMANDS = re.findall(r"^ +(?:\$ )?rotemina (excite .+)$", PAGE, re.MULTILINE)


@pytest.mark.parametrize("command", COMMANDS)
def test_commands_on_the_page_work(command, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(command.split()) == 0


def test_page_names_every_kind():
    assert [kind for kind in EXCITATION_KINDS if f"| `{kind}` |" not in PAGE] == []


def test_program_on_the_page_runs():
    (program,) = re.findall(r"```python\n(.+?)```", PAGE, re.DOTALL)
    names = {}
    exec(program, names)  # noqa: S102 the text of the page
    assert names["made"].record.axes == ("thx", "x")
