"""Errors that a user of the program can cause by a file or a request."""


class InputError(ValueError):
    """A file or request that cannot be used.

    The message names what is wrong, where, the value, the bound and what to do. The command line
    prints it and exits with status 2; the window shows it as a notice.
    """
