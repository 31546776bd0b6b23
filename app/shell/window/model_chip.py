"""The chip in the header that shows which model makes the predictions."""

from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QFont, QFontInfo, QFontMetrics
from PySide6.QtWidgets import QMenu, QToolButton

from rotemina.app.language import get_axis_label, translate
from rotemina.app.motion.model import ModelInUse
from rotemina.app.motion.state import SessionState
from rotemina.app.widgets.controls import make_tooltip, set_property
from rotemina.app.workbench import Workbench
from rotemina.sim.gap.output import localize_effect_title

_MAX_NAMED_EFFECTS = 2
# Space for the margins and the arrow of the menu.
_PADDING_PX = 44
# The maximum width at a text size of 13 px. It keeps the chip smaller than the stop button.
_MAX_WIDTH_PX, _NORMAL_TEXT_PX = 280, 13


class ModelChip(QToolButton):
    """Chip for the model in use: grey if nominal, blue if corrected.

    Its menu returns to the nominal model.
    """

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self.setObjectName("model")
        self.setAccessibleName(translate("shell", "Model in use"))
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextOnly)
        self._workbench = workbench
        self._name = ""
        self._shown_state: tuple[str, tuple[str, ...]] | None = None
        menu = QMenu(self)
        self.back = menu.addAction(
            translate("shell", "Back to nominal"), workbench.machine.use_nominal_model
        )
        self.setMenu(menu)
        self.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self._show(workbench.session.model, ())

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 (Qt's name)
        """Fit the width when the text size changes."""
        super().changeEvent(event)
        if event.type() in (QEvent.Type.FontChange, QEvent.Type.StyleChange):
            self._fit()

    def refresh(self, state: SessionState) -> None:
        """Show the model in use, and whether it does not know the history of some axes."""
        model = self._workbench.session.model
        if (model.id, state.unsettled) != self._shown_state:
            self._show(model, state.unsettled)
        is_at_rest = self._workbench.session.at_rest
        if self.back.isEnabled() is not (model.is_corrected and is_at_rest):
            self.back.setEnabled(model.is_corrected and is_at_rest)

    def _show(self, model: ModelInUse, unsettled: tuple[str, ...]) -> None:
        self._shown_state = model.id, unsettled
        self._name = describe_model(model) + (" ≈" if unsettled else "")
        set_property(self, "corrected", model.is_corrected)
        self._fit()
        lines = [
            translate("shell", "The model that plots, comparison, dry run and 3-D view use."),
            translate(
                "shell",
                "Predictions only: commands to the machine do not change. The panel "
                "Compensation changes them.",
            ),
        ]
        lines += [
            f"{get_axis_label(effect.axis)}: {_translate_effect(effect.id)}"
            for effect in model.effects
        ]
        if unsettled:
            lines.append(
                translate(
                    "shell",
                    "≈ The history of {axes} is unknown: until it has swept its range, the "
                    "model may be off by the band in the plots.",
                ).format(axes=", ".join(map(get_axis_label, unsettled)))
            )
        self.setToolTip(make_tooltip(self._name, *lines, model.id))

    def _fit(self) -> None:
        font = QFont(self.font())
        font.setBold(True)
        metrics, text_width = (
            QFontMetrics(font),
            _MAX_WIDTH_PX * QFontInfo(font).pixelSize() // _NORMAL_TEXT_PX - _PADDING_PX,
        )
        text = metrics.elidedText(self._name, Qt.TextElideMode.ElideRight, text_width)
        self.setText(text)
        self.setFixedWidth(metrics.horizontalAdvance(text) + _PADDING_PX)


def describe_model(model: ModelInUse) -> str:
    """Return the name of a model: nominal, or corrected with its effects."""
    if not model.is_corrected:
        return translate("shell", "Nominal model")
    names = list(dict.fromkeys(_translate_effect(effect.id) for effect in model.effects))
    text = ", ".join(names[:_MAX_NAMED_EFFECTS])
    if len(names) > _MAX_NAMED_EFFECTS:
        text += f" +{len(names) - _MAX_NAMED_EFFECTS}"
    return translate("shell", "Corrected: {effects}").format(effects=text)


def _translate_effect(effect_id: str) -> str:
    return translate("effects", localize_effect_title(effect_id))
