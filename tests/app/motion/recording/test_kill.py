"""A recorder that is killed: at most the last second is lost, and nothing before it."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from rotemina.app.motion.recording.recording_reader import Recording
from rotemina.app.motion.recording.recovery import recover

CHILD = Path(__file__).with_name("recorded_child.py")
MOST_LOST_S = 1.0


def killed_after(path, portions):
    """Kill a recording child after it has told so many times; return (host time, samples) told."""
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
    whole = [line for line in [*lines, *rest.splitlines(keepends=True)] if line.endswith("\n")]
    return [(float(at), int(count)) for at, count in map(str.split, whole)]


def check_recovered(path, told):
    recording = Recording.open(recover(path.with_name(path.name + ".part")))
    samples = recording.samples()
    number = np.arange(len(samples))
    np.testing.assert_array_equal(samples.command[:, 5], number * 8.0 + 5.0)
    np.testing.assert_array_equal(samples.measured[:, 0], number * 8.0 + 0.25)
    np.testing.assert_array_equal(samples.inputs[:, 1], number * 8.0 + 1.5)
    np.testing.assert_array_equal(samples.model[:, 2], number * 8.0 + 2.75)
    notes = [int(event.text) for event in recording.events() if event.kind == "note"]
    assert notes == list(range(0, len(samples), 320))
    killed_s = told[-1][0]
    kept_s = max([at for at, count in told if count <= len(samples)], default=told[0][0])
    return killed_s - kept_s


def kill_at_random(tmp_path, times, seed):
    rng = np.random.default_rng(seed)
    lost = []
    for number in range(times):
        path = tmp_path / f"{number}.arrows"
        lost.append(check_recovered(path, killed_after(path, int(rng.integers(1, 130)))))
    print(f"{times} kills lost {max(lost):.3f} s at most, {np.median(lost):.3f} s in the median")
    assert max(lost) <= MOST_LOST_S
    return lost


def test_killed_twice(tmp_path):
    kill_at_random(tmp_path, 2, seed=1)


@pytest.mark.slow
def test_killed_often(tmp_path):
    lost = kill_at_random(tmp_path, int(os.environ.get("ROTEMINA_KILLS", "15")), seed=2)
    assert max(lost) > 0.0  # it was really cut off
