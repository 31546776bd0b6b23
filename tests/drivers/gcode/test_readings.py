"""Reports that are damaged, late or of another place: none of them moves an axis wrongly."""

import re

import pytest

from rotemina.drivers.errors import LimitError, StateError
from rotemina.drivers.gcode.emulator import EmulatedStage
from rotemina.drivers.gcode.jog_guard import JogGuard
from rotemina.drivers.samples import DeviceState

TARGET = re.compile(r"([XYZ])(-?[\d.]+)")


def lose_point(data):
    return data.replace(b".", b"", 1)


def lose_coordinate(data):
    return re.sub(rb",-?[\d.]+", b"", data, count=1)


def lose_sign(data):
    return data.replace(b"-", b"", 1)


def lose_digit(data):
    return re.sub(rb"MPos:(-?)\d", rb"MPos:\1", data, count=1)


def lose_letter_of_state(data):
    return data.replace(b"<Idle", b"<Ile").replace(b"<Jog", b"<Jg")


DAMAGES = [lose_point, lose_coordinate, lose_sign, lose_digit, lose_letter_of_state]


def in_range(bench, since):
    """Return whether every target sent lies within its axis' travel."""
    travel = {"X": 50.0, "Y": 50.0, "Z": 30.0}
    return all(
        -travel[letter] <= float(value) <= 0.0
        for line in bench.lines_sent(since)
        for letter, value in TARGET.findall(line)
    )


@pytest.mark.parametrize("damage", DAMAGES, ids=lambda damage: damage.__name__)
def test_a_damaged_report_before_a_move_is_not_its_start(joined, damage):
    bench = joined()
    bench.stage.settings[20] = 0.0  # without soft limits nothing but the driver protects
    driver = bench.homed()
    bench.alter_once(damage)
    bench.run(0.03)
    since = len(bench.port.written)
    rejected = driver.link_quality().rejected
    driver.move_to({"x": 0.04})
    bench.rest()
    assert rejected == 1
    assert in_range(bench, since)
    assert bench.stage.true[0] == pytest.approx(40.0, abs=1e-3)
    assert driver.status().fault is None


@pytest.mark.parametrize("damage", DAMAGES, ids=lambda damage: damage.__name__)
def test_a_damaged_report_in_mid_move_is_discarded_and_the_move_goes_on(joined, damage):
    bench = joined()
    driver = bench.homed()
    driver.move_to({"x": 0.03, "y": 0.02})
    for _ in range(5):
        bench.alter_once(damage)
        bench.run(0.2)
    samples = bench.rest()
    assert driver.link_quality().rejected == 5
    assert samples.measured[:, 0].max() <= 0.030001
    assert bench.stage.true[:2] == pytest.approx([30.0, 20.0], abs=1e-3)
    assert driver.status().fault is None


def test_no_move_starts_before_a_plausible_report(joined):
    bench = joined()
    driver = bench.homed()
    bench.port.alter = lose_point
    bench.run(0.02)
    since = len(bench.port.written)
    driver.move_to({"x": 0.04})
    bench.run(0.02)
    assert bench.lines_sent(since) == []
    bench.port.alter = None
    bench.rest()
    assert bench.stage.true[0] == pytest.approx(40.0, abs=1e-3)


def test_three_reports_of_another_place_make_the_position_unknown(joined):
    bench = joined()
    driver = bench.homed()
    bench.stage._blocks.set(0, -20.0)  # somebody set its count
    bench.run(0.2)
    status = driver.status()
    assert status.state is DeviceState.FAULT
    assert "3 reports in a row" in status.fault
    assert status.unhomed == ("x", "y", "z")
    bench.rest()
    driver.clear_fault()
    bench.rest()
    with pytest.raises(StateError, match="home first"):
        driver.move_to({"x": 0.01})
    driver.home(driver.homing_axes)
    bench.rest()
    assert driver.status().position_known


def test_a_late_answer_to_an_abandoned_query_is_discarded(joined):
    bench = joined()
    driver = bench.homed()
    driver.move_to({"x": 0.04})
    bench.run(0.5)
    held = []
    bench.port.alter = lambda data: (held.append(data), b"")[1] if b"MPos" in data else data
    bench.run(0.03)
    late = b"".join(held)
    bench.port.alter = lambda data: b"" if b"MPos" in data else data
    bench.run(0.24)  # the query is abandoned
    bench.port.alter = lambda data: late + data
    samples = bench.run(0.01)
    bench.port.alter = None
    assert late
    assert len(samples) == 0
    bench.rest()
    assert bench.stage.true[0] == pytest.approx(40.0, abs=1e-3)


def test_after_a_pause_of_the_program_nothing_goes_on_by_itself(joined):
    bench = joined()
    driver = bench.homed()
    driver.move_to({"x": 0.045})
    bench.run(0.5)
    bench.clock.advance(20.0)
    bench.run(0.1)
    held = bench.stage.true[0]
    bench.rest()
    assert bench.stage.true[0] == held < 20.0
    assert driver.status().position_known
    driver.move_to({"x": 0.02})
    bench.rest()
    assert bench.stage.true[0] == pytest.approx(20.0, abs=1e-3)


