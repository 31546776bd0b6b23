"""``rotemina plugin``: a new package, the list of plugins, and the check with its exit status."""

import pytest

from rotemina.app import plugin_kit
from rotemina.app.cli.main import main
from rotemina.app.plugin_kit import PluginKind, plugin_kinds
from rotemina.drivers.cameras import CameraSource
from rotemina.drivers.conformance import CheckVerdict, DriverCheckResult
from rotemina.drivers.contract import registry


def test_new_writes_a_package_and_prints_the_next_steps(tmp_path, capsys):
    assert main(["plugin", "new", "driver", "glass", "--folder", str(tmp_path)]) == 0
    output = capsys.readouterr().out
    assert f"pip install --editable '{tmp_path / 'rotemina-glass'}[test]'" in output
    assert "rotemina plugin check glass" in output
    assert (tmp_path / "rotemina-glass" / "pyproject.toml").is_file()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ("new panel Glass", "'Glass' cannot be the name of a plugin"),
        ("new effect delay", "the effect 'delay' already exists (of the package rotemina)"),
        ("check no_such", "there is no plugin 'no_such'"),
        ("check delay --kind camera", "there is no camera 'delay'"),
    ],
)
def test_bad_input_is_refused(get_refusal, arguments, message):
    assert message in get_refusal(f"plugin {arguments}")


def test_unknown_kind_is_refused(capsys):
    with pytest.raises(SystemExit):
        main(["plugin", "new", "gripper", "glass"])
    assert "driver" in capsys.readouterr().err


def test_list_has_a_line_for_each_plugin_including_broken_ones(monkeypatch, capsys):
    reason = "no.such:Thing cannot be imported"
    cameras = registry.discover_plugins(PluginKind.CAMERA.group, CameraSource).plugins
    monkeypatch.setitem(
        plugin_kinds._FINDERS,
        PluginKind.CAMERA,
        lambda: ({"opencv": cameras["opencv"]}, {"sequence": reason, "micromanager": reason}),
    )
    assert main(["plugin", "list", "camera"]) == 0
    heading, *lines = capsys.readouterr().out.splitlines()
    assert heading.split() == ["kind", "name", "package", "version", "interface", "state"]
    broken_line, good_line = lines[0].split(maxsplit=7), lines[1].split()
    assert good_line[:3] == ["camera", "opencv", "rotemina"]
    version = str(PluginKind.CAMERA.api_version)
    assert good_line[4:] == [version, "of", version, "loaded"]
    assert broken_line[1] == "micromanager"
    assert broken_line[4] == "?"
    assert broken_line[7] == f"left out: {reason}"


def test_list_without_a_kind_covers_all_kinds(monkeypatch, capsys):
    for kind in PluginKind:
        monkeypatch.setitem(plugin_kinds._FINDERS, kind, lambda: ({}, {}))
    monkeypatch.setattr(plugin_kinds, "entry_points", lambda group: [])
    assert main(["plugin", "list"]) == 0
    assert len(capsys.readouterr().out.splitlines()) == 1


@pytest.mark.parametrize(
    ("verdict", "status"), [(CheckVerdict.PASSED, 0), (CheckVerdict.FAILED, 1)]
)
def test_check_prints_results_and_returns_status(monkeypatch, capsys, verdict, status):
    results = [DriverCheckResult("painting", "paint itself", verdict, "what was seen")]
    monkeypatch.setattr(plugin_kit, "check_plugin", lambda *_: iter(results))
    assert main(["plugin", "check", "plots"]) == status
    output = capsys.readouterr().out
    assert output.startswith("panel plots (rotemina.plugins.plots.panel:PlotsPanel)\n")
    assert "what was seen" in output
    assert ("paint itself" in output) == bool(status)


def test_check_of_an_effect_runs_the_effect_checks(capsys):
    assert main(["plugin", "check", "sensor_gain"]) == 0
    output = capsys.readouterr().out
    assert "ok      loading" in output
    assert "stays finite at presets and bounds" in output
