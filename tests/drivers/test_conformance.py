"""The kit on drivers that do one thing wrong: each fails the check meant for it, and no other."""

import signal
import subprocess
import sys
import threading
from dataclasses import replace

import numpy as np
import pytest

from rotemina.drivers.byte_channels import ByteChannel
from rotemina.drivers.clock import VirtualClock
from rotemina.drivers.conformance.bench import Bench, bench_of
from rotemina.drivers.conformance.check import Verdict
from rotemina.drivers.conformance.suite import CHECKS, checks_named, run_checks
from rotemina.drivers.driver import MachineKind
from rotemina.drivers.errors import ConnectionLostError
from rotemina.drivers.gcode.driver import GcodeStage
from rotemina.drivers.gcode.emulator import EmulatedStage
from rotemina.drivers.mc68hc11.driver import MC68HC11
from rotemina.drivers.profile import Profile, ProfileSegment
from rotemina.drivers.samples import DeviceState, Samples
from rotemina.drivers.serial_port import SerialPort
from rotemina.drivers.simulator.driver import Simulator
from rotemina.drivers.simulator.fast_captures import Capturing
from rotemina.drivers.virtual_board.boards import VirtualBoards
from rotemina.sim.errors import InputError
from rotemina.sim.robot.file import load_robot

SHIPPED = load_robot("rotemina")
# One stepper and one piezo have all abilities, and are simulated in a third of the time.
ROBOT = replace(
    SHIPPED,
    axes={name: SHIPPED.axes[name] for name in ("x", "thx")},
    couplings=(),
    stages={"micro": ("x",), "nano": ("thx",)},
)
LOST_S = 1.0


class Cabled(Simulator):
    """The simulator at the end of a cable that can be pulled; the device's lease is 0.5 s."""

    cable = True  # of the class: it is the device's, whoever drives it
    damaged = False  # its next report
    delay_s = 0.0
    room = threading.Event()  # in its port
    touches = 0

    def _open(self):
        type(self).touches += 1
        self._heard_s = self._took_s = self.clock()
        self._lost = False
        super()._open()

    def _status(self):
        status = super()._status()
        silent_s = self.clock() - self._heard_s if not type(self).cable else 0.0
        return replace(status, silent_s=max(silent_s, 1e-9) if not type(self).cable else 0.0)

    def _read(self):
        if self.room.is_set():
            self._took_s = self.clock()
        is_blocked = self.clock() - self._took_s > LOST_S
        if type(self).cable and not self._lost and not is_blocked:
            self._heard_s = self.clock()
            return self._check_report(super()._read())
        if (is_blocked or self.clock() - self._heard_s > LOST_S) and not self._lost:
            self._lost = True
            super()._stop()
        if self._lost:
            raise ConnectionLostError("nothing heard for 1 s; check the cable and connect again")
        return Samples.none(len(self.axes))

    def _check_report(self, samples):
        """Discard a damaged report."""
        if not len(samples):
            return samples
        damaged, type(self).damaged = type(self).damaged, False
        return Samples.none(len(self.axes)) if damaged else samples

    def _require_sound(self, action):
        if self._is_open and self._lost:
            raise ConnectionLostError(f"cannot {action}: the connection was lost")
        return super()._require_sound(action)


def bench(driver):
    """A bench whose every hook works, on a fresh device."""
    room = threading.Event()
    room.set()
    device = type(driver.__name__, (driver,), {"cable": True, "room": room, "touches": 0})
    clock = VirtualClock(1234.5)

    def cause_fault(opened):
        opened._fault = "limit switch of x"

    return Bench(
        make=lambda settings: device(ROBOT, settings, clock=clock),
        advance=clock.advance,
        cut_link=lambda: setattr(device, "cable", False),
        restore_link=lambda: setattr(device, "cable", True),
        block_port=room.clear,
        unblock_port=room.set,
        misreport=lambda: setattr(device, "damaged", True),
        delay_line=lambda seconds: setattr(device, "delay_s", seconds),
        cause_fault=cause_fault,
        touched=lambda: device.touches > 0,
        long_loss_s=2.0,
    )


def altered(samples, **changes):
    return Samples(**{name: changes.get(name, getattr(samples, name)) for name in FIELDS})


