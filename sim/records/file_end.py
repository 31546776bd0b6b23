"""Check whether the last row of a file is complete.

After a power cut or a broken copy, a file may end inside a number. A file of this program ends with
a line end, so a file without one is incomplete. Other programs may write no line end. Then the last
number is complete if all numbers above it have the same number of digits, padded with zeros, and
the last number has as many. Otherwise this cannot be decided.
"""

import logging
import re

from rotemina.sim.errors import RecordError
from rotemina.sim.messages import MessageWording
from rotemina.sim.records.fields import BLANKS, is_comment, split_fields, without_padding
from rotemina.sim.records.file_blocks import LineBlock
from rotemina.sim.records.layout import FileLayout

_LOG = logging.getLogger(__name__)
# Enough rows to show how the file writes numbers.
_TAIL_BYTES = 65_536
_DIGITS = re.compile(r"[^.,eE]*(?:[.,](?P<decimals>\d*))?(?:[eE][+-]?(?P<exponent>\d+))?")


class FileEnd:
    """The end of a file: it collects the last rows and checks the very last one.

    Parameters
    ----------
    name : name of the file in errors.
    layout : separator and columns.
    """

    def __init__(self, name: str, layout: FileLayout) -> None:
        self._name = name
        self._layout = layout
        self._tail = b""

    def add(self, block: LineBlock, *, is_our_format: bool) -> None:
        """Store the end of a block; at the end of the file, check the last row.

        A row that may have been cut off causes a warning.

        Raises
        ------
        RecordError
            If the last row of the file was cut off.
        """
        kept_bytes = _TAIL_BYTES - len(block.data)
        self._tail = (self._tail[-kept_bytes:] if kept_bytes > 0 else b"") + block.data[
            -_TAIL_BYTES:
        ]
        if block.unterminated:
            self._check_last_row(block.last_line, is_our_format=is_our_format)

    def _check_last_row(self, line: int, *, is_our_format: bool) -> None:
        rows = self._tail.decode("utf-8", "replace").replace("\r", "").split("\n")[:-1]
        if not rows or not _is_row(rows[-1]):
            return
        if is_our_format:
            raise RecordError(
                "{name}:{line}: the last line has no line end, but this program always writes "
                "one: the file was cut off here; copy it again, delete the line, or add a line "
                "break if the line is complete",
                name=self._name,
                line=line,
            )
        # The first of these rows may have lost its beginning, but its last number is complete.
        *numbers_above, last_number = map(self._find_last_number, filter(_is_row, rows))
        digits = set(map(_count_digits, numbers_above))
        is_padded = len(digits) == 1 and any(map(_has_padding, numbers_above))
        if is_padded and _count_digits(last_number) in digits:
            return
        if is_padded and _has_fewer(_count_digits(last_number), *digits):
            raise RecordError(
                "{name}:{line}: the last number {number} has fewer digits than all above it, "
                "and the line has no line end: the file was cut off here; copy it again, or "
                "delete the line",
                name=self._name,
                line=line,
                number=repr(last_number),
            )
        quoted = MessageWording().quote
        _LOG.warning(
            "%s:%d: the last line has no line end; if the file was cut off, its last number %s "
            "is incomplete: compare it with the original, or delete the line",
            quoted(self._name),
            line,
            quoted(last_number),
        )

    def _find_last_number(self, line: str) -> str:
        fields = split_fields(line, self._layout.separator)
        return without_padding(fields, len(self._layout.columns))[-1]


def _is_row(line: str) -> bool:
    return bool(line.strip(BLANKS)) and not is_comment(line)


def _count_digits(number: str) -> tuple[int, int]:
    """Return the number of decimals of a number and the number of digits of its exponent."""
    match = _DIGITS.match(number)
    assert match is not None
    return len(match["decimals"] or ""), len(match["exponent"] or "")


def _has_padding(number: str) -> bool:
    """Return whether the decimals of a number end in a zero."""
    match = _DIGITS.match(number)
    return match is not None and (match["decimals"] or "").endswith("0")


def _has_fewer(digits: tuple[int, int], expected: tuple[int, int]) -> bool:
    return digits[0] < expected[0] or digits[1] < expected[1]
