"""Errors that a user can cause by a file or a request."""

from rotemina.sim.messages import SystemText


class ToldError(Exception):
    """An error whose text is what it was raised with: a message keeps its template and fields."""

    def __str__(self) -> str:
        """Return the text itself, not a copy that would forget its template and fields."""
        told = self.args[0] if len(self.args) == 1 else None
        return told if isinstance(told, str) else super().__str__()


class InputError(ToldError, ValueError):
    """A file or request that cannot be used.

    The message names what is wrong, where, the value, the bound and what to do. The command line
    prints it and exits with status 2; the window shows it as a notice.
    """


def reason_of(error: BaseException) -> str:
    """Return what an error says, to stand in a message; the system's words are marked as such."""
    if isinstance(error, ToldError):
        return str(error)
    return SystemText(getattr(error, "strerror", None) or str(error) or type(error).__name__)
