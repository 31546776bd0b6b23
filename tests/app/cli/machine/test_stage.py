"""``rotemina stage`` as users run it: a separate process with a driver at its port."""

import os
import signal
import subprocess
import sys
import time

import pytest

from rotemina.drivers.contract import DeviceState
from rotemina.drivers.gcode.driver import GcodeStage
from rotemina.sim.robot_files import load_robot, read_robot_file

pytestmark = pytest.mark.skipif(os.name != "posix", reason="needs POSIX pseudo-terminals")
PATIENCE_S = 60.0  # generous, for a loaded machine


def read_until(driver, condition):
    """Read from the driver until a condition holds."""
    end_s = time.monotonic() + PATIENCE_S
    driver.read()
    while not condition():
        assert time.monotonic() < end_s, driver.status()
        time.sleep(driver.service_period_s)
        driver.read()


def read_command(driver):
    """Return the commanded positions in the next sample."""
    samples, end_s = driver.read(), time.monotonic() + PATIENCE_S
    while not len(samples):
        assert time.monotonic() < end_s, driver.status()
        time.sleep(driver.service_period_s)
        samples = driver.read()
    return samples.command[-1]


def test_driver_homes_moves_stops_and_sees_a_fault_over_the_port(tmp_path):
    port, robot_file = tmp_path / "stage", tmp_path / "small.toml"
    text = read_robot_file("xyz")
    robot_file.write_text(text.replace("0.050]", "0.004]").replace("0.030]", "0.004]"), "utf-8")
    with subprocess.Popen(
        [
            sys.executable, "-m", "rotemina.app.cli.main", "stage",
            "--robot", str(robot_file), "--port", str(port),
        ],
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    ) as process:  # fmt: skip
        try:
            assert process.stdout.readline().startswith(f"listening on {port} (/dev/")
            driver = GcodeStage(load_robot(str(robot_file)), {"port": str(port)})
            driver.open()
            driver.home(("z",))
            read_until(driver, lambda: "z" not in driver.status().unhomed)
            driver.home(("x", "y"))
            read_until(driver, lambda: driver.status().position_known)
            driver.move_to({"x": 0.0025})
            read_until(driver, lambda: driver.status().state is DeviceState.IDLE)
            assert read_command(driver) == pytest.approx([0.0025, 0.001, 0.001], abs=1e-9)
            driver.move_to({"x": 0.004})
            driver.stop()
            read_until(driver, lambda: not driver.stop_pending)
            assert read_command(driver)[0] < 0.0035
            process.stdin.write("nonsense\nlimit\n")
            process.stdin.flush()
            read_until(driver, lambda: driver.status().state is DeviceState.FAULT)
            assert "hard limit" in driver.status().fault
            driver.close()
            process.send_signal(signal.SIGTERM)
            assert process.wait(PATIENCE_S) == 0
            assert "'nonsense': must be one of limit, power" in process.stderr.read()
        finally:
            process.kill()
    assert not port.is_symlink()


def test_robot_with_piezo_axes_is_refused(get_refusal):
    assert "axis thx is moved by a piezo" in get_refusal("stage --robot rotemina")
