"""No message of a German window has English in it, however it was put together."""

import errno
import os
import re
import xml.etree.ElementTree as ET
from pathlib import Path
from string import Formatter

import pytest

from rotemina.app.shell import language
from rotemina.app.shell.help_topics import explained
from rotemina.app.shell.language import SETTING, spoken, translate
from rotemina.drivers.errors import ConnectionLostError
from rotemina.drivers.registry import driver_named
from rotemina.drivers.samples import DeviceState
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.errors import InputError, reason_of
from rotemina.sim.messages import AxisName, Listed, SystemText, joined, message

PANELS = ("connection", "events")
LONG_MS = 30_000
CATALOGUE = Path(__file__).parents[3] / "resources" / "languages" / "de"
_WORD = re.compile(r"[A-Za-z]{2,}")


def pieces(text):
    """Return what a template says around its fields, where that is two words or more."""
    for literal, *_ in Formatter().parse(text):
        if len(_WORD.findall(literal)) >= 2:
            yield " ".join(literal.split()).strip(" ,.;:()")


@pytest.fixture(scope="module")
def english():
    """What templates say in English, and in German do not."""
    found = set()
    for path in CATALOGUE.glob("*.ts"):
        for each in ET.parse(path).iter("message"):  # noqa: S314 (a file of this repository)
            german = each.findtext("translation") or ""
            try:
                found |= {piece for piece in pieces(each.findtext("source")) if piece not in german}
            except ValueError:  # a text with braces that are no fields
                continue
    assert len(found) > 2000
    return found


@pytest.fixture
def german(qapp):
    language.use(qapp, "de")
    yield
    language.use(qapp, language.ENGLISH)


@pytest.fixture
def quoting(monkeypatch):
    """Quote what the system says in German, whether that is in the catalogue yet or not."""
    usual = language.TranslatedWording.text

    def text(self, context, template):
        foreign = template == language._FOREIGN
        return "das System meldet: „{text}“" if foreign else usual(self, context, template)

    monkeypatch.setattr(language.TranslatedWording, "text", text)


def english_in(text, english):
    """Return what of a text is English."""
    plain = " ".join(text.split())
    there = (piece for piece in english if piece in plain)
    return sorted(piece for piece in there if re.search(rf"\b{re.escape(piece)}\b", plain))


OUTSIDE = message("engine", "axis {axis}: target {target} is outside its range {low} to {high}; ")


def nested():
    """Yield a message wherever one may stand in another, and an axis and a word with it."""
    inner = message("engine", "the position of {axes} is not known; home first").fill(
        axes=joined((AxisName("thy"), AxisName("zn")), ", ")
    )
    error = InputError(inner)
    outer = message("engine", "the device failed ({fault}); reconnect, then check its position")
    yield outer.fill(fault=inner)
    yield outer.fill(fault=reason_of(error))
    yield outer.fill(fault=Listed((inner, inner)))
    yield outer.fill(fault=joined((inner, inner), "; "))
    yield outer.fill(fault=message("engine", "{what}: {error}").fill(what="home", error=inner))
    paused = translate(
        "shell",
        "Playback paused: {text}. Check the machine, then resume or end the playback.",
    )
    yield paused.format(text=inner)
    yield paused.format(text=error)
    yield explained(error)


def test_a_message_within_another_is_german_too(german, english):
    for text in nested():
        shown = spoken(text)
        assert english_in(shown, english) == [], shown
        assert "Position von θy" in shown
        assert "thy" not in shown
    shown = translate("shell", "{name} cannot be shown: a penetration is {phase}; end it first")
    assert "thrust" not in shown.format(name="a", phase=DeviceState.MOVING)


def test_the_check_finds_a_message_that_was_made_a_text(german, english):
    outer = message("engine", "the device failed ({fault}); reconnect, then check its position")
    inner = message("engine", "the position of {axes} is not known; home first").fill(axes="x")
    assert english_in(spoken(outer.fill(fault=f"{inner}")), english)


def test_words_of_the_system_are_translated_where_known_and_quoted_elsewhere(qapp, german, quoting):
    denied = OSError(errno.EACCES, os.strerror(errno.EACCES), "/a/b.csv")
    assert explained(denied) == "/a/b.csv: keine Berechtigung"
    loop = OSError(errno.ELOOP, "Too many levels", "/a")
    assert explained(loop) == "/a: das System meldet: „Too many levels“"
    assert translate("shell", "{path}").format(path=ValueError("no such thing")) == (
        "das System meldet: „no such thing“"
    )
    cannot = message("engine", "{name} cannot be read ({reason}){then}")
    assert "(das System meldet: „odd“)" in spoken(
        cannot.fill(name="a", reason=SystemText("odd"), then="")
    )


class Unplugged(Simulator):
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


def refused_of(window, folder):
    """Yield requests that a window refuses, one after another."""
    bench = window.workbench
    bad = folder / "bad.csv"
    bad.write_text("t [s],x.cmd [kg]\n0,1\n0,2\n", "utf-8")
    yield bench.play
    yield lambda: bench.save_record(folder / "a.csv")
    yield lambda: bench.go_to({"zn": 70e-6})
    yield lambda: bench.go_to({"thy": 1.0, "zn": 1.0})
    yield lambda: bench.jog("thx", 1.0)
    yield lambda: bench.set_voltage("zn", 1e6)
    yield bench.undo
    yield bench.clear_floor
    yield lambda: bench.load_trajectory(folder / "missing.csv")
    yield lambda: bench.open_record(bad)
    yield lambda: bench.open_replay(bad)
    yield bench.emergency_stop
    yield lambda: bench.home(["x"])
    yield lambda: bench.jog("zn", 1e-6)
    yield bench.release


def test_what_a_german_window_says_of_refusals_and_faults_is_german(
    qtbot, qapp, settings, make_robot_window, tmp_path, english, quoting
):
    settings.set(SETTING, "de")
    window = make_robot_window(driver=Unplugged)
    told = []
    window.workbench.noticed.connect(lambda _, text: told.append(str(text)))
    session = window.workbench.session
    qtbot.waitUntil(lambda: session.snapshot().locked is None, timeout=LONG_MS)
    for request in refused_of(window, tmp_path):
        request()
        qtbot.waitUntil(lambda: not window.workbench.busy, timeout=LONG_MS)
    session.driver.cut = True
    qtbot.waitUntil(lambda: any("COM9" in text for text in told), timeout=LONG_MS)
    window.workbench.use_driver(driver_named("mc68hc11"), {"port": "/dev/none"})
    qtbot.waitUntil(lambda: any("/dev/none" in text for text in told), timeout=LONG_MS)
    entries = [entry.text for entry in window.panels["events"].journal.entries]
    assert len(told) > 10
    own = [re.sub(r"„.*?“", "", text) for text in (*told, *entries)]
    found = {text: english_in(text, english) for text in own}
    assert {text: words for text, words in found.items() if words} == {}
    assert [text for text in own if re.search(r"\b(the|is|must|not|thx|thy|zn)\b", text)] == []
    language.use(qapp, language.ENGLISH)
