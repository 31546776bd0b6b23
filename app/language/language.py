"""The language of the window: English from the source code, or a translation of it.

A text is written in English where it is shown, as ``translate("shell", "Stop")``, with its context,
the folder of the code. The folder of a panel states its context once for all its texts:
``tr("Diagnose")``. A text in a table is only marked there and translated where it is shown,
because the table is created at import, before a language is chosen. Texts with values are templates
that are filled later: ``tr("{n} records").format(n=3)``.

The code below the window uses messages (:mod:`rotemina.sim.messages.messages`). Their templates are
translated where they are shown: alone by :func:`translate_message`, or as a field of another text
by its ``format``. Numbers have the decimal sign of the language. Logs and files are English.
"""

import logging
from collections.abc import Callable
from enum import StrEnum
from functools import partial
from importlib import resources
from importlib.resources.abc import Traversable

import numpy as np
from PySide6.QtCore import QCoreApplication, QLibraryInfo, QLocale, QTranslator

from rotemina.app.language.display_units import get_axis_label
from rotemina.app.settings import LANGUAGE_KEY as LANGUAGE_KEY, UserSettings
from rotemina.sim.errors import MessageError, describe_exception

# Re-exported for the texts of the window.
from rotemina.sim.messages import (
    AxisName,
    EffectName,
    FieldList,
    Message,
    MessageWording,
    SystemText,
    decimal_sign,
    format_number,
    marked as marked,
    message,
    use_decimal_sign,
)

logger = logging.getLogger(__name__)

# The language of the operating system, if it is one of LANGUAGES.
SYSTEM_LANGUAGE = ""
ENGLISH = "en"
#: Names of the languages, each in its own language.
LANGUAGES = {ENGLISH: "English", "de": "Deutsch"}
_TEXTS_PACKAGE = "rotemina.resources.languages"
_SYSTEM_TEXT = marked("engine", "the system reports: “{text}”")
# The context of all texts from the layers below the window.
_ENGINE_CONTEXT = "engine"
# A dynamic property of the application object.
_LANGUAGE_PROPERTY = "language"


class FilledText(str):
    """Text that keeps its template and the values of the fields."""

    __slots__ = ("fields", "template")
    template: str
    fields: tuple[object, ...]

    def __new__(cls, text: str, template: str, fields: tuple[object, ...]) -> "FilledText":
        """Return the text with its template and the values of its fields."""
        filled_text = super().__new__(cls, text)
        filled_text.template, filled_text.fields = template, fields
        return filled_text


class LocalizedTemplate(str):
    """Template whose fields (numbers, messages, errors) are written in the language in use."""

    __slots__ = ()

    def format(self, *values: object, **fields: object) -> FilledText:
        """Return the text with its fields filled in."""
        localized_fields = {name: _localize(value) for name, value in fields.items()}
        text = super().format(*map(_localize, values), **localized_fields)
        return FilledText(text, str(self), (*values, *fields.values()))


class _LocalizedNumber:
    __slots__ = ("_value",)

    def __init__(self, value: float | np.ndarray | np.number) -> None:
        self._value = value

    def __format__(self, format_spec: str) -> str:
        if format_spec:
            return format_number(float(self._value), format_spec)
        return format(self._value)

    def __str__(self) -> str:
        return str(self._value)

    def __repr__(self) -> str:
        return repr(self._value)


def _localize(value: object) -> object:
    match value:
        case float() | np.ndarray() | np.number():
            return _LocalizedNumber(value)
        case Message() | AxisName() | EffectName() | SystemText() | StrEnum() | FieldList():
            return WindowWording().format_field(value)
        case BaseException():
            return describe_error(value)
    return value


def translate(context: str, text: str) -> LocalizedTemplate:
    """Return ``text`` in the language in use, or unchanged if it has no translation."""
    return LocalizedTemplate(QCoreApplication.translate(context, text))


class TranslatedWording(MessageWording):
    """Wording of messages in the window's language, with the axis names used in files."""

    @property
    def decimal_sign(self) -> str:
        """The decimal sign of the language."""
        return decimal_sign()

    def localize_text(self, context: str, template: str) -> str:
        """Return a template in the window's language."""
        return translate(context, template) if template else template

    def localize_word(self, text: str) -> str:
        """Return a word of the engine in the window's language; other texts are unchanged."""
        return translate(_ENGINE_CONTEXT, text) if text else text

    def quote_system_text(self, text: str) -> str:
        """Return the translation of a text of the operating system, or a quotation of the text."""
        translation = self.localize_word(text)
        quotation = self.localize_text(_ENGINE_CONTEXT, _SYSTEM_TEXT)
        is_plain = (
            translation != text or quotation == _SYSTEM_TEXT or not any(map(str.isalpha, text))
        )
        return translation if is_plain else quotation.format(text=text)

    def conjunction(self, *, one_of_them: bool) -> str:
        """Return the word before the last item of a list."""
        return translate("engine", "or") if one_of_them else translate("engine", "and")


