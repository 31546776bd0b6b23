"""Damaged, late or implausible reports do not move an axis to a wrong position."""

import re

import pytest

from rotemina.drivers.contract import DeviceState, LimitError, StateError
from rotemina.drivers.gcode import EmulatedStage
from rotemina.drivers.gcode.jog_guard import JogGuard

TARGET_PATTERN = re.compile(r"([XYZ])(-?[\d.]+)")


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


DAMAGE_FUNCTIONS = [lose_point, lose_coordinate, lose_sign, lose_digit, lose_letter_of_state]


def targets_are_in_range(bench, first_byte):
    """Return whether every target sent lies within its axis' travel."""
    travel = {"X": 50.0, "Y": 50.0, "Z": 30.0}
    return all(
        -travel[letter] <= float(value) <= 0.0
        for line in bench.lines_sent(first_byte)
        for letter, value in TARGET_PATTERN.findall(line)
    )


@pytest.mark.parametrize("damage", DAMAGE_FUNCTIONS, ids=lambda damage: damage.__name__)
def test_damaged_reports_before_and_during_a_move_are_discarded(make_bench, damage):
    bench = make_bench()
    # Without soft limits, only the driver protects the stage.
    bench.stage.settings[20] = 0.0
    driver = bench.open_and_home()
    bench.alter_once(damage)
    bench.run(0.03)
    first_byte = len(bench.port.written)
    assert driver.link_quality().rejected == 1
    driver.move_to({"x": 0.03, "y": 0.02})
    for _ in range(5):
        bench.run(0.1)
        bench.alter_once(damage)
        bench.run(0.1)
    samples = bench.wait_for_rest()
    assert driver.link_quality().rejected == 6
    assert targets_are_in_range(bench, first_byte)
    assert samples.measured[:, 0].max() <= 0.030001
    assert bench.stage.true_positions[:2] == pytest.approx([30.0, 20.0], abs=1e-3)
    assert driver.status().fault is None


def test_no_move_starts_before_a_plausible_report(bench, driver):
    bench.port.alter = lose_point
    bench.run(0.02)
    first_byte = len(bench.port.written)
    driver.move_to({"x": 0.04})
    bench.run(0.02)
    assert bench.lines_sent(first_byte) == []
    bench.port.alter = None
    bench.wait_for_rest()
    assert bench.stage.true_positions[0] == pytest.approx(40.0, abs=1e-3)


def test_three_reports_of_another_position_make_the_position_unknown(bench, driver):
    # Another program has set the count of the controller.
    bench.stage._blocks.set_position(0, -20.0)
    bench.run(0.2)
    status = driver.status()
    assert status.state is DeviceState.FAULT
    assert "3 reports in a row" in status.fault
    assert status.unhomed == ("x", "y", "z")
    bench.wait_for_rest()
    driver.clear_fault()
    bench.wait_for_rest()
    with pytest.raises(StateError, match="home first"):
        driver.move_to({"x": 0.01})
    bench.home()


def test_a_late_answer_to_an_abandoned_query_is_discarded(bench, driver):
    driver.move_to({"x": 0.04})
    bench.run(0.5)
    held_replies = []
    bench.port.alter = lambda data: (held_replies.append(data), b"")[1] if b"MPos" in data else data
    bench.run(0.03)
    late_replies = b"".join(held_replies)
    bench.port.alter = lambda data: b"" if b"MPos" in data else data
    # The driver abandons the query during this time.
    bench.run(0.24)
    bench.port.alter = lambda data: late_replies + data
    samples = bench.run(0.01)
    bench.port.alter = None
    assert late_replies
    assert len(samples) == 0
    bench.wait_for_rest()
    assert bench.stage.true_positions[0] == pytest.approx(40.0, abs=1e-3)


def test_a_pause_at_rest_changes_nothing(bench, driver):
    bench.run(0.5)
    bench.clock.advance(60.0)
    bench.run(0.2)
    assert driver.status().position_known
    assert driver.status().fault is None


