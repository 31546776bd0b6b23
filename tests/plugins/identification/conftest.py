"""Records of a mirror with one resonance, 1000 Hz and damping ratio 0.02, uncoupled."""

import numpy as np
import pytest

from rotemina.plugins.identification.record_query import AnalysisQuestion
from rotemina.sim.plant import simulate_nominal_response
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot_files import load_robot

RATE_HZ = 12_800.0
NOISE_M = 1e-10


@pytest.fixture(scope="session")
def mirror():
    """Return the mirror, as a robot."""
    return load_robot("fsm")


@pytest.fixture(scope="session")
def make_mirror_record(mirror):
    """Return a function that makes a record of axis m1 for a command (n,), m, with sensor noise."""

    def make(command, noise_m=NOISE_M, **metadata):
        time_s = np.arange(len(command)) / RATE_HZ
        commands = Record.from_signals(time_s, {("m1", Tap.CMD): command}, {"m1": "m"}, metadata)
        response = simulate_nominal_response(mirror, commands)
        noise = noise_m * np.random.default_rng(7).standard_normal(len(command))
        signals = {
            ("m1", Tap.CMD): command,
            ("m1", Tap.U): response.signal("m1", Tap.U),
            ("m1", Tap.MEAS): response.signal("m1", Tap.MEAS) + noise,
        }
        return Record.from_signals(time_s, signals, {"m1": "m"}, metadata)

    return make


@pytest.fixture(scope="session")
def noise_record(make_mirror_record):
    """Return a record of about 1.3 s with white noise as command."""
    return make_mirror_record(1e-6 * np.random.default_rng(3).uniform(-1.0, 1.0, 16_384))


@pytest.fixture(scope="session")
def stairs_record(make_mirror_record):
    """Return a record with steps of 1 µm up and down every 0.1 s."""
    return make_mirror_record(1e-6 * (np.arange(12_800) // 1280 % 2))


@pytest.fixture
def make_query(mirror):
    """Return a function that makes a query of m1, by default from command to measurement."""

    def make(record, input_tap=Tap.CMD, output_tap=Tap.MEAS, **settings):
        return AnalysisQuestion(
            "a record", record, mirror, record.axes[0], input_tap, output_tap, **settings
        )

    return make
