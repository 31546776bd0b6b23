"""The map of the tip beside the picture: click to choose a place, press a button to go there."""

import time
from functools import partial

import numpy as np

from rotemina.app.display_units import label
from rotemina.app.microscope.status import MicroscopeStatus
from rotemina.app.motion.saved_positions import SavedPositions
from rotemina.app.motion.state import SessionState
from rotemina.app.shell.engine_words import spoken
from rotemina.app.shell.pending_confirmations import Pending
from rotemina.app.shell.theme import Theme
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.app.widgets.changing_button import ChangingButton
from rotemina.app.widgets.controls import allow, button
from rotemina.app.widgets.labels import show_text
from rotemina.app.widgets.section import Section
from rotemina.drivers.clock import Clock
from rotemina.plugins.microscope import tr
from rotemina.plugins.microscope.map_view import MapView
from rotemina.plugins.microscope.tip_map import MapPlace, PlaceKind, TipMap, Trail
from rotemina.sim.errors import InputError
from rotemina.sim.kinematics.workspace import Workspace
from rotemina.sim.quantities import amount, fixed
from rotemina.sim.trajectory.axis_limits import check_target

_NOTED_S = 0.1  # between two looks where the tip is
_FILE_S = 1.0  # between two looks at the file of positions
_SETTLE_S = 0.5  # a double click is no answer


