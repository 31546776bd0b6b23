"""The Effects panel: switch and adjust the effects of the running simulator."""

from dataclasses import replace
from pathlib import Path

from PySide6.QtCore import QSignalBlocker, Qt
from PySide6.QtWidgets import QLabel, QMenu, QPushButton, QSizePolicy, QSplitter, QWidget

from rotemina.app.language import describe_error, get_axis_label, marked
from rotemina.app.motion.state import ConnectionState, SessionState
from rotemina.app.panel import (
    Panel,
    PanelArea,
    offer_in_palette,
)
from rotemina.app.shell.records import ask_file, ask_save_path
from rotemina.app.widgets.controls import (
    enable_unless,
    make_tooltip,
    name_widget,
    set_property,
)
from rotemina.app.widgets.layout import make_column, make_row
from rotemina.app.widgets.text import make_plain_label
from rotemina.app.workbench import Level, Workbench
from rotemina.plugins.effects import mark, tr
from rotemina.plugins.effects.chosen_effects import ChosenEffects, with_formulation, with_value
from rotemina.plugins.effects.editor import EffectEditor
from rotemina.plugins.effects.effect_table import EffectTable
from rotemina.plugins.effects.live_changes import ApplyState, Effects, LiveEffects
from rotemina.plugins.effects.menu import fill_effect_menu
from rotemina.plugins.effects.words import effect_title, format_name
from rotemina.sim.effects import Effect, Formulation, load_all_effects
from rotemina.sim.errors import InputError
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot, write_robot
from rotemina.sim.trajectory import load_worn_effects

ONLY_SIMULATOR_TEXT = mark(
    "Only the simulator has adjustable effects. Connect to the simulator to switch and adjust them."
)
ROBOT_FILE_FILTER = mark("Robot files (*.toml)")
MAX_UNDO_STEPS = 100


