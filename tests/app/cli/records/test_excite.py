"""``rotemina excite`` from the command line."""

from pathlib import Path

import numpy as np
import pytest

from rotemina.app.cli.main import main
from rotemina.sim.excitation import EXCITATION_KINDS
from rotemina.sim.records import Tap, read_record


@pytest.mark.parametrize(
    ("kind", "robot"),
    [
        *((kind, "rotemina") for kind in EXCITATION_KINDS),
        *(("multisine", robot) for robot in ("fsm", "picma", "emps")),
    ],
)
def test_kind_writes_a_file_that_names_its_excitation(kind, robot, capsys):
    limits = [] if robot == "rotemina" else ["--max-speed", "100mm/s"]
    assert main(["excite", kind, "--robot", robot, *limits, "-o", "it.csv"]) == 0
    record = read_record("it.csv")
    assert record.metadata["excitation"] == kind
    output = capsys.readouterr().out
    assert output.startswith(f"it.csv: {len(record.time_s)} rows")
    assert all(f"  {axis}: {kind}; " in output for axis in record.axes)
    assert main(["play", "it.csv", "--robot", robot, "--dry-run"]) == 0


def test_each_axis_can_have_its_own_values():
    arguments = (
        "excite sine --axes x,thx,zn --amplitude x=20um,thx=200urad,10% --frequency zn=2,1 "
        "--offset x=30mm -o it.csv"
    )
    assert main(arguments.split()) == 0
    record = read_record("it.csv")
    assert record.axes == ("x", "thx", "zn")
    spans = [np.ptp(record.signal(axis, Tap.CMD)) for axis in record.axes]
    assert spans == pytest.approx([40e-6, 400e-6, 13e-6], rel=1e-4)
    assert record.signal("x", Tap.CMD).mean() == pytest.approx(0.03, rel=1e-4)
    assert "frequency_hz = 2;" in record.metadata["excitation zn"]
    assert "frequency_hz = 1;" in record.metadata["excitation thx"]


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        ("sine --frequency 2Hz --duration 3s --periodic", "cycles = 6"),
        ("triangle --frequency 2 --offset 25%", "offset_rad = 0.000290887"),
        ("decaying-triangle --growing", "growing = True"),
        ("staircase --levels 4 --hold 0.2", "levels = 4; hold_s = 0.2"),
        ("multisine --band 2:100 --period 0.5 --detection 0 --slope -1", "lines = 1 3 5 7 9 "),
        ("chirp --band 1:100 --spacing linear --duration 5", "spacing = linear"),
        ("prbs --order 7 --frequency 100 --no-periodic", "order = 7"),
        ("sweeps --speeds 1mrad/s:50urad/s", "speeds_rad_per_s = 0.001 5e-05"),
        ("steps --rise 0.1 --jerk 1000mrad/s3 --cycles 2", "cycles = 2"),
    ],
)
def test_every_parameter_has_its_option(arguments, text):
    assert main(["excite", *arguments.split(), "--axes", "thx", "-o", "it.csv"]) == 0
    assert text in read_record("it.csv").metadata["excitation thx"]


def test_same_seed_writes_same_bytes():
    for name, seed in (("a.csv", "3"), ("b.csv", "3"), ("c.csv", "4")):
        options = ["--axes", "thx,thy", "--seed", seed, "--rate", "1000", "-o", name]
        assert main(["excite", "multisine", *options]) == 0
    assert Path("a.csv").read_bytes() == Path("b.csv").read_bytes()
    assert Path("a.csv").read_bytes() != Path("c.csv").read_bytes()
    record = read_record("a.csv")
    assert record.history == "periodic"
    assert record.period_samples == 1000


