"""The effects panel with the simulator running."""

import threading
from dataclasses import replace
from importlib import resources
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFileDialog

from rotemina.app.motion.session.device_service import DeviceService
from rotemina.app.workbench import Level
from rotemina.drivers.contract import DeviceState
from rotemina.plugins.effects import panel as panel_module
from rotemina.plugins.effects.panel import ONLY_SIMULATOR_TEXT
from rotemina.sim.effects import load_all_effects
from rotemina.sim.errors import EffectError
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot

LONG_MS = 30_000
HYSTERESIS = AxisEffect(axis="thx", id="hysteresis")


@pytest.fixture
def session(window):
    return window.workbench.session


@pytest.fixture
def panel(qtbot, window):
    panel = window.panels["effects"]
    window.docks["effects"].raise_()
    qtbot.waitUntil(panel.add.isEnabled, timeout=LONG_MS)
    return panel


@pytest.fixture
def wait_for_effects(qtbot, session, panel):
    """Return a function that waits until the simulator and the panel have exactly these effects."""

    def wait(*effects):
        qtbot.waitUntil(lambda: session.service.effects == effects, timeout=LONG_MS)
        qtbot.waitUntil(lambda: panel.chain.requests == effects, timeout=LONG_MS)
        qtbot.waitUntil(lambda: panel.live._sent_effects is None, timeout=LONG_MS)

    return wait


@pytest.fixture
def panel_with_hysteresis(session, panel, wait_for_effects):
    """Return the panel with hysteresis on θx."""
    session.service.set_effects([HYSTERESIS])
    wait_for_effects(HYSTERESIS)
    return panel


def find_action(menu, *path):
    """Return the action at the end of a menu path, with the first of its formulations."""
    for name in path[:-1]:
        action = next(candidate for candidate in menu.actions() if candidate.text().strip() == name)
        menu = action.menu()
        menu.aboutToShow.emit()
    action = next(candidate for candidate in menu.actions() if candidate.text().strip() == path[-1])
    return action.menu().actions()[0] if action.menu() else action


def type_in(qtbot, field, text):
    field.edit.setFocus()
    field.edit.selectAll()
    qtbot.keyClicks(field.edit, text)
    qtbot.keyClick(field.edit, Qt.Key.Key_Return)


def get_newest_notice(window):
    notices = window.notices.notices()
    return notices[0].text if notices else ""


def move_and_wait(qtbot, session, axis, position):
    session.go_to({axis: position})

    def has_arrived():
        state = session.snapshot()
        is_at_target = abs(state.command[axis] - position) < 1e-12
        return is_at_target and state.activity is DeviceState.IDLE

    qtbot.waitUntil(has_arrived, timeout=LONG_MS)


def get_mean_gap(session, axis):
    """Return the mean difference between the measurement and the model in the last 50 ms."""
    history = session.history.tail(0.05)
    column = history.axes.index(axis)
    return abs(float((history.measured - history.model)[:, column].mean()))


def test_an_effect_added_from_the_menu_is_simulated(window, panel, wait_for_effects):
    menu = next(action for action in panel.add.menu().actions() if action.text() == "θx").menu()
    menu.aboutToShow.emit()
    headings = [action.text() for action in menu.actions() if not action.isEnabled()]
    stages = ["Electronics", "Actuator", "Mechanics", "Sensor"]
    assert headings == [stage for stage in stages if stage in headings]
    hysteresis = find_action(menu, "Hysteresis")
    assert load_all_effects()[0]["hysteresis"].summary in hysteresis.toolTip()
    assert menu.toolTipsVisible()
    hysteresis.trigger()
    wait_for_effects(HYSTERESIS)
    preset = panel.editor.fields["width"].quantity.preset
    assert panel.editor.fields["width"].edit.text() == f"{1e6 * preset:.6g}"
    assert panel.status.text() == "1 effect, 1 on"
    for name in ("light", "dark"):
        window.use_theme(name)
        colour = panel.table.item(0, 3).foreground().color().name()
        assert colour == window.workbench.theme.text
    find_action(panel.add.menu(), "X", "Flexible mode", "appendage").trigger()
    wait_for_effects(AxisEffect(axis="x", id="flexible_mode", formulation="appendage"), HYSTERESIS)
    assert panel.editor.title.text() == "X: Flexible mode"


