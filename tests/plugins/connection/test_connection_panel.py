"""The connection panel on real sessions: with the simulator, and with devices that fail."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel

from rotemina.app.motion.state import ConnectionState
from rotemina.drivers.contract import DeviceState, registry
from rotemina.drivers.simulator import Simulator
from rotemina.plugins.connection import driver_choice as device_module

LONG_MS = 30_000


@pytest.fixture(autouse=True)
def no_real_ports(monkeypatch):
    """Offer one made-up serial port instead of those of this computer."""
    ports = [device_module.OfferedPort("/dev/ttyTEST0", "a <b>cable</b>")]
    monkeypatch.setattr(device_module, "list_serial_ports", lambda: ports)


@pytest.fixture
def press(qtbot):
    def press(button):
        qtbot.waitUntil(button.isEnabled, timeout=LONG_MS)
        qtbot.mouseClick(button, Qt.MouseButton.LeftButton)

    return press


@pytest.fixture
def panel(window):
    return window.panels["connection"]


def wait_for_phase(qtbot, panel, expected):
    # On a busy computer the program may stall and stop the machine; it is ready again after that.
    accepted_texts = ("Ready", "Stopped") if expected == "Ready" else (expected,)
    qtbot.waitUntil(lambda: panel.state.phase.text() in accepted_texts, timeout=LONG_MS)


def join_notices(window):
    return " ".join(notice.text for notice in window.notices.notices())


def make_unhomed_simulator(robot):
    return Simulator(robot, {"start_homed": False, "start_fraction": 0.001})


def test_opening_the_panel_on_a_homed_simulator_moves_nothing(qtbot, window, panel):
    wait_for_phase(qtbot, panel, "Ready")
    assert window.workbench.session.snapshot().activity is DeviceState.IDLE
    assert panel.state.phase.property("tone") == "good"
    assert panel.state.reason.text() == "Motion is possible."
    assert not panel.state.release.isEnabled()
    assert "nothing is locked" in panel.state.release.toolTip()
    assert "no open line" in panel.line.text.text()
    fields = [field.widget for field in panel.device.form.fields.values()]
    for widget in (*panel.findChildren(device_module.DriverChoice), *fields):
        assert widget.focusPolicy() & Qt.FocusPolicy.TabFocus
        assert widget.accessibleName()
    for name in ("emergency", "release", "clear"):
        assert getattr(panel.state, name).focusPolicy() & Qt.FocusPolicy.TabFocus
    assert all(
        label.textFormat() is Qt.TextFormat.PlainText
        for label in panel.findChildren(QLabel)
        if label.wordWrap()
    )


def test_an_unhomed_machine_is_homed_from_the_panel(qtbot, make_robot_window, press):
    window = make_robot_window(driver=make_unhomed_simulator)
    panel = window.panels["connection"]
    wait_for_phase(qtbot, panel, "Locked")
    assert panel.position.text.text() == "Not homed: X, Y, Z"
    assert "home first" in panel.state.reason.text()
    assert panel.tip.figures.values["Tip height"].text() == "unknown"
    assert not panel.tip.teach.isEnabled()
    press(panel.position.home_buttons["y"])
    qtbot.waitUntil(lambda: panel.position.text.text() == "Not homed: X, Z", timeout=LONG_MS)
    press(panel.position.home_all)
    wait_for_phase(qtbot, panel, "Ready")
    assert panel.position.text.text() == "All positions are known."


def test_the_owner_is_shown_while_homing(qtbot, make_robot_window, press):
    window = make_robot_window(driver=lambda robot: Simulator(robot, {"start_homed": False}))
    panel = window.panels["connection"]
    wait_for_phase(qtbot, panel, "Locked")
    press(panel.position.home_buttons["x"])
    qtbot.waitUntil(lambda: panel.position.owners.text() == "Homing moves X", timeout=LONG_MS)
    qtbot.waitUntil(lambda: "simulator: Homing" in window._status.text(), timeout=LONG_MS)
    assert window._bar.reason_label.text() == "Moving to find the limit switches of X."
    assert not panel.position.home_buttons["y"].isEnabled()
    assert not panel.device.connect_button.isEnabled()


def test_back_undoes_a_move_but_not_of_the_previous_device(qtbot, window, panel, press):
    session = window.workbench.session
    wait_for_phase(qtbot, panel, "Ready")
    assert "no previous position" in panel.position.back.toolTip()
    start = session.snapshot().command["zn"]
    window.workbench.jog("zn", 1e-6)
    press(panel.position.back)
    qtbot.waitUntil(lambda: abs(session.snapshot().command["zn"] - start) < 1e-12, timeout=LONG_MS)
    # A jog is refused while the axis still moves.
    qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.IDLE, timeout=LONG_MS)
    window.workbench.jog("zn", 1e-6)
    qtbot.waitUntil(panel.position.back.isEnabled, timeout=LONG_MS)
    panel.device.form.fields["seed"].widget.setText("5")
    press(panel.device.connect_button)
    qtbot.waitUntil(lambda: session.driver.settings["seed"] == 5, timeout=LONG_MS)
    wait_for_phase(qtbot, panel, "Ready")
    qtbot.waitUntil(lambda: not panel.position.back.isEnabled(), timeout=LONG_MS)


def test_teaching_a_floor_asks_with_the_old_and_the_new_height(qtbot, window, panel, press):
    session, tip = window.workbench.session, panel.tip
    wait_for_phase(qtbot, panel, "Ready")
    assert tip.figures.values["Floor"].text() == "none"
    assert not tip.remove.isEnabled()
    height_text = tip.figures.values["Tip height"].text()
    press(tip.teach)
    assert tip.question.isVisibleTo(panel)
    assert height_text in tip.question.text.text()
    assert "there is none" in tip.question.text.text()
    qtbot.mouseClick(tip.question.no, Qt.MouseButton.LeftButton)
    assert tip.question.isHidden()
    assert not session.bounds.keep_out.is_bounded
    press(tip.teach)
    qtbot.mouseClick(tip.question.yes, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: tip.figures.values["Floor"].text() == height_text, timeout=LONG_MS)
    assert tip.figures.values["Above the floor"].text() == "0.0000 mm"
    window.workbench.jog("z", -1e-3)
    assert "floor" in join_notices(window)
    press(tip.remove)
    assert height_text in tip.question.text.text()
    assert "Without a floor" in tip.question.text.text()
    qtbot.mouseClick(tip.question.yes, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: tip.figures.values["Floor"].text() == "none", timeout=LONG_MS)
    press(tip.teach)
    window.workbench.jog("z", 1e-4)  # the question is cancelled, because the tip moves
    qtbot.waitUntil(tip.question.isHidden, timeout=LONG_MS)
    assert "no floor was set" in join_notices(window)


def test_applying_a_voltage_asks_with_the_resulting_position(qtbot, window, panel, press):
    session, voltage = window.workbench.session, panel.voltage
    wait_for_phase(qtbot, panel, "Ready")
    assert [voltage.axis.itemText(i) for i in range(voltage.axis.count())] == ["θx", "θy", "Z nano"]
    voltage.axis.setCurrentIndex(2)
    voltage.volts.setValue(1000.0)
    assert voltage.volts.value() == 130.0
    voltage.volts.setValue(80.0)
    start_m = session.snapshot().command["zn"]
    press(voltage.apply_button)
    assert voltage.question.isVisibleTo(panel)
    assert "80 V to Z nano" in voltage.question.text.text()
    assert "40.000 µm" in voltage.question.text.text()
    voltage.volts.setValue(81.0)  # differs from the voltage in the question
    assert voltage.question.isHidden()
    press(voltage.apply_button)
    qtbot.mouseClick(voltage.question.no, Qt.MouseButton.LeftButton)
    assert session.snapshot().command["zn"] == start_m
    press(voltage.apply_button)
    qtbot.mouseClick(voltage.question.yes, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: abs(session.snapshot().command["zn"] - 40.5e-6) < 1e-9, timeout=LONG_MS)
    press(voltage.apply_button)
    window.workbench.jog("x", 1e-2)  # no voltage is applied during motion
    qtbot.waitUntil(voltage.question.isHidden, timeout=LONG_MS)
    assert "still moving" in voltage.apply_button.toolTip()
    window.workbench.stop()


@pytest.mark.parametrize("choice", ["write", "accept"])
def test_differing_parameters_are_written_or_accepted(
    qtbot, make_robot_window, press, differing_driver, choice
):
    window = make_robot_window(driver=differing_driver)
    panel = window.panels["connection"]
    parameters, session = panel.parameters, window.workbench.session
    qtbot.waitUntil(lambda: parameters.table.rowCount() == 2, timeout=LONG_MS)
    wait_for_phase(qtbot, panel, "Locked")
    rows = [[parameters.table.item(row, column).text() for column in range(3)] for row in range(2)]
    assert rows == [["x pitch <b>", "0.5 mm", "0.4 mm"], ["y limit", "50 mm", "55 mm"]]
    assert not panel.tip.teach.isEnabled()
    press(getattr(parameters, choice))
    wait_for_phase(qtbot, panel, "Ready")
    assert parameters.table.rowCount() == 0
    assert (session.driver.written, session.driver.accepted) == (
        choice == "write",
        choice == "accept",
    )
    assert not parameters.write.isEnabled()


def test_a_device_that_cannot_be_opened_is_reported_and_reconnected(
    qtbot, make_robot_window, press, unplugged_driver
):
    window = make_robot_window(driver=unplugged_driver)
    panel = window.panels["connection"]
    wait_for_phase(qtbot, panel, "Failed")
    assert "nothing answers on port <COM9>" in panel.state.reason.text()
    qtbot.waitUntil(lambda: "port <COM9>" in join_notices(window), timeout=LONG_MS)
    assert panel.state.reason.textFormat() is Qt.TextFormat.PlainText
    assert not panel.position.home_all.isEnabled()
    qtbot.waitUntil(window._bar.remedy_button.isVisible, timeout=LONG_MS)
    window.workbench.session.driver.plugged_in = True
    press(window._bar.remedy_button)
    wait_for_phase(qtbot, panel, "Ready")
    qtbot.waitUntil(lambda: not window._bar.remedy_button.isVisible(), timeout=LONG_MS)


def test_the_position_after_a_lost_connection_must_be_confirmed(
    qtbot, make_robot_window, press, failing_driver
):
    window = make_robot_window(driver=failing_driver)
    panel, driver = window.panels["connection"], window.workbench.session.driver
    wait_for_phase(qtbot, panel, "Ready")
    driver.is_cut = True
    wait_for_phase(qtbot, panel, "Link lost")
    driver.is_cut = False
    press(panel.device.reconnect_button)
    wait_for_phase(qtbot, panel, "Locked")
    assert "may be wrong" in panel.state.reason.text()
    window.docks["connection"].hide()
    qtbot.waitUntil(lambda: window._bar.remedy_button.text() == "Confirm …", timeout=LONG_MS)
    qtbot.waitUntil(window._bar.remedy_button.isEnabled, timeout=LONG_MS)
    press(window._bar.remedy_button)  # opens the page without confirming anything
    assert "may be wrong" in panel.state.reason.text()
    qtbot.waitUntil(panel.state.confirm.isVisible, timeout=LONG_MS)
    press(panel.state.confirm)
    wait_for_phase(qtbot, panel, "Ready")
    assert not panel.state.confirm.isEnabled()
    assert not window._bar.remedy_button.isVisible()


def test_a_fault_and_an_emergency_stop_are_ended_from_the_panel(
    qtbot, make_robot_window, press, failing_driver
):
    window = make_robot_window(driver=failing_driver)
    panel, driver = window.panels["connection"], window.workbench.session.driver
    wait_for_phase(qtbot, panel, "Ready")
    assert not panel.state.clear.isEnabled()
    driver.fault_text = "too hot"
    wait_for_phase(qtbot, panel, "Fault")
    assert "too hot" in panel.state.reason.text()
    press(panel.state.clear)
    wait_for_phase(qtbot, panel, "Ready")
    press(panel.state.emergency)
    qtbot.waitUntil(lambda: "release it first" in panel.state.reason.text(), timeout=LONG_MS)
    assert panel.state.phase.property("tone") == "danger"
    assert not panel.state.emergency.isEnabled()
    assert not panel.position.home_all.isEnabled()
    assert "release it first" in panel.position.home_all.toolTip()
    press(panel.state.release)
    qtbot.waitUntil(panel.state.emergency.isEnabled, timeout=LONG_MS)


def test_disconnecting_and_connecting_with_other_settings(qtbot, window, panel, press):
    device, session = panel.device, window.workbench.session
    wait_for_phase(qtbot, panel, "Ready")
    assert not device.connect_button.isEnabled()
    assert "connected with these settings" in device.connect_button.toolTip()
    press(device.disconnect_button)
    wait_for_phase(qtbot, panel, "Disconnected")
    field = device.form.fields["start_fraction"].widget
    field.setText("0.25")
    device.form.fields["settle_s"].widget.setText("0.02")
    press(device.connect_button)
    wait_for_phase(qtbot, panel, "Ready")
    assert session.driver.settings["start_fraction"] == 0.25
    assert session.snapshot().command["x"] == pytest.approx(0.055 * 0.25)
    assert window.workbench.settings.get("driver.simulator.start_fraction", 0.0) == 0.25
    assert window.workbench.settings.get("driver.simulator.start_homed", False) is False


def test_invalid_settings_are_marked_or_refused_and_not_used(qtbot, window, panel, press):
    connect, form = panel.device.connect_button, panel.device.form
    for name, text, reason in (
        ("settle_s", "0,5", "decimal point"),
        ("settle_s", "1_0", "not a number"),
        ("seed", "1.5", "not an integer"),
    ):
        widget = form.fields[name].widget
        text_before = widget.text()
        widget.setText(text)
        qtbot.waitUntil(lambda reason=reason: reason in connect.toolTip(), timeout=LONG_MS)
        assert widget.property("bad")
        assert not connect.isEnabled()
        widget.setText(text_before)
    form.fields["start_fraction"].widget.setText("7")
    press(connect)
    assert "start_fraction" in join_notices(window)
    assert window.workbench.session.snapshot().connection is ConnectionState.CONNECTED
    assert window.workbench.settings.get("driver.simulator.start_fraction", 0.5) == 0.5


class FailingDriver(Simulator):
    name = "bursting"

    def __init__(self, *_args, **_options):
        raise TypeError("made for <another> age")


class TwoPortSimulator(Simulator):
    name = "ported"
    default_settings = {**Simulator.default_settings, "port": "", "second_port": ""}  # noqa: RUF012


@pytest.fixture
def device(make_robot_window, monkeypatch):
    """The choice of a device, of which some fail and one has ports."""
    drivers = {"simulator": Simulator, "bursting": FailingDriver, "ported": TwoPortSimulator}
    broken = {"old": "old:Driver is made for version <1>"}
    monkeypatch.setattr(
        device_module, "discover_drivers", lambda: registry.PluginDiscovery(drivers, broken)
    )
    return make_robot_window().panels["connection"].device


def test_broken_drivers_are_listed_with_the_reason_and_ports_are_offered(qtbot, device):
    window = device.window()
    settings, workbench = window.workbench.settings, window.workbench
    assert [device.choice.itemText(row) for row in range(device.choice.count())] == [
        "simulator",
        "bursting",
        "ported",
        "old – cannot be used",
    ]
    item = device.choice.model().item(3)
    assert not item.isEnabled()
    assert "&lt;1&gt;" in item.toolTip()
    assert device.broken_text.text() == "old is left out: old:Driver is made for version <1>"
    assert device.broken_text.textFormat() is Qt.TextFormat.PlainText
    assert device.find.isHidden()
    device.choice.setCurrentIndex(1)
    device._connect_device()
    assert "cannot be created: TypeError: made for <another> age" in join_notices(window)
    assert workbench.session.driver.name == "simulator"
    device.choice.setCurrentIndex(2)
    port = device.form.fields["port"].widget
    qtbot.waitUntil(lambda: port.count() == 1, timeout=LONG_MS)
    assert port.itemText(0) == "/dev/ttyTEST0"
    assert "&lt;b&gt;" in port.itemData(0, Qt.ItemDataRole.ToolTipRole)
    qtbot.keyClicks(port.lineEdit(), "socket://host:9")
    qtbot.keyClick(port.lineEdit(), Qt.Key.Key_Return)
    assert settings.get("driver.ported.port", "") == "socket://host:9"
    device.choice.setCurrentIndex(0)
    workbench.offer_ports([("/dev/pts/8", "board 1"), ("/dev/pts/9", "board 2")])
    assert device.choice.currentText() == "ported"
    assert device.form.read_values()["port"] == "/dev/pts/8"
    assert device.form.read_values()["second_port"] == "/dev/pts/9"
    workbench.offer_ports([("/dev/pts/7", "both boards")])
    assert device.form.read_values()["second_port"] == ""


def test_a_robot_without_tip_and_switches_says_so(qtbot, make_robot_window):
    window = make_robot_window("picma")
    panel = window.panels["connection"]
    qtbot.waitSignal(window.workbench.refreshed).wait()
    assert "no limit switches" in panel.position.home_all.toolTip()
    assert "no tip" in panel.tip.teach.toolTip()
    assert not panel.position.home_buttons
