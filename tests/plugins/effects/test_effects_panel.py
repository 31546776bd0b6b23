"""The effects panel on the running simulator."""

import threading
from importlib import resources
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFileDialog

from rotemina.app.motion.device_service import Service
from rotemina.app.shell.workbench import Level
from rotemina.drivers.samples import DeviceState
from rotemina.plugins.effects import panel as panel_module
from rotemina.plugins.effects.panel import REAL_MACHINE
from rotemina.sim.effects.errors import EffectError
from rotemina.sim.effects.registry import all_effects
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect

LONG_MS = 30_000
LOOP = AxisEffect(axis="thx", id="hysteresis")


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
def in_place(qtbot, session, panel):
    """Wait until the simulator does exactly this, and the panel knows."""

    def wait(*effects):
        qtbot.waitUntil(lambda: session.service.effects == effects, timeout=LONG_MS)
        qtbot.waitUntil(lambda: panel.chain.asked == effects, timeout=LONG_MS)
        qtbot.waitUntil(lambda: panel.live._sent is None, timeout=LONG_MS)

    return wait


@pytest.fixture
def loop(session, panel, in_place):
    """The panel with hysteresis on θx."""
    session.service.set_effects([LOOP])
    in_place(LOOP)
    return panel


def choose(menu, *path):
    """Return the action at the end of a path; of an effect's formulations the usual one."""
    for name in path[:-1]:
        action = next(a for a in menu.actions() if a.text().strip() == name)
        menu = action.menu()
        menu.aboutToShow.emit()
    action = next(a for a in menu.actions() if a.text().strip() == path[-1])
    return action.menu().actions()[0] if action.menu() else action


def type_in(qtbot, field, text):
    field.edit.setFocus()
    field.edit.selectAll()
    qtbot.keyClicks(field.edit, text)
    qtbot.keyClick(field.edit, Qt.Key.Key_Return)


def newest_notice(window):
    notices = window.notices.notices()
    return notices[0].text if notices else ""


def go_and_rest(qtbot, session, axis, position):
    session.go_to({axis: position})

    def arrived():
        state = session.snapshot()
        there = abs(state.command[axis] - position) < 1e-12
        return there and state.activity is DeviceState.IDLE

    qtbot.waitUntil(arrived, timeout=LONG_MS)


def gap(session, axis):
    """Return the mean distance of measurement from the model line in the last 50 ms."""
    history = session.history.tail(0.05)
    column = history.axes.index(axis)
    return abs(float((history.measured - history.model)[:, column].mean()))


def test_an_effect_is_added_from_the_menu_and_acts(panel, in_place):
    choose(panel.add.menu(), "θx", "Hysteresis").trigger()
    in_place(LOOP)
    preset = panel.editor.fields["width"].quantity.preset
    assert panel.editor.fields["width"].edit.text() == f"{1e6 * preset:.6g}"
    assert panel.status.text() == "1 effect, 1 on"
    choose(panel.add.menu(), "X", "Flexible mode", "appendage").trigger()
    in_place(AxisEffect(axis="x", id="flexible_mode", formulation="appendage"), LOOP)
    assert panel.editor.title.text() == "X: Flexible mode"


def test_hysteresis_parts_the_measurement_from_the_model_line_until_all_is_off(
    qtbot, window, session, loop
):
    go_and_rest(qtbot, session, "thx", 9e-4)
    go_and_rest(qtbot, session, "thx", 6e-4)
    qtbot.waitUntil(lambda: gap(session, "thx") > 1e-5, timeout=LONG_MS)
    qtbot.mouseClick(loop.all_off, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: gap(session, "thx") < 2e-6, timeout=LONG_MS)
    assert loop.chain.asked == (LOOP,)
    assert loop.status.text() == "1 effect, all off"
    tick = loop.table.item(0, 0)
    assert tick.checkState() is Qt.CheckState.Unchecked
    tick.setCheckState(Qt.CheckState.Checked)  # what is ticked acts
    qtbot.waitUntil(lambda: session.service.effects == (LOOP,), timeout=LONG_MS)
    assert not loop.all_off.isChecked()


