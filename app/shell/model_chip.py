"""The chip in the header that says which model predictions are made with."""

from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QFont, QFontInfo, QFontMetrics
from PySide6.QtWidgets import QMenu, QToolButton

from rotemina.app.display_units import label
from rotemina.app.motion.model_in_use import ModelInUse
from rotemina.app.motion.state import SessionState
from rotemina.app.shell.language import translate
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.controls import plain_tip, set_property
from rotemina.sim.gap.output.report.words import effect_title

_MOST_EFFECTS = 2  # that are named
_ROOM = 44  # of margins and the arrow of a menu
_WIDEST, _TEXT = 280, 13  # px at text of so many px: with that it is smaller than the stop button


class ModelChip(QToolButton):
    """Grey: the nominal model; blue: a corrected one, with the way back in its menu."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self.setObjectName("model")
        self.setAccessibleName(translate("shell", "Model in use"))
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextOnly)
        self._workbench = workbench
        self._name = ""
        self._told: tuple[str, tuple[str, ...]] | None = None
        menu = QMenu(self)
        self.back = menu.addAction(
            translate("shell", "Back to nominal"), workbench.use_nominal_model
        )
        self.setMenu(menu)
        self.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self._show(workbench.session.model, ())

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 (Qt's name)
        """Take the width of the text in another size."""
        super().changeEvent(event)
        if event.type() in (QEvent.Type.FontChange, QEvent.Type.StyleChange):
            self._fit()

    def refresh(self, state: SessionState) -> None:
        """Show which model is in use, and of which axes it does not know the past."""
        model = self._workbench.session.model
        if (model.id, state.unsettled) != self._told:
            self._show(model, state.unsettled)
        resting = self._workbench.session.at_rest
        if self.back.isEnabled() is not (model.corrected and resting):
            self.back.setEnabled(model.corrected and resting)

    def _show(self, model: ModelInUse, unsettled: tuple[str, ...]) -> None:
        self._told = model.id, unsettled
        self._name = model_name(model) + (" ≈" if unsettled else "")
        set_property(self, "corrected", model.corrected)
        self._fit()
        lines = [
            translate("shell", "The model that plots, comparison, dry run and 3-D view use."),
            translate(
                "shell",
                "Predictions only: commands to the machine do not change. The panel "
                "Compensation changes them.",
            ),
        ]
        lines += [f"{label(one.axis)}: {_title(one.id)}" for one in model.effects]
        if unsettled:
            lines.append(
                translate(
                    "shell",
                    "≈ The history of {axes} is unknown: until it has swept its range, the "
                    "model may be off by the band in the plots.",
                ).format(axes=", ".join(map(label, unsettled)))
            )
        self.setToolTip(plain_tip(self._name, *lines, model.id))

    def _fit(self) -> None:
        """Show as much of the name as there is room for; the tooltip has all of it."""
        font = QFont(self.font())
        font.setBold(True)
        metrics, room = QFontMetrics(font), _WIDEST * QFontInfo(font).pixelSize() // _TEXT - _ROOM
        text = metrics.elidedText(self._name, Qt.TextElideMode.ElideRight, room)
        self.setText(text)
        self.setFixedWidth(metrics.horizontalAdvance(text) + _ROOM)


def model_name(model: ModelInUse) -> str:
    """Return what a model is called: nominal, or corrected and by what."""
    if not model.corrected:
        return translate("shell", "Nominal model")
    names = list(dict.fromkeys(_title(one.id) for one in model.effects))
    listed = ", ".join(names[:_MOST_EFFECTS])
    if len(names) > _MOST_EFFECTS:
        listed += f" +{len(names) - _MOST_EFFECTS}"
    return translate("shell", "Corrected: {effects}").format(effects=listed)


def _title(effect: str) -> str:
    return translate("effects", effect_title(effect))
