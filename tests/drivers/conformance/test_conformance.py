"""Drivers with one mistake each fail exactly the conformance check for that mistake."""

import signal
import subprocess
import sys
import threading
from dataclasses import replace

import numpy as np
import pytest

from rotemina.drivers.abilities import MotionProfile, ProfileSegment
from rotemina.drivers.conformance import (
    CHECKS,
    CheckVerdict,
    DriverBench,
    find_checks,
    make_bench,
    run_checks,
)
from rotemina.drivers.contract import (
    ConnectionLostError,
    DeviceSamples,
    DeviceState,
    MachineKind,
    VirtualClock,
)
from rotemina.drivers.simulator import Simulator
from rotemina.drivers.simulator.fast_captures import SimulatedCapture
from rotemina.sim.errors import InputError
from rotemina.sim.robot_files import load_robot

SHIPPED = load_robot("rotemina")
# One stepper and one piezo have all abilities, and are simulated in a third of the time.
ROBOT = replace(
    SHIPPED,
    axes={name: SHIPPED.axes[name] for name in ("x", "thx")},
    couplings=(),
    stages={"micro": ("x",), "nano": ("thx",)},
)
LOST_S = 1.0


class CabledSimulator(Simulator):
    """A simulator with a cable that can be disconnected. The device's lease is 0.5 s."""

    # These are attributes of the class, because all drivers of a device share them.
    is_cable_connected = True
    is_next_report_damaged = False
    delay_s = 0.0
    port_has_room = threading.Event()
    access_count = 0

    def _open(self):
        type(self).access_count += 1
        self._last_report_s = self._last_write_s = self.clock()
        self._lost = False
        super()._open()

    def _status(self):
        status = super()._status()
        if type(self).is_cable_connected:
            return status
        return replace(status, silent_s=max(self.clock() - self._last_report_s, 1e-9))

    def _read(self):
        if self.port_has_room.is_set():
            self._last_write_s = self.clock()
        is_blocked = self.clock() - self._last_write_s > LOST_S
        if type(self).is_cable_connected and not self._lost and not is_blocked:
            self._last_report_s = self.clock()
            return self._check_report(super()._read())
        if (is_blocked or self.clock() - self._last_report_s > LOST_S) and not self._lost:
            self._lost = True
            super()._stop()
        if self._lost:
            raise ConnectionLostError("nothing heard for 1 s; check the cable and connect again")
        return DeviceSamples.empty(len(self.axes))

    def _check_report(self, samples):
        """Discard a damaged report."""
        if not len(samples):
            return samples
        is_damaged = type(self).is_next_report_damaged
        type(self).is_next_report_damaged = False
        return DeviceSamples.empty(len(self.axes)) if is_damaged else samples

    def _require_operational(self, action):
        if self._is_open and self._lost:
            raise ConnectionLostError(f"cannot {action}: the connection was lost")
        return super()._require_operational(action)


def make_cabled_bench(driver):
    """Return a bench with all hooks for a driver of a new device."""
    port_has_room = threading.Event()
    port_has_room.set()
    device = type(
        driver.__name__,
        (driver,),
        {"is_cable_connected": True, "port_has_room": port_has_room, "access_count": 0},
    )
    clock = VirtualClock(1234.5)

    def cause_fault(driver_with_fault):
        driver_with_fault._fault = "limit switch of x"

    return DriverBench(
        make=lambda settings: device(ROBOT, settings, clock=clock),
        advance=clock.advance,
        cut_link=lambda: setattr(device, "is_cable_connected", False),
        restore_link=lambda: setattr(device, "is_cable_connected", True),
        block_port=port_has_room.clear,
        unblock_port=port_has_room.set,
        misreport=lambda: setattr(device, "is_next_report_damaged", True),
        delay_line=lambda seconds: setattr(device, "delay_s", seconds),
        cause_fault=cause_fault,
        was_device_contacted=lambda: device.access_count > 0,
        long_loss_s=2.0,
    )


# The drivers with a mistake, each with the check that it fails and words from the finding.
FAULTY_DRIVERS = []


