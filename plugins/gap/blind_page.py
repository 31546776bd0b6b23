"""The blind test of the diagnosis: how often it is right, on machines that it has never seen."""

from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QIntValidator
from PySide6.QtWidgets import (
    QDialog,
    QLabel,
    QLineEdit,
    QProgressBar,
    QPushButton,
    QSplitter,
    QWidget,
)

from rotemina.app.files import write_text
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.app.widgets.controls import allow, named, plain_tip
from rotemina.app.widgets.labels import hint, plain_text
from rotemina.app.widgets.layouts import in_column, in_row
from rotemina.app.widgets.table import Table
from rotemina.plugins.gap import mark, tr
from rotemina.plugins.gap.blind_figures import HEAD, BlindResult
from rotemina.plugins.gap.blind_run import BlindRun
from rotemina.plugins.gap.robot_choice import RobotChoice
from rotemina.plugins.gap.words import effect_title, effect_word
from rotemina.sim.quantities import percent
from rotemina.sim.robot.file import load_robot, shipped_robots
from rotemina.sim.robot.writing import robot_text

ABOUT = mark(
    "The test draws machines with hidden effects, by equations that the "
    "diagnosis does not know. The names of the effects are sealed until the "
    "diagnosis has answered; then they are opened and compared. A case takes "
    "about half a minute. The test runs in the background; you can stop and "
    "resume it without losing finished cases."
)
NOTHING = mark(
    "No case is scored yet.\nPress Start; figures and confusion matrix appear "
    "when all cases are done. To score earlier, press Stop, then “Score "
    "finished cases”."
)
_MOST_CASES, _MOST_SEED = 9999, 999_999_999
_STRENGTH = 170  # of the strongest colour, of 255
_VERDICTS = {
    "none": mark("no gap"),
    "unknown": mark("unknown"),
    "insufficient_excitation": mark("undecided"),
    "failed": mark("failed"),
    "explained": mark("explained"),
}


