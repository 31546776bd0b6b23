"""Texts about a solved plate."""

import numpy as np

from rotemina.app.language import get_axis_label
from rotemina.plugins.plate import mark, tr
from rotemina.plugins.plate.solution import SolvedPlate
from rotemina.sim.arrays import FloatArray
from rotemina.sim.messages import format_fixed
from rotemina.sim.plate import (
    AGREEMENT_TOLERANCE_RATIO,
    StressPoint,
    YieldSafety,
    compare_with_shipped_robot,
    mode_name,
    safety_at,
)
from rotemina.sim.robot import Plate
from rotemina.sim.units import format_percent

MESH_CHOICES = ((mark("Coarse mesh"), 60), (mark("Default mesh"), 120), (mark("Fine mesh"), 240))

# A point counts as being at the hub or the rim if it is closer than this, relative to the
# distance between them.
_EDGE_RATIO = 0.02

POSE_AXES = (("zn", "µm", 1e6), ("thx", "µrad", 1e6), ("thy", "µrad", 1e6))
EMPTY_TEXT = mark("Solve the plate of this robot to see its stress, its deformation and its modes.")


# English names of modes that the model returns. They are marked here for translation.
MODE_NAMES = (mark("hub along the pin"), mark("plate between hub and rim"))
_TILT_PREFIX = "hub tilts about "


def describe_pose(solved: SolvedPlate, pose: FloatArray) -> str:
    """Describe the stress and the reaction of the plate at a pose of the hub."""
    solutions = solved.solutions
    pose_safety = safety_at(solutions, pose)
    force, moment_x, moment_y = solutions.stiffness @ pose
    reaction = tr("Reaction {force:.1f} N; {x:.1f} and {y:.1f} N mm about x and y")
    lines = [reaction.format(force=force, x=1e3 * moment_x, y=1e3 * moment_y)]
    if np.any(pose):
        lines.insert(0, describe_safety(pose_safety, solutions.clamped.plate))
    return "\n".join(lines)


def describe_safety(plate_safety: YieldSafety, plate: Plate) -> str:
    """Describe the largest stress and the safety against yield, and warn if the plate yields."""
    text = tr(
        "{stress:.1f} MPa von Mises {place}; safety {factor:.2f} against yield at {limit:.0f} MPa"
    )
    sentence = text.format(
        stress=1e-6 * plate_safety.point.stress,
        place=describe_place(plate_safety.point, plate),
        factor=plate_safety.factor,
        limit=1e-6 * plate.yield_stress,
    )
    if plate_safety.factor < 1.0:
        return tr("THE PLATE YIELDS: {said}").format(said=sentence)
    return sentence


def describe_place(point: StressPoint, plate: Plate) -> str:
    """Describe where a point lies on the plate."""
    relative_radius = (point.radius - plate.hub_radius) / (plate.rim_radius - plate.hub_radius)
    text = tr("between hub and rim, r {radius:.2f} mm, {degrees:.0f}°")
    if relative_radius < _EDGE_RATIO:
        text = tr("at the hub, r {radius:.2f} mm, {degrees:.0f}°")
    elif relative_radius > 1.0 - _EDGE_RATIO:
        text = tr("at the rim, r {radius:.2f} mm, {degrees:.0f}°")
    degrees = np.degrees(point.direction) % 360.0
    return text.format(radius=1e3 * point.radius, degrees=degrees)


def describe_plate(solved: SolvedPlate) -> str:
    """Describe the stiffness of the plate and its safety over the whole range of motion."""
    solutions = solved.solutions
    axial, tilt_x, tilt_y = np.diag(solutions.stiffness)
    largest_difference = max(
        abs(entry.difference) for entry in compare_with_shipped_robot(solutions)
    )
    agreement_text = tr(
        "{axial:.3f} N/µm along the pin; {x:.4g} and {y:.4g} N m/rad in tilt: they agree with the "
        "shipped robot within {tolerance}"
    )
    disagreement_text = tr(
        "{axial:.3f} N/µm along the pin; {x:.4g} and {y:.4g} N m/rad in tilt: they do not agree "
        "with the shipped robot within {tolerance}"
    )
    template = (
        agreement_text if largest_difference <= AGREEMENT_TOLERANCE_RATIO else disagreement_text
    )
    range_text = tr("Whole range: {safety}, at {pose}")
    pose = ", ".join(
        f"{get_axis_label(name)} {format_fixed(per_si * value, 1)} {unit}"
        for (name, unit, per_si), value in zip(POSE_AXES, solved.lowest_safety.pose, strict=True)
    )
    return "\n".join(
        [
            template.format(
                axial=1e-6 * axial,
                x=tilt_x,
                y=tilt_y,
                tolerance=format_percent(AGREEMENT_TOLERANCE_RATIO),
            ),
            range_text.format(
                safety=describe_safety(solved.lowest_safety, solutions.clamped.plate), pose=pose
            ),
        ]
    )


def make_mode_titles(solved: SolvedPlate) -> list[str]:
    """Return a title for each mode: number, frequency and name."""
    modes = solved.modes
    return [
        f"{number}  {format_fixed(frequency, 0)} Hz  {_translate_mode(mode_name(hub))}"
        for number, (frequency, hub) in enumerate(
            zip(modes.frequencies_hz, modes.hub, strict=True), start=1
        )
    ]


def is_yielding(solved: SolvedPlate, pose: FloatArray) -> bool:
    """Return whether the plate yields at a pose of the hub."""
    return safety_at(solved.solutions, pose).factor < 1.0


def _translate_mode(name: str) -> str:
    axis_text = name.removeprefix(_TILT_PREFIX)
    if axis_text != name:
        return tr("hub tilts about {angle}").format(angle=axis_text)
    return tr(name)
