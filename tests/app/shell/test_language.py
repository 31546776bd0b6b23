"""The window in German, and what happens where a language is unknown or its file is missing."""

import re
import subprocess
from pathlib import Path
from types import SimpleNamespace

import PySide6
import pytest
from PySide6.QtCore import QCoreApplication, Qt
from PySide6.QtWidgets import QDialog, QDialogButtonBox

from rotemina.app.motion.penetration.parameters import PenetrationParameters
from rotemina.app.motion.teleoperation.profile import load_profile
from rotemina.app.shell import language
from rotemina.app.shell.engine_words import spoken
from rotemina.app.shell.help_topics import explained
from rotemina.app.shell.language import SETTING, chosen, translate
from rotemina.app.shell.workbench import Level
from rotemina.drivers.errors import DriverError
from rotemina.drivers.gcode.error_texts import Firmware, describe_alarm
from rotemina.drivers.registry import driver_named
from rotemina.sim.errors import InputError
from rotemina.sim.gap.intake.record_checks import check as check_gap
from rotemina.sim.gap.output.document_reader import read_document
from rotemina.sim.messages import message
from rotemina.sim.plate.mesh import make_mesh
from rotemina.sim.records.reading import read_record
from rotemina.sim.robot.file import load_robot, parse_robot
from rotemina.sim.trajectory.axis_limits import OutOfLimitsError, check_target
from rotemina.sim.tuning.tuning_scenario import step_of
from rotemina.sim.units import canonical

PANELS = ("connection",)
LONG_MS = 30_000


@pytest.fixture
def spoken_by_the_system(monkeypatch):
    """Let the system speak languages, the best first."""

    def speak(*names):
        system = SimpleNamespace(uiLanguages=lambda: list(names))
        monkeypatch.setattr(language, "QLocale", SimpleNamespace(system=lambda: system))

    return speak


@pytest.fixture
def application(qapp):
    yield qapp
    language.use(qapp, "en")


@pytest.fixture
def german(application, settings, make_robot_window):
    settings.set(SETTING, "de")
    return make_robot_window()


def notices(window):
    return [notice.text for notice in window.notices.notices()]


def test_the_systems_language_is_spoken_where_none_is_set(settings, spoken_by_the_system):
    for names, expected in (
        (("de-AT", "de", "en"), "de"),
        (("fr-FR", "de-DE"), "de"),
        (("en-GB", "de"), "en"),
        (("C",), "en"),
        ((), "en"),
    ):
        spoken_by_the_system(*names)
        assert chosen(settings) == expected
        settings.set(SETTING, "de")
        assert chosen(settings) == "de"
        settings.set(SETTING, "")


def test_an_unknown_language_is_told_and_the_systems_is_spoken(
    settings, spoken_by_the_system, caplog
):
    spoken_by_the_system("nl")
    settings.set(SETTING, "klingon")
    assert chosen(settings) == "en"
    assert "'klingon'" in caplog.text
    assert "en, de" in caplog.text
    settings.set(SETTING, 7)
    assert chosen(settings) == "en"


@pytest.mark.parametrize("content", [None, b"", b"\x3c\xb8\x64\x18 no texts", b"<TS></TS>"])
def test_a_file_that_cannot_be_read_leaves_the_window_english(
    application, tmp_path, caplog, content
):
    if content is not None:
        (tmp_path / "de.qm").write_bytes(content)
    language.install(application, tmp_path, "de")
    assert translate("panels", "Plots") == "Plots"
    assert str(tmp_path / "de.qm") in caplog.text


def test_languages_take_turns(application):
    for name, plots, cancel in (
        ("de", "Diagramme", "Abbrechen"),
        ("en", "Plots", "Cancel"),
        ("de", "Diagramme", "Abbrechen"),
    ):
        language.use(application, name)
        assert language.in_use(application) == name
        assert translate("panels", "Plots") == plots
        box = QDialogButtonBox(QDialogButtonBox.StandardButton.Cancel)
        assert box.buttons()[0].text().replace("&", "") == cancel  # Qt's own


