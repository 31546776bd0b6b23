"""Dialog for the blind test, which measures how often the diagnosis of unseen machines is right."""

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

from rotemina.app.settings import write_text
from rotemina.app.widgets.controls import (
    enable_unless,
    make_tooltip,
    name_widget,
)
from rotemina.app.widgets.layout import make_column, make_row
from rotemina.app.widgets.text import TextTable, make_hint, make_plain_label
from rotemina.app.workbench import Level, Workbench
from rotemina.plugins.gap import mark, tr
from rotemina.plugins.gap.answer import effect_title, effect_word
from rotemina.plugins.gap.blind.blind_figures import FIGURE_HEADINGS, BlindResult
from rotemina.plugins.gap.blind.blind_run import BlindTestProcess
from rotemina.plugins.gap.diagnosing import RobotChoice
from rotemina.sim.robot_files import format_robot, list_shipped_robots, load_robot
from rotemina.sim.units import format_percent

ABOUT_TEXT = mark(
    "The test draws machines with hidden effects, by equations that the "
    "diagnosis does not know. The names of the effects are sealed until the "
    "diagnosis has answered; then they are opened and compared. A case takes "
    "about half a minute. The test runs in the background; you can stop and "
    "resume it without losing finished cases."
)
EMPTY_TEXT = mark(
    "No case is scored yet.\nPress Start; figures and confusion matrix appear "
    "when all cases are done. To score earlier, press Stop, then “Score "
    "finished cases”."
)
_MAX_CASES, _MAX_SEED = 9999, 999_999_999

# Alpha (0 to 255) of the strongest colour of the matrix. The numbers must stay readable.
_MAX_ALPHA = 170
_VERDICT_NAMES = {
    "none": mark("no gap"),
    "unknown": mark("unknown"),
    "insufficient_excitation": mark("undecided"),
    "failed": mark("failed"),
    "explained": mark("explained"),
}


