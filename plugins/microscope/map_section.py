"""Map of the tip next to the picture: a click chooses a place, a button moves the tip there."""

import time
from functools import partial

import numpy as np

from rotemina.app.language import get_axis_label, translate_message
from rotemina.app.microscope import MicroscopeStatus
from rotemina.app.motion.session import SavedPositions
from rotemina.app.motion.state import SessionState
from rotemina.app.widgets.controls import ChangingButton, enable_unless, make_button
from rotemina.app.widgets.layout import Section
from rotemina.app.widgets.style import Theme
from rotemina.app.widgets.text import show_or_hide_text
from rotemina.app.workbench import Level, PendingConfirmation, Workbench
from rotemina.drivers.contract import Clock
from rotemina.plugins.microscope import tr
from rotemina.plugins.microscope.map_view import MapView
from rotemina.plugins.microscope.tip_map import MapPlace, PlaceKind, TipMap, TipTrail
from rotemina.sim.errors import InputError
from rotemina.sim.kinematics import TipWorkspace
from rotemina.sim.messages import format_fixed
from rotemina.sim.trajectory import check_target
from rotemina.sim.units import format_quantity

_TRAIL_PERIOD_S = 0.1
_FILE_CHECK_PERIOD_S = 1.0
# A second press sooner than this may be a double click, and does not count as a confirmation.
_MIN_CONFIRM_DELAY_S = 0.5


