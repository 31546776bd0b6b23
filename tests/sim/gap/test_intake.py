"""Records looked at before a diagnosis: faults are refused or told, effects pass."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.effects.attachment import Attached
from rotemina.sim.effects.errors import EffectError
from rotemina.sim.effects.registry import all_effects
from rotemina.sim.gap.caution import Caution, remarks
from rotemina.sim.gap.diagnosis import Verdict
from rotemina.sim.gap.errors import GapError
from rotemina.sim.gap.intake import check
from rotemina.sim.gap.leaps import pieces
from rotemina.sim.gap.method import diagnose
from rotemina.sim.messages import message
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")
AXES = ("x", "thx", "zn")


def make_commands(axes=AXES, rows=4000, share=0.3, rate_hz=1000.0, **metadata):
    """Each axis there and back at its own pace, with a rest at the end."""
    time_s = np.arange(rows) / rate_hz
    signals = {}
    for number, axis in enumerate(axes, start=1):
        described = ROBOT.axes[axis]
        turn = np.sin(2.0 * np.pi * 0.4 * number * np.minimum(time_s, 0.85 * time_s[-1]))
        way = min(share * described.span, 2e-3)
        signals[axis, Tap.CMD] = sum(described.range) / 2.0 + way * turn
    return Record.from_signals(time_s, signals, {a: ROBOT.unit(a) for a in axes}, metadata)


def measured(effects=(), seed=0, **how):
    return simulate(ROBOT, effects, make_commands(**how), np.random.default_rng(seed))


def changed(record, taps=None, **metadata):
    """The record with some signals in place of its own; None takes one away."""
    signals = {channel: record.signal(*channel) for channel in record.columns} | dict(taps or {})
    kept = {channel: signal for channel, signal in signals.items() if signal is not None}
    return Record.from_signals(record.time_s, kept, record.units, dict(record.metadata) | metadata)


def timed(record, time_s):
    return Record(time_s, record.columns, np.array(record.values), record.units, record.metadata)


def refusal(*records, robot=ROBOT, names=()):
    with pytest.raises(GapError) as caught:
        check(robot, records, names)
    assert "\n" not in str(caught.value)
    return str(caught.value)


def test_healthy_records_pass_without_a_word():
    records = [measured(), measured(seed=1, rate_hz=2000.0), measured(seed=2, share=0.1)]
    assert check(ROBOT, records) == ()


def effects_on(axis):
    for effect in all_effects()[0].values():
        for formulation in effect.formulations:
            source = ("zn" if axis == "x" else "x") if effect.coupled else None
            asked = AxisEffect(
                axis=axis, id=effect.id, formulation=formulation.name, from_axis=source
            )
            try:
                Attached.of(ROBOT, asked)
            except EffectError:
                continue
            yield asked


@pytest.mark.parametrize("axis", AXES)
def test_no_effect_is_taken_for_a_fault(axis):
    taken = {
        (asked.id, asked.formulation): cautions
        for asked in effects_on(axis)
        if (cautions := check(ROBOT, [measured([asked], rows=3000)]))
    }
    assert not taken


@pytest.mark.parametrize(
    ("axis", "effect", "parameters"),
    [
        ("thx", "gain_error", {"error": -0.5}),
        ("thx", "sensor_gain", {"error": 0.5}),
        ("x", "sensor_quantization", {"step": 2e-5}),
        ("x", "backlash", {"width": 2e-4}),
        ("thx", "sensor_outliers", {"rate": 100.0}),
        ("thx", "contact", {}),
        ("thx", "saturation", {"high_margin": 0.25}),
        ("zn", "thermal_drift", {}),
        ("x", "cross_coupling", {"k": -0.9}),
    ],
)
def test_strong_effects_are_none_either(axis, effect, parameters):
    source = "zn" if effect == "cross_coupling" else None
    asked = AxisEffect(axis=axis, id=effect, parameters=parameters, from_axis=source)
    assert check(ROBOT, [measured([asked])]) == ()


def test_what_is_missing_is_told():
    record = measured()
    bare = changed(
        record,
        {
            ("x", Tap.REF): None,
            ("thx", Tap.MEAS): None,
            **{("zn", tap): None for tap in (Tap.U, Tap.REF, Tap.MEAS)},
        },
    )
    texts = {one.axis: str(one.text) for one in check(ROBOT, [bare])}
    assert texts["x"].startswith("No independent reference (ref)")
    assert texts["thx"].startswith("The axis' own sensor was not recorded")
    assert texts["zn"] == "The axis was commanded but not measured: it is not diagnosed."
    assert not [one for one in check(ROBOT, [bare, measured(seed=1)]) if one.axis == "x"]


def test_an_axis_that_never_moved_is_told_and_not_refused():
    still = make_commands(("thx",), share=0.0)
    record = simulate(ROBOT, (), still, np.random.default_rng(0))
    [caution] = check(ROBOT, [record])
    assert str(caution.text).startswith("The axis was never commanded to move")
    assert caution.axis == "thx"


@pytest.mark.parametrize(
    ("records", "message"),
    [
        ([], "no record was given"),
        (
            [lambda: measured(rows=99)],
            "record 1 (99 rows, 0.098 s): 99 rows; a diagnosis needs 100 rows",
        ),
        ([make_commands], "no measured channel (u, ref or meas) but only commands"),
    ],
)
def test_nothing_to_go_by_is_refused(records, message):
    assert message in refusal(*(make() for make in records))


def test_records_of_another_robot_are_refused():
    record = measured()
    assert "has no axis 'x'; its axes are p" in refusal(record, robot=load_robot("picma"))
    odd = Record(record.time_s, record.columns, record.values, dict.fromkeys(AXES, "m"))
    said = refusal(odd, names=["odd.csv"])
    assert said.startswith("odd.csv: axis 'thx' is in units of m, but robot 'RoTeMiNa'")
    time_s = np.arange(500) / 1000.0
    force = Record.from_signals(
        time_s, {("q", Tap.CMD): 0.1 + 0.0 * time_s, ("q", Tap.MEAS): time_s}, {"q": "m"}
    )
    assert "no q.u column tells which" in refusal(force, robot=load_robot("emps"))


@pytest.mark.parametrize(
    ("axis", "tap", "factor", "words"),
    [
        ("thx", Tap.MEAS, 1e3, "913.3 × what thx.cmd asks for: this looks like a unit error"),
        ("thx", Tap.REF, 1e-6, "a factor of 0.000001, such as rad read as urad"),
        ("thx", Tap.MEAS, 206264.8, "a factor of 206265, such as arcsec read as rad"),
        ("thx", Tap.MEAS, 4.8481368, "a factor of 4.84814, such as urad read as arcsec"),
        ("thx", Tap.REF, 0.2062648, "a factor of 0.206265, such as arcsec read as urad"),
        ("thx", Tap.MEAS, 57.29578, "a factor of 57.2958, such as deg read as rad"),
        ("x", Tap.MEAS, 1e-3, "a factor of 0.001, such as "),
        ("x", Tap.MEAS, -1e3, "x.meas is -1000 × what x.cmd asks for"),
        ("zn", Tap.U, 0.1, "zn.u is 0.1 × cmd/gain, the output of the amplifier"),
    ],
)
def test_units_that_are_wrong_are_refused_with_the_factor(axis, tap, factor, words):
    record = measured([AxisEffect(axis="thx", id="hysteresis")])
    wrong = changed(record, {(axis, tap): factor * record.signal(axis, tap)})
    assert words in refusal(measured(seed=1), wrong, names=["a.csv", "b.csv"])
    assert refusal(wrong, names=["b.csv"]).startswith("b.csv: ")


def test_a_voltage_that_is_cut_off_by_far_is_no_unit_error():
    record = measured()
    u = record.signal("zn", Tap.U)
    middle, most = u.mean(), 0.125 * np.ptp(u)
    cut = changed(record, {("zn", Tap.U): middle + most * np.tanh((u - middle) / most)})
    assert check(ROBOT, [cut]) == check(ROBOT, [record])


def test_a_voltage_that_another_record_shows_cut_off_is_no_unit_error():
    def between_two_places(record, factor):
        places = np.sign(np.sin(2 * np.pi * 0.5 * record.time_s))
        cmd = 32.5e-6 + 20e-6 * places
        u = factor * places + 75.0
        return changed(record, {("zn", Tap.CMD): cmd, ("zn", Tap.U): u})

    record = measured()
    u = record.signal("zn", Tap.U)
    cut = changed(record, {("zn", Tap.U): np.clip(u, u.mean() - 1.5, u.mean() + 1.5)})
    few = between_two_places(measured(seed=1), 1.5)
    assert "zn.u is 0." in refusal(few)  # by itself it cannot tell
    assert "zn.u is 0." in refusal(record, few)
    check(ROBOT, [cut, few])


def test_commands_in_wrong_units_are_refused():
    record = measured()
    far = changed(record, {("x", Tap.CMD): 1e3 * record.signal("x", Tap.CMD)})
    assert "is far outside the range 0 mm to 55 mm" in refusal(far)
    hasty = timed(record, record.time_s / 1e3)
    assert "× its speed limit: this looks like a unit error of time" in refusal(hasty)


def test_odd_gains_and_signs_are_told():
    record = measured()
    for factor in (-1.0, 4.0):
        odd = changed(record, {("zn", Tap.MEAS): factor * record.signal("zn", Tap.MEAS)})
        [caution] = check(ROBOT, [odd])
        assert (caution.axis, caution.record) == ("zn", 0)
        assert f"{factor:.3g} × the command" in str(caution.text)


def test_a_factor_on_axes_that_move_together_may_be_a_coupling():
    commands = make_commands(("thx",))
    both = {(axis, Tap.CMD): commands.signal("thx", Tap.CMD) for axis in ("thx", "thy")}
    together = Record.from_signals(commands.time_s, both, {"thx": "rad", "thy": "rad"})
    coupled = AxisEffect(
        axis="thy",
        id="cross_coupling",
        formulation="static",
        from_axis="thx",
        parameters={"k": -0.79},
    )
    cautions = check(ROBOT, [simulate(ROBOT, [coupled], together, np.random.default_rng(0))])
    assert [str(one.text).split(",")[0] for one in cautions] == [
        f"The {tap} channel is 0.21 × the command" for tap in ("ref", "meas")
    ]


def test_a_coupling_beyond_one_is_no_fault():
    strong = AxisEffect(
        axis="thy", id="cross_coupling", formulation="static", from_axis="thx", parameters={"k": 3}
    )
    record = measured([strong], axes=("thx", "thy"))
    assert check(ROBOT, [record]) == ()


def test_a_command_beyond_the_range_is_told():
    record = measured(axes=("zn",))
    beyond = changed(record, {("zn", Tap.CMD): record.signal("zn", Tap.CMD) + 2e-5})
    [caution] = check(ROBOT, [beyond])
    assert str(caution.text).startswith("A command of 7")


def with_leap(record, leap_s, *rows):
    """The record with time that leaps before each of these rows."""
    later = sum(leap_s * (np.arange(len(record.time_s)) >= row) for row in rows)
    return timed(record, record.time_s + later)


def test_a_record_is_split_where_time_leaps():
    record = with_leap(changed(measured(), name="a"), 1.5, 1000, 1050, 3950)
    [caution] = check(ROBOT, [record])
    assert (caution.axis, caution.record) == (None, 0)
    assert str(caution.text) == (
        "Time leaps 3 ×, by up to 1.5 s: the record is split there, and the history of "
        "each piece is unknown; 100 rows in pieces shorter than 100 are omitted."
    )
    first, second = pieces([record], ["a.csv"])
    assert (first.name, first.number) == ("a.csv, rows 1 to 1000", 0)
    assert (first.record.history, second.record.history) == ("rest", "unknown")
    assert second.record.metadata["name"] == "a"
    assert np.array_equal(second.record.values, record.values[1050:3950])


def test_what_came_before_a_piece_of_a_periodic_record_is_unknown():
    record = changed(measured(), history="periodic", period_samples="1000")
    halves = pieces([with_leap(record, 2.0, 2000)])
    assert [one.record.history for one in halves] == ["unknown", "unknown"]
    assert [one.record.period_samples for one in halves] == [None, None]


def test_short_leaps_split_where_an_axis_is_under_way():
    record = measured()
    [caution] = check(ROBOT, [with_leap(record, 0.25, 1000)])
    assert str(caution.text).startswith("Time leaps 1 ×, by up to 0.251 s: the record is split")
    at_rest = with_leap(record, 0.25, 3900)
    assert len(pieces([at_rest])) == 1
    [caution] = check(ROBOT, [at_rest])
    assert str(caution.text).startswith(
        "Rows are missing in a record for up to 0.251 s while no axis"
    )
    assert len(pieces([with_leap(record, 1.5, 3900)])) == 2


def test_slow_rows_are_no_leaps():
    slow = timed(measured(axes=("zn",)), 1e4 * measured(axes=("zn",)).time_s)
    assert len(pieces([slow])) == 1
    assert len(pieces([with_leap(slow, 95.0, 2000)])) == 2


def test_a_record_of_which_no_piece_is_long_enough_is_refused():
    record = with_leap(measured(rows=300), 2.0, 99, 198, 210)
    assert refusal(record, measured(seed=1), names=["a.csv", "b.csv"]) == (
        "a.csv: time leaps 3 ×, by up to 2 s, and no piece between has more than 99 rows; a "
        "diagnosis needs 100 or more without a leap: leave the record out, or record without losses"
    )


def test_holds_may_be_written_sparsely():
    """Rows are left out while all axes hold, up to the row at which one steps on."""
    time_s = np.arange(4000) / 1000.0
    steps = 2e-5 + 1e-5 * (np.floor(time_s) % 2.0)
    commands = Record.from_signals(time_s, {("zn", Tap.CMD): steps}, {"zn": "m"})
    record = simulate(ROBOT, (), commands, np.random.default_rng(0))
    kept = np.flatnonzero(time_s % 1.0 < 0.8)
    sparse = Record(record.time_s[kept], record.columns, record.values[kept], record.units)
    assert [str(one.text)[:31] for one in check(ROBOT, [sparse])] == [
        "Rows are missing in a record fo"
    ]


def test_single_missing_rows_and_scattered_times_are_told():
    record = measured()
    kept = np.delete(np.arange(4000), [500, 900, 1700])
    part = Record(record.time_s[kept], record.columns, record.values[kept], record.units)
    [caution] = check(ROBOT, [part])
    assert str(caution.text).startswith("Rows are missing at 3 places of a record")
    scatter = 3e-4 * np.random.default_rng(0).uniform(-1.0, 1.0, 4000)
    [caution] = check(ROBOT, [timed(record, record.time_s + scatter)])
    assert "their scatter appears as sensor noise" in str(caution.text)


def test_a_periodic_record_repeats_its_commands():
    record = measured(axes=("x",))
    wrong = changed(record, history="periodic", period_samples="1000")
    assert "x.cmd at row " in refusal(wrong)
    assert "is not what it was a period before" in refusal(wrong)


def test_a_sensor_that_does_not_answer_is_refused():
    record = measured()
    dead = changed(record, {("thx", Tap.MEAS): np.full(4000, 3e-4)})
    said = refusal(dead, names=["dead.csv"])
    assert said.startswith(
        "dead.csv: thx.meas stands at exactly 300 µrad for 100 % of the rows, while the axis is "
        "commanded to move (first at t = 0 s): the sensor is stuck or not connected"
    )


def test_a_saturated_sensor_is_refused_where_it_is_sure_and_else_told():
    record = measured()
    for axis in ("thx", "x"):  # the noise of the one flickers, the other has a reference
        reading = record.signal(axis, Tap.MEAS)
        clipped = np.minimum(reading, np.percentile(reading, 85.0))
        bad = changed(record, {(axis, Tap.MEAS): clipped})
        assert f"{axis}.meas stands at exactly " in refusal(bad)
        assert "the sensor is saturated; repair it, stay within what it can read" in refusal(bad)
    alone = changed(bad, {("x", Tap.REF): None})
    assert [str(one.text)[:29] for one in check(ROBOT, [alone]) if one.record == 0] == [
        "The reading stays at exactly "
    ]


def test_an_axis_that_truly_stops_is_no_fault():
    """A hard stop: the encoder's noise is below its step, but the reference stands as well."""
    record = measured()
    stop = np.round(np.percentile(record.signal("x", Tap.MEAS), 80.0), 7)
    ends = {("x", tap): np.minimum(record.signal("x", tap), stop) for tap in (Tap.REF, Tap.MEAS)}
    assert check(ROBOT, [changed(record, ends)]) == ()


