"""What the corrected model answers to new commands."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.errors import InputError
from rotemina.sim.gap.diagnosis import Offset
from rotemina.sim.gap.output.prediction import predict
from rotemina.sim.records.reading import read_record
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.records.writing import write_record
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")
WORN = replace(
    ROBOT,
    effects=(
        AxisEffect(axis="thx", id="hysteresis", parameters={"width": 1.1e-4}),
        AxisEffect(axis="x", id="backlash", parameters={"width": 2e-6}),
        AxisEffect(axis="thx", id="sensor_noise"),
    ),
)


def make_commands(axes=("thx", "x"), rows=1500, **metadata):
    time_s = np.arange(rows) / 1000.0
    swing = 0.5 + 0.3 * np.sin(9.0 * time_s) * np.minimum(time_s, 1.0)
    signals = {(axis, Tap.CMD): min(ROBOT.axes[axis].span, 1e-3) * swing for axis in axes}
    return Record.from_signals(time_s, signals, {a: ROBOT.unit(a) for a in axes}, metadata)


def test_every_modelled_tap_is_there_as_the_machine_without_noise_would_show_it():
    commands = make_commands()
    found = predict(WORN, commands)
    names = ["thx.cmd", "thx.u", "thx.ref", "thx.meas", "x.cmd", "x.ref", "x.meas"]
    assert [str(column) for column in found.columns] == names
    assert np.array_equal(found.values, simulate(WORN, None, commands).values)
    assert not np.array_equal(found.values, simulate(ROBOT, None, commands).values)


def test_a_measured_record_is_predicted_from_its_commands_alone():
    commands = make_commands()
    measured = simulate(WORN, None, commands, np.random.default_rng(4))
    assert np.array_equal(predict(WORN, measured).values, predict(WORN, commands).values)


def test_a_prediction_says_what_it_is_and_reads_back(tmp_path):
    commands = make_commands(note="n", **{"simulated seed": "3", "predicted effect 9": "old"})
    record = predict(replace(WORN, name="two\nlines"), commands)
    write_record(record, tmp_path / "p.csv")
    read_back = read_record(tmp_path / "p.csv", robot=ROBOT)
    assert np.array_equal(read_back.values, record.values)
    metadata = read_back.metadata
    assert metadata["note"] == "n"
    assert metadata["predicted by"] == "the corrected model of a gap diagnosis"
    assert metadata["predicted robot"] == "two lines"
    assert metadata["predicted effect 1"].startswith("hysteresis on thx; ")
    assert "simulated seed" not in metadata
    assert "predicted effect 9" not in metadata


def test_a_periodic_file_begins_in_its_steady_state():
    time_s = np.arange(1000) / 1000.0
    sine = 3e-5 + 1e-5 * np.sin(2.0 * np.pi * 5.0 * time_s)
    commands = Record.from_signals(
        time_s,
        {("zn", Tap.CMD): sine},
        {"zn": "m"},
        {"history": "periodic", "period_samples": "200"},
    )
    found = predict(ROBOT, commands)
    meas = found.signal("zn", Tap.MEAS)
    assert meas[:200] == pytest.approx(meas[800:], abs=1e-12)
    assert found.history == "periodic"


def test_an_unknown_history_begins_where_it_was_measured_or_else_at_rest():
    commands = make_commands(("zn",), history="unknown")
    bare = predict(ROBOT, commands)
    assert bare.history == "rest"
    assert np.array_equal(bare.values, predict(ROBOT, make_commands(("zn",))).values)
    moved = {
        ("zn", Tap.CMD): commands.signal("zn", Tap.CMD),
        ("zn", Tap.REF): commands.signal("zn", Tap.CMD) + 1e-5,
    }
    started = predict(
        ROBOT, Record.from_signals(commands.time_s, moved, {"zn": "m"}, commands.metadata)
    )
    assert started.history == "unknown"
    assert started.signal("zn", Tap.REF)[0] == pytest.approx(bare.signal("zn", Tap.REF)[0] + 1e-5)


def test_a_force_axis_runs_by_its_voltage_or_under_its_controller():
    emps = load_robot("emps")
    time_s = np.arange(500) / 1000.0
    command = 0.1 + 0.01 * np.sin(3.0 * time_s) ** 2
    closed = Record.from_signals(
        time_s, {("q", Tap.CMD): command}, {"q": "m"}, {"mode": "closed_loop"}
    )
    found = predict(emps, closed)
    assert found.closed_loop
    assert found.signal("q", Tap.U).any()
    open_loop = Record.from_signals(time_s, {("q", Tap.CMD): command}, {"q": "m"})
    with pytest.raises(InputError, match=r"needs a q\.u column"):
        predict(emps, open_loop)


@pytest.mark.parametrize(
    ("axis", "unit", "message"),
    [
        ("w", "m", "axis 'w' of the commands: the diagnosed robot 'RoTeMiNa' has x, y"),
        ("thx", "m", "axis 'thx' of the commands is in units of m, but"),
    ],
)
def test_commands_of_another_robot_are_refused(axis, unit, message):
    commands = Record.from_signals(np.arange(3.0), {(axis, Tap.CMD): np.zeros(3)}, {axis: unit})
    with pytest.raises(InputError) as caught:
        predict(ROBOT, commands)
    assert message in str(caught.value)


def test_memory_of_the_motion_before_is_carried_over():
    """What comes out is the second half of one run, and no run from rest."""
    whole = make_commands(rows=3000)
    first, second = (
        Record.from_signals(
            whole.time_s[part] - whole.time_s[part][0],
            {(axis, Tap.CMD): whole.signal(axis, Tap.CMD)[part] for axis in whole.axes},
            whole.units,
        )
        for part in (slice(0, 1700), slice(1700, 3000))
    )
    expected = predict(WORN, whole)
    carried = predict(WORN, second, after=first)
    assert np.array_equal(carried.time_s, second.time_s)
    for axis in ("thx", "x"):
        own = expected.signal(axis, Tap.MEAS)[1700:]
        assert carried.signal(axis, Tap.MEAS) == pytest.approx(own, abs=1e-12)
    fresh = predict(WORN, second)
    assert np.abs(fresh.signal("thx", Tap.MEAS) - carried.signal("thx", Tap.MEAS)).max() > 1e-6


def test_a_pause_holds_the_last_command():
    """What creeps goes on meanwhile."""
    creeping = replace(ROBOT, effects=(AxisEffect(axis="thx", id="creep"),))
    commands = make_commands(axes=("thx",))
    at_once = predict(creeping, commands, after=commands)
    later = predict(creeping, commands, after=commands, pause_s=20.0)
    change = later.signal("thx", Tap.MEAS) - at_once.signal("thx", Tap.MEAS)
    assert np.abs(change).max() > 1e-7


def test_the_motion_before_must_hold_the_axes_and_a_pause_is_no_less_than_nothing():
    commands = make_commands()
    with pytest.raises(InputError, match="'x' of the commands: the motion before has thx"):
        predict(WORN, commands, after=make_commands(axes=("thx",)))
    with pytest.raises(InputError, match="pause = -1 s: must be 0 s or more"):
        predict(WORN, commands, after=commands, pause_s=-1.0)


def test_a_constant_that_records_agree_on_is_predicted():
    commands = make_commands()
    moved = predict(WORN, commands, {"thx": {Tap.MEAS: Offset(2e-6, 1e-7)}})
    plain = predict(WORN, commands)
    added = moved.signal("thx", Tap.MEAS) - plain.signal("thx", Tap.MEAS)
    assert added == pytest.approx(2e-6)
    assert np.array_equal(moved.signal("thx", Tap.REF), plain.signal("thx", Tap.REF))
