"""A penetration is recorded by itself, unless a recording runs anyway."""

from types import SimpleNamespace

import pytest

from rotemina.app.motion.penetration.status import Phase
from rotemina.app.shell.penetration_records import PenetrationRecords
from rotemina.drivers.clock import VirtualClock


class Operation:
    """Of an operation, what a recorder of penetrations needs."""

    def __init__(self, file):
        self.file = file
        self.recording = None
        self.done = []
        self.penetration = SimpleNamespace(status=SimpleNamespace(phase=Phase.ARMED))

    def start_recording(self, *, name=""):
        self.done.append(name)
        self.recording = object()

    def stop_recording(self):
        self.recording = None
        self.done.append("ended")
        self.file.write_text("all")
        return self.file


class Bench:
    def __init__(self, qtbot, file):
        self.operation, self.clock, self.told = Operation(file), VirtualClock(0.0), []
        self.records = PenetrationRecords(self.operation, self.told.append, self.clock)
        self.stored = []
        self.records.stored.connect(self.stored.append)
        self.qtbot = qtbot

    def look(self, phase, seconds=0.0):
        self.operation.penetration.status.phase = phase
        self.clock.advance(seconds)
        self.records.look()
        self.qtbot.waitUntil(lambda: not self.records._background.busy)
        return self.operation.done


@pytest.fixture
def bench(qtbot, tmp_path):
    bench = Bench(qtbot, tmp_path / "file")
    yield bench
    bench.records.close()


def test_a_penetration_is_recorded_from_its_arming_until_half_a_second_after_its_end(bench):
    assert bench.look(Phase.DISARMED) == []
    assert bench.look(Phase.ARMED) == ["penetration"]
    assert bench.look(Phase.APPROACH) == ["penetration"]
    assert bench.look(Phase.RETRACT, 5.0) == ["penetration"]
    assert bench.look(Phase.DONE) == ["penetration"]
    assert bench.look(Phase.DONE, 0.4) == ["penetration"]
    assert bench.look(Phase.DONE, 0.2) == ["penetration", "ended"]
    assert bench.look(Phase.DONE, 9.0) == ["penetration", "ended"]
    assert bench.stored == [bench.operation.file]
    assert bench.operation.file.exists()
    assert bench.look(Phase.RETRACT)[2:] == ["penetration"]  # what was held comes back
    assert bench.told == []


def test_what_was_armed_and_never_started_is_not_kept(bench):
    bench.look(Phase.ARMED)
    bench.look(Phase.DISARMED)
    assert bench.look(Phase.DISARMED, 1.0) == ["penetration", "ended"]
    assert bench.stored == []
    assert not bench.operation.file.exists()


def test_a_recording_of_the_operator_is_neither_begun_anew_nor_ended(bench):
    bench.operation.recording = theirs = object()
    bench.look(Phase.APPROACH)
    bench.look(Phase.DONE, 9.0)
    assert bench.look(Phase.DONE, 9.0) == []
    assert bench.operation.recording is theirs


def test_one_that_the_operator_ended_is_not_ended_again(bench):
    bench.look(Phase.APPROACH)
    bench.operation.recording = theirs = object()
    bench.look(Phase.DONE, 9.0)
    assert bench.look(Phase.DONE, 9.0) == ["penetration"]
    assert bench.operation.recording is theirs


def test_what_the_operator_records_since_is_not_ended_and_not_deleted(bench):
    """The operator ends the recording and begins another between the look and the end of it."""
    bench.look(Phase.ARMED)
    bench.look(Phase.DISARMED)
    run = bench.records._background.run

    def late(*given):
        bench.operation.recording = another
        run(*given)

    another = object()
    bench.records._background.run = late
    assert bench.look(Phase.DISARMED, 0.6) == ["penetration"]
    assert bench.operation.recording is another
    assert bench.stored == []
