"""The scene of one robot: its two ghosts, model and real, around dish and cell."""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from rotemina.app.scene import robot_parts
from rotemina.app.scene.frames import LINKS, exaggerated, frames
from rotemina.app.scene.scale_notes import Old, Words, note
from rotemina.app.scene.scene import Command, Scene, set_property, set_transform
from rotemina.app.scene.solids import Look, Solid, set_object
from rotemina.app.scene.views import View, look
from rotemina.sim.arrays import FloatArray
from rotemina.sim.kinematics.chain import JOINTS, Chain
from rotemina.sim.kinematics.keep_out import KeepOutZone
from rotemina.sim.robot.model import Robot

ROOT = "/robot"


class Ghost(StrEnum):
    """The two robots that are drawn into each other."""

    MODEL = "model"
    REAL = "real"


@dataclass(frozen=True, slots=True)
class Colours:
    """Colours as ``#rrggbb``, by painted part."""

    background: str
    fixed: str
    model: str
    real: str
    forbidden: str


@dataclass(frozen=True, slots=True)
class Reading:
    """Positions of the two ghosts by axis, m or rad; empty where unknown."""

    measured: Mapping[str, float]
    model: Mapping[str, float]
    age_s: float | None = None


class RobotScene:
    """Fills a scene; only transforms change from one reading to the next.

    Parameters
    ----------
    robot : Robot
    colours : Colours
    old_s : float
        Age, s, from which a reading is called old.
    words : Words, optional
        What is written over the picture; English by default.

    Raises
    ------
    ChainError
        If the robot is no hybrid chain.
    """

    def __init__(
        self, robot: Robot, colours: Colours, *, old_s: float, words: Words | None = None
    ) -> None:
        self.scene = Scene()
        self.chain = Chain.of(robot)
        self.factor = 1.0
        self.shown = frozenset(Ghost)
        self._colours = colours
        self._old = Old(old_s)
        self._words = words or Words()
        self._reading = Reading({}, {})
        self._zone: KeepOutZone | None = None
        self._offset = np.array([axis.offset for axis in robot.axes.values()])
        for path in ("/Grid", "/Axes"):
            self.scene.put(set_property(path, "visible", False))
        self.paint(colours)
        self.look(View.ISO)

    # --- what is seen -----------------------------------------------------------------------------

    def show(self, reading: Reading) -> None:
        """Place both ghosts; one whose position is unknown is hidden."""
        self._reading = reading
        positions = {Ghost.MODEL: reading.model, Ghost.REAL: reading.measured}
        joints = {ghost: self._joints(positions[ghost]) for ghost in Ghost}
        commands: list[Command] = []
        for ghost, place in joints.items():
            seen = place is not None and ghost in self.shown
            commands.append(set_property(f"{ROOT}/{ghost}", "visible", seen))
            if place is not None and seen:
                commands += self._pose(ghost, place)
        unknown = frozenset(ghost for ghost, place in joints.items() if place is None)
        age_s = self._old.shown(reading.age_s)
        colours = {"model": self._colours.model, "real": self._colours.real}
        unseen = unknown & self.shown
        commands.append(note(self.shown, unseen, age_s, self.factor, colours, self._words))
        self.scene.put(*commands)

    def choose(self, *ghosts: Ghost) -> None:
        """Draw these ghosts and no others."""
        self.shown = frozenset(ghosts)
        self.show(self._reading)

    def alive(self, time_s: float) -> None:
        """Signal to viewers that the program is alive although nothing moves."""
        self.scene.put({"type": "alive", "second": int(time_s)})

    def exaggerate(self, factor: float) -> None:
        """Draw the nano stage's motion from mid-range that many times as large."""
        self.factor = factor
        self.show(self._reading)

    def look(self, view: View) -> None:
        """Turn every viewer's camera."""
        self.scene.put(look(self.chain, view), again=True)

    # --- what stands there ------------------------------------------------------------------------

    def bound(self, zone: KeepOutZone | None) -> None:
        """Draw the tip's bounds, and the dish on its floor."""
        if zone is not self._zone:
            self._zone = zone
            self._put_surroundings()

    def paint(self, colours: Colours) -> None:
        """Draw everything again in these colours."""
        self._colours = colours
        rgb = [int(colours.background[at : at + 2], 16) / 255 for at in (1, 3, 5)]
        for end in ("top_color", "bottom_color"):
            self.scene.put(set_property("/Background", end, rgb))
        looks = {
            Ghost.MODEL: Look(colours.model, 0.4, veil=True),
            Ghost.REAL: Look(colours.real, 0.7),
        }
        for ghost, appearance in looks.items():
            for part in robot_parts.moving_parts(self.chain):
                path = f"{ROOT}/{ghost}/{LINKS[part.link]}/{part.name}"
                solid = Solid(part.shape, part.middle, appearance)
                self.scene.put(set_object(path, solid))
        self._put_all("base", robot_parts.fixed_parts(self.chain, Look(colours.fixed)))
        self._put_surroundings()
        self.show(self._reading)

    def _put_surroundings(self) -> None:
        zone, colours = self._zone, self._colours
        low, high, radius = (-np.inf, np.inf, np.inf) if zone is None else _ends(zone)
        floor = low if np.isfinite(low) else None
        glass, living = Look("#9fc8d8", 0.25, veil=True), Look("#7fbf5f", 0.8)
        self._put_all("specimen", robot_parts.specimen(self.chain, floor, glass, living))
        for name, height in (("floor", low), ("objective", high)):
            path, seen = f"{ROOT}/bounds/{name}", bool(np.isfinite(height))
            self.scene.put(set_property(path, "visible", seen))
            if seen:
                forbidden = Look(colours.forbidden, 0.3, veil=True)
                disc = robot_parts.bound(self.chain, height, radius, forbidden)
                self.scene.put(set_object(path, disc))

    def _put_all(self, group: str, solids: Mapping[str, Solid]) -> None:
        for name, solid in solids.items():
            self.scene.put(set_object(f"{ROOT}/{group}/{name}", solid))

    def _pose(self, ghost: Ghost, joints: FloatArray) -> list[Command]:
        placed = frames(exaggerated(self.chain, joints, self.factor))
        return [
            set_transform(f"{ROOT}/{ghost}/{path}", placed[link]) for link, path in LINKS.items()
        ]

    def _joints(self, positions: Mapping[str, float]) -> FloatArray | None:
        """Return the true joints (6,) of readings by axis; None where one is unknown."""
        if not all(np.isfinite(positions.get(axis, np.nan)) for axis in JOINTS):
            return None
        axes = self.chain.robot.axes
        read = np.array([positions.get(axis, np.nan) for axis in axes]) - self._offset
        return self.chain.joints_of(read)


def _ends(zone: KeepOutZone) -> tuple[float, float, float]:
    return zone.low, zone.high, zone.radius
