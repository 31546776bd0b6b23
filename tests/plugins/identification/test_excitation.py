"""The motions that the page offers, and what is known of their records."""

import numpy as np
import pytest

from rotemina.plugins.identification.excitation import ExcitationRequest, Wave, prepared, steady
from rotemina.sim.errors import InputError
from rotemina.sim.kinematics.keep_out import KeepOutZone
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot

PERIOD_S = 0.001


@pytest.fixture(scope="module")
def robot():
    return load_robot("rotemina")


@pytest.fixture(scope="module")
def multisine(robot):
    return prepared(robot, ExcitationRequest("zn", Wave.MULTISINE), PERIOD_S)


def played(motion, rate_hz, **metadata):
    """The record of a playback, held between rows, with the device's sampling rate."""
    asked = motion.made.record
    time_s = np.arange(round(asked.duration_s * rate_hz) + 1) / rate_hz
    row = np.searchsorted(asked.time_s, time_s + 1e-9, side="right") - 1
    command = asked.signal("zn", Tap.CMD)[row]
    signals = {("zn", Tap.CMD): command, ("zn", Tap.MEAS): command}
    return Record.from_signals(time_s, signals, {"zn": "m"}, {"history": "unknown", **metadata})


@pytest.mark.parametrize("wave", list(Wave))
def test_every_motion_suits_the_axis_where_nothing_is_typed(robot, wave):
    motion = prepared(robot, ExcitationRequest("zn", wave), PERIOD_S)
    assert motion.digest == motion.dry_run.checked.digest
    assert motion.objection == ""
    assert motion.name == f"{wave} of Z nano"
    assert "of 5 mm/s" in motion.words
    assert "within all limits" in motion.words


def test_what_is_typed_is_what_moves(robot):
    motion = prepared(
        robot, ExcitationRequest("zn", Wave.SINE, "5um", "2 Hz", " 4", 20e-6), PERIOD_S
    )
    command = motion.made.record.signal("zn", Tap.CMD)
    assert (command.min(), command.max()) == pytest.approx((15e-6, 25e-6))
    assert motion.dry_run.duration_s == pytest.approx(4.0)
    assert "15 µm to 25 µm" in motion.words
    stairs = prepared(robot, ExcitationRequest("zn", Wave.STAIRCASE, "10%", "", "0.2 s"), PERIOD_S)
    assert stairs.dry_run.duration_s == pytest.approx(11 * 0.2, rel=0.05)


def test_what_exceeds_a_limit_is_reduced_and_said(robot):
    words = prepared(robot, ExcitationRequest("zn", Wave.SINE, "1mm", "1"), PERIOD_S).words
    assert "Reduced to the limits: axis zn: amplitude 1 mm" in words


@pytest.mark.parametrize(
    ("excitation", "said"),
    [
        (ExcitationRequest("zn", Wave.SINE, "5"), "has no unit"),
        (ExcitationRequest("zn", Wave.SINE, "5urad"), "not in m"),
        (ExcitationRequest("zn", Wave.SINE, "", "fast"), "frequency: 'fast' is not a number in Hz"),
        (ExcitationRequest("zn", Wave.SINE, "", "", "1e999"), "must be a finite number"),
        (ExcitationRequest("zn", Wave.SINE, "", "", "-1"), "must be a finite number above 0"),
        (ExcitationRequest("zn", Wave.SINE, "", "900 Hz", about=0.0), "zn"),
    ],
)
def test_what_makes_no_sense_is_refused_in_words(robot, excitation, said):
    with pytest.raises(InputError, match=said):
        prepared(robot, excitation, PERIOD_S)


def test_a_motion_through_the_floor_must_not_be_played(robot):
    command = {name: sum(axis.range) / 2.0 for name, axis in robot.axes.items()}
    zone = KeepOutZone.of(robot)
    tip = zone.tip(np.array(list(command.values())))
    floored = zone.taught(float(tip[2]) - 5e-6)
    motion = prepared(robot, ExcitationRequest("zn", Wave.TRIANGLE), PERIOD_S, floored, command)
    assert motion.digest is None
    assert motion.words.splitlines()[-1].startswith("Not playable: tip")
    small = prepared(
        robot, ExcitationRequest("zn", Wave.TRIANGLE, "1um"), PERIOD_S, floored, command
    )
    assert small.digest is not None


def test_a_periodic_motion_is_looked_at_in_its_steady_state(multisine):
    record = steady(played(multisine, 2000.0), multisine)
    assert (record.history, record.period_samples) == ("periodic", 2000)
    assert len(record.time_s) == 3 * 2000
    asked = multisine.made.record.signal("zn", Tap.CMD)
    np.testing.assert_array_equal(record.signal("zn", Tap.CMD), asked[2000:])


def test_a_record_out_of_step_with_the_motion_is_not_called_periodic(multisine):
    record = played(multisine, 1990.5)
    found = steady(record, multisine)
    assert found.history == "rest"
    assert found.period_samples is None
    np.testing.assert_array_equal(found.values, record.values)


def test_a_motion_that_is_not_periodic_began_at_rest(robot):
    motion = prepared(robot, ExcitationRequest("zn", Wave.TRIANGLE), PERIOD_S)
    record = steady(played(motion, 1000.0, mode="open_loop"), motion)
    assert record.history == "rest"
    assert record.metadata == {"mode": "open_loop"}
