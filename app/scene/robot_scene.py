"""The scene of one robot: its two superimposed ghosts (model and real), the dish and the cell."""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from rotemina.app.scene import robot_parts
from rotemina.app.scene.link_frames import LINK_PATHS, compute_link_frames, exaggerate_nano_motion
from rotemina.app.scene.scale_notes import ReadingAge, SceneTexts, make_note
from rotemina.app.scene.scene import SceneCommand, SceneCommandStore, set_property, set_transform
from rotemina.app.scene.solids import SceneSolid, SolidAppearance, set_object
from rotemina.app.scene.views import SceneViewpoint, make_view_command
from rotemina.sim.arrays import FloatArray
from rotemina.sim.kinematics import JOINTS, KeepOutZone, KinematicChain
from rotemina.sim.robot import Robot

ROBOT_PATH = "/robot"


class RobotGhost(StrEnum):
    """One of the two superimposed robots."""

    MODEL = "model"
    REAL = "real"


@dataclass(frozen=True, slots=True)
class SceneColours:
    """Colours of the painted parts, as ``#rrggbb``."""

    background: str
    fixed: str
    model: str
    real: str
    forbidden: str


@dataclass(frozen=True, slots=True)
class GhostPositions:
    """Positions of the two ghosts by axis, m or rad; axes with unknown position are missing.

    ``age_s`` is the age of the measured positions.
    """

    measured: Mapping[str, float]
    model: Mapping[str, float]
    age_s: float | None = None