FIELDS = ("device_time_s", "command", "measured", "inputs", "playback_row")


class TouchesWhenMade(Cabled):
    def __init__(self, *given, **named):
        super().__init__(*given, **named)
        type(self).touches += 1


class ClosesBadly(Cabled):
    """Keeps its port, unless the operating system took it away."""

    _port_taken = False

    def _close(self):
        self._port_taken = not self._lost
        super()._close()

    def _open(self):
        if self._port_taken:
            raise ConnectionLostError("the port is in use")
        super()._open()


class ComesBackElsewhere(Cabled):
    def _close(self):
        super()._close()
        self._position = self._position + 1e-5


class ChangesItsKind(Cabled):
    """Says that it is a real machine when it is opened again."""

    _openings = 0

    def _identify(self):
        self._openings += 1
        return MachineKind.SIMULATED if self._openings == 1 else MachineKind.REAL


class AssumedVirtual(Cabled):
    built_in_kind = MachineKind.VIRTUAL


class DriftsAtRest(Cabled):
    """Its readings wander off, as of a sensor of the wrong range."""

    def _read(self):
        samples = super()._read()
        wander = 4e-4 * np.sin(2.0 * samples.device_time_s)[:, None] * [1, 0]
        return altered(samples, measured=samples.measured + wander)


class HandsOutTwice(Cabled):
    _last = None

    def _read(self):
        samples = super()._read()
        if len(samples) or self._last is None:
            self._last = samples if len(samples) else None
            return samples
        again, self._last = self._last, None
        parts = {name: getattr(again, name)[-1:] for name in FIELDS}
        return Samples(**parts | {"device_time_s": parts["device_time_s"] + 1e-6})


class NamesRowsAtRest(Cabled):
    _played = False

    def _play(self, trajectory, permit):
        self._played = True
        super()._play(trajectory, permit)

    def _read(self):
        samples = super()._read()
        if self._played:
            return samples
        return altered(samples, playback_row=np.zeros_like(samples.playback_row))


class HurriesAtRest(Cabled):
    """Its clock is 5 % fast until it has something to do."""

    _busy_from_s = float("inf")

    def _open(self):
        self._busy_from_s = float("inf")
        super()._open()

    def _status(self):
        status = super()._status()
        if status.state is not DeviceState.IDLE:
            self._busy_from_s = min(self._busy_from_s, self._running.time_s)
        return status

    def _read(self):
        samples = super()._read()
        hurry = 0.05 * np.minimum(samples.device_time_s, self._busy_from_s)
        return altered(samples, device_time_s=samples.device_time_s + hurry)


class StatusOfOneThread(Cabled):
    def _open(self):
        self._thread = threading.get_ident()
        super()._open()

    def _status(self):
        if threading.get_ident() != self._thread:
            raise RuntimeError("called by another thread")
        return super()._status()


class StopWaitsForTheRead(Cabled):
    def __init__(self, *given, **named):
        super().__init__(*given, **named)
        self._lock = threading.Lock()

    def _read(self):
        with self._lock:
            return super()._read()

    def _stop(self):
        if self._lock.acquire(timeout=5.0):
            self._lock.release()
        super()._stop()


class StopsWhenRead(Cabled):
    _asked = False

    def _stop(self):
        self._asked = True

    def _move_to(self, targets, speeds, permit):
        self._asked = False
        super()._move_to(targets, speeds, permit)

    def _read(self):
        if self._asked:
            self._asked = False
            super()._stop()
        return super()._read()


class StopUndoesTheNextMove(Cabled):
    _stopped = False

    def _stop(self):
        self._stopped = not self._running.moving and not self._running.playing
        super()._stop()

    def _move_to(self, targets, speeds, permit):
        if not self._stopped:
            super()._move_to(targets, speeds, permit)
        self._stopped = False


class PassesTheGateWithWhatIsNew(Cabled):
    def _move_to(self, targets, speeds, permit):
        super()._move_to(targets, speeds, self.gate.permit())


