"""Choice of the profile in use; saving a changed one."""

from PySide6.QtGui import QStandardItemModel
from PySide6.QtWidgets import QLineEdit, QToolButton, QWidget

from rotemina.app.motion.teleoperation.input_arbiter import DevicesView
from rotemina.app.shell.engine_words import spoken
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.app.widgets.controls import allow, button, plain_tip
from rotemina.app.widgets.inline_question import Question
from rotemina.app.widgets.labels import show_text
from rotemina.app.widgets.layouts import in_row
from rotemina.app.widgets.section import Section
from rotemina.app.widgets.wheel_safe import SteadyChoice
from rotemina.plugins.inputs import mark, tr
from rotemina.plugins.inputs.profiles import AUTOMATIC, Offer, ProfileChoice

_FIRST = mark("save or discard the changes first")


class ProfileSection(Section):
    """The choice of a profile and, while input devices are set up, what becomes of changes."""

    def __init__(self, workbench: Workbench, profiles: ProfileChoice) -> None:
        super().__init__(tr("Profile"))
        self._workbench = workbench
        self.profiles = profiles
        self.choice = SteadyChoice(tr("Profile"), letters=8)
        self.again = QToolButton()
        self.again.setText("⟳")
        self.again.setAccessibleName(tr("Refresh the profiles"))
        self.again.setToolTip(tr("Read the folder of profiles again"))
        self.add_row(self.choice, self.again, equal=False)
        self.state = self.add_text()
        self.name = QLineEdit()
        self.name.setAccessibleName(tr("Name of the profile"))
        self.name.setToolTip(tr("Letters, digits, blanks and ( ) . , + - _; at most 60"))
        self.name.setMaxLength(60)
        self.save = button(tr("Save"), self._ask_save)
        self.save.setToolTip(tr("Save the profile under this name and use it from now on"))
        self.discard = button(tr("Discard"), self._discard)
        self.discard.setToolTip(tr("Discard the changes of the profile"))
        self.keeping = QWidget()
        in_row((self.name, 1), self.save, self.discard, on=self.keeping, margins=0, spacing=6)
        self.column.addWidget(self.keeping)
        self.question = Question()
        self.column.addWidget(self.question)
        self._offers: tuple[Offer, ...] = ()
        self.choice.activated.connect(lambda _: self._choose())
        self.again.clicked.connect(lambda _: self._fill(profiles.look()))
        self.name.returnPressed.connect(self._ask_save)
        self._suggested = ""
        self._fill(profiles.offers)

    def refresh(self, view: DevicesView) -> None:
        """Show what is used."""
        profiles = self.profiles
        self._fill(profiles.offers)
        self.choice.select(profiles.chosen)
        allow(
            self.choice, tr(_FIRST) if profiles.changed else None, tr("Functions of the controls")
        )
        show_text(self.state, _state(view, profiles))
        self.keeping.setVisible(view.setting_up)
        if not view.setting_up:
            self.question.hide()
            return
        self._suggest()
        nothing = (
            None if view.profile is not None else tr("there is no profile: map a control first")
        )
        allow(self.save, nothing, tr("Save the profile under this name and use it from now on"))
        unchanged = None if profiles.changed else tr("nothing was changed")
        allow(self.discard, unchanged, tr("Discard the changes of the profile"))

    def _suggest(self) -> None:
        """Write a name, unless someone has written one."""
        suggestion = self.profiles.suggestion()
        if suggestion != self._suggested and self.name.text() == self._suggested:
            self.name.setText(suggestion)
            self._suggested = suggestion

    def _fill(self, offers: tuple[Offer, ...]) -> None:
        if offers == self._offers:
            return
        self._offers = offers
        self.choice.clear()
        model = self.choice.model()
        assert isinstance(model, QStandardItemModel)
        for offer in offers:
            self.choice.addItem(offer.text, offer.name)
            item = model.item(self.choice.count() - 1)
            item.setEnabled(offer.problem is None)
            item.setToolTip(plain_tip(offer.problem or ""))
        self.choice.select(self.profiles.chosen)

    def _choose(self) -> None:
        name = str(self.choice.currentData())
        if not self._workbench.ask(lambda: self.profiles.choose(name)):
            self.choice.select(self.profiles.chosen)

    def _ask_save(self) -> None:
        name = self.name.text().strip()
        if name != self.profiles.chosen and self.profiles.exists(name):
            asked = tr("Profile {name!r} already exists. Overwrite it?")
            self.question.ask(asked.format(name=name), tr("Overwrite"), self._save)
        else:
            self._save()

    def _save(self) -> None:
        self.question.hide()
        name = self.name.text().strip()
        if self._workbench.ask(lambda: self.profiles.save(name)):
            self._suggested = name
            self._workbench.notify(
                Level.GOOD, tr("Input devices: profile {name!r} is saved.").format(name=name)
            )

    def _discard(self) -> None:
        self._workbench.ask(self.profiles.discard)


def _state(view: DevicesView, profiles: ProfileChoice) -> str:
    if profiles.changed:
        where = tr("save it") if view.setting_up else tr("set up, and save it")
        return tr(
            "Changed, but not saved: {where}, or the change is lost when the program ends."
        ).format(where=where)
    if profiles.chosen == AUTOMATIC and view.profile is not None:
        return tr("In use: {name}").format(name=spoken(view.profile.name))
    return ""
