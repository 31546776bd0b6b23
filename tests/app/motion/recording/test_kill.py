"""A killed recorder loses at most the last second, and nothing before it."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from rotemina.app.motion.recording import Recording, recover_recording

CHILD = Path(__file__).with_name("recorded_child.py")
MAX_LOSS_S = 1.0


def kill_after(path, portions):
    """Kill a recording child after this many portions; return its (host time, samples) lines."""
    child = subprocess.Popen(
        [sys.executable, str(CHILD), str(path)], stdout=subprocess.PIPE, text=True
    )
    lines = []
    try:
        while len(lines) < portions:
            lines.append(child.stdout.readline())
    finally:
        child.kill()
        rest, _ = child.communicate()
    whole_lines = [
        line for line in [*lines, *rest.splitlines(keepends=True)] if line.endswith("\n")
    ]
    return [(float(time_s), int(count)) for time_s, count in map(str.split, whole_lines)]


def measure_loss(path, progress):
    """Check the recovered recording, and return the time, s, that was lost before the kill."""
    recording = Recording.open(recover_recording(path.with_name(path.name + ".part")))
    samples = recording.read_samples()
    number = np.arange(len(samples))
    np.testing.assert_array_equal(samples.command[:, 5], number * 8.0 + 5.0)
    np.testing.assert_array_equal(samples.measured[:, 0], number * 8.0 + 0.25)
    np.testing.assert_array_equal(samples.inputs[:, 1], number * 8.0 + 1.5)
    np.testing.assert_array_equal(samples.model[:, 2], number * 8.0 + 2.75)
    notes = [int(event.text) for event in recording.read_events() if event.kind == "note"]
    assert notes == list(range(0, len(samples), 320))
    killed_s = progress[-1][0]
    last_recovered_s = max(
        [time_s for time_s, count in progress if count <= len(samples)], default=progress[0][0]
    )
    return killed_s - last_recovered_s


def kill_at_random(tmp_path, times, seed):
    rng = np.random.default_rng(seed)
    losses_s = []
    for number in range(times):
        path = tmp_path / f"{number}.arrows"
        losses_s.append(measure_loss(path, kill_after(path, int(rng.integers(1, 130)))))
    print(f"{times} kills lost {max(losses_s):.3f} s at most")
    assert max(losses_s) <= MAX_LOSS_S
    return losses_s


def test_two_kills_lose_at_most_a_second(tmp_path):
    kill_at_random(tmp_path, 2, seed=1)


@pytest.mark.slow
def test_many_kills_lose_at_most_a_second(tmp_path):
    losses_s = kill_at_random(tmp_path, int(os.environ.get("ROTEMINA_KILLS", "6")), seed=2)
    assert max(losses_s) > 0.0  # the recordings were really cut off
