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
from rotemina.drivers.gcode import EmulatedStage
from rotemina.drivers.gcode.driver import GcodeStage
from rotemina.drivers.mc68hc11.driver import MC68HC11Driver
from rotemina.drivers.serial_lines.byte_channels import ByteChannel
from rotemina.drivers.serial_lines.serial_port import SerialPort
from rotemina.drivers.simulator import Simulator
from rotemina.drivers.simulator.fast_captures import SimulatedCapture
from rotemina.drivers.virtual_board import VirtualBoards
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
        silent_s = self.clock() - self._last_report_s if not type(self).is_cable_connected else 0.0
        return replace(
            status, silent_s=max(silent_s, 1e-9) if not type(self).is_cable_connected else 0.0
        )

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


def replace_arrays(samples, **changes):
    return DeviceSamples(**{name: changes.get(name, getattr(samples, name)) for name in FIELDS})


FIELDS = ("device_time_s", "command", "measured", "inputs", "playback_row")


class AccessesDeviceInConstructor(CabledSimulator):
    def __init__(self, *arguments, **options):
        super().__init__(*arguments, **options)
        type(self).access_count += 1


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


class MovesWhileClosed(CabledSimulator):
    def _close(self):
        super()._close()
        self._position = self._position + 1e-5


class ChangesItsKind(CabledSimulator):
    """Reports that it is a real machine when it is opened again."""

    _openings = 0

    def _identify(self):
        self._openings += 1
        return MachineKind.SIMULATED if self._openings == 1 else MachineKind.REAL


class AssumesVirtualMachine(CabledSimulator):
    built_in_kind = MachineKind.VIRTUAL


class DriftsAtRest(CabledSimulator):
    """Its readings drift, like those of a sensor with the wrong range."""

    def _read(self):
        samples = super()._read()
        drift = 4e-4 * np.sin(2.0 * samples.device_time_s)[:, None] * [1, 0]
        return replace_arrays(samples, measured=samples.measured + drift)


class ReturnsSamplesTwice(CabledSimulator):
    _last_samples = None

    def _read(self):
        samples = super()._read()
        if len(samples) or self._last_samples is None:
            self._last_samples = samples if len(samples) else None
            return samples
        samples, self._last_samples = self._last_samples, None
        arrays = {name: getattr(samples, name)[-1:] for name in FIELDS}
        return DeviceSamples(**arrays | {"device_time_s": arrays["device_time_s"] + 1e-6})


class ReportsRowsAtRest(CabledSimulator):
    _has_played = False

    def _play(self, trajectory, permit):
        self._has_played = True
        super()._play(trajectory, permit)

    def _read(self):
        samples = super()._read()
        if self._has_played:
            return samples
        return replace_arrays(samples, playback_row=np.zeros_like(samples.playback_row))


class RunsFastClockAtRest(CabledSimulator):
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

    def _read(self):
        samples = super()._read()
        advance_s = 0.05 * np.minimum(samples.device_time_s, self._busy_from_s)
        return replace_arrays(samples, device_time_s=samples.device_time_s + advance_s)


class AllowsStatusInOneThread(CabledSimulator):
    def _open(self):
        self._thread = threading.get_ident()
        super()._open()

    def _status(self):
        if threading.get_ident() != self._thread:
            raise RuntimeError("called by another thread")
        return super()._status()


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


class CancelsNextMoveInStop(CabledSimulator):
    _was_at_rest = False

    def _stop(self):
        self._was_at_rest = not self._open_device.is_moving and not self._open_device.is_playing
        super()._stop()

    def _move_to(self, targets, speeds, permit):
        if not self._was_at_rest:
            super()._move_to(targets, speeds, permit)
        self._was_at_rest = False


class UsesNewPermit(CabledSimulator):
    def _move_to(self, targets, speeds, permit):
        super()._move_to(targets, speeds, self.gate.permit())


