"""The driver of a G-code stage: stops, alarms, homing, and the controllers that it refuses."""

import pytest

from rotemina.drivers.contract import (
    ConnectionLostError,
    DeviceState,
    DriverError,
    DriverSettingError,
    DriverTimeoutError,
    LimitError,
    StateError,
)
from rotemina.drivers.gcode.driver import GcodeStage
from rotemina.sim.errors import InputError
from rotemina.sim.robot_files import load_robot


def test_an_opened_stage_is_idle_and_unhomed_until_it_is_homed(make_bench):
    bench = make_bench()
    bench.driver.open()
    status = bench.driver.status()
    assert (status.state, status.unhomed) == (DeviceState.IDLE, ("x", "y", "z"))
    with pytest.raises(StateError, match="home first"):
        bench.driver.move_to({"x": 0.01})
    bench.driver.home(("x", "y", "z"))
    assert bench.driver.status().state is DeviceState.HOMING
    bench.wait_for_rest()
    assert bench.driver.status().position_known
    # The axes are at their low switches, plus the pull-off distance.
    assert bench.read_position() == pytest.approx([1e-3, 1e-3, 1e-3], abs=1e-9)
    assert bench.stage.true_positions == pytest.approx([1.0, 1.0, 1.0], abs=1e-6)


def test_a_move_is_straight_at_the_given_speed_and_ends_at_its_target(bench, driver):
    driver.move_to({"x": 0.021, "y": 0.006}, {"x": 0.004})
    samples = bench.wait_for_rest()
    assert bench.read_position() == pytest.approx([0.021, 0.006, 0.001], abs=1e-9)
    assert bench.stage.true_positions == pytest.approx([21.0, 6.0, 1.0], abs=1e-4)
    x, y, _ = samples.command.T
    assert (y - 0.001) == pytest.approx((x - 0.001) / 4.0, abs=2e-6)
    is_between = (x > 0.0011) & (x < 0.0209)
    duration_s = samples.device_time_s[is_between][-1] - samples.device_time_s[is_between][0]
    assert duration_s == pytest.approx(0.0198 / 0.004, rel=0.02)


@pytest.mark.parametrize("after_s", [0.02, 1.0])
def test_a_stopped_move_never_resumes(bench, driver, after_s):
    driver.move_to({"x": 0.045})
    bench.run(after_s)
    driver.stop()
    assert bench.port.written.endswith(b"!")
    bench.wait_for_rest()
    assert bench.port.written.rstrip(b"?").endswith(b"\x18")
    assert not driver.stop_pending
    assert driver.status().position_known
    held_position = bench.read_position()
    # Another program sends a resume command.
    bench.send_to_stage(b"~")
    bench.run(2.0)
    assert (bench.read_position() == held_position).all()
    driver.move_to({"x": 0.02})
    bench.wait_for_rest()
    assert bench.stage.true_positions[0] == pytest.approx(20.0, abs=1e-4)


def test_a_stop_while_homing_resets_at_once_and_the_position_stays_unknown(make_bench):
    bench = make_bench()
    bench.driver.open()
    bench.driver.home(("y",))
    bench.run(0.5)
    bench.driver.stop()
    assert bench.port.written.endswith(b"\x18")
    positions = list(bench.stage.true_positions)
    bench.wait_for_rest()
    assert bench.stage.true_positions == positions
    assert bench.stage.events == ["ALARM:6"]
    status = bench.driver.status()
    assert (status.state, status.fault) == (DeviceState.IDLE, None)
    assert "y" in status.unhomed
    bench.home()


def test_a_stop_drops_a_target_that_waits_for_braking(bench, driver):
    driver.move_to({"x": 0.045})
    bench.run(0.5)
    # The axis has to brake before it can turn back.
    driver.move_to({"x": 0.002})
    driver.stop()
    bench.wait_for_rest()
    held_position = bench.read_position()[0]
    assert 0.003 < held_position < 0.01
    bench.run(1.0)
    assert bench.read_position()[0] == held_position


def test_a_cut_line_ends_a_move_within_the_lines_already_sent(bench, driver):
    driver.move_to({"x": 0.045})
    bench.run(1.0)
    bench.set_cut(True)
    start_mm = bench.stage.true_positions[0]
    bench.advance_stage(5.0)
    assert bench.stage.state == "Idle"
    # At 10 mm/s: 0.25 s, a segment of 0.1 s, and the age of the last report. Then it brakes.
    assert bench.stage.true_positions[0] - start_mm < 10.0 * (0.25 + 0.1 + 0.05) + 10.0**2 / (
        2.0 * 200.0
    )


def test_a_hard_limit_is_a_fault_that_requires_homing(bench, driver):
    driver.move_to({"x": 0.045})
    bench.run(0.5)
    bench.stage.hit_limit()
    # During such an alarm the controller does not answer, which does not mean a lost line.
    bench.run(3.0)
    status = driver.status()
    assert status.state is DeviceState.FAULT
    assert "ALARM:1, hard limit" in status.fault
    driver.clear_fault()
    bench.wait_for_rest()
    status = driver.status()
    assert (status.state, status.position_known) == (DeviceState.IDLE, False)
    bench.home()


