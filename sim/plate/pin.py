"""The pin as a beam on the hub, driven by the position of its bottom.

``u = (zn, thx, thy)`` with the bottom's own motion: ``w`` along the pin, and its sideways motion
over the length, ``thx = v_y / L``, ``thy = −v_x / L``, counted as the machine's kinematics does.
Forces that belong to it are the force along the pin and the moments about the pivot.

Source: S. P. Timoshenko, "On the correction for shear of the differential equation for transverse
vibrations of prismatic bars", Phil. Mag. 41 (1921); shear coefficient of the circle,
``6 (1 + ν) / (7 + 6 ν)``: G. R. Cowper, J. Appl. Mech. 33 (1966).
"""

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.messages import message
from rotemina.sim.plate.errors import PlateError
from rotemina.sim.robot.model import Robot
from rotemina.sim.robot.plate import Pin

_LONGEST, _SHORTEST = 200.0, 4.0  # lengths over diameter of what is a beam and no thread or block


def pin_length(robot: Robot) -> float:
    """Return the pin's length: the plate's own figure, or else the robot's, m.

    Raises
    ------
    PlateError
        If there is neither, or the pin is no beam.
    """
    pin = robot.plate.pin
    length = pin.length if pin.length is not None else robot.pin_length
    if length is None:
        raise PlateError(
            message(
                "engine",
                "robot {name}: plate.pin.length: missing, and robot.pin_length too; give one",
            ).fill(name=robot.name)
        )
    low, high = _SHORTEST * pin.diameter, _LONGEST * pin.diameter
    if not low <= length <= high:
        raise PlateError(
            message(
                "engine",
                "robot {name}: plate.pin.length = {length} m: must be {low} to {high} m, "
                "{shortest} to {longest} times its diameter, because it is computed as a beam",
            ).fill(
                name=robot.name,
                length=length,
                low=low,
                high=high,
                shortest=_SHORTEST,
                longest=_LONGEST,
            )
        )
    return length


def compliance(pin: Pin, length: float) -> FloatArray:
    """Return the pin's own part of the motion of its bottom per force, (3, 3).

    ``L / (E A)`` along it; as an angle, ``(L³ / (3 E I) + L / (κ G A)) / L²`` per moment.
    """
    area = np.pi / 4.0 * pin.diameter**2
    inertia = np.pi / 64.0 * pin.diameter**4
    shear_modulus = pin.youngs_modulus / (2.0 * (1.0 + pin.poissons_ratio))
    ratio = 6.0 * (1.0 + pin.poissons_ratio) / (7.0 + 6.0 * pin.poissons_ratio)
    bending = length / (3.0 * pin.youngs_modulus * inertia)
    tilt = bending + 1.0 / (ratio * shear_modulus * area * length)
    return np.diag([length / (pin.youngs_modulus * area), tilt, tilt])


def pin_stress(pin: Pin, force: FloatArray) -> float:
    """Return the largest stress in the pin, at its seat: bending and force along it, Pa."""
    section = np.pi / 32.0 * pin.diameter**3
    area = np.pi / 4.0 * pin.diameter**2
    return float(np.hypot(force[1], force[2]) / section + abs(force[0]) / area)