def test_the_menu_is_grouped_by_stage_with_summaries_as_tooltips(panel):
    effects, _ = all_effects()
    menu = next(a for a in panel.add.menu().actions() if a.text() == "θx").menu()
    menu.aboutToShow.emit()
    heads = [a.text() for a in menu.actions() if not a.isEnabled()]
    assert heads == [h for h in ("Electronics", "Actuator", "Mechanics", "Sensor") if h in heads]
    assert {"Actuator", "Mechanics", "Sensor"} <= set(heads)
    assert effects["hysteresis"].summary in choose(menu, "Hysteresis").toolTip()
    assert menu.toolTipsVisible()


def test_a_typed_value_is_applied_in_the_shown_unit(qtbot, loop, in_place):
    field = loop.editor.fields["width"]
    assert field.quantity.unit == "µrad"
    type_in(qtbot, field, "200")
    in_place(AxisEffect(axis="thx", id="hysteresis", parameters={"width": 2e-4}))
    assert field.reset.isEnabled()
    qtbot.mouseClick(field.reset, Qt.MouseButton.LeftButton)
    preset = field.quantity.preset
    in_place(AxisEffect(axis="thx", id="hysteresis", parameters={"width": preset}))
    assert not field.reset.isEnabled()


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("9000", "9000 µrad must be between 0 and {high} µrad"),
        ("2,5", "decimal point"),
        ("1_0", "is not a number"),
    ],
)
def test_what_is_refused_is_told_with_its_bound_and_marked(
    qtbot, window, session, loop, text, reason
):
    field = loop.editor.fields["width"]
    type_in(qtbot, field, text)
    assert reason.format(high=field.quantity.number(field.quantity.high)) in newest_notice(window)
    assert field.not_applied
    assert field.edit.text() == text
    assert session.service.effects == (LOOP,)
    loop.editor.fields["shape"].slider.setValue(0)
    qtbot.waitUntil(
        lambda: list(session.service.effects[0].parameters) == ["shape"], timeout=LONG_MS
    )
    assert field.not_applied
    type_in(qtbot, field, "100")
    assert not field.not_applied


def test_leaving_a_field_changes_nothing(qtbot, session, loop, in_place):
    odd = AxisEffect(axis="thx", id="hysteresis", parameters={"width": 1.23456789e-4})
    session.service.set_effects([odd])
    in_place(odd)
    field = loop.editor.fields["width"]
    qtbot.keyClick(field.edit, Qt.Key.Key_Return)
    assert not loop.live._pause.isActive()
    assert loop.chain.asked == (odd,)


def test_a_slider_tunes_and_its_end_is_the_bound(loop, in_place):
    slider = loop.editor.fields["width"].slider
    slider.setValue(slider.maximum())
    high = loop.editor.fields["width"].quantity.high
    in_place(AxisEffect(axis="thx", id="hysteresis", parameters={"width": high}))
    assert loop.editor.fields["width"].edit.text() == f"{1e6 * high:.6g}"


def test_bounds_and_preset_are_in_the_tooltip(loop):
    field = loop.editor.fields["width"]
    about = field.edit.toolTip()
    assert f"between 0 and {1e6 * field.quantity.high:.6g} µrad" in about
    assert f"Preset {1e6 * field.quantity.preset:.6g} µrad" in about


def test_a_switch_and_remove(qtbot, loop, in_place):
    loop.table.item(0, 0).setCheckState(Qt.CheckState.Unchecked)
    in_place(AxisEffect(axis="thx", id="hysteresis", enabled=False))
    assert loop.status.text() == "1 effect, 0 on"
    qtbot.mouseClick(loop.remove, Qt.MouseButton.LeftButton)
    in_place()
    assert not loop.remove.isEnabled()
    assert loop.editor.fields == {}
    assert "nominal" in loop.status.text()


