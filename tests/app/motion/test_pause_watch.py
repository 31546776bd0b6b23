"""A pause of the program cancels what was under way."""

import time

import pytest

from rotemina.app.motion.pause_watch import MAX_PAUSE_S, PauseWatch, read_boot_clock
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import Stopped
from rotemina.drivers.clock import VirtualClock
from rotemina.drivers.samples import DeviceState
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.robot.file import load_robot


class RealTimeSimulator(Simulator):
    """A simulator that counts as a device with a clock of its own."""

    virtual_time = False


def run_session(simulator, pause_s):
    """Return the stops of a session, and how far x went after a pause in mid-move, m."""
    clock = VirtualClock(5.0)
    session = MotionSession(simulator(load_robot("rotemina"), {"start_fraction": 0.1}, clock=clock))
    stops = []
    session.subscribe(lambda event: stops.append(event) if isinstance(event, Stopped) else None)
    session.connect()

    def run(seconds):
        for _ in range(round(seconds / 0.01)):
            clock.advance(0.01)
            session.run_once()

    run(0.1)
    session.go_to({"x": 0.05})
    run(0.5)
    clock.advance(pause_s)
    run(0.5)
    resumed = session.snapshot().command["x"]
    run(3.0)
    assert session.snapshot().activity is DeviceState.IDLE or not stops
    return stops, session.snapshot().command["x"] - resumed


def test_after_a_pause_in_mid_move_the_machine_is_stopped_and_the_operator_notified():
    stops, way = run_session(RealTimeSimulator, 2.0 * MAX_PAUSE_S)
    assert len(stops) == 1
    assert "this program stood still for 2" in str(stops[0].request)
    assert way == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize(
    ("simulator", "pause_s"),
    [(RealTimeSimulator, 0.5 * MAX_PAUSE_S), (Simulator, 1.2 * MAX_PAUSE_S)],
)
def test_a_short_delay_or_a_stepped_simulation_is_no_pause(simulator, pause_s):
    stops, way = run_session(simulator, pause_s)
    assert stops == []
    assert way > 1e-3


def test_the_systems_clock_counts_the_time_that_the_computer_slept():
    watch = PauseWatch(time.monotonic)
    assert watch._clock is read_boot_clock
    assert watch.measure_pause() >= 0.0
