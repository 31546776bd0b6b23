"""A calibration run records the raw sensor. The result corrects later readings."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.app.calibration import CalibrationPlayback, CalibrationPlaybackPhase
from rotemina.app.calibration.calibration_playback import NO_LASER
from rotemina.app.errors import RequestRefusedError
from rotemina.app.motion.device import AppliedCalibration
from rotemina.app.motion.session import MotionSession
from rotemina.drivers.contract import VirtualClock
from rotemina.drivers.simulator import Simulator
from rotemina.sim.calibration import SensorModel
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.trajectory import dry_run

GAIN = 0.1
CALIBRATION = AppliedCalibration(
    "today", SensorModel(low=0.0, high=6.5e-5, gain_error=GAIN), (0.0, 6.5e-5)
)


class CalibrationBench:
    def __init__(self, laser=True):
        self.clock = VirtualClock()
        self.robot = load_robot("rotemina")
        driver = Simulator(self.robot, {"settle_s": 0.0}, clock=self.clock)
        if not laser:
            read = driver._read
            driver._read = lambda: _remove_reference(read())
        self.session = MotionSession(driver, clock=self.clock)
        self.events = []
        self.session.subscribe(self.events.append)
        self.session.connect()
        self.step(3)
        self.session.service.set_effects(
            [AxisEffect(axis="zn", id="sensor_gain", parameters={"error": GAIN})]
        )
        self.step(3)

    def step(self, times=1):
        for _ in range(times):
            self.clock.advance(0.02)
            self.session.run_once()
            self.session.run_once()

    def make_run(self):
        values = 2e-5 + 1e-5 * np.sin(np.linspace(0.0, 2 * np.pi, 401)) ** 2
        motion = Record.from_signals(np.arange(401) * 1e-3, {("zn", Tap.CMD): values}, {"zn": "m"})
        checked_motion = dry_run(self.robot, motion).require()
        return CalibrationPlayback(self.session, "zn", checked_motion)


def _remove_reference(samples):
    return replace(samples, reference=None)


@pytest.fixture
def bench():
    bench = CalibrationBench()
    yield bench
    bench.session.close()


def test_run_records_raw_sensor_and_laser(bench):
    bench.session.corrections.set_calibration("zn", CALIBRATION)
    run = bench.make_run()
    run.start()
    bench.step(20)
    assert run.state.phase is CalibrationPlaybackPhase.MOVING
    assert bench.session.corrections.names == {}
    bench.step(40)
    assert run.state.phase is CalibrationPlaybackPhase.DONE
    record = run.record
    reference, reading = (record.signal("zn", tap) for tap in (Tap.REF, Tap.MEAS))
    slope = np.polyfit(reference, reading, 1)[0]
    assert slope == pytest.approx(1.0 + GAIN, rel=0.01)
    assert len(record.time_s) == 401
    assert bench.session.corrections.names == {"zn": "today"}  # it is active again
    finished_records = [event.record for event in bench.events if hasattr(event, "completed")]
    assert not finished_records[-1].has("zn", Tap.REF)  # the session's own record is unchanged


def test_calibration_corrects_readings_and_is_named_in_the_record(bench):
    raw = bench.session.snapshot().measured["zn"]
    bench.session.corrections.set_calibration("zn", CALIBRATION)
    bench.step(3)
    corrected = bench.session.snapshot().measured["zn"]
    assert corrected == pytest.approx(raw / (1.0 + GAIN), abs=1e-7)
    assert bench.session.history.tail().measured[-1, -1] == corrected
    bench.session.play(
        Record.from_signals(
            np.arange(50) * 1e-3, {("zn", Tap.CMD): np.full(50, 3.25e-5)}, {"zn": "m"}
        )
    )
    bench.step(20)
    finished_records = [event.record for event in bench.events if hasattr(event, "completed")]
    assert finished_records[-1].metadata["calibration zn"] == "today"
    bench.session.corrections.set_calibration("zn", None)
    bench.step(3)
    assert bench.session.snapshot().measured["zn"] == pytest.approx(raw, abs=1e-7)
    with pytest.raises(KeyError):
        bench.session.corrections.set_calibration("q", CALIBRATION)


def test_a_device_without_a_laser_is_stopped_at_once():
    bench = CalibrationBench(laser=False)
    run = bench.make_run()
    run.start()
    bench.step(3)
    assert run.state.phase is CalibrationPlaybackPhase.FAILED
    assert run.state.message == NO_LASER
    assert run.record is None
    bench.session.close()


@pytest.mark.parametrize("is_lost", [False, True])
def test_stop_or_a_lost_connection_aborts_the_run(bench, is_lost):
    run = bench.make_run()
    run.start()
    bench.step(10)
    bench.session.disconnect() if is_lost else run.stop()
    bench.step(10)
    assert run.state.phase is CalibrationPlaybackPhase.FAILED
    assert run.record is None
    with pytest.raises(RequestRefusedError, match="already started"):
        run.start()
    run.close()


def test_refused_motion_fails_the_run(bench):
    bench.session.emergency_stop()
    run = bench.make_run()
    with pytest.raises(RequestRefusedError, match="is active"):
        run.start()
    assert run.state.phase is CalibrationPlaybackPhase.FAILED
    bench.session.release()
