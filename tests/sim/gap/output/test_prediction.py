"""Response of the corrected model to new commands."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.errors import InputError
from rotemina.sim.gap.output import predict
from rotemina.sim.gap.result import ModelOffset
from rotemina.sim.records import Record, Tap, read_record, write_record
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")
WORN_ROBOT = replace(
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


def test_every_modelled_tap_is_predicted_without_noise():
    commands = make_commands()
    prediction = predict(WORN_ROBOT, commands)
    names = ["thx.cmd", "thx.u", "thx.ref", "thx.meas", "x.cmd", "x.ref", "x.meas"]
    assert [str(column) for column in prediction.columns] == names
    assert np.array_equal(prediction.values, simulate(WORN_ROBOT, None, commands).values)
    assert not np.array_equal(prediction.values, simulate(ROBOT, None, commands).values)


def test_a_measured_record_is_predicted_only_from_its_commands():
    commands = make_commands()
    measured = simulate(WORN_ROBOT, None, commands, np.random.default_rng(4))
    assert np.array_equal(
        predict(WORN_ROBOT, measured).values, predict(WORN_ROBOT, commands).values
    )


def test_a_prediction_describes_itself_and_can_be_read_back(tmp_path):
    commands = make_commands(note="n", **{"simulated seed": "3", "predicted effect 9": "old"})
    record = predict(replace(WORN_ROBOT, name="two\nlines"), commands)
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
    prediction = predict(ROBOT, commands)
    meas = prediction.signal("zn", Tap.MEAS)
    assert meas[:200] == pytest.approx(meas[800:], abs=1e-12)
    assert prediction.history == "periodic"


def test_a_record_of_unknown_history_starts_at_its_measurement_or_at_rest():
    commands = make_commands(("zn",), history="unknown")
    from_rest = predict(ROBOT, commands)
    assert from_rest.history == "rest"
    assert np.array_equal(from_rest.values, predict(ROBOT, make_commands(("zn",))).values)
    measured_signals = {
        ("zn", Tap.CMD): commands.signal("zn", Tap.CMD),
        ("zn", Tap.REF): commands.signal("zn", Tap.CMD) + 1e-5,
    }
    from_measurement = predict(
        ROBOT,
        Record.from_signals(commands.time_s, measured_signals, {"zn": "m"}, commands.metadata),
    )
    assert from_measurement.history == "unknown"
    assert from_measurement.signal("zn", Tap.REF)[0] == pytest.approx(
        from_rest.signal("zn", Tap.REF)[0] + 1e-5
    )


def test_a_force_axis_needs_its_voltage_or_a_controller():
    emps = load_robot("emps")
    time_s = np.arange(500) / 1000.0
    command = 0.1 + 0.01 * np.sin(3.0 * time_s) ** 2
    closed_loop = Record.from_signals(
        time_s, {("q", Tap.CMD): command}, {"q": "m"}, {"mode": "closed_loop"}
    )
    prediction = predict(emps, closed_loop)
    assert prediction.closed_loop
    assert prediction.signal("q", Tap.U).any()
    open_loop = Record.from_signals(time_s, {("q", Tap.CMD): command}, {"q": "m"})
    with pytest.raises(InputError, match=r"needs a q\.u column"):
        predict(emps, open_loop)


@pytest.mark.parametrize(
    ("axis", "unit", "message"),
    [
        ("w", "m", "is no axis of the diagnosed robot 'RoTeMiNa', which has x, y"),
        ("thx", "m", "axis 'thx' of the commands is in units of m, but"),
    ],
)
def test_commands_of_another_robot_are_refused(axis, unit, message):
    commands = Record.from_signals(np.arange(3.0), {(axis, Tap.CMD): np.zeros(3)}, {axis: unit})
    with pytest.raises(InputError) as error_info:
        predict(ROBOT, commands)
    assert message in str(error_info.value)


def test_the_memory_of_the_previous_motion_is_carried_over():
    """The prediction is the second half of one run, not a run from rest."""
    full_commands = make_commands(rows=3000)
    first, second = (
        Record.from_signals(
            full_commands.time_s[part] - full_commands.time_s[part][0],
            {
                (axis, Tap.CMD): full_commands.signal(axis, Tap.CMD)[part]
                for axis in full_commands.axes
            },
            full_commands.units,
        )
        for part in (slice(0, 1700), slice(1700, 3000))
    )
    expected = predict(WORN_ROBOT, full_commands)
    continued = predict(WORN_ROBOT, second, after=first)
    assert np.array_equal(continued.time_s, second.time_s)
    for axis in ("thx", "x"):
        expected_reading = expected.signal(axis, Tap.MEAS)[1700:]
        assert continued.signal(axis, Tap.MEAS) == pytest.approx(expected_reading, abs=1e-12)
    from_rest = predict(WORN_ROBOT, second)
    assert (
        np.abs(from_rest.signal("thx", Tap.MEAS) - continued.signal("thx", Tap.MEAS)).max() > 1e-6
    )


def test_a_pause_holds_the_last_command():
    """Creep continues during the pause."""
    creeping_robot = replace(ROBOT, effects=(AxisEffect(axis="thx", id="creep"),))
    commands = make_commands(axes=("thx",))
    at_once = predict(creeping_robot, commands, after=commands)
    later = predict(creeping_robot, commands, after=commands, pause_s=20.0)
    change = later.signal("thx", Tap.MEAS) - at_once.signal("thx", Tap.MEAS)
    assert np.abs(change).max() > 1e-7


def test_the_previous_motion_must_contain_the_axes_and_a_pause_must_not_be_negative():
    commands = make_commands()
    with pytest.raises(InputError, match="not in the previous motion, which has thx"):
        predict(WORN_ROBOT, commands, after=make_commands(axes=("thx",)))
    with pytest.raises(InputError, match="pause = -1 s: must be 0 s or more"):
        predict(WORN_ROBOT, commands, after=commands, pause_s=-1.0)


def test_an_offset_on_which_records_agree_is_predicted():
    commands = make_commands()
    with_offset = predict(WORN_ROBOT, commands, {"thx": {Tap.MEAS: ModelOffset(2e-6, 1e-7)}})
    plain = predict(WORN_ROBOT, commands)
    change = with_offset.signal("thx", Tap.MEAS) - plain.signal("thx", Tap.MEAS)
    assert change == pytest.approx(2e-6)
    assert np.array_equal(with_offset.signal("thx", Tap.REF), plain.signal("thx", Tap.REF))
