"""The gap page: choose a model and records, diagnose, see where, which and how far, act on it."""

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import Qt, QUrl
from PySide6.QtGui import QDesktopServices
from PySide6.QtWidgets import (
    QComboBox,
    QFileDialog,
    QHBoxLayout,
    QLabel,
    QMessageBox,
    QProgressBar,
    QPushButton,
    QSizePolicy,
    QStackedWidget,
    QTabBar,
    QVBoxLayout,
)

from rotemina.app.display import label
from rotemina.app.files import json_text, write_text
from rotemina.app.panel import Area, Panel
from rotemina.app.shell.theme import Theme
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.plugins.gap.answer import Answer
from rotemina.plugins.gap.diagnosing import Diagnosing
from rotemina.plugins.gap.far import FarView
from rotemina.plugins.gap.records import RecordChoice
from rotemina.plugins.gap.robots import RobotChoice
from rotemina.plugins.gap.tips import tip
from rotemina.plugins.gap.where import WhereView
from rotemina.plugins.gap.which import WhichView
from rotemina.sim.errors import InputError
from rotemina.sim.gap.diagnosis import Cause, Verdict
from rotemina.sim.gap.document import as_json
from rotemina.sim.gap.report.page import write_report
from rotemina.sim.gap.report.quantities import percent
from rotemina.sim.gap.report.words import VERDICTS, effect_title, listed, summary
from rotemina.sim.gap.suggestion import suggestion
from rotemina.sim.gap.twin import twin_text

EMPTY = (
    "Choose records of the real machine (the last playback is taken by itself) and diagnose: "
    "where the model parts from them, which effects it lacks, how far the gap shrinks."
)
VIEWS = ("Where", "Which effect", "How far")
_HEIGHT = 240
_CALLED = {
    Verdict.NONE: "No gap.",
    Verdict.EXPLAINED: "Explained.",
    Verdict.UNKNOWN: "Unknown gap.",
    Verdict.INSUFFICIENT: "Insufficient excitation.",
}


