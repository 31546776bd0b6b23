"""No message of a German window contains English, however it was composed."""

import errno
import os
import re
import xml.etree.ElementTree as ET
from pathlib import Path
from string import Formatter

import pytest

from rotemina.app.language import LANGUAGE_KEY, language, translate, translate_message
from rotemina.app.workbench.help_topics import explain_error
from rotemina.drivers.contract import ConnectionLostError, DeviceState, find_driver
from rotemina.drivers.simulator import Simulator
from rotemina.sim.errors import InputError, describe_exception
from rotemina.sim.messages import AxisName, FieldList, SystemText, join_messages, message

PANELS = ("connection", "events")
LONG_MS = 30_000
CATALOGUE = Path(__file__).parents[3] / "resources" / "languages" / "de"
_WORD = re.compile(r"[A-Za-z]{2,}")


def split_literals(text):
    """Yield the literal parts of a template that have at least two words."""
    for literal, *_ in Formatter().parse(text):
        if len(_WORD.findall(literal)) >= 2:
            yield " ".join(literal.split()).strip(" ,.;:()")


@pytest.fixture(scope="module")
def english_literals():
    """The English literals of all templates that do not appear in their German translation."""
    literals = set()
    for path in CATALOGUE.glob("*.ts"):
        for entry in ET.parse(path).iter("message"):  # noqa: S314 (a file of this repository)
            german = entry.findtext("translation") or ""
            try:
                literals |= {
                    piece
                    for piece in split_literals(entry.findtext("source"))
                    if piece not in german
                }
            except ValueError:  # the braces in this text are not fields
                continue
    assert len(literals) > 2000
    return literals


@pytest.fixture
def german(qapp):
    language.use_language(qapp, "de")
    yield
    language.use_language(qapp, language.ENGLISH)


@pytest.fixture
def quote_system_texts(monkeypatch):
    """Quote texts of the system in German, even if the catalogue lacks the phrase."""
    original = language.TranslatedWording.localize_text

    def localize_text(self, context, template):
        is_system_text = template == language._SYSTEM_TEXT
        return (
            "das System meldet: „{text}“" if is_system_text else original(self, context, template)
        )

    monkeypatch.setattr(language.TranslatedWording, "localize_text", localize_text)


def find_english(text, english_literals):
    """Return the English literals in a text."""
    plain = " ".join(text.split())
    candidates = (piece for piece in english_literals if piece in plain)
    return sorted(piece for piece in candidates if re.search(rf"\b{re.escape(piece)}\b", plain))


OUTSIDE = message("engine", "axis {axis}: target {target} is outside its range {low} to {high}; ")


def make_nested_messages():
    """Yield messages nested in each other in every supported way."""
    inner = message("engine", "the position of {axes} is not known; home first").fill(
        axes=join_messages((AxisName("thy"), AxisName("zn")), ", ")
    )
    error = InputError(inner)
    outer = message("engine", "the device failed ({fault}); reconnect, then check its position")
    yield outer.fill(fault=inner)
    yield outer.fill(fault=describe_exception(error))
    yield outer.fill(fault=FieldList((inner, inner)))
    yield outer.fill(fault=join_messages((inner, inner), "; "))
    yield outer.fill(fault=message("engine", "{what}: {error}").fill(what="home", error=inner))
    paused = translate(
        "shell", "Playback paused: {text}. Check the machine, then resume or end the playback."
    )
    yield paused.format(text=inner)
    yield paused.format(text=error)
    yield explain_error(error)


def test_a_nested_message_is_translated(german, english_literals):
    for text in make_nested_messages():
        shown = translate_message(text)
        assert find_english(shown, english_literals) == [], shown
        assert "Position von θy" in shown
        assert "thy" not in shown
    shown = translate("shell", "{name} cannot be shown: a penetration is {phase}; end it first")
    assert "thrust" not in shown.format(name="a", phase=DeviceState.MOVING)


