"""What comes of an answer: a twin, a report, a document; each is a file that is requested."""

from collections.abc import Callable, Sequence
from html import escape
from pathlib import Path

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QWidget

from rotemina.app.files import json_text, write_text
from rotemina.app.motion.compared_run import Run
from rotemina.app.shell.engine_words import TranslatedWording
from rotemina.app.shell.file_dialog import ask_where
from rotemina.app.shell.gap_words import run_lines
from rotemina.app.shell.language import translate
from rotemina.app.shell.report_files import PAGES, save_report
from rotemina.app.shell.workbench import Workbench
from rotemina.plugins.gap import tr
from rotemina.plugins.gap.diagnosis_answer import Answer
from rotemina.sim.gap.diagnosis import Diagnosis
from rotemina.sim.gap.output.digital_twin import twin_text
from rotemina.sim.gap.output.document import as_json
from rotemina.sim.records.record import Record

_BEFORE = '<h2 id="where">'  # of a page: what is told of the run in hand stands there


class Actions(QObject):
    """Writes files of an answer in the background; a failure becomes a notice.

    Signals
    -------
    twin_saved(Path)
    """

    twin_saved = Signal(object)

    def __init__(self, workbench: Workbench, parent: QWidget) -> None:
        super().__init__(parent)
        self._workbench = workbench
        self._parent = parent

    # --- asking where to --------------------------------------------------------------------------

    def ask_twin(self, answer: Answer, source: str | Path | None) -> None:
        """Ask where to, and write the twin of an answer about the robot of ``source``."""
        self._ask(
            tr("Add to twin"),
            "twin.toml",
            tr("Robot files (*.toml)"),
            lambda path: self.save_twin(answer, source, path),
        )

    def ask_report(self, answer: Answer) -> None:
        """Ask where to, write the report and open it."""
        self._ask(
            tr("Report"),
            "gap-report.html",
            translate("shell", PAGES),
            lambda path: self.save_report(answer, path),
        )

    def ask_json(self, answer: Answer) -> None:
        """Ask where to, and write the diagnosis as JSON."""
        self._ask(
            tr("Save the diagnosis"),
            "gap.json",
            tr("JSON (*.json)"),
            lambda path: self.save_json(answer, path),
        )

    def _ask(self, title: str, name: str, filters: str, use: Callable[[Path], None]) -> None:
        ask_where(self._parent, self._workbench, title, filters, name, use)

    # --- writing ----------------------------------------------------------------------------------

    def save_twin(self, answer: Answer, source: str | Path | None, path: Path) -> None:
        """Write a robot file of the corrected model."""
        robot, effects = answer.diagnosis.robot, answer.diagnosis.fitted

        def write() -> None:
            write_text(path, twin_text(robot, effects, source))

        self._workbench.write_file("gap twin", path, write, lambda: self.twin_saved.emit(path))

    def save_report(self, answer: Answer, path: Path) -> None:
        """Write the report and open it."""
        run, diagnosis = self._workbench.run, answer.diagnosis
        save_report(
            self._workbench,
            path,
            lambda: write_report(diagnosis, answer.records, path, answer.names, run),
            self._parent,
        )

    def save_json(self, answer: Answer, path: Path) -> None:
        """Write the diagnosis as JSON."""
        self._workbench.write_file(
            "gap document", path, lambda: write_text(path, json_text(as_json(answer.diagnosis)))
        )


def write_report(
    diagnosis: Diagnosis,
    records: Sequence[Record],
    path: Path,
    names: Sequence[str],
    run: Run | None = None,
) -> None:
    """Write the page of a diagnosis to a file, with the gap of the run in hand at its head."""
    from rotemina.sim.gap.output.report import page  # drawing takes its time to import

    text = page.report_text(diagnosis, records, names, TranslatedWording())
    if run is not None:
        lines = "".join(f"<li>{escape(line)}</li>" for line in run_lines(run))
        told = f"<p>{escape(run.name)} ({escape(run.model_id)}):</p><ul>{lines}</ul>\n"
        text = text.replace(_BEFORE, told + _BEFORE, 1)
    write_text(path, text)