def test_a_missing_limit_switch_is_a_fault(make_bench):
    bench = make_bench(missing_switch="Z")
    bench.driver.open()
    bench.driver.home(("z",))
    bench.wait_for_rest()
    status = bench.driver.status()
    assert status.state is DeviceState.FAULT
    assert "ALARM:9, homing: the limit switch was not found" in status.fault


def test_a_power_loss_of_the_controller_is_a_fault_and_loses_the_position(bench, driver):
    driver.move_to({"x": 0.045})
    bench.run(0.5)
    bench.stage.cut_power()
    bench.run(0.2)
    status = driver.status()
    assert status.state is DeviceState.FAULT
    assert "lost power" in status.fault
    assert status.unhomed == ("x", "y", "z")


def test_a_rejected_line_is_a_fault_with_its_reason(bench, driver):
    # Another program has changed the travel of the controller.
    bench.stage.settings[130] = 10.0
    driver.move_to({"x": 0.045})
    bench.run(1.0)
    bench.wait_for_rest()
    assert "error:15, the target lies beyond the travel" in driver.status().fault
    driver.clear_fault()
    bench.run(0.2)
    assert driver.status().state is DeviceState.IDLE


def test_a_line_without_an_answer_stops_the_stage(bench, driver):
    bench.set_cut(True)
    driver.move_to({"x": 0.045})
    bench.set_cut(False)
    bench.run(2.0)
    assert "no answer to '$J=" in driver.status().fault
    assert bench.stage.state == "Idle"
    assert bench.stage.true_positions[0] == 1.0


def test_opening_clears_a_queue_left_by_another_program(make_bench):
    bench = make_bench()
    bench.stage.receive(b"$X\nG21 G90\nG1 X-20 F300\nG1 X-40\n", 0.01)
    bench.stage.advance(1.0)
    assert bench.stage.state == "Run"
    bench.clock.advance(1.0)
    bench.driver.open()
    positions = bench.stage.true_positions
    bench.run(1.0)
    assert bench.stage.true_positions == positions
    assert bench.stage.state == "Idle"
    assert not bench.driver.status().position_known


def test_a_position_is_trusted_only_with_the_setting(bench):
    bench.driver.close()
    bench.driver.open()
    assert not bench.driver.status().position_known
    bench.driver.close()
    trusting_driver = bench.make({"trust_position": True}, bench._open_port)
    trusting_driver.open()
    assert trusting_driver.status().position_known
    assert trusting_driver.descriptions[0].resolution == 1e-6


def test_a_controller_without_single_homing_homes_all_axes_or_none(make_bench):
    bench = make_bench(single_homing=False)
    bench.driver.open()
    with pytest.raises(LimitError, match="homes all axes together"):
        bench.driver.home(("x",))
    bench.home()


def test_a_removed_port_is_a_lost_connection_and_stop_does_not_raise(bench):
    bench.port.is_removed = True
    with pytest.raises(ConnectionLostError):
        bench.driver.read()
    bench.driver.stop()


@pytest.mark.parametrize(
    ("number", "value", "message"),
    [
        (120, 400.0, r"axis x: \$120 = 400\.000, the file has 200\.000 mm/s² \(\$120=200\.000\)"),
        (131, 40.0, r"axis y: \$131 = 40\.000, the file has 50\.000 mm \(\$131=50\.000\)"),
        (102, -1.0, r"axis z: the controller has no setting \$102"),
        (13, 1.0, r"the controller reports inches; send it \$13=0"),
    ],
)
def test_a_controller_that_contradicts_the_robot_file_is_refused(
    make_bench, number, value, message
):
    bench = make_bench()
    bench.stage.settings[number] = value
    with pytest.raises(DriverError, match=message):
        bench.driver.open()
    assert bench.driver.status().state is DeviceState.CLOSED


def test_a_controller_that_does_not_answer_is_reported(make_bench):
    bench = make_bench()
    open_port = bench._open_port

    def open_cut_port(url, baud):
        port = open_port(url, baud)
        port.is_cut = True
        return port

    bench.driver._open_port = open_cut_port
    with pytest.raises(DriverTimeoutError, match="nothing arrived; check the controller's power"):
        bench.driver.open()


def test_unsuitable_robots_and_settings_are_refused():
    with pytest.raises(InputError, match="axis thx is moved by a piezo"):
        GcodeStage(load_robot("rotemina"))
    with pytest.raises(InputError, match="has 3 axes; the letters 'XY' name 2"):
        GcodeStage(load_robot("xyz"), {"letters": "XY"})
    for settings in ({"letters": "XXY"}, {"poll_s": 1.0}, {"homing_s": 0.0}, {"baud": 1}):
        with pytest.raises(DriverSettingError, match=next(iter(settings))):
            GcodeStage(load_robot("xyz"), settings)