class LeavesTheRange(Cabled):
    """Overshoots where it is sent to an end."""

    _over = 0.0

    def _move_to(self, targets, speeds, permit):
        super()._move_to(targets, speeds, permit)
        ends = [targets.get(name) == axis.range[1] for name, axis in ROBOT.axes.items()]
        self._over = 1e-3 * np.array(ends) * [axis.span for axis in ROBOT.axes.values()]

    def _stop(self):
        self._over = 0.0
        super()._stop()

    def _read(self):
        samples = super()._read()
        return altered(samples, command=samples.command + self._over)


class HurriesMoves(Cabled):
    def _made(self, position, time_s):
        made = super()._made(position, time_s)
        made._setpoints._limits.speed[:] *= 2.0
        return made


class IgnoresSpeeds(Cabled):
    def _move_to(self, targets, speeds, permit):
        super()._move_to(targets, {}, permit)


class FinishesMovesFirst(Cabled):
    def _move_to(self, targets, speeds, permit):
        if not self._running.moving:
            super()._move_to(targets, speeds, permit)


class ReadsInMillimetres(Cabled):
    def _read(self):
        samples = super()._read()
        return altered(samples, measured=samples.measured * [1e-3, 1.0])


class ArrivesNearly(Cabled):
    """Does not go all the way where several axes move, if that is not to an end."""

    def _move_to(self, targets, speeds, permit):
        within = len(targets) == 2 and targets["x"] < 0.055
        near = {axis: 0.999 * at for axis, at in targets.items()}
        super()._move_to(near if within else targets, speeds, permit)


class IgnoresLeases(Cabled):
    def _move_velocity(self, velocities, lease_s, permit):
        super()._move_velocity(velocities, 1e6, permit)


class HaltsAtEachRenewal(Cabled):
    def _move_velocity(self, velocities, lease_s, permit):
        super()._move_velocity(dict.fromkeys(velocities, 0.0), lease_s, permit)
        self._running.advance(0.0)
        self._device._setpoints.generate(3)
        super()._move_velocity(velocities, lease_s, permit)


class GoesOnAtZero(Cabled):
    def _move_velocity(self, velocities, lease_s, permit):
        if any(velocities.values()):
            super()._move_velocity(velocities, lease_s, permit)
        else:
            self._leases_s = {index: self.clock() - self._opened_at_s + 0.5 for index in range(2)}


class LeavesOutARow(Cabled):
    def _read(self):
        samples = super()._read()
        rows = np.where(samples.playback_row == 100, -1, samples.playback_row)
        return altered(samples, playback_row=rows)


class PlaysBeside(Cabled):
    """Its commands are a step off while rows act."""

    def _read(self):
        samples = super()._read()
        off = np.where(samples.playback_row > 0, 2e-7, 0.0)[:, None]
        return altered(samples, command=samples.command + off)


class SaysMovingWhenPlaying(Cabled):
    """And so lets anybody break into a playback."""

    def _status(self):
        status = super()._status()
        profile = self._running.running_profile
        if status.state is DeviceState.PLAYING and not profile:
            return replace(status, state=DeviceState.MOVING)
        return status


class KnowsAfterAStoppedSearch(Cabled):
    def _stop(self):
        self._homing._unknown.clear()
        super()._stop()


class NeverKnows(Cabled):
    _sought = False

    def _home(self, axes, permit):
        self._sought = True
        super()._home(axes, permit)

    def _status(self):
        status = super()._status()
        return replace(status, position_known=False, unhomed=("x",)) if self._sought else status


class DrivesBeyond(Cabled):
    """Overshoots where a speed takes it to an end."""

    _driven = False

    def _move_velocity(self, velocities, lease_s, permit):
        self._driven = True
        super()._move_velocity(velocities, lease_s, permit)

    def _read(self):
        samples = super()._read()
        low, high = np.array([axis.range for axis in ROBOT.axes.values()]).T
        place = (samples.command - low) / (high - low)
        over = 1e-3 * (high - low) * (1.0 * (place > 0.9999) - 1.0 * (place < 1e-4))
        return altered(samples, command=samples.command + over) if self._driven else samples


class SpellsAsciiOnly(Cabled):
    def _show(self, row, text):
        text.encode("ascii")
        super()._show(row, text)


class CountsPotentiometers(Cabled):
    def analog_inputs(self):
        return (2048.0,), (False,)


