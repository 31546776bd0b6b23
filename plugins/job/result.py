"""What came of the run in hand: the gap of each axis that moved, and where to look further."""

from collections.abc import Callable

from PySide6.QtWidgets import QFrame, QGridLayout, QHBoxLayout, QLabel, QPushButton, QVBoxLayout

from rotemina.app.display import label
from rotemina.app.shell.gap_words import RUN, size, small_print
from rotemina.app.shell.language import translate
from rotemina.app.shell.workbench import Run
from rotemina.app.widgets.controls import plain_tip
from rotemina.app.widgets.labels import ElidedLabel
from rotemina.sim.records.record import Tap

_COLUMNS = 2


class ResultView(QFrame):
    """The gaps of a run in two columns; unseen before the first."""

    def __init__(self, bring_up: Callable[[str], object]) -> None:
        super().__init__()
        self.setObjectName("section")
        heading = QLabel(translate("shell", RUN))
        heading.setProperty("quiet", True)
        self.name = ElidedLabel()
        self.name.setProperty("heading", True)
        self.gaps = QGridLayout()
        self.gaps.setHorizontalSpacing(12)
        buttons = QHBoxLayout()
        buttons.addStretch(1)
        for text, tip, panel in (
            (
                translate("job", "Compare"),
                translate("job", "Compare model and machine in this run, axis by axis"),
                "comparison",
            ),
            (
                translate("job", "Diagnose"),
                translate("job", "Find the effects that explain the gap"),
                "gap",
            ),
        ):
            button = QPushButton(text)
            button.setToolTip(plain_tip(tip))
            button.clicked.connect(lambda _=False, panel=panel: bring_up(panel))
            buttons.addWidget(button)
        column = QVBoxLayout(self)
        column.setContentsMargins(2, 4, 2, 6)
        column.setSpacing(3)
        for widget in (heading, self.name):
            column.addWidget(widget)
        column.addLayout(self.gaps)
        column.addLayout(buttons)
        self.hide()

    def show_run(self, run: Run) -> None:
        """Show the gaps of a run."""
        self.name.show_text(run.name)
        while (item := self.gaps.takeAt(0)) is not None:
            if (old := item.widget()) is not None:
                old.deleteLater()
        found = [(axis, gap) for (axis, tap), gap in run.gaps.items() if tap is Tap.MEAS]
        for number, (axis, figure) in enumerate(found):
            unit = run.record.units[axis]
            text = QLabel(f"{label(axis)}  {size(figure, unit)}")
            text.setToolTip(plain_tip(small_print(figure, unit)))
            self.gaps.addWidget(text, *divmod(number, _COLUMNS))
        self.show()
