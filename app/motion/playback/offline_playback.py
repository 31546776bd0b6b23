"""Playback faster than real time, with a virtual device whose clock is advanced manually."""

from collections.abc import Callable, Mapping

from rotemina.app.motion.device import require_ability
from rotemina.app.motion.session import NamedInverse, NamedRegulation, make_compensated_trajectory
from rotemina.app.motion.state import PlaybackRecorder
from rotemina.drivers.abilities import AxisRegulator, HysteresisCompensator, TrajectoryPlayer
from rotemina.drivers.contract import DeviceState, DriverError, VirtualClock, find_driver
from rotemina.sim.compensate import sample_at_ticks
from rotemina.sim.errors import InputError
from rotemina.sim.messages import message
from rotemina.sim.records import Record
from rotemina.sim.robot import Robot
from rotemina.sim.trajectory import CheckedTrajectory

# Device time between two reports of the progress.
_PROGRESS_PERIOD_S = 0.5


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

    ``progress`` is called with 0 to 1 during the playback. With ``laser`` the record also has the
    tap ``ref``, if the device has a reference sensor. ``inverse`` converts every set-point of its
    axis, also during the move to the first row. ``loop`` closes a feedback loop around its axis.
    With the same seed the record equals that of a live playback, except for the residual vibration
    of the move to the first row.

    Raises
    ------
    InputError
        If the driver does not exist or cannot run faster than real time, a setting is wrong, or the
        trajectory exceeds the training range of the inverse or a limit
        (:class:`rotemina.drivers.contract.LimitError`).
    DriverError
        If the device fails during the playback.
    """
    clock = VirtualClock()
    device_type = _find_virtual_player(driver)
    device = device_type(robot, {**(settings or {}), "seed": seed}, clock=clock)
    checked = device.accept(trajectory)
    inverse_names = {}
    if inverse is not None:
        period_s, inverses = device.setpoint_period_s, {inverse.model.axis: inverse}
        make_compensated_trajectory(
            robot, sample_at_ticks(checked.commands, period_s), inverses, period_s, preview=False
        )
        inverse_names = {inverse.model.axis: inverse.name}
    loops = {} if loop is None else {loop.regulation.axis: loop.name}
    recorder = PlaybackRecorder(
        checked, device.name, laser=laser, compensations=inverse_names, loops=loops
    )
    device.open()
    try:
        device.read()
        if inverse is not None:
            refusal = message("engine", "driver {name} cannot compensate; use the simulator")
            require_ability(device, HysteresisCompensator, refusal).compensate(
                inverse.model.axis, inverse.model
            )
        if loop is not None:
            refusal = message("engine", "driver {name} cannot close a loop; use the simulator")
            require_ability(device, AxisRegulator, refusal).regulate(
                loop.regulation.axis, loop.regulation
            )
        device.play(checked)
        while device.status().state is DeviceState.PLAYING:
            clock.advance(_PROGRESS_PERIOD_S)
            recorder.add(device.read())
            if progress is not None:
                progress(device.status().progress)
        status = device.status()
    finally:
        device.close()
    record = recorder.finish()
    if record is None or not recorder.is_complete:
        raise DriverError(
            "{name}: playback ended early: {reason}",
            name=device.name,
            reason=status.fault or status.state,
        )
    return record


def _find_virtual_player(name: str) -> type[TrajectoryPlayer]:
    driver_type = find_driver(name)
    if not (issubclass(driver_type, TrajectoryPlayer) and driver_type.virtual_time):
        raise InputError(
            "driver {name} cannot play faster than real time; use the simulator", name=repr(name)
        )
    return driver_type
