"""The driver through a USB adapter: frames of 1 ms outwards, and a latency timer inwards."""

import numpy as np
import pytest

from rotemina.drivers.samples import DeviceState
from rotemina.sim.records.record import Record, Tap

FRAME_S = 1e-3
ROUND_S = 1e-4  # what one port reads, the other's boards have lived through
PACKET = 62  # bytes that go to the host at once, whatever the timer says


def through_an_adapter(port, latency_s):
    """Let a port write at the next USB frame, and read a full packet or what the timer lets go."""
    line, clock = port.line, port.clock
    waiting, had = [], bytearray()
    given_s = clock()

    def write(data):
        frames = np.ceil((clock() - port.begin_s) / FRAME_S - 1e-6)
        waiting.append((float(frames) * FRAME_S, data))

    def read():
        nonlocal given_s
        now_s = clock() - port.begin_s
        while waiting and waiting[0][0] <= now_s + 1e-9:
            at_s, data = waiting.pop(0)
            had.extend(line.advance(at_s))
            line.receive(data, at_s)
        had.extend(line.advance(now_s))
        if len(had) < PACKET and clock() < given_s + latency_s:
            return b""
        given_s, out = clock(), bytes(had)
        had.clear()
        return out

    port.write, port.read = write, read


@pytest.fixture(params=[1e-3, 16e-3], ids=["1 ms", "16 ms"])
def bench(request, robot, joined_bench):
    made = joined_bench(robot)
    opened = made.driver._open_port

    def open_port(url, baud):
        port = opened(url, baud)
        through_an_adapter(port, request.param)
        return port

    made.driver._open_port = open_port
    made.driver.open()
    made.run(0.05)
    yield made
    made.driver.close()


def wave(rows):
    time_s = np.arange(rows) * 0.005
    command = 30e-6 + 1e-6 * np.sin(2 * np.pi * time_s)
    return Record.from_signals(time_s, {("zn", Tap.CMD): command}, {"zn": "m"})


def test_a_playback_keeps_up_and_a_stop_takes_one_usb_frame_longer(bench):
    bench.driver.play(wave(100))
    samples = bench.run_until(DeviceState.IDLE, DeviceState.MOVING, DeviceState.FAULT)
    assert bench.driver.status().fault is None
    rows = samples.playback_row[samples.playback_row >= 0]
    np.testing.assert_array_equal(rows, np.arange(100))
    assert bench.driver.link_quality().repeated == 0
    bench.driver.play(wave(1000))
    bench.run(0.1)
    bench.run(0.0237, round_s=ROUND_S)
    asked_s, told_s = bench.clock() - bench.begin_s, bench.driver.link_quality().stop_s
    bench.driver.stop()
    bench.run(0.03, round_s=ROUND_S)
    heard = {}  # what is said again after that is the same stop
    for note in bench.boards.notes.taken():
        if note.text.endswith("stop heard"):
            heard.setdefault(note.text, note.at_s)
    assert len(heard) == 2
    assert max(heard.values()) - asked_s <= told_s + FRAME_S + ROUND_S