def test_reduced_amplitude_is_reported(capsys, get_refusal):
    arguments = ["excite", "sine", "--axes", "x", "--amplitude", "5mm", "--frequency", "1"]
    assert main([*arguments, "-o", "it.csv"]) == 0
    output = capsys.readouterr().out
    assert (
        "changed: axis x: amplitude 5 mm → 1.59156 mm (× 0.3183), for the speed limit 10 mm/s"
        in output
    )
    assert get_refusal([*arguments, "--strict", "-o", "strict.csv"]) == (
        "rotemina: axis x: amplitude 5 mm is beyond 1.59156 mm, "
        "the most permitted by the speed limit 10 mm/s\n"
    )


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ("noise", "unknown kind 'noise'; use one of sine, triangle"),
        ("sine --axes w", "axis 'w': robot 'RoTeMiNa' has no such axis"),
        ("sine --axes ,", "no axis is named"),
        ("sine --hold 1", "sine has no --hold; it takes --amplitude --offset --frequency"),
        ("sine --amplitude 5", "--amplitude: '5' has no unit"),
        ("sine --amplitude 5um", "--amplitude: axis thx: '5um' is in m, not in rad"),
        ("sine --axes x --amplitude 5kg", "unknown unit 'kg'"),
        ("sine --axes x --amplitude y=5um", "--amplitude: axis 'y' is not one of those that move"),
        ("sine --axes x --amplitude 5um,6um", "two values for an axis"),
        ("sine --axes x --amplitude=-5um", "must be above 0"),
        ("sine --frequency fast", "--frequency: 'fast' is not a number of Hz"),
        ("sine --frequency 0", "frequency_hz = 0: must be a finite number above 0"),
        ("sine --seed -1", "seed -1: must be 0 or more"),
        ("chirp --band 5", "--band: '5'; write it as LOW:HIGH"),
        ("chirp --spacing odd", "--spacing: 'odd' is not one of log, linear"),
        ("prbs --order 1.5", "--order: '1.5' is not an integer"),
        ("prbs --order 99", "order = 99: must lie between 3 and 20"),
        ("sweeps --axes x --speeds 1mm", "is in m, not in m/s"),
        ("staircase --hold 1e12", "rows"),
        ("sine -o no/such/folder/it.csv", "it.csv"),
    ],
)
def test_bad_request_is_refused(arguments, message, get_refusal):
    output = "" if "-o " in arguments else "-o it.csv"
    assert message in get_refusal(f"excite {arguments} {output}")


def test_missing_speed_limit_is_requested_and_then_observed(capsys, get_refusal):
    arguments = "excite triangle --robot fsm --axes m1,m2 -o it.csv --frequency 1 --amplitude 1um"
    error = get_refusal(arguments)
    assert "states no speed limit (max_speed) of m1 and m2" in error
    assert "--max-speed m1=1mm/s,m2=1mm/s" in error
    assert main([*arguments.split(), "--max-speed", "m1=2um/s,1um/s"]) == 0
    assert "for the speed limit 2 µm/s" in capsys.readouterr().out
    record = read_record("it.csv")
    speeds = [np.abs(np.diff(record.signal(axis, Tap.CMD))).max() for axis in ("m1", "m2")]
    rate_hz = float(record.metadata["rate_hz"])
    assert np.multiply(speeds, rate_hz) == pytest.approx([2e-6, 1e-6], rel=1e-3)


@pytest.mark.parametrize(
    ("speed", "message"),
    [
        ("fast", "--max-speed fast: 'fast' is not an amount"),
        ("10%", "--max-speed 10%: must be a speed above 0, such as 10mm/s"),
        ("5mm", "--max-speed 5mm: is in m, not in m/s"),
        ("m1=1mrad/s", "--max-speed m1=1mrad/s: is in rad/s, not in m/s"),
        ("m2=1mm/s", "--max-speed m2=1mm/s: axis 'm2' does not move; use one of m1"),
        ("1mm/s,2mm/s", "--max-speed 1mm/s,2mm/s: has two values for m/s"),
    ],
)
def test_invalid_speed_limit_is_refused(speed, message, get_refusal):
    arguments = f"excite sine --robot fsm --axes m1 --max-speed={speed} -o it.csv"
    assert message in get_refusal(arguments)


def test_page_names_every_kind():
    page = (Path(__file__).parents[4] / "docs" / "excitations.md").read_text("utf-8")
    assert [kind for kind in EXCITATION_KINDS if f"| `{kind}` |" not in page] == []
