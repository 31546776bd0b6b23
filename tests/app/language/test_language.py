"""The window in German, and the fallback when a language is unknown or its file is missing."""

import re
import subprocess
from pathlib import Path
from types import SimpleNamespace

import PySide6
import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QDialogButtonBox

from rotemina.app.language import LANGUAGE_KEY, language, translate, translate_message
from rotemina.app.language.language import determine_language
from rotemina.app.motion.inputs.profile import load_profile
from rotemina.app.motion.penetration import PenetrationParameters
from rotemina.app.workbench.help_topics import explain_error
from rotemina.drivers.contract import DriverError, find_driver
from rotemina.drivers.gcode.error_texts import ControllerFirmware, describe_alarm
from rotemina.sim.errors import InputError, OutOfLimitsError
from rotemina.sim.gap.intake import check_records as check_gap
from rotemina.sim.gap.output import read_document
from rotemina.sim.messages import message
from rotemina.sim.plate.mesh import make_mesh
from rotemina.sim.records import read_record
from rotemina.sim.robot_files import load_robot, parse_robot
from rotemina.sim.trajectory import check_target
from rotemina.sim.tuning.tuning_scenario import make_step
from rotemina.sim.units import parse_unit

PANELS = ("connection",)
LONG_MS = 30_000


@pytest.fixture
def set_system_languages(monkeypatch):
    """Set the languages of the system, the preferred one first."""

    def set_languages(*names):
        system = SimpleNamespace(uiLanguages=lambda: list(names))
        monkeypatch.setattr(language, "QLocale", SimpleNamespace(system=lambda: system))

    return set_languages


@pytest.fixture
def application(qapp):
    yield qapp
    language.use_language(qapp, "en")


@pytest.fixture
def german(application, settings, make_robot_window):
    settings.set(LANGUAGE_KEY, "de")
    return make_robot_window()


def get_notice_texts(window):
    return [notice.text for notice in window.notices.notices()]


def test_the_system_language_is_used_if_none_is_set(settings, set_system_languages):
    for names, expected in (
        (("de-AT", "de", "en"), "de"),
        (("fr-FR", "de-DE"), "de"),
        (("en-GB", "de"), "en"),
        (("C",), "en"),
        ((), "en"),
    ):
        set_system_languages(*names)
        assert determine_language(settings) == expected
        settings.set(LANGUAGE_KEY, "de")
        assert determine_language(settings) == "de"
        settings.set(LANGUAGE_KEY, "")


def test_an_unknown_language_is_logged_and_the_system_language_used(
    settings, set_system_languages, caplog
):
    set_system_languages("nl")
    settings.set(LANGUAGE_KEY, "klingon")
    assert determine_language(settings) == "en"
    assert "'klingon'" in caplog.text
    assert "en, de" in caplog.text
    settings.set(LANGUAGE_KEY, 7)
    assert determine_language(settings) == "en"


@pytest.mark.parametrize("content", [None, b"\x3c\xb8\x64\x18 no texts"])
def test_a_file_that_cannot_be_read_leaves_the_window_english(
    application, tmp_path, caplog, content
):
    if content is not None:
        (tmp_path / "de.qm").write_bytes(content)
    language.install_texts(application, tmp_path, "de")
    assert translate("panels", "Plots") == "Plots"
    assert str(tmp_path / "de.qm") in caplog.text


def test_the_language_can_be_changed_repeatedly(application):
    for name, plots, cancel in (
        ("de", "Diagramme", "Abbrechen"),
        ("en", "Plots", "Cancel"),
        ("de", "Diagramme", "Abbrechen"),
    ):
        language.use_language(application, name)
        assert language.get_language(application) == name
        assert translate("panels", "Plots") == plots
        box = QDialogButtonBox(QDialogButtonBox.StandardButton.Cancel)
        assert box.buttons()[0].text().replace("&", "") == cancel  # translated by Qt


def test_a_plugin_brings_its_own_texts(application, tmp_path, monkeypatch):
    package = tmp_path / "glass_stage" / "languages"
    package.mkdir(parents=True)
    (package.parent / "__init__.py").write_text("", "utf-8")
    message = "<message><source>Lamp</source><translation>Lampe</translation></message>"
    context = f"<context><name>glass_stage</name>{message}</context>"
    (tmp_path / "de.ts").write_text(f'<TS version="2.1" language="de">{context}</TS>', "utf-8")
    lrelease = Path(PySide6.__file__).parent / "lrelease"
    command = [lrelease, "-silent", tmp_path / "de.ts", "-qm", package / "de.qm"]
    subprocess.run(command, check=True)
    monkeypatch.syspath_prepend(tmp_path)
    for name, lamp in (("en", "Lamp"), ("de", "Lampe")):
        language.use_language(application, name)
        language.add_package_texts("glass_stage")
        language.add_package_texts("of_nobody")
        assert translate("glass_stage", "Lamp") == lamp
    assert translate("panels", "Plots") == "Diagramme"


def test_a_refusal_is_translated_with_its_values(application):
    robot = load_robot("rotemina")
    with pytest.raises(OutOfLimitsError) as refusal:
        check_target(robot, "zn", 6.55e-5)
    english = "axis zn: target 65.5 µm is outside its range 0 µm to 65 µm; choose a target inside"
    assert str(refusal.value) == english
    assert explain_error(refusal.value) == english.replace("zn", "Z nano")
    language.use_language(application, "de")
    assert explain_error(refusal.value) == (
        "Achse Z nano: Ziel 65,5 µm liegt außerhalb ihres Bereichs 0 µm bis 65 µm; ein Ziel "
        "innerhalb wählen"
    )
    assert str(refusal.value) == english