def test_a_pause_at_rest_changes_nothing(joined):
    bench = joined()
    driver = bench.homed()
    bench.run(0.5)
    bench.clock.advance(3600.0)
    bench.run(0.2)
    assert driver.status().position_known
    assert driver.status().fault is None


class Backwards(EmulatedStage):
    """Counts against the direction in which it goes."""

    def _report_if_asked(self):
        position = self._blocks.position
        self._blocks.position = [2.0 * -49.0 - at for at in position[:1]] + position[1:]
        super()._report_if_asked()
        self._blocks.position = position


def test_the_first_move_ends_after_a_millimetre_if_the_reading_goes_the_other_way(joined):
    bench = joined(stage=Backwards)
    driver = bench.homed()
    driver.move_to({"x": 0.04})
    bench.run(3.0)
    status = driver.status()
    assert "axis x reads -49." in status.fault
    assert "check the direction" in status.fault
    assert "x" in status.unhomed
    assert bench.stage.true[0] <= 2.0 + 1e-3  # homed at 1 mm


def test_an_axis_that_does_not_follow_its_first_move_is_a_fault(joined):
    bench = joined()
    driver = bench.homed()
    bench.port.alter = lambda data: re.sub(rb"MPos:-[\d.]+", b"MPos:-49.000", data)
    driver.move_to({"x": 0.04})
    bench.run(3.0)
    assert "axis x at -49.000 instead of -10.000" in driver.status().fault
    assert bench.stage.true[0] <= 2.0 + 1e-3


def test_a_stop_halts_although_a_line_waits_in_the_controller(joined):
    class Slow(EmulatedStage):
        """Takes lines only when told; a jog that waits there begins after a hold."""

        takes = True

        def _obey_a_line(self):
            if self.takes:
                super()._obey_a_line()

    bench = joined(stage=Slow)
    driver = bench.homed()
    bench.stage.takes = False
    driver.move_to({"x": 0.045})
    bench.run(0.05)
    driver.stop()
    bench.stage.takes = True
    bench.run(0.5)
    assert bench.stage.true[0] < 1.1  # homed at 1 mm


@pytest.mark.parametrize("delay_s", [0.025, 0.12, 0.3])
def test_a_slow_line_works_and_its_samples_are_dated_right(joined, delay_s):
    bench = joined(line={"delay_s": delay_s})
    driver = bench.homed()
    driver.move_to({"x": 0.02}, {"x": 0.005})
    began_s = driver._controller._opened_s
    truth = []
    for _ in range(400):
        bench.clock.advance(0.01)
        samples = driver.read()
        truth.append((bench.clock() - began_s, bench.stage.true[0] * 1e-3))
        for time_s, at in zip(samples.device_time_s, samples.measured[:, 0], strict=True):
            past = [value for when_s, value in truth if when_s <= time_s + 1e-9]
            if past:
                assert abs(at - past[-1]) <= 0.005 * (driver.stamp_error_s + 0.01) + 2e-6
        assert driver.status().silent_s == 0.0
    bench.rest()
    assert bench.stage.true[0] == pytest.approx(20.0, abs=1e-3)
    assert driver.stamp_error_s >= delay_s * 0.9
    driver.stop()
    bench.rest()
    assert driver.status().position_known


def test_a_line_that_is_too_slow_is_refused_with_its_round_trip(joined):
    bench = joined(line={"delay_s": 0.6})
    with pytest.raises(Exception, match=r"an answer takes 1\.2\d? s; at most 1 s is accepted"):
        bench.driver.open()


@pytest.mark.parametrize(
    "line",
    [
        "$J=G53 G21 G90 X-50.1 F100",
        "$J=G53 G21 G90 X0.1 F100",
        "$J=G53 G21 X-10 F100",
        "$J=G53 G21 G91 X-10 F100",
        "$J=G53 G20 G90 X-1 F100",
        "$J=G53 G21 G90 A-1 F100",
        "$J=G53 G21 G90 Xnan F100",
        "G0 X-10",
        "$120=10",
        "$RST=*",
    ],
)
def test_no_line_that_could_leave_a_range_reaches_the_wire(joined, line):
    bench = joined()
    driver = bench.homed()
    since = len(bench.port.written)
    with pytest.raises(LimitError, match="was not sent"):
        driver._controller.dialogue.say(line)
    assert bench.lines_sent(since) == []


def test_a_guard_permits_what_lies_in_range():
    guard = JogGuard()
    guard.permit_ranges({"X": (-50.0, 0.0)})
    for line in ("$J=G53 G21 G90 X-50.0000 F600.000", "$H", "$HX", "$$", "$/axes/x/homing/mpos_mm"):
        guard.check(line)
