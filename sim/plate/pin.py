"""The pin as a beam on the hub whose bottom end is moved.

The motion of the bottom end is ``u = (zn, thx, thy)``: ``zn`` along the pin, and its sideways
motion divided by the length, ``thx = v_y / L``, ``thy = −v_x / L``, with the signs of the machine's
kinematics. The corresponding forces are the force along the pin and the moments about the pivot.

Source: S. P. Timoshenko, "On the correction for shear of the differential equation for transverse
vibrations of prismatic bars", Phil. Mag. 41 (1921); shear coefficient of the circle,
``6 (1 + ν) / (7 + 6 ν)``: G. R. Cowper, J. Appl. Mech. 33 (1966).
"""

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import PlateError
from rotemina.sim.robot import PlatePin, Robot

# Limits of the ratio of length to diameter within which the pin can be computed as a beam.
_MAX_SLENDERNESS_RATIO, _MIN_SLENDERNESS_RATIO = 200.0, 4.0


def pin_length(robot: Robot) -> float:
    """Return the length of the pin, m, as given for the plate or otherwise for the robot.

    Raises
    ------
    PlateError
        If neither is given, or the pin is too long or too short to be computed as a beam.
    """
    pin = robot.plate.pin
    length = pin.length if pin.length is not None else robot.pin_length
    if length is None:
        raise PlateError(
            "robot {name}: plate.pin.length: missing, and robot.pin_length too; give one",
            name=robot.name,
        )
    low, high = _MIN_SLENDERNESS_RATIO * pin.diameter, _MAX_SLENDERNESS_RATIO * pin.diameter
    if not low <= length <= high:
        raise PlateError(
            "robot {name}: plate.pin.length = {length} m: must be {low} to {high} m, "
            "{shortest} to {longest} times its diameter, because it is computed as a beam",
            name=robot.name,
            length=length,
            low=low,
            high=high,
            shortest=_MIN_SLENDERNESS_RATIO,
            longest=_MAX_SLENDERNESS_RATIO,
        )
    return length


def pin_compliance(pin: PlatePin, length: float) -> FloatArray:
    """Return the compliance (3, 3) of the pin: motion of its bottom end per force or moment.

    It is ``L / (E A)`` along the pin, and ``(L³ / (3 E I) + L / (κ G A)) / L²`` as an angle per
    moment.
    """
    area = np.pi / 4.0 * pin.diameter**2
    inertia = np.pi / 64.0 * pin.diameter**4
    shear_modulus = pin.youngs_modulus / (2.0 * (1.0 + pin.poissons_ratio))
    shear_coefficient = 6.0 * (1.0 + pin.poissons_ratio) / (7.0 + 6.0 * pin.poissons_ratio)
    bending = length / (3.0 * pin.youngs_modulus * inertia)
    tilt = bending + 1.0 / (shear_coefficient * shear_modulus * area * length)
    return np.diag([length / (pin.youngs_modulus * area), tilt, tilt])


def pin_stress(pin: PlatePin, force: FloatArray) -> float:
    """Return the largest stress in the pin, Pa, which is at its seat: bending and axial force."""
    section_modulus = np.pi / 32.0 * pin.diameter**3
    area = np.pi / 4.0 * pin.diameter**2
    return float(np.hypot(force[1], force[2]) / section_modulus + abs(force[0]) / area)
