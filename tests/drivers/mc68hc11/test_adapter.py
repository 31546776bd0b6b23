"""The driver with a USB adapter, which sends every 1 ms and receives by a latency timer."""

import numpy as np
import pytest

from rotemina.drivers.contract import DeviceState

FRAME_S = 1e-3
# The boards of both ports advance with each read, so the rounds are short.
ROUND_S = 1e-4
# The adapter sends this number of bytes at once, independent of its timer.
PACKET_BYTES = 62


def simulate_usb_adapter(port, latency_s):
    """Let a port write at the next USB frame, and read full packets or when the timer expires."""
    line, clock = port.line, port.clock
    sent, received = [], bytearray()
    last_packet_s = clock()

    def write(data):
        frames = np.ceil((clock() - port.begin_s) / FRAME_S - 1e-6)
        sent.append((float(frames) * FRAME_S, data))

    def read():
        nonlocal last_packet_s
        now_s = clock() - port.begin_s
        while sent and sent[0][0] <= now_s + 1e-9:
            at_s, data = sent.pop(0)
            received.extend(line.advance(at_s))
            line.receive(data, at_s)
        received.extend(line.advance(now_s))
        if len(received) < PACKET_BYTES and clock() < last_packet_s + latency_s:
            return b""
        last_packet_s, data = clock(), bytes(received)
        received.clear()
        return data

    port.write, port.read = write, read


@pytest.fixture(params=[1e-3, 16e-3], ids=["1 ms", "16 ms"])
def bench(request, robot, make_bench):
    bench = make_bench(robot)
    open_memory_port = bench.driver._open_port

    def open_port(url, baud):
        port = open_memory_port(url, baud)
        simulate_usb_adapter(port, request.param)
        return port

    bench.driver._open_port = open_port
    bench.driver.open()
    bench.run(0.05)
    yield bench
    bench.driver.close()


def test_a_playback_keeps_its_rate_and_a_stop_takes_one_usb_frame_longer(bench):
    bench.driver.play(bench.make_wave(100))
    samples = bench.run_until(DeviceState.IDLE, DeviceState.MOVING, DeviceState.FAULT)
    assert bench.driver.status().fault is None
    rows = samples.playback_row[samples.playback_row >= 0]
    np.testing.assert_array_equal(rows, np.arange(100))
    assert bench.driver.link_quality().repeated == 0
    bench.driver.play(bench.make_wave(1000))
    bench.run(0.1)
    bench.run(0.0237, round_s=ROUND_S)
    request_s, announced_s = bench.clock() - bench.begin_s, bench.driver.link_quality().stop_s
    bench.driver.stop()
    bench.run(0.03, round_s=ROUND_S)
    # Later reports of a board are about the same stop, so only the first one counts.
    heard_s = {}
    for note in bench.boards.notes.take_events():
        if note.text.endswith("stop heard"):
            heard_s.setdefault(note.text, note.at_s)
    assert len(heard_s) == 2
    assert max(heard_s.values()) - request_s <= announced_s + FRAME_S + ROUND_S
