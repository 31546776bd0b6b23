"""The language of the window: English as the code says it, and what is translated from it.

A text is written in English where it is shown, as ``translate("shell", "Stop")``: its context, the
folder it stands in, and itself. The folder of a panel names its context once, for all its texts:
``tr("Diagnose")``. A text that is kept in a table is marked there, and translated where it is
shown: a table is made when its module is imported, before a language is in use. Texts with values
are templates and are filled later: ``tr("{n} records").format(n=3)``.

What is below the window says it in messages (:mod:`rotemina.sim.messages`), whose templates are
translated where they are shown: alone by :func:`spoken`, in a field of a text by its ``format``.
Numbers have the decimal sign of the language. Logs and files are English.
"""

import logging
from collections.abc import Callable
from enum import StrEnum
from functools import partial
from importlib import resources
from importlib.resources.abc import Traversable

import numpy as np
from PySide6.QtCore import QCoreApplication, QLibraryInfo, QLocale, QTranslator

from rotemina.app.display_units import label
from rotemina.app.settings import LANGUAGE as SETTING
from rotemina.app.settings import Settings
from rotemina.sim.errors import ToldError, reason_of
from rotemina.sim.messages import (
    AxisName,
    EffectName,
    Listed,
    Message,
    SystemText,
    Wording,
    message,
)
from rotemina.sim.messages import marked as marked  # which the engines use for theirs
from rotemina.sim.quantities import decimal_sign, formatted, use_decimal_sign

logger = logging.getLogger(__name__)

SYSTEM = ""  # the system's language, where it is among these
ENGLISH = "en"
#: Each language by what it calls itself.
LANGUAGES = {ENGLISH: "English", "de": "Deutsch"}
_PACKAGE = "rotemina.resources.languages"
_FOREIGN = marked("engine", "the system reports: “{text}”")
_ENGINE = "engine"  # the context of what is below the window
_IN_USE = "language"  # property of the application


class FilledText(str):
    """A text that keeps the template it was made from, and what stands in its fields."""

    __slots__ = ("fields", "template")
    template: str
    fields: tuple[object, ...]

    def __new__(cls, text: str, template: str, fields: tuple[object, ...]) -> "FilledText":
        """Return the text with its template and the values of its fields."""
        made = super().__new__(cls, text)
        made.template, made.fields = template, fields
        return made


class Template(str):
    """A text whose fields read as the language in use has them: numbers, messages, errors."""

    __slots__ = ()

    def format(self, *values: object, **fields: object) -> FilledText:
        """Return it with something in each of its fields."""
        named = {name: _local(value) for name, value in fields.items()}
        text = super().format(*map(_local, values), **named)
        return FilledText(text, str(self), (*values, *fields.values()))


class _Number:
    """A number that is written with the decimal sign in use."""

    __slots__ = ("_value",)

    def __init__(self, value: float | np.ndarray | np.number) -> None:
        self._value = value

    def __format__(self, format_spec: str) -> str:
        if format_spec:
            return formatted(float(self._value), format_spec)
        return format(self._value)

    def __str__(self) -> str:
        return str(self._value)

    def __repr__(self) -> str:
        return repr(self._value)


def _local(value: object) -> object:
    match value:
        case float() | np.ndarray() | np.number():
            return _Number(value)
        case Message() | AxisName() | EffectName() | SystemText() | StrEnum() | Listed():
            return WindowWording().shown(value)
        case BaseException():
            return error_text(value)
    return value


def translate(context: str, text: str) -> Template:
    """Return ``text`` in the language in use, itself where it has no translation."""
    return Template(QCoreApplication.translate(context, text))


class TranslatedWording(Wording):
    """Messages in the language of the window, with the names that axes have in files."""

    @property
    def decimal_sign(self) -> str:
        """The sign of the language."""
        return decimal_sign()

    def text(self, context: str, template: str) -> str:
        """Return a template in the language of the window."""
        return translate(context, template) if template else template

    def word(self, text: str) -> str:
        """Return a word of the engine; another text as it is."""
        return translate(_ENGINE, text) if text else text

    def foreign(self, text: str) -> str:
        """Return a text of the system in the language of the window, or quoted as foreign."""
        shown = self.word(text)
        quoted = self.text(_ENGINE, _FOREIGN)
        known = shown != text or quoted == _FOREIGN or not any(map(str.isalpha, text))
        return shown if known else quoted.format(text=text)

    def conjunction(self, *, one_of_them: bool) -> str:
        """Return what stands before the last one of several."""
        return translate("engine", "or") if one_of_them else translate("engine", "and")


