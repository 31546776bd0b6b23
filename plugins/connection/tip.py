"""The tip's height above its floor: taught and taken away only after a question."""

from collections.abc import Callable
from math import isfinite

from PySide6.QtWidgets import QFrame, QHBoxLayout, QVBoxLayout

from rotemina.app.motion.state import SessionState
from rotemina.app.shell.controls import allow
from rotemina.app.shell.language import marked, translate
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.plugins.connection import reasons
from rotemina.plugins.connection.section import Figures, Section, button, quiet_text

_STILL_M = 1e-9  # a tip that has moved more than this is not where the question was asked
_FIGURES = (
    marked("connection", "Tip height"),
    marked("connection", "Floor"),
    marked("connection", "Above the floor"),
)


class Question(QFrame):
    """A question inside the panel: everything else, the stop among it, stays within reach."""

    def __init__(self) -> None:
        super().__init__()
        self.setObjectName("question")
        self.text = quiet_text()
        self.text.setProperty("quiet", False)
        self.yes = button(translate("connection", "Yes"), self._agree)
        self.yes.setToolTip(translate("connection", "Do what the question asks"))
        self.no = button(translate("connection", "Cancel"), self.hide)
        self.no.setToolTip(translate("connection", "Leave it as it is"))
        row = QHBoxLayout()
        row.setSpacing(6)
        row.addWidget(self.yes, 1)
        row.addWidget(self.no, 1)
        column = QVBoxLayout(self)
        column.setContentsMargins(8, 6, 8, 8)
        column.addWidget(self.text)
        column.addLayout(row)
        self._then: Callable[[], None] = lambda: None
        self.hide()

    def ask(self, text: str, answer: str, then: Callable[[], None]) -> None:
        """Ask; do ``then`` if that is wanted."""
        self.text.setText(text)
        self.yes.setText(answer)
        self._then = then
        self.show()
        self.no.setFocus()  # what Enter chooses

    def _agree(self) -> None:
        self.hide()
        self._then()


class TipSection(Section):
    """Tip, floor and what is between them."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(translate("connection", "Tip"))
        self._workbench = workbench
        self._height: float | None = None
        self._asked: float | None = None  # the tip's height at which a floor is to be taught
        self.figures = Figures(*_FIGURES)
        self.column.addWidget(self.figures)
        self.teach = button(translate("connection", "Teach floor …"), self._ask_teach)
        self.remove = button(translate("connection", "Remove floor …"), self._ask_remove)
        self.question = Question()
        self.column.addWidget(self.question)  # above what asks it, which is in sight
        self.add_row(self.teach, self.remove)

    def refresh(self, state: SessionState) -> None:
        """Show a state."""
        zone = self._workbench.session.keep_out
        known = state.tip is not None and state.position_known
        self._height = state.tip[2] if known and state.tip is not None else None
        floor = self._floor()
        above = None if floor is None or self._height is None else self._height - floor
        self.figures.show_values(
            translate("connection", "unknown") if self._height is None else height(self._height),
            translate("connection", "none") if floor is None else height(floor),
            "–" if above is None else height(above),
        )
        why = reasons.against_teaching(state, zone)
        allow(
            self.teach,
            why,
            translate("connection", "Put the floor where the tip is now; below it nothing moves"),
        )
        allow(
            self.remove,
            reasons.against_removing(zone, state),
            translate("connection", "Let the tip go as low as its axes can"),
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
                translate(
                    "connection",
                    "The tip has moved: no floor was taught. Ask again where it rests.",
                ),
                about=self,
            )

    def _floor(self) -> float | None:
        zone = self._workbench.session.keep_out
        return zone.floor if zone is not None and isfinite(zone.floor) else None

    def _ask_teach(self) -> None:
        if self._height is None:
            return
        self._asked, floor = self._height, self._floor()
        old = (
            translate("connection", "there is none yet")
            if floor is None
            else translate("connection", "it is at {height}").format(height=height(floor))
        )
        self.question.ask(
            translate(
                "connection", "Put the floor at {height}, where the tip is now? So far {old}."
            ).format(height=height(self._height), old=old),
            translate("connection", "Teach"),
            self._workbench.teach_floor,
        )

    def _ask_remove(self) -> None:
        floor = self._floor()
        if floor is None:
            return
        self._asked = None
        self.question.ask(
            translate(
                "connection",
                "Take the floor at {height} away? New floor: none; only the ranges of "
                "the axes hold the tip then.",
            ).format(height=height(floor)),
            translate("connection", "Remove"),
            self._workbench.clear_floor,
        )


def height(metres: float) -> str:
    """Return a height as text."""
    return f"{1e3 * metres:.4f} mm"