class LeavesTheToolOn(Cabled):
    def _stop(self):
        on = self.tool_on
        super()._stop()
        self._tool_on = on


class MistakesTheVoltage(Cabled):
    def _set_voltage(self, axis, voltage, permit):
        at = float(self._running.command[self.axes.index(axis)])
        self._move_to({axis: at + 2.0 * (voltage * ROBOT.axes[axis].gain - at)}, {})


class LosesACapturedSample(Cabled):
    def _capture(self, axes, rate_hz, count):
        super()._capture(axes, rate_hz, count)

        class Losing(Capturing):
            def handed_out(self):
                part = super().handed_out()
                if part is None or not part.complete:
                    return part
                return replace(
                    part, device_time_s=part.device_time_s[1:], measured=part.measured[1:]
                )

        made = self._capturing
        self._capturing = Losing(axes, tuple(made._columns), rate_hz, count, made._begin_s)


class StraightensProfiles(Cabled):
    def _upload(self, profile, permit):
        straight = [
            ProfileSegment(one.duration_s, one.length, 0.0, 0.0) for one in profile.segments
        ]
        super()._upload(Profile(profile.axis, tuple(straight)), permit)


class KeepsAnAbortedProfile(Cabled):
    def _abort(self):
        kept = self._kept
        super()._abort()
        self._profile = kept

    def _upload(self, profile, permit):
        super()._upload(profile, permit)
        self._kept = self._profile

    def _trigger(self, permit):
        self._profile = self._profile or getattr(self, "_again", None)
        if self._profile is not None:
            self._profile.start = float(self._running.command[self._profile.index])
        super()._trigger(permit)


class JumpsWhenCleared(Cabled):
    def _clear_fault(self, permit):
        super()._clear_fault(permit)
        self._running.move_to(0, 0.05)


class FailsAtOnce(Cabled):
    """Knows no short loss."""

    def _read(self):
        if not type(self).cable:
            self._lost = True
        return super()._read()


class NeverGivesUp(Cabled):
    def _read(self):
        self._heard_s = max(self._heard_s, self.clock() - 0.9 * LOST_S)
        return super()._read()


class ReadsAfterALoss(Cabled):
    def _read(self):
        if self._lost and type(self).cable:
            return Simulator._read(self)
        return super()._read()


class ResumesWhenReopened(Cabled):
    def _close(self):
        lost = self._lost
        super()._close()
        self._resume = lost

    def _open(self):
        super()._open()
        if getattr(self, "_resume", False):
            self._running.move_to(0, 0.055)


class StopWaitsForThePort(Cabled):
    def _stop(self):
        self.room.wait()
        super()._stop()


class WritesForEver(Cabled):
    """Is read as if the port took everything."""

    def _read(self):
        self._took_s = self.clock()
        return super()._read()


class SilentWhenBlockedOnce(Cabled):
    """Cannot be moved any more."""

    _was_blocked = False

    def _read(self):
        self._was_blocked |= not self.room.is_set()
        return super()._read()

    def _move_to(self, *given):
        if not self._was_blocked:
            super()._move_to(*given)


class BelievesDamagedReports(Cabled):
    def _check_report(self, samples):
        if not len(samples):
            return samples
        damaged, type(self).damaged = type(self).damaged, False
        return altered(samples, measured=samples.measured + 1.0) if damaged else samples


class SilentOnASlowLine(Cabled):
    def _status(self):
        status = super()._status()
        return replace(status, silent_s=0.2) if self.delay_s and self.gate.epoch.stops else status

    def _move_to(self, *given):
        super()._move_to(*given)
        self.gate.stop()


class ResumesAfterAPause(Cabled):
    """Continues its motion after a pause."""

    virtual_time = False


