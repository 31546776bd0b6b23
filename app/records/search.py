"""Finding records by words."""

from collections.abc import Collection, Iterable

from rotemina.app.records.entry import Entry, Kind


def search(
    entries: Iterable[Entry], text: str = "", kinds: Collection[Kind] = frozenset(Kind)
) -> tuple[Entry, ...]:
    """Return the entries of some kinds that hold every word of a text, in their order.

    A word may stand anywhere in name, note, run, operator, sample, machine, driver, model,
    effects, date and file name; capital letters do not matter.
    """
    found = [one for one in entries if one.kind in kinds]
    for word in text.casefold().split():
        found = [one for one in found if word in one.searched]
    return tuple(found)
