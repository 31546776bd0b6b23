"""Each state word of a controller has a meaning, and an unknown word locks motion."""

import pytest

from rotemina.drivers.contract import DeviceState, StateError
from rotemina.drivers.gcode import EmulatedStage
from rotemina.drivers.gcode.error_texts import ControllerFirmware, describe_alarm, describe_error
from rotemina.drivers.gcode.grbl_reports import StatusReport, parse_report
from rotemina.drivers.gcode.machine_states import interpret_state


class OtherStateStage(EmulatedStage):
    """A stage that reports ``word`` as its state, if it is set."""

    word = None

    def _report_if_requested(self):
        state, self._state = self._state, self.word or self._state
        super()._report_if_requested()
        self._state = state


# For each state word: whether axes move, whether they may move, and whether the position is lost.
STATES = {
    "Idle": (False, True, False),
    "Run": (True, True, False),
    "Run:2": (True, True, False),
    "Jog": (True, True, False),
    "Home": (True, True, False),
    "Hold:0": (False, False, False),
    "Hold:1": (True, False, False),
    "Hold": (True, False, False),
    "Door:0": (False, False, False),
    "Door:1": (False, False, False),
    "Door:2": (True, False, False),
    "Door": (True, False, False),
    "Alarm": (False, False, True),
    "Alarm:9": (False, False, True),
    "Check": (False, False, False),
    "Sleep": (False, False, True),
    "Tool": (False, False, False),
    "Starting": (False, False, True),
    "Parking": (True, False, False),
    "": (True, False, False),
}


def test_each_word_says_whether_axes_move_and_whether_they_may_move():
    for word, expected in STATES.items():
        status = parse_report(f"<{word}|MPos:0.000,0.000,0.000|FS:0,0>")
        assert isinstance(status, StatusReport)
        state = interpret_state(status)
        assert (state.is_moving, state.fault is None, state.position_lost) == expected, word


def test_a_door_that_opens_during_a_move_is_a_fault_and_keeps_the_position(bench, driver):
    driver.move_to({"x": 0.04})
    bench.run(1.0)
    bench.stage.open_door()
    while driver.status().fault is None:
        bench.run(0.005, 0.005)
    with pytest.raises(StateError, match="still braking"):
        driver.clear_fault()
    bench.run(0.5)
    status = driver.status()
    assert status.state is DeviceState.FAULT
    assert "the safety door is open" in status.fault
    driver.clear_fault()
    bench.run(0.5)
    assert "the safety door is open" in driver.status().fault
    bench.stage.close_door()
    driver.clear_fault()
    bench.wait_for_rest()
    assert driver.status().fault is None
    assert driver.status().position_known
    assert bench.stage.events == []
    held_position = bench.stage.true_positions[0]
    bench.run(1.0)
    assert bench.stage.true_positions[0] == held_position
    driver.move_to({"x": 0.02})
    bench.wait_for_rest()
    assert bench.stage.true_positions[0] == pytest.approx(20.0, abs=1e-3)


def test_a_stop_while_the_door_is_open_does_not_reset_before_the_axes_rest(bench, driver):
    driver.move_to({"x": 0.04})
    bench.run(1.0)
    bench.stage.open_door()
    driver.stop()
    bench.run(1.0)
    assert bench.stage.events == []
    assert driver.status().position_known


def test_a_sleeping_controller_has_lost_its_position(bench, driver):
    bench.send_to_stage(b"$SLP\n")
    bench.run(0.3)
    status = driver.status()
    assert "sleeps" in status.fault
    assert status.unhomed == ("x", "y", "z")
    driver.clear_fault()
    bench.wait_for_rest()
    bench.home()