def test_a_plugin_brings_texts_of_its_own(application, tmp_path, monkeypatch):
    package = tmp_path / "glass_stage" / "languages"
    package.mkdir(parents=True)
    (package.parent / "__init__.py").write_text("", "utf-8")
    message = "<message><source>Lamp</source><translation>Lampe</translation></message>"
    context = f"<context><name>glass_stage</name>{message}</context>"
    (tmp_path / "de.ts").write_text(f'<TS version="2.1" language="de">{context}</TS>', "utf-8")
    program = Path(PySide6.__file__).parent / "lrelease"
    made = [program, "-silent", tmp_path / "de.ts", "-qm", package / "de.qm"]
    subprocess.run(made, check=True)
    monkeypatch.syspath_prepend(tmp_path)
    for name, lamp in (("en", "Lamp"), ("de", "Lampe")):
        language.use(application, name)
        language.add_texts_of("glass_stage")
        language.add_texts_of("of_nobody")
        assert translate("glass_stage", "Lamp") == lamp
    assert translate("panels", "Plots") == "Diagramme"


def test_a_refusal_is_german_in_a_german_window_with_its_values_and_words(application):
    robot = load_robot("rotemina")
    with pytest.raises(OutOfLimitsError) as refused:
        check_target(robot, "zn", 6.55e-5)
    english = "axis zn: target 65.5 µm is outside its range 0 µm to 65 µm; choose a target inside"
    assert str(refused.value) == english
    assert explained(refused.value) == english.replace("zn", "Z nano")
    language.use(application, "de")
    assert explained(refused.value) == (
        "Achse Z nano: Ziel 65,5 µm liegt außerhalb ihres Bereichs 0 µm bis 65 µm; ein Ziel "
        "innerhalb wählen"
    )
    assert str(refused.value) == english


def refused(kind, call, *given, **named):
    """Return the error that a call ends with."""
    with pytest.raises(kind) as caught:
        call(*given, **named)
    return caught.value


# Names, paths, and in brackets what the system or a library says.
FOREIGN = re.compile(r"'[^']*'|/\S*|\([^)]*\)")


def typical_refusals(folder):
    """What each layer below the window refuses, as an operator meets it."""
    robot = load_robot("rotemina")
    record = folder / "record.csv"
    record.write_text("t [s],x.cmd [mm]\n0,1\n0,2\n", "utf-8")
    yield refused(InputError, read_record, folder / "missing.csv")
    yield refused(InputError, read_record, record)
    yield refused(InputError, parse_robot, "[robot]\nname = 'a'\naxes = 'x'\n", "a.toml")
    yield refused(InputError, canonical, "furlong")
    yield refused(DriverError, driver_named("mc68hc11")(robot, {"port": ""}).open)
    yield refused(DriverError, driver_named("mc68hc11")(robot, {"port": "/dev/none"}).open)
    yield refused(InputError, driver_named("gcode"), robot)
    yield refused(InputError, PenetrationParameters.parsed, "velocity = 1")
    profile = folder / "profile.toml"
    profile.write_text("name = 3", "utf-8")
    yield refused(InputError, load_profile, profile)
    yield refused(InputError, make_mesh, robot.plate, divisions=3)
    yield refused(InputError, step_of, robot.axes["zn"], 5000.0, distance=1.0)
    yield refused(InputError, read_document, folder / "missing.json")
    yield refused(InputError, check_gap, robot, [])


def test_refusals_of_each_layer_are_german_in_a_german_window(application, tmp_path):
    language.use(application, "de")
    said = [str(error) for error in typical_refusals(tmp_path)]
    shown = [spoken(text) for text in said]
    assert [text for text, german in zip(said, shown, strict=True) if text == german] == []
    english = re.compile(r"\b(the|is|must|there|it|not|choose|cannot|and|of)\b")
    assert [text for text in shown if english.search(FOREIGN.sub("", text))] == []


def test_a_boards_fault_is_german_with_all_that_stands_in_it(application):
    language.use(application, "de")
    board = message("engine", "board {address}: {words}")
    met = message("engine", "limit switch reached: {switches}").fill(switches="x")
    assert spoken(board.fill(address=1, words=met)) == "Karte 1: Endschalter erreicht: x"
    assert (
        spoken(describe_alarm(1, Firmware.GRBL))
        == "ALARM:1, Hardware-Grenze: ein Endschalter wurde erreicht"
    )


