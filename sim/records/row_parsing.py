"""The rows of a record file: numbers, one time and one value per channel each.

Two parsers read them. :meth:`RowParser.parse_strictly` is plain Python, defines the format and
finds the line and column of an error. :meth:`RowParser.parse` does the same for whole blocks at
once with polars and hands any block that is not beyond doubt to the strict one.
"""

from math import inf, isfinite

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.messages import Message, joined, marked, message
from rotemina.sim.records.fields import (
    BLANKS,
    GROUPED_NUMBER,
    NUMBER,
    SPREADSHEET_ERROR,
    UNFINISHED_NUMBER,
    is_comment,
    split_fields,
    without_padding,
)
from rotemina.sim.records.file_blocks import LIMITS, Block
from rotemina.sim.records.layout import Layout, is_header_again
from rotemina.sim.records.record import RecordError

_SHOWN_END = 20  # characters of a line that was cut off


class RowParser:
    """Turns blocks of rows into SI numbers and checks them, in the order of the file.

    Parameters
    ----------
    name : the file's, for errors.
    layout : separator and columns.
    small_block_bytes : blocks up to this size are parsed strictly at once.
    """

    def __init__(
        self, name: str, layout: Layout, *, small_block_bytes: int = LIMITS.small_block_bytes
    ) -> None:
        self._name = name
        self._layout = layout
        self._per_si = layout.per_si
        self._small_block_bytes = small_block_bytes
        self._last_time_s = -inf
        self._decimal_sign = ""

    def parse(self, block: Block) -> FloatArray:
        """Return the (rows, columns) numbers of a block in SI, time first.

        Raises
        ------
        RecordError
            If a row is refused; the message names file, line and column.
        """
        rows = None
        if len(block.data) > self._small_block_bytes:
            rows = self._parse_fast(block)
        if rows is None:
            rows = self.parse_strictly(block)
        if len(rows):
            self._last_time_s = float(rows[-1, 0])
        return rows

    def _parse_fast(self, block: Block) -> FloatArray | None:
        """Return what the strict parser would, or None where it has to decide."""
        from rotemina.sim.records import fast_rows  # polars takes its time to import

        data, comments = fast_rows.without_comments(block.data)
        sign = fast_rows.decimal_sign(data, self._layout.separator)
        if sign is None or (sign and self._decimal_sign not in ("", sign)):
            return None
        lines = block.lines - comments
        rows = fast_rows.parse(data, lines, self._layout.separator, len(self._layout.columns))
        if rows is None:
            return None
        for index, divisor in enumerate(self._per_si):
            if divisor != 1.0:
                rows[:, index] /= divisor
        time_s = rows[:, 0]
        if len(rows) and (time_s[0] <= self._last_time_s or (time_s[1:] <= time_s[:-1]).any()):
            return None
        self._decimal_sign = self._decimal_sign or sign
        return rows

    def parse_strictly(self, block: Block) -> FloatArray:
        """Return the same as :meth:`parse`, row by row in plain Python; refuse as it does."""
        rows: list[list[float]] = []
        # A line of tabs is a row of missing values where tabs separate.
        blanks = " " if self._layout.separator == "\t" else BLANKS
        last_time_s = self._last_time_s
        for line, data in enumerate(block.data.split(b"\n")[:-1], start=block.first_line):
            text = decode_line(data, self._name, line)
            if not text.strip(blanks) or is_comment(text):
                continue
            try:
                row = self._parse_row(text, line)
            except RecordError:
                self._refuse_second_header(text, line)
                if block.unterminated and line == block.last_line:
                    self._refuse_cut_row(text, line)
                raise
            if row[0] <= last_time_s:
                raise self._error(
                    line,
                    0,
                    message(
                        "engine",
                        "time {time} s does not increase after {last} s; each row must be later "
                        "than the one before",
                    ).fill(time=repr(row[0]), last=repr(last_time_s)),
                )
            last_time_s = row[0]
            rows.append(row)
        return np.array(rows, dtype=np.float64).reshape(len(rows), len(self._per_si))

    def _refuse_second_header(self, text: str, line: int) -> None:
        if is_header_again(text, self._layout.separator):
            raise RecordError(
                message(
                    "engine",
                    "{name}:{line}: a second header; the file holds two logs: move the lines from "
                    "here on to a file of their own",
                ).fill(name=self._name, line=line)
            ) from None

    def _refuse_cut_row(self, text: str, line: int) -> None:
        fields = self._fields(text)
        is_short = len(fields) < len(self._per_si)
        is_open = text.count('"') % 2 == 1
        if is_short or is_open or UNFINISHED_NUMBER.fullmatch(fields[-1].replace(",", ".", 1)):
            raise RecordError(
                message(
                    "engine",
                    "{name}:{line}: the file ends inside this line, at {end}: it was cut off; copy "
                    "it again, or delete the line",
                ).fill(name=self._name, line=line, end=repr(text[-_SHOWN_END:]))
            ) from None

    def _fields(self, text: str) -> list[str]:
        return without_padding(split_fields(text, self._layout.separator), len(self._per_si))

    def _parse_row(self, text: str, line: int) -> list[float]:
        fields = self._fields(text)
        if len(fields) != len(self._per_si):
            raise self._length_error(line, fields)
        return [
            self._parse_number(field, line, index) / divisor
            for index, (field, divisor) in enumerate(zip(fields, self._per_si, strict=True))
        ]

    def _parse_number(self, field: str, line: int, index: int) -> float:
        self._check_decimal_sign(field, line, index)
        text = field.replace(",", ".", 1)
        if NUMBER.fullmatch(text) is None:
            raise self._error(line, index, _what_is_wrong(field))
        value = float(text)
        if not isfinite(value):
            raise self._error(
                line,
                index,
                message("engine", "value {value} exceeds what float64 holds").fill(
                    value=repr(field)
                ),
            )
        return value

    def _check_decimal_sign(self, field: str, line: int, index: int) -> None:
        # Where commas separate, a quoted "1,234" may be a thousand or a little more than one.
        in_doubt = self._layout.separator == "," and "," in field and not self._decimal_sign
        if in_doubt and GROUPED_NUMBER.fullmatch(field) is not None:
            raise self._error(line, index, _grouped(field))
        # Both in one file would let a thousands separator pass for a decimal sign: "1,234" next to
        # "0.5".
        for sign in ",.":
            if sign in field:
                self._decimal_sign = self._decimal_sign or sign
                if sign != self._decimal_sign:
                    raise self._error(
                        line,
                        index,
                        message(
                            "engine",
                            "value {value} has {sign} where the numbers before have {before}; use "
                            "one decimal sign and no thousands separators",
                        ).fill(value=repr(field), sign=repr(sign), before=repr(self._decimal_sign)),
                    )

    def _length_error(self, line: int, fields: list[str]) -> RecordError:
        wanted = len(self._per_si)
        separator = {"\t": marked("engine", "tabs"), " ": marked("engine", "blanks")}.get(
            self._layout.separator, repr(self._layout.separator)
        )
        advice = [
            message("engine", "separate {count} columns by {separator}").fill(
                count=wanted, separator=separator
            )
        ]
        if self._layout.separator == "," and wanted < len(fields) <= 2 * wanted:
            advice.append(
                message("engine", "if the commas are decimal signs, separate columns by ';'")
            )
        return self._error(
            line,
            min(len(fields), wanted),
            message(
                "engine", "the row has {count} fields where the header names {wanted}; {advice}"
            ).fill(count=len(fields), wanted=wanted, advice=joined(advice, "; ")),
        )

    def _error(self, line: int, index: int, what: str) -> RecordError:
        names = self._layout.names
        column = names[index] if index < len(names) else str(index + 1)
        return RecordError(
            message("engine", "{name}:{line}:{column}: {what}").fill(
                name=self._name, line=line, column=column, what=what
            )
        )


