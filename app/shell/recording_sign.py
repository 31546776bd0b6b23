"""A sign that a recording runs, which no closed panel hides."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel, QSizePolicy

from rotemina.app.display_units import duration_text, size_text
from rotemina.app.shell.language import translate
from rotemina.app.shell.phase_words import Tone, set_tone
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.controls import plain_tip


class RecordingSign(QLabel):
    """For how long it is recorded and how much, or that the disk takes nothing; else unseen."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._operation = workbench.operation
        self.setTextFormat(Qt.TextFormat.PlainText)
        self.setAccessibleName(translate("shell", "Recording"))
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        set_tone(self, Tone.BUSY)
        self.setVisible(False)
        workbench.refreshed.connect(lambda _: self.refresh())

    def refresh(self) -> None:
        """Show how the recording stands."""
        recorder = self._operation.recording
        self.setVisible(recorder is not None)
        if recorder is None:
            return
        writer = recorder.writer
        if writer.failure is not None:
            set_tone(self, Tone.DANGER)
            self.setText(translate("shell", "● Not recording: disk"))
            self.setToolTip(plain_tip(f"{writer.path}: {writer.failure}"))
            return
        set_tone(self, Tone.BUSY)
        since_s = self._operation.clock() - writer.began_s
        self.setText(
            translate("shell", "● {time}  {size}").format(
                time=duration_text(since_s), size=size_text(writer.bytes_written)
            )
        )
        self.setToolTip(
            plain_tip(
                translate("shell", "Time and size of the running recording"), str(writer.path)
            )
        )
