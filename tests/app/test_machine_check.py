"""What the check of a machine says of good ones, limited ones and broken ones."""

import itertools
import shutil
import sys
from collections import namedtuple

import pytest

from rotemina.app import machine_check, system_check
from rotemina.app.machine_check import State
from rotemina.app.system_check import Package
from rotemina.drivers.errors import LimitError
from rotemina.drivers.inputs.device import InputIdentity, InputSource

Usage = namedtuple("Usage", "total used free")


class Sticks(InputSource):
    """One stick, which the system lets nobody open."""

    name = "sticks"

    def devices(self):
        return (InputIdentity("stick:1", "Stick", "sticks"),)

    def open(self, identity):
        raise LimitError(f"{identity.name}: no permission to open it")


class Nothing(InputSource):
    name = "nothing"
    problem = "the library hidapi does not load"

    def devices(self):
        return ()

    def open(self, identity):
        raise AssertionError


def test_an_old_python_is_broken(monkeypatch):
    assert machine_check.python().state is State.GOOD
    monkeypatch.setattr(system_check, "OLDEST_PYTHON", (99, 1))
    found = machine_check.python()
    assert found.state is State.BROKEN
    assert "99.1" in found.advice


@pytest.mark.parametrize(
    ("required", "said"),
    [
        ("numpy>=99", "numpy"),
        ("no-such-package-at-all>=1; python_version >= '3.0'", "missing, >=1 needed"),
    ],
)
def test_packages_too_old_or_absent_are_broken(required, said):
    found = machine_check.dependencies(["numpy>=1", required])
    assert found.state is State.BROKEN
    assert said in found.seen


def test_packages_of_extras_and_of_other_systems_are_not_asked_for():
    found = machine_check.dependencies(
        ["numpy>=1", "absent>=1; extra == 'lint'", "absent>=1; python_version < '3'"]
    )
    assert found.state is State.GOOD
    assert found.seen.startswith("1 packages")


def test_missing_libraries_come_with_the_command_that_installs_them(monkeypatch):
    missing = [Package("libegl1", "libEGL.so.1")]
    monkeypatch.setattr(system_check, "missing_libraries", lambda platform: missing)
    found = machine_check.qt_libraries("xcb")
    assert found.state is State.BROKEN
    assert "libEGL.so.1" in found.seen
    assert found.advice


@pytest.mark.parametrize(
    ("program", "states", "said"),
    [
        ("print('offscreen')", [State.GOOD, State.LIMITED], "no OpenGL"),
        ("print('xcb'); print('llvmpipe (LLVM 15)')", [State.GOOD, State.LIMITED], "llvmpipe"),
        ("print('xcb'); print('Mesa Intel UHD')", [State.GOOD, State.GOOD], "Mesa Intel UHD"),
        ("import os; print('xcb', flush=True); os.abort()", [State.GOOD, State.LIMITED], "no Op"),
        ("import sys; sys.exit('could not load xcb')", [State.BROKEN], "could not load xcb"),
        ("import os; os.abort()", [State.BROKEN], "without a message"),
    ],
)
def test_qt_is_tried_in_a_process_that_may_abort(program, states, said):
    found = list(machine_check.qt("xcb", program))
    assert [one.state for one in found] == states
    assert said in found[-1].seen


def test_without_a_display_qt_starts_as_the_program_does(monkeypatch):
    monkeypatch.delenv("QT_QPA_PLATFORM")
    (found, *_) = machine_check.qt("offscreen")
    assert (found.state, found.seen) == (State.LIMITED, "offscreen: no display for a window")


def test_a_qt_that_hangs_is_given_up(monkeypatch):
    monkeypatch.setattr(machine_check, "_QT_STARTS_IN_S", 0.2)
    (found,) = machine_check.qt("xcb", "import threading; threading.Event().wait()")
    assert found.state is State.BROKEN
    assert "no answer" in found.seen


def test_serial_ports_without_permission_are_named(tmp_path):
    port = tmp_path / "ttyUSB0"
    port.touch()
    found = machine_check.serial_ports([str(port), "/dev/fine"], lambda one: one == "/dev/fine")
    assert found.state is State.LIMITED
    assert "/dev/fine" not in found.seen
    if sys.platform.startswith("linux"):
        assert port.group() in found.advice
    assert machine_check.serial_ports([]).state is State.GOOD
    assert machine_check.serial_ports([str(port)]).seen == str(port)


def test_joysticks_that_cannot_be_opened_tell_why():
    found = machine_check.joysticks(Sticks())
    assert found.state is State.LIMITED
    assert "no permission" in found.seen
    assert "hidapi" in machine_check.joysticks(Nothing()).seen


def test_folders_are_tried_where_they_would_be_made(tmp_path, monkeypatch):
    wanted = tmp_path / "not" / "yet"
    assert machine_check.writable({"cache": wanted}).state is State.GOOD
    assert list(tmp_path.iterdir()) == []

    def refuse(dir):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(machine_check.tempfile, "TemporaryFile", refuse)
    found = machine_check.writable({"cache": wanted})
    assert found.state is State.BROKEN
    assert f"{wanted} (cache): Permission denied" in found.seen


@pytest.mark.parametrize(
    ("free", "state"), [(1e8, State.BROKEN), (1e9, State.LIMITED), (1e11, State.GOOD)]
)
def test_a_disk_is_judged_by_what_can_be_recorded(tmp_path, monkeypatch, free, state):
    monkeypatch.setattr(shutil, "disk_usage", lambda folder: Usage(1e12, 1e12 - free, free))
    assert machine_check.free_disk(tmp_path / "absent").state is state


@pytest.mark.parametrize(("step_s", "state"), [(1e-6, State.GOOD), (0.0156, State.LIMITED)])
def test_a_clock_is_judged_by_its_smallest_step(step_s, state):
    ticks = itertools.count()
    found = machine_check.clock(lambda: (next(ticks) // 3) * step_s)
    assert found.state is state


def test_a_clock_that_stands_still_is_told():
    assert "still" in machine_check.clock(lambda: 7.0, most=10).seen
