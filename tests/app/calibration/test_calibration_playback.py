"""A calibration through a session: recorded as the sensor is, applied to what is read after."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.app.calibration.calibration_playback import NO_LASER, CalibrationRun, Phase
from rotemina.app.motion.mailbox import RefusedError
from rotemina.app.motion.sensor_corrections import AppliedCalibration
from rotemina.app.motion.session import MotionSession
from rotemina.drivers.clock import VirtualClock
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.calibration.sensor import SensorModel
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.trajectory.dry_run import dry_run

GAIN = 0.1
RIGHT = AppliedCalibration(
    "today", SensorModel(low=0.0, high=6.5e-5, gain_error=GAIN), (0.0, 6.5e-5)
)


class _Bench:
    def __init__(self, laser=True):
        self.clock = VirtualClock()
        self.robot = load_robot("rotemina")
        driver = Simulator(self.robot, {"settle_s": 0.0}, clock=self.clock)
        if not laser:
            read = driver._read
            driver._read = lambda: _without(read())
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

    def run(self):
        values = 2e-5 + 1e-5 * np.sin(np.linspace(0.0, 2 * np.pi, 401)) ** 2
        motion = Record.from_signals(np.arange(401) * 1e-3, {("zn", Tap.CMD): values}, {"zn": "m"})
        checked = dry_run(self.robot, motion).require()
        return CalibrationRun(self.session, "zn", checked)


def _without(samples):
    return replace(samples, reference=None)


@pytest.fixture
def bench():
    made = _Bench()
    yield made
    made.session.close()


def test_a_run_records_the_sensor_as_it_is_and_the_laser(bench):
    bench.session.corrections.use("zn", RIGHT)
    run = bench.run()
    run.start()
    bench.step(20)
    assert run.state.phase is Phase.MOVING
    assert bench.session.corrections.names == {}
    bench.step(40)
    assert run.state.phase is Phase.DONE
    record = run.record
    reference, reading = (record.signal("zn", tap) for tap in (Tap.REF, Tap.MEAS))
    slope = np.polyfit(reference, reading, 1)[0]
    assert slope == pytest.approx(1.0 + GAIN, rel=0.01)
    assert len(record.time_s) == 401
    assert bench.session.corrections.names == {"zn": "today"}  # it acts again
    ended = [event.record for event in bench.events if hasattr(event, "completed")]
    assert not ended[-1].has("zn", Tap.REF)  # the session's own record is as it always was


def test_a_calibration_puts_readings_right_and_is_told(bench):
    raw = bench.session.snapshot().measured["zn"]
    bench.session.corrections.use("zn", RIGHT)
    bench.step(3)
    right = bench.session.snapshot().measured["zn"]
    assert right == pytest.approx(raw / (1.0 + GAIN), abs=1e-7)
    assert bench.session.history.tail().measured[-1, -1] == right
    bench.session.play(
        Record.from_signals(
            np.arange(50) * 1e-3, {("zn", Tap.CMD): np.full(50, 3.25e-5)}, {"zn": "m"}
        )
    )
    bench.step(20)
    ended = [event.record for event in bench.events if hasattr(event, "completed")]
    assert ended[-1].metadata["calibration zn"] == "today"
    bench.session.corrections.use("zn", None)
    bench.step(3)
    assert bench.session.snapshot().measured["zn"] == pytest.approx(raw, abs=1e-7)
    with pytest.raises(KeyError):
        bench.session.corrections.use("q", RIGHT)


def test_a_device_without_a_laser_is_stopped_at_once():
    bench = _Bench(laser=False)
    run = bench.run()
    run.start()
    bench.step(3)
    assert run.state.phase is Phase.FAILED
    assert run.state.message == NO_LASER
    assert run.record is None
    bench.session.close()


def test_a_stop_gives_a_run_up(bench):
    run = bench.run()
    run.start()
    bench.step(10)
    run.stop()
    bench.step(10)
    assert run.state.phase is Phase.FAILED
    assert run.record is None
    with pytest.raises(RefusedError, match="already started"):
        run.start()


def test_a_lost_connection_gives_a_run_up(bench):
    run = bench.run()
    run.start()
    bench.step(10)
    bench.session.disconnect()
    bench.step(2)
    assert run.state.phase is Phase.FAILED
    run.close()


def test_a_refused_motion_is_no_run(bench):
    bench.session.emergency_stop()
    run = bench.run()
    with pytest.raises(RefusedError, match="is active"):
        run.start()
    assert run.state.phase is Phase.FAILED
    bench.session.release()
