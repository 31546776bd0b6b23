"""``rotemina stage`` as its users meet it: a process of its own, and the driver at its port."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from rotemina.app.cli.main import main
from rotemina.drivers.gcode.driver import GcodeStage
from rotemina.drivers.samples import DeviceState
from rotemina.sim.robot.file import load_robot

pytestmark = pytest.mark.skipif(os.name != "posix", reason="pseudo-terminals are of POSIX")
PATIENCE_S = 60.0  # a machine under load may take its time; nothing waits so long that works


def until(driver, condition):
    """Serve the driver until a condition holds."""
    end_s = time.monotonic() + PATIENCE_S
    driver.read()
    while not condition():
        assert time.monotonic() < end_s, driver.status()
        time.sleep(driver.service_period_s)
        driver.read()


def command(driver):
    """Return where the axes are by the next sample."""
    samples, end_s = driver.read(), time.monotonic() + PATIENCE_S
    while not len(samples):
        assert time.monotonic() < end_s, driver.status()
        time.sleep(driver.service_period_s)
        samples = driver.read()
    return samples.command[-1]


def test_a_stage_is_homed_moved_stopped_and_faulty_over_its_port(tmp_path):
    port, small = tmp_path / "stage", tmp_path / "small.toml"
    text = (Path(__file__).parents[3] / "resources" / "robots" / "xyz.toml").read_text("utf-8")
    small.write_text(text.replace("0.050]", "0.004]").replace("0.030]", "0.004]"), "utf-8")
    with subprocess.Popen(
        [
            sys.executable, "-m", "rotemina.app.cli.main", "stage",
            "--robot", str(small), "--port", str(port),
        ],
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    ) as process:  # fmt: skip
        try:
            assert process.stdout.readline().startswith(f"listening on {port} (/dev/")
            driver = GcodeStage(load_robot(str(small)), {"port": str(port)})
            driver.open()
            driver.home(("z",))
            until(driver, lambda: "z" not in driver.status().unhomed)
            driver.home(("x", "y"))
            until(driver, lambda: driver.status().position_known)
            driver.move_to({"x": 0.0025})
            until(driver, lambda: driver.status().state is DeviceState.IDLE)
            assert command(driver) == pytest.approx([0.0025, 0.001, 0.001], abs=1e-9)
            driver.move_to({"x": 0.004})
            driver.stop()
            until(driver, lambda: not driver.stop_pending)
            assert command(driver)[0] < 0.0035
            process.stdin.write("nonsense\nlimit\n")
            process.stdin.flush()
            until(driver, lambda: driver.status().state is DeviceState.FAULT)
            assert "hard limit" in driver.status().fault
            driver.close()
            process.send_signal(signal.SIGTERM)
            assert process.wait(PATIENCE_S) == 0
            assert "'nonsense': must be one of limit, power" in process.stderr.read()
        finally:
            process.kill()
    assert not port.is_symlink()


def test_a_robot_that_no_such_controller_moves_is_refused(capsys):
    assert main(["stage", "--robot", "rotemina"]) == 2
    assert "axis thx is moved by a piezo" in capsys.readouterr().err