def test_hysteresis_opens_a_gap_to_the_model_until_all_effects_are_off(
    qtbot, window, session, panel_with_hysteresis
):
    move_and_wait(qtbot, session, "thx", 9e-4)
    move_and_wait(qtbot, session, "thx", 6e-4)
    qtbot.waitUntil(lambda: get_mean_gap(session, "thx") > 1e-5, timeout=LONG_MS)
    qtbot.mouseClick(panel_with_hysteresis.all_off, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: get_mean_gap(session, "thx") < 2e-6, timeout=LONG_MS)
    assert panel_with_hysteresis.chain.requests == (HYSTERESIS,)
    assert panel_with_hysteresis.status.text() == "1 effect, all off"
    checkbox = panel_with_hysteresis.table.item(0, 0)
    assert checkbox.checkState() is Qt.CheckState.Unchecked
    checkbox.setCheckState(Qt.CheckState.Checked)  # enables the effects again
    qtbot.waitUntil(lambda: session.service.effects == (HYSTERESIS,), timeout=LONG_MS)
    assert not panel_with_hysteresis.all_off.isChecked()


def test_a_value_is_typed_dragged_and_reset_in_the_shown_unit(
    qtbot, session, panel_with_hysteresis, wait_for_effects
):
    field = panel_with_hysteresis.editor.fields["width"]
    high, preset = field.quantity.high, field.quantity.preset
    tooltip = field.edit.toolTip()
    assert f"between 0 and {1e6 * high:.6g} µrad" in tooltip
    assert f"Preset {1e6 * preset:.6g} µrad" in tooltip
    type_in(qtbot, field, "200")
    wait_for_effects(AxisEffect(axis="thx", id="hysteresis", parameters={"width": 2e-4}))
    assert field.reset.isEnabled()
    qtbot.mouseClick(field.reset, Qt.MouseButton.LeftButton)
    wait_for_effects(AxisEffect(axis="thx", id="hysteresis", parameters={"width": preset}))
    assert not field.reset.isEnabled()
    field.slider.setValue(field.slider.maximum())
    wait_for_effects(AxisEffect(axis="thx", id="hysteresis", parameters={"width": high}))
    assert field.edit.text() == f"{1e6 * high:.6g}"
    # A value that is only left with Return keeps all its digits.
    precise_effect = AxisEffect(axis="thx", id="hysteresis", parameters={"width": 1.23456789e-4})
    session.service.set_effects([precise_effect])
    wait_for_effects(precise_effect)
    qtbot.keyClick(panel_with_hysteresis.editor.fields["width"].edit, Qt.Key.Key_Return)
    assert not panel_with_hysteresis.live._pause.isActive()
    assert panel_with_hysteresis.chain.requests == (precise_effect,)


def test_a_refused_value_is_marked_and_reported_with_its_bound(
    qtbot, window, session, panel_with_hysteresis
):
    field = panel_with_hysteresis.editor.fields["width"]
    high = field.quantity.format_number(field.quantity.high)
    for text, reason in (
        ("2,5", "decimal point"),
        ("9000", f"9000 µrad must be between 0 and {high} µrad"),
    ):
        type_in(qtbot, field, text)
        assert reason in get_newest_notice(window)
        assert field.is_not_applied
        assert field.edit.text() == text
        assert session.service.effects == (HYSTERESIS,)
    panel_with_hysteresis.editor.fields["shape"].slider.setValue(0)
    qtbot.waitUntil(
        lambda: list(session.service.effects[0].parameters) == ["shape"], timeout=LONG_MS
    )
    assert field.is_not_applied
    type_in(qtbot, field, "100")
    assert not field.is_not_applied