def catch_error(error_class, call, *args, **kwargs):
    """Return the error that the call raises."""
    with pytest.raises(error_class) as caught:
        call(*args, **kwargs)
    return caught.value


# Names, paths, and texts of the system or a library in brackets.
UNTRANSLATED = re.compile(r"'[^']*'|/\S*|\([^)]*\)")


def make_typical_errors(folder):
    """Yield typical errors of each layer below the window."""
    robot = load_robot("rotemina")
    record = folder / "record.csv"
    record.write_text("t [s],x.cmd [mm]\n0,1\n0,2\n", "utf-8")
    yield catch_error(InputError, read_record, folder / "missing.csv")
    yield catch_error(InputError, read_record, record)
    yield catch_error(InputError, parse_robot, "[robot]\nname = 'a'\naxes = 'x'\n", "a.toml")
    yield catch_error(InputError, parse_unit, "furlong")
    yield catch_error(DriverError, find_driver("mc68hc11")(robot, {"port": ""}).open)
    yield catch_error(DriverError, find_driver("mc68hc11")(robot, {"port": "/dev/none"}).open)
    yield catch_error(InputError, find_driver("gcode"), robot)
    yield catch_error(InputError, PenetrationParameters.from_text, "velocity = 1")
    profile = folder / "profile.toml"
    profile.write_text("name = 3", "utf-8")
    yield catch_error(InputError, load_profile, profile)
    yield catch_error(InputError, make_mesh, robot.plate, divisions=3)
    yield catch_error(InputError, make_step, robot.axes["zn"], 5000.0, distance=1.0)
    yield catch_error(InputError, read_document, folder / "missing.json")
    yield catch_error(InputError, check_gap, robot, [])


def test_refusals_of_each_layer_are_german_in_a_german_window(application, tmp_path):
    language.use_language(application, "de")
    messages = [str(error) for error in make_typical_errors(tmp_path)]
    translations = [translate_message(text) for text in messages]
    assert [
        text for text, german in zip(messages, translations, strict=True) if text == german
    ] == []
    english_word = re.compile(r"\b(the|is|must|there|it|not|choose|cannot|and|of)\b")
    assert [text for text in translations if english_word.search(UNTRANSLATED.sub("", text))] == []


def test_words_in_message_fields_are_translated_and_other_texts_stay(application):
    language.use_language(application, "de")
    stop = message("engine", "stop and lock")
    switch = message("engine", "limit switch reached: {switches}").fill(switches="x")
    for text, german_text in (
        (
            message("engine", "{stop} is active; release it first").fill(stop=stop),
            "Halt und sperren ist aktiv; erst freigeben",
        ),
        (
            message("engine", "{name}: cannot {action} while closed; open it first").fill(
                name="stage", action="play"
            ),
            "stage: geschlossen, kann nicht abspielen; erst öffnen",
        ),
        (
            message("engine", "board {address}: {words}").fill(address=1, words=switch),
            "Karte 1: Endschalter erreicht: x",
        ),
        (
            describe_alarm(1, ControllerFirmware.GRBL),
            "ALARM:1, Hardware-Grenze: ein Endschalter wurde erreicht",
        ),
        ("something that nobody has heard of", "something that nobody has heard of"),
    ):
        assert translate_message(text) == german_text


def test_numbers_have_the_decimal_sign_of_the_language(application):
    text = translate("shell", "stop latency {ms:.1f} ms (99.9 %)")
    assert text.format(ms=0.9) == "stop latency 0.9 ms (99.9 %)"
    language.use_language(application, "de")
    german = translate("shell", "stop latency {ms:.1f} ms (99.9 %)").format(ms=0.9)
    assert "0,9 ms" in german
    assert "99,9 %" in german


def test_the_window_is_german(qtbot, german):
    menus = [action.text() for action in german.menuBar().actions()]
    assert menus == ["&Datei", "&Bewegung", "&Ansicht", "&Hilfe"]
    assert german.docks["control"].windowTitle() == "Steuerung"
    assert german.stop_button.text() == "HALT (Esc)"
    _check_panel_notice(qtbot, german)
    _check_setting_number(german)
    _check_palette(qtbot, german)


def _check_panel_notice(qtbot, window):
    row = window.panels["control"].rows["x"]
    qtbot.waitUntil(row.go.isEnabled, timeout=LONG_MS)  # it is locked until a reading is fresh
    row.target.setText("1.500,0")
    row.go.click()
    assert "ist keine Position" in get_notice_texts(window)[0]
    assert "Dezimalkomma" in get_notice_texts(window)[0]


def _check_setting_number(window):
    field = window.panels["connection"].device.form.fields["settle_s"]
    assert field.widget.text() == "0,02"
    field.set_text("0,25")
    assert field.read_value() == 0.25
    field.set_text("0,02")


def _check_palette(qtbot, window):
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


def test_a_language_is_chosen_for_the_next_start(window, settings):
    notices = []
    window.workbench.notice_posted.connect(lambda _, text: notices.append(str(text)))
    actions = {action.data(): action for action in window.language_menu.actions()}

    def get_checked():
        return [name for name, action in actions.items() if action.isChecked()]

    assert (list(actions), get_checked()) == (["", "en", "de"], [""])
    actions["de"].trigger()
    assert (settings.get(LANGUAGE_KEY, ""), get_checked()) == ("de", ["de"])
    (text,) = notices
    assert "Deutsch from the next start" in text
    assert "ab dem nächsten Start auf Deutsch" in text
    entries = {entry.text: entry for entry in window._make_palette_entries()}
    entries["Language: English"].run()
    assert settings.get(LANGUAGE_KEY, "") == "en"
    assert len(notices) == 1  # it is in use already
    window.language_menu.check_current()
    assert get_checked() == ["en"]
