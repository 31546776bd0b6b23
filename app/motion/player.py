"""Playing a trajectory as fast as the machine can: the same driver, on a clock set by hand."""

from collections.abc import Callable, Mapping

from rotemina.app.motion.recorder import PlaybackRecorder
from rotemina.drivers.abilities import TrajectoryPlayer
from rotemina.drivers.clock import VirtualClock
from rotemina.drivers.errors import DriverError
from rotemina.drivers.registry import driver_named
from rotemina.drivers.samples import DeviceState
from rotemina.sim.errors import InputError
from rotemina.sim.records.record import Record
from rotemina.sim.robot.model import Robot
from rotemina.sim.trajectory.checked import CheckedTrajectory

_STEP_S = 0.5  # device time between two looks at the progress


def play_offline(
    robot: Robot,
    trajectory: Record | CheckedTrajectory,
    seed: int = 0,
    *,
    driver: str = "simulator",
    settings: Mapping[str, object] | None = None,
    progress: Callable[[float], None] | None = None,
) -> Record:
    """Play a trajectory and return its record, without waiting for real time.

    ``progress`` is called with 0 to 1 as the playback goes on. With the same seed the record is
    that of a live playback, up to what is left of the vibration of the way to the first row.

    Raises
    ------
    InputError
        If there is no such driver, it cannot run faster than real time, a setting is wrong, or
        the trajectory exceeds a limit (:class:`rotemina.drivers.errors.LimitError`).
    DriverError
        If the device fails on the way.
    """
    clock = VirtualClock()
    make = _virtual_player(driver)
    device = make(robot, {**(settings or {}), "seed": seed}, clock=clock)
    checked = device.accept(trajectory)
    recorder = PlaybackRecorder(checked, device.name)
    device.open()
    try:
        device.read()
        device.play(checked)
        while device.status().state is DeviceState.PLAYING:
            clock.advance(_STEP_S)
            recorder.add(device.read())
            if progress is not None:
                progress(device.status().progress)
        status = device.status()
    finally:
        device.close()
    record = recorder.finish()
    if record is None or not recorder.complete:
        raise DriverError(f"{device.name}: playback ended early: {status.fault or status.state}")
    return record


def _virtual_player(name: str) -> type[TrajectoryPlayer]:
    found = driver_named(name)
    if not (issubclass(found, TrajectoryPlayer) and found.virtual_time):
        raise InputError(f"driver {name!r} cannot play faster than real time; use the simulator")
    return found