def test_changes_are_taken_back_one_by_one_and_a_dragged_slider_at_once(qtbot, loop, in_place):
    assert not loop.undo.isEnabled()
    slider = loop.editor.fields["width"].slider
    for place in (600, 700, 800):
        slider.setValue(place)
    qtbot.mouseClick(loop.remove, Qt.MouseButton.LeftButton)
    in_place()
    qtbot.mouseClick(loop.undo, Qt.MouseButton.LeftButton)
    tuned = {"width": loop.editor.fields["width"].quantity.at(800)}
    in_place(AxisEffect(axis="thx", id="hysteresis", parameters=tuned))
    qtbot.mouseClick(loop.undo, Qt.MouseButton.LeftButton)
    in_place(LOOP)
    assert not loop.editor.fields["width"].reset.isEnabled()
    assert not loop.undo.isEnabled()


def test_the_panel_takes_no_more_height_than_the_others(window, panel):
    heights = {name: other.minimumSizeHint().height() for name, other in window.panels.items()}
    assert heights["effects"] <= heights["trajectory"]


def test_another_formulation_and_another_source(qtbot, session, panel, in_place):
    leak = AxisEffect(axis="zn", id="cross_coupling", from_axis="z", parameters={"k": 0.5})
    session.service.set_effects([leak])
    in_place(leak)
    editor = panel.editor
    editor.formulation.setCurrentIndex(editor.formulation.findData("mode"))
    editor.formulation.activated.emit(editor.formulation.currentIndex())
    mode = AxisEffect(
        axis="zn",
        id="cross_coupling",
        formulation="mode",
        from_axis="z",
        parameters={"k": 0.5},
    )
    in_place(mode)
    assert "frequency" in editor.fields
    assert editor.fields["k"].quantity.unit == ""
    editor.source.setCurrentIndex(editor.source.findData("thx"))
    editor.source.activated.emit(editor.source.currentIndex())
    qtbot.waitUntil(lambda: session.service.effects[0].from_axis == "thx", timeout=LONG_MS)
    assert editor.fields["k"].quantity.unit == "m/rad"


def test_effects_of_one_stage_change_places(qtbot, session, panel, in_place):
    mode, rub = AxisEffect(axis="x", id="flexible_mode"), AxisEffect(axis="x", id="friction")
    session.service.set_effects([mode, rub])
    in_place(mode, rub)
    assert not panel.up.isEnabled()
    qtbot.mouseClick(panel.down, Qt.MouseButton.LeftButton)
    in_place(rub, mode)
    assert panel.editor.title.text() == "X: Flexible mode"
    assert panel.table.currentRow() == 1


def test_the_robot_is_saved_and_its_effects_are_loaded(
    qtbot, window, session, loop, in_place, tmp_path
):
    path = tmp_path / "mine.toml"
    loop.all_off.setChecked(True)
    loop.save_robot(path)
    qtbot.waitUntil(path.exists, timeout=LONG_MS)
    qtbot.waitUntil(lambda: "Saved" in newest_notice(window), timeout=LONG_MS)
    assert load_robot(path).effects == (LOOP,)
    loop.all_off.setChecked(False)
    qtbot.mouseClick(loop.remove, Qt.MouseButton.LeftButton)
    in_place()
    loop.load_effects(path)
    in_place(LOOP)


def test_a_save_dialog_asks_before_it_replaces_a_file(panel):
    panel._ask_save()
    (dialog,) = panel.findChildren(QFileDialog)
    assert not dialog.testOption(QFileDialog.Option.DontConfirmOverwrite)
    assert (Path(dialog.directory().absolutePath()) / "six_axis_tour.csv").is_file()
    assert dialog.defaultSuffix() == "toml"
    dialog.reject()


@pytest.mark.parametrize("robot", ["picma", "rotemina"])
def test_effects_that_do_not_fit_or_are_none_leave_the_list(
    qtbot, window, session, loop, tmp_path, robot
):
    path = tmp_path / "other.toml"
    text = shipped_text(robot) + ('\n[[axis.p.effect]]\nid = "delay"\n' if robot == "picma" else "")
    path.write_text(text, "utf-8")
    loop.load_effects(path)
    wanted = "no such axis" if robot == "picma" else "has no effects"
    qtbot.waitUntil(lambda: wanted in newest_notice(window), timeout=LONG_MS)
    assert loop.chain.asked == session.service.effects == (LOOP,)