class GapPanel(Panel):
    """A diagnosis from the choice of records to a corrected model."""

    title = "Gap diagnosis"
    area = Area.BOTTOM
    order = 50

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self.answer: Answer | None = None
        self._source: str | Path | None = None  # of the robot that the answer is about
        self.diagnosing = Diagnosing(self)
        self.robots, self.records = RobotChoice(workbench), RecordChoice(workbench)
        self._make_buttons()
        self._make_views()
        self._lay_out()
        self._connect()
        self._show_state()

    # --- parts ------------------------------------------------------------------------------------

    def _make_buttons(self) -> None:
        self.start = QPushButton("Diagnose")
        self.start.setProperty("primary", True)
        self.stop = QPushButton("Stop")
        self.stop.setToolTip("End this diagnosis now; motion goes on")
        self.progress = QProgressBar()
        self.progress.setRange(0, 1000)
        self.progress.setTextVisible(False)
        self.progress.setMinimumWidth(40)
        self.progress.setMaximumWidth(110)
        self.doing = QLabel()
        self.doing.setTextFormat(Qt.TextFormat.PlainText)
        self.doing.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self.twin = QPushButton("Add to twin …")
        self.twin.setToolTip("Write a robot file of the model with the effects that were found")
        self.report = QPushButton("Open report …")
        self.report.setToolTip("Write the report, a page with all figures, and open it")
        self.save = QPushButton("Save JSON …")

    def _make_views(self) -> None:
        theme = self.workbench.theme
        self.where, self.which, self.far = WhereView(theme), WhichView(theme), FarView(theme)
        self.views = QStackedWidget()
        for view in (self.where, self.which, self.far, _hint()):
            self.views.addWidget(view)
        self.tabs = QTabBar()
        self.tabs.setAccessibleName("What is shown")
        self.tabs.setExpanding(False)
        self.tabs.setDrawBase(False)
        for name in VIEWS:
            self.tabs.addTab(name)
        self.verdict = QLabel()
        self.verdict.setTextFormat(Qt.TextFormat.PlainText)
        self.verdict.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self.plan = QPushButton("Plan experiment")
        self.plan.setToolTip("Take the motion in hand that would tell rivals apart, to play it")
        self.axis = QComboBox()
        self.axis.setAccessibleName("Axis")

    def _lay_out(self) -> None:
        top = QHBoxLayout()
        top.setSpacing(6)
        for widget in (self.robots, self.records, self.start, self.stop, self.progress):
            top.addWidget(widget)
        top.addWidget(self.doing, 1)
        for widget in (self.twin, self.report, self.save):
            top.addWidget(widget)
        head = QHBoxLayout()
        head.setSpacing(8)
        head.addWidget(self.tabs)
        head.addWidget(self.verdict, 1)
        head.addWidget(self.plan)
        head.addWidget(self.axis)
        outer = QVBoxLayout(self)
        outer.setContentsMargins(10, 6, 10, 6)
        outer.setSpacing(4)
        outer.addLayout(top)
        outer.addLayout(head)
        outer.addWidget(self.views, 1)
        self.setMinimumHeight(_HEIGHT)

    def _connect(self) -> None:
        self.start.clicked.connect(self.diagnose)
        self.stop.clicked.connect(self.end)
        self.twin.clicked.connect(self._ask_twin)
        self.report.clicked.connect(self._ask_report)
        self.save.clicked.connect(self._ask_save)
        self.plan.clicked.connect(self.plan_experiment)
        self.robots.changed.connect(self.records.use_robot)
        self.records.changed.connect(self._show_state)
        self.tabs.currentChanged.connect(lambda _: self._show_state())
        self.axis.activated.connect(lambda _: self._show_axis())
        self.diagnosing.progressed.connect(self._show_progress)
        self.diagnosing.finished.connect(self.take_answer)
        self.diagnosing.failed.connect(self._fail)
        self.workbench.closing.connect(self.diagnosing.close)
        self.workbench.theme_changed.connect(self._use_theme)

    # --- the diagnosis ----------------------------------------------------------------------------

    def diagnose(self) -> None:
        """Diagnose the chosen records; the answer that was shown stays until there is another."""
        chosen = self.records.chosen
        if not chosen:
            self.workbench.notify(Level.WARNING, "There are no records to diagnose: choose some.")
            return
        names = [each.name for each in chosen]
        doing = "waiting for the end of what was stopped" if self.diagnosing.busy else "reading"
        self.diagnosing.start(self.robots.robot, names, [each.record for each in chosen])
        self._show_progress(doing, 0.0)
        self._show_state()

    def end(self) -> None:
        """Stop the diagnosis that runs."""
        self.diagnosing.stop()
        self.doing.setText("stopped")
        self._show_state()

    def take_answer(self, answer: Answer) -> None:
        """Show a diagnosis."""
        self.answer, self._source = answer, self.robots.source
        self.axis.clear()
        for name in answer.diagnosis.axes:
            self.axis.addItem(label(name), name)
        self.axis.setCurrentIndex(self.axis.findData(answer.first_axis))
        self.where.show_answer(answer)
        self._show_axis()
        self.verdict.setText(headline(answer))
        said = summary(answer.diagnosis, answer.records)
        self.verdict.setToolTip(tip(f"{VERDICTS[answer.diagnosis.verdict]}.", *said))
        self.doing.clear()
        self._show_state()

    def _fail(self, message: str) -> None:
        self.doing.setText("failed")
        self.workbench.notify(Level.ERROR, message)
        self._show_state()

    # --- what is shown ----------------------------------------------------------------------------

    def _show_state(self) -> None:
        running, done = self.diagnosing.running, self.answer is not None
        self.start.setEnabled(not running and bool(self.records.chosen))
        self.robots.setEnabled(not running)
        self.records.setEnabled(not running)
        self.stop.setEnabled(running)
        self.progress.setVisible(running)
        for button in (self.report, self.save):
            button.setEnabled(done)
        self.twin.setEnabled(self.answer is not None and bool(self.answer.diagnosis.fitted))
        self.plan.setVisible(self.answer is not None and bool(self.answer.diagnosis.experiments))
        self.tabs.setVisible(done)
        self.views.setCurrentIndex(self.tabs.currentIndex() if done else len(VIEWS))
        self.axis.setVisible(done and self.views.currentWidget() is not self.where)

    def _show_progress(self, doing: str, share: float) -> None:
        self.progress.setValue(round(1000 * share))
        self.doing.setText(doing)
        self.doing.setToolTip(tip(f"{doing}, {100.0 * share:.0f} % done"))

    def _show_axis(self) -> None:
        if self.answer is not None:
            axis = self.axis.currentData()
            self.which.show_axis(self.answer, axis)
            self.far.show_axis(self.answer, axis)

    def _use_theme(self, theme: Theme) -> None:
        for view in (self.where, self.which, self.far):
            view.set_theme(theme)

    # --- what comes of it -------------------------------------------------------------------------

    def plan_experiment(self) -> None:
        """Take the suggested experiment in hand: that of the axis in sight, or else the first."""
        assert self.answer is not None
        experiments = self.answer.diagnosis.experiments
        axis = self.axis.currentData()
        number = next((n for n, one in enumerate(experiments) if one.axis == axis), 0)
        made = suggestion(experiments[number], number + 1, "gap", self.answer.units)
        name = made.names.commands
        self.workbench.plan_trajectory(name, made.records[name])

    def save_twin(self, path: Path) -> None:
        """Write a robot file of the corrected model, and offer it to the running simulator."""
        answer = self.answer
        assert answer is not None
        robot, effects, source = answer.diagnosis.robot, answer.diagnosis.fitted, self._source

        def done(_: None) -> None:
            self.workbench.notify(Level.GOOD, f"Saved {path}")
            self._offer_live(answer)

        self.workbench.work(
            "gap twin",
            f"Writing {path.name} …",
            lambda: write_text(path, twin_text(robot, effects, source)),
            done,
        )

    def save_report(self, path: Path) -> None:
        """Write the report and open it."""
        answer = self.answer
        assert answer is not None

        def done(_: None) -> None:
            self.workbench.notify(Level.GOOD, f"Saved {path}")
            if not QDesktopServices.openUrl(QUrl.fromLocalFile(str(path))):
                self.workbench.notify(
                    Level.WARNING, f"{path}: nothing here opens it; open it in a browser"
                )

        self.workbench.work(
            "gap report",
            f"Writing {path.name} …",
            lambda: write_report(answer.diagnosis, answer.records, path, answer.names),
            done,
        )

    def save_json(self, path: Path) -> None:
        """Write the diagnosis as JSON."""
        answer = self.answer
        assert answer is not None
        self.workbench.work(
            "gap document",
            f"Writing {path.name} …",
            lambda: write_text(path, json_text(as_json(answer.diagnosis))),
            lambda _: self.workbench.notify(Level.GOOD, f"Saved {path}"),
        )

    def _offer_live(self, answer: Answer) -> None:
        """Ask whether the simulator is to run the corrected model, where there is one."""
        session = self.workbench.session
        if session.effects is None or answer.diagnosis.robot.axes != self.workbench.robot.axes:
            return
        question = QMessageBox(self.main_window)
        question.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        question.setWindowTitle("Add to twin")
        question.setText("Let the running simulator be the corrected model?")
        question.setInformativeText("The effects that it has now are replaced.")
        question.setStandardButtons(QMessageBox.StandardButton.Yes | QMessageBox.StandardButton.No)
        yes = QMessageBox.StandardButton.Yes
        question.finished.connect(lambda said: self._load_live(answer) if said == yes else None)
        question.setModal(False)  # the window, and its stop button, can still be used
        question.show()

    def _load_live(self, answer: Answer) -> None:
        diagnosis = answer.diagnosis
        try:
            self.workbench.session.set_effects((*diagnosis.robot.effects, *diagnosis.fitted))
        except InputError as error:
            self.workbench.notify(Level.ERROR, str(error))

    def _ask_twin(self) -> None:
        self._ask("Add to twin", "robot.toml", "Robot files (*.toml)", self.save_twin)

    def _ask_report(self) -> None:
        self._ask("Report", "gap-report.html", "Pages (*.html)", self.save_report)

    def _ask_save(self) -> None:
        self._ask("Save the diagnosis", "gap.json", "JSON (*.json)", self.save_json)

    def _ask(self, title: str, name: str, filters: str, use: Callable[[Path], None]) -> None:
        """Ask where to, beside a window that can still be used; it asks before a file goes."""
        settings = self.workbench.settings
        dialog = QFileDialog(self, title, settings.get("files.folder", ""), filters)
        dialog.setOption(QFileDialog.Option.DontUseNativeDialog)
        dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        dialog.setAcceptMode(QFileDialog.AcceptMode.AcceptSave)
        dialog.setDefaultSuffix(Path(name).suffix[1:])
        dialog.selectFile(name)
        dialog.fileSelected.connect(
            lambda chosen: settings.set("files.folder", str(Path(chosen).parent))
        )
        dialog.fileSelected.connect(lambda chosen: use(Path(chosen)))
        dialog.show()


def headline(answer: Answer) -> str:
    """Return verdict and causes in one line."""
    diagnosis = answer.diagnosis
    parts = [_CALLED[diagnosis.verdict]]
    for name, one in diagnosis.axes.items():
        causes = [_cause(cause) for cause in one.causes]
        if causes:
            parts.append(f"{label(name)}: {', '.join(causes)}")
        elif one.verdict is not Verdict.NONE:
            parts.append(f"{label(name)}: {_CALLED[one.verdict].lower()}")
    return "   ".join(parts)


def _cause(cause: Cause) -> str:
    names = [effect_title(effect).lower() for effect in (cause.effect, *cause.ambiguous_with)]
    return f"{listed(names, 'or')} {percent(cause.probability)}"


def _hint() -> QLabel:
    hint = QLabel(EMPTY)
    hint.setWordWrap(True)
    hint.setAlignment(Qt.AlignmentFlag.AlignCenter)
    hint.setProperty("quiet", True)
    return hint