def fails(check, finding):
    """Return a decorator that adds a driver to :data:`FAULTY_DRIVERS`."""

    def add(driver):
        FAULTY_DRIVERS.append(pytest.param(driver, check, finding, id=driver.__name__))
        return driver

    return add


class ChangesSamples(CabledSimulator):
    """A driver that changes its samples."""

    def _read(self):
        return self.change(super()._read())


@fails("making", "creating it reached the device")
class AccessesDeviceInConstructor(CabledSimulator):
    def __init__(self, *arguments, **options):
        super().__init__(*arguments, **options)
        type(self).access_count += 1


@fails("reopening", "the port is in use")
class KeepsPortOpen(CabledSimulator):
    """Does not release its port when it is closed, unless the connection was lost."""

    _port_is_in_use = False

    def _close(self):
        self._port_is_in_use = not self._lost
        super()._close()

    def _open(self):
        if self._port_is_in_use:
            raise ConnectionLostError("the port is in use")
        super()._open()


@fails("reopening", "after reopening axis x is at")
class MovesWhileClosed(CabledSimulator):
    def _close(self):
        super()._close()
        self._position = self._position + 1e-5


@fails("identity", "after reopening it is real")
class ChangesItsKind(CabledSimulator):
    """Reports that it is a real machine when it is opened again."""

    _openings = 0

    def _identify(self):
        self._openings += 1
        return MachineKind.SIMULATED if self._openings == 1 else MachineKind.REAL


@fails("identity", "before it was opened it is virtual")
class AssumesVirtualMachine(CabledSimulator):
    built_in_kind = MachineKind.VIRTUAL


@fails("opens-at-rest", "the reading of axis x at rest changes")
class DriftsAtRest(ChangesSamples):
    """Its readings drift, like those of a sensor with the wrong range."""

    def change(self, samples):
        drift = 4e-4 * np.sin(2.0 * samples.device_time_s)[:, None] * [1, 0]
        return replace(samples, measured=samples.measured + drift)


@fails("reading-fast", "with fast reads samples are 1e-06 s apart")
class ReturnsSamplesTwice(ChangesSamples):
    _last_samples = None

    def change(self, samples):
        if len(samples) or self._last_samples is None:
            self._last_samples = samples if len(samples) else None
            return samples
        samples, self._last_samples = self._last_samples, None
        names = ("command", "measured", "inputs", "playback_row")
        latest = {name: getattr(samples, name)[-1:] for name in names}
        return DeviceSamples(samples.device_time_s[-1:] + 1e-6, **latest)


@fails("samples-follow", "a sample at rest names row [0]")
class ReportsRowsAtRest(ChangesSamples):
    _has_played = False

    def _play(self, trajectory, permit):
        self._has_played = True
        super()._play(trajectory, permit)

    def change(self, samples):
        if self._has_played:
            return samples
        return replace(samples, playback_row=np.zeros_like(samples.playback_row))


@fails("device-time", "the device's time advanced by 1.05 s")
class RunsFastClockAtRest(ChangesSamples):
    """Its clock is 5 % fast until the first motion."""

    _busy_from_s = float("inf")

    def _open(self):
        self._busy_from_s = float("inf")
        super()._open()

    def _status(self):
        status = super()._status()
        if status.state is not DeviceState.IDLE:
            self._busy_from_s = min(self._busy_from_s, self._open_device.time_s)
        return status

    def change(self, samples):
        advance_s = 0.05 * np.minimum(samples.device_time_s, self._busy_from_s)
        return replace(samples, device_time_s=samples.device_time_s + advance_s)


@fails("many-threads", "called by another thread")
class AllowsStatusInOneThread(CabledSimulator):
    def _open(self):
        self._thread = threading.get_ident()
        super()._open()

    def _status(self):
        if threading.get_ident() != self._thread:
            raise RuntimeError("called by another thread")
        return super()._status()


@fails("stop-during-a-read", "a stop waits until the read has ended")
class WaitsForReadInStop(CabledSimulator):
    def __init__(self, *arguments, **options):
        super().__init__(*arguments, **options)
        self._lock = threading.Lock()

    def _read(self):
        with self._lock:
            return super()._read()

    def _stop(self):
        if self._lock.acquire(timeout=5.0):
            self._lock.release()
        super()._stop()


