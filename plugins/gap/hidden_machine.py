"""A machine with a secret, to be found out: drawn, driven like any other, and revealed."""

import secrets
from collections.abc import Collection, Iterator

from PySide6.QtCore import QObject, Qt
from PySide6.QtWidgets import QMessageBox, QWidget

from rotemina.app.blind.hidden_machine import Cause, HiddenMachine, Secret, draw_secret, is_right
from rotemina.app.display_units import label
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.drivers.simulator.driver import Simulator
from rotemina.plugins.gap import tr
from rotemina.plugins.gap.diagnosis_answer import Answer
from rotemina.plugins.gap.words import effect_word

RIGHT, PLAYED = "hidden.right", "hidden.played"  # of the score, in the preferences
_SEEDS = 1 << 30


class HiddenMachineTrial(QObject):
    """Replaces the simulator by a hidden machine, and finally reveals its effects."""

    def __init__(self, workbench: Workbench, parent: QWidget) -> None:
        super().__init__(parent)
        self._workbench = workbench
        self._parent = parent
        self.secret: Secret | None = None

    def begin(self, seed: int | None = None) -> None:
        """Draw a machine in the background, and connect to it."""
        robot = self._workbench.robot
        drawn = secrets.randbelow(_SEEDS) if seed is None else seed
        self._workbench.work(
            "hidden machine",
            tr("Choosing a machine at random …"),
            lambda: draw_secret(robot, drawn),
            self._connect,
        )

    def reveal(self, answer: Answer | None) -> None:
        """Tell what the machine has beside what an answer says; count that, and let it go."""
        secret = self.secret
        if secret is None:
            return
        named = tuple(named_by(answer, secret))
        right = is_right(secret, named)
        settings = self._workbench.settings
        settings.set(RIGHT, settings.get(RIGHT, 0) + right)
        settings.set(PLAYED, settings.get(PLAYED, 0) + 1)
        self.secret = None
        self._tell(secret, named, right=right)
        session = self._workbench.session
        self._workbench.ask(lambda: session.use(Simulator(session.robot)))

    def _connect(self, secret: Secret) -> None:
        machine = HiddenMachine(self._workbench.robot, secret)
        if self._workbench.ask(lambda: self._workbench.session.use(machine)):
            self.secret = secret
            told = tr(
                "A hidden machine is connected. It has one or two effects, or none. Play a "
                "motion, diagnose it, then choose More → Reveal."
            )
            self._workbench.notify(Level.INFO, told, about=self._parent)

    def _tell(self, secret: Secret, named: Collection[Cause], *, right: bool) -> None:
        settings = self._workbench.settings
        box = QMessageBox(self._parent.window())
        box.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        box.setWindowTitle(tr("Hidden machine"))
        box.setTextFormat(Qt.TextFormat.PlainText)
        box.setText(
            tr("Correct: the diagnosis named exactly the effects of the machine.")
            if right
            else tr("Not correct.")
        )
        lines = (
            tr("The machine has: {causes}").format(causes=_listed(secret.causes)),
            tr("The diagnosis names: {causes}").format(causes=_listed(named)),
            tr("Score: {right} of {played}").format(
                right=settings.get(RIGHT, 0), played=settings.get(PLAYED, 0)
            ),
        )
        box.setInformativeText("\n".join(lines))
        box.setModal(False)
        box.show()


def named_by(answer: Answer | None, secret: Secret) -> Iterator[Cause]:
    """Yield the causes that an answer names; of a set that it cannot tell apart, the right one."""
    for cause in answer.diagnosis.causes if answer is not None else ():
        rivals = (cause.effect, *cause.ambiguous_with)
        found = [(cause.axis, effect) for effect in rivals]
        yield next((one for one in found if one in secret.causes), found[0])


def _listed(causes: Collection[Cause]) -> str:
    names = [f"{label(axis)} {effect_word(effect)}" for axis, effect in sorted(causes)]
    return ", ".join(names) or tr("nothing")
