"""Wrong units are distinguished from effects."""

import sys
from pathlib import Path

import numpy as np
import pytest

from rotemina.sim.gap.intake import check_records
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.simulation import simulate

# The shared records are in a module of the parent folder.
sys.path.insert(0, str(Path(__file__).parents[1]))
from intake_records import (
    ROBOT,
    get_refusal,
    make_commands,
    modify_record,
    replace_times,
    simulate_record,
)


@pytest.mark.parametrize(
    ("axis", "tap", "factor", "expected_text"),
    [
        ("thx", Tap.MEAS, 1e3, "913.3 × thx.cmd: this looks like a unit error"),
        ("thx", Tap.REF, 1e-6, "a factor of 0.000001, such as rad read as urad"),
        ("thx", Tap.MEAS, 206264.8, "a factor of 206265, such as arcsec read as rad"),
        ("thx", Tap.MEAS, 4.8481368, "a factor of 4.84814, such as urad read as arcsec"),
        ("thx", Tap.REF, 0.2062648, "a factor of 0.206265, such as arcsec read as urad"),
        ("thx", Tap.MEAS, 57.29578, "a factor of 57.2958, such as deg read as rad"),
        ("x", Tap.MEAS, 1e-3, "a factor of 0.001, such as "),
        ("x", Tap.MEAS, -1e3, "x.meas is -1000 × x.cmd"),
        ("zn", Tap.U, 0.1, "zn.u is 0.1 × cmd/gain, the output of the amplifier"),
    ],
)
def test_wrong_units_are_refused_with_their_factor(axis, tap, factor, expected_text):
    record = simulate_record([AxisEffect(axis="thx", id="hysteresis")])
    wrong_record = modify_record(record, {(axis, tap): factor * record.signal(axis, tap)})
    assert expected_text in get_refusal(
        simulate_record(seed=1), wrong_record, names=["a.csv", "b.csv"]
    )
    assert get_refusal(wrong_record, names=["b.csv"]).startswith("b.csv: ")


def test_a_strongly_saturated_voltage_is_not_a_unit_error():
    record = simulate_record()
    u = record.signal("zn", Tap.U)
    middle, limit = u.mean(), 0.125 * np.ptp(u)
    saturated_record = modify_record(
        record, {("zn", Tap.U): middle + limit * np.tanh((u - middle) / limit)}
    )
    assert check_records(ROBOT, [saturated_record]) == check_records(ROBOT, [record])


def test_a_voltage_that_is_saturated_in_another_record_is_not_a_unit_error():
    def alternate_positions(record, factor):
        signs = np.sign(np.sin(2 * np.pi * 0.5 * record.time_s))
        cmd = 32.5e-6 + 20e-6 * signs
        u = factor * signs + 75.0
        return modify_record(record, {("zn", Tap.CMD): cmd, ("zn", Tap.U): u})

    record = simulate_record()
    u = record.signal("zn", Tap.U)
    saturated_record = modify_record(
        record, {("zn", Tap.U): np.clip(u, u.mean() - 1.5, u.mean() + 1.5)}
    )
    two_position_record = alternate_positions(simulate_record(seed=1), 1.5)
    # Alone, the record looks like a unit error.
    assert "zn.u is 0." in get_refusal(two_position_record)
    assert "zn.u is 0." in get_refusal(record, two_position_record)
    check_records(ROBOT, [saturated_record, two_position_record])


def test_commands_in_wrong_units_are_refused():
    record = simulate_record()
    far_record = modify_record(record, {("x", Tap.CMD): 1e3 * record.signal("x", Tap.CMD)})
    assert "is far outside the range 0 mm to 55 mm" in get_refusal(far_record)
    fast_record = replace_times(record, record.time_s / 1e3)
    assert "× its speed limit: this looks like a unit error of time" in get_refusal(fast_record)


def test_unusual_gains_and_signs_are_reported():
    record = simulate_record()
    for factor in (-1.0, 4.0):
        scaled_record = modify_record(
            record, {("zn", Tap.MEAS): factor * record.signal("zn", Tap.MEAS)}
        )
        [caution] = check_records(ROBOT, [scaled_record])
        assert (caution.axis, caution.record) == ("zn", 0)
        assert f"{factor:.3g} × the command" in str(caution.text)


def test_a_factor_on_axes_that_move_together_may_be_a_coupling():
    commands = make_commands(("thx",))
    signals = {(axis, Tap.CMD): commands.signal("thx", Tap.CMD) for axis in ("thx", "thy")}
    common_commands = Record.from_signals(commands.time_s, signals, {"thx": "rad", "thy": "rad"})
    coupled = AxisEffect(
        axis="thy",
        id="cross_coupling",
        formulation="static",
        from_axis="thx",
        parameters={"k": -0.79},
    )
    cautions = check_records(
        ROBOT, [simulate(ROBOT, [coupled], common_commands, np.random.default_rng(0))]
    )
    assert [str(caution.text).split(",")[0] for caution in cautions] == [
        f"The {tap} channel is 0.21 × the command" for tap in ("ref", "meas")
    ]


def test_a_coupling_above_one_is_not_a_fault():
    strong = AxisEffect(
        axis="thy", id="cross_coupling", formulation="static", from_axis="thx", parameters={"k": 3}
    )
    record = simulate_record([strong], axes=("thx", "thy"))
    assert check_records(ROBOT, [record]) == ()
