"""Frames of the boards: speed of packing and parsing, as multiples of the fastest line.

``make bench`` runs it. The host must be fifty times faster than the line, also with random garbage
between the frames, and must find every frame after such garbage.
"""

import time

import numpy as np

from rotemina.drivers.mc68hc11.protocol import (
    FrameDecoder,
    SerialFrame,
    Telemetry,
    encode_frame,
    unpack_message,
)

# Rate of 125 000 baud.
LINE_BYTES_PER_S = 12_500
MIN_MULTIPLE = 50.0
RUNS = 7
READ_BYTES = 256
QUICK = {"RUNS": 1, "MIN_MULTIPLE": 0.0}


def make_frames(count: int = 5000) -> list[SerialFrame]:
    rng = np.random.default_rng(0)
    numbers = rng.integers(-(2**23), 2**23, (count, 3)).tolist()
    return [
        SerialFrame(
            1,
            k & 0xFF,
            Telemetry.TYPE,
            Telemetry.from_samples(
                k, 0, 0, 0, 0, [(position, position + 1) for position in positions]
            ).pack(),
            True,
        )
        for k, positions in enumerate(numbers)
    ]


def count_frames(wire: bytes) -> int:
    decoder, count = FrameDecoder(), 0
    for begin in range(0, len(wire), READ_BYTES):
        for frame in decoder.feed(wire[begin : begin + READ_BYTES]):
            unpack_message(frame.type, frame.payload)
            count += 1
    return count


def test_the_codec_is_faster_than_the_line() -> None:
    sent = make_frames()
    rng = np.random.default_rng(1)
    clean = b"".join(map(encode_frame, sent))
    noisy = b"".join(rng.bytes(20) + encode_frame(frame) for frame in sent)
    jobs = {
        "packed": (len(clean), lambda: len([encode_frame(frame) for frame in sent])),
        "understood": (len(clean), lambda: count_frames(clean)),
        "understood in garbage": (len(noisy), lambda: count_frames(noisy)),
    }
    print(f"multiples of the line at 125 000 baud (limit {MIN_MULTIPLE})")
    for name, (size, job) in jobs.items():
        seconds = []
        for _ in range(RUNS):
            begin = time.perf_counter()
            assert job() == len(sent)
            seconds.append(time.perf_counter() - begin)
        multiples = [
            size / duration_s / LINE_BYTES_PER_S for duration_s in (max(seconds), min(seconds))
        ]
        print(f"{name}: {multiples[0]:.0f} to {multiples[1]:.0f}")
        assert multiples[0] >= MIN_MULTIPLE
