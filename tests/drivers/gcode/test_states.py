"""State words of controllers: each has a meaning, and an unknown one locks motion."""

import pytest

from rotemina.drivers.errors import StateError
from rotemina.drivers.gcode.emulator import EmulatedStage
from rotemina.drivers.gcode.error_texts import Firmware, describe_alarm, describe_error
from rotemina.drivers.gcode.grbl_reports import Status, parse_report
from rotemina.drivers.gcode.machine_states import interpret_state
from rotemina.drivers.samples import DeviceState


class Worded(EmulatedStage):
    """Reports another state word while it has one."""

    word = None

    def _report_if_asked(self):
        state, self._state = self._state, self.word or self._state
        super()._report_if_asked()
        self._state = state


@pytest.mark.parametrize(
    ("word", "moving", "may_move", "lost"),
    [
        ("Idle", False, True, False),
        ("Run", True, True, False),
        ("Run:2", True, True, False),
        ("Jog", True, True, False),
        ("Home", True, True, False),
        ("Hold:0", False, False, False),
        ("Hold:1", True, False, False),
        ("Hold", True, False, False),
        ("Door:0", False, False, False),
        ("Door:1", False, False, False),
        ("Door:2", True, False, False),
        ("Door:3", True, False, False),
        ("Door:4", True, False, False),
        ("Door", True, False, False),
        ("Alarm", False, False, True),
        ("Alarm:9", False, False, True),
        ("Check", False, False, False),
        ("Sleep", False, False, True),
        ("Tool", False, False, False),
        ("Starting", False, False, True),
        ("Parking", True, False, False),
        ("", True, False, False),
    ],
)
def test_each_word_says_whether_axes_move_and_whether_they_may(word, moving, may_move, lost):
    status = parse_report(f"<{word}|MPos:0.000,0.000,0.000|FS:0,0>")
    assert isinstance(status, Status)
    state = interpret_state(status)
    assert (state.moving, state.fault is None, state.position_lost) == (moving, may_move, lost)


def test_a_door_that_opens_in_mid_move_is_a_fault_and_keeps_the_position(joined):
    bench = joined()
    driver = bench.homed()
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
    bench.rest()
    assert driver.status().fault is None
    assert driver.status().position_known
    assert bench.stage.events == []
    held = bench.stage.true[0]
    bench.run(1.0)
    assert bench.stage.true[0] == held
    driver.move_to({"x": 0.02})
    bench.rest()
    assert bench.stage.true[0] == pytest.approx(20.0, abs=1e-3)


def test_a_stop_while_the_door_is_open_does_not_reset_before_the_axes_rest(joined):
    bench = joined()
    driver = bench.homed()
    driver.move_to({"x": 0.04})
    bench.run(1.0)
    bench.stage.open_door()
    driver.stop()
    bench.run(1.0)
    assert bench.stage.events == []
    assert driver.status().position_known


def test_a_controller_that_sleeps_has_lost_its_position(joined):
    bench = joined()
    driver = bench.homed()
    bench.stage.receive(b"$SLP\n", bench.clock() - bench.began_s)
    bench.run(0.3)
    status = driver.status()
    assert "sleeps" in status.fault
    assert status.unhomed == ("x", "y", "z")
    driver.clear_fault()
    bench.rest()
    driver.home(driver.homing_axes)
    bench.rest()
    assert driver.status().position_known


@pytest.mark.parametrize("word", ["Tool", "Check", "Parking"])
def test_a_state_in_which_nothing_may_move_is_named_and_stops_a_move(joined, word):
    bench = joined(stage=Worded)
    driver = bench.homed()
    driver.move_to({"x": 0.045})
    bench.run(0.5)
    bench.stage.word = word
    bench.run(2.0)
    fault = driver.status().fault
    assert {"Tool": "tool change", "Check": "only checks", "Parking": "'Parking'"}[word] in fault
    assert bench.stage.true[0] < 20.0
    driver.clear_fault()  # the count stands still, so it may be reset
    bench.stage.word = None
    bench.rest()
    assert driver.status().fault is None


def test_an_alarm_that_nobody_announced_is_a_fault_that_wants_homing(joined):
    bench = joined(stage=Worded)
    driver = bench.homed()
    bench.stage.word = "Alarm"
    bench.run(0.2)
    status = driver.status()
    assert "locked by an alarm" in status.fault
    assert not status.position_known


def test_a_pause_by_a_button_of_the_controller_is_a_fault(joined):
    bench = joined()
    driver = bench.homed()
    bench.stage.receive(b"!", bench.clock() - bench.began_s)
    bench.run(0.2)
    assert "was paused (feed hold)" in driver.status().fault
    driver.clear_fault()
    bench.rest()
    assert driver.status().position_known


@pytest.mark.parametrize("stopped", [False, True])
def test_a_controller_is_left_idle_with_its_settings_as_they_were(joined, stopped):
    bench = joined()
    before = dict(bench.stage.settings)
    driver = bench.homed()
    driver.move_to({"x": 0.045})
    bench.run(0.5)
    if stopped:
        driver.stop()
    driver.close()
    assert bench.stage.state == "Idle"
    assert bench.stage.settings == before
    reply = bench.stage.advance(bench.clock() - bench.began_s)
    bench.stage.receive(b"$G\n", bench.clock() - bench.began_s)
    bench.clock.advance(0.1)
    reply = bench.stage.advance(bench.clock() - bench.began_s)
    assert reply  # the next program gets an answer


def test_a_controller_that_homes_is_reset_when_it_is_left(joined):
    bench = joined()
    bench.driver.open()
    bench.driver.home(("y",))
    bench.run(0.5)
    bench.driver.close()
    at = list(bench.stage.true)
    bench.clock.advance(2.0)
    bench.stage.advance(bench.clock() - bench.began_s)
    assert bench.stage.true == at


def test_a_controller_that_an_alarm_has_locked_can_be_left(joined):
    bench = joined()
    driver = bench.homed()
    bench.stage.hit_limit()
    bench.run(0.2)
    began_s = bench.clock()
    driver.close()
    assert bench.clock() == began_s


@pytest.mark.parametrize(
    ("describe", "numbers"),
    [
        (describe_error, {Firmware.GRBL: [*range(1, 18), *range(20, 39)]}),
        (
            describe_error,
            {Firmware.GRBL_HAL: [*range(1, 59), *range(60, 67), *range(70, 93), 253]},
        ),
        (
            describe_error,
            {
                Firmware.FLUID_NC: [
                    *range(1, 41), *range(60, 71), *range(80, 84), 90, 100, 101, *range(110, 115),
                    120, 130, *range(150, 153), *range(160, 163), *range(170, 182),
                ]
            },
        ),
        (describe_alarm, {Firmware.GRBL: range(1, 11)}),
        (describe_alarm, {Firmware.GRBL_HAL: range(1, 23)}),
        (describe_alarm, {Firmware.FLUID_NC: range(1, 19)}),
    ],
)  # fmt: skip
def test_every_documented_number_is_explained(describe, numbers):
    for firmware, known in numbers.items():
        for number in known:
            assert "does not document" not in describe(number, firmware), number
        assert "does not document" in describe(999, firmware)


def test_the_firmware_decides_what_a_number_means(joined):
    class Hal(EmulatedStage):
        def _tell_or_set(self, text):
            if text == "I":
                self._say("[FIRMWARE:grblHAL]")
            super()._tell_or_set(text)

    bench = joined(stage=Hal)
    driver = bench.homed()
    bench.stage._alarm(10)
    bench.run(0.1)
    assert "ALARM:10, its emergency stop is pressed" in driver.status().fault