@fails("stop-when-called", "s after a stop axis x moves at 10 mm/s")
class StopsAtNextRead(CabledSimulator):
    _stop_requested = False

    def _stop(self):
        self._stop_requested = True

    def _move_to(self, targets, speeds, permit):
        self._stop_requested = False
        super()._move_to(targets, speeds, permit)

    def _read(self):
        if self._stop_requested:
            self._stop_requested = False
            super()._stop()
        return super()._read()


@fails("stop-before-a-move", "after a stop and a move axis x ends at")
class CancelsNextMoveInStop(CabledSimulator):
    _was_at_rest = False

    def _stop(self):
        self._was_at_rest = not self._open_device.is_moving and not self._open_device.is_playing
        super()._stop()

    def _move_to(self, targets, speeds, permit):
        if not self._was_at_rest:
            super()._move_to(targets, speeds, permit)
        self._was_at_rest = False


@fails("stop-overtakes", "axis x was to hold, but moved")
class UsesNewPermit(CabledSimulator):
    def _move_to(self, targets, speeds, permit):
        super()._move_to(targets, speeds, self.gate.permit())


@fails("moves-stay-inside", "axis x was commanded beyond its range")
class OvershootsTargets(ChangesSamples):
    """Overshoots a target at the end of a range."""

    _overshoot = 0.0

    def _move_to(self, targets, speeds, permit):
        super()._move_to(targets, speeds, permit)
        ends = [targets.get(name) == axis.range[1] for name, axis in ROBOT.axes.items()]
        self._overshoot = 1e-3 * np.array(ends) * [axis.span for axis in ROBOT.axes.values()]

    def _stop(self):
        self._overshoot = 0.0
        super()._stop()

    def change(self, samples):
        return replace(samples, command=samples.command + self._overshoot)


@fails("moves-keep-the-speed", "axis x moved in one sample by 20 µm")
class MovesTooFast(CabledSimulator):
    def _make_device(self, position, time_s):
        device = super()._make_device(position, time_s)
        device._setpoints._limits.speed[:] *= 2.0
        return device


@fails("move-at-a-speed", "in a slow move axis x moves at 10 mm/s")
class IgnoresSpeeds(CabledSimulator):
    def _move_to(self, targets, speeds, permit):
        super()._move_to(targets, {}, permit)


@fails("new-target", "axis x was sent back and ends at 0 m")
class IgnoresTargetsDuringMoves(CabledSimulator):
    def _move_to(self, targets, speeds, permit):
        if not self._open_device.is_moving:
            super()._move_to(targets, speeds, permit)


@fails("units", "changed by -3 µm; expected: -3 mm")
class ReadsInMillimetres(ChangesSamples):
    def change(self, samples):
        return replace(samples, measured=samples.measured * [1e-3, 1.0])


@fails("move-arrives", "axis x arrives at")
class StopsBeforeTarget(CabledSimulator):
    """Stops before its target when both axes move and the target is not at an end."""

    def _move_to(self, targets, speeds, permit):
        is_inside = len(targets) == 2 and targets["x"] < 0.055
        nearer_targets = {axis: 0.999 * target for axis, target in targets.items()}
        super()._move_to(nearer_targets if is_inside else targets, speeds, permit)


@fails("lease-expiry", "with a lease of 0.2 s axis x moved for")
class IgnoresLeases(CabledSimulator):
    def _move_velocity(self, velocities, lease_s, permit):
        super()._move_velocity(velocities, 1e6, permit)


@fails("lease-renewed", "axis x is off in one sample")
class StopsAtEachRenewal(CabledSimulator):
    def _move_velocity(self, velocities, lease_s, permit):
        super()._move_velocity(dict.fromkeys(velocities, 0.0), lease_s, permit)
        self._open_device.advance(0.0)
        self._device._setpoints.generate(3)
        super()._move_velocity(velocities, lease_s, permit)


@fails("zero-velocity", "after a stop axis x moved on by")
class ContinuesAtZeroVelocity(CabledSimulator):
    def _move_velocity(self, velocities, lease_s, permit):
        if any(velocities.values()):
            super()._move_velocity(velocities, lease_s, permit)
        else:
            self._lease_ends_s = {
                index: self.clock() - self._opened_at_s + 0.5 for index in range(2)
            }