def shipped_text(robot):
    return resources.files("rotemina.resources.robots").joinpath(f"{robot}.toml").read_text("utf-8")


def test_what_takes_long_is_prepared_while_the_window_lives(qtbot, window, session, panel):
    driver = session.driver
    plain, gate = driver._set_effects, threading.Event()

    def slow(effects, permit):
        gate.wait(30.0)
        plain(effects, permit)

    driver._set_effects = slow
    try:
        choose(panel.add.menu(), "θx", "Hysteresis").trigger()
        qtbot.waitUntil(lambda: panel.status.text() == "preparing …", timeout=LONG_MS)
        qtbot.waitSignals([window.workbench.refreshed] * 3, timeout=LONG_MS).wait()
        assert session.service.effects == ()
    finally:
        gate.set()
    qtbot.waitUntil(lambda: panel.status.text() == "1 effect, 1 on", timeout=LONG_MS)
    assert session.service.effects == (LOOP,)


def test_what_the_simulator_refuses_later_is_shown_as_not_applied(qtbot, window, session, loop):
    driver = session.driver
    plain = driver._set_effects

    def refuse(effects, permit):
        raise EffectError("unstable with it")

    driver._set_effects = refuse
    field = loop.editor.fields["width"]
    type_in(qtbot, field, "200")
    qtbot.waitUntil(lambda: loop.status.text() == "Not applied: unstable with it", timeout=LONG_MS)
    assert field.not_applied
    assert newest_notice(window) == "unstable with it"
    assert session.service.effects == (LOOP,)
    driver._set_effects = plain
    loop.editor.fields["shape"].slider.setValue(0)
    qtbot.waitUntil(lambda: not field.not_applied, timeout=LONG_MS)
    assert loop.status.text() == "1 effect, 1 on"
    assert session.service.effects[0].parameters["width"] == 2e-4


def test_broken_effects_are_named_and_left_out(make_robot_window, monkeypatch):
    effects, _ = all_effects()
    found = {"hysteresis": effects["hysteresis"]}
    monkeypatch.setattr(
        panel_module, "all_effects", lambda: (found, {"creep": "effect 'creep' is <broken>"})
    )
    panel = make_robot_window().panels["effects"]
    assert panel.left_out.text() == "1 left out"
    assert "effect 'creep' is &lt;broken&gt;".replace("'", "&#x27;") in panel.left_out.toolTip()
    action = choose(panel.add.menu(), "Left out (1)", "creep")
    assert not action.isEnabled()


def test_a_real_machine_has_effects_of_its_own(make_robot_window, monkeypatch):
    monkeypatch.setattr(Service, "effects", property(lambda self: None))
    panel = make_robot_window().panels["effects"]
    assert panel.status.text() == REAL_MACHINE
    for widget in (panel.add, panel.load, panel.save, panel.all_off, panel.table):
        assert not widget.isEnabled()


def test_the_panel_follows_from_the_simulator_to_a_real_machine_and_back(
    qtbot, window, loop, monkeypatch
):
    before = Service.effects
    with monkeypatch.context() as patch:
        patch.setattr(Service, "effects", property(lambda self: None))
        qtbot.waitUntil(lambda: loop.status.text() == REAL_MACHINE, timeout=LONG_MS)
        qtbot.waitUntil(lambda: not loop.add.isEnabled(), timeout=LONG_MS)
        assert loop.table.rowCount() == 0
    assert Service.effects is before
    qtbot.waitUntil(loop.add.isEnabled, timeout=LONG_MS)
    assert loop.chain.asked == (LOOP,)


def test_a_lost_simulator_locks_the_panel(qtbot, window, loop):
    window.workbench.session.close()
    qtbot.waitUntil(lambda: not loop.add.isEnabled(), timeout=LONG_MS)
    window.workbench.notify(Level.INFO, "the window lives")


def test_the_theme_changes_the_list(window, loop):
    window.use_theme("light")
    light = loop.table.item(0, 3).foreground().color().name()
    window.use_theme("dark")
    assert light == "#1b2129"
    assert loop.table.item(0, 3).foreground().color().name() == "#e8ebf0"
