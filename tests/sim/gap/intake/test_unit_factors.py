"""Units that are wrong, told from effects."""

import sys
from pathlib import Path

import numpy as np
import pytest

from rotemina.sim.gap.intake.record_checks import check
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

sys.path.insert(0, str(Path(__file__).parents[1]))  # no test module: the records
from intake_records import ROBOT, changed, make_commands, measured, refusal, timed


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