class OvershootsTargets(CabledSimulator):
    """Overshoots a target at the end of a range."""

    _overshoot = 0.0

    def _move_to(self, targets, speeds, permit):
        super()._move_to(targets, speeds, permit)
        ends = [targets.get(name) == axis.range[1] for name, axis in ROBOT.axes.items()]
        self._overshoot = 1e-3 * np.array(ends) * [axis.span for axis in ROBOT.axes.values()]

    def _stop(self):
        self._overshoot = 0.0
        super()._stop()

    def _read(self):
        samples = super()._read()
        return replace_arrays(samples, command=samples.command + self._overshoot)


class MovesTooFast(CabledSimulator):
    def _make_device(self, position, time_s):
        device = super()._make_device(position, time_s)
        device._setpoints._limits.speed[:] *= 2.0
        return device


class IgnoresSpeeds(CabledSimulator):
    def _move_to(self, targets, speeds, permit):
        super()._move_to(targets, {}, permit)


class IgnoresTargetsDuringMoves(CabledSimulator):
    def _move_to(self, targets, speeds, permit):
        if not self._open_device.is_moving:
            super()._move_to(targets, speeds, permit)


class ReadsInMillimetres(CabledSimulator):
    def _read(self):
        samples = super()._read()
        return replace_arrays(samples, measured=samples.measured * [1e-3, 1.0])


class StopsBeforeTarget(CabledSimulator):
    """Stops before its target when both axes move and the target is not at an end."""

    def _move_to(self, targets, speeds, permit):
        is_inside = len(targets) == 2 and targets["x"] < 0.055
        nearer_targets = {axis: 0.999 * target for axis, target in targets.items()}
        super()._move_to(nearer_targets if is_inside else targets, speeds, permit)


class IgnoresLeases(CabledSimulator):
    def _move_velocity(self, velocities, lease_s, permit):
        super()._move_velocity(velocities, 1e6, permit)


class StopsAtEachRenewal(CabledSimulator):
    def _move_velocity(self, velocities, lease_s, permit):
        super()._move_velocity(dict.fromkeys(velocities, 0.0), lease_s, permit)
        self._open_device.advance(0.0)
        self._device._setpoints.generate(3)
        super()._move_velocity(velocities, lease_s, permit)


class ContinuesAtZeroVelocity(CabledSimulator):
    def _move_velocity(self, velocities, lease_s, permit):
        if any(velocities.values()):
            super()._move_velocity(velocities, lease_s, permit)
        else:
            self._lease_ends_s = {
                index: self.clock() - self._opened_at_s + 0.5 for index in range(2)
            }


class SkipsRow(CabledSimulator):
    def _read(self):
        samples = super()._read()
        rows = np.where(samples.playback_row == 100, -1, samples.playback_row)
        return replace_arrays(samples, playback_row=rows)


class PlaysWithOffset(CabledSimulator):
    """Its commands are off by a step during playback."""

    def _read(self):
        samples = super()._read()
        offset = np.where(samples.playback_row > 0, 2e-7, 0.0)[:, None]
        return replace_arrays(samples, command=samples.command + offset)


class ReportsMovingWhilePlaying(CabledSimulator):
    """Reports a motion instead of a playback, so that other requests can interrupt it."""

    def _status(self):
        status = super()._status()
        profile = self._open_device.running_profile
        if status.state is DeviceState.PLAYING and not profile:
            return replace(status, state=DeviceState.MOVING)
        return status


class KnowsPositionAfterStoppedHoming(CabledSimulator):
    def _stop(self):
        self._homing._unknown_axes.clear()
        super()._stop()


class NeverKnowsPosition(CabledSimulator):
    _was_homed = False

    def _home(self, axes, permit):
        self._was_homed = True
        super()._home(axes, permit)

    def _status(self):
        status = super()._status()
        return replace(status, position_known=False, unhomed=("x",)) if self._was_homed else status