@fails("rows-in-order", "1000 rows were named; expected: all 1001")
class SkipsRow(ChangesSamples):
    def change(self, samples):
        rows = np.where(samples.playback_row == 100, -1, samples.playback_row)
        return replace(samples, playback_row=rows)


@fails("commands-as-told", "axis x is off the trajectory by 200 nm")
class PlaysWithOffset(ChangesSamples):
    """Its commands are off by a step during playback."""

    def change(self, samples):
        offset = np.where(samples.playback_row > 0, 2e-7, 0.0)[:, None]
        return replace(samples, command=samples.command + offset)


@fails("one-owner", "a move during a playback was accepted")
class ReportsMovingWhilePlaying(CabledSimulator):
    """Reports a motion instead of a playback, so that other requests can interrupt it."""

    def _status(self):
        status = super()._status()
        profile = self._open_device.running_profile
        if status.state is DeviceState.PLAYING and not profile:
            return replace(status, state=DeviceState.MOVING)
        return status


@fails("homing-stopped", "after stopped homing the unhomed axes are none")
class KnowsPositionAfterStoppedHoming(CabledSimulator):
    def _stop(self):
        self._homing._unknown_axes.clear()
        super()._stop()


@fails("homing", "after homing the position of ('x',) is unknown")
class NeverKnowsPosition(CabledSimulator):
    _was_homed = False

    def _home(self, axes, permit):
        self._was_homed = True
        super()._home(axes, permit)

    def _status(self):
        status = super()._status()
        return replace(status, position_known=False, unhomed=("x",)) if self._was_homed else status


@fails("velocity-meets-the-limit", "axis thx was commanded beyond its range")
class OvershootsWithVelocity(ChangesSamples):
    """Overshoots the end of a range when it moves at a velocity."""

    _had_velocity = False

    def _move_velocity(self, velocities, lease_s, permit):
        self._had_velocity = True
        super()._move_velocity(velocities, lease_s, permit)

    def change(self, samples):
        low, high = np.array([axis.range for axis in ROBOT.axes.values()]).T
        fraction = (samples.command - low) / (high - low)
        overshoot = 1e-3 * (high - low) * (1.0 * (fraction > 0.9999) - 1.0 * (fraction < 1e-4))
        return replace(samples, command=samples.command + self._had_velocity * overshoot)


@fails("display", "UnicodeEncodeError")
class ShowsAsciiOnly(CabledSimulator):
    def _show(self, row, text):
        text.encode("ascii")
        super()._show(row, text)


@fails("analog-inputs", "readings (2048.0,)")
class ReturnsRawInputs(CabledSimulator):
    def analog_inputs(self):
        return (2048.0,), (False,)


@fails("tool", "on after a stop")
class LeavesToolOn(CabledSimulator):
    def _stop(self):
        is_tool_on = self.tool_on
        super()._stop()
        self._tool_on = is_tool_on


@fails("voltage", "axis thx was set to")
class DoublesVoltage(CabledSimulator):
    def _set_voltage(self, axis, voltage, permit):
        position = float(self._open_device.command[self.axes.index(axis)])
        distance = voltage * ROBOT.axes[axis].gain - position
        self._move_to({axis: position + 2.0 * distance}, {}, permit)


@fails("capture", "199 samples arrived")
class LosesCapturedSample(CabledSimulator):
    def _capture(self, axes, rate_hz, count):
        super()._capture(axes, rate_hz, count)

        class LossyCapture(SimulatedCapture):
            def read_captured(self):
                portion = super().read_captured()
                if portion is None or not portion.complete:
                    return portion
                return replace(
                    portion, device_time_s=portion.device_time_s[1:], measured=portion.measured[1:]
                )

        capture = self._running_capture
        self._running_capture = LossyCapture(
            axes, tuple(capture._columns), rate_hz, count, capture._begin_s
        )


