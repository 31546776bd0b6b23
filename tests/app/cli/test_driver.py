"""``rotemina driver``: what is installed, and the check with its exit status."""

from importlib.metadata import EntryPoint

import pytest

from rotemina.app.cli.main import main
from rotemina.drivers import registry

PLUGINS = """
from rotemina.drivers.simulator.driver import Simulator


class Careless(Simulator):
    def _move_velocity(self, velocities, lease_s, permit):
        super()._move_velocity(velocities, 1e6, permit)


class Real(Simulator):
    virtual_time = False
"""


@pytest.fixture
def plugins(tmp_path, monkeypatch):
    """A driver that ignores leases, one in real time, and one that is missing."""
    (tmp_path / "careless_drivers.py").write_text(PLUGINS, "utf-8")
    monkeypatch.syspath_prepend(str(tmp_path))
    values = {
        "careless": "careless_drivers:Careless",
        "real": "careless_drivers:Real",
        "lost": "no_such_module:Lost",
    }
    points = [EntryPoint(name, value, registry.DRIVERS) for name, value in values.items()]
    monkeypatch.setattr(registry, "entry_points", lambda group: points)


@pytest.mark.parametrize("command", [["driver"], ["driver", "list"]])
def test_list_has_a_line_for_each_driver(command, capsys):
    assert main(command) == 0
    lines = capsys.readouterr().out.splitlines()
    (line,) = [line for line in lines if line.startswith("simulator ")]
    assert "any clock" in line
    assert "VelocityMover, Homer, VoltageOutput" in line


def test_list_says_what_cannot_be_loaded_and_why(plugins, capsys):
    assert main(["driver", "list"]) == 0
    assert "left out: lost: no_such_module:Lost cannot be imported" in capsys.readouterr().out


def test_check_passes_with_status_0(capsys):
    only = ["--only", "units", "--only", "making", "--only", "fault"]
    assert main(["driver", "check", "simulator", "--robot", "fsm", *only]) == 0
    making, fault, units, summary = capsys.readouterr().out.splitlines()
    assert making.split() == ["ok", "making"]
    assert fault.split()[:2] == ["-", "fault"]
    assert "cannot cause fault" in fault
    assert units.split() == ["ok", "units"]
    assert summary == "simulator on Fine steering mirror: 2 passed, 0 failed, 1 skipped"


def test_check_fails_with_status_1_and_says_what_was_seen(plugins, capsys):
    assert main(["driver", "check", "careless", "--only", "lease-expiry"]) == 1
    failed, demand, _ = capsys.readouterr().out.splitlines()
    assert failed.split()[:2] == ["FAILED", "lease-expiry"]
    assert "expected: at most 247 ms" in failed
    assert "without a fault" in demand


def test_settings_reach_the_driver(capsys):
    command = ["driver", "check", "simulator", "--only", "homing", "--verbose"]
    assert main([*command, "--set", "start_homed=false", "--set", "sample_rate_hz=500"]) == 0
    assert "After homing the position is known" in capsys.readouterr().out


def test_a_real_device_moves_only_when_that_is_asked_for(plugins, capsys):
    only = ["--only", "making", "--only", "units"]
    assert main(["driver", "check", "real", *only]) == 0
    said = capsys.readouterr().out.splitlines()
    assert "--move lets the axes move" in said[0]
    assert said[2].endswith("it moves axes")
    assert main(["driver", "check", "real", "--move", "--only", "making"]) == 0
    assert "ALL AXES WILL MOVE" in capsys.readouterr().out.splitlines()[0]


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        (["nope"], "nope"),
        (["simulator", "--robot", "no_such_robot"], "no_such_robot"),
        (["simulator", "--only", "nonsense"], "nonsense"),
        (["simulator", "--set", "seed"], "KEY=VALUE"),
        (["simulator", "--set", "colour=red"], "colour"),
        (["simulator", "--set", "seed=1.5"], "must be int"),
        (["simulator", "--set", "start_homed=perhaps"], "true or false"),
        (["simulator", "--set", "settle_s=-1"], "settle_s"),
    ],
)
def test_bad_input_is_one_line_and_status_2(arguments, named, capsys):
    assert main(["driver", "check", *arguments]) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert len(captured.err.splitlines()) == 1
    assert named in captured.err
