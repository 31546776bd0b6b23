"""Interfaces of folders: what they export exists; folders stay small."""

import ast
from importlib import import_module
from pathlib import Path

ROOT = Path(__file__).parents[1]
LAYERS = ("app", "drivers", "plugins", "sim")
STUBS = [stub for layer in LAYERS for stub in sorted((ROOT / layer).rglob("__init__.pyi"))]
FOLDERS = [file.parent for layer in LAYERS for file in sorted((ROOT / layer).rglob("__init__.py"))]
MAX_FILES = 25
# One file per effect.
LARGE_FOLDERS = {"sim/effects"}


def list_exports(stub):
    """Return the names that a folder exports."""
    return [
        alias.asname or alias.name
        for node in ast.parse(stub.read_text("utf-8")).body
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
    ]


def name_folder(folder):
    return folder.relative_to(ROOT).as_posix()


def test_every_exported_name_exists():
    assert len(STUBS) > 50
    for stub in STUBS:
        folder = import_module("rotemina." + name_folder(stub.parent).replace("/", "."))
        exports = list_exports(stub)
        assert sorted(folder.__all__) == sorted(exports), folder
        assert [name for name in exports if not hasattr(folder, name)] == [], folder


def test_no_folder_has_too_many_files():
    sizes = {name_folder(folder): len(list(folder.glob("*.py"))) - 1 for folder in FOLDERS}
    assert {
        name: size for name, size in sizes.items() if size > MAX_FILES and name not in LARGE_FOLDERS
    } == {}
