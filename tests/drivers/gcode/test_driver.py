"""The driver of a G-code stage: stops, alarms, homing, and what it refuses to be connected to."""

import pytest

from rotemina.drivers.errors import (
    ConnectionLostError,
    DriverError,
    DriverTimeoutError,
    LimitError,
    StateError,
)
from rotemina.drivers.gate import GateError
from rotemina.drivers.gcode.driver import GcodeStage
from rotemina.drivers.samples import DeviceState
from rotemina.drivers.settings import SettingError
from rotemina.sim.errors import InputError
from rotemina.sim.robot.file import load_robot


def test_opened_it_is_at_rest_and_its_position_is_unknown_until_it_is_homed(joined):
    bench = joined()
    bench.driver.open()
    status = bench.driver.status()
    assert (status.state, status.unhomed) == (DeviceState.IDLE, ("x", "y", "z"))
    with pytest.raises(StateError, match="home first"):
        bench.driver.move_to({"x": 0.01})
    bench.driver.home(("x", "y", "z"))
    assert bench.driver.status().state is DeviceState.HOMING
    bench.rest()
    assert bench.driver.status().position_known
    # The low switches, and the way that the controller pulls off them.
    assert bench.at() == pytest.approx([1e-3, 1e-3, 1e-3], abs=1e-9)
    assert bench.stage.true == pytest.approx([1.0, 1.0, 1.0], abs=1e-6)


def test_a_way_is_straight_as_fast_as_it_may_be_and_arrives_where_the_axes_truly_are(joined):
    bench = joined()
    driver = bench.homed()
    driver.move_to({"x": 0.021, "y": 0.006}, {"x": 0.004})
    samples = bench.rest()
    assert bench.at() == pytest.approx([0.021, 0.006, 0.001], abs=1e-9)
    assert bench.stage.true == pytest.approx([21.0, 6.0, 1.0], abs=1e-4)
    x, y, _ = samples.command.T
    assert (y - 0.001) == pytest.approx((x - 0.001) / 4.0, abs=2e-6)
    seconds = (x > 0.0011) & (x < 0.0209)
    took_s = samples.device_time_s[seconds][-1] - samples.device_time_s[seconds][0]
    assert took_s == pytest.approx(0.0198 / 0.004, rel=0.02)


@pytest.mark.parametrize("after_s", [0.02, 0.35, 1.0])
def test_what_a_stop_has_held_never_goes_on(joined, after_s):
    bench = joined()
    driver = bench.homed()
    driver.move_to({"x": 0.045})
    bench.run(after_s)
    driver.stop()
    assert bench.port.written.endswith(b"!")
    bench.rest()
    assert bench.port.written.rstrip(b"?").endswith(b"\x18")
    assert not driver.stop_pending
    assert driver.status().position_known
    held = bench.at()
    bench.stage.receive(b"~", bench.clock() - bench.began_s)  # resume, by whomever
    bench.run(2.0)
    assert (bench.at() == held).all()
    driver.move_to({"x": 0.02})
    bench.rest()
    assert bench.stage.true[0] == pytest.approx(20.0, abs=1e-4)


def test_a_stop_while_it_homes_resets_at_once_and_the_position_stays_unknown(joined):
    bench = joined()
    bench.driver.open()
    bench.driver.home(("y",))
    bench.run(0.5)
    bench.driver.stop()
    assert bench.port.written.endswith(b"\x18")
    at = list(bench.stage.true)
    bench.rest()
    assert bench.stage.true == at
    assert bench.stage.events == ["ALARM:6"]
    status = bench.driver.status()
    assert (status.state, status.fault) == (DeviceState.IDLE, None)
    assert "y" in status.unhomed
    bench.driver.home(("x", "y", "z"))
    bench.rest()
    assert bench.driver.status().position_known


def test_a_target_that_waits_for_a_new_way_is_dropped_by_a_stop(joined):
    bench = joined()
    driver = bench.homed()
    driver.move_to({"x": 0.045})
    bench.run(0.5)
    driver.move_to({"x": 0.002})  # it has to brake first
    driver.stop()
    bench.rest()
    held = bench.at()[0]
    assert 0.003 < held < 0.01
    bench.run(1.0)
    assert bench.at()[0] == held


def test_a_line_that_is_torn_ends_a_way_within_what_was_told(joined):
    bench = joined()
    driver = bench.homed()
    driver.move_to({"x": 0.045})
    bench.run(1.0)
    bench.cut(True)
    at = bench.stage.true[0]
    bench.clock.advance(5.0)
    bench.stage.advance(bench.clock() - bench.began_s)
    assert bench.stage.state == "Idle"
    # 0.25 s, a piece of 0.1 s, and the latest report's age, at 10 mm/s; and its braking.
    assert bench.stage.true[0] - at < 10.0 * (0.25 + 0.1 + 0.05) + 10.0**2 / (2.0 * 200.0)


def test_a_hard_limit_is_a_fault_that_wants_homing(joined):
    bench = joined()
    driver = bench.homed()
    driver.move_to({"x": 0.045})
    bench.run(0.5)
    bench.stage.hit_limit()
    bench.run(3.0)  # in such an alarm it answers nothing, which is no lost line
    status = driver.status()
    assert status.state is DeviceState.FAULT
    assert "ALARM:1, hard limit" in status.fault
    driver.clear_fault()
    bench.rest()
    status = driver.status()
    assert (status.state, status.position_known) == (DeviceState.IDLE, False)
    driver.home(driver.homing_axes)
    bench.rest()
    assert driver.status().position_known


def test_a_switch_that_is_not_found_is_a_fault(joined):
    bench = joined(missing_switch="Z")
    bench.driver.open()
    bench.driver.home(("z",))
    bench.rest()
    status = bench.driver.status()
    assert status.state is DeviceState.FAULT
    assert "ALARM:9, homing: the limit switch was not found" in status.fault