class MapSection(Section):
    """Section with the map of the tip. It records the trail even while it is hidden.

    *Go there* moves the axes by the safe route of saved positions: up, across, down. A long move
    needs a second press as confirmation. A stop cancels the confirmation.
    """

    def __init__(self, workbench: Workbench, clock: Clock = time.monotonic) -> None:
        super().__init__(tr("Map of the tip"))
        self._workbench, self._clock = workbench, clock
        self.trail = TipTrail()
        self.goal: MapPlace | None = None
        self._last_trail_point_s = self._last_file_check_s = float("-inf")
        # Modification time and size of the file of positions when it was last read.
        self._file_stamp: object = None
        self._known_places: list[MapPlace] = []
        # State of the file and of the cell list for which the known places were computed.
        self._known_places_key: object = None
        self._positions = SavedPositions(workbench.settings.folder, workbench.robot)
        self._pending_move: PendingConfirmation[MapPlace] = PendingConfirmation(workbench.session)
        self._question_time_s = 0.0
        self._was_fitted = False
        self.view = MapView(workbench.theme)
        self.status_label = self.add_text()
        self.go = ChangingButton(tr("Go there"), tr("Far away: go there?"), run=self._go_to_goal)
        self.go.setProperty("primary", True)
        self.fit_button = make_button(
            tr("Fit"), lambda: self.view.fit(whole_reach=False), tr("Show the trail and all places")
        )
        self.reach_button = make_button(
            tr("Reach"),
            lambda: self.view.fit(whole_reach=True),
            tr("Show everything within reach of the axes"),
        )
        self.clear = make_button(
            tr("Clear trail"), self._clear, tr("Clear the trail of the tip; nothing moves")
        )
        try:
            self._map: TipMap | None = TipMap(workbench.robot)
        except InputError as error:
            self._map = None
            self.status_label.setText(translate_message(str(error)))
            return
        self._reach = TipWorkspace.of(self._map.chain).hull
        # Button and map are near the top, so that they are visible even in a low window.
        self.column.insertWidget(1, self.go)
        self.column.insertWidget(2, self.view)
        self.add_row(self.fit_button, self.reach_button, self.clear)
        self.view.chosen.connect(self.choose)
        workbench.refreshed.connect(self._note_tip)
        workbench.theme_changed.connect(self._use_theme)

    def refresh(self, status: MicroscopeStatus, state: SessionState) -> None:
        """Show places and tip, and enable the actions that are possible now."""
        if self._map is None:
            return
        if self._pending_move.item is None:
            self.go.setText(tr("Go there"))
        places = self._collect_places(self._map)
        if self.goal is not None and self.goal.kind is not PlaceKind.FREE:
            # The place may have been saved again with other positions, or deleted.
            identity = (self.goal.kind, self.goal.name)
            saved_place = next(
                (place for place in places if (place.kind, place.name) == identity), None
            )
            if saved_place is None or saved_place.targets != self.goal.targets:
                self._set_goal(saved_place)
        tip = self._map.compute_tip(state.measured) if state.position_known else None
        zone = self._workbench.session.bounds.keep_out
        self.view.show_tip(tip, self.trail.points, self._reach, zone)
        self.view.show_places(places, self.goal)
        if not self._was_fitted and tip is not None:
            self._was_fitted = True
            self.view.fit(whole_reach=True)
        show_or_hide_text(self.status_label, self._describe_goal(self._map, state))
        goal_objection = None if self.goal is not None else tr("no place is chosen")
        motion_objection = None
        if not self._workbench.session.at_rest:
            motion_objection = tr("the machine is not at rest")
        lock_objection = translate_message(state.lock_reason) if state.lock_reason else None
        position_objection = None
        if not (state.position_known and state.command):
            position_objection = tr("the position is not known")
        tooltip = tr("Raise the tip above both places, move across, lower it")
        enable_unless(
            self.go,
            goal_objection or lock_objection or position_objection or motion_objection,
            tooltip,
        )

    def choose(self, place: MapPlace | None, x: float, y: float) -> None:
        """Choose a place, or the free place at x and y, m, if ``place`` is None. Nothing moves."""
        if place is None and self._map is not None:
            command = self._workbench.session.snapshot().command
            place = self._map.make_free_place(x, y, command)
        self._set_goal(place)

    def _set_goal(self, place: MapPlace | None) -> None:
        self.goal = place
        self._pending_move.withdraw()
        self.go.setText(tr("Go there"))

    def _go_to_goal(self) -> None:
        session, goal = self._workbench.session, self.goal
        if goal is None or self._map is None:
            # The place was deleted just before the press.
            text = tr("No move: no place is chosen. Choose one in the map.")
            self._workbench.notify(Level.WARNING, text, about=self)
            return
        for axis, target in goal.targets.items():
            if not self._workbench.run_request(
                partial(check_target, self._workbench.robot, axis, target)
            ):
                # An impossible move needs no confirmation.
                return
        permit = session.permit()
        if self._map.is_large_move(goal, session.snapshot().command):
            if self._pending_move.item != goal:
                self._pending_move.put(goal)
                self._question_time_s = self._clock()
                self.go.setText(tr("Far away: go there?"))
                return
            if self._clock() - self._question_time_s < _MIN_CONFIRM_DELAY_S:
                return
            permit = self._pending_move.permit
        self._pending_move.withdraw()
        self.go.setText(tr("Go there"))
        self._workbench.run_request(lambda: session.go_safely(goal.targets, permit=permit))

    def _clear(self) -> None:
        self.trail.clear()
        self.view.update()

    def _note_tip(self, state: SessionState) -> None:
        now_s = self._clock()
        if (
            self._map is None
            or now_s - self._last_trail_point_s < _TRAIL_PERIOD_S
            or not state.position_known
        ):
            return
        self._last_trail_point_s = now_s
        tip = self._map.compute_tip(state.measured)
        if tip is not None:
            self.trail.add(tip)

    def _use_theme(self, theme: Theme) -> None:
        self.view.set_theme(theme)

    def _collect_places(self, tip_map: TipMap) -> list[MapPlace]:
        self._read_positions()
        cells = self._workbench.operation.cells.cells
        if self._known_places_key == (self._file_stamp, cells):
            return self._known_places
        self._known_places_key = self._file_stamp, cells
        places = [
            *(
                tip_map.make_place(PlaceKind.SAVED, name, targets)
                for name, targets in self._positions.positions.items()
            ),
            *(
                tip_map.make_place(PlaceKind.CELL, str(cell.number), cell.positions, cell.outcome)
                for cell in cells
            ),
        ]
        self._known_places = [place for place in places if place is not None]
        return self._known_places

    def _read_positions(self) -> None:
        """Read the file of positions if it has changed. The panel Control reports errors in it."""
        now_s = self._clock()
        if now_s - self._last_file_check_s < _FILE_CHECK_PERIOD_S:
            return
        self._last_file_check_s = now_s
        try:
            file_status = self._positions.path.stat()
            stamp: object = (file_status.st_mtime_ns, file_status.st_size)
        except OSError:
            stamp = None
        if stamp != self._file_stamp:
            self._file_stamp = stamp
            try:
                self._positions.read()
            except InputError:
                return

    def _describe_goal(self, tip_map: TipMap, state: SessionState) -> str:
        goal = self.goal
        if goal is None:
            return tr("Click a place to choose it.")
        names = {
            PlaceKind.SAVED: tr("Position {name}"),
            PlaceKind.CELL: tr("Cell {name}"),
            PlaceKind.FREE: tr("Free place"),
        }
        lines = [names[goal.kind].format(name=goal.name)]
        position = ", ".join(format_fixed(1e3 * coordinate, 4) for coordinate in goal.tip_m)
        lines.append(tr("tip x, y, z [mm]: {place}").format(place=position))
        commanded_tip = tip_map.compute_tip(state.command)
        if commanded_tip is not None:
            distance = float(np.linalg.norm(np.array(goal.tip_m) - commanded_tip))
            longest_axis = max(
                (axis for axis in goal.targets if axis in state.command),
                key=lambda axis: (
                    abs(goal.targets[axis] - state.command[axis])
                    / self._workbench.robot.axes[axis].span
                ),
            )
            lines.append(
                tr("{way} from here; longest move: {axis}").format(
                    way=format_quantity(distance, "m", digits=3), axis=get_axis_label(longest_axis)
                )
            )
        return "\n".join(lines)
