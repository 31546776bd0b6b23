"""The language of the window: English as the code says it, and what is translated from it.

A text is written in English where it is shown, as ``translate("gap", "Diagnose")``: its context,
the folder it stands in, and itself. A text that is kept in a table is marked there, and translated
where it is shown: a table is made when its module is imported, before a language is in use. Texts
with values are templates and are filled later: ``translate("gap", "{n} records").format(n=3)``.

What the engines below the window say (refusals, reports, files) is English in every language.
"""

from PySide6.QtCore import QCoreApplication


def translate(context: str, text: str) -> str:
    """Return ``text`` in the language in use, itself where it has no translation."""
    return QCoreApplication.translate(context, text)


def marked(context: str, text: str) -> str:
    """Return ``text`` as it is: it is found for translation here, and translated where shown."""
    return text