MUTANTS = {
    TouchesWhenMade: "making",
    ClosesBadly: "reopening",
    ComesBackElsewhere: "reopening",
    ChangesItsKind: "identity",
    AssumedVirtual: "identity",
    DriftsAtRest: "opens-at-rest",
    HandsOutTwice: "reading-fast",
    NamesRowsAtRest: "samples-follow",
    HurriesAtRest: "device-time",
    StatusOfOneThread: "many-threads",
    StopWaitsForTheRead: "stop-during-a-read",
    StopsWhenRead: "stop-when-called",
    StopUndoesTheNextMove: "stop-before-a-move",
    PassesTheGateWithWhatIsNew: "stop-overtakes",
    LeavesTheRange: "moves-stay-inside",
    HurriesMoves: "moves-keep-the-speed",
    IgnoresSpeeds: "move-at-a-speed",
    FinishesMovesFirst: "new-target",
    ReadsInMillimetres: "units",
    ArrivesNearly: "move-arrives",
    IgnoresLeases: "lease-expiry",
    HaltsAtEachRenewal: "lease-renewed",
    GoesOnAtZero: "zero-velocity",
    LeavesOutARow: "rows-in-order",
    PlaysBeside: "commands-as-told",
    SaysMovingWhenPlaying: "one-owner",
    DrivesBeyond: "velocity-meets-the-limit",
    NeverKnows: "homing",
    SpellsAsciiOnly: "display",
    CountsPotentiometers: "analog-inputs",
    LeavesTheToolOn: "tool",
    KnowsAfterAStoppedSearch: "homing-stopped",
    MistakesTheVoltage: "voltage",
    LosesACapturedSample: "capture",
    StraightensProfiles: "profile-follows",
    KeepsAnAbortedProfile: "profile-aborted",
    JumpsWhenCleared: "fault",
    FailsAtOnce: "short-loss",
    NeverGivesUp: "long-loss",
    ReadsAfterALoss: "long-loss",
    ResumesWhenReopened: "nothing-resumes",
    StopWaitsForThePort: "blocked-port",
    WritesForEver: "blocked-port",
    SilentWhenBlockedOnce: "blocked-port",
    BelievesDamagedReports: "damaged-report",
    SilentOnASlowLine: "slow-line",
}


class MemoryChannel(ByteChannel):
    """A line in memory to a device, which takes bytes only while there is room."""

    def __init__(self, device, clock, room):
        self._device, self._clock, self._room = device, clock, room
        self._began_s = 1234.5

    def read(self):
        return self._device.advance(self._clock() - self._began_s)

    def write(self, data):
        if not self._room.is_set():
            return 0
        self._device.receive(data, self._clock() - self._began_s)
        return len(data)

    def close(self):
        pass


def line_bench(driver, robot, device, settings):
    """A bench of a driver with the port that real lines have, and a device in memory."""
    clock, room = VirtualClock(1234.5), threading.Event()
    room.set()

    def open_port(url, _baud):
        return SerialPort(url, MemoryChannel(device, clock, room), clock)

    def make(given):
        return driver(
            robot,
            {"port": "memory", **settings, **given},
            clock=clock,
            open_port=open_port,
            pause=clock.advance,
        )

    return Bench(make=make, advance=clock.advance, block_port=room.clear, unblock_port=room.set)


def test_a_driver_that_keeps_the_contract_passes_every_check():
    results = list(run_checks(bench(Cabled)))
    # A simulator lives on the time that it is given: there is no pause.
    others = [one for one in results if one.name != "paused-program"]
    assert [(one.name, one.note) for one in others if one.verdict is not Verdict.PASSED] == []


def test_the_boards_driver_survives_a_port_that_takes_no_bytes():
    robot = load_robot("picma")
    boards = VirtualBoards(robot, ports=1, position_known=True)
    (check,) = checks_named(["blocked-port"])
    result = check.run(line_bench(MC68HC11, robot, boards.lines[0], {"settle_s": 0.05}))
    assert result.verdict is Verdict.PASSED, result.note


def test_the_gcode_driver_survives_a_port_that_takes_no_bytes():
    robot = load_robot("xyz")
    stage = EmulatedStage(robot)
    (check,) = checks_named(["blocked-port"])
    result = check.run(line_bench(GcodeStage, robot, stage, {"trust_position": True}))
    assert result.verdict is Verdict.PASSED, result.note


@pytest.mark.slow
@pytest.mark.parametrize("mutant", MUTANTS, ids=lambda mutant: mutant.__name__)
def test_a_driver_that_does_one_thing_wrong_fails_the_check_meant_for_it(mutant):
    results = run_checks(bench(mutant))
    failed = {one.name: one.note for one in results if one.verdict is Verdict.FAILED}
    assert set(failed) == {MUTANTS[mutant]}, failed


