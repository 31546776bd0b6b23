"""New packages: their names and files. Nothing is overwritten or written in part."""

import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from rotemina.app.errors import PluginNameError, PluginWriteError
from rotemina.app.plugin_kit import PluginKind, write_plugin, writing
from rotemina.app.plugin_kit.writing import render_package

OWN_PROJECT = tomllib.loads((Path(__file__).parents[3] / "pyproject.toml").read_text("utf-8"))
LONGEST_NAME = "glass_stage_of_the_other_robot"


@pytest.mark.parametrize("kind", PluginKind)
def test_package_declares_its_content(kind):
    files = render_package(kind, "glass_stage")
    project = tomllib.loads(files["pyproject.toml"])["project"]
    assert project["name"] == "rotemina-glass-stage"
    ((group, points),) = project["entry-points"].items()
    assert group == kind.group
    module, _, attribute = points["glass_stage"].partition(":")
    text = files[f"src/{module.replace('.', '/')}.py"]
    assert f"\n{attribute} = " in text or f"\nclass {attribute}(" in text
    assert f"api_version={kind.api_version}" in text.replace(" ", "")
    assert "rotemina plugin check glass_stage" in files["README.md"]
    for name, text in files.items():
        assert "{" + "{" not in text, name
        if name.endswith(".py"):
            compile(text, name, "exec")


@pytest.mark.parametrize("name", ["a", LONGEST_NAME])
def test_packages_follow_the_style_of_the_program(tmp_path, name):
    ruff = shutil.which("ruff", path=Path(sys.executable).parent)
    if ruff is None:
        pytest.skip("ruff is not installed")
    for kind in PluginKind:
        (tmp_path / kind).mkdir()
        write_plugin(kind, name, tmp_path / kind)
    for command in (["check", "--no-cache"], ["format", "--check", "--no-cache"]):
        process = subprocess.run([ruff, *command, tmp_path], capture_output=True, text=True)
        assert process.returncode == 0, process.stdout


def test_packages_use_the_style_rules_of_the_program():
    package_rules = tomllib.loads(render_package(PluginKind.DRIVER, "any")["pyproject.toml"])[
        "tool"
    ]["ruff"]
    own_rules = OWN_PROJECT["tool"]["ruff"]
    for key in ("line-length", "target-version"):
        assert package_rules[key] == own_rules[key]
    for key in ("select", "ignore"):
        assert package_rules["lint"][key] == own_rules["lint"][key]


@pytest.mark.parametrize(
    "name", ["", "Stage", "1st", "a-b", "_a", "a_", "a__b", "../a", "ä", "a" * 31, "a\n"]
)
def test_bad_name_is_refused(tmp_path, name):
    with pytest.raises(PluginNameError, match="must have small letters"):
        write_plugin(PluginKind.PANEL, name, tmp_path)
    assert list(tmp_path.iterdir()) == []


def test_taken_name_is_refused_only_for_its_kind(tmp_path):
    with pytest.raises(PluginNameError, match=r"effect 'delay' already exists.*package rotemina"):
        write_plugin(PluginKind.EFFECT, "delay", tmp_path)
    assert write_plugin(PluginKind.PANEL, "delay", tmp_path).is_dir()


@pytest.mark.parametrize("existing", ["folder", "file", "dangling"])
def test_existing_path_is_not_overwritten(tmp_path, existing):
    path = tmp_path / "rotemina-glass"
    if existing == "folder":
        path.mkdir()
        (path / "mine.txt").write_text("mine")
    elif existing == "file":
        path.write_text("mine")
    else:
        path.symlink_to(tmp_path / "nowhere")
    with pytest.raises(PluginWriteError, match="not overwritten"):
        write_plugin(PluginKind.PANEL, "glass", tmp_path)
    assert [entry.name for entry in tmp_path.iterdir()] == ["rotemina-glass"]


def test_package_that_cannot_be_completed_leaves_nothing(tmp_path, monkeypatch):
    with pytest.raises(PluginWriteError, match="folder not found"):
        write_plugin(PluginKind.PANEL, "glass", tmp_path / "gone")
    files = dict(render_package(PluginKind.PANEL, "glass"))
    files["README.md/inside"] = "a file cannot be a folder"
    monkeypatch.setattr(writing, "render_package", lambda *_: files)
    with pytest.raises(PluginWriteError, match="cannot be written"):
        write_plugin(PluginKind.PANEL, "glass", tmp_path)
    assert list(tmp_path.iterdir()) == []
