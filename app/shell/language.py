"""The language of the window: English as the code says it, and what is translated from it.

A text is written in English where it is shown, as ``translate("gap", "Diagnose")``: its context,
the folder it stands in, and itself. A text that is kept in a table is marked there, and translated
where it is shown: a table is made when its module is imported, before a language is in use. Texts
with values are templates and are filled later: ``translate("gap", "{n} records").format(n=3)``.

What the engines below the window say (refusals, reports, files) is English in every language.
"""

import logging
from importlib import resources
from importlib.resources.abc import Traversable

from PySide6.QtCore import QCoreApplication, QLibraryInfo, QLocale, QTranslator

from rotemina.app.settings import Settings

logger = logging.getLogger(__name__)

SETTING = "window.language"
SYSTEM = ""  # the system's language, where it is among these
ENGLISH = "en"
#: Each language by what it calls itself.
LANGUAGES = {ENGLISH: "English", "de": "Deutsch"}
_PACKAGE = "rotemina.resources.languages"
_IN_USE = "language"  # property of the application


def translate(context: str, text: str) -> str:
    """Return ``text`` in the language in use, itself where it has no translation."""
    return QCoreApplication.translate(context, text)


def marked(context: str, text: str) -> str:
    """Return ``text`` as it is: it is found for translation here, and translated where shown."""
    return text


def chosen(settings: Settings) -> str:
    """Return which language the window shall speak: as set, else the system's, else English."""
    asked = settings.get(SETTING, SYSTEM)
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
