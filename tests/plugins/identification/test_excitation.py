"""The excitations that the page offers, and the records of their playback."""

import numpy as np
import pytest

from rotemina.plugins.identification.excitation import (
    ExcitationRequest,
    ExcitationWave,
    prepare_excitation,
    trim_to_steady_state,
)
from rotemina.sim.errors import InputError
from rotemina.sim.kinematics import KeepOutZone
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot_files import load_robot

PERIOD_S = 0.001


@pytest.fixture(scope="module")
def robot():
    return load_robot("rotemina")


@pytest.fixture(scope="module")
def multisine(robot):
    return prepare_excitation(robot, ExcitationRequest("zn", ExcitationWave.MULTISINE), PERIOD_S)


def make_playback_record(motion, rate_hz, **metadata):
    """Return the record of a playback at the device's rate, with each row held until the next."""
    planned = motion.excitation.record
    time_s = np.arange(round(planned.duration_s * rate_hz) + 1) / rate_hz
    rows = np.searchsorted(planned.time_s, time_s + 1e-9, side="right") - 1
    command = planned.signal("zn", Tap.CMD)[rows]
    signals = {("zn", Tap.CMD): command, ("zn", Tap.MEAS): command}
    return Record.from_signals(time_s, signals, {"zn": "m"}, {"history": "unknown", **metadata})


@pytest.mark.parametrize("wave", list(ExcitationWave))
def test_the_default_excitation_fits_the_axis(robot, wave):
    motion = prepare_excitation(robot, ExcitationRequest("zn", wave), PERIOD_S)
    assert motion.digest == motion.dry_run.checked.digest
    assert motion.objection == ""
    assert motion.name == f"{wave} of Z nano"
    assert "of 5 mm/s" in motion.description
    assert "within all limits" in motion.description


def test_typed_values_define_the_excitation(robot):
    motion = prepare_excitation(
        robot, ExcitationRequest("zn", ExcitationWave.SINE, "5um", "2 Hz", " 4", 20e-6), PERIOD_S
    )
    command = motion.excitation.record.signal("zn", Tap.CMD)
    assert (command.min(), command.max()) == pytest.approx((15e-6, 25e-6))
    assert motion.dry_run.duration_s == pytest.approx(4.0)
    assert "15 µm to 25 µm" in motion.description
    stairs = prepare_excitation(
        robot, ExcitationRequest("zn", ExcitationWave.STAIRCASE, "10%", "", "0.2 s"), PERIOD_S
    )
    assert stairs.dry_run.duration_s == pytest.approx(11 * 0.2, rel=0.05)


def test_an_excitation_beyond_a_limit_is_reduced_and_reported(robot):
    description = prepare_excitation(
        robot, ExcitationRequest("zn", ExcitationWave.SINE, "1mm", "1"), PERIOD_S
    ).description
    assert "Reduced to the limits: axis zn: amplitude 1 mm" in description


@pytest.mark.parametrize(
    ("excitation", "message"),
    [
        (ExcitationRequest("zn", ExcitationWave.SINE, "5"), "has no unit"),
        (ExcitationRequest("zn", ExcitationWave.SINE, "5urad"), "not in m"),
        (
            ExcitationRequest("zn", ExcitationWave.SINE, "", "fast"),
            "frequency: 'fast' is not a number in Hz",
        ),
        (ExcitationRequest("zn", ExcitationWave.SINE, "", "", "1e999"), "must be a finite number"),
        (
            ExcitationRequest("zn", ExcitationWave.SINE, "", "", "-1"),
            "must be a finite number above 0",
        ),
        (ExcitationRequest("zn", ExcitationWave.SINE, "", "900 Hz", middle=0.0), "zn"),
    ],
)
def test_an_invalid_request_is_refused(robot, excitation, message):
    with pytest.raises(InputError, match=message):
        prepare_excitation(robot, excitation, PERIOD_S)


def test_an_excitation_through_the_floor_cannot_be_played(robot):
    command = {name: sum(axis.range) / 2.0 for name, axis in robot.axes.items()}
    zone = KeepOutZone.of(robot)
    tip = zone.tip_at(np.array(list(command.values())))
    zone_with_floor = zone.with_floor(float(tip[2]) - 5e-6)
    motion = prepare_excitation(
        robot, ExcitationRequest("zn", ExcitationWave.TRIANGLE), PERIOD_S, zone_with_floor, command
    )
    assert motion.digest is None
    assert motion.description.splitlines()[-1].startswith("Not playable: tip")
    small = prepare_excitation(
        robot,
        ExcitationRequest("zn", ExcitationWave.TRIANGLE, "1um"),
        PERIOD_S,
        zone_with_floor,
        command,
    )
    assert small.digest is not None


def test_a_periodic_record_is_trimmed_to_its_steady_state(multisine):
    record = trim_to_steady_state(make_playback_record(multisine, 2000.0), multisine)
    assert (record.history, record.period_samples) == ("periodic", 2000)
    assert len(record.time_s) == 3 * 2000
    command = multisine.excitation.record.signal("zn", Tap.CMD)
    np.testing.assert_array_equal(record.signal("zn", Tap.CMD), command[2000:])


def test_a_record_at_another_rate_or_of_a_non_periodic_motion_starts_at_rest(robot, multisine):
    record = make_playback_record(multisine, 1990.5)
    trimmed = trim_to_steady_state(record, multisine)
    assert (trimmed.history, trimmed.period_samples) == ("rest", None)
    np.testing.assert_array_equal(trimmed.values, record.values)
    motion = prepare_excitation(robot, ExcitationRequest("zn", ExcitationWave.TRIANGLE), PERIOD_S)
    trimmed = trim_to_steady_state(make_playback_record(motion, 1000.0, mode="open_loop"), motion)
    assert trimmed.history == "rest"
    assert trimmed.metadata == {"mode": "open_loop"}
