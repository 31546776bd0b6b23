"""The page about drivers: its example fulfils the contract, and all names on it exist."""

import re
from pathlib import Path

import pytest

from rotemina.drivers.abilities import abilities, model_abilities, parameters, tool
from rotemina.drivers.contract import Driver, VirtualClock, errors, gate
from rotemina.sim.robot_files import load_robot

PAGE = (Path(__file__).parents[2] / "docs" / "drivers.md").read_text("utf-8")
DRIVER_EXAMPLE, USAGE_EXAMPLE = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)


@pytest.mark.parametrize("name", ["rotemina", "fsm"])
def test_the_example_fulfils_the_contract(name):
    names = {"robot": load_robot(name), "clock": VirtualClock()}
    exec(DRIVER_EXAMPLE, names)  # noqa: S102 - the page's own code
    exec(USAGE_EXAMPLE, names)  # noqa: S102 - the page's own code
    assert names["failed"] == []


def test_the_page_lists_exactly_the_abilities():
    ability_names = {
        name
        for module in (abilities, model_abilities, parameters, tool)
        for name, value in vars(module).items()
        if isinstance(value, type) and issubclass(value, Driver) and value is not Driver
    }
    section = PAGE.split("## Abilities")[1].split("\n## ")[0]
    cells = [line.split("|")[1] for line in section.splitlines() if line.startswith("| `")]
    assert {name for cell in cells for name in re.findall(r"`(\w+)`", cell)} == ability_names


def test_errors_on_the_page_exist():
    for name in set(re.findall(r"`(\w+Error)`", PAGE)) - {"SettingError"}:
        assert hasattr(errors, name) or hasattr(gate, name)
