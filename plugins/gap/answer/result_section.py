"""Section with the result of a diagnosis: headline, axis cards, views and buttons."""

from PySide6.QtWidgets import QMenu, QPushButton, QStackedWidget, QTabBar, QToolButton, QWidget

from rotemina.app.widgets.controls import (
    TabNews,
    enable_unless,
    make_tooltip,
    name_widget,
    set_property,
)
from rotemina.app.widgets.layout import make_column, make_row
from rotemina.app.widgets.style import Theme
from rotemina.app.widgets.text import make_hint
from rotemina.plugins.gap import mark, tr
from rotemina.plugins.gap.answer.axis_cards import AxisCards
from rotemina.plugins.gap.answer.causes_view import CausesView
from rotemina.plugins.gap.answer.diagnosis_answer import DiagnosisAnswer
from rotemina.plugins.gap.answer.distribution_view import DistributionView
from rotemina.plugins.gap.answer.headline_view import HeadlineView
from rotemina.plugins.gap.answer.progress_view import ProgressView
from rotemina.plugins.gap.answer.shrinkage_view import ShrinkageView
from rotemina.plugins.gap.answer.unseen_motion_reduction import UnseenMotionResult
from rotemina.plugins.gap.answer.unseen_motion_view import UnseenMotionView
from rotemina.plugins.gap.answer.verdict_advice import describe_next_step

VIEW_TITLES = (mark("Where"), mark("Which effect"), mark("How far"), mark("Unseen motion"))
WHERE_INDEX, WHICH_INDEX, SHRINKAGE_INDEX, UNSEEN_MOTION_INDEX, RUNNING_INDEX, HINT_INDEX = range(6)
VIEW_TOOLTIPS = (
    mark("Axis, channel, frequencies and kind of motion in which the gap lies"),
    mark("Candidates with their probabilities, explanation and advice"),
    mark("How far the gap shrinks with the causes, down to the noise floor"),
    mark("How far it shrinks on a motion that the diagnosis has not seen"),
)

# In a wider section, the lines of text would be too long to read easily.
_MAX_WIDTH_PX = 1400
_NO_ANSWER = mark("there is no diagnosis yet; diagnose records first")


class ResultSection(QWidget):
    """Main column of the page. The panel connects its buttons."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._answer: DiagnosisAnswer | None = None
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
        # The tooltips explain why an entry cannot be chosen.
        menu.setToolTipsVisible(True)
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
        self.unseen_motion, self.running = UnseenMotionView(theme), ProgressView(theme)
        self.hint = make_hint(describe_next_step(0))
        self.views = QStackedWidget()
        for view in (
            self.distribution,
            self.causes,
            self.shrinkage,
            self.unseen_motion,
            self.running,
            self.hint,
        ):
            self.views.addWidget(view)
        self.tabs = name_widget(QTabBar(), tr("View"))
        self.tabs.setExpanding(False)
        self.tabs.setDrawBase(False)
        for index, (name, tooltip) in enumerate(zip(VIEW_TITLES, VIEW_TOOLTIPS, strict=True)):
            self.tabs.addTab(tr(name))
            self.tabs.setTabToolTip(index, tr(tooltip))
        self.news = TabNews(self.tabs)
        self.headline = HeadlineView([self.use], [self.twin, self.report, self.more])
        self.plan = QPushButton(tr("Play next experiment …"))
        self.plan.setToolTip(
            make_tooltip(
                tr(
                    "Play the motion that best distinguishes the candidates, and diagnose its "
                    "record with the others"
                )
            )
        )
        self.cells = AxisCards(theme)

    def _lay_out(self) -> None:
        tab_row = make_row(self.tabs, 1, self.plan, self.motion, spacing=8)
        self.setMaximumWidth(_MAX_WIDTH_PX)
        make_column(
            self.headline, self.cells, tab_row, (self.views, 1), on=self, margins=0, spacing=6
        )

    def show_answer(self, answer: DiagnosisAnswer) -> None:
        """Show a new diagnosis, and clear the results of unseen motions."""
        self._answer = answer
        self.distribution.show_answer(answer)
        self.unseen_motion.show_result(None)
        self.cells.show_answer(answer)
        self.headline.show_answer(answer, None)

    def show_unseen_motion(self, answer: DiagnosisAnswer, proof: UnseenMotionResult) -> None:
        """Show the result of a new motion."""
        self.unseen_motion.show_result(proof)
        self.headline.show_answer(answer, proof)

    def open_unseen_motion_tab(self) -> None:
        """Open the tab of the unseen motion, which the operator has just requested."""
        self.tabs.setCurrentIndex(UNSEEN_MOTION_INDEX)

    def mark_unseen_motion_tab(self) -> None:
        """Mark the tab of the unseen motion until the operator opens it."""
        self.news.mark(UNSEEN_MOTION_INDEX)

    def show_state(self, answer: DiagnosisAnswer | None, chosen: int, *, running: bool) -> None:
        """Enable or disable the buttons, and show the result, the progress or a hint.

        Parameters
        ----------
        answer : the current answer, if any.
        chosen : number of chosen records.
        running : whether a diagnosis is running.
        """
        no_answer_reason = tr(_NO_ANSWER) if answer is None else None
        no_cause_reason = explain_no_cause(answer)
        enable_unless(
            self.twin, no_cause_reason, tr("Write a robot file of the model with the causes found")
        )
        enable_unless(
            self.motion,
            no_cause_reason,
            tr("Play a motion that no record contains, and measure its gap"),
        )
        enable_unless(
            self.report, no_answer_reason, tr("Write the report with all figures, and open it")
        )
        enable_unless(self.save, no_answer_reason, "")
        has_result = answer is not None and not running
        self.plan.setVisible(has_result and bool(answer and answer.diagnosis.experiments))
        self.tabs.setVisible(has_result)
        for widget in (self.headline, self.cells, self.motion):
            widget.setVisible(has_result)
        self.hint.setText(describe_next_step(chosen))
        index = self.tabs.currentIndex() if has_result else RUNNING_INDEX if running else HINT_INDEX
        self.views.setCurrentIndex(index)

    def offer_use(self, unavailable_reason: str | None, objection: str | None) -> None:
        """Offer the corrected model, or show why it is unavailable.

        With an objection to the model, its use needs a confirmation.
        """
        note = tr(
            "Predictions only: commands to the machine do not change. The panel "
            "Compensation changes them."
        )
        self.use.setText(tr("Use anyway …") if objection else tr("Use corrected model"))
        set_property(self.use, "primary", objection is None)
        enable_unless(self.use, unavailable_reason, "\n".join(filter(None, (objection, note))))

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        for view in (
            self.distribution,
            self.causes,
            self.shrinkage,
            self.unseen_motion,
            self.running,
            self.cells,
        ):
            view.set_theme(theme)

    def _show_axis(self, axis: str) -> None:
        if self._answer is not None:
            self.causes.show_axis(self._answer, axis)
            self.shrinkage.show_axis(self._answer, axis)


def explain_no_cause(answer: DiagnosisAnswer | None) -> str | None:
    """Return why there is no cause to correct, or None if there is one."""
    if answer is None:
        return tr(_NO_ANSWER)
    return None if answer.diagnosis.fitted else tr("no effect was found")