@fails("profile-follows", "axis x is off the profile")
class IgnoresCurvatureOfProfiles(CabledSimulator):
    def _upload(self, profile, permit):
        straight_segments = [
            ProfileSegment(segment.duration_s, segment.displacement, 0.0, 0.0)
            for segment in profile.segments
        ]
        super()._upload(MotionProfile(profile.axis, tuple(straight_segments)), permit)


@fails("profile-aborted", "a trigger after an abort was accepted")
class KeepsAbortedProfile(CabledSimulator):
    def _abort(self):
        uploaded_profile = self._uploaded_profile
        super()._abort()
        self._profile = uploaded_profile

    def _upload(self, profile, permit):
        super()._upload(profile, permit)
        self._uploaded_profile = self._profile

    def _trigger(self, permit):
        self._profile = self._profile or getattr(self, "_again", None)
        if self._profile is not None:
            self._profile.start = float(self._open_device.command[self._profile.index])
        super()._trigger(permit)


@fails("fault", "after clearing it is moving")
class MovesWhenFaultIsCleared(CabledSimulator):
    def _clear_fault(self, permit):
        super()._clear_fault(permit)
        self._open_device.move_to(0, 0.05)


@fails("short-loss", "it raised ConnectionLostError")
class FailsAtShortLoss(CabledSimulator):
    """Treats every loss as a long one."""

    def _read(self):
        if not type(self).is_cable_connected:
            self._lost = True
        return super()._read()


@fails("long-loss", "reads still succeed 2 s after the link was cut")
class NeverReportsLoss(CabledSimulator):
    def _read(self):
        self._last_report_s = max(self._last_report_s, self.clock() - 0.9 * LOST_S)
        return super()._read()


@fails("long-loss", "a read after the link was lost was accepted")
class ReadsAfterLoss(CabledSimulator):
    def _read(self):
        if self._lost and type(self).is_cable_connected:
            return Simulator._read(self)
        return super()._read()


@fails("nothing-resumes", "after reopening it is moving")
class ResumesWhenReopened(CabledSimulator):
    def _close(self):
        lost = self._lost
        super()._close()
        self._resume = lost

    def _open(self):
        super()._open()
        if getattr(self, "_resume", False):
            self._open_device.move_to(0, 0.055)


@fails("blocked-port", "a stop has not returned")
class WaitsForPortInStop(CabledSimulator):
    def _stop(self):
        self.port_has_room.wait()
        super()._stop()


@fails("blocked-port", "reads still succeed 2 s after the port was blocked")
class NeverDetectsBlockedPort(CabledSimulator):
    """Reads as if the port had accepted all bytes."""

    def _read(self):
        self._last_write_s = self.clock()
        return super()._read()


@fails("blocked-port", "after reopening, axis x ends at")
class IgnoresMovesAfterBlockedPort(CabledSimulator):
    """Does not move any more after its port was blocked."""

    _was_blocked = False

    def _read(self):
        self._was_blocked |= not self.port_has_room.is_set()
        return super()._read()

    def _move_to(self, *arguments):
        if not self._was_blocked:
            super()._move_to(*arguments)


@fails("damaged-report", "the reading of axis x jumps by 1.00001 m")
class AcceptsDamagedReports(CabledSimulator):
    def _check_report(self, samples):
        if not len(samples):
            return samples
        is_damaged = type(self).is_next_report_damaged
        type(self).is_next_report_damaged = False
        return replace(samples, measured=samples.measured + 1.0) if is_damaged else samples


@fails("slow-line", "it counts as silent for 0.2 s")
class CountsSlowLineAsSilent(CabledSimulator):
    def _status(self):
        status = super()._status()
        return replace(status, silent_s=0.2) if self.delay_s and self.gate.epoch.stops else status

    def _move_to(self, *arguments):
        super()._move_to(*arguments)
        self.gate.stop()


@fails("paused-program", "axis x was to hold, but moved")
class ResumesAfterPause(CabledSimulator):
    """Continues its motion after a pause of the program."""

    virtual_time = False


def test_a_correct_driver_passes_every_check():
    results = list(run_checks(make_cabled_bench(CabledSimulator)))
    # The time of a simulator is virtual, so the program cannot pause.
    failures = {
        result.name: result.note
        for result in results
        if result.verdict is not CheckVerdict.PASSED and result.name != "paused-program"
    }
    assert failures == {}


