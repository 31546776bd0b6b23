"""Errors of the library of records that a user can cause or correct."""

from rotemina.sim.errors import InputError


class LibraryError(InputError):
    """The library cannot be read, or a change of it cannot be kept; the message says what to do."""


class DamagedLibraryError(LibraryError):
    """The library's file was damaged; it was set aside."""
