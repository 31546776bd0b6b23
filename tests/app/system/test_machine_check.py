"""The machine check distinguishes good, limited and broken machines."""

import itertools
import shutil
import sys
from collections import namedtuple

import pytest

from rotemina.app.system import FindingState, machine_check, system_check
from rotemina.app.system.system_check import DebianPackage
from rotemina.drivers.contract import LimitError
from rotemina.drivers.inputs import InputIdentity, InputSource

Usage = namedtuple("Usage", "total used free")
GOOD, LIMITED, BROKEN = FindingState.GOOD, FindingState.LIMITED, FindingState.BROKEN


class LockedJoysticks(InputSource):
    """One joystick that the system does not allow to be opened."""

    name = "sticks"

    def devices(self):
        return (InputIdentity("stick:1", "Stick", "sticks"),)

    def open(self, identity):
        raise LimitError(f"{identity.name}: no permission to open it")


class NoJoysticks(InputSource):
    name = "nothing"
    problem = "the library hidapi does not load"

    def devices(self):
        return ()

    def open(self, identity):
        raise AssertionError


def test_an_old_python_is_broken(monkeypatch):
    assert machine_check.check_python().state is GOOD
    monkeypatch.setattr(system_check, "OLDEST_PYTHON", (99, 1))
    finding = machine_check.check_python()
    assert finding.state is BROKEN
    assert "99.1" in finding.advice


@pytest.mark.parametrize(
    ("required", "state", "text"),
    [
        ("numpy>=99", BROKEN, "numpy"),
        ("no-such-package>=1; python_version >= '3.0'", BROKEN, "missing, >=1 needed"),
        ("absent>=1; extra == 'lint'", GOOD, "1 packages"),
        ("absent>=1; python_version < '3'", GOOD, "1 packages"),
    ],
)
def test_packages_too_old_or_absent_are_broken(required, state, text):
    finding = machine_check.check_dependencies(["numpy>=1", required])
    assert finding.state is state
    assert text in finding.seen


def test_missing_libraries_come_with_the_command_that_installs_them(monkeypatch):
    missing = [DebianPackage("libegl1", "libEGL.so.1")]
    monkeypatch.setattr(system_check, "find_missing_libraries", lambda platform: missing)
    finding = machine_check.check_qt_libraries("xcb")
    assert finding.state is BROKEN
    assert "libEGL.so.1" in finding.seen
    assert finding.advice


@pytest.mark.parametrize(
    ("program", "states", "text"),
    [
        ("print('xcb\\nllvmpipe (LLVM 15)')", [GOOD, LIMITED], "llvmpipe"),
        ("print('xcb\\nMesa Intel UHD')", [GOOD, GOOD], "Mesa Intel UHD"),
        ("import os; print('xcb', flush=True); os.abort()", [GOOD, LIMITED], "no OpenGL"),
        ("import sys; sys.exit('could not load xcb')", [BROKEN], "could not load xcb"),
        ("import os; os.abort()", [BROKEN], "without a message"),
    ],
)
def test_qt_is_checked_in_a_process_that_may_abort(program, states, text):
    findings = list(machine_check.check_qt("xcb", program))
    assert [finding.state for finding in findings] == states
    assert text in findings[-1].seen


def test_without_a_display_qt_is_checked_offscreen(monkeypatch):
    monkeypatch.delenv("QT_QPA_PLATFORM")
    (finding, *_) = machine_check.check_qt("offscreen")
    assert (finding.state, finding.seen) == (LIMITED, "offscreen: no display for a window")


def test_the_check_of_a_hanging_qt_times_out(monkeypatch):
    monkeypatch.setattr(machine_check, "_QT_START_TIMEOUT_S", 0.2)
    (finding,) = machine_check.check_qt("xcb", "import threading; threading.Event().wait()")
    assert finding.state is BROKEN
    assert "no answer" in finding.seen


def test_serial_ports_without_permission_are_named(tmp_path):
    port = tmp_path / "ttyUSB0"
    port.touch()
    finding = machine_check.check_serial_ports(
        [str(port), "/dev/fine"], lambda path: path == "/dev/fine"
    )
    assert finding.state is LIMITED
    assert "/dev/fine" not in finding.seen
    if sys.platform.startswith("linux"):
        assert port.group() in finding.advice
    assert machine_check.check_serial_ports([]).state is GOOD
    assert machine_check.check_serial_ports([str(port)]).seen == str(port)


def test_joysticks_that_cannot_be_opened_are_explained():
    finding = machine_check.check_joysticks(LockedJoysticks())
    assert finding.state is LIMITED
    assert "no permission" in finding.seen
    assert "hidapi" in machine_check.check_joysticks(NoJoysticks()).seen


def test_missing_folders_are_checked_without_being_created(tmp_path, monkeypatch):
    missing_folder = tmp_path / "not" / "yet"
    assert machine_check.check_folders({"cache": missing_folder}).state is GOOD
    assert list(tmp_path.iterdir()) == []

    def refuse(dir):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(machine_check.tempfile, "TemporaryFile", refuse)
    finding = machine_check.check_folders({"cache": missing_folder})
    assert finding.state is BROKEN
    assert f"{missing_folder} (cache): Permission denied" in finding.seen


@pytest.mark.parametrize(("free", "state"), [(1e8, BROKEN), (1e9, LIMITED), (1e11, GOOD)])
def test_a_disk_is_judged_by_its_free_space(tmp_path, monkeypatch, free, state):
    monkeypatch.setattr(shutil, "disk_usage", lambda folder: Usage(1e12, 1e12 - free, free))
    assert machine_check.check_free_disk(tmp_path / "absent").state is state


@pytest.mark.parametrize(("step_s", "state"), [(1e-6, GOOD), (0.0156, LIMITED)])
def test_a_clock_is_judged_by_its_smallest_step(step_s, state):
    ticks = itertools.count()
    finding = machine_check.check_clock(lambda: (next(ticks) // 3) * step_s)
    assert finding.state is state
    assert "still" in machine_check.check_clock(lambda: 7.0, max_calls=10).seen