def test_words_in_the_fields_of_a_message_are_translated_and_other_texts_stay(application):
    language.use(application, "de")
    latched = message("engine", "{stop} is active; release it first")
    stop = message("engine", "stop and lock")
    assert spoken(latched.fill(stop=stop)) == "Halt und sperren ist aktiv; erst freigeben"
    cannot = message("engine", "{name}: cannot {action} while closed; open it first")
    assert spoken(cannot.fill(name="stage", action="play")) == (
        "stage: geschlossen, kann nicht abspielen; erst öffnen"
    )
    assert spoken("something that nobody has heard of") == "something that nobody has heard of"


def test_numbers_have_the_sign_of_the_language(application):
    text = translate("shell", "stop latency {ms:.1f} ms (99.9 %)")
    assert text.format(ms=0.9) == "stop latency 0.9 ms (99.9 %)"
    language.use(application, "de")
    german = translate("shell", "stop latency {ms:.1f} ms (99.9 %)").format(ms=0.9)
    assert "0,9 ms" in german
    assert "99,9 %" in german


def test_the_window_is_german_and_all_of_its_commands_work(qtbot, german):
    menus = [action.text() for action in german.menuBar().actions()]
    assert menus == ["&Datei", "&Bewegung", "&Ansicht", "&Hilfe"]
    assert german.docks["control"].windowTitle() == "Steuerung"
    assert german.stop_button.text() == "HALT (Esc)"
    _a_panels_notice_is_german(qtbot, german)
    _a_setting_has_a_german_number(german)
    _the_palette_finds_and_does(qtbot, german)
    _every_command_works(german)


def _a_panels_notice_is_german(qtbot, window):
    row = window.panels["control"].rows["x"]
    qtbot.waitUntil(row.go.isEnabled, timeout=LONG_MS)  # it is locked until a reading is fresh
    row.target.setText("1.500,0")
    row.go.click()
    assert "ist keine Position" in notices(window)[0]
    assert "Dezimalkomma" in notices(window)[0]


def _a_setting_has_a_german_number(window):
    field = window.panels["connection"].device.form.fields["settle_s"]
    assert field.widget.text() == "0,02"
    field.set_text("0,25")
    assert field.value() == 0.25
    field.set_text("0,02")


def _the_palette_finds_and_does(qtbot, window):
    window.toggle_palette()
    page = window.palette_page
    qtbot.keyClicks(page.field, "schema helles")
    assert page.list.item(0).text().startswith("Ansicht: Helles Farbschema")
    qtbot.keyClick(page.field, Qt.Key.Key_Return)
    assert window.workbench.theme.name == "light"
    window.toggle_palette()
    qtbot.keyClicks(page.field, "verbindung trennen")
    assert page.list.item(0).text() == "Verbindung: Trennen"
    page.field.setText("Bewegung: Fehler quittieren")
    assert "nicht jetzt" in page.list.item(0).text()
    page.hide()


def _every_command_works(window):
    for command in window.commands():
        assert command.text.replace("&", "").strip()
        if command.run != window.close:
            command.run()
            QCoreApplication.processEvents()
    for dialog in window.findChildren(QDialog):
        dialog.close()


def test_a_language_is_chosen_for_the_next_start(window, settings):
    told = []
    window.workbench.noticed.connect(lambda level, text: told.append((level, str(text))))
    actions = {action.data(): action for action in window.language_menu.actions()}
    assert {name: action.isChecked() for name, action in actions.items()} == {
        "": True,
        "en": False,
        "de": False,
    }
    actions["de"].trigger()
    assert settings.get(SETTING, "") == "de"
    assert told == [
        (
            Level.INFO,
            "The window speaks Deutsch from the next start on. "
            "Das Fenster spricht ab dem nächsten Start Deutsch.",
        )
    ]
    assert actions["de"].isChecked()
    assert not actions[""].isChecked()
    entries = {entry.text: entry for entry in window._entries()}
    entries["Language: English"].run()
    assert settings.get(SETTING, "") == "en"
    assert len(told) == 1  # it is spoken already
    window.language_menu.mark()
    assert actions["en"].isChecked()
