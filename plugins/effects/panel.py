"""Effects of the running simulator: switch and tune them, live."""

from dataclasses import replace
from pathlib import Path

from PySide6.QtCore import QSignalBlocker, Qt
from PySide6.QtWidgets import QLabel, QMenu, QPushButton, QSizePolicy, QSplitter, QWidget

from rotemina.app.display_units import label
from rotemina.app.motion.state import Connection, SessionState
from rotemina.app.panel import Area, Panel, offer_in_palette
from rotemina.app.shell.engine_words import error_text
from rotemina.app.shell.file_dialog import ask_file, ask_where
from rotemina.app.shell.language import marked
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.app.widgets.controls import allow, named, plain_tip, set_property
from rotemina.app.widgets.labels import plain_text
from rotemina.app.widgets.layouts import in_column, in_row
from rotemina.plugins.effects import mark, tr
from rotemina.plugins.effects.chosen_effects import Chain, with_formulation, with_value
from rotemina.plugins.effects.editor import Editor
from rotemina.plugins.effects.effect_table import EffectTable
from rotemina.plugins.effects.live_changes import ApplyState, Effects, LiveEffects
from rotemina.plugins.effects.menu import fill
from rotemina.plugins.effects.words import effect_title, spoken
from rotemina.sim.effects.formulation import Effect, Formulation
from rotemina.sim.effects.registry import all_effects
from rotemina.sim.errors import InputError
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.robot.writing import write_robot
from rotemina.sim.trajectory.worn_machine_demo import worn_effects

REAL_MACHINE = mark(
    "Only the simulator has adjustable effects. Connect to the simulator to switch and adjust them."
)
FILES = mark("Robot files (*.toml)")
MOST_PAST = 100  # lists that can be brought back


