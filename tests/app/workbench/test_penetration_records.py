"""A penetration is recorded automatically, unless a recording is already running."""

from types import SimpleNamespace

import pytest

from rotemina.app.motion.penetration import PenetrationPhase
from rotemina.app.workbench.penetration_records import PenetrationRecorder
from rotemina.drivers.contract import VirtualClock


class FakeOperation:
    """A stub operation that logs its recordings."""

    def __init__(self, file):
        self.file = file
        self.recording = None
        self.calls = []
        self.penetration = SimpleNamespace(status=SimpleNamespace(phase=PenetrationPhase.ARMED))

    def start_recording(self, *, name=""):
        self.calls.append(name)
        self.recording = object()

    def stop_recording(self):
        self.recording = None
        self.calls.append("ended")
        self.file.write_text("all")
        return self.file


class RecorderBench:
    def __init__(self, qtbot, file):
        self.operation, self.clock, self.messages = FakeOperation(file), VirtualClock(0.0), []
        self.records = PenetrationRecorder(self.operation, self.messages.append, self.clock)
        self.stored = []
        self.records.stored.connect(self.stored.append)
        self.qtbot = qtbot

    def update(self, phase, seconds=0.0):
        self.operation.penetration.status.phase = phase
        self.clock.advance(seconds)
        self.records.update_recording()
        self.qtbot.waitUntil(lambda: not self.records._background.busy)
        return self.operation.calls


@pytest.fixture
def bench(qtbot, tmp_path):
    bench = RecorderBench(qtbot, tmp_path / "file")
    yield bench
    bench.records.close()


def test_a_penetration_is_recorded_from_arming_until_half_a_second_after_its_end(bench):
    assert bench.update(PenetrationPhase.DISARMED) == []
    assert bench.update(PenetrationPhase.ARMED) == ["penetration"]
    assert bench.update(PenetrationPhase.APPROACH) == ["penetration"]
    assert bench.update(PenetrationPhase.RETRACT, 5.0) == ["penetration"]
    assert bench.update(PenetrationPhase.DONE) == ["penetration"]
    assert bench.update(PenetrationPhase.DONE, 0.4) == ["penetration"]
    assert bench.update(PenetrationPhase.DONE, 0.2) == ["penetration", "ended"]
    assert bench.update(PenetrationPhase.DONE, 9.0) == ["penetration", "ended"]
    assert bench.stored == [bench.operation.file]
    assert bench.operation.file.exists()
    assert bench.update(PenetrationPhase.RETRACT)[2:] == ["penetration"]  # retracted after a hold
    assert bench.messages == []


def test_a_penetration_that_never_started_is_not_kept(bench):
    bench.update(PenetrationPhase.ARMED)
    bench.update(PenetrationPhase.DISARMED)
    assert bench.update(PenetrationPhase.DISARMED, 1.0) == ["penetration", "ended"]
    assert bench.stored == []
    assert not bench.operation.file.exists()


@pytest.mark.parametrize("phase_before", [None, PenetrationPhase.APPROACH])
def test_a_recording_of_the_operator_is_left_running(bench, phase_before):
    if phase_before is not None:  # a recording of the penetration is running already
        bench.update(phase_before)
    calls = list(bench.operation.calls)
    bench.operation.recording = other_recording = object()
    bench.update(PenetrationPhase.APPROACH)
    bench.update(PenetrationPhase.DONE, 9.0)
    assert bench.update(PenetrationPhase.DONE, 9.0) == calls
    assert bench.operation.recording is other_recording


def test_a_newer_recording_of_the_operator_is_kept(bench):
    """The operator ends the recording and starts another while the recorder ends the first."""
    bench.update(PenetrationPhase.ARMED)
    bench.update(PenetrationPhase.DISARMED)
    run = bench.records._background.run

    def run_late(*args):
        bench.operation.recording = new_recording
        run(*args)

    new_recording = object()
    bench.records._background.run = run_late
    assert bench.update(PenetrationPhase.DISARMED, 0.6) == ["penetration"]
    assert bench.operation.recording is new_recording
    assert bench.stored == []
