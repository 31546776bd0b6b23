"""Whether the last row of a file is whole: a power cut or a broken copy may end inside a number.

A file of this program ends with a line end, so one without has lost something. Other programs may
write none. There the last number is whole if the numbers above it always have the same number of
digits, padded with zeros, and this one has them as well. Otherwise it cannot be known.
"""

import logging
import re

from rotemina.sim.messages import Wording, message
from rotemina.sim.records.fields import BLANKS, is_comment, split_fields, without_padding
from rotemina.sim.records.file_blocks import Block
from rotemina.sim.records.layout import Layout
from rotemina.sim.records.record import RecordError

_LOG = logging.getLogger(__name__)
_TAIL_BYTES = 65_536  # enough rows to show how numbers are written
_DIGITS = re.compile(r"[^.,eE]*(?:[.,](?P<decimals>\d*))?(?:[eE][+-]?(?P<exponent>\d+))?")


class FileEnd:
    """Keeps the last rows of a file and judges the very last.

    Parameters
    ----------
    name : the file's, for errors.
    layout : separator and columns.
    """

    def __init__(self, name: str, layout: Layout) -> None:
        self._name = name
        self._layout = layout
        self._tail = b""

    def add(self, block: Block, *, is_our_format: bool) -> None:
        """Keep the end of a block; at the end of the file refuse a row that was cut off, or warn.

        Raises
        ------
        RecordError
            If the file's last row was cut off.
        """
        kept = _TAIL_BYTES - len(block.data)
        self._tail = (self._tail[-kept:] if kept > 0 else b"") + block.data[-_TAIL_BYTES:]
        if block.unterminated:
            self._judge(block.last_line, is_our_format=is_our_format)

    def _judge(self, line: int, *, is_our_format: bool) -> None:
        rows = self._tail.decode("utf-8", "replace").replace("\r", "").split("\n")[:-1]
        if not rows or not _is_row(rows[-1]):
            return
        if is_our_format:
            raise RecordError(
                message(
                    "engine",
                    "{name}:{line}: the line has no line end, which every file of this program "
                    "has: the file was cut off here; copy it again, delete the line, or end it "
                    "with a line break if it is whole",
                ).fill(name=self._name, line=line)
            )
        # The first row may have lost its beginning, but its last number is whole.
        *above, number = map(self._last_number, filter(_is_row, rows))
        digits = set(map(_digits, above))
        is_padded = len(digits) == 1 and any(map(_has_padding, above))
        if is_padded and _digits(number) in digits:
            return
        if is_padded and _has_fewer(_digits(number), *digits):
            raise RecordError(
                message(
                    "engine",
                    "{name}:{line}: the last number {number} has fewer digits than all above it, "
                    "and the line has no line end: the file was cut off here; copy it again, or "
                    "delete the line",
                ).fill(name=self._name, line=line, number=repr(number))
            )
        quoted = Wording().quoted
        _LOG.warning(
            "%s:%d: the last line has no line end; if the file was cut off, its last number %s "
            "is not whole: compare it with the original, or delete the line",
            quoted(self._name),
            line,
            quoted(number),
        )

    def _last_number(self, line: str) -> str:
        fields = split_fields(line, self._layout.separator)
        return without_padding(fields, len(self._layout.columns))[-1]


def _is_row(line: str) -> bool:
    return bool(line.strip(BLANKS)) and not is_comment(line)


def _digits(number: str) -> tuple[int, int]:
    """Return how many decimals a number has, and how many digits its exponent."""
    match = _DIGITS.match(number)
    assert match is not None
    return len(match["decimals"] or ""), len(match["exponent"] or "")


def _has_padding(number: str) -> bool:
    """Return whether a number's decimals end in a zero, which its value does not need."""
    match = _DIGITS.match(number)
    return match is not None and (match["decimals"] or "").endswith("0")


def _has_fewer(digits: tuple[int, int], expected: tuple[int, int]) -> bool:
    return digits[0] < expected[0] or digits[1] < expected[1]