def test_the_check_finds_a_message_that_was_converted_to_text(german, english_literals):
    outer = message("engine", "the device failed ({fault}); reconnect, then check its position")
    inner = message("engine", "the position of {axes} is not known; home first").fill(axes="x")
    assert find_english(translate_message(outer.fill(fault=f"{inner}")), english_literals)


def test_system_errors_are_translated_if_known_and_quoted_otherwise(
    qapp, german, quote_system_texts
):
    denied = OSError(errno.EACCES, os.strerror(errno.EACCES), "/a/b.csv")
    assert explain_error(denied) == "/a/b.csv: keine Berechtigung"
    loop = OSError(errno.ELOOP, "Too many levels", "/a")
    assert explain_error(loop) == "/a: das System meldet: „Too many levels“"
    assert translate("shell", "{path}").format(path=ValueError("no such thing")) == (
        "das System meldet: „no such thing“"
    )
    unreadable = message("engine", "{name} cannot be read ({reason}){then}")
    assert "(das System meldet: „odd“)" in translate_message(
        unreadable.fill(name="a", reason=SystemText("odd"), then="")
    )


class UnpluggableSimulator(Simulator):
    """A simulator whose link can be cut."""

    cut = False

    def _read(self):
        if self.cut:
            lost = message(
                "engine",
                "{url}: the port has disappeared ({error}). Plug it in and reconnect, then "
                "check the position of the machine",
            )
            raise ConnectionLostError(lost.fill(url="COM9", error=SystemText("EOF")))
        return super()._read()


def make_refused_requests(window, folder):
    """Yield requests that the window refuses."""
    bench = window.workbench
    bad = folder / "bad.csv"
    bad.write_text("t [s],x.cmd [kg]\n0,1\n0,2\n", "utf-8")
    yield bench.play
    yield lambda: bench.records.save_record(folder / "a.csv")
    yield lambda: bench.go_to({"thy": 1.0, "zn": 1.0})
    yield lambda: bench.jog("thx", 1.0)
    yield lambda: bench.set_voltage("zn", 1e6)
    yield bench.undo
    yield bench.clear_floor
    yield lambda: bench.planner.load_trajectory(folder / "missing.csv")
    yield lambda: bench.records.open_record(bad)
    yield lambda: bench.open_replay(bad)
    yield bench.emergency_stop
    yield lambda: bench.home(["x"])
    yield lambda: bench.jog("zn", 1e-6)
    yield bench.release


def test_refusals_and_faults_in_a_german_window_are_german(
    qtbot, qapp, settings, make_robot_window, tmp_path, english_literals, quote_system_texts
):
    settings.set(LANGUAGE_KEY, "de")
    window = make_robot_window(driver=UnpluggableSimulator)
    notices = []
    window.workbench.notice_posted.connect(lambda _, text: notices.append(str(text)))
    session = window.workbench.session
    qtbot.waitUntil(lambda: session.snapshot().lock_reason is None, timeout=LONG_MS)
    for request in make_refused_requests(window, tmp_path):
        request()
        qtbot.waitUntil(lambda: not window.workbench.busy, timeout=LONG_MS)
    session.driver.cut = True
    qtbot.waitUntil(lambda: any("COM9" in text for text in notices), timeout=LONG_MS)
    window.workbench.use_driver(find_driver("mc68hc11"), {"port": "/dev/none"})
    qtbot.waitUntil(lambda: any("/dev/none" in text for text in notices), timeout=LONG_MS)
    entries = [entry.text for entry in window.panels["events"].journal.entries]
    assert len(notices) > 10
    own_words = [re.sub(r"„.*?“", "", text) for text in (*notices, *entries)]
    english_by_text = {text: find_english(text, english_literals) for text in own_words}
    assert {text: literals for text, literals in english_by_text.items() if literals} == {}
    assert [
        text for text in own_words if re.search(r"\b(the|is|must|not|thx|thy|zn)\b", text)
    ] == []
    language.use_language(qapp, language.ENGLISH)
