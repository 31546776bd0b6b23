"""Exports of an answer as files: a twin, a report, or a JSON document."""

from collections.abc import Callable, Sequence
from html import escape
from pathlib import Path

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QWidget

from rotemina.app.language import TranslatedWording, translate
from rotemina.app.motion.playback import ComparedRun
from rotemina.app.settings import format_json, write_text
from rotemina.app.shell.records import PAGE_FILTER, ask_save_path, save_report
from rotemina.app.workbench import Workbench, format_run_gaps
from rotemina.plugins.gap import tr
from rotemina.plugins.gap.answer.diagnosis_answer import DiagnosisAnswer
from rotemina.sim.gap.output import as_json, make_twin_text
from rotemina.sim.gap.result import Diagnosis
from rotemina.sim.records import Record

# The gaps of the current run are inserted before this heading of the report.
_WHERE_HEADING = '<h2 id="where">'


class AnswerExports(QObject):
    """Writes an answer to files in the background. A failure is shown as a notice.

    Signals
    -------
    twin_saved(Path) : the robot file of the twin was written.
    """

    twin_saved = Signal(object)

    def __init__(self, workbench: Workbench, parent: QWidget) -> None:
        super().__init__(parent)
        self._workbench = workbench
        self._parent = parent

    def ask_twin(self, answer: DiagnosisAnswer, source: str | Path | None) -> None:
        """Ask for a path and write the twin there.

        ``source`` is the name or file of the diagnosed robot, or None for the robot in use.
        """
        self._ask_path(
            tr("Add to twin"),
            "twin.toml",
            tr("Robot files (*.toml)"),
            lambda path: self.save_twin(answer, source, path),
        )

    def ask_report(self, answer: DiagnosisAnswer) -> None:
        """Ask for a path, write the report and open it."""
        self._ask_path(
            tr("Report"),
            "gap-report.html",
            translate("shell", PAGE_FILTER),
            lambda path: self.save_report(answer, path),
        )

    def ask_json(self, answer: DiagnosisAnswer) -> None:
        """Ask for a path and write the diagnosis as JSON."""
        self._ask_path(
            tr("Save the diagnosis"),
            "gap.json",
            tr("JSON (*.json)"),
            lambda path: self.save_json(answer, path),
        )

    def _ask_path(
        self, title: str, name: str, file_filter: str, save: Callable[[Path], None]
    ) -> None:
        ask_save_path(self._parent, self._workbench, title, file_filter, name, save)

    def save_twin(self, answer: DiagnosisAnswer, source: str | Path | None, path: Path) -> None:
        """Write a robot file of the corrected model."""
        robot, effects = answer.diagnosis.robot, answer.diagnosis.fitted

        def write() -> None:
            write_text(path, make_twin_text(robot, effects, source))

        self._workbench.write_file("gap twin", path, write, lambda: self.twin_saved.emit(path))

    def save_report(self, answer: DiagnosisAnswer, path: Path) -> None:
        """Write the report and open it."""
        run, diagnosis = self._workbench.run, answer.diagnosis
        save_report(
            self._workbench,
            path,
            lambda: write_report(diagnosis, answer.records, path, answer.names, run),
            self._parent,
        )

    def save_json(self, answer: DiagnosisAnswer, path: Path) -> None:
        """Write the diagnosis as JSON."""
        self._workbench.write_file(
            "gap document", path, lambda: write_text(path, format_json(as_json(answer.diagnosis)))
        )


def write_report(
    diagnosis: Diagnosis,
    records: Sequence[Record],
    path: Path,
    names: Sequence[str],
    run: ComparedRun | None = None,
) -> None:
    """Write the report of a diagnosis to a file. If there is a run, its gaps come first."""
    # The drawing modules are imported only here, because that is slow.
    from rotemina.sim.gap.output import html_page as page

    text = page.make_report_text(diagnosis, records, names, TranslatedWording())
    if run is not None:
        lines = "".join(f"<li>{escape(line)}</li>" for line in format_run_gaps(run))
        section = f"<p>{escape(run.name)} ({escape(run.model_id)}):</p><ul>{lines}</ul>\n"
        text = text.replace(_WHERE_HEADING, section + _WHERE_HEADING, 1)
    write_text(path, text)
