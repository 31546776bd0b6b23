"""The diagnosis contains no name of an effect, because each effect describes itself."""

import ast
from pathlib import Path

from rotemina.sim import gap
from rotemina.sim.effects import list_effect_ids

MODULES = sorted(Path(gap.__file__).parent.rglob("*.py"))


def test_no_effect_id_appears_in_the_code_and_no_module_of_an_effect_is_imported():
    effect_ids = set(list_effect_ids())
    effect_modules = {f"rotemina.sim.effects.{name}" for name in effect_ids}
    found = [
        (module.name, node.lineno)
        for module in MODULES
        for node in ast.walk(ast.parse(module.read_text(encoding="utf-8")))
        if (isinstance(node, ast.Constant) and node.value in effect_ids)
        or (isinstance(node, ast.ImportFrom) and node.module in effect_modules)
    ]
    assert found == []
