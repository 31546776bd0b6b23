"""The tip's height above its floor; teaching and removing it asks first."""

from math import isfinite

from rotemina.app.motion.state import SessionState
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.app.widgets.controls import allow, button
from rotemina.app.widgets.figures import Figures
from rotemina.app.widgets.inline_question import Question
from rotemina.app.widgets.section import Section
from rotemina.plugins.connection import mark, tr, unavailable_reasons
from rotemina.sim.quantities import fixed

_STILL_M = 1e-9  # a tip that has moved more than this is not where the question was asked
_FIGURES = (mark("Tip height"), mark("Floor"), mark("Above the floor"))


class TipSection(Section):
    """Tip, floor and what is between them."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(tr("Tip"))
        self._workbench = workbench
        self._height: float | None = None
        self._asked: float | None = None  # the tip's height at which a floor is to be taught
        self.figures = Figures({tr(name): "" for name in _FIGURES})
        self.column.addWidget(self.figures)
        self.teach = button(tr("Teach floor …"), self._ask_teach)
        self.remove = button(tr("Remove floor …"), self._ask_remove)
        self.question = Question()
        self.column.addWidget(self.question)  # above what asks it, which is in sight
        self.add_row(self.teach, self.remove)

    def refresh(self, state: SessionState) -> None:
        """Show a state."""
        zone = self._workbench.session.bounds.keep_out
        known = state.tip is not None and state.position_known
        self._height = state.tip[2] if known and state.tip is not None else None
        floor = self._floor()
        above = None if floor is None or self._height is None else self._height - floor
        self.figures.show_values(
            tr("unknown") if self._height is None else height(self._height),
            tr("none") if floor is None else height(floor),
            "–" if above is None else height(above),
        )
        why = unavailable_reasons.against_teaching(state, zone)
        allow(
            self.teach,
            why,
            tr("Set the floor at the present height of the tip; nothing moves below it"),
        )
        allow(
            self.remove,
            unavailable_reasons.against_removing(zone, state),
            tr("Remove the lower limit of the tip; only the axis ranges remain"),
        )
        self._withdraw(why)

    def _withdraw(self, why: str | None) -> None:
        """Take a question back that the machine has overtaken."""
        if self.question.isHidden() or self._asked is None:
            return
        moved = self._height is None or abs(self._height - self._asked) > _STILL_M
        if moved or why is not None:
            self.question.hide()
            self._workbench.notify(
                Level.WARNING,
                tr("The tip has moved, so no floor was set. Try again when it is at rest."),
                about=self,
            )

    def _floor(self) -> float | None:
        zone = self._workbench.session.bounds.keep_out
        return zone.floor if zone is not None and isfinite(zone.floor) else None

    def _ask_teach(self) -> None:
        if self._height is None:
            return
        self._asked, floor = self._height, self._floor()
        old = (
            tr("there is none")
            if floor is None
            else tr("it is at {height}").format(height=height(floor))
        )
        self.question.ask(
            tr("Set the floor at {height}, the present height of the tip? So far {old}.").format(
                height=height(self._height), old=old
            ),
            tr("Set floor"),
            self._workbench.teach_floor,
        )

    def _ask_remove(self) -> None:
        floor = self._floor()
        if floor is None:
            return
        self._asked = None
        self.question.ask(
            tr(
                "Remove the floor at {height}? Without a floor only the axis ranges limit the tip."
            ).format(height=height(floor)),
            tr("Remove"),
            self._workbench.clear_floor,
        )


def height(metres: float) -> str:
    """Return a height as text."""
    return f"{fixed(1e3 * metres, 4)} mm"
