"""What the corrected model answers to new commands."""

from collections.abc import Iterator

from rotemina.sim.arrays import FloatArray
from rotemina.sim.gap.errors import GapError
from rotemina.sim.plant.assembly import assemble
from rotemina.sim.plant.response import nominal_response
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import Robot, StepperAxis

_PREFIX = "predicted "  # of the metadata that say how a record came about
_OTHER_PREFIX = "simulated "
_ANSWERS = (Tap.U, Tap.REF, Tap.MEAS)


def predict(robot: Robot, commands: Record) -> Record:
    """Return the record that a model expects of commands: without noise, rounding and chance.

    The run starts as a diagnosis starts it: at rest at the first command, in the steady state of a
    periodic file, or for a record of unknown history where its first rows were measured.

    Parameters
    ----------
    robot : Robot
        The corrected one: its effects act.
    commands : Record
        Its ``cmd`` (and ``add``; ``u`` of axes that a force moves) drive the model.

    Returns
    -------
    Record
        ``cmd``, ``u`` (not of steppers), ``ref`` and ``meas`` of the axes of ``commands``. Its
        metadata are those of ``commands``, and what robot and effects it comes from.

    Raises
    ------
    GapError
        If an axis of the commands is none of the robot's, or in units of another quantity.
    PlantError, EffectError
        If the model cannot be simulated.
    """
    _check_axes(robot, commands)
    response = nominal_response(robot, commands)
    signals: dict[tuple[str, Tap], FloatArray] = {}
    for axis in commands.axes:
        for tap in (Tap.CMD, Tap.ADD):
            if commands.has(axis, tap):
                signals[axis, tap] = commands.signal(axis, tap)
        for tap in _ANSWERS:
            if tap is not Tap.U or not isinstance(robot.axes[axis], StepperAxis):
                signals[axis, tap] = response.signal(axis, tap)
    metadata = dict(_metadata(robot, commands))
    return Record.from_signals(commands.time_s, signals, commands.units, metadata)


def _check_axes(robot: Robot, commands: Record) -> None:
    for axis in commands.axes:
        if axis not in robot.axes:
            raise GapError(
                f"axis {axis!r} of the commands: the diagnosed robot {robot.name!r} has "
                f"{', '.join(robot.axes)}"
            )
        unit = robot.unit(axis)
        if unit is not None and commands.units[axis] != unit:
            raise GapError(
                f"axis {axis!r} of the commands is in units of {commands.units[axis]}, but the "
                f"diagnosed robot {robot.name!r} moves it in units of {unit}; correct the unit"
            )


def _metadata(robot: Robot, commands: Record) -> Iterator[tuple[str, str]]:
    measured = any(commands.has(axis, tap) for axis in commands.axes for tap in _ANSWERS[1:])
    for key, value in commands.metadata.items():
        # A model that nothing measured tells where it was begins at rest.
        at_rest = key == "history" and value == "unknown" and not measured
        if not at_rest and not key.startswith((_PREFIX, _OTHER_PREFIX)):
            yield key, value
    yield f"{_PREFIX}by", "the corrected model of a gap diagnosis"
    yield f"{_PREFIX}robot", " ".join(robot.name.split())
    for number, one in enumerate(assemble(robot, commands.axes).effects, start=1):
        yield f"{_PREFIX}effect {number}", str(one)
