"""Frames of the boards: how fast they are packed and understood, as multiples of the fastest line.

``make bench`` runs it. The host must keep up with the line fifty times over, and on random garbage
too, of which every frame that follows must come through.
"""

import time

import numpy as np

from rotemina.drivers.mc68hc11.board_messages import Telemetry
from rotemina.drivers.mc68hc11.framing import Decoder, Frame, encoded
from rotemina.drivers.mc68hc11.messages import message_of

LINE_BYTES_PER_S = 12_500  # 125 000 baud
LEAST = 50.0
RUNS = 7
READ = 256  # bytes that a port gives at once
QUICK = {"RUNS": 1, "LEAST": 0.0}


def frames(count: int = 5000) -> list[Frame]:
    rng = np.random.default_rng(0)
    numbers = rng.integers(-(2**23), 2**23, (count, 3)).tolist()
    return [
        Frame(
            1,
            k & 0xFF,
            Telemetry.TYPE,
            Telemetry.of(k, 0, 0, 0, 0, [(one, one + 1) for one in own]).packed(),
            True,
        )
        for k, own in enumerate(numbers)
    ]


def understood(wire: bytes) -> int:
    decoder, count = Decoder(), 0
    for begin in range(0, len(wire), READ):
        for frame in decoder.feed(wire[begin : begin + READ]):
            message_of(frame.type, frame.payload)
            count += 1
    return count


def test_the_codec_outruns_the_line() -> None:
    sent = frames()
    rng = np.random.default_rng(1)
    clean = b"".join(map(encoded, sent))
    noisy = b"".join(rng.bytes(20) + encoded(one) for one in sent)
    jobs = {
        "packed": (len(clean), lambda: len([encoded(one) for one in sent])),
        "understood": (len(clean), lambda: understood(clean)),
        "understood in garbage": (len(noisy), lambda: understood(noisy)),
    }
    print(f"multiples of the line at 125 000 baud (limit {LEAST})")
    for name, (size, job) in jobs.items():
        seconds = []
        for _ in range(RUNS):
            begin = time.perf_counter()
            assert job() == len(sent)
            seconds.append(time.perf_counter() - begin)
        times = [size / one / LINE_BYTES_PER_S for one in (max(seconds), min(seconds))]
        print(f"{name}: {times[0]:.0f} to {times[1]:.0f}")
        assert times[0] >= LEAST
