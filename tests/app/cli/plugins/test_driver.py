"""``rotemina driver``: the list of installed drivers, and the check with its exit status."""

from importlib.metadata import EntryPoint

import pytest

from rotemina.app.cli.main import main
from rotemina.drivers.contract import registry

PLUGIN_SOURCE = """
from rotemina.drivers.simulator import Simulator


class Careless(Simulator):
    def _move_velocity(self, velocities, lease_s, permit):
        super()._move_velocity(velocities, 1e6, permit)


class Real(Simulator):
    virtual_time = False
"""


@pytest.fixture
def plugins(tmp_path, monkeypatch):
    """Install a driver that ignores leases, one in real time, and one that cannot be imported."""
    (tmp_path / "careless_drivers.py").write_text(PLUGIN_SOURCE, "utf-8")
    monkeypatch.syspath_prepend(str(tmp_path))
    values = {
        "careless": "careless_drivers:Careless",
        "real": "careless_drivers:Real",
        "lost": "no_such_module:Lost",
    }
    points = [EntryPoint(name, value, registry.DRIVER_GROUP) for name, value in values.items()]
    monkeypatch.setattr(registry, "entry_points", lambda group: points)


def test_list_has_a_line_for_each_driver(capsys):
    assert main(["driver"]) == 0
    lines = capsys.readouterr().out.splitlines()
    (line,) = [line for line in lines if line.startswith("simulator ")]
    assert "any clock" in line
    assert "VelocityMover, AxisHomer, VoltageOutput" in line


def test_list_reports_drivers_that_cannot_be_loaded(plugins, capsys):
    assert main(["driver", "list"]) == 0
    assert "left out: lost: no_such_module:Lost cannot be imported" in capsys.readouterr().out


def test_check_passes_with_status_0(capsys):
    options = ["--only", "units", "--only", "making", "--only", "fault"]
    assert main(["driver", "check", "simulator", "--robot", "fsm", *options]) == 0
    making_line, fault_line, units_line, summary_line = capsys.readouterr().out.splitlines()
    assert making_line.split() == ["ok", "making"]
    assert fault_line.split()[:2] == ["-", "fault"]
    assert "cannot cause fault" in fault_line
    assert units_line.split() == ["ok", "units"]
    assert summary_line == "simulator on Fine steering mirror: 2 passed, 0 failed, 1 skipped"


def test_failed_check_has_status_1_and_reports_the_observation(plugins, capsys):
    assert main(["driver", "check", "careless", "--only", "lease-expiry"]) == 1
    failed, demand, _ = capsys.readouterr().out.splitlines()
    assert failed.split()[:2] == ["FAILED", "lease-expiry"]
    assert "expected: at most 247 ms" in failed
    assert "without a fault" in demand


def test_settings_reach_the_driver(capsys):
    command = ["driver", "check", "simulator", "--only", "homing", "--verbose"]
    assert main([*command, "--set", "start_homed = 0", "--set", "sample_rate_hz=500"]) == 0
    assert "After homing the position is known" in capsys.readouterr().out


def test_real_device_moves_only_on_request(plugins, capsys):
    options = ["--only", "making", "--only", "units"]
    assert main(["driver", "check", "real", *options]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert "--move lets the axes move" in lines[0]
    assert lines[2].endswith("it moves axes")
    assert main(["driver", "check", "real", "--move", "--only", "making"]) == 0
    assert "ALL AXES WILL MOVE" in capsys.readouterr().out.splitlines()[0]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ("nope", "nope"),
        ("simulator --robot no_such_robot", "no_such_robot"),
        ("simulator --only nonsense", "nonsense"),
        ("simulator --set seed", "name=value"),
        ("simulator --set colour=red", "colour"),
        ("simulator --set seed=1.5", "'1.5' is not an integer"),
        ("simulator --set seed=1_0", "'1_0' is not an integer"),
        ("simulator --set settle_s=nan", "'nan' is not a number"),
        ("simulator --set start_homed=perhaps", "true or false"),
        ("simulator --set settle_s=-1", "settle_s"),
    ],
)
def test_bad_input_is_refused(arguments, message, get_refusal):
    assert message in get_refusal(f"driver check {arguments}")