class RobotScene:
    """Makes the drawing commands of a robot; a motion changes only transforms.

    Parameters
    ----------
    robot : Robot
    colours : SceneColours
    max_age_s : float
        Positions older than this are marked as old, s.
    texts : SceneTexts, optional
        Texts over the picture; English by default.

    Raises
    ------
    ChainError
        If the robot is not a hybrid chain.
    """

    def __init__(
        self,
        robot: Robot,
        colours: SceneColours,
        *,
        max_age_s: float,
        texts: SceneTexts | None = None,
    ) -> None:
        self.scene = SceneCommandStore()
        self.chain = KinematicChain.of(robot)
        self.exaggeration = 1.0
        self.shown_ghosts = frozenset(RobotGhost)
        self._colours = colours
        self._reading_age = ReadingAge(max_age_s)
        self._texts = texts or SceneTexts()
        self._reading = GhostPositions({}, {})
        self._zone: KeepOutZone | None = None
        self._axis_offsets = np.array([axis.offset for axis in robot.axes.values()])
        for path in ("/Grid", "/Axes"):
            self.scene.put(set_property(path, "visible", False))
        self.paint(colours)
        self.set_viewpoint(SceneViewpoint.ISO)

    def show_positions(self, reading: GhostPositions) -> None:
        """Draw both ghosts at their positions; a ghost whose position is unknown is hidden."""
        self._reading = reading
        positions = {RobotGhost.MODEL: reading.model, RobotGhost.REAL: reading.measured}
        joints = {ghost: self._compute_joints(positions[ghost]) for ghost in RobotGhost}
        commands: list[SceneCommand] = []
        for ghost, joint_values in joints.items():
            is_visible = joint_values is not None and ghost in self.shown_ghosts
            commands.append(set_property(f"{ROBOT_PATH}/{ghost}", "visible", is_visible))
            if joint_values is not None and is_visible:
                commands += self._make_transforms(ghost, joint_values)
        unknown_ghosts = frozenset(
            ghost for ghost, joint_values in joints.items() if joint_values is None
        )
        age_s = self._reading_age.round_if_old(reading.age_s)
        colours = {"model": self._colours.model, "real": self._colours.real}
        undrawn_ghosts = unknown_ghosts & self.shown_ghosts
        commands.append(
            make_note(
                self.shown_ghosts, undrawn_ghosts, age_s, self.exaggeration, colours, self._texts
            )
        )
        self.scene.put(*commands)

    def choose_ghosts(self, *ghosts: RobotGhost) -> None:
        """Draw only these ghosts."""
        self.shown_ghosts = frozenset(ghosts)
        self.show_positions(self._reading)

    def signal_alive(self, time_s: float) -> None:
        """Show viewers that the program is running, even if nothing moves."""
        self.scene.put({"type": "alive", "second": int(time_s)})

    def exaggerate(self, factor: float) -> None:
        """Draw the displacement of the nano stage from mid-range enlarged by a factor."""
        self.exaggeration = factor
        self.show_positions(self._reading)

    def set_viewpoint(self, view: SceneViewpoint) -> None:
        """Move the camera of every viewer to this viewpoint."""
        self.scene.put(make_view_command(self.chain, view), again=True)

    def show_bounds(self, zone: KeepOutZone | None) -> None:
        """Draw the bounds of the tip, and the dish at the lower bound."""
        if zone is not self._zone:
            self._zone = zone
            self._put_surroundings()

    def paint(self, colours: SceneColours) -> None:
        """Draw everything again in these colours."""
        self._colours = colours
        rgb = [int(colours.background[index : index + 2], 16) / 255 for index in (1, 3, 5)]
        for name in ("top_color", "bottom_color"):
            self.scene.put(set_property("/Background", name, rgb))
        appearances = {
            RobotGhost.MODEL: SolidAppearance(colours.model, 0.4, is_veil=True),
            RobotGhost.REAL: SolidAppearance(colours.real, 0.7),
        }
        for ghost, appearance in appearances.items():
            for part in robot_parts.make_moving_parts(self.chain):
                path = f"{ROBOT_PATH}/{ghost}/{LINK_PATHS[part.link]}/{part.name}"
                solid = SceneSolid(part.shape, part.centre_m, appearance)
                self.scene.put(set_object(path, solid))
        self._put_group(
            "base", robot_parts.make_fixed_parts(self.chain, SolidAppearance(colours.fixed))
        )
        self._put_surroundings()
        self.show_positions(self._reading)

    def _put_surroundings(self) -> None:
        zone, colours = self._zone, self._colours
        low, high, radius = (-np.inf, np.inf, np.inf) if zone is None else _get_limits(zone)
        floor = low if np.isfinite(low) else None
        glass = SolidAppearance("#9fc8d8", 0.25, is_veil=True)
        cell = SolidAppearance("#7fbf5f", 0.8)
        self._put_group("specimen", robot_parts.make_specimen(self.chain, floor, glass, cell))
        for name, height in (("floor", low), ("objective", high)):
            path, is_finite = f"{ROBOT_PATH}/bounds/{name}", bool(np.isfinite(height))
            self.scene.put(set_property(path, "visible", is_finite))
            if is_finite:
                forbidden = SolidAppearance(colours.forbidden, 0.3, is_veil=True)
                disc = robot_parts.make_bound_disc(self.chain, height, radius, forbidden)
                self.scene.put(set_object(path, disc))

    def _put_group(self, group: str, solids: Mapping[str, SceneSolid]) -> None:
        for name, solid in solids.items():
            self.scene.put(set_object(f"{ROBOT_PATH}/{group}/{name}", solid))

    def _make_transforms(self, ghost: RobotGhost, joints: FloatArray) -> list[SceneCommand]:
        poses = compute_link_frames(exaggerate_nano_motion(self.chain, joints, self.exaggeration))
        return [
            set_transform(f"{ROBOT_PATH}/{ghost}/{path}", poses[link])
            for link, path in LINK_PATHS.items()
        ]

    def _compute_joints(self, positions: Mapping[str, float]) -> FloatArray | None:
        """Compute the true joint positions (6,) from positions by axis; None if one is unknown."""
        if not all(np.isfinite(positions.get(axis, np.nan)) for axis in JOINTS):
            return None
        axes = self.chain.robot.axes
        true_positions = (
            np.array([positions.get(axis, np.nan) for axis in axes]) - self._axis_offsets
        )
        return self.chain.select_joints(true_positions)


def _get_limits(zone: KeepOutZone) -> tuple[float, float, float]:
    return zone.low, zone.high, zone.radius