class BlindPage(QDialog):
    """Number of cases and seed → progress → figures beside their levels, confusion matrix."""

    def __init__(self, workbench: Workbench, robots: RobotChoice, parent: QWidget) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Blind test of the diagnosis"))
        self._workbench, self._robots = workbench, robots
        self.run = BlindRun(self)
        self.cases = _field("12", _MOST_CASES, 1, tr("Number of machines, 1 to 9999"))
        self.seed = _field(
            "1", _MOST_SEED, 0, tr("Seed of the machines: the same seed draws the same machines")
        )
        self.start, self.stop = QPushButton(tr("Start")), QPushButton(tr("Stop"))
        self.start.setProperty("primary", True)
        self.score = QPushButton(tr("Score finished cases"))
        self.progress = QProgressBar()
        self.progress.setFormat(tr("%v of %m"))
        self.doing = plain_text(quiet=False)
        self.figures = Table(tr("Figures beside their target levels"), [tr(text) for text in HEAD])
        self.matrix = Table(tr("True cause and cause named first"), choose=False)
        self._lay_out()
        self._connect()
        self._show_state()

    def _lay_out(self) -> None:
        about = QLabel(tr(ABOUT))
        about.setWordWrap(True)
        row = in_row(
            QLabel(tr("Cases")),
            self.cases,
            QLabel(tr("Seed")),
            self.seed,
            *(self.start, self.stop, self.score, self.progress),
            (self.doing, 1),
        )
        split = self.shown = QSplitter(Qt.Orientation.Vertical)
        split.addWidget(_titled(tr("Figures, each with its 95 % interval"), self.figures))
        split.addWidget(
            _titled(
                tr(
                    "Confusion matrix, cases with one effect at most: rows are true causes, "
                    "columns are the causes named first"
                ),
                self.matrix,
            )
        )
        self.nothing = hint(tr(NOTHING))
        in_column(about, row, (self.nothing, 1), (split, 1), on=self)
        split.hide()
        self.resize(900, 640)

    def _connect(self) -> None:
        self.start.clicked.connect(lambda: self.begin(score=False))
        self.score.clicked.connect(lambda: self.begin(score=True))
        self.stop.clicked.connect(self._end)
        for field in (self.cases, self.seed):
            field.textChanged.connect(lambda _: self._show_state())
        self.run.progressed.connect(self._show_progress)
        self.run.finished.connect(self.show_result)
        self.run.stopped.connect(lambda: self._show_end(tr("stopped; finished cases are kept")))
        self.run.failed.connect(self._fail)
        self._workbench.closing.connect(self.run.close)
        self._workbench.theme_changed.connect(lambda _: self._show_colours())
        self._result: BlindResult | None = None

    # --- running ----------------------------------------------------------------------------------

    def begin(self, *, score: bool) -> None:
        """Run the cases that are not done yet, or score those that are."""
        seed = int(self.seed.text())
        folder = self._workbench.played_folder.parent / "blind" / self._name(seed)
        try:
            robot = self._robot(folder)
        except OSError as error:
            text = tr("{folder}: cannot be created ({reason})")
            self._fail(text.format(folder=folder, reason=error.strerror))
            return
        self.run.start(robot, int(self.cases.text()), seed, folder, score=score)
        self.progress.setRange(0, 0)
        self.doing.setText(tr("scoring") if score else tr("choosing the first machine"))
        self._show_state()

    def _name(self, seed: int) -> str:
        name = "".join(c if c.isalnum() or c in "-_" else "_" for c in self._robots.robot.name)
        return f"{name}-seed-{seed}"

    def _robot(self, folder: Path) -> str:
        """Return what ``--robot`` takes: a shipped robot's name, or a file of the one chosen."""
        robot = self._robots.robot
        shipped = next((name for name in shipped_robots() if load_robot(name) == robot), None)
        if shipped is not None:
            return shipped
        folder.mkdir(parents=True, exist_ok=True)
        write_text(folder / "robot.toml", robot_text(robot))
        return str(folder / "robot.toml")

    def _end(self) -> None:
        self.run.stop()
        self._show_end(tr("stopping"))

    def _show_progress(self, done: int, count: int) -> None:
        self.progress.setRange(0, count)
        self.progress.setValue(done)
        self.doing.setText(tr("{done} of {count} cases done").format(done=done, count=count))

    def _show_end(self, text: str) -> None:
        self.doing.setText(text)
        self._show_state()

    def _fail(self, message: str) -> None:
        self._show_end(tr("failed"))
        self._workbench.notify(Level.ERROR, message, about=self, subject=self)

    def _show_state(self) -> None:
        running = self.run.running
        whole = all(field.hasAcceptableInput() for field in (self.cases, self.seed))
        why = (
            tr("it is already running")
            if running
            else None
            if whole
            else tr("enter cases and seed")
        )
        allow(self.start, why, tr("Run the unfinished cases, then score all"))
        allow(self.score, why, tr("Score the finished cases without running more"))
        allow(
            self.stop,
            None if running else tr("nothing is running"),
            tr("Stop the test; finished cases are kept"),
        )
        self.progress.setVisible(running)
        for field in (self.cases, self.seed):
            field.setEnabled(not running)

    # --- the result -------------------------------------------------------------------------------

    def show_result(self, result: BlindResult) -> None:
        """Show figures and confusion matrix."""
        self._workbench.settled.emit(self)
        self._result = result
        text = tr("{done} of {count} cases scored")
        self._show_end(text.format(done=result.done, count=result.asked))
        self._show_colours()

    def _show_colours(self) -> None:
        result, theme = self._result, self._workbench.theme
        if result is None:
            return
        self.nothing.hide()
        self.shown.show()
        colours = {True: QColor(theme.good), False: QColor(theme.warning), None: None}
        self.figures.show_rows(
            [(tr(one.cells[0]), *one.cells[1:]) for one in result.rows],
            [colours[one.reached] for one in result.rows],
        )
        names = result.names
        self.matrix.set_head((tr("true cause"), *map(title, names)))
        self.matrix.show_rows(
            [
                (title(there), *(str(result.counts.get((there, told), "")) for told in names))
                for there in names
            ]
        )
        for row, there in enumerate(names):
            for column, told in enumerate(names, start=1):
                share = result.share(there, told)
                colour = QColor(theme.good if there == told else theme.danger)
                colour.setAlpha(round(_STRENGTH * share))
                item = self.matrix.item(row, column)
                item.setBackground(colour)
                text = tr("{truth}, diagnosed as {told}: {share} of its cases")
                said = text.format(truth=title(there), told=_word(told), share=percent(share))
                item.setToolTip(plain_tip(said))


def title(name: str) -> str:
    """Return a verdict or an effect as people call it."""
    return tr(_VERDICTS[name]) if name in _VERDICTS else effect_title(name)


def _word(name: str) -> str:
    """Return the same within a sentence."""
    return title(name) if name in _VERDICTS else effect_word(name)


def _field(text: str, most: int, least: int, tooltip: str) -> QLineEdit:
    field = named(QLineEdit(text), tooltip, tooltip)
    field.setValidator(QIntValidator(least, most, field))
    field.setMaximumWidth(90)
    return field


def _titled(text: str, table: Table) -> QWidget:
    box, heading = QWidget(), QLabel(text)
    heading.setProperty("quiet", True)
    in_column(heading, (table, 1), on=box, margins=0, spacing=2)
    return box