class EffectsPanel(Panel):
    """Panel with the list of effects and an editor for the chosen one."""

    title = marked("panels", "Effects")
    area = PanelArea.BOTTOM
    order = 40
    help_page = "effects.md#in-the-window"

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self.chain = ChosenEffects(workbench.robot)
        self.chosen_index = -1
        self._is_real = False
        # Effect index and parameter name, if the last change was one of a parameter value.
        self._last_tuned: tuple[int, str] | None = None
        self._undo_stack: list[ChosenEffects] = []
        self._make_buttons()
        self.table, self.editor = EffectTable(), EffectEditor(workbench.robot)
        self.status = make_plain_label(quiet=False)
        # The text may be long; the notice and the tooltip show all of it.
        self.status.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self.left_out = QLabel()
        self._lay_out()
        self._offer_effects()
        self._offer_machines()
        self.live = LiveEffects(workbench.session, self)
        self._connect()
        offer_in_palette(self.all_off, self.undo, self.load)
        offer_in_palette(self.save, safe_while_hidden=True)
        self._adopt(workbench.session.service.effects)

    def _make_buttons(self) -> None:
        self.add = QPushButton(tr("Add effect"))
        self.add.setToolTip(tr("Choose an axis, an effect and its formulation"))
        self.machine = QPushButton(tr("Machine"))
        self.machine.setToolTip(
            tr("Simulate the machine of the robot file, or a worn one for demonstration")
        )
        self.up = _make_button("▲", tr("Apply this effect earlier within its stage"))
        self.down = _make_button("▼", tr("Apply this effect later within its stage"))
        self.remove = _make_button(tr("Remove"), tr("Remove this effect"))
        self.undo = _make_button(tr("Undo"), tr("Undo the last change of this list"))
        self.all_off = _make_button(
            tr("All off"),
            tr("Compare with the nominal machine: disable all effects until this is released"),
        )
        self.all_off.setCheckable(True)
        self.load = _make_button(tr("Load …"), tr("Replace these effects by those of a robot file"))
        self.save = _make_button(
            tr("Save robot …"), tr("Save a robot file of this robot with these effects")
        )

    def _lay_out(self) -> None:
        changes = self.add, self.up, self.down, self.remove, self.undo, self.all_off
        files = self.left_out, self.load, self.save
        buttons = make_row(self.machine, *changes, (self.status, 1), *files, spacing=6)
        split = QSplitter(Qt.Orientation.Horizontal)
        split.addWidget(self.table)
        split.addWidget(self.editor)
        split.setSizes([450, 500])
        self._body = QWidget()
        make_column(buttons, (split, 1), on=self._body, margins=(10, 8, 10, 8))
        make_column(self._body, on=self, margins=0)

    def _offer_effects(self) -> None:
        effects, broken = load_all_effects()
        menu = QMenu(self.add)
        fill_effect_menu(menu, self.workbench.robot, effects, broken, self.add_effect)
        self.add.setMenu(menu)
        self.left_out.setVisible(bool(broken))
        self.left_out.setText(tr("{n} left out").format(n=len(broken)))
        self.left_out.setToolTip(
            make_tooltip(tr("Effects that cannot be loaded:"), *broken.values())
        )

    def _offer_machines(self) -> None:
        robot = self.workbench.robot
        menu = QMenu(self.machine)
        menu.addAction(tr("From the robot file"), lambda: self.use_effects(robot.effects))
        worn_action = menu.addAction(
            tr("Worn, for demonstration"), lambda: self.use_effects(load_worn_effects(robot))
        )
        menu.setToolTipsVisible(True)
        unavailable_reason = (
            None if load_worn_effects(robot) else tr("there are no such effects for this robot")
        )
        enable_unless(
            worn_action, unavailable_reason, tr("Effects of a machine after years of use")
        )
        self.machine.setMenu(menu)

    def _connect(self) -> None:
        self.up.clicked.connect(lambda: self._move(-1))
        self.down.clicked.connect(lambda: self._move(+1))
        self.remove.clicked.connect(self._remove)
        self.undo.clicked.connect(self._undo)
        self.all_off.toggled.connect(lambda _: self._apply())
        self.load.clicked.connect(self._ask_load)
        self.save.clicked.connect(self._ask_save)
        self.table.chosen.connect(self._choose)
        self.table.switched.connect(self._switch)
        self.editor.value_changed.connect(self._tune)
        self.editor.value_refused.connect(self._refuse)
        self.editor.formulation_chosen.connect(
            lambda name: self._change(with_formulation(self.chain.effects[self.chosen_index], name))
        )
        self.editor.source_chosen.connect(
            lambda axis: self._change(
                replace(self.chain.requests[self.chosen_index], from_axis=axis)
            )
        )
        self.live.changed.connect(self._show_apply_state)
        self.live.refused.connect(lambda text: self.workbench.refuse(text, about=self))
        self.live.replaced.connect(self._adopt)
        self.follow(self._refresh)
        self.workbench.theme_changed.connect(lambda _: self._show())

    def add_effect(self, axis: str, effect: Effect, formulation: Formulation) -> None:
        """Add an effect with its presets to an axis."""
        others = [name for name in self.workbench.robot.axes if name != axis]
        is_default = formulation is effect.formulations[0]
        request = AxisEffect(
            axis=axis,
            id=effect.id,
            formulation=None if is_default else formulation.name,
            from_axis=others[0] if effect.coupled else None,
        )
        chain, self.chosen_index = self.chain.with_effect(request)
        self._use_chain(chain)

    def _remove(self) -> None:
        chain = self.chain.without_effect(self.chosen_index)
        self.chosen_index = min(self.chosen_index, len(chain) - 1)
        self._use_chain(chain)

    def _move(self, step: int) -> None:
        neighbour = self.chain.find_neighbour(self.chosen_index, step)
        if neighbour is not None:
            chain, self.chosen_index = self.chain.with_swap(self.chosen_index, neighbour), neighbour
            self._use_chain(chain)

    def _choose(self, index: int) -> None:
        self.chosen_index = index
        self._show_chosen()

    def _switch(self, index: int, on: bool) -> None:
        """Switch an effect on or off.

        If "All off" is pressed, release it, but leave the other effects off.
        """
        self.chosen_index = index
        if self.all_off.isChecked():
            with QSignalBlocker(self.all_off):
                self.all_off.setChecked(False)
            chain = ChosenEffects.from_effects(self.workbench.robot, self.chain.disabled_requests)
            self._use_chain(
                chain.with_replacement(index, replace(self.chain.requests[index], enabled=on))
            )
        else:
            self._change(replace(self.chain.requests[index], enabled=on))

    def _tune(self, name: str, value: float) -> None:
        self._change(with_value(self.chain.effects[self.chosen_index], name, value), tuned=name)

    def _refuse(self, name: str, reason: str) -> None:
        attached = self.chain.effects[self.chosen_index]
        title = f"{get_axis_label(attached.entry.axis)} {effect_title(attached.effect)}"
        self.workbench.refuse(f"{title}, {format_name(name)}: {reason}", about=self)

    def _undo(self) -> None:
        self.chain, self._last_tuned = self._undo_stack.pop(), None
        self.chosen_index = min(max(self.chosen_index, 0), len(self.chain) - 1)
        self._apply()

    def _change(self, request: AxisEffect, *, tuned: str | None = None) -> None:
        try:
            chain = self.chain.with_replacement(self.chosen_index, request)
        except InputError as error:
            self.workbench.notify(Level.ERROR, describe_error(error), about=error)
            self._show()
            return
        self._use_chain(chain, tuned)

    def use_effects(self, effects: tuple[AxisEffect, ...]) -> None:
        """Replace all effects of the simulated machine."""
        self.chosen_index = 0 if effects else -1
        self._use_chain(ChosenEffects.from_effects(self.workbench.robot, effects))

    def load_effects(self, path: Path) -> None:
        """Replace all effects by those of a robot file."""

        def read_effects() -> ChosenEffects:
            effects = load_robot(path).effects
            if not effects:
                text = tr("{path}: the robot file has no effects; the list is unchanged")
                raise InputError(text.format(path=path))
            return ChosenEffects.from_effects(self.workbench.robot, effects)

        def on_loaded(chain: ChosenEffects) -> None:
            self.chosen_index = 0
            self._use_chain(chain)

        self.workbench.read_file("load effects", path.name, read_effects, on_loaded)

    def save_robot(self, path: Path) -> None:
        """Write a robot file of the robot with its effects. An existing file is overwritten."""
        robot = replace(self.workbench.robot, effects=self.chain.requests)
        self.workbench.write_file(
            "save robot", path, lambda: write_robot(robot, path, overwrite=True)
        )

    def _ask_load(self) -> None:
        title = tr("Load effects from a robot file")
        ask_file(self, self.workbench, title, tr(ROBOT_FILE_FILTER), self.load_effects)

    def _ask_save(self) -> None:
        title = tr("Save the robot with its effects")
        ask_save_path(
            self, self.workbench, title, tr(ROBOT_FILE_FILTER), "robot.toml", self.save_robot
        )

    def _use_chain(self, chain: ChosenEffects, tuned: str | None = None) -> None:
        """Make these the current effects, show them, and apply them to the simulator.

        ``tuned`` is the parameter whose value was changed, if this was the only change.
        """
        tuned_parameter = None if tuned is None else (self.chosen_index, tuned)
        # Successive changes of one value, as when a slider is dragged, are undone in one step.
        if tuned_parameter is None or tuned_parameter != self._last_tuned:
            self._push_undo_step()
        self.chain, self._last_tuned = chain, tuned_parameter
        self._apply()

    def _push_undo_step(self) -> None:
        self._undo_stack = [*self._undo_stack[1 - MAX_UNDO_STEPS :], self.chain]

    def _apply(self) -> None:
        self._show()
        self.live.request(
            self.chain.disabled_requests if self.all_off.isChecked() else self.chain.requests
        )

    def _adopt(self, effects: Effects | None) -> None:
        """Show effects that were set elsewhere. None means that the device is a real machine."""
        self._is_real = effects is None
        # The panel must be disabled at once, and not only with the next state of the machine.
        if self._is_real:
            enable_unless(self._body, tr(ONLY_SIMULATOR_TEXT), "")
        if len(self.chain):
            self._push_undo_step()
        self.chain, self._last_tuned = (
            ChosenEffects.from_effects(self.workbench.robot, effects or ()),
            None,
        )
        self.chosen_index = min(max(self.chosen_index, 0), len(self.chain) - 1)
        self.all_off.blockSignals(True)
        self.all_off.setChecked(False)
        self.all_off.blockSignals(False)
        self._show()

    def _refresh(self, state: SessionState) -> None:
        objection = tr(ONLY_SIMULATOR_TEXT) if self._is_real else None
        if state.connection is not ConnectionState.CONNECTED:
            objection = tr("no device is connected")
        enable_unless(self._body, objection, "")
        self.live.refresh(state)

    def _show(self) -> None:
        self.table.show_effects(
            self.chain, self.chosen_index, self.workbench.theme, all_off=self.all_off.isChecked()
        )
        self._show_chosen()
        self._show_apply_state()

    def _show_chosen(self) -> None:
        has_choice = 0 <= self.chosen_index < len(self.chain)
        self.editor.show_effect(
            self.chain.effects[self.chosen_index] if has_choice else None, self.chosen_index
        )
        no_choice_reason = None if has_choice else tr("no effect is chosen")
        enable_unless(self.remove, no_choice_reason, tr("Remove this effect"))
        no_undo_reason = None if self._undo_stack else tr("nothing was changed")
        enable_unless(self.undo, no_undo_reason, tr("Undo the last change of this list"))
        for button, step, tooltip in (
            (self.up, -1, tr("Apply this effect earlier within its stage")),
            (self.down, +1, tr("Apply this effect later within its stage")),
        ):
            is_last = has_choice and self.chain.find_neighbour(self.chosen_index, step) is None
            last_reason = (
                tr("the stage has no further effect in this direction") if is_last else None
            )
            enable_unless(button, no_choice_reason or last_reason, tooltip)

    def _show_apply_state(self) -> None:
        self._mark_fields()
        if self._is_real:
            self._show_status(tr(ONLY_SIMULATOR_TEXT))
        elif self.live.apply_state is ApplyState.REFUSED:
            self._show_status(tr("Not applied: {reason}").format(reason=self.live.reason), bad=True)
        elif self.live.apply_state is ApplyState.PREPARING:
            self._show_status(tr("preparing …"))
        else:
            self._show_status(self._format_count())

    def _mark_fields(self) -> None:
        if self.live.apply_state is ApplyState.APPLIED:
            for field in self.editor.fields.values():
                field.unmark_if_applied()
        elif self.live.apply_state is ApplyState.REFUSED and self._last_tuned is not None:
            index, name = self._last_tuned
            if index == self.chosen_index and name in self.editor.fields:
                self.editor.fields[name].set_not_applied(True)

    def _format_count(self) -> str:
        if not len(self.chain):
            return tr("No effects: nominal")
        on_count = sum(request.enabled for request in self.chain.requests)
        state = tr("all off") if self.all_off.isChecked() else tr("{n} on").format(n=on_count)
        singular, plural = tr("1 effect, {state}"), tr("{n} effects, {state}")
        return (plural if len(self.chain) > 1 else singular).format(n=len(self.chain), state=state)

    def _show_status(self, text: str, *, bad: bool = False) -> None:
        self.status.setText(text)
        self.status.setToolTip(make_tooltip(text))
        set_property(self.status, "bad", bad)


def _make_button(text: str, tooltip: str) -> QPushButton:
    # A single symbol is no name for a screen reader, so the tooltip is used instead.
    return name_widget(QPushButton(text), tooltip if len(text) == 1 else text, tooltip)
