"""The ``# key: value`` lines of a record file."""

from collections.abc import Callable, Iterator, Mapping

from rotemina.sim.messages import marked, message
from rotemina.sim.records.fields import BLANKS, without_quotes
from rotemina.sim.records.record import RecordError

VERSION_KEY = "rotemina-record"
VERSION = "1"
# With which a spreadsheet fills a line up to the width of the table.
_FILLERS = BLANKS + ",;"


def _is_count(text: str) -> bool:
    return text.isascii() and text.isdigit() and len(text) <= 15 and int(text) > 0


# What the program itself reads, with what it may be; any other key is the user's.
_RULES: Mapping[str, tuple[Callable[[str], bool], str]] = {
    VERSION_KEY: (
        lambda text: text == VERSION,
        message("engine", "the version must be {version}").fill(version=VERSION),
    ),
    "mode": (
        lambda text: text in ("open_loop", "closed_loop"),
        marked("engine", marked("engine", "use open_loop or closed_loop")),
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
        marked("engine", marked("engine", "use a positive whole number of rows")),
    ),
}


def parse_comment(line: str) -> tuple[str, str] | None:
    """Return the key and value of one line that begins with ``#``, or None for plain prose."""
    line = without_quotes(line.strip(BLANKS))
    key, colon, value = line.removeprefix("#").partition(":")
    key, value = key.strip(BLANKS), value.strip(BLANKS)
    return (key, value) if colon and key else None


class Comments:
    """The ``#`` lines of one file, as far as they were read."""

    def __init__(self) -> None:
        self._values: dict[str, list[str]] = {}

    @property
    def metadata(self) -> dict[str, str]:
        """What the lines said, without the format's version.

        A key of the user that came with several values has them all, with ``"; "`` between.
        """
        return {key: "; ".join(each) for key, each in self._values.items() if key != VERSION_KEY}

    @property
    def name_our_format(self) -> bool:
        """Whether a line names the version of this program's format, as its own files do."""
        return VERSION_KEY in self._values

    def add(self, line: str, where: str) -> None:
        """Add what one line says.

        Raises
        ------
        RecordError
            If the program reads the key, and the value is none of its values or contradicts one
            before.
        """
        entry = parse_comment(line)
        if entry is None:
            return
        key, value = entry
        if key in _RULES:
            value = value.rstrip(_FILLERS)
        check_entry(key, value, where)
        values = self._values.setdefault(key, [])
        if values and key in _RULES and value != values[-1]:
            raise RecordError(
                message("engine", "{where}:{key}: {value} contradicts {values}; keep one").fill(
                    where=where, key=key, value=repr(value), values=repr(values[-1])
                )
            )
        if not values or value != values[-1]:
            values.append(value)


def check_entry(key: str, value: str, where: str) -> None:
    """Refuse a value that a key of the program may not have."""
    allowed, advice = _RULES.get(key, (None, ""))
    if allowed is not None and not allowed(value):
        raise RecordError(
            message("engine", "{where}:{key}: value {value}; {advice}").fill(
                where=where, key=key, value=repr(value), advice=advice
            )
        )


def comment_lines(metadata: Mapping[str, str], longest: int) -> Iterator[str]:
    """Give the ``#`` lines of a file, the version first, each of at most ``longest`` bytes.

    Raises
    ------
    RecordError
        If an entry would not read back as it is.
    """
    for key, value in {VERSION_KEY: VERSION, **metadata}.items():
        check_entry(key, value, "metadata")
        line = f"# {key}: {value}".rstrip(BLANKS)
        if parse_comment(line) != (key, value) or not _is_one_line(line):
            raise RecordError(
                message(
                    "engine",
                    "metadata:{key}: {value} does not fit in a '# key: value' line; leave out line "
                    "ends, control characters, blanks around, and ':' in the key",
                ).fill(key=repr(key), value=repr(value))
            )
        if len(line.encode()) >= longest:
            raise RecordError(
                message("engine", "metadata:{key}: longer than {longest} bytes; shorten it").fill(
                    key=repr(key), longest=longest
                )
            )
        yield line


def _is_one_line(line: str) -> bool:
    try:
        line.encode()
    except UnicodeEncodeError:
        return False
    return not any(ord(sign) < 32 and sign != "\t" for sign in line)
