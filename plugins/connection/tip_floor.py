"""Section with the height of the tip above the taught floor.

Teaching or removing the floor needs a confirmation.
"""

from math import isfinite

from rotemina.app.motion.state import SessionState
from rotemina.app.widgets.controls import enable_unless, make_button
from rotemina.app.widgets.layout import InlineQuestion, Section
from rotemina.app.widgets.text import ValueGrid
from rotemina.app.workbench import Level, Workbench
from rotemina.plugins.connection import mark, tr, unavailable_reasons
from rotemina.sim.messages import format_fixed

# The question is cancelled if the tip has moved by more than this since it was asked.
_MAX_TIP_DRIFT_M = 1e-9
_VALUE_NAMES = (mark("Tip height"), mark("Floor"), mark("Above the floor"))


class TipFloorSection(Section):
    """Section with the heights of the tip and of the floor, and the distance between them."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(tr("Tip"))
        self._workbench = workbench
        self._height: float | None = None
        # The tip height, m, at which the operator was asked to confirm teaching. None unless that
        # question is open.
        self._height_when_asked: float | None = None
        self.figures = ValueGrid({tr(name): "" for name in _VALUE_NAMES})
        self.column.addWidget(self.figures)
        self.teach = make_button(tr("Teach floor …"), self._ask_to_teach)
        self.remove = make_button(tr("Remove floor …"), self._ask_to_remove)
        self.question = InlineQuestion()
        # The question is above the buttons that open it, where it is certain to be visible.
        self.column.addWidget(self.question)
        self.add_row(self.teach, self.remove)

    def refresh(self, state: SessionState) -> None:
        """Show the heights in this state."""
        zone = self._workbench.session.bounds.keep_out
        self._height = state.tip[2] if state.tip is not None and state.position_known else None
        floor = self._find_floor()
        height_above_floor = None if floor is None or self._height is None else self._height - floor
        self.figures.show_values(
            tr("unknown") if self._height is None else format_height(self._height),
            tr("none") if floor is None else format_height(floor),
            "–" if height_above_floor is None else format_height(height_above_floor),
        )
        teach_objection = unavailable_reasons.find_teach_objection(state, zone)
        enable_unless(
            self.teach,
            teach_objection,
            tr("Set the floor at the current height of the tip; the tip then cannot move below it"),
        )
        enable_unless(
            self.remove,
            unavailable_reasons.find_removal_objection(zone, state),
            tr("Remove the floor; only the axis ranges then limit the tip"),
        )
        self._cancel_outdated_question(teach_objection)

    def _cancel_outdated_question(self, teach_objection: str | None) -> None:
        if self.question.isHidden() or self._height_when_asked is None:
            return
        has_moved = (
            self._height is None or abs(self._height - self._height_when_asked) > _MAX_TIP_DRIFT_M
        )
        if has_moved or teach_objection is not None:
            self.question.hide()
            self._workbench.notify(
                Level.WARNING,
                tr(
                    "The tip has moved or motion was locked, so no floor was set. Try again when "
                    "the machine is at rest."
                ),
                about=self,
            )

    def _find_floor(self) -> float | None:
        zone = self._workbench.session.bounds.keep_out
        return zone.floor if zone is not None and isfinite(zone.floor) else None

    def _ask_to_teach(self) -> None:
        if self._height is None:
            return
        self._height_when_asked, floor = self._height, self._find_floor()
        floor_text = (
            tr("there is none")
            if floor is None
            else tr("it is at {height}").format(height=format_height(floor))
        )
        self.question.ask(
            tr(
                "Set the floor at {height}, the current height of the tip? At the moment, {old}."
            ).format(height=format_height(self._height), old=floor_text),
            tr("Set floor"),
            self._workbench.teach_floor,
        )

    def _ask_to_remove(self) -> None:
        floor = self._find_floor()
        if floor is None:
            return
        self._height_when_asked = None
        self.question.ask(
            tr(
                "Remove the floor at {height}? Without a floor only the axis ranges limit the tip."
            ).format(height=format_height(floor)),
            tr("Remove"),
            self._workbench.clear_floor,
        )


def format_height(metres: float) -> str:
    """Return a height in metres as text in millimetres."""
    return f"{format_fixed(1e3 * metres, 4)} mm"
