"""How soon steps come farther apart after a stop, and when the last one comes."""

import numpy as np
import pytest

from rotemina.drivers.mc68hc11.framing import STOP_BYTES
from rotemina.drivers.mc68hc11.host_messages import BeginStream, MoveVelocity, SetPoint, Watch
from rotemina.drivers.mc68hc11.protocol_codes import Fault
from rotemina.drivers.virtual_board.boards import TICK_S
from rotemina.drivers.virtual_board.fault_injection import inject

SPEED = 50_000  # steps/s: 5 mm/s
BRAKING_S = 5e-3 / 0.2
BYTE_S = 80e-6


@pytest.fixture
def running(hosts):
    """Return a host whose x goes at a speed that lasts, and a watchdog of 50 ms."""
    host = hosts()
    host.ask(Watch(50))
    for _ in range(10):
        host.say(MoveVelocity(0, SPEED, 5000))
        host.live(0.03)
    return host


def braking(host, since_s, seconds=0.2):
    """Live on tick by tick; return when steps first came slower, and when the last one came.

    Times in s after ``since_s``, each the end of a tick.
    """
    drive, times, places = host.boards.boards[0].drives[0], [], []
    for _ in range(round(seconds / TICK_S)):
        host.live(TICK_S)
        times.append(host.time_s - since_s)
        places.append(drive.position)
    steps = np.diff(places)
    usual = SPEED * TICK_S
    slower = np.flatnonzero(steps < 0.999 * usual)
    assert slower.size, "it does not brake"
    return times[slower[0] + 1], times[np.flatnonzero(steps > 0.0)[-1] + 1]


def test_after_a_stop_the_next_tick_is_slower_and_the_last_step_comes_in_time(running):
    since_s = running.time_s
    running.write(STOP_BYTES)
    slower_s, last_s = braking(running, since_s)
    assert slower_s <= BYTE_S + 2.0 * TICK_S
    assert last_s <= BYTE_S + BRAKING_S + 2.0 * TICK_S
    assert running.boards.boards[0].fault is Fault.STOPPED


@pytest.mark.parametrize("phase_s", [0.0, 1e-4, 2.7e-4, 4.3e-4])
@pytest.mark.parametrize("playing", [False, True])
def test_the_last_pulse_comes_one_tick_after_the_time_that_braking_takes(hosts, phase_s, playing):
    host = hosts().patient()
    if playing:
        host.say(BeginStream(host.now_us() + 50_000 & 0xFFFF_FFFF, 100, 10, 0))
        for index in range(40):  # at SPEED
            host.say(SetPoint.of(index, 10, [(250 if index else 0, 0), (0, 0), (0, 0)]))
            host.live(0.003)
    else:
        host.say(MoveVelocity(0, SPEED, 5000))
        host.live(0.1)
    host.live(phase_s)
    host.write(STOP_BYTES)
    host.live(0.1)
    (note,) = host.boards.notes.stops
    assert 0.8 * BRAKING_S < note.rest_s - note.heard_s <= BRAKING_S + TICK_S + 1e-9


def test_a_line_held_at_space_is_a_stop(running):
    since_s = running.time_s
    running.write(b"\x04\x01\x07")  # in the middle of a frame
    inject(running.boards, "space 1 s")
    slower_s, last_s = braking(running, since_s)
    assert slower_s <= 5 * BYTE_S + 2.0 * TICK_S
    assert last_s <= 5 * BYTE_S + BRAKING_S + 2.0 * TICK_S
    assert running.boards.boards[0].fault is Fault.STOPPED


def test_a_torn_line_is_silence_and_the_watchdog_stops(running):
    running.say(MoveVelocity(0, SPEED, 5000))  # the latest valid frame
    running.live(0.005)
    since_s = running.time_s
    inject(running.boards, "silence 1 s")
    slower_s, last_s = braking(running, since_s)
    assert 0.04 < slower_s <= 0.05 + 2.0 * TICK_S
    assert last_s <= 0.05 + BRAKING_S + 2.0 * TICK_S
    assert running.boards.boards[0].fault is Fault.WATCHDOG
