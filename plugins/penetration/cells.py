"""A cell for demonstrations: the effect `contact` on the axis of a simulated machine."""

from rotemina.app.display import label
from rotemina.app.motion.penetration.errors import PenetrationError
from rotemina.app.shell.language import translate
from rotemina.plugins.penetration.plan_preview import way_text
from rotemina.sim.effects.attachment import Attached
from rotemina.sim.robot.model import AxisEffect, Robot

Effects = tuple[AxisEffect, ...]

CONTACT = "contact"
#: Where a cell is put and how stiff it is beside the axis itself, unless told otherwise.
AHEAD, STIFFNESS = 5e-6, 0.1


def with_cell(
    robot: Robot, effects: Effects, axis: str, at: float, sign: float, stiffness: float
) -> Effects:
    """Return effects with one cell on an axis; others are kept, another cell there is moved.

    Parameters
    ----------
    at : float
        Position of the axis at which the tip meets it, m.
    sign : float
        Which way the tip goes then.
    stiffness : float
        Over the axis' own.

    Raises
    ------
    PenetrationError
        If it would not be within the axis' range.
    EffectError
        If the effect does not take such values.
    """
    low, _ = robot.axes[axis].range
    bare = Attached.of(robot, AxisEffect(axis=axis, id=CONTACT))
    place, parameter = at - low, bare.formulation.parameter("place")
    assert parameter is not None, "every contact is somewhere"
    least, most = parameter.bounds(bare.facts)
    if not least <= place <= most:
        raise PenetrationError(
            translate(
                "penetration",
                "a cell at {at} of {axis}: must be {least} to {most}; move the axis away "
                "from its end first",
            ).format(
                at=way_text(at),
                axis=label(axis),
                least=way_text(low + least),
                most=way_text(low + most),
            )
        )
    values = {"place": place, "stiffness": sign * stiffness}
    asked = AxisEffect(axis=axis, id=CONTACT, parameters=values)
    Attached.of(robot, asked)
    return (*without_cell(effects, axis), asked)


def without_cell(effects: Effects, axis: str) -> Effects:
    """Return effects without the cells on an axis."""
    return tuple(one for one in effects if not _is_cell(one, axis))


def cells_text(robot: Robot, effects: Effects, axis: str) -> str:
    """Return where the cells on an axis are, in words."""
    low, _ = robot.axes[axis].range
    places = []
    for one in effects:
        if _is_cell(one, axis) and one.enabled:
            values = Attached.of(robot, one).values
            places.append(
                translate("penetration", "{at} of {axis}").format(
                    at=way_text(low + values["place"]), axis=label(axis)
                )
            )
    return (
        translate("penetration", "A cell at {places}.").format(
            places=translate("penetration", " and ").join(places)
        )
        if places
        else translate("penetration", "There is no cell.")
    )


def _is_cell(one: AxisEffect, axis: str) -> bool:
    return one.id == CONTACT and one.axis == axis