@pytest.mark.parametrize(("word", "fault"), [("Tool", "tool change"), ("Parking", "'Parking'")])
def test_a_state_without_motion_is_reported_and_stops_a_move(make_bench, word, fault):
    bench = make_bench(stage=OtherStateStage)
    driver = bench.open_and_home()
    driver.move_to({"x": 0.045})
    bench.run(0.5)
    bench.stage.word = word
    bench.run(2.0)
    assert fault in driver.status().fault
    assert bench.stage.true_positions[0] < 20.0
    # The count does not change, so the controller may be reset.
    driver.clear_fault()
    bench.stage.word = None
    bench.wait_for_rest()
    assert driver.status().fault is None


def test_an_unannounced_alarm_is_a_fault_that_requires_homing(make_bench):
    bench = make_bench(stage=OtherStateStage)
    driver = bench.open_and_home()
    bench.stage.word = "Alarm"
    bench.run(0.2)
    status = driver.status()
    assert "locked by an alarm" in status.fault
    assert not status.position_known


def test_a_pause_by_a_button_on_the_controller_is_a_fault(bench, driver):
    bench.send_to_stage(b"!")
    bench.run(0.2)
    assert "was paused (feed hold)" in driver.status().fault
    driver.clear_fault()
    bench.wait_for_rest()
    assert driver.status().position_known


@pytest.mark.parametrize("with_stop", [False, True])
def test_closing_during_a_move_stops_it_and_leaves_an_idle_controller(make_bench, with_stop):
    bench = make_bench()
    settings_before = dict(bench.stage.settings)
    driver = bench.open_and_home()
    driver.move_to({"x": 0.045})
    bench.run(0.5)
    if with_stop:
        driver.stop()
    driver.close()
    position_mm = bench.stage.true_positions[0]
    assert bench.stage.state == "Idle"
    assert bench.stage.settings == settings_before
    bench.advance_stage(2.0)
    assert bench.stage.true_positions[0] == position_mm < 10.0
    # The next program gets an answer.
    bench.send_to_stage(b"$G\n")
    assert bench.advance_stage(0.1)


def test_closing_resets_a_homing_controller(make_bench):
    bench = make_bench()
    bench.driver.open()
    bench.driver.home(("y",))
    bench.run(0.5)
    bench.driver.close()
    positions = list(bench.stage.true_positions)
    bench.advance_stage(2.0)
    assert bench.stage.true_positions == positions


def test_a_controller_locked_by_an_alarm_can_be_closed(bench, driver):
    bench.stage.hit_limit()
    bench.run(0.2)
    began_s = bench.clock()
    driver.close()
    assert bench.clock() == began_s


def test_every_documented_number_is_explained():
    grbl, hal, fluid = (
        ControllerFirmware.GRBL,
        ControllerFirmware.GRBL_HAL,
        ControllerFirmware.FLUID_NC,
    )
    for describe, firmware, numbers in (
        (describe_error, grbl, [*range(1, 18), *range(20, 39)]),
        (describe_error, hal, [*range(1, 59), *range(60, 67), *range(70, 93), 253]),
        (
            describe_error,
            fluid,
            [
                *range(1, 41),
                *range(60, 71),
                *range(80, 84),
                90,
                100,
                101,
                *range(110, 115),
                120,
                130,
                *range(150, 153),
                *range(160, 163),
                *range(170, 182),
            ],
        ),
        (describe_alarm, grbl, range(1, 11)),
        (describe_alarm, hal, range(1, 23)),
        (describe_alarm, fluid, range(1, 19)),
    ):
        for number in numbers:
            assert "does not document" not in describe(number, firmware), (firmware, number)
        assert "does not document" in describe(999, firmware)


def test_the_firmware_decides_the_meaning_of_an_alarm_number(make_bench):
    class GrblHalStage(EmulatedStage):
        def _report_or_set(self, text):
            if text == "I":
                self._send("[FIRMWARE:grblHAL]")
            super()._report_or_set(text)

    bench = make_bench(stage=GrblHalStage)
    driver = bench.open_and_home()
    bench.stage._raise_alarm(10)
    bench.run(0.1)
    assert "ALARM:10, the emergency stop is pressed" in driver.status().fault