class WindowWording(TranslatedWording):
    """Wording of messages in the window's language, with the axis names shown in the window."""

    def name_axis(self, name: str) -> str:
        """Return the name of an axis as the window shows it."""
        return get_axis_label(name)


def translate_message(text: str) -> str:
    """Return a message or a word of the engine in the window's language."""
    return WindowWording().format_field(text)


def describe_error(error: BaseException) -> str:
    """Return the text of an error in the window's language."""
    return translate_message(make_error_message(error))


def make_error_message(error: BaseException) -> str:
    """Return the text of an error as a message; texts of Python or a library are marked as such."""
    if isinstance(error, MessageError):
        return str(error)
    if isinstance(error, OSError) and error.filename is not None:
        template = message("engine", "{file}: {reason}")
        return template.fill(file=str(error.filename), reason=describe_exception(error))
    return describe_exception(error)


def make_text_functions(
    context: str,
) -> tuple[Callable[[str], LocalizedTemplate], Callable[[str], str]]:
    """Return :func:`translate` and :func:`marked` for the texts of one context."""
    return partial(translate, context), partial(marked, context)


def determine_language(settings: UserSettings, requested: str | None = None) -> str:
    """Return the window's language: the requested one, else the setting, else the system's."""
    requested = requested or settings.get(LANGUAGE_KEY, SYSTEM_LANGUAGE)
    if requested in LANGUAGES:
        return requested
    if requested != SYSTEM_LANGUAGE:
        logger.warning(
            "setting %s = %r is not a language of the window (%s); the system's language is used",
            LANGUAGE_KEY,
            requested,
            ", ".join(LANGUAGES),
        )
    system_languages = (name.partition("-")[0] for name in QLocale.system().uiLanguages())
    return next((name for name in system_languages if name in LANGUAGES), ENGLISH)


def use_language(application: QCoreApplication, language: str) -> None:
    """Use a language for all texts created from now on; untranslated texts stay English."""
    application.setProperty(_LANGUAGE_PROPERTY, language)
    _use_number_format(QLocale(language))
    for translator in application.findChildren(QTranslator):
        application.removeTranslator(translator)
        translator.deleteLater()
    if language == ENGLISH:
        return
    # The texts of Qt's own dialogs.
    qt_texts = QTranslator(application)
    folder = QLibraryInfo.path(QLibraryInfo.LibraryPath.TranslationsPath)
    if qt_texts.load(f"qtbase_{language}", folder):
        application.installTranslator(qt_texts)
    install_texts(application, resources.files(_TEXTS_PACKAGE), language)


def _use_number_format(locale: QLocale) -> None:
    """Write all numbers in the format of a locale, but without thousands separators."""
    options = QLocale.NumberOption
    locale.setNumberOptions(options.OmitGroupSeparator | options.RejectGroupSeparator)
    QLocale.setDefault(locale)
    use_decimal_sign(locale.decimalPoint())


def get_language(application: QCoreApplication | None) -> str:
    """Return the language of the window."""
    name = application.property(_LANGUAGE_PROPERTY) if application is not None else None
    return name or ENGLISH


def install_texts(application: QCoreApplication, folder: Traversable, language: str) -> None:
    """Install the translations ``<language>.qm`` of a folder; an unreadable file is only logged."""
    file = folder.joinpath(f"{language}.qm")
    try:
        texts = _TextFile(application, file.read_bytes())
    except OSError as error:
        logger.warning("%s cannot be read, the window uses English: %s", file, error)
        return
    if texts.readable:
        application.installTranslator(texts)
    else:
        logger.warning("%s is not a Qt translation file, the window uses English", file)


def add_package_texts(package: str) -> None:
    """Add the translations of a plugin's package, if it has the language in use.

    They are read from the folder ``languages`` of the package.
    """
    application = QCoreApplication.instance()
    language = get_language(application)
    if application is None or language == ENGLISH:
        return
    try:
        folder = resources.files(package).joinpath("languages")
        is_available = folder.joinpath(f"{language}.qm").is_file()
    except (ImportError, TypeError, ValueError, OSError):
        # There is no such package or it cannot be read, so its panels use English.
        return
    if is_available:
        install_texts(application, folder, language)


class _TextFile(QTranslator):
    """Translations of one file.

    The data must be kept, because Qt reads from this memory while it translates.
    """

    def __init__(self, application: QCoreApplication, data: bytes) -> None:
        super().__init__(application)
        self._data = data
        self.readable = self.load(data)