def held(signal, begin, end):
    signal = signal.copy()
    signal[begin:end] = signal[begin]
    return signal


def test_an_axis_that_does_not_answer_is_refused():
    record = measured()
    floating = 3e-5 + 1e-6 * np.random.default_rng(0).standard_normal(4000)
    silent = changed(record, {("zn", Tap.REF): None, ("zn", Tap.MEAS): floating})
    said = refusal(silent, names=["a.csv"])
    assert said.startswith("a.csv: zn.meas does not follow zn.cmd (its gain is ")
    assert said.endswith("switch the axis on, or leave its columns out")


def test_channels_that_are_swapped_are_refused():
    record = measured(axes=("thx", "thy"))
    swapped = {
        ("thx", Tap.MEAS): record.signal("thy", Tap.MEAS),
        ("thy", Tap.MEAS): record.signal("thx", Tap.MEAS),
    }
    said = refusal(changed(record, swapped))
    assert "thx.meas does not follow thx.cmd but thy.cmd (its gain is " in said
    assert "channels may be swapped" in said


def test_dropouts_pass_and_a_long_one_is_refused():
    record = measured()
    reading = record.signal("thx", Tap.MEAS)
    short, gone = reading.copy(), reading.copy()
    for begin in range(300, 3300, 500):
        short = held(short, begin, begin + 100)
        gone[begin : begin + 100] = 0.0
    for taken in (short, gone):
        assert check(ROBOT, [changed(record, {("thx", Tap.MEAS): taken})]) == ()
    long = changed(record, {("thx", Tap.MEAS): held(reading, 1000, 2000)})
    assert "the sensor is stuck or not connected" in refusal(long)