class WindowWording(TranslatedWording):
    """Messages in the language of the window, with its names of axes."""

    def axis(self, name: str) -> str:
        """Return what the window calls an axis."""
        return label(name)


def spoken(text: str) -> str:
    """Return a message or a word of the engine in the language of the window."""
    return WindowWording().shown(text)


def error_text(error: BaseException) -> str:
    """Return what an error says, in the language of the window."""
    return spoken(error_message(error))


def error_message(error: BaseException) -> str:
    """Return what an error says as a message; what Python or a library says is marked as such."""
    if isinstance(error, ToldError):
        return str(error)
    if isinstance(error, OSError) and error.filename is not None:
        told = message("engine", "{file}: {reason}")
        return told.fill(file=str(error.filename), reason=reason_of(error))
    return reason_of(error)


def texts_of(context: str) -> tuple[Callable[[str], Template], Callable[[str], str]]:
    """Return :func:`translate` and :func:`marked` for texts of one context."""
    return partial(translate, context), partial(marked, context)


def chosen(settings: Settings, asked: str | None = None) -> str:
    """Return which language the window speaks: that asked for, else as set, else the system's."""
    asked = asked or settings.get(SETTING, SYSTEM)
    if asked in LANGUAGES:
        return asked
    if asked != SYSTEM:
        logger.warning(
            "the setting %s = %r is no language of the window (those are %s): the system's is used",
            SETTING,
            asked,
            ", ".join(LANGUAGES),
        )
    spoken = (name.partition("-")[0] for name in QLocale.system().uiLanguages())
    return next((name for name in spoken if name in LANGUAGES), ENGLISH)


def use(application: QCoreApplication, language: str) -> None:
    """Let all that is made from now on speak a language; texts that are missing are English."""
    application.setProperty(_IN_USE, language)
    _write_numbers_as(QLocale(language))
    for old in application.findChildren(QTranslator):
        application.removeTranslator(old)
        old.deleteLater()
    if language == ENGLISH:
        return
    dialogs = QTranslator(application)  # what Qt's own dialogs say
    folder = QLibraryInfo.path(QLibraryInfo.LibraryPath.TranslationsPath)
    if dialogs.load(f"qtbase_{language}", folder):
        application.installTranslator(dialogs)
    install(application, resources.files(_PACKAGE), language)


def _write_numbers_as(locale: QLocale) -> None:
    """Let texts and fields write numbers as a locale does, but without separators of thousands."""
    options = QLocale.NumberOption
    locale.setNumberOptions(options.OmitGroupSeparator | options.RejectGroupSeparator)
    QLocale.setDefault(locale)
    use_decimal_sign(locale.decimalPoint())


def in_use(application: QCoreApplication | None) -> str:
    """Return the language that the window speaks."""
    name = application.property(_IN_USE) if application is not None else None
    return name or ENGLISH


def install(application: QCoreApplication, folder: Traversable, language: str) -> None:
    """Add the texts of ``<language>.qm`` in a folder; a file that cannot be read is only logged."""
    file = folder.joinpath(f"{language}.qm")
    try:
        texts = _Texts(application, file.read_bytes())
    except OSError as error:
        logger.warning("%s: no texts, the window speaks English: %s", file, error)
        return
    if texts.readable:
        application.installTranslator(texts)
    else:
        logger.warning("%s: not a file that Qt reads texts from, the window speaks English", file)


def add_texts_of(package: str) -> None:
    """Add what a plugin's package carries in ``languages``, if it has the language in use."""
    application = QCoreApplication.instance()
    spoken = in_use(application)
    if application is None or spoken == ENGLISH:
        return
    try:
        folder = resources.files(package).joinpath("languages")
        carried = folder.joinpath(f"{spoken}.qm").is_file()
    except (ImportError, TypeError, ValueError, OSError):
        return  # no package, or one that cannot be looked into: its panels speak English
    if carried:
        install(application, folder, spoken)


class _Texts(QTranslator):
    """Texts of one file, and the memory that Qt reads them from as long as it translates."""

    def __init__(self, application: QCoreApplication, data: bytes) -> None:
        super().__init__(application)
        self._data = data
        self.readable = self.load(data)
