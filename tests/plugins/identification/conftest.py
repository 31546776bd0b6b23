"""Records of a mirror with one resonance, 1000 Hz and damping ratio 0.02, uncoupled."""

import numpy as np
import pytest

from rotemina.plugins.identification.record_query import Question
from rotemina.sim.plant.response import nominal_response
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot

RATE_HZ = 12_800.0
NOISE_M = 1e-10


@pytest.fixture(scope="session")
def mirror():
    """The robot."""
    return load_robot("fsm")


@pytest.fixture(scope="session")
def record_of(mirror):
    """Make the record of axis m1 for a command (n,) in m, with sensor noise from a fixed seed."""

    def make(command, noise_m=NOISE_M, **metadata):
        time_s = np.arange(len(command)) / RATE_HZ
        asked = Record.from_signals(time_s, {("m1", Tap.CMD): command}, {"m1": "m"}, metadata)
        answer = nominal_response(mirror, asked)
        noise = noise_m * np.random.default_rng(7).standard_normal(len(command))
        signals = {
            ("m1", Tap.CMD): command,
            ("m1", Tap.U): answer.signal("m1", Tap.U),
            ("m1", Tap.MEAS): answer.signal("m1", Tap.MEAS) + noise,
        }
        return Record.from_signals(time_s, signals, {"m1": "m"}, metadata)

    return make


@pytest.fixture(scope="session")
def noise_record(record_of):
    """Driven by white noise for about 1.3 s."""
    return record_of(1e-6 * np.random.default_rng(3).uniform(-1.0, 1.0, 16_384))


@pytest.fixture(scope="session")
def stairs_record(record_of):
    """Up and down by 1 µm every 0.1 s."""
    return record_of(1e-6 * (np.arange(12_800) // 1280 % 2))


@pytest.fixture
def ask(mirror):
    """Ask of m1 from command to measurement."""

    def make(record, drive=Tap.CMD, answer=Tap.MEAS, **settings):
        return Question("a record", record, mirror, record.axes[0], drive, answer, **settings)

    return make
