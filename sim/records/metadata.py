"""The ``# key: value`` lines of a record file."""

from collections.abc import Callable, Iterator, Mapping

from rotemina.sim.errors import RecordError
from rotemina.sim.messages import marked, message
from rotemina.sim.records.fields import BLANKS, without_quotes

VERSION_KEY = "rotemina-record"
FORMAT_VERSION = "1"
# A spreadsheet fills a line with these characters up to the width of the table.
_FILLERS = BLANKS + ",;"


def _is_count(text: str) -> bool:
    return text.isascii() and text.isdigit() and len(text) <= 15 and int(text) > 0


# The keys that the program itself reads, each with a check of the value and advice. Any other key
# belongs to the user.
_KEY_RULES: Mapping[str, tuple[Callable[[str], bool], str]] = {
    VERSION_KEY: (
        lambda text: text == FORMAT_VERSION,
        message("engine", "the version must be {version}").fill(version=FORMAT_VERSION),
    ),
    "mode": (
        lambda text: text in ("open_loop", "closed_loop"),
        marked("engine", "use open_loop or closed_loop"),
    ),
    "history": (
        lambda text: text in ("unknown", "periodic"),
        marked(
            "engine",
            marked(
                "engine", "use unknown or periodic, or leave the line out for a machine at rest"
            ),
        ),
    ),
    "period_samples": (
        _is_count,
        marked("engine", "use a positive whole number of rows"),
    ),
}


def parse_comment(line: str) -> tuple[str, str] | None:
    """Return the key and value of a line that begins with ``#``, or None if it has no key."""
    line = without_quotes(line.strip(BLANKS))
    key, colon, value = line.removeprefix("#").partition(":")
    key, value = key.strip(BLANKS), value.strip(BLANKS)
    return (key, value) if colon and key else None


class FileComments:
    """The entries of the ``#`` lines that have been read from a file."""

    def __init__(self) -> None:
        self._values: dict[str, list[str]] = {}

    @property
    def metadata(self) -> dict[str, str]:
        """The entries of the lines, without the version of the format.

        If a key of the user has several values, they are joined by ``"; "``.
        """
        return {
            key: "; ".join(values) for key, values in self._values.items() if key != VERSION_KEY
        }

    @property
    def has_version(self) -> bool:
        """Whether a line states the version of this program's format, as in its own files."""
        return VERSION_KEY in self._values

    def add(self, line: str, where: str) -> None:
        """Add the entry of one line.

        Raises
        ------
        RecordError
            If the key is one of the program's and the value is invalid or contradicts an earlier
            one.
        """
        entry = parse_comment(line)
        if entry is None:
            return
        key, value = entry
        if key in _KEY_RULES:
            value = value.rstrip(_FILLERS)
        check_entry(key, value, where)
        values = self._values.setdefault(key, [])
        if values and key in _KEY_RULES and value != values[-1]:
            raise RecordError(
                "{where}:{key}: {value} contradicts {values}; keep one",
                where=where,
                key=key,
                value=repr(value),
                values=repr(values[-1]),
            )
        if not values or value != values[-1]:
            values.append(value)


def check_entry(key: str, value: str, where: str) -> None:
    """Refuse an invalid value of one of the program's keys."""
    is_valid, advice = _KEY_RULES.get(key, (None, ""))
    if is_valid is not None and not is_valid(value):
        raise RecordError(
            "{where}:{key}: value {value}; {advice}",
            where=where,
            key=key,
            value=repr(value),
            advice=advice,
        )


def format_comments(metadata: Mapping[str, str], longest: int) -> Iterator[str]:
    """Yield the ``#`` lines of a file, the version first; each has fewer than ``longest`` bytes.

    Raises
    ------
    RecordError
        If an entry would not be the same when read back.
    """
    for key, value in {VERSION_KEY: FORMAT_VERSION, **metadata}.items():
        check_entry(key, value, "metadata")
        line = f"# {key}: {value}".rstrip(BLANKS)
        if parse_comment(line) != (key, value) or not _is_one_line(line):
            raise RecordError(
                "metadata:{key}: {value} does not fit in a '# key: value' line; remove line "
                "ends, control characters, surrounding blanks, and ':' in the key",
                key=repr(key),
                value=repr(value),
            )
        if len(line.encode()) >= longest:
            raise RecordError(
                "metadata:{key}: longer than {longest} bytes; shorten it",
                key=repr(key),
                longest=longest,
            )
        yield line


def _is_one_line(line: str) -> bool:
    try:
        line.encode()
    except UnicodeEncodeError:
        return False
    return not any(ord(character) < 32 and character != "\t" for character in line)