def decode_line(data: bytes, name: str, line: int) -> str:
    """Return one line as text, without its line end.

    Raises
    ------
    RecordError
        If it is not UTF-8, or if a carriage return stands inside of it.
    """
    try:
        text = data.decode("utf-8")
    except UnicodeDecodeError as error:
        raise RecordError(
            message(
                "engine", "{name}:{line}:byte {start}: {data} is not UTF-8; save the file as UTF-8"
            ).fill(
                name=name,
                line=line,
                start=error.start + 1,
                data=repr(data[error.start : error.start + 1]),
            )
        ) from error
    text = text.removesuffix("\r")
    if "\r" in text:
        raise RecordError(
            message(
                "engine",
                "{name}:{line}: a carriage return is inside the line; end lines with LF or CRLF",
            ).fill(name=name, line=line)
        )
    return text


def _what_is_wrong(field: str) -> str:
    if not field:
        return marked(
            "engine",
            "the value is missing; a sensor dropout is a finite wrong value, never an empty field",
        )
    if field.lower().lstrip("+-") in ("nan", "inf", "infinity"):
        return message("engine", "value {value} is not finite; write a finite number").fill(
            value=repr(field)
        )
    if SPREADSHEET_ERROR.fullmatch(field) is not None:
        return message(
            "engine",
            "value {value} is a spreadsheet's mark of a missing value or an error; write a number, "
            "or delete the row",
        ).fill(value=repr(field))
    if GROUPED_NUMBER.fullmatch(field) is not None:
        return _grouped(field)
    if '"' in field:
        return message(
            "engine",
            "value {value} has a quote without its partner on this line; remove it",
        ).fill(value=repr(field))
    return message(
        "engine", "value {value} is not a plain decimal number; write it like -12.5 or 3e-6"
    ).fill(value=repr(field))


def _grouped(field: str) -> Message:
    return message(
        "engine", "value {value} has a thousands separator; write its digits without any"
    ).fill(value=repr(field))
