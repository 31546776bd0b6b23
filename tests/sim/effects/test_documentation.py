"""docs/effects.md matches the installed effects, and its example of a new effect works."""

import re
from importlib import resources
from importlib.metadata import EntryPoint
from pathlib import Path

import pytest

from rotemina.sim.effects import load_all_effects, registry
from rotemina.sim.robot_files import parse_robot
from rotemina.sim.simulation import check_effect

DOCS = Path(__file__).parents[3] / "docs"
PAGE = (DOCS / "effects.md").read_text("utf-8")
LETTERS = {"piezo": "P", "stepper": "S", "force": "F"}


def find_code_blocks(language):
    return re.findall(rf"```{language}\n(.*?)```", PAGE, flags=re.DOTALL)


@pytest.mark.parametrize("effect", load_all_effects()[0].values(), ids=lambda effect: effect.id)
def test_the_catalogue_describes_every_effect_correctly(effect):
    line = next(line for line in PAGE.splitlines() if line.startswith(f"| `{effect.id}` |"))
    _, _, stage, kinds, formulations, summary, _ = (part.strip() for part in line.split("|"))
    assert stage == effect.stage
    assert set(kinds) == {LETTERS[kind] for kind in effect.kinds}
    assert re.findall(r"`(\w+)`", formulations) == [f.name for f in effect.formulations]
    assert summary == effect.summary


def test_the_robot_file_of_the_page_is_valid():
    text = resources.files("rotemina.resources.robots").joinpath("rotemina.toml").read_text("utf-8")
    robot = parse_robot(text + find_code_blocks("toml")[0])
    assert [effect.id for effect in robot.effects] == ["hysteresis", "cross_coupling"]


def test_the_effect_of_the_page_passes_the_check(tmp_path, monkeypatch):
    source = next(block for block in find_code_blocks("python") if "cable_drag.py" in block)
    (tmp_path / "cable_drag.py").write_text(source, "utf-8")
    monkeypatch.syspath_prepend(str(tmp_path))
    point = EntryPoint("cable_drag", "cable_drag:CABLE_DRAG", registry.GROUP)
    monkeypatch.setattr(registry, "_find_entry_points", lambda: {"cable_drag": point})
    registry.load_effect.cache_clear()
    try:
        report = check_effect("cable_drag")
    finally:
        registry.load_effect.cache_clear()
    assert report.passed, "\n".join(map(str, report.failures))
