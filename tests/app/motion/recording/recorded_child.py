"""A process that records until it is killed, and prints the time and number of added samples."""

import sys
import time
from pathlib import Path

import numpy as np

from rotemina.app.motion.recording.writer import RecordingWriter
from rotemina.drivers.contract import DeviceSamples

RATE_HZ = 20_000
PORTION = 320
AXES = 6


def make_samples(first):
    """Return samples whose values contain the number of the sample."""
    number = np.arange(first, first + PORTION)
    values = number[:, None] * 8.0 + np.arange(AXES)
    rows = np.full(PORTION, -1)
    return DeviceSamples(number / RATE_HZ, values, values + 0.25, values + 0.5, rows)


def main(path):
    writer = RecordingWriter(Path(path), dict.fromkeys("abcdef", "m"), {})
    writer.start()
    start_s = time.monotonic()
    first = 0
    while True:
        samples = make_samples(first)
        now_s = time.monotonic()
        writer.add(samples, samples.command + 0.75, now_s)
        writer.add_event("note", str(first))
        first += PORTION
        sys.stdout.write(f"{now_s:.6f} {first}\n")
        sys.stdout.flush()
        time.sleep(max(0.0, start_s + first / RATE_HZ - time.monotonic()))


if __name__ == "__main__":
    main(sys.argv[1])
