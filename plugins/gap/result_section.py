"""The result of a diagnosis: its sentence and axes, the views, and what can be done about it."""

from PySide6.QtWidgets import QMenu, QPushButton, QStackedWidget, QTabBar, QToolButton, QWidget

from rotemina.app.shell.theme import Theme
from rotemina.app.widgets.controls import allow, named, plain_tip, set_property
from rotemina.app.widgets.labels import hint
from rotemina.app.widgets.layouts import in_column, in_row
from rotemina.app.widgets.tab_dots import TabNews
from rotemina.plugins.gap import mark, tr
from rotemina.plugins.gap.axis_cards import AxisCells
from rotemina.plugins.gap.causes_view import CausesView
from rotemina.plugins.gap.diagnosis_answer import Answer
from rotemina.plugins.gap.distribution_view import DistributionView
from rotemina.plugins.gap.headline_view import Headline
from rotemina.plugins.gap.progress_view import ProgressView
from rotemina.plugins.gap.shrinkage_view import ShrinkageView
from rotemina.plugins.gap.unseen_motion_reduction import Proof
from rotemina.plugins.gap.unseen_motion_view import ProofView
from rotemina.plugins.gap.verdict_advice import readiness

VIEWS = (mark("Where"), mark("Which effect"), mark("How far"), mark("Unseen motion"))
WHERE, WHICH, FAR, PROOF, RUNNING, HINT = range(6)
TIPS = (
    mark("Axis, channel, frequencies and kind of motion in which the gap lies"),
    mark("Candidates with their probabilities, explanation and advice"),
    mark("How far the gap shrinks with the causes, down to the noise floor"),
    mark("How far it shrinks on a motion that the diagnosis has not seen"),
)
_WIDEST = 1400  # px: longer lines read worse
_NO_ANSWER = mark("there is no diagnosis yet; diagnose records first")


class ResultSection(QWidget):
    """The main column of the page; its buttons are connected by the panel."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._answer: Answer | None = None
        self._make_buttons()
        self._make_views(theme)
        self._lay_out()
        self.cells.chosen.connect(self._show_axis)

    def _make_buttons(self) -> None:
        self.use = QPushButton(tr("Use corrected model"))
        self.twin = QPushButton(tr("Add to twin …"))
        self.motion = QPushButton(tr("New motion …"))
        self.report = QPushButton(tr("Report …"))
        self.more = QToolButton()
        self.more.setText(tr("More"))
        self.more.setToolTip(
            tr("Save the diagnosis as JSON; test how often the diagnosis is correct")
        )
        self.more.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self.menu = menu = QMenu(self)
        menu.setToolTipsVisible(True)  # which say why an entry cannot be chosen
        self.save = menu.addAction(tr("Save JSON …"))
        self.test = menu.addAction(tr("Blind test …"))
        menu.addSeparator()
        self.hide_machine = menu.addAction(tr("Hidden machine …"))
        self.reveal = menu.addAction(tr("Reveal"))
        self.more.setMenu(menu)

    def _make_views(self, theme: Theme) -> None:
        self.distribution, self.causes, self.shrinkage = (
            DistributionView(theme),
            CausesView(theme),
            ShrinkageView(theme),
        )
        self.proof, self.running = ProofView(theme), ProgressView(theme)
        self.hint = hint(readiness(0))
        self.views = QStackedWidget()
        for view in (
            self.distribution,
            self.causes,
            self.shrinkage,
            self.proof,
            self.running,
            self.hint,
        ):
            self.views.addWidget(view)
        self.tabs = named(QTabBar(), tr("View"))
        self.tabs.setExpanding(False)
        self.tabs.setDrawBase(False)
        for number, name in enumerate(VIEWS):
            self.tabs.addTab(tr(name))
            self.tabs.setTabToolTip(number, tr(TIPS[number]))
        self.news = TabNews(self.tabs)
        self.headline = Headline([self.use], [self.twin, self.report, self.more])
        self.plan = QPushButton(tr("Play next experiment …"))
        self.plan.setToolTip(
            plain_tip(
                tr(
                    "Play the motion that best distinguishes the candidates, and diagnose its "
                    "record with the others"
                )
            )
        )
        self.cells = AxisCells(theme)

    def _lay_out(self) -> None:
        head = in_row(self.tabs, 1, self.plan, self.motion, spacing=8)
        self.setMaximumWidth(_WIDEST)
        in_column(self.headline, self.cells, head, (self.views, 1), on=self, margins=0, spacing=6)

    # --- what is shown ----------------------------------------------------------------------------

    def show_answer(self, answer: Answer) -> None:
        """Show a diagnosis, of which no motion has said anything yet."""
        self._answer = answer
        self.distribution.show_answer(answer)
        self.proof.show_proof(None)
        self.cells.show_answer(answer)
        self.headline.show_answer(answer, None)

    def show_proof(self, answer: Answer, proof: Proof) -> None:
        """Show the result of a new motion for a diagnosis."""
        self.proof.show_proof(proof)
        self.headline.show_answer(answer, proof)

    def turn_to_proof(self) -> None:
        """Turn to what a new motion will say, which the operator has just asked for."""
        self.tabs.setCurrentIndex(PROOF)

    def mark_proof(self) -> None:
        """Mark the tab of what a new motion says, until it is looked at."""
        self.news.mark(PROOF)

    def show_state(self, answer: Answer | None, chosen: int, *, running: bool) -> None:
        """Offer what can be done with an answer, while a diagnosis of ``chosen`` records runs."""
        why = tr(_NO_ANSWER) if answer is None else None
        found = unfound(answer)
        allow(self.twin, found, tr("Write a robot file of the model with the causes found"))
        allow(self.motion, found, tr("Play a motion that no record contains, and measure its gap"))
        allow(self.report, why, tr("Write the report with all figures, and open it"))
        allow(self.save, why, "")
        done = answer is not None and not running
        self.plan.setVisible(done and bool(answer and answer.diagnosis.experiments))
        self.tabs.setVisible(done)
        for widget in (self.headline, self.cells, self.motion):
            widget.setVisible(done)
        self.hint.setText(readiness(chosen))
        shown = self.tabs.currentIndex() if done else RUNNING if running else HINT
        self.views.setCurrentIndex(shown)

    def offer_use(self, why_not: str | None, doubt: str | None) -> None:
        """Offer the corrected model: after a question where there is a doubt about it."""
        said = tr(
            "Predictions only: commands to the machine do not change. The panel "
            "Compensation changes them."
        )
        self.use.setText(tr("Use anyway …") if doubt else tr("Use corrected model"))
        set_property(self.use, "primary", doubt is None)
        allow(self.use, why_not, "\n".join(filter(None, (doubt, said))))

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        for view in (
            self.distribution,
            self.causes,
            self.shrinkage,
            self.proof,
            self.running,
            self.cells,
        ):
            view.set_theme(theme)

    def _show_axis(self, axis: str) -> None:
        if self._answer is not None:
            self.causes.show_axis(self._answer, axis)
            self.shrinkage.show_axis(self._answer, axis)


def unfound(answer: Answer | None) -> str | None:
    """Return why there is no cause to do anything about; None: there is one."""
    if answer is None:
        return tr(_NO_ANSWER)
    return None if answer.diagnosis.fitted else tr("no effect was found")