class OvershootsWithVelocity(CabledSimulator):
    """Overshoots the end of a range when it moves at a velocity."""

    _had_velocity = False

    def _move_velocity(self, velocities, lease_s, permit):
        self._had_velocity = True
        super()._move_velocity(velocities, lease_s, permit)

    def _read(self):
        samples = super()._read()
        low, high = np.array([axis.range for axis in ROBOT.axes.values()]).T
        fraction = (samples.command - low) / (high - low)
        overshoot = 1e-3 * (high - low) * (1.0 * (fraction > 0.9999) - 1.0 * (fraction < 1e-4))
        return (
            replace_arrays(samples, command=samples.command + overshoot)
            if self._had_velocity
            else samples
        )


class ShowsAsciiOnly(CabledSimulator):
    def _show(self, row, text):
        text.encode("ascii")
        super()._show(row, text)


class ReturnsRawInputs(CabledSimulator):
    def analog_inputs(self):
        return (2048.0,), (False,)


class LeavesToolOn(CabledSimulator):
    def _stop(self):
        is_tool_on = self.tool_on
        super()._stop()
        self._tool_on = is_tool_on


class DoublesVoltage(CabledSimulator):
    def _set_voltage(self, axis, voltage, permit):
        position = float(self._open_device.command[self.axes.index(axis)])
        self._move_to({axis: position + 2.0 * (voltage * ROBOT.axes[axis].gain - position)}, {})


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


class IgnoresCurvatureOfProfiles(CabledSimulator):
    def _upload(self, profile, permit):
        straight_segments = [
            ProfileSegment(segment.duration_s, segment.displacement, 0.0, 0.0)
            for segment in profile.segments
        ]
        super()._upload(MotionProfile(profile.axis, tuple(straight_segments)), permit)


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


class MovesWhenFaultIsCleared(CabledSimulator):
    def _clear_fault(self, permit):
        super()._clear_fault(permit)
        self._open_device.move_to(0, 0.05)


class FailsAtShortLoss(CabledSimulator):
    """Treats every loss as a long one."""

    def _read(self):
        if not type(self).is_cable_connected:
            self._lost = True
        return super()._read()


class NeverReportsLoss(CabledSimulator):
    def _read(self):
        self._last_report_s = max(self._last_report_s, self.clock() - 0.9 * LOST_S)
        return super()._read()


class ReadsAfterLoss(CabledSimulator):
    def _read(self):
        if self._lost and type(self).is_cable_connected:
            return Simulator._read(self)
        return super()._read()


class ResumesWhenReopened(CabledSimulator):
    def _close(self):
        lost = self._lost
        super()._close()
        self._resume = lost

    def _open(self):
        super()._open()
        if getattr(self, "_resume", False):
            self._open_device.move_to(0, 0.055)


class WaitsForPortInStop(CabledSimulator):
    def _stop(self):
        self.port_has_room.wait()
        super()._stop()


class NeverDetectsBlockedPort(CabledSimulator):
    """Reads as if the port had accepted all bytes."""

    def _read(self):
        self._last_write_s = self.clock()
        return super()._read()


class IgnoresMovesAfterBlockedPort(CabledSimulator):
    """Does not move any more after its port was blocked."""

    _was_blocked = False

    def _read(self):
        self._was_blocked |= not self.port_has_room.is_set()
        return super()._read()

    def _move_to(self, *arguments):
        if not self._was_blocked:
            super()._move_to(*arguments)


class AcceptsDamagedReports(CabledSimulator):
    def _check_report(self, samples):
        if not len(samples):
            return samples
        is_damaged = type(self).is_next_report_damaged
        type(self).is_next_report_damaged = False
        return replace_arrays(samples, measured=samples.measured + 1.0) if is_damaged else samples


class CountsSlowLineAsSilent(CabledSimulator):
    def _status(self):
        status = super()._status()
        return replace(status, silent_s=0.2) if self.delay_s and self.gate.epoch.stops else status

    def _move_to(self, *arguments):
        super()._move_to(*arguments)
        self.gate.stop()


