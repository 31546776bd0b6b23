"""How a paused playback goes on whose axes were moved: asked inside the window, never modal."""

from collections.abc import Callable

from PySide6.QtWidgets import QFrame

from rotemina.app.shell.language import translate
from rotemina.app.shell.state_words import describe_moved
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.controls import button
from rotemina.app.widgets.labels import plain_text
from rotemina.app.widgets.layouts import in_column, in_row


class ResumeQuestion(QFrame):
    """The ways to go on after axes were moved during a pause; the stops stay within reach."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self.setObjectName("question")
        self._workbench = workbench
        self.text = plain_text(quiet=False, wrap=True)
        self.move_back = button(
            translate("shell", "Move back slowly and resume"),
            lambda: self._answer(lambda: workbench.resume_playback(moves_back=True)),
            translate(
                "shell",
                "Move to the row at which it goes on at a tenth of the axes' greatest speed, then "
                "resume",
            ),
        )
        self.start_over = button(
            translate("shell", "Start over"),
            lambda: self._answer(workbench.start_playback_over),
            translate("shell", "Play from the first row; the axes first move there"),
        )
        self.keep = button(
            translate("shell", "Keep paused"),
            self.hide,
            translate("shell", "Move nothing; Resume asks again"),
        )
        buttons = in_row(self.move_back, self.start_over, self.keep, 1, spacing=6)
        in_column(self.text, buttons, on=self, margins=(8, 6, 8, 8), spacing=6)
        self.hide()
        workbench.resume_asked.connect(self._show)
        workbench.stopped.connect(self.hide)
        workbench.refreshed.connect(lambda _: self._refresh())

    def _show(self, asked: bool) -> None:
        if not asked:
            self.hide()
            return
        self._refresh_text()
        self.show()
        self.keep.setFocus()  # what Enter chooses

    def _refresh(self) -> None:
        if self.isVisible():
            self._refresh_text()

    def _refresh_text(self) -> None:
        moved = describe_moved(self._workbench.robot, self._workbench.playback.state)
        if moved:  # while an axis moves, the last distance stays
            self.text.setText(translate("shell", "{moved}. How to go on?").format(moved=moved))

    def _answer(self, act: Callable[[], object]) -> None:
        self.hide()
        act()
