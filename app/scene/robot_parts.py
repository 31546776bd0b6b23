"""The drawn parts of the robot.

Travel, pin length, lever arm of the piezos and the cell come from the robot file. All other
dimensions are schematic, such as plates of 90 mm for the tables and a dish of 35 mm. They only make
the machine recognisable, and no computation uses them.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from rotemina.app.scene.solids import (
    Coordinates,
    SceneSolid,
    SolidAppearance,
    SolidShape,
    make_box,
    make_ellipsoid,
    make_tube,
)
from rotemina.sim.arrays import FloatArray
from rotemina.sim.kinematics import TABLES, KinematicChain, compute_tip_position
from rotemina.sim.microscope import SimulatedCell

PLATE_SIDE_M = 0.090
_RAIL_HEIGHT_M, _CARRIAGE_HEIGHT_M = 0.025, 0.020
# The tables stand this far behind the pivot, so that they do not hide the dish.
_TABLE_SETBACK_M = 0.120
# Used if a robot file does not state the lever arm of the piezos.
_DEFAULT_LEVER_M = 0.045
DISH_RADIUS_M, _DISH_WALL_HEIGHT_M, _GLASS_THICKNESS_M = 0.0175, 0.010, 0.5e-3


class RobotPart(NamedTuple):
    """A named shape whose centre is given in the frame of a link, m."""

    link: str
    name: str
    shape: SolidShape
    centre_m: Coordinates


def make_cell(chain: KinematicChain) -> SimulatedCell:
    """Return the cell of the simulated microscope, next to the mid-range position of the tip."""
    x, y, z = (float(value) for value in compute_tip_position(chain, chain.centre))
    return SimulatedCell.near_view_centre((x, y, z))


def make_moving_parts(chain: KinematicChain) -> Iterator[RobotPart]:
    """Yield the moving parts of one ghost, each in the frame of its link."""
    yield from _make_table_parts(chain)
    yield from _make_nano_parts(chain)


def make_fixed_parts(chain: KinematicChain, appearance: SolidAppearance) -> dict[str, SceneSolid]:
    """Return the fixed parts by name: the base, and the rail of the lowest table."""
    (x_low, *_), (x_high, *_) = chain.lower[TABLES], chain.upper[TABLES]
    _, y_centre, _ = chain.centre[TABLES]
    base_top = _compute_stack_top(chain) - 2 * (_RAIL_HEIGHT_M + _CARRIAGE_HEIGHT_M)
    x_centre, width = (x_low + x_high) / 2, PLATE_SIDE_M + x_high - x_low
    table_y = float(y_centre) + _TABLE_SETBACK_M
    rail = SceneSolid(
        make_box(width, PLATE_SIDE_M, _RAIL_HEIGHT_M),
        (x_centre, table_y, base_top + _RAIL_HEIGHT_M / 2),
        appearance,
    )
    base = SceneSolid(
        make_box(1.3 * width, 1.8 * PLATE_SIDE_M, 0.01),
        (x_centre, table_y, base_top - 0.005),
        appearance,
    )
    return {"rail": rail, "base": base}


def make_specimen(
    chain: KinematicChain,
    floor: float | None,
    glass: SolidAppearance,
    cell_appearance: SolidAppearance,
) -> dict[str, SceneSolid]:
    """Return the solids of dish and cell by name.

    The bottom of the dish is at the ``floor`` of the tip, m; if that is None, at the lower side of
    the cell.
    """
    cell = make_cell(chain)
    x, y, z = cell.centre_m
    dish_bottom = z - cell.radii_m[2] if floor is None else floor
    centre_x, centre_y, _ = compute_tip_position(chain, chain.centre).tolist()
    wall = make_tube(DISH_RADIUS_M, _DISH_WALL_HEIGHT_M, open_=True)
    return {
        "dish": SceneSolid(
            make_tube(DISH_RADIUS_M, _GLASS_THICKNESS_M),
            (centre_x, centre_y, dish_bottom - _GLASS_THICKNESS_M / 2),
            glass,
        ),
        "wall": SceneSolid(
            wall, (centre_x, centre_y, dish_bottom + _DISH_WALL_HEIGHT_M / 2), glass
        ),
        "cell": SceneSolid(make_ellipsoid(cell.radii_m), (x, y, z), cell_appearance),
    }


def make_bound_disc(
    chain: KinematicChain, height: float, radius: float, appearance: SolidAppearance
) -> SceneSolid:
    """Return a thin disc at a height, m, that shows the lower or upper bound of the tip.

    ``radius``, m, may be infinite; then the disc covers the travel of the tables.
    """
    x, y, _ = compute_tip_position(chain, chain.centre).tolist()
    travel = (chain.upper - chain.lower)[TABLES]
    travel_radius = float(np.hypot(travel[0], travel[1]) / 2)
    disc = make_tube(min(radius, travel_radius), 2e-5)
    return SceneSolid(disc, (x, y, height - 1e-5), appearance)


def _compute_stack_top(chain: KinematicChain) -> float:
    """Return the height, m, of the plate of the y table, which is the lowest height of the tip."""
    return float(chain.lower[2]) - chain.pin_length


def _make_table_parts(chain: KinematicChain) -> Iterator[RobotPart]:
    travel: FloatArray = (chain.upper - chain.lower)[TABLES]
    low, centre = chain.lower[TABLES], chain.centre[TABLES]
    stack_top = _compute_stack_top(chain)
    plate = make_box(PLATE_SIDE_M, PLATE_SIDE_M, _CARRIAGE_HEIGHT_M)
    rail_height = stack_top - _CARRIAGE_HEIGHT_M - _RAIL_HEIGHT_M / 2
    # The rail of each table is fixed to the carriage below it.
    yield RobotPart(
        "x", "carriage", plate, (0.0, centre[1] + _TABLE_SETBACK_M, rail_height - 0.0225)
    )
    rail = make_box(PLATE_SIDE_M, PLATE_SIDE_M + float(travel[1]), _RAIL_HEIGHT_M)
    yield RobotPart("x", "rail", rail, (0.0, centre[1] + _TABLE_SETBACK_M, rail_height))
    carriage_height = stack_top - _CARRIAGE_HEIGHT_M / 2
    yield RobotPart("y", "carriage", plate, (0.0, _TABLE_SETBACK_M, carriage_height))
    column_length = PLATE_SIDE_M + float(travel[2])
    column = make_box(PLATE_SIDE_M, 0.03, column_length)
    column_centre = (0.0, _TABLE_SETBACK_M, stack_top + column_length / 2)
    yield RobotPart("y", "column", column, column_centre)
    # At the lower end of its range the z carriage is at the bottom of the column.
    z_carriage_height = stack_top + PLATE_SIDE_M / 2 - float(low[2])
    yield RobotPart(
        "z",
        "carriage",
        make_box(PLATE_SIDE_M, 0.015, PLATE_SIDE_M),
        (0.0, _TABLE_SETBACK_M - 0.0225, z_carriage_height),
    )


def _make_nano_parts(chain: KinematicChain) -> Iterator[RobotPart]:
    lever = chain.robot.piezo_lever_arm or _DEFAULT_LEVER_M
    plate_radius = lever + 0.008
    front, back = plate_radius - 0.006, _TABLE_SETBACK_M - 0.030
    arm = make_box(0.05, back - front, 0.012)
    yield RobotPart("z", "arm", arm, (0.0, (front + back) / 2, 0.027))
    yield RobotPart("z", "housing", make_tube(plate_radius, 0.010), (0.0, 0.0, 0.027))
    # Size of the piezo actuator PA 50/14.
    piezo = make_tube(0.005, 0.014)
    for name, x, y in (("piezo zn", 0.0, 0.0), ("piezo thx", 0.0, lever), ("piezo thy", lever, 0)):
        yield RobotPart("z", name, piezo, (x, float(y), 0.015))
    yield RobotPart("tilt", "plate", make_tube(plate_radius, 0.004), (0.0, 0.0, 0.006))
    yield RobotPart("tilt", "flexure", make_ellipsoid((0.005, 0.005, 0.005)), (0.0, 0.0, 0.0))
    holder_length, glass_length = 0.45 * chain.pin_length, 0.55 * chain.pin_length
    holder = make_tube(0.003, holder_length)
    yield RobotPart("pin", "holder", holder, (0.0, 0.0, -holder_length / 2))
    pin = make_tube(0.0008, glass_length, foot_radius=1e-6)
    yield RobotPart("pin", "pin", pin, (0.0, 0.0, -holder_length - glass_length / 2))