class ResumesAfterPause(CabledSimulator):
    """Continues its motion after a pause of the program."""

    virtual_time = False


FAULTY_DRIVERS = {
    AccessesDeviceInConstructor: "making",
    KeepsPortOpen: "reopening",
    MovesWhileClosed: "reopening",
    ChangesItsKind: "identity",
    AssumesVirtualMachine: "identity",
    DriftsAtRest: "opens-at-rest",
    ReturnsSamplesTwice: "reading-fast",
    ReportsRowsAtRest: "samples-follow",
    RunsFastClockAtRest: "device-time",
    AllowsStatusInOneThread: "many-threads",
    WaitsForReadInStop: "stop-during-a-read",
    StopsAtNextRead: "stop-when-called",
    CancelsNextMoveInStop: "stop-before-a-move",
    UsesNewPermit: "stop-overtakes",
    OvershootsTargets: "moves-stay-inside",
    MovesTooFast: "moves-keep-the-speed",
    IgnoresSpeeds: "move-at-a-speed",
    IgnoresTargetsDuringMoves: "new-target",
    ReadsInMillimetres: "units",
    StopsBeforeTarget: "move-arrives",
    IgnoresLeases: "lease-expiry",
    StopsAtEachRenewal: "lease-renewed",
    ContinuesAtZeroVelocity: "zero-velocity",
    SkipsRow: "rows-in-order",
    PlaysWithOffset: "commands-as-told",
    ReportsMovingWhilePlaying: "one-owner",
    OvershootsWithVelocity: "velocity-meets-the-limit",
    NeverKnowsPosition: "homing",
    ShowsAsciiOnly: "display",
    ReturnsRawInputs: "analog-inputs",
    LeavesToolOn: "tool",
    KnowsPositionAfterStoppedHoming: "homing-stopped",
    DoublesVoltage: "voltage",
    LosesCapturedSample: "capture",
    IgnoresCurvatureOfProfiles: "profile-follows",
    KeepsAbortedProfile: "profile-aborted",
    MovesWhenFaultIsCleared: "fault",
    FailsAtShortLoss: "short-loss",
    NeverReportsLoss: "long-loss",
    ReadsAfterLoss: "long-loss",
    ResumesWhenReopened: "nothing-resumes",
    WaitsForPortInStop: "blocked-port",
    NeverDetectsBlockedPort: "blocked-port",
    IgnoresMovesAfterBlockedPort: "blocked-port",
    AcceptsDamagedReports: "damaged-report",
    CountsSlowLineAsSilent: "slow-line",
}


class MemoryChannel(ByteChannel):
    """A line in memory to a device, which takes bytes only while there is room."""

    def __init__(self, device, clock, port_has_room):
        self._device, self._clock, self._has_room = device, clock, port_has_room
        self._began_s = 1234.5

    def read(self):
        return self._device.advance(self._clock() - self._began_s)

    def write(self, data):
        if not self._has_room.is_set():
            return 0
        self._device.receive(data, self._clock() - self._began_s)
        return len(data)

    def close(self):
        pass


def make_line_bench(driver, robot, device, settings):
    """Return a bench of a driver with a real serial port class and a device in memory."""
    clock, port_has_room = VirtualClock(1234.5), threading.Event()
    port_has_room.set()

    def open_port(url, _baud):
        return SerialPort(url, MemoryChannel(device, clock, port_has_room), clock)

    def make(changed_settings):
        return driver(
            robot,
            {"port": "memory", **settings, **changed_settings},
            clock=clock,
            open_port=open_port,
            pause=clock.advance,
        )

    return DriverBench(
        make=make,
        advance=clock.advance,
        block_port=port_has_room.clear,
        unblock_port=port_has_room.set,
    )


