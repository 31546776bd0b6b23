"""The page about drivers: its example keeps the contract, and what it names exists."""

import re
from pathlib import Path

import pytest

from rotemina.drivers import abilities, errors, gate, model_abilities, tool
from rotemina.drivers.clock import VirtualClock
from rotemina.drivers.driver import Driver
from rotemina.sim.robot.file import load_robot

PAGE = (Path(__file__).parents[2] / "docs" / "drivers.md").read_text("utf-8")
DRIVER, USE = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)


@pytest.mark.parametrize("name", ["rotemina", "fsm"])
def test_the_example_keeps_the_contract(name):
    names = {"robot": load_robot(name), "clock": VirtualClock()}
    exec(DRIVER, names)  # noqa: S102 - the page's own code
    exec(USE, names)  # noqa: S102
    assert names["failed"] == []


def test_every_ability_is_on_the_page_and_no_other():
    own = {
        name
        for module in (abilities, model_abilities, tool)
        for name, one in vars(module).items()
        if isinstance(one, type) and issubclass(one, Driver) and one is not Driver
    }
    section = PAGE.split("## Abilities")[1].split("\n## ")[0]
    cells = [line.split("|")[1] for line in section.splitlines() if line.startswith("| `")]
    assert {name for cell in cells for name in re.findall(r"`(\w+)`", cell)} == own


def test_errors_on_the_page_exist():
    for name in set(re.findall(r"`(\w+Error)`", PAGE)) - {"SettingError"}:
        assert hasattr(errors, name) or hasattr(gate, name)