class EffectsPanel(Panel):
    """The list of effects in place, and the fields of the chosen one."""

    title = marked("panels", "Effects")
    area = Area.BOTTOM
    order = 40
    help_page = "effects.md#in-the-window"

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self.chain = Chain(workbench.robot)
        self.place = -1
        self._real = False  # whether the device is no simulator
        self._last: tuple[int, str] | None = None  # what was tuned last: place and parameter
        self._past: list[Chain] = []
        self._make_buttons()
        self.table, self.editor = EffectTable(), Editor(workbench.robot)
        self.status = plain_text(quiet=False)
        # Its text may be long; the notice and the tooltip have all of it.
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

    # --- parts ------------------------------------------------------------------------------------

    def _make_buttons(self) -> None:
        self.add = QPushButton(tr("Add effect"))
        self.add.setToolTip(tr("Choose an axis, an effect and its formulation"))
        self.machine = QPushButton(tr("Machine"))
        self.machine.setToolTip(
            tr("Simulate the machine of the robot file, or a worn one for demonstration")
        )
        self.up = _button("▲", tr("Apply this effect earlier within its stage"))
        self.down = _button("▼", tr("Apply this effect later within its stage"))
        self.remove = _button(tr("Remove"), tr("Remove this effect"))
        self.undo = _button(tr("Undo"), tr("Undo the last change of this list"))
        self.all_off = _button(
            tr("All off"),
            tr("Compare with the nominal machine: disable all effects until this is released"),
        )
        self.all_off.setCheckable(True)
        self.load = _button(tr("Load …"), tr("Replace these effects by those of a robot file"))
        self.save = _button(
            tr("Save robot …"), tr("Save a robot file of this robot with these effects")
        )

    def _lay_out(self) -> None:
        changes = self.add, self.up, self.down, self.remove, self.undo, self.all_off
        files = self.left_out, self.load, self.save
        buttons = in_row(self.machine, *changes, (self.status, 1), *files, spacing=6)
        split = QSplitter(Qt.Orientation.Horizontal)
        split.addWidget(self.table)
        split.addWidget(self.editor)
        split.setSizes([450, 500])
        self._body = QWidget()
        in_column(buttons, (split, 1), on=self._body, margins=(10, 8, 10, 8))
        in_column(self._body, on=self, margins=0)

    def _offer_effects(self) -> None:
        effects, broken = all_effects()
        menu = QMenu(self.add)
        fill(menu, self.workbench.robot, effects, broken, self.add_effect)
        self.add.setMenu(menu)
        self.left_out.setVisible(bool(broken))
        self.left_out.setText(tr("{n} left out").format(n=len(broken)))
        self.left_out.setToolTip(plain_tip(tr("Effects that cannot be loaded:"), *broken.values()))

    def _offer_machines(self) -> None:
        robot = self.workbench.robot
        menu = QMenu(self.machine)
        menu.addAction(tr("From the robot file"), lambda: self.use_effects(robot.effects))
        worn = menu.addAction(
            tr("Worn, for demonstration"), lambda: self.use_effects(worn_effects(robot))
        )
        menu.setToolTipsVisible(True)
        none = None if worn_effects(robot) else tr("there are no such effects for this robot")
        allow(worn, none, tr("Effects as of a machine after years of use"))
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
            lambda name: self._change(with_formulation(self.chain.effects[self.place], name))
        )
        self.editor.source_chosen.connect(
            lambda axis: self._change(replace(self.chain.asked[self.place], from_axis=axis))
        )
        self.live.changed.connect(self._show_standing)
        self.live.refused.connect(lambda text: self.workbench.refuse(text, about=self))
        self.live.replaced.connect(self._adopt)
        self.follow(self._refresh)
        self.workbench.theme_changed.connect(lambda _: self._show())

    # --- what the operator does -------------------------------------------------------------------

    def add_effect(self, axis: str, effect: Effect, formulation: Formulation) -> None:
        """Put an effect with its presets on an axis."""
        others = [name for name in self.workbench.robot.axes if name != axis]
        usual = formulation is effect.formulations[0]
        asked = AxisEffect(
            axis=axis,
            id=effect.id,
            formulation=None if usual else formulation.name,
            from_axis=others[0] if effect.coupled else None,
        )
        chain, self.place = self.chain.added(asked)
        self._use(chain)

    def _remove(self) -> None:
        chain = self.chain.removed(self.place)
        self.place = min(self.place, len(chain) - 1)
        self._use(chain)

    def _move(self, step: int) -> None:
        other = self.chain.neighbour(self.place, step)
        if other is not None:
            chain, self.place = self.chain.swapped(self.place, other), other
            self._use(chain)

    def _choose(self, place: int) -> None:
        self.place = place
        self._show_chosen()

    def _switch(self, place: int, on: bool) -> None:
        """Have an effect act or not; where all are off, this one acts alone, as the ticks show."""
        self.place = place
        if self.all_off.isChecked():
            with QSignalBlocker(self.all_off):
                self.all_off.setChecked(False)
            silent = Chain.of(self.workbench.robot, self.chain.silent)
            self._use(silent.changed(place, replace(self.chain.asked[place], enabled=on)))
        else:
            self._change(replace(self.chain.asked[place], enabled=on))

    def _tune(self, name: str, value: float) -> None:
        self._change(with_value(self.chain.effects[self.place], name, value), tuned=name)

    def _refuse(self, name: str, reason: str) -> None:
        one = self.chain.effects[self.place]
        where = f"{label(one.asked.axis)} {effect_title(one.effect)}, {spoken(name)}"
        self.workbench.refuse(f"{where}: {reason}", about=self)

    def _undo(self) -> None:
        self.chain, self._last = self._past.pop(), None
        self.place = min(max(self.place, 0), len(self.chain) - 1)
        self._apply()

    def _change(self, asked: AxisEffect, *, tuned: str | None = None) -> None:
        try:
            chain = self.chain.changed(self.place, asked)
        except InputError as error:
            self.workbench.notify(Level.ERROR, error_text(error), about=error)
            self._show()
            return
        self._use(chain, tuned)

    def use_effects(self, effects: tuple[AxisEffect, ...]) -> None:
        """Let the simulated machine have these effects and no others."""
        self.place = 0 if effects else -1
        self._use(Chain.of(self.workbench.robot, effects))

    # --- files ------------------------------------------------------------------------------------

    def load_effects(self, path: Path) -> None:
        """Take the effects of a robot file in place of these."""

        def work() -> Chain:
            effects = load_robot(path).effects
            if not effects:
                text = tr("{path}: the robot file has no effects; the list is unchanged")
                raise InputError(text.format(path=path))
            return Chain.of(self.workbench.robot, effects)

        def done(chain: Chain) -> None:
            self.place = 0
            self._use(chain)

        self.workbench.read_file("load effects", path.name, work, done)

    def save_robot(self, path: Path) -> None:
        """Write a robot file of the robot with its effects, over one that is there."""
        robot = replace(self.workbench.robot, effects=self.chain.asked)
        self.workbench.write_file(
            "save robot", path, lambda: write_robot(robot, path, overwrite=True)
        )

    def _ask_load(self) -> None:
        title = tr("Load effects from a robot file")
        ask_file(self, self.workbench, title, tr(FILES), self.load_effects)

    def _ask_save(self) -> None:
        title = tr("Save the robot with its effects")
        ask_where(self, self.workbench, title, tr(FILES), "robot.toml", self.save_robot)

    # --- what is shown ----------------------------------------------------------------------------

    def _use(self, chain: Chain, tuned: str | None = None) -> None:
        """Take effects in hand, show them, and have the simulator do them."""
        last = None if tuned is None else (self.place, tuned)
        if last is None or last != self._last:  # a slider that is dragged is one change
            self._remember()
        self.chain, self._last = chain, last
        self._apply()

    def _remember(self) -> None:
        self._past = [*self._past[1 - MOST_PAST :], self.chain]

    def _apply(self) -> None:
        self._show()
        self.live.ask(self.chain.silent if self.all_off.isChecked() else self.chain.asked)

    def _adopt(self, effects: Effects | None) -> None:
        """Show effects that came from elsewhere, or that a real machine has its own."""
        self._real = effects is None
        if self._real:  # at once, and not with the next refreshed state
            allow(self._body, tr(REAL_MACHINE), "")
        if len(self.chain):
            self._remember()
        self.chain, self._last = Chain.of(self.workbench.robot, effects or ()), None
        self.place = min(max(self.place, 0), len(self.chain) - 1)
        self.all_off.blockSignals(True)
        self.all_off.setChecked(False)
        self.all_off.blockSignals(False)
        self._show()

    def _refresh(self, state: SessionState) -> None:
        why_not = tr(REAL_MACHINE) if self._real else None
        if state.connection is not Connection.CONNECTED:
            why_not = tr("no device is connected")
        allow(self._body, why_not, "")
        self.live.refresh(state)

    def _show(self) -> None:
        muted = self.all_off.isChecked()
        self.table.show_chain(self.chain, self.place, self.workbench.theme, muted=muted)
        self._show_chosen()
        self._show_standing()

    def _show_chosen(self) -> None:
        chosen = 0 <= self.place < len(self.chain)
        self.editor.show_effect(self.chain.effects[self.place] if chosen else None, self.place)
        none = None if chosen else tr("no effect is chosen")
        allow(self.remove, none, tr("Remove this effect"))
        unchanged = None if self._past else tr("nothing was changed")
        allow(self.undo, unchanged, tr("Undo the last change of this list"))
        for button, step, tip in (
            (self.up, -1, tr("Apply this effect earlier within its stage")),
            (self.down, +1, tr("Apply this effect later within its stage")),
        ):
            last = chosen and self.chain.neighbour(self.place, step) is None
            end = tr("the stage has no further effect in this direction") if last else None
            allow(button, none or end, tip)

    def _show_standing(self) -> None:
        self._mark_fields()
        if self._real:
            self._say(tr(REAL_MACHINE))
        elif self.live.apply_state is ApplyState.REFUSED:
            self._say(tr("Not applied: {reason}").format(reason=self.live.reason), bad=True)
        elif self.live.apply_state is ApplyState.PREPARING:
            self._say(tr("preparing …"))
        else:
            self._say(self._count())

    def _mark_fields(self) -> None:
        """Mark the parameter that was tuned last while the simulator does not take it."""
        if self.live.apply_state is ApplyState.APPLIED:
            for field in self.editor.fields.values():
                field.settle()
        elif self.live.apply_state is ApplyState.REFUSED and self._last is not None:
            place, name = self._last
            if place == self.place and name in self.editor.fields:
                self.editor.fields[name].set_not_applied(True)

    def _count(self) -> str:
        if not len(self.chain):
            return tr("No effects: nominal")
        on = sum(one.enabled for one in self.chain.asked)
        state = tr("all off") if self.all_off.isChecked() else tr("{n} on").format(n=on)
        one, more = tr("1 effect, {state}"), tr("{n} effects, {state}")
        return (more if len(self.chain) > 1 else one).format(n=len(self.chain), state=state)

    def _say(self, text: str, *, bad: bool = False) -> None:
        self.status.setText(text)
        self.status.setToolTip(plain_tip(text))
        set_property(self.status, "bad", bad)


def _button(text: str, about: str) -> QPushButton:
    return named(QPushButton(text), about if len(text) == 1 else text, about)
