"""A pause of the program cancels the present motion."""

import time

import pytest

from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.session.heartbeat import MAX_PAUSE_S, PauseWatch, read_boot_clock
from rotemina.app.motion.state import StopRequested
from rotemina.drivers.contract import DeviceState, VirtualClock
from rotemina.drivers.simulator import Simulator
from rotemina.sim.robot_files import load_robot


class RealTimeSimulator(Simulator):
    """A simulator that counts as a device with a separate clock."""

    virtual_time = False


def run_session(simulator, pause_s):
    """Return the stops of a session, and the distance of x after a pause during a move, m."""
    clock = VirtualClock(5.0)
    session = MotionSession(simulator(load_robot("rotemina"), {"start_fraction": 0.1}, clock=clock))
    stops = []
    session.subscribe(
        lambda event: stops.append(event) if isinstance(event, StopRequested) else None
    )
    session.connect()

    def step(seconds):
        for _ in range(round(seconds / 0.01)):
            clock.advance(0.01)
            session.run_once()

    step(0.1)
    session.go_to({"x": 0.05})
    step(0.5)
    clock.advance(pause_s)
    step(0.5)
    resumed_x = session.snapshot().command["x"]
    step(3.0)
    assert session.snapshot().activity is DeviceState.IDLE or not stops
    return stops, session.snapshot().command["x"] - resumed_x


def test_a_pause_during_a_move_stops_the_machine_and_notifies_the_operator():
    stops, distance = run_session(RealTimeSimulator, 2.0 * MAX_PAUSE_S)
    assert len(stops) == 1
    assert "this program did not run for 2" in str(stops[0].request)
    assert distance == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize(
    ("simulator", "pause_s"),
    [(RealTimeSimulator, 0.5 * MAX_PAUSE_S), (Simulator, 1.2 * MAX_PAUSE_S)],
)
def test_a_short_delay_or_a_stepped_simulation_is_no_pause(simulator, pause_s):
    stops, distance = run_session(simulator, pause_s)
    assert stops == []
    assert distance > 1e-3


def test_the_boot_clock_includes_the_sleep_of_the_computer():
    watch = PauseWatch(time.monotonic)
    assert watch._clock is read_boot_clock
    assert watch.measure_pause() >= 0.0