def test_undo_takes_back_single_changes_and_a_slider_drag_as_one(
    qtbot, panel_with_hysteresis, wait_for_effects
):
    panel = panel_with_hysteresis
    assert not panel.undo.isEnabled()
    field = panel.editor.fields["width"]
    for slider_position in (600, 700, 800):
        field.slider.setValue(slider_position)
    dragged = replace(HYSTERESIS, parameters={"width": field.quantity.from_slider(800)})
    wait_for_effects(dragged)
    panel.table.item(0, 0).setCheckState(Qt.CheckState.Unchecked)
    wait_for_effects(replace(dragged, enabled=False))
    assert panel.status.text() == "1 effect, 0 on"
    qtbot.mouseClick(panel.remove, Qt.MouseButton.LeftButton)
    wait_for_effects()
    assert not panel.remove.isEnabled()
    assert panel.editor.fields == {}
    assert "nominal" in panel.status.text()
    for effect in (replace(dragged, enabled=False), dragged, HYSTERESIS):
        qtbot.mouseClick(panel.undo, Qt.MouseButton.LeftButton)
        wait_for_effects(effect)
    assert not panel.editor.fields["width"].reset.isEnabled()
    assert not panel.undo.isEnabled()


def test_formulation_and_source_axis_can_be_changed(qtbot, session, panel, wait_for_effects):
    static_coupling = AxisEffect(
        axis="zn", id="cross_coupling", from_axis="z", parameters={"k": 0.5}
    )
    session.service.set_effects([static_coupling])
    wait_for_effects(static_coupling)
    editor = panel.editor
    editor.formulation.setCurrentIndex(editor.formulation.findData("mode"))
    editor.formulation.activated.emit(editor.formulation.currentIndex())
    mode_coupling = AxisEffect(
        axis="zn",
        id="cross_coupling",
        formulation="mode",
        from_axis="z",
        parameters={"k": 0.5},
    )
    wait_for_effects(mode_coupling)
    assert "frequency" in editor.fields
    assert editor.fields["k"].quantity.unit == ""
    editor.source.setCurrentIndex(editor.source.findData("thx"))
    editor.source.activated.emit(editor.source.currentIndex())
    qtbot.waitUntil(lambda: session.service.effects[0].from_axis == "thx", timeout=LONG_MS)
    assert editor.fields["k"].quantity.unit == "m/rad"


def test_effects_of_one_stage_can_be_reordered(qtbot, session, panel, wait_for_effects):
    mode, friction = AxisEffect(axis="x", id="flexible_mode"), AxisEffect(axis="x", id="friction")
    session.service.set_effects([mode, friction])
    wait_for_effects(mode, friction)
    assert not panel.up.isEnabled()
    qtbot.mouseClick(panel.down, Qt.MouseButton.LeftButton)
    wait_for_effects(friction, mode)
    assert panel.editor.title.text() == "X: Flexible mode"
    assert panel.table.currentRow() == 1


def test_the_robot_is_saved_and_its_effects_are_loaded(
    qtbot, window, session, panel_with_hysteresis, wait_for_effects, tmp_path
):
    panel_with_hysteresis._ask_save()
    (dialog,) = panel_with_hysteresis.findChildren(QFileDialog)
    assert not dialog.testOption(QFileDialog.Option.DontConfirmOverwrite)
    assert (Path(dialog.directory().absolutePath()) / "six_axis_tour.csv").is_file()
    assert dialog.defaultSuffix() == "toml"
    dialog.reject()
    path = tmp_path / "mine.toml"
    panel_with_hysteresis.all_off.setChecked(True)
    panel_with_hysteresis.save_robot(path)
    qtbot.waitUntil(path.exists, timeout=LONG_MS)
    qtbot.waitUntil(lambda: "Saved" in get_newest_notice(window), timeout=LONG_MS)
    assert load_robot(path).effects == (HYSTERESIS,)
    panel_with_hysteresis.all_off.setChecked(False)
    qtbot.mouseClick(panel_with_hysteresis.remove, Qt.MouseButton.LeftButton)
    wait_for_effects()
    panel_with_hysteresis.load_effects(path)
    wait_for_effects(HYSTERESIS)


