"""New packages: names, what is written, and that nothing is overwritten or left half."""

import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from rotemina.app.plugin_kit import writing
from rotemina.app.plugin_kit.plugin_kinds import Kind
from rotemina.app.plugin_kit.writing import (
    PluginNameError,
    PluginWriteError,
    new_plugin,
    rendered,
)

PROJECT = tomllib.loads((Path(__file__).parents[3] / "pyproject.toml").read_text("utf-8"))
LONGEST = "glass_stage_of_the_other_robot"


@pytest.mark.parametrize("kind", Kind)
def test_a_package_names_what_it_holds(kind):
    files = rendered(kind, "glass_stage")
    project = tomllib.loads(files["pyproject.toml"])["project"]
    assert project["name"] == "rotemina-glass-stage"
    ((group, points),) = project["entry-points"].items()
    assert group == kind.group
    module, _, thing = points["glass_stage"].partition(":")
    text = files[f"src/{module.replace('.', '/')}.py"]
    assert f"\n{thing} = " in text or f"\nclass {thing}(" in text
    assert f"api_version={kind.api_version}" in text.replace(" ", "")
    assert "rotemina plugin check glass_stage" in files["README.md"]
    for name, text in files.items():
        assert "{" + "{" not in text, name
        if name.endswith(".py"):
            compile(text, name, "exec")


@pytest.mark.parametrize("name", ["a", LONGEST])
def test_packages_keep_the_style_of_the_program(tmp_path, name):
    ruff = shutil.which("ruff", path=Path(sys.executable).parent)
    if ruff is None:
        pytest.skip("ruff is not installed")
    for kind in Kind:
        (tmp_path / kind).mkdir()
        new_plugin(kind, name, tmp_path / kind)
    for command in (["check", "--no-cache"], ["format", "--check", "--no-cache"]):
        done = subprocess.run([ruff, *command, tmp_path], capture_output=True, text=True)
        assert done.returncode == 0, done.stdout


def test_the_rules_of_style_are_those_of_the_program():
    theirs = tomllib.loads(rendered(Kind.DRIVER, "any")["pyproject.toml"])["tool"]["ruff"]
    ours = PROJECT["tool"]["ruff"]
    for key in ("line-length", "target-version"):
        assert theirs[key] == ours[key]
    for key in ("select", "ignore"):
        assert theirs["lint"][key] == ours["lint"][key]


@pytest.mark.parametrize(
    "name",
    ["", "Stage", "1st", "a-b", "a b", "_a", "a_", "a__b", "../a", "a/b", "ä", "a" * 31, "a\n"],
)
def test_a_bad_name_is_refused(tmp_path, name):
    with pytest.raises(PluginNameError, match="must have small letters"):
        new_plugin(Kind.PANEL, name, tmp_path)
    assert list(tmp_path.iterdir()) == []


def test_a_name_that_is_taken_is_refused_for_that_kind_alone(tmp_path):
    with pytest.raises(PluginNameError, match=r"effect 'delay' already exists.*package rotemina"):
        new_plugin(Kind.EFFECT, "delay", tmp_path)
    assert new_plugin(Kind.PANEL, "delay", tmp_path).is_dir()


@pytest.mark.parametrize("there", ["folder", "file", "dangling"])
def test_nothing_is_overwritten(tmp_path, there):
    place = tmp_path / "rotemina-glass"
    if there == "folder":
        place.mkdir()
        (place / "mine.txt").write_text("mine")
    elif there == "file":
        place.write_text("mine")
    else:
        place.symlink_to(tmp_path / "nowhere")
    with pytest.raises(PluginWriteError, match="not overwritten"):
        new_plugin(Kind.PANEL, "glass", tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["rotemina-glass"]


def test_a_missing_folder_is_refused(tmp_path):
    with pytest.raises(PluginWriteError, match="folder not found"):
        new_plugin(Kind.PANEL, "glass", tmp_path / "gone")


def test_a_package_that_cannot_be_finished_is_not_begun(tmp_path, monkeypatch):
    files = dict(rendered(Kind.PANEL, "glass"))
    files["README.md/inside"] = "a file cannot be a folder"
    monkeypatch.setattr(writing, "rendered", lambda *_: files)
    with pytest.raises(PluginWriteError, match="cannot be written"):
        new_plugin(Kind.PANEL, "glass", tmp_path)
    assert list(tmp_path.iterdir()) == []
