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
from rotemina.app.shell.language import spoken, translate
from rotemina.drivers.samples import DeviceState
from rotemina.sim.errors import InputError, reason_of
from rotemina.sim.messages import AxisName, Listed, SystemText, joined, message

PANELS = ("connection", "events", "recorder", "plots", "teleoperation", "penetration")
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


def english_in(text, english):
    """Return what of a text is English."""
    plain = " ".join(text.split())
    return sorted(piece for piece in english if re.search(rf"\b{re.escape(piece)}\b", plain))


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


def test_words_of_the_system_are_translated_where_known_and_quoted_elsewhere(
    qapp, german, monkeypatch
):
    quote = language.TranslatedWording.text

    def text(self, context, template):
        known = template == language._FOREIGN
        return "das System meldet: „{text}“" if known else quote(self, context, template)

    monkeypatch.setattr(language.TranslatedWording, "text", text)
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
    language.use(qapp, language.ENGLISH)
    monkeypatch.undo()
    assert explained(loop) == "/a: Too many levels"
