"""Run, operator and sample: typed once, they stand in every playback and recording to come."""

from PySide6.QtWidgets import QGridLayout, QLabel, QLineEdit, QWidget

from rotemina.app.motion.run_labels import MOST_LETTERS, RunLabels
from rotemina.app.shell.language import translate
from rotemina.app.shell.workbench import Workbench


class LabelFields(QWidget):
    """Three fields, one below the other; what is typed counts from Enter or the next field on."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._library = workbench.library
        self.run, self.operator, self.sample = QLineEdit(), QLineEdit(), QLineEdit()
        named = {
            translate("recorder", "Run"): self.run,
            translate("recorder", "Operator"): self.operator,
            translate("recorder", "Sample"): self.sample,
        }
        grid = QGridLayout(self)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setHorizontalSpacing(10)
        grid.setVerticalSpacing(2)
        for row, (name, field) in enumerate(named.items()):
            title = QLabel(name)
            title.setProperty("quiet", True)
            title.setBuddy(field)
            field.setAccessibleName(name)
            field.setMaxLength(MOST_LETTERS)
            field.setToolTip(
                translate("recorder", "Stored with every playback and recording from now on")
            )
            field.editingFinished.connect(self._use)
            grid.addWidget(title, row, 0)
            grid.addWidget(field, row, 1)
        self._library.labels_changed.connect(self._show)
        self._show()

    def _use(self) -> None:
        typed = (field.text() for field in (self.run, self.operator, self.sample))
        self._library.use_labels(RunLabels.typed(*typed))

    def _show(self) -> None:
        labels = self._library.labels
        self.run.setText(labels.run)
        self.operator.setText(labels.operator)
        self.sample.setText(labels.sample)