def test_a_file_with_foreign_or_no_effects_keeps_the_list(
    qtbot, window, session, panel_with_hysteresis, tmp_path
):
    path = tmp_path / "other.toml"
    for robot, addition, reason in (
        ("picma", '\n[[axis.p.effect]]\nid = "delay"\n', "no such axis"),
        ("rotemina", "", "has no effects"),
    ):
        shipped_file = resources.files("rotemina.resources.robots").joinpath(f"{robot}.toml")
        path.write_text(shipped_file.read_text("utf-8") + addition, "utf-8")
        panel_with_hysteresis.load_effects(path)
        qtbot.waitUntil(lambda reason=reason: reason in get_newest_notice(window), timeout=LONG_MS)
        assert panel_with_hysteresis.chain.requests == session.service.effects == (HYSTERESIS,)


def test_the_window_stays_alive_while_effects_are_prepared(qtbot, window, session, panel):
    driver = session.driver
    set_effects, may_continue = driver._set_effects, threading.Event()

    def set_effects_slowly(effects, permit):
        may_continue.wait(30.0)
        set_effects(effects, permit)

    driver._set_effects = set_effects_slowly
    try:
        find_action(panel.add.menu(), "θx", "Hysteresis").trigger()
        qtbot.waitUntil(lambda: panel.status.text() == "preparing …", timeout=LONG_MS)
        qtbot.waitSignals([window.workbench.refreshed] * 3, timeout=LONG_MS).wait()
        assert session.service.effects == ()
    finally:
        may_continue.set()
    qtbot.waitUntil(lambda: panel.status.text() == "1 effect, 1 on", timeout=LONG_MS)
    assert session.service.effects == (HYSTERESIS,)


def test_a_late_refusal_of_the_simulator_is_shown_as_not_applied(
    qtbot, window, session, panel_with_hysteresis
):
    driver = session.driver
    set_effects = driver._set_effects

    def refuse(effects, permit):
        raise EffectError("unstable with it")

    driver._set_effects = refuse
    field = panel_with_hysteresis.editor.fields["width"]
    type_in(qtbot, field, "200")
    qtbot.waitUntil(
        lambda: panel_with_hysteresis.status.text() == "Not applied: unstable with it",
        timeout=LONG_MS,
    )
    assert field.is_not_applied
    assert get_newest_notice(window) == "unstable with it"
    assert session.service.effects == (HYSTERESIS,)
    driver._set_effects = set_effects
    panel_with_hysteresis.editor.fields["shape"].slider.setValue(0)
    qtbot.waitUntil(lambda: not field.is_not_applied, timeout=LONG_MS)
    assert panel_with_hysteresis.status.text() == "1 effect, 1 on"
    assert session.service.effects[0].parameters["width"] == 2e-4


def test_broken_effects_are_named_and_left_out(make_robot_window, monkeypatch):
    effects, _ = load_all_effects()
    working_effects = {"hysteresis": effects["hysteresis"]}
    monkeypatch.setattr(
        panel_module,
        "load_all_effects",
        lambda: (working_effects, {"creep": "effect 'creep' is <broken>"}),
    )
    panel = make_robot_window().panels["effects"]
    assert panel.left_out.text() == "1 left out"
    assert "effect 'creep' is &lt;broken&gt;".replace("'", "&#x27;") in panel.left_out.toolTip()
    action = find_action(panel.add.menu(), "Left out (1)", "creep")
    assert not action.isEnabled()


def test_the_panel_follows_a_change_to_a_real_machine_and_back(
    qtbot, window, panel_with_hysteresis, monkeypatch
):
    panel = panel_with_hysteresis
    with monkeypatch.context() as patch:
        patch.setattr(DeviceService, "effects", property(lambda self: None))
        qtbot.waitUntil(lambda: panel.status.text() == ONLY_SIMULATOR_TEXT, timeout=LONG_MS)
        qtbot.waitUntil(lambda: not panel.add.isEnabled(), timeout=LONG_MS)
        for widget in (panel.load, panel.save, panel.all_off, panel.table):
            assert not widget.isEnabled()
        assert panel.table.rowCount() == 0
    qtbot.waitUntil(panel.add.isEnabled, timeout=LONG_MS)
    assert panel.chain.requests == (HYSTERESIS,)


def test_a_lost_simulator_locks_the_panel(qtbot, window, panel_with_hysteresis):
    window.workbench.session.close()
    qtbot.waitUntil(lambda: not panel_with_hysteresis.add.isEnabled(), timeout=LONG_MS)
    window.workbench.notify(Level.INFO, "the window lives")
