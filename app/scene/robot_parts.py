"""The drawn parts of the robot.

Travel, pin length, lever arm of the piezos and the cell come from the robot file and what is made
of it. Everything else only lets one recognise the machine: plates of 90 mm for the tables, a dish
of 35 mm. Nothing is computed from a part.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from rotemina.app.scene.solids import Look, Point, Shape, Solid, box, ellipsoid, tube
from rotemina.sim.arrays import FloatArray
from rotemina.sim.kinematics.chain import TABLES, Chain
from rotemina.sim.kinematics.forward import tip_position
from rotemina.sim.microscope.cell import Cell

PLATE = 0.090  # m, side of a table
_RAIL, _CARRIAGE = 0.025, 0.020  # m, heights of a table's two halves
_BACK = 0.120  # m, from the pivot back to the middle of the tables: the dish stays free
_LEVER = 0.045  # m, where a robot file says nothing
DISH_RADIUS, _DISH_WALL, _GLASS = 0.0175, 0.010, 0.5e-3


class Part(NamedTuple):
    """A named shape about a point, m, of a link's frame."""

    link: str
    name: str
    shape: Shape
    middle: Point


def cell_of(chain: Chain) -> Cell:
    """Return the cell that the simulated microscope shows, beside the tip in mid-range."""
    x, y, z = (float(value) for value in tip_position(chain, chain.centre))
    return Cell.beside((x, y, z))


def moving_parts(chain: Chain) -> Iterator[Part]:
    """Give the parts of one ghost, by the link that carries each."""
    yield from _tables(chain)
    yield from _nano_stage(chain)


def fixed_parts(chain: Chain, look: Look) -> dict[str, Solid]:
    """Return the fixed parts: the base, and the rail of the lowest table."""
    (x_low, *_), (x_high, *_) = chain.lower[TABLES], chain.upper[TABLES]
    _, y_middle, _ = chain.centre[TABLES]
    top = _stack_top(chain) - 2 * (_RAIL + _CARRIAGE)
    middle_x, width = (x_low + x_high) / 2, PLATE + x_high - x_low
    back = float(y_middle) + _BACK
    rail = Solid(box(width, PLATE, _RAIL), (middle_x, back, top + _RAIL / 2), look)
    base = Solid(box(1.3 * width, 1.8 * PLATE, 0.01), (middle_x, back, top - 0.005), look)
    return {"rail": rail, "base": base}


def specimen(chain: Chain, floor: float | None, glass: Look, living: Look) -> dict[str, Solid]:
    """Return dish and cell; the dish's bottom is the tip's ``floor``, m, or just below the cell."""
    cell = cell_of(chain)
    x, y, z = cell.centre_m
    bottom = z - cell.radii_m[2] if floor is None else floor
    centre_x, centre_y, _ = tip_position(chain, chain.centre).tolist()
    wall = tube(DISH_RADIUS, _DISH_WALL, open_=True)
    return {
        "dish": Solid(tube(DISH_RADIUS, _GLASS), (centre_x, centre_y, bottom - _GLASS / 2), glass),
        "wall": Solid(wall, (centre_x, centre_y, bottom + _DISH_WALL / 2), glass),
        "cell": Solid(ellipsoid(cell.radii_m), (x, y, z), living),
    }


def bound(chain: Chain, height: float, radius: float, look: Look) -> Solid:
    """Return a thin disc at a height, m, that bounds the tip; ``radius`` may be infinite."""
    x, y, _ = tip_position(chain, chain.centre).tolist()
    travel = (chain.upper - chain.lower)[TABLES]
    reach = float(np.hypot(travel[0], travel[1]) / 2)
    return Solid(tube(min(radius, reach), 2e-5), (x, y, height - 1e-5), look)


def _stack_top(chain: Chain) -> float:
    """Return the height, m, of the y table's plate: below the lowest tip."""
    return float(chain.lower[2]) - chain.pin_length


def _tables(chain: Chain) -> Iterator[Part]:
    travel: FloatArray = (chain.upper - chain.lower)[TABLES]
    low, middle = chain.lower[TABLES], chain.centre[TABLES]
    top = _stack_top(chain)
    plate = box(PLATE, PLATE, _CARRIAGE)
    rail_height = top - _CARRIAGE - _RAIL / 2
    # Every table's rail stands in the frame of the carriage below it.
    yield Part("x", "carriage", plate, (0.0, middle[1] + _BACK, rail_height - 0.0225))
    rail = box(PLATE, PLATE + float(travel[1]), _RAIL)
    yield Part("x", "rail", rail, (0.0, middle[1] + _BACK, rail_height))
    yield Part("y", "carriage", plate, (0.0, _BACK, top - _CARRIAGE / 2))
    height = PLATE + float(travel[2])
    column_middle = top + height / 2
    yield Part("y", "column", box(PLATE, 0.03, height), (0.0, _BACK, column_middle))
    # At its lowest the z carriage stands at the column's foot.
    lift = top + PLATE / 2 - float(low[2])
    yield Part("z", "carriage", box(PLATE, 0.015, PLATE), (0.0, _BACK - 0.0225, lift))


def _nano_stage(chain: Chain) -> Iterator[Part]:
    lever = chain.robot.piezo_lever_arm or _LEVER
    reach = lever + 0.008
    front, back = reach - 0.006, _BACK - 0.030
    arm = box(0.05, back - front, 0.012)
    yield Part("z", "arm", arm, (0.0, (front + back) / 2, 0.027))
    yield Part("z", "housing", tube(reach, 0.010), (0.0, 0.0, 0.027))
    piezo = tube(0.005, 0.014)  # PA 50/14
    for name, x, y in (("piezo zn", 0.0, 0.0), ("piezo thx", 0.0, lever), ("piezo thy", lever, 0)):
        yield Part("z", name, piezo, (x, float(y), 0.015))
    yield Part("tilt", "plate", tube(reach, 0.004), (0.0, 0.0, 0.006))
    yield Part("tilt", "flexure", ellipsoid((0.005, 0.005, 0.005)), (0.0, 0.0, 0.0))
    length = chain.pin_length
    holder, glass = 0.45 * length, 0.55 * length
    yield Part("pin", "holder", tube(0.003, holder), (0.0, 0.0, -holder / 2))
    pin = tube(0.0008, glass, foot=1e-6)
    yield Part("pin", "pin", pin, (0.0, 0.0, -holder - glass / 2))
