"""The diagnosis contains no name of an effect, because each effect describes itself."""

import ast
from pathlib import Path

import pytest

from rotemina.sim import gap
from rotemina.sim.effects import list_effect_ids

MODULES = sorted(Path(gap.__file__).parent.rglob("*.py"))


@pytest.mark.parametrize("module", MODULES, ids=lambda path: path.stem)
def test_no_effect_id_appears_in_the_code(module):
    words = {
        node.value
        for node in ast.walk(ast.parse(module.read_text(encoding="utf-8")))
        if isinstance(node, ast.Constant) and isinstance(node.value, str)
    }
    assert not words & set(list_effect_ids())


def test_no_module_of_an_effect_is_imported():
    effect_modules = {f"rotemina.sim.effects.{name}" for name in list_effect_ids()}
    for module in MODULES:
        for node in ast.walk(ast.parse(module.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ImportFrom):
                assert node.module not in effect_modules, module.name
