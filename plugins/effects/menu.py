"""Menu of the effects that can be added, by axis and by stage of the signal chain."""

from collections.abc import Callable, Mapping

from PySide6.QtGui import QAction
from PySide6.QtWidgets import QMenu

from rotemina.app.language import get_axis_label
from rotemina.app.widgets.controls import make_tooltip
from rotemina.plugins.effects import tr
from rotemina.plugins.effects.chosen_effects import find_candidates
from rotemina.plugins.effects.words import (
    effect_summary,
    effect_title,
    formulation_name,
    stage_name,
)
from rotemina.sim.effects import Effect, Formulation
from rotemina.sim.robot import Robot

AddEffect = Callable[[str, Effect, Formulation], None]


def fill_effect_menu(
    menu: QMenu,
    robot: Robot,
    effects: Mapping[str, Effect],
    broken: Mapping[str, str],
    add: AddEffect,
) -> None:
    """Fill a menu with the effects that each axis can have, and those that could not be loaded.

    Parameters
    ----------
    menu : QMenu
    robot : Robot
    effects : effect id -> effect.
    broken : effect id -> why the effect cannot be loaded.
    add : called with axis, effect and formulation when an entry is chosen.
    """
    for axis in robot.axes:
        axis_menu = _add_submenu(menu, get_axis_label(axis))
        # The submenu is filled when it opens, because creating hundreds of entries takes long.
        axis_menu.aboutToShow.connect(
            lambda axis_menu=axis_menu, axis=axis: _fill_axis_menu(
                axis_menu, robot, axis, effects, add
            )
        )
    if broken:
        menu.addSeparator()
        broken_menu = _add_submenu(menu, tr("Left out ({n})").format(n=len(broken)))
        for effect_id, reason in broken.items():
            action = _add_disabled_entry(broken_menu, effect_id)
            action.setToolTip(make_tooltip(reason))


def _fill_axis_menu(
    menu: QMenu, robot: Robot, axis: str, effects: Mapping[str, Effect], add: AddEffect
) -> None:
    stage = None
    menu.clear()
    for effect_id, formulation_names in find_candidates(robot, axis, effects).items():
        effect = effects[effect_id]
        if effect.stage is not stage:
            stage = effect.stage
            _add_disabled_entry(menu, stage_name(stage).capitalize())
        _add_effect(menu, axis, effect, formulation_names, add)


def _add_effect(
    menu: QMenu, axis: str, effect: Effect, formulation_names: list[str], add: AddEffect
) -> None:
    formulations = [
        formulation for formulation in effect.formulations if formulation.name in formulation_names
    ]
    title = f"   {effect_title(effect)}"
    submenu = _add_submenu(menu, title) if len(formulations) > 1 else None
    if submenu is not None:
        submenu.menuAction().setToolTip(make_tooltip(effect_summary(effect)))
    for formulation in formulations:
        text = title if submenu is None else formulation_name(formulation.name)
        action = (submenu or menu).addAction(_escape_ampersands(text))
        action.setToolTip(make_tooltip(effect_summary(effect), formulation.equation))
        action.triggered.connect(lambda _=False, chosen=formulation: add(axis, effect, chosen))


def _add_submenu(menu: QMenu, text: str) -> QMenu:
    submenu = menu.addMenu(_escape_ampersands(text))
    submenu.setToolTipsVisible(True)
    return submenu


def _add_disabled_entry(menu: QMenu, text: str) -> QAction:
    action = menu.addAction(_escape_ampersands(text))
    action.setEnabled(False)
    return action


def _escape_ampersands(text: str) -> str:
    # An "&" in the name of an axis must not mark a shortcut.
    return text.replace("&", "&&")