def test_the_same_measurements_twice_are_refused():
    record = measured()
    copy = changed(record, {}, name="another")
    said = refusal(record, measured(seed=1), copy, names=["a.csv", "b.csv", "c.csv"])
    assert said.startswith("c.csv: it holds measurements of a.csv again (")
    for part in (record.part(slice(1000, 3000)), record.part(slice(2500, None))):
        assert "again" in refusal(record, part)
        assert "again" in refusal(part, record)
    overlapping = record.part(slice(0, 2500)), record.part(slice(2000, None))
    assert "again" in refusal(*overlapping)


def test_other_runs_of_the_same_commands_and_rests_are_no_copies():
    assert check(ROBOT, [measured(seed=1), measured(seed=2)]) == ()
    still = make_commands(("x",), share=0.0)
    rests = [simulate(ROBOT, (), still, np.random.default_rng(seed)) for seed in (1, 2)]
    assert {str(one.text)[:27] for one in check(ROBOT, rests)} == {"The axis was never commande"}
    whole = measured()
    assert check(ROBOT, [whole.part(slice(0, 2000)), whole.part(slice(2000, None))]) == ()


def test_remarks_know_no_order_of_records():
    a, b, c = (message("gap", text) for text in ("A.", "B.", "C."))
    cautions = [Caution(b, "x", 1), Caution(a, None, 0), Caution(b, "x", 0), Caution(c, "y")]
    assert remarks(cautions, "x") == remarks(cautions[::-1], "x") == (a, b)


def test_a_robot_that_differs_in_one_figure_only_fits():
    robot = replace(ROBOT, name="other")
    assert check(robot, [measured()]) == ()


@pytest.mark.parametrize("rate_hz", [0.1, 1e5])
def test_slow_and_fast_records_are_welcome(rate_hz):
    records = [measured(seed=seed, rate_hz=rate_hz, axes=("zn",), rows=400) for seed in (0, 1)]
    assert check(ROBOT, records) == ()
    assert diagnose(ROBOT, records).verdict is Verdict.NONE


def test_a_split_record_is_diagnosed_in_pieces():
    """The machine went on moving between the pieces."""
    wrong = AxisEffect(axis="x", id="gain_error", parameters={"error": 0.02})
    record = measured([wrong], axes=("x",))
    kept = np.r_[0:1500, 2600:4000]
    lost = Record(record.time_s[kept], record.columns, record.values[kept], record.units)
    answer = diagnose(ROBOT, [lost])
    assert answer.causes[0].effect == "gain_error"
    assert any(str(one).startswith("Time leaps 1 ×") for one in answer.axes["x"].remarks)
