"""Notices to the operator: shown by the window, and logged."""

import logging
from collections.abc import Hashable
from enum import StrEnum

from PySide6.QtCore import QObject, Signal

from rotemina.app.workbench.help_topics import IsSettled, NoticeMessage, find_help_page
from rotemina.sim.errors import (
    InputError,
)

logger = logging.getLogger(__name__)


class Level(StrEnum):
    """Importance of a notice."""

    INFO = "info"
    GOOD = "good"
    WARNING = "warning"
    ERROR = "error"


class NoticePoster(QObject):
    """Poster of notices to the operator.

    Signals
    -------
    posted(Level, NoticeMessage) : a message for the operator, with its help page.
    settled(hashable) : the work of this subject was done, so the notice of an earlier failure is
        obsolete.
    """

    posted = Signal(object, object)
    settled = Signal(object)
    _warned = Signal(object)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._warned.connect(lambda text: self.notify(Level.WARNING, text, about="motion.md"))

    def notify(
        self,
        level: Level,
        text: str,
        about: object = None,
        *,
        until: IsSettled | None = None,
        subject: Hashable | None = None,
    ) -> None:
        """Show a notice to the operator.

        ``about`` is the error that is reported, a widget of the reporting panel, or the name of a
        help page; the notice then has a "?" that opens the page. A text that carries its page, such
        as the message of a failure in the background, needs none.

        The notice disappears when its cause is gone: as soon as ``until`` returns true for the
        session's state, or when :attr:`settled` names its ``subject``, the request or work that
        failed.
        """
        message = NoticeMessage(
            text,
            find_help_page(about),
            subject=subject,
            until=until,
            is_refusal=isinstance(about, InputError),
        )
        logger.log(
            logging.WARNING if level in (Level.WARNING, Level.ERROR) else logging.INFO, message
        )
        self.posted.emit(level, message)

    def refuse(self, text: str, about: object = None) -> None:
        """Report a refusal as :meth:`notify` does; the next action removes the notice."""
        self.notify(Level.ERROR, NoticeMessage(text, is_refusal=True), about=about)

    def warn_from_any_thread(self, text: str) -> None:
        """Show a warning about manual operation or the microscope."""
        self._warned.emit(text)
