"""Playback as fast as the machine permits, with the same driver on a manual clock."""

from collections.abc import Callable, Mapping

from rotemina.app.motion.compensation import NamedInverse, compensated_trajectory
from rotemina.app.motion.mailbox import able
from rotemina.app.motion.recorder import PlaybackRecorder
from rotemina.app.motion.regulation import NamedRegulation
from rotemina.drivers.abilities import TrajectoryPlayer
from rotemina.drivers.clock import VirtualClock
from rotemina.drivers.errors import DriverError
from rotemina.drivers.model_abilities import Compensator, Regulator
from rotemina.drivers.registry import driver_named
from rotemina.drivers.samples import DeviceState
from rotemina.sim.compensate.trajectory import on_ticks
from rotemina.sim.errors import InputError
from rotemina.sim.messages import message
from rotemina.sim.records.record import Record
from rotemina.sim.robot.model import Robot
from rotemina.sim.trajectory.checked_trajectory import CheckedTrajectory

_STEP_S = 0.5  # device time between two looks at the progress


def play_offline(
    robot: Robot,
    trajectory: Record | CheckedTrajectory,
    seed: int = 0,
    *,
    driver: str = "simulator",
    settings: Mapping[str, object] | None = None,
    progress: Callable[[float], None] | None = None,
    laser: bool = False,
    inverse: NamedInverse | None = None,
    loop: NamedRegulation | None = None,
) -> Record:
    """Play a trajectory and return its record, without waiting for real time.

    ``progress`` is called with 0 to 1 during the playback. With ``laser`` the record also has
    ``ref``, if the device has a reference. With ``inverse`` every set-point of its axis passes
    through it, also on the move to the first row; with ``loop`` its axis is under feedback. With
    the same seed the record equals that of a live playback, except for the residual vibration of
    the move to the first row.

    Raises
    ------
    InputError
        If there is no such driver, it cannot run faster than real time, a setting is wrong, or
        the trajectory exceeds a limit (:class:`rotemina.drivers.errors.LimitError`), or what the
        inverse saw.
    DriverError
        If the device fails on the way.
    """
    clock = VirtualClock()
    make = _virtual_player(driver)
    device = make(robot, {**(settings or {}), "seed": seed}, clock=clock)
    checked = device.accept(trajectory)
    names = {}
    if inverse is not None:
        period_s, used = device.setpoint_period_s, {inverse.model.axis: inverse}
        compensated_trajectory(
            robot, on_ticks(checked.commands, period_s), used, period_s, preview=False
        )
        names = {inverse.model.axis: inverse.name}
    loops = {} if loop is None else {loop.regulation.axis: loop.name}
    recorder = PlaybackRecorder(checked, device.name, laser=laser, compensations=names, loops=loops)
    device.open()
    try:
        device.read()
        if inverse is not None:
            refusal = message("engine", "driver {name} cannot compensate; use the simulator")
            able(device, Compensator, refusal).compensate(inverse.model.axis, inverse.model)
        if loop is not None:
            refusal = message("engine", "driver {name} cannot close a loop; use the simulator")
            able(device, Regulator, refusal).regulate(loop.regulation.axis, loop.regulation)
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
        raise DriverError(
            message("engine", "{name}: playback ended early: {reason}").fill(
                name=device.name, reason=status.fault or status.state
            )
        )
    return record


def _virtual_player(name: str) -> type[TrajectoryPlayer]:
    found = driver_named(name)
    if not (issubclass(found, TrajectoryPlayer) and found.virtual_time):
        raise InputError(
            message(
                "engine", "driver {name} cannot play faster than real time; use the simulator"
            ).fill(name=repr(name))
        )
    return found
