"""The menu of addable effects by axis and stage, with their formulations."""

from collections.abc import Callable, Mapping

from PySide6.QtGui import QAction
from PySide6.QtWidgets import QMenu

from rotemina.app.display_units import label
from rotemina.app.widgets.controls import plain_tip
from rotemina.plugins.effects import tr
from rotemina.plugins.effects.chosen_effects import candidates
from rotemina.plugins.effects.words import (
    effect_summary,
    effect_title,
    formulation_name,
    stage_name,
)
from rotemina.sim.effects.formulation import Effect, Formulation
from rotemina.sim.robot.model import Robot

Add = Callable[[str, Effect, Formulation], None]


def fill(
    menu: QMenu, robot: Robot, effects: Mapping[str, Effect], broken: Mapping[str, str], add: Add
) -> None:
    """Fill a menu with the effects that may sit on each axis, and name those left out."""
    for axis in robot.axes:
        inner = _submenu(menu, label(axis))
        # When it is opened: hundreds of entries take long to make, and few of them are looked at.
        inner.aboutToShow.connect(
            lambda inner=inner, axis=axis: _add_axis(inner, robot, axis, effects, add)
        )
    if broken:
        menu.addSeparator()
        left_out = _submenu(menu, tr("Left out ({n})").format(n=len(broken)))
        for effect_id, reason in broken.items():
            action = _line(left_out, effect_id)
            action.setToolTip(plain_tip(reason))


def _add_axis(
    menu: QMenu, robot: Robot, axis: str, effects: Mapping[str, Effect], add: Add
) -> None:
    stage = None
    menu.clear()
    for effect_id, names in candidates(robot, axis, effects).items():
        effect = effects[effect_id]
        if effect.stage is not stage:
            stage = effect.stage
            _line(menu, stage_name(stage).capitalize())
        _add_effect(menu, axis, effect, names, add)


def _add_effect(menu: QMenu, axis: str, effect: Effect, names: list[str], add: Add) -> None:
    formulations = [f for f in effect.formulations if f.name in names]
    title = f"   {effect_title(effect)}"
    several = _submenu(menu, title) if len(formulations) > 1 else None
    if several is not None:
        several.menuAction().setToolTip(plain_tip(effect_summary(effect)))
    for formulation in formulations:
        text = title if several is None else formulation_name(formulation.name)
        action = (several or menu).addAction(_literal(text))
        action.setToolTip(plain_tip(effect_summary(effect), formulation.equation))
        action.triggered.connect(lambda _=False, chosen=formulation: add(axis, effect, chosen))


def _submenu(menu: QMenu, text: str) -> QMenu:
    inner = menu.addMenu(_literal(text))
    inner.setToolTipsVisible(True)
    return inner


def _line(menu: QMenu, text: str) -> QAction:
    """Add a line that says something and cannot be chosen."""
    action = menu.addAction(_literal(text))
    action.setEnabled(False)
    return action


def _literal(text: str) -> str:
    return text.replace("&", "&&")  # an axis' name marks no shortcut