@pytest.mark.parametrize(
    ("mutant", "note"),
    [(ChangesItsKind, "opened again it is real"), (AssumedVirtual, "before it was opened it is")],
)
def test_a_driver_that_is_not_sure_what_it_drives_fails(mutant, note):
    (check,) = checks_named(["identity"])
    result = check.run(bench(mutant))
    assert result.verdict is Verdict.FAILED
    assert note in result.note


@pytest.mark.parametrize(
    ("driver", "robot", "device"),
    [
        (MC68HC11, "picma", lambda robot: VirtualBoards(robot, ports=1).lines[0]),
        (GcodeStage, "xyz", EmulatedStage),
    ],
    ids=["boards", "stage"],
)
def test_the_shipped_drivers_say_the_same_of_a_device_each_time(driver, robot, device):
    described = load_robot(robot)
    (check,) = checks_named(["identity"])
    result = check.run(line_bench(driver, described, device(described), {}))
    assert result.verdict is Verdict.PASSED, result.note


def test_a_driver_that_goes_on_after_a_pause_fails():
    (check,) = checks_named(["paused-program"])
    result = check.run(bench(ResumesAfterAPause))
    assert result.verdict is Verdict.FAILED
    assert "was to hold" in result.note


def test_a_signal_while_a_finished_check_stops_acts_afterwards():
    closed = []

    class SignalledWhileStopping(Cabled):
        def _stop(self):
            signal.raise_signal(signal.SIGINT)
            super()._stop()

        def _close(self):
            super()._close()
            closed.append(True)

    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        with pytest.raises(KeyboardInterrupt), bench(SignalledWhileStopping).opened():
            pass
    finally:
        signal.signal(signal.SIGINT, before)
    assert closed == [True]


def test_what_moves_nothing_can_be_checked_alone():
    results = list(run_checks(bench(Cabled), may_move=False))
    skipped = {one.name for one in results if one.note == "it moves axes"}
    assert skipped == {check.name for check in CHECKS if check.moves}


def test_checks_are_found_by_name_and_an_unknown_one_is_named():
    assert [one.name for one in checks_named(["units", "making"])] == ["making", "units"]
    assert checks_named([]) == CHECKS
    with pytest.raises(InputError, match="no check 'unitz'"):
        checks_named(["unitz"])


def test_every_check_says_what_it_demands_once():
    assert len({check.name for check in CHECKS}) == len(CHECKS)
    for check in CHECKS:
        assert check.demand.endswith(".")
        assert len(check.demand) > 20


def test_a_driver_of_few_abilities_is_spared_the_others():
    from rotemina.drivers.abilities import VelocityMover

    (one,) = checks_named(["homing"])
    result = one.run(bench_of(type("Bare", (Simulator,), {}), load_robot("picma")))
    assert result.verdict is Verdict.SKIPPED
    assert all(check.needs is not None for check in CHECKS if "velocit" in check.name)
    assert VelocityMover in {check.needs for check in CHECKS}


KIT = """
import signal

# As in a program that a terminal starts: a script starts its background jobs with SIGINT ignored,
# nohup with SIGHUP, and they hand that on to this process.
signal.signal(signal.SIGINT, signal.default_int_handler)
signal.signal(signal.SIGHUP, signal.SIG_DFL)

from dataclasses import replace
from rotemina.drivers.conformance.bench import bench_of
from rotemina.drivers.conformance.suite import checks_named, run_checks
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.robot.file import load_robot

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

list(run_checks(bench_of(Real, load_robot("rotemina")), checks_named(["move-arrives"])))
"""


@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM", "SIGHUP"])
def test_a_signal_during_a_move_stops_the_axes_before_the_kit_ends(name):
    with subprocess.Popen([sys.executable, "-c", KIT], stdout=subprocess.PIPE, text=True) as kit:
        assert kit.stdout.readline() == "moves\n"
        kit.send_signal(signal.Signals[name])
        assert kit.stdout.read().split() == ["stopped", "closed"]
    assert kit.returncode != 0