def test_a_controller_that_loses_its_supply_is_a_fault_and_its_position_is_lost(joined):
    bench = joined()
    driver = bench.homed()
    driver.move_to({"x": 0.045})
    bench.run(0.5)
    bench.stage.cut_power()
    bench.run(0.2)
    status = driver.status()
    assert status.state is DeviceState.FAULT
    assert "lost its supply" in status.fault
    assert status.unhomed == ("x", "y", "z")


def test_a_line_that_is_refused_is_a_fault_with_its_reason(joined):
    bench = joined()
    driver = bench.homed()
    bench.stage.settings[130] = 10.0  # somebody changed its travel
    driver.move_to({"x": 0.045})
    bench.run(1.0)
    bench.rest()
    assert "error:15, the target lies beyond the travel" in driver.status().fault
    driver.clear_fault()
    bench.run(0.2)
    assert driver.status().state is DeviceState.IDLE


def test_a_line_that_is_not_answered_halts(joined):
    bench = joined()
    driver = bench.homed()
    bench.cut(True)
    driver.move_to({"x": 0.045})
    bench.cut(False)
    bench.run(2.0)
    assert "no answer to '$J=" in driver.status().fault
    assert bench.stage.state == "Idle"
    assert bench.stage.true[0] == 1.0


def test_opening_ends_what_others_have_left_in_the_queue(joined):
    bench = joined()
    bench.stage.receive(b"$X\nG21 G90\nG1 X-20 F300\nG1 X-40\n", 0.01)
    bench.stage.advance(1.0)
    assert bench.stage.state == "Run"
    bench.clock.advance(1.0)
    bench.driver.open()
    at = bench.stage.true
    bench.run(1.0)
    assert bench.stage.true == at
    assert bench.stage.state == "Idle"
    assert not bench.driver.status().position_known


def test_closing_in_mid_move_halts_and_empties(joined):
    bench = joined()
    driver = bench.homed()
    driver.move_to({"x": 0.045})
    bench.run(0.5)
    driver.close()
    at = bench.stage.true[0]
    bench.clock.advance(2.0)
    bench.stage.advance(bench.clock() - bench.began_s)
    assert bench.stage.true[0] == at < 10.0
    assert bench.stage.state == "Idle"


def test_a_position_is_trusted_only_where_that_is_said(joined):
    bench = joined()
    bench.homed()
    bench.driver.close()
    bench.driver.open()
    assert not bench.driver.status().position_known
    bench.driver.close()
    trusting = bench.make({"trust_position": True})
    trusting.open()
    assert trusting.status().position_known
    assert trusting.descriptions[0].resolution == 1e-6


def test_a_controller_without_single_homing_homes_all_or_none(joined):
    bench = joined(single_homing=False)
    bench.driver.open()
    with pytest.raises(LimitError, match="homes all axes together"):
        bench.driver.home(("x",))
    bench.driver.home(("x", "y", "z"))
    bench.rest()
    assert bench.driver.status().position_known


def test_a_request_that_a_stop_has_overtaken_says_nothing(joined):
    bench = joined()
    driver = bench.homed()
    permit = driver.gate.permit()
    driver.stop()
    bench.rest()
    written = len(bench.port.written)
    with pytest.raises(GateError, match="a stop came"):
        driver.move_to({"x": 0.02}, permit=permit)
    assert len(bench.port.written) == written


def test_a_port_that_goes_is_a_lost_connection_and_stops_raise_nothing(joined):
    bench = joined()
    bench.homed()
    bench.port.gone = True
    with pytest.raises(ConnectionLostError):
        bench.driver.read()
    bench.driver.stop()


@pytest.mark.parametrize(
    ("number", "value", "words"),
    [
        (120, 400.0, r"axis x: \$120 = 400\.000, the file has 200\.000 mm/s² \(\$120=200\.000\)"),
        (120, 10.0, r"axis x: \$120 = 10\.000, the file has 200\.000 mm/s² \(\$120=200\.000\)"),
        (112, 60.0, r"axis z: \$112 = 60\.000, the file has 300\.000 mm/min \(\$112=300\.000\)"),
        (131, 40.0, r"axis y: \$131 = 40\.000, the file has 50\.000 mm \(\$131=50\.000\)"),
        (102, -1.0, r"axis z: the controller has no setting \$102"),
        (13, 1.0, r"it reports inches; send it \$13=0"),
    ],
)
def test_a_controller_that_does_not_agree_with_the_robot_file_is_refused(
    joined, number, value, words
):
    bench = joined()
    bench.stage.settings[number] = value
    with pytest.raises(DriverError, match=words):
        bench.driver.open()
    assert bench.driver.status().state is DeviceState.CLOSED


def test_what_does_not_answer_is_told(joined):
    bench = joined()
    opened = bench._opened

    def deaf(url, baud):
        port = opened(url, baud)
        port.cut = True
        return port

    bench.driver._open_port = deaf
    with pytest.raises(DriverTimeoutError, match="nothing arrived; check the controller's power"):
        bench.driver.open()


def test_robots_and_settings_that_do_not_fit_are_refused():
    with pytest.raises(InputError, match="axis thx is moved by a piezo"):
        GcodeStage(load_robot("rotemina"))
    with pytest.raises(InputError, match="has 3 axes; the letters 'XY' name 2"):
        GcodeStage(load_robot("xyz"), {"letters": "XY"})
    for settings in ({"letters": "XXY"}, {"poll_s": 1.0}, {"homing_s": 0.0}, {"baud": 1}):
        with pytest.raises(SettingError, match=next(iter(settings))):
            GcodeStage(load_robot("xyz"), settings)