@pytest.mark.parametrize(("driver", "name", "finding"), FAULTY_DRIVERS)
def test_a_faulty_driver_fails_the_check_for_its_fault(driver, name, finding):
    (check,) = find_checks([name])
    result = check.run(make_cabled_bench(driver))
    assert result.verdict is CheckVerdict.FAILED
    assert finding in result.note


@pytest.mark.slow
@pytest.mark.parametrize(
    ("driver", "name"),
    [
        (DriftsAtRest, "opens-at-rest"),
        (StopsAtNextRead, "stop-when-called"),
        (OvershootsTargets, "moves-stay-inside"),
        (SkipsRow, "rows-in-order"),
        (NeverDetectsBlockedPort, "blocked-port"),
    ],
)
def test_a_faulty_driver_fails_no_other_check(driver, name):
    results = run_checks(make_cabled_bench(driver))
    failures = {
        result.name: result.note for result in results if result.verdict is CheckVerdict.FAILED
    }
    assert set(failures) == {name}, failures


def test_a_signal_during_the_final_stop_acts_after_closing():
    close_calls = []

    class SignalledWhileStopping(CabledSimulator):
        def _stop(self):
            signal.raise_signal(signal.SIGINT)
            super()._stop()

        def _close(self):
            super()._close()
            close_calls.append(True)

    previous_handler = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        with (
            pytest.raises(KeyboardInterrupt),
            make_cabled_bench(SignalledWhileStopping).open_driver(),
        ):
            pass
    finally:
        signal.signal(signal.SIGINT, previous_handler)
    assert close_calls == [True]


def test_checks_that_move_axes_can_be_skipped():
    results = list(run_checks(make_cabled_bench(CabledSimulator), may_move=False))
    skipped = {result.name for result in results if result.note == "it moves axes"}
    assert skipped == {check.name for check in CHECKS if check.moves}


def test_checks_are_found_by_name_and_an_unknown_name_is_rejected():
    assert [check.name for check in find_checks(["units", "making"])] == ["making", "units"]
    assert find_checks([]) == CHECKS
    with pytest.raises(InputError, match="no check 'unitz'"):
        find_checks(["unitz"])


def test_every_check_has_a_unique_name_and_a_demand():
    assert len({check.name for check in CHECKS}) == len(CHECKS)
    for check in CHECKS:
        assert check.requirement.endswith(".")
        assert len(check.requirement) > 20


def test_checks_of_missing_abilities_are_skipped():
    (check,) = find_checks(["homing"])
    result = check.run(make_bench(Simulator, load_robot("picma")))
    assert result.verdict is CheckVerdict.SKIPPED


CHECK_SCRIPT = """
import signal

# A program in a terminal has these handlers. A background job inherits an ignored SIGINT from its
# script, and a program under nohup inherits an ignored SIGHUP.
signal.signal(signal.SIGINT, signal.default_int_handler)
signal.signal(signal.SIGHUP, signal.SIG_DFL)

from dataclasses import replace
from rotemina.drivers.conformance import make_bench
from rotemina.drivers.conformance import find_checks, run_checks
from rotemina.drivers.simulator import Simulator
from rotemina.sim.robot_files import load_robot

class Real(Simulator):
    virtual_time = False

    def _move_to(self, *given):
        super()._move_to(*given)
        print("moves", flush=True)

    def _stop(self):
        super()._stop()
        print("stopped", flush=True)

    def _close(self):
        super()._close()
        print("closed", flush=True)

list(run_checks(make_bench(Real, load_robot("rotemina")), find_checks(["move-arrives"])))
"""


@pytest.mark.parametrize("name", ["SIGTERM", "SIGHUP"])
def test_a_signal_during_a_move_stops_the_axes_before_the_program_ends(name):
    with subprocess.Popen(
        [sys.executable, "-c", CHECK_SCRIPT], stdout=subprocess.PIPE, text=True
    ) as process:
        assert process.stdout.readline() == "moves\n"
        process.send_signal(signal.Signals[name])
        assert process.stdout.read().split() == ["stopped", "closed"]
    assert process.returncode != 0