class BlindPage(QDialog):
    """Dialog that runs a blind test, and shows its scores and confusion matrix."""

    def __init__(self, workbench: Workbench, robots: RobotChoice, parent: QWidget) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Blind test of the diagnosis"))
        self._workbench, self._robots = workbench, robots
        self.run = BlindTestProcess(self)
        self.cases = _make_field("12", _MAX_CASES, 1, tr("Number of machines, 1 to 9999"))
        self.seed = _make_field(
            "1", _MAX_SEED, 0, tr("Seed of the machines: the same seed draws the same machines")
        )
        self.start, self.stop = QPushButton(tr("Start")), QPushButton(tr("Stop"))
        self.start.setProperty("primary", True)
        self.score = QPushButton(tr("Score finished cases"))
        self.progress = QProgressBar()
        self.progress.setFormat(tr("%v of %m"))
        self.doing = make_plain_label(quiet=False)
        self.figures = TextTable(
            tr("Figures with their target levels"), [tr(text) for text in FIGURE_HEADINGS]
        )
        self.matrix = TextTable(tr("True cause and cause named first"), selectable=False)
        self._lay_out()
        self._connect()
        self._show_state()

    def _lay_out(self) -> None:
        about = QLabel(tr(ABOUT_TEXT))
        about.setWordWrap(True)
        row = make_row(
            QLabel(tr("Cases")),
            self.cases,
            QLabel(tr("Seed")),
            self.seed,
            *(self.start, self.stop, self.score, self.progress),
            (self.doing, 1),
        )
        split = self.shown = QSplitter(Qt.Orientation.Vertical)
        split.addWidget(_add_heading(tr("Figures, each with its 95 % interval"), self.figures))
        split.addWidget(
            _add_heading(
                tr(
                    "Confusion matrix, cases with one effect at most: rows are true causes, "
                    "columns are the causes named first"
                ),
                self.matrix,
            )
        )
        self.nothing = make_hint(tr(EMPTY_TEXT))
        make_column(about, row, (self.nothing, 1), (split, 1), on=self)
        split.hide()
        self.resize(900, 640)

    def _connect(self) -> None:
        self.start.clicked.connect(lambda: self.begin(score=False))
        self.score.clicked.connect(lambda: self.begin(score=True))
        self.stop.clicked.connect(self._stop_test)
        for field in (self.cases, self.seed):
            field.textChanged.connect(lambda _: self._show_state())
        self.run.progressed.connect(self._show_progress)
        self.run.finished.connect(self.show_result)
        self.run.stopped.connect(lambda: self._show_status(tr("stopped; finished cases are kept")))
        self.run.failed.connect(self._fail)
        self._workbench.closing.connect(self.run.close)
        self._workbench.theme_changed.connect(lambda _: self._fill_tables())
        self._result: BlindResult | None = None

    def begin(self, *, score: bool) -> None:
        """Run the unfinished cases and score all of them, or only score the finished cases."""
        seed = int(self.seed.text())
        folder = self._workbench.played_folder.parent / "blind" / self._make_folder_name(seed)
        try:
            robot = self._find_robot_argument(folder)
        except OSError as error:
            text = tr("{folder}: cannot be created ({reason})")
            self._fail(text.format(folder=folder, reason=error.strerror))
            return
        self.run.start(robot, int(self.cases.text()), seed, folder, score=score)
        self.progress.setRange(0, 0)
        self.doing.setText(tr("scoring") if score else tr("choosing the first machine"))
        self._show_state()

    def _make_folder_name(self, seed: int) -> str:
        name = "".join(
            letter if letter.isalnum() or letter in "-_" else "_"
            for letter in self._robots.robot.name
        )
        return f"{name}-seed-{seed}"

    def _find_robot_argument(self, folder: Path) -> str:
        """Return the argument of ``--robot``: the name of a shipped robot, or a file.

        Any other robot is written to a file in the folder of the test.
        """
        robot = self._robots.robot
        shipped_name = next(
            (name for name in list_shipped_robots() if load_robot(name) == robot), None
        )
        if shipped_name is not None:
            return shipped_name
        folder.mkdir(parents=True, exist_ok=True)
        write_text(folder / "robot.toml", format_robot(robot))
        return str(folder / "robot.toml")

    def _stop_test(self) -> None:
        self.run.stop()
        self._show_status(tr("stopping"))

    def _show_progress(self, done: int, count: int) -> None:
        self.progress.setRange(0, count)
        self.progress.setValue(done)
        self.doing.setText(tr("{done} of {count} cases done").format(done=done, count=count))

    def _show_status(self, text: str) -> None:
        self.doing.setText(text)
        self._show_state()

    def _fail(self, message: str) -> None:
        self._show_status(tr("failed"))
        self._workbench.notify(Level.ERROR, message, about=self, subject=self)

    def _show_state(self) -> None:
        is_running = self.run.running
        is_complete = all(field.hasAcceptableInput() for field in (self.cases, self.seed))
        objection = (
            tr("it is already running")
            if is_running
            else None
            if is_complete
            else tr("enter cases and seed")
        )
        enable_unless(self.start, objection, tr("Run the unfinished cases, then score all"))
        enable_unless(self.score, objection, tr("Score the finished cases without running more"))
        enable_unless(
            self.stop,
            None if is_running else tr("nothing is running"),
            tr("Stop the test; finished cases are kept"),
        )
        self.progress.setVisible(is_running)
        for field in (self.cases, self.seed):
            field.setEnabled(not is_running)

    def show_result(self, result: BlindResult) -> None:
        """Show the scores and the confusion matrix."""
        self._workbench.settled.emit(self)
        self._result = result
        text = tr("{done} of {count} cases scored")
        self._show_status(text.format(done=result.done, count=result.total))
        self._fill_tables()

    def _fill_tables(self) -> None:
        result, theme = self._result, self._workbench.theme
        if result is None:
            return
        self.nothing.hide()
        self.shown.show()
        colours = {True: QColor(theme.good), False: QColor(theme.warning), None: None}
        self.figures.show_rows(
            [(tr(figure.cells[0]), *figure.cells[1:]) for figure in result.rows],
            [colours[figure.reached] for figure in result.rows],
        )
        names = result.names
        self.matrix.set_headers((tr("true cause"), *map(translate_outcome, names)))
        self.matrix.show_rows(
            [
                (
                    translate_outcome(truth),
                    *(str(result.counts.get((truth, diagnosed), "")) for diagnosed in names),
                )
                for truth in names
            ]
        )
        for row, truth in enumerate(names):
            for column, diagnosed in enumerate(names, start=1):
                share = result.compute_share(truth, diagnosed)
                colour = QColor(theme.good if truth == diagnosed else theme.danger)
                colour.setAlpha(round(_MAX_ALPHA * share))
                item = self.matrix.item(row, column)
                item.setBackground(colour)
                text = tr("{truth}, diagnosed as {told}: {share} of its cases")
                tooltip = text.format(
                    truth=translate_outcome(truth),
                    told=_translate_in_sentence(diagnosed),
                    share=format_percent(share),
                )
                item.setToolTip(make_tooltip(tooltip))


def translate_outcome(name: str) -> str:
    """Return the name of a verdict or an effect in the UI language."""
    return tr(_VERDICT_NAMES[name]) if name in _VERDICT_NAMES else effect_title(name)


def _translate_in_sentence(name: str) -> str:
    return translate_outcome(name) if name in _VERDICT_NAMES else effect_word(name)


def _make_field(text: str, upper_bound: int, lower_bound: int, tooltip: str) -> QLineEdit:
    field = name_widget(QLineEdit(text), tooltip, tooltip)
    field.setValidator(QIntValidator(lower_bound, upper_bound, field))
    field.setMaximumWidth(90)
    return field


def _add_heading(text: str, table: TextTable) -> QWidget:
    container, heading = QWidget(), QLabel(text)
    heading.setProperty("quiet", True)
    make_column(heading, (table, 1), on=container, margins=0, spacing=2)
    return container
