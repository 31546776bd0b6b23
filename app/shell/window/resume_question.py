"""The question of how to continue a paused playback whose axes were moved."""

from collections.abc import Callable

from PySide6.QtWidgets import QFrame

from rotemina.app.language import translate
from rotemina.app.widgets.controls import make_button
from rotemina.app.widgets.layout import make_column, make_row
from rotemina.app.widgets.text import make_plain_label
from rotemina.app.workbench import Workbench, describe_moved


class ResumeQuestion(QFrame):
    """Question inside the window, with buttons for the answers; the stop buttons stay usable."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self.setObjectName("question")
        self._workbench = workbench
        self.text = make_plain_label(quiet=False, wrap=True)
        self.move_back = make_button(
            translate("shell", "Move back slowly and resume"),
            lambda: self._answer(lambda: workbench.player.resume_playback(moves_back=True)),
            translate(
                "shell",
                "Move back to the pause position at a tenth of the axes' maximum speed, then "
                "resume",
            ),
        )
        self.start_over = make_button(
            translate("shell", "Start over"),
            lambda: self._answer(workbench.player.start_playback_over),
            translate("shell", "Play from the first row; the axes first move there"),
        )
        self.keep = make_button(
            translate("shell", "Keep paused"),
            self.hide,
            translate("shell", "Move nothing; Resume asks again"),
        )
        buttons = make_row(self.move_back, self.start_over, self.keep, 1, spacing=6)
        make_column(self.text, buttons, on=self, margins=(8, 6, 8, 8), spacing=6)
        self.hide()
        workbench.player.resume_asked.connect(self._show)
        workbench.stopped.connect(self.hide)
        workbench.refreshed.connect(lambda _: self._refresh())

    def _show(self, is_asked: bool) -> None:
        if not is_asked:
            self.hide()
            return
        self._refresh_text()
        self.show()
        # Enter then chooses the safe answer.
        self.keep.setFocus()

    def _refresh(self) -> None:
        if self.isVisible():
            self._refresh_text()

    def _refresh_text(self) -> None:
        moved_text = describe_moved(self._workbench.robot, self._workbench.playback.state)
        # The last distance stays while an axis moves.
        if moved_text:
            self.text.setText(
                translate("shell", "{moved}. How do you want to continue?").format(moved=moved_text)
            )

    def _answer(self, action: Callable[[], object]) -> None:
        self.hide()
        action()