class ReversedStage(EmulatedStage):
    """A stage that counts against its direction of motion."""

    def _report_if_requested(self):
        position = self._blocks.position
        self._blocks.position = [2.0 * -49.0 - position[0], *position[1:]]
        super()._report_if_requested()
        self._blocks.position = position


def test_the_first_move_ends_after_a_millimetre_if_the_reading_is_reversed(make_bench):
    bench = make_bench(stage=ReversedStage)
    driver = bench.open_and_home()
    driver.move_to({"x": 0.04})
    bench.run(3.0)
    status = driver.status()
    assert "axis x reads -49." in status.fault
    assert "check the direction" in status.fault
    assert "x" in status.unhomed
    assert bench.stage.true_positions[0] <= 2.0 + 1e-3  # homed at 1 mm


def test_an_axis_that_does_not_follow_its_first_move_is_a_fault(bench, driver):
    bench.port.alter = lambda data: re.sub(rb"MPos:-[\d.]+", b"MPos:-49.000", data)
    driver.move_to({"x": 0.04})
    bench.run(3.0)
    assert "axis x is at -49.000 instead of -10.000" in driver.status().fault
    assert bench.stage.true_positions[0] <= 2.0 + 1e-3


def test_a_stop_also_drops_a_line_that_waits_in_the_controller(make_bench):
    class SlowStage(EmulatedStage):
        """A stage that can be set to take no lines. A waiting jog begins after a hold."""

        is_taking_lines = True

        def _execute_next_line(self):
            if self.is_taking_lines:
                super()._execute_next_line()

    bench = make_bench(stage=SlowStage)
    driver = bench.open_and_home()
    bench.stage.is_taking_lines = False
    driver.move_to({"x": 0.045})
    bench.run(0.05)
    driver.stop()
    bench.stage.is_taking_lines = True
    bench.run(0.5)
    assert bench.stage.true_positions[0] < 1.1  # homed at 1 mm


@pytest.mark.parametrize("delay_s", [0.025, 0.3])
def test_a_slow_line_works_and_its_samples_have_correct_times(make_bench, delay_s):
    bench = make_bench(line={"delay_s": delay_s})
    driver = bench.open_and_home()
    driver.move_to({"x": 0.02}, {"x": 0.005})
    began_s = driver._controller._opened_s
    true_positions = []
    for _ in range(400):
        bench.clock.advance(0.01)
        samples = driver.read()
        true_positions.append((bench.clock() - began_s, bench.stage.true_positions[0] * 1e-3))
        for time_s, position in zip(samples.device_time_s, samples.measured[:, 0], strict=True):
            earlier_positions = [
                value for true_time_s, value in true_positions if true_time_s <= time_s + 1e-9
            ]
            if earlier_positions:
                assert (
                    abs(position - earlier_positions[-1])
                    <= 0.005 * (driver.stamp_error_s + 0.01) + 2e-6
                )
        assert driver.status().silent_s == 0.0
    bench.wait_for_rest()
    assert bench.stage.true_positions[0] == pytest.approx(20.0, abs=1e-3)
    assert driver.stamp_error_s >= delay_s * 0.9
    driver.stop()
    bench.wait_for_rest()
    assert driver.status().position_known


def test_a_line_that_is_too_slow_is_refused_with_its_round_trip_time(make_bench):
    bench = make_bench(line={"delay_s": 0.6})
    with pytest.raises(Exception, match=r"an answer takes 1\.2\d? s, but at most 1 s is allowed"):
        bench.driver.open()


def test_a_line_that_could_leave_a_range_is_never_sent(bench, driver):
    first_byte = len(bench.port.written)
    for line in (
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
    ):
        with pytest.raises(LimitError, match="was not sent"):
            driver._controller.dialogue.send_line(line)
    assert bench.lines_sent(first_byte) == []


def test_a_guard_permits_lines_within_the_range():
    guard = JogGuard()
    guard.permit_ranges({"X": (-50.0, 0.0)})
    for line in ("$J=G53 G21 G90 X-50.0000 F600.000", "$H", "$HX", "$$", "$/axes/x/homing/mpos_mm"):
        guard.check(line)
