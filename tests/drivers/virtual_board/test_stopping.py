"""The time from a stop to the first slower step and to the last step."""

import numpy as np
import pytest

from rotemina.drivers.mc68hc11.protocol import (
    STOP_BYTES,
    BeginStream,
    BoardFault,
    IdentifyBoard,
    MoveVelocity,
    SetWatchdog,
    StreamSegment,
)
from rotemina.drivers.virtual_board import inject_fault
from rotemina.drivers.virtual_board.boards import DEFAULT_TICK_S

SPEED_STEPS_PER_S = 50_000
BRAKING_S = 5e-3 / 0.2
BYTE_S = 80e-6


@pytest.fixture
def moving_host(make_host):
    """Return a host whose axis x moves at constant speed, with a watchdog of 50 ms."""
    host = make_host()
    host.ask(SetWatchdog(50))
    for _ in range(10):
        host.send(MoveVelocity(0, SPEED_STEPS_PER_S, 5000))
        host.run(0.03)
    return host


def measure_braking(host, since_s, seconds=0.2):
    """Run tick by tick, and return the times of the first slower step and of the last step.

    Times are in s after ``since_s``, at the end of a tick.
    """
    drive, times, positions = host.boards.boards[0].drives[0], [], []
    for _ in range(round(seconds / DEFAULT_TICK_S)):
        host.run(DEFAULT_TICK_S)
        times.append(host.time_s - since_s)
        positions.append(drive.position)
    steps = np.diff(positions)
    usual_steps = SPEED_STEPS_PER_S * DEFAULT_TICK_S
    slower_ticks = np.flatnonzero(steps < 0.999 * usual_steps)
    assert slower_ticks.size, "it does not brake"
    return times[slower_ticks[0] + 1], times[np.flatnonzero(steps > 0.0)[-1] + 1]


def test_after_a_stop_the_axis_brakes_in_the_next_tick_and_rests_in_time(moving_host):
    since_s = moving_host.time_s
    moving_host.write(STOP_BYTES)
    slower_s, last_s = measure_braking(moving_host, since_s)
    assert slower_s <= BYTE_S + 2.0 * DEFAULT_TICK_S
    assert last_s <= BYTE_S + BRAKING_S + 2.0 * DEFAULT_TICK_S
    assert moving_host.boards.boards[0].fault is BoardFault.STOPPED


@pytest.mark.parametrize("phase_s", [0.0, 2.7e-4])
@pytest.mark.parametrize("is_playing", [False, True])
def test_the_last_step_comes_at_most_one_tick_after_the_braking_time(
    make_host, phase_s, is_playing
):
    host = make_host().with_long_watchdogs()
    if is_playing:
        host.send(BeginStream(host.read_time_us() + 50_000 & 0xFFFF_FFFF, 100, 10, 0))
        # The set-points have the same speed.
        for index in range(40):
            host.send(
                StreamSegment.from_differences(
                    index, 10, [(250 if index else 0, 0), (0, 0), (0, 0)]
                )
            )
            host.run(0.003)
    else:
        host.send(MoveVelocity(0, SPEED_STEPS_PER_S, 5000))
        host.run(0.1)
    host.run(phase_s)
    host.write(STOP_BYTES)
    host.run(0.1)
    (note,) = host.boards.notes.stops
    assert 0.8 * BRAKING_S < note.rest_s - note.received_s <= BRAKING_S + DEFAULT_TICK_S + 1e-9


def test_a_break_on_the_line_is_a_stop_and_nothing_is_answered_until_it_ends(moving_host):
    since_s = moving_host.time_s
    # The break comes in the middle of a frame.
    moving_host.write(b"\x04\x01\x07")
    inject_fault(moving_host.boards, "space 1 s")
    slower_s, last_s = measure_braking(moving_host, since_s)
    assert slower_s <= 5 * BYTE_S + 2.0 * DEFAULT_TICK_S
    assert last_s <= 5 * BYTE_S + BRAKING_S + 2.0 * DEFAULT_TICK_S
    assert moving_host.boards.boards[0].fault is BoardFault.STOPPED
    assert moving_host.ask(IdentifyBoard(1)) is None
    moving_host.run(1.0)
    assert moving_host.ask(IdentifyBoard(1)) is not None


def test_on_a_disconnected_line_the_watchdog_stops_the_axis(moving_host):
    # This is the last valid frame.
    moving_host.send(MoveVelocity(0, SPEED_STEPS_PER_S, 5000))
    moving_host.run(0.005)
    since_s = moving_host.time_s
    inject_fault(moving_host.boards, "silence 1 s")
    slower_s, last_s = measure_braking(moving_host, since_s)
    assert 0.04 < slower_s <= 0.05 + 2.0 * DEFAULT_TICK_S
    assert last_s <= 0.05 + BRAKING_S + 2.0 * DEFAULT_TICK_S
    assert moving_host.boards.boards[0].fault is BoardFault.WATCHDOG
