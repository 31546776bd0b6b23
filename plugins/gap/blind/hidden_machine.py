"""Practice with a simulated machine whose effects are hidden until the operator reveals them."""

import secrets
from collections.abc import Collection, Iterator

from PySide6.QtCore import QObject, Qt
from PySide6.QtWidgets import QMessageBox, QWidget

from rotemina.app.blind import (
    HiddenCause,
    HiddenEffects,
    HiddenMachineSimulator,
    draw_hidden_effects,
    is_diagnosis_right,
)
from rotemina.app.language import get_axis_label
from rotemina.app.workbench import Level, Workbench
from rotemina.drivers.simulator import Simulator
from rotemina.plugins.gap import tr
from rotemina.plugins.gap.answer import DiagnosisAnswer, effect_word

# Keys of the score in the preferences.
CORRECT_COUNT_KEY, PLAYED_COUNT_KEY = "hidden.right", "hidden.played"
_SEED_COUNT = 1 << 30


class HiddenMachineTrial(QObject):
    """Trial that replaces the simulator with a hidden machine, and later reveals its effects."""

    def __init__(self, workbench: Workbench, parent: QWidget) -> None:
        super().__init__(parent)
        self._workbench = workbench
        self._parent = parent
        self.hidden_effects: HiddenEffects | None = None

    def begin(self, seed: int | None = None) -> None:
        """Choose a machine at random in the background, and connect to it.

        Without a seed, a random one is used.
        """
        robot = self._workbench.robot
        seed_in_use = secrets.randbelow(_SEED_COUNT) if seed is None else seed
        self._workbench.work(
            "hidden machine",
            tr("Choosing a machine at random …"),
            lambda: draw_hidden_effects(robot, seed_in_use),
            self._connect,
        )

    def reveal(self, answer: DiagnosisAnswer | None) -> None:
        """Show the effects of the machine and those of an answer, and disconnect the machine.

        The result is added to the score.
        """
        hidden_effects = self.hidden_effects
        if hidden_effects is None:
            return
        named_causes = tuple(find_named_causes(answer, hidden_effects))
        is_right = is_diagnosis_right(hidden_effects, named_causes)
        settings = self._workbench.settings
        settings.set(CORRECT_COUNT_KEY, settings.get(CORRECT_COUNT_KEY, 0) + is_right)
        settings.set(PLAYED_COUNT_KEY, settings.get(PLAYED_COUNT_KEY, 0) + 1)
        self.hidden_effects = None
        self._show_outcome(hidden_effects, named_causes, is_right=is_right)
        session = self._workbench.session
        self._workbench.run_request(lambda: session.use_driver(Simulator(session.robot)))

    def _connect(self, hidden_effects: HiddenEffects) -> None:
        machine = HiddenMachineSimulator(self._workbench.robot, hidden_effects)
        if self._workbench.run_request(lambda: self._workbench.session.use_driver(machine)):
            self.hidden_effects = hidden_effects
            text = tr(
                "A hidden machine is connected. It has one or two effects, or none. Play a "
                "motion, diagnose it, then choose More → Reveal."
            )
            self._workbench.notify(Level.INFO, text, about=self._parent)

    def _show_outcome(
        self,
        hidden_effects: HiddenEffects,
        named_causes: Collection[HiddenCause],
        *,
        is_right: bool,
    ) -> None:
        settings = self._workbench.settings
        dialog = QMessageBox(self._parent.window())
        dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        dialog.setWindowTitle(tr("Hidden machine"))
        dialog.setTextFormat(Qt.TextFormat.PlainText)
        dialog.setText(
            tr("Correct: the diagnosis named exactly the effects of the machine.")
            if is_right
            else tr("Not correct.")
        )
        lines = (
            tr("The machine has: {causes}").format(causes=_format_causes(hidden_effects.causes)),
            tr("The diagnosis names: {causes}").format(causes=_format_causes(named_causes)),
            tr("Score: {right} of {played}").format(
                right=settings.get(CORRECT_COUNT_KEY, 0), played=settings.get(PLAYED_COUNT_KEY, 0)
            ),
        )
        dialog.setInformativeText("\n".join(lines))
        dialog.setModal(False)
        dialog.show()


def find_named_causes(
    answer: DiagnosisAnswer | None, hidden_effects: HiddenEffects
) -> Iterator[HiddenCause]:
    """Yield the causes that an answer names.

    If an answer cannot distinguish between several causes, it is credited with the true one if that
    is among them.
    """
    for cause in answer.diagnosis.causes if answer is not None else ():
        candidate_effects = (cause.effect, *cause.ambiguous_with)
        candidates = [(cause.axis, effect) for effect in candidate_effects]
        yield next(
            (candidate for candidate in candidates if candidate in hidden_effects.causes),
            candidates[0],
        )


def _format_causes(causes: Collection[HiddenCause]) -> str:
    names = [f"{get_axis_label(axis)} {effect_word(effect)}" for axis, effect in sorted(causes)]
    return ", ".join(names) or tr("nothing")
