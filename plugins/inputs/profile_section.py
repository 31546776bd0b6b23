"""Section with the choice of the profile, and the buttons that save or discard changes."""

from PySide6.QtGui import QStandardItemModel
from PySide6.QtWidgets import QLineEdit, QToolButton, QWidget

from rotemina.app.language import translate_message
from rotemina.app.motion.inputs import InputDisplayState
from rotemina.app.widgets.controls import (
    WheelSafeComboBox,
    enable_unless,
    make_button,
    make_tooltip,
)
from rotemina.app.widgets.layout import InlineQuestion, Section, make_row
from rotemina.app.widgets.text import show_or_hide_text
from rotemina.app.workbench import Level, Workbench
from rotemina.plugins.inputs import mark, tr
from rotemina.plugins.inputs.profiles import AUTOMATIC_PROFILE, ProfileChoice, ProfileOption

_UNSAVED_CHANGES = mark("save or discard the changes first")


class ProfileSection(Section):
    """Section with the choice of a profile. In the set-up, changes can be saved or discarded."""

    def __init__(self, workbench: Workbench, profiles: ProfileChoice) -> None:
        super().__init__(tr("Profile"))
        self._workbench = workbench
        self.profiles = profiles
        self.choice = WheelSafeComboBox(tr("Profile"), letters=8)
        self.refresh_button = QToolButton()
        self.refresh_button.setText("⟳")
        self.refresh_button.setAccessibleName(tr("Refresh the profiles"))
        self.refresh_button.setToolTip(tr("Read the folder of profiles again"))
        self.add_row(self.choice, self.refresh_button, equal=False)
        self.state = self.add_text()
        self.name = QLineEdit()
        self.name.setAccessibleName(tr("Name of the profile"))
        self.name.setToolTip(tr("Letters, digits, blanks and ( ) . , + - _; at most 60"))
        self.name.setMaxLength(60)
        self.save_button = make_button(tr("Save"), self._ask_to_save)
        self.save_button.setToolTip(tr("Save the profile under this name and use it from now on"))
        self.discard_button = make_button(tr("Discard"), self._discard_changes)
        self.discard_button.setToolTip(tr("Discard the changes of the profile"))
        self.save_row = QWidget()
        make_row(
            (self.name, 1),
            self.save_button,
            self.discard_button,
            on=self.save_row,
            margins=0,
            spacing=6,
        )
        self.column.addWidget(self.save_row)
        self.question = InlineQuestion()
        self.column.addWidget(self.question)
        self._options: tuple[ProfileOption, ...] = ()
        self.choice.activated.connect(lambda _: self._choose_profile())
        self.refresh_button.clicked.connect(lambda _: self._fill_choice(profiles.read_options()))
        self.name.returnPressed.connect(self._ask_to_save)
        self._suggested_name = ""
        self._fill_choice(profiles.options)

    def refresh(self, view: InputDisplayState) -> None:
        """Show the profile in use."""
        profiles = self.profiles
        self._fill_choice(profiles.options)
        self.choice.select(profiles.chosen)
        enable_unless(
            self.choice,
            tr(_UNSAVED_CHANGES) if profiles.is_changed else None,
            tr("Functions of the controls"),
        )
        show_or_hide_text(self.state, _describe_state(view, profiles))
        self.save_row.setVisible(view.is_mapping_open)
        if not view.is_mapping_open:
            self.question.hide()
            return
        self._suggest_name()
        no_profile_reason = (
            None if view.profile is not None else tr("there is no profile: map a control first")
        )
        enable_unless(
            self.save_button,
            no_profile_reason,
            tr("Save the profile under this name and use it from now on"),
        )
        unchanged_reason = None if profiles.is_changed else tr("nothing was changed")
        enable_unless(
            self.discard_button, unchanged_reason, tr("Discard the changes of the profile")
        )

    def _suggest_name(self) -> None:
        """Suggest a name unless the operator has typed one."""
        suggestion = self.profiles.suggest_name()
        if suggestion != self._suggested_name and self.name.text() == self._suggested_name:
            self.name.setText(suggestion)
            self._suggested_name = suggestion

    def _fill_choice(self, options: tuple[ProfileOption, ...]) -> None:
        if options == self._options:
            return
        self._options = options
        self.choice.clear()
        model = self.choice.model()
        assert isinstance(model, QStandardItemModel)
        for option in options:
            self.choice.addItem(option.text, option.name)
            item = model.item(self.choice.count() - 1)
            item.setEnabled(option.problem is None)
            item.setToolTip(make_tooltip(option.problem or ""))
        self.choice.select(self.profiles.chosen)

    def _choose_profile(self) -> None:
        name = str(self.choice.currentData())
        if not self._workbench.run_request(lambda: self.profiles.choose_profile(name)):
            self.choice.select(self.profiles.chosen)

    def _ask_to_save(self) -> None:
        name = self.name.text().strip()
        if name != self.profiles.chosen and self.profiles.has_profile(name):
            question = tr("Profile {name!r} already exists. Overwrite it?")
            self.question.ask(question.format(name=name), tr("Overwrite"), self._save_profile)
        else:
            self._save_profile()

    def _save_profile(self) -> None:
        self.question.hide()
        name = self.name.text().strip()
        if self._workbench.run_request(lambda: self.profiles.save(name)):
            self._suggested_name = name
            self._workbench.notify(
                Level.GOOD, tr("Input devices: profile {name!r} is saved.").format(name=name)
            )

    def _discard_changes(self) -> None:
        self._workbench.run_request(self.profiles.discard)


def _describe_state(view: InputDisplayState, profiles: ProfileChoice) -> str:
    if profiles.is_changed:
        remedy = tr("save it") if view.is_mapping_open else tr("set up, and save it")
        return tr(
            "Changed, but not saved: {where}, or the change is lost when the program ends."
        ).format(where=remedy)
    if profiles.chosen == AUTOMATIC_PROFILE and view.profile is not None:
        return tr("In use: {name}").format(name=translate_message(view.profile.name))
    return ""