def test_a_correct_driver_passes_every_check():
    results = list(run_checks(make_cabled_bench(CabledSimulator)))
    # The time of a simulator is virtual, so the program cannot pause.
    failures = {
        result.name: result.note
        for result in results
        if result.verdict is not CheckVerdict.PASSED and result.name != "paused-program"
    }
    assert failures == {}


def test_the_boards_driver_survives_a_port_that_takes_no_bytes():
    robot = load_robot("picma")
    boards = VirtualBoards(robot, ports=1, position_known=True)
    (check,) = find_checks(["blocked-port"])
    result = check.run(
        make_line_bench(MC68HC11Driver, robot, boards.host_ports[0], {"settle_s": 0.05})
    )
    assert result.verdict is CheckVerdict.PASSED, result.note


def test_the_gcode_driver_survives_a_port_that_takes_no_bytes():
    robot = load_robot("xyz")
    stage = EmulatedStage(robot)
    (check,) = find_checks(["blocked-port"])
    result = check.run(make_line_bench(GcodeStage, robot, stage, {"trust_position": True}))
    assert result.verdict is CheckVerdict.PASSED, result.note


@pytest.mark.slow
@pytest.mark.parametrize(
    "faulty_driver", FAULTY_DRIVERS, ids=lambda faulty_driver: faulty_driver.__name__
)
def test_a_faulty_driver_fails_only_the_check_for_its_fault(faulty_driver):
    results = run_checks(make_cabled_bench(faulty_driver))
    failed = {
        result.name: result.note for result in results if result.verdict is CheckVerdict.FAILED
    }
    assert set(failed) == {FAULTY_DRIVERS[faulty_driver]}, failed


@pytest.mark.parametrize(
    ("faulty_driver", "note"),
    [
        (ChangesItsKind, "after reopening it is real"),
        (AssumesVirtualMachine, "before it was opened it is"),
    ],
)
def test_a_driver_with_an_inconsistent_machine_kind_fails(faulty_driver, note):
    (check,) = find_checks(["identity"])
    result = check.run(make_cabled_bench(faulty_driver))
    assert result.verdict is CheckVerdict.FAILED
    assert note in result.note


@pytest.mark.parametrize(
    ("driver", "robot", "device"),
    [
        (MC68HC11Driver, "picma", lambda robot: VirtualBoards(robot, ports=1).host_ports[0]),
        (GcodeStage, "xyz", EmulatedStage),
    ],
    ids=["boards", "stage"],
)
def test_the_shipped_drivers_report_the_same_machine_kind_each_time(driver, robot, device):
    loaded_robot = load_robot(robot)
    (check,) = find_checks(["identity"])
    result = check.run(make_line_bench(driver, loaded_robot, device(loaded_robot), {}))
    assert result.verdict is CheckVerdict.PASSED, result.note


def test_a_driver_that_continues_after_a_pause_fails():
    (check,) = find_checks(["paused-program"])
    result = check.run(make_cabled_bench(ResumesAfterPause))
    assert result.verdict is CheckVerdict.FAILED
    assert "was to hold" in result.note


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
    from rotemina.drivers.abilities import VelocityMover

    (homing_check,) = find_checks(["homing"])
    result = homing_check.run(make_bench(type("Bare", (Simulator,), {}), load_robot("picma")))
    assert result.verdict is CheckVerdict.SKIPPED
    assert all(check.needs is not None for check in CHECKS if "velocit" in check.name)
    assert VelocityMover in {check.needs for check in CHECKS}


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


@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM", "SIGHUP"])
def test_a_signal_during_a_move_stops_the_axes_before_the_program_ends(name):
    with subprocess.Popen(
        [sys.executable, "-c", CHECK_SCRIPT], stdout=subprocess.PIPE, text=True
    ) as process:
        assert process.stdout.readline() == "moves\n"
        process.send_signal(signal.Signals[name])
        assert process.stdout.read().split() == ["stopped", "closed"]
    assert process.returncode != 0
