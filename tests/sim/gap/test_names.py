"""The diagnosis knows no effect by name: what it must know of one, the effect brings itself."""

import ast
from pathlib import Path

import pytest

from rotemina.sim import gap
from rotemina.sim.effects.registry import effect_ids

MODULES = sorted(Path(gap.__file__).parent.rglob("*.py"))


@pytest.mark.parametrize("module", MODULES, ids=lambda path: path.stem)
def test_no_effect_is_spelled_out(module):
    words = {
        node.value
        for node in ast.walk(ast.parse(module.read_text(encoding="utf-8")))
        if isinstance(node, ast.Constant) and isinstance(node.value, str)
    }
    assert not words & set(effect_ids())


def test_effects_are_imported_from_no_module_of_their_own():
    own = {f"rotemina.sim.effects.{name}" for name in effect_ids()}
    for module in MODULES:
        for node in ast.walk(ast.parse(module.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ImportFrom):
                assert node.module not in own, module.name