class MapSection(Section):
    """Notes where the tip goes while nobody looks, too.

    A press of *Go there* sends the axes by the safe way of saved positions: up, across, down. A
    far way is confirmed by a second press, which a stop withdraws.
    """

    def __init__(self, workbench: Workbench, clock: Clock = time.monotonic) -> None:
        super().__init__(tr("Map of the tip"))
        self._bench, self._clock = workbench, clock
        self.trail = Trail()
        self.goal: MapPlace | None = None
        self._noted_s = self._read_s = float("-inf")
        self._file: object = None  # how the file of positions was when it was read
        self._known: list[MapPlace] = []
        self._known_for: object = None  # the file and the cells that these places are of
        self._positions = SavedPositions(workbench.settings.folder, workbench.robot)
        self._asked: Pending[MapPlace] = Pending(workbench.session)
        self._asked_s = 0.0
        self._fitted = False
        self.view = MapView(workbench.theme)
        self.said = self.add_text()
        self.go = ChangingButton(tr("Go there"), tr("Far away: go there?"), run=self._go)
        self.go.setProperty("primary", True)
        self.near = button(
            tr("Fit"), lambda: self.view.fit(whole=False), tr("Show the trail and all places")
        )
        self.whole = button(
            tr("Reach"),
            lambda: self.view.fit(whole=True),
            tr("Show everything within reach of the axes"),
        )
        self.clear = button(
            tr("Clear trail"), self._clear, tr("Clear the trail of the tip; nothing moves")
        )
        try:
            self._map: TipMap | None = TipMap(workbench.robot)
        except InputError as error:
            self._map = None
            self.said.setText(spoken(str(error)))
            return
        self._reach = Workspace.of(self._map.chain).hull
        self.column.insertWidget(1, self.go)  # in sight however low the window is
        self.column.insertWidget(2, self.view)
        self.add_row(self.near, self.whole, self.clear)
        self.view.chosen.connect(self.choose)
        workbench.refreshed.connect(self._note)
        workbench.theme_changed.connect(self._use_theme)

    # --- what happens -----------------------------------------------------------------------------

    def refresh(self, status: MicroscopeStatus, state: SessionState) -> None:
        """Show places and tip, and what can be done now."""
        if self._map is None:
            return
        if self._asked.what is None:
            self.go.setText(tr("Go there"))
        places = self._places(self._map)
        if self.goal is not None and self.goal.kind is not PlaceKind.FREE:
            # It may have been saved anew elsewhere, or be gone.
            same = (self.goal.kind, self.goal.name)
            now = next((one for one in places if (one.kind, one.name) == same), None)
            if now is None or now.targets != self.goal.targets:
                self._take(now)
        tip = self._map.tip(state.measured) if state.position_known else None
        zone = self._bench.session.bounds.keep_out
        self.view.show_tip(tip, self.trail.points, self._reach, zone)
        self.view.show_places(places, self.goal)
        if not self._fitted and tip is not None:
            self._fitted = True
            self.view.fit(whole=True)
        show_text(self.said, self._told(self._map, state))
        none = None if self.goal is not None else tr("no place is chosen")
        moves = None
        if not self._bench.session.at_rest:
            moves = tr("the machine is not at rest")
        locked = spoken(state.locked) if state.locked else None
        unknown = None
        if not (state.position_known and state.command):
            unknown = tr("the position is not known")
        tip_text = tr("Raise the tip above both places, move across, lower it")
        allow(self.go, none or locked or unknown or moves, tip_text)

    def choose(self, place: MapPlace | None, x: float, y: float) -> None:
        """Choose a place, or the free one at x and y, m, where none was hit; nothing moves."""
        if place is None and self._map is not None:
            command = self._bench.session.snapshot().command
            place = self._map.free(x, y, command)
        self._take(place)

    def _take(self, place: MapPlace | None) -> None:
        self.goal = place
        self._asked.withdraw()
        self.go.setText(tr("Go there"))

    def _go(self) -> None:
        session, goal = self._bench.session, self.goal
        if goal is None or self._map is None:  # the place was deleted just before the press
            text = tr("No move: no place is chosen. Choose one in the map.")
            self._bench.notify(Level.WARNING, text, about=self)
            return
        for axis, at in goal.targets.items():
            if not self._bench.ask(partial(check_target, self._bench.robot, axis, at)):
                return  # nobody is asked about a move that cannot be made
        permit = session.permit()
        if self._map.large(goal, session.snapshot().command):
            if self._asked.what != goal:
                self._asked.put(goal)
                self._asked_s = self._clock()
                self.go.setText(tr("Far away: go there?"))
                return
            if self._clock() - self._asked_s < _SETTLE_S:
                return
            permit = self._asked.permit
        self._asked.withdraw()
        self.go.setText(tr("Go there"))
        self._bench.ask(lambda: session.go_safely(goal.targets, permit=permit))

    def _clear(self) -> None:
        self.trail.clear()
        self.view.update()

    def _note(self, state: SessionState) -> None:
        """Note where the tip is."""
        now_s = self._clock()
        if self._map is None or now_s - self._noted_s < _NOTED_S or not state.position_known:
            return
        self._noted_s = now_s
        tip = self._map.tip(state.measured)
        if tip is not None:
            self.trail.add(tip)

    def _use_theme(self, theme: Theme) -> None:
        self.view.set_theme(theme)

    # --- places -----------------------------------------------------------------------------------

    def _places(self, tip_map: TipMap) -> list[MapPlace]:
        self._read_positions()
        cells = self._bench.operation.cells.cells
        if self._known_for == (self._file, cells):
            return self._known
        self._known_for = self._file, cells
        found = [
            *(
                tip_map.place(PlaceKind.SAVED, name, place)
                for name, place in self._positions.kept.items()
            ),
            *(
                tip_map.place(PlaceKind.CELL, str(one.number), one.place, one.outcome)
                for one in cells
            ),
        ]
        self._known = [one for one in found if one is not None]
        return self._known

    def _read_positions(self) -> None:
        """Read the file of positions where it has changed; what is wrong with it Control tells."""
        now_s = self._clock()
        if now_s - self._read_s < _FILE_S:
            return
        self._read_s = now_s
        try:
            about = self._positions.path.stat()
            file: object = (about.st_mtime_ns, about.st_size)
        except OSError:
            file = None
        if file != self._file:
            self._file = file
            try:
                self._positions.read()
            except InputError:
                return

    def _told(self, tip_map: TipMap, state: SessionState) -> str:
        """Say what is chosen, and how far it is from where the tip was sent."""
        goal = self.goal
        if goal is None:
            return tr("Click a place to choose it.")
        names = {
            PlaceKind.SAVED: tr("Position {name}"),
            PlaceKind.CELL: tr("Cell {name}"),
            PlaceKind.FREE: tr("Free place"),
        }
        lines = [names[goal.kind].format(name=goal.name)]
        there = ", ".join(fixed(1e3 * at, 4) for at in goal.tip_m)
        lines.append(tr("tip x, y, z [mm]: {place}").format(place=there))
        now = tip_map.tip(state.command)
        if now is not None:
            away = float(np.linalg.norm(np.array(goal.tip_m) - now))
            far = max(
                (axis for axis in goal.targets if axis in state.command),
                key=lambda axis: (
                    abs(goal.targets[axis] - state.command[axis])
                    / self._bench.robot.axes[axis].span
                ),
            )
            lines.append(
                tr("{way} from here; farthest: {axis}").format(
                    way=amount(away, "m", digits=3), axis=label(far)
                )
            )
        return "\n".join(lines)
