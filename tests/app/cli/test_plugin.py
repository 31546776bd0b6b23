"""``rotemina plugin``: a new package, what is installed, and the check with its exit status."""

import pytest

from rotemina.app.cli.main import main
from rotemina.app.plugin_kit import checking, plugin_kinds
from rotemina.app.plugin_kit.plugin_kinds import Kind
from rotemina.drivers import registry
from rotemina.drivers.cameras.source import CameraSource
from rotemina.drivers.conformance.check import Result, Verdict


def test_new_writes_a_package_and_says_what_comes_next(tmp_path, capsys):
    assert main(["plugin", "new", "driver", "glass", "--folder", str(tmp_path)]) == 0
    said = capsys.readouterr().out
    assert f"pip install --editable '{tmp_path / 'rotemina-glass'}[test]'" in said
    assert "rotemina plugin check glass" in said
    assert (tmp_path / "rotemina-glass" / "pyproject.toml").is_file()


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["new", "panel", "Glass"], "'Glass' cannot be the name of a plugin"),
        (
            ["new", "effect", "delay"],
            "the effect 'delay' already exists (of the package rotemina)",
        ),
        (["check", "no_such"], "there is no plugin 'no_such'"),
        (["check", "delay", "--kind", "camera"], "there is no camera 'delay'"),
    ],
)
def test_bad_input_is_one_clear_line(tmp_path, monkeypatch, capsys, arguments, said):
    monkeypatch.chdir(tmp_path)
    assert main(["plugin", *arguments]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert said in line
    assert list(tmp_path.iterdir()) == []


def test_an_unknown_kind_is_refused(capsys):
    with pytest.raises(SystemExit):
        main(["plugin", "new", "gripper", "glass"])
    assert "driver" in capsys.readouterr().err


def test_list_has_a_line_for_each_plugin_and_says_what_was_left_out(monkeypatch, capsys):
    reason = "no.such:Thing cannot be imported"
    ours = registry.discover(Kind.CAMERA.group, CameraSource).found
    monkeypatch.setitem(
        plugin_kinds._FINDERS,
        Kind.CAMERA,
        lambda: ({"opencv": ours["opencv"]}, {"sequence": reason, "micromanager": reason}),
    )
    assert main(["plugin", "list", "camera"]) == 0
    head, *lines = capsys.readouterr().out.splitlines()
    assert head.split() == ["kind", "name", "package", "version", "interface", "state"]
    broken, good = lines[0].split(maxsplit=7), lines[1].split()
    assert good[:3] == ["camera", "opencv", "rotemina"]
    assert good[4:] == ["1", "of", "1", "loaded"]
    assert broken[1] == "micromanager"
    assert broken[4] == "?"
    assert broken[7] == f"left out: {reason}"


def test_list_without_a_kind_has_all_kinds(monkeypatch, capsys):
    for kind in Kind:
        monkeypatch.setitem(plugin_kinds._FINDERS, kind, lambda: ({}, {}))
    monkeypatch.setattr(plugin_kinds, "entry_points", lambda group: [])
    assert main(["plugin", "list"]) == 0
    assert len(capsys.readouterr().out.splitlines()) == 1


@pytest.mark.parametrize(("verdict", "status"), [(Verdict.PASSED, 0), (Verdict.FAILED, 1)])
def test_check_tells_each_result_and_its_status(monkeypatch, capsys, verdict, status):
    found = [Result("painting", "paint itself", verdict, "what was seen")]
    monkeypatch.setattr(checking, "check_plugin", lambda *_: iter(found))
    assert main(["plugin", "check", "plots"]) == status
    said = capsys.readouterr().out
    assert said.startswith("panel plots (rotemina.plugins.plots.panel:PlotsPanel)\n")
    assert "what was seen" in said
    assert ("paint itself" in said) == bool(status)


def test_check_of_an_effect_runs_the_kit_of_effects(capsys):
    assert main(["plugin", "check", "sensor_gain"]) == 0
    said = capsys.readouterr().out
    assert "ok      loading" in said
    assert "stays finite at presets and bounds" in said
