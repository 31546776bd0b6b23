"""The fields of one line of a record file, as any program may write them.

A line separates its fields by one sign. A field may stand in double quotes, with each quote inside
doubled, and may have blanks around it; a spreadsheet fills short lines with empty fields.
"""

import re

# In the order in which they are looked for: a comma may also be a decimal sign, a blank a filler.
SEPARATORS = (";", "\t", ",", " ")
BLANKS = " \t"
# The blanks of other alphabets and of typeset numbers, which look like a blank.
PADDING = BLANKS + "\u00a0\u2007\u2009\u202f"
_AS_BLANKS = str.maketrans(dict.fromkeys(PADDING[len(BLANKS) :], " "))

# ASCII digits with one sign, one point, one exponent: no "1_000", no "0x10", no "nan".
NUMBER = re.compile(r"[+-]?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][+-]?\d+)?", re.ASCII)
# The beginning of a number that cannot be its end.
UNFINISHED_NUMBER = re.compile(r"[+-]?\.?|[+-]?(?:\d+\.?\d*|\.\d+)[eE][+-]?", re.ASCII)
# Digits in groups of three: "1,234", "1.234.567", "12 345,6", "1'234".
GROUPED_NUMBER = re.compile(
    rf"[+-]?[1-9]\d{{0,2}}(?:[,.'’{PADDING}]\d{{3}})+(?:[.,]\d+)?", re.ASCII
)
# What spreadsheets write where a value is missing or cannot be calculated: "#N/A", "#DIV/0!".
SPREADSHEET_ERROR = re.compile(r"#(?:N/?[AV]|[^\W\d_]+(?:/0)?[!?])", re.IGNORECASE)
_ERROR_AS_FIRST_FIELD = re.compile(
    rf'"?{SPREADSHEET_ERROR.pattern}"?[ \t]*+(?:[;,\t]|(?<=[ \t])[-+.\d])', re.IGNORECASE
)
NOT_FINITE = re.compile(r"[+-]?(?:nan|inf|infinity)", re.IGNORECASE)

# A spreadsheet quotes a whole comment that holds a separator. No heading or number begins so.
COMMENT_MARKS = ("#", "%", "//", '"#')
COMMENT_BEGIN = rb'[ \t]*(?:"?#|%|//)'
_QUOTED_BEGIN = re.compile(r'"((?:[^"]|"")*+)"')
_SEPARATOR_LINE = re.compile(r'"?sep=(?P<sign>[^"])"?[;,]*', re.IGNORECASE)


def _field_pattern(separator: str) -> re.Pattern[str]:
    padding = PADDING.replace(separator, "")
    inside, end = (BLANKS, f"[{BLANKS}]+") if separator == " " else (separator, separator)
    return re.compile(
        rf'[{padding}]*+(?:"(?P<quoted>(?:[^"]|"")*+)"|(?P<plain>[^"{inside}]*+))[{padding}]*+'
        rf"(?P<end>{end}|\Z)"
    )


_FIELDS = {separator: _field_pattern(separator) for separator in SEPARATORS}


def with_plain_blanks(text: str) -> str:
    """Return a text with blanks in place of no-break and narrow ones."""
    return text if text.isascii() else text.translate(_AS_BLANKS)


def without_quotes(text: str) -> str:
    """Return what quotes at the beginning of a text enclose; a text without them as it is."""
    match = _QUOTED_BEGIN.match(text)
    return match[1].replace('""', '"') if match else text


def is_comment(line: str) -> bool:
    """Return whether a line is a comment of this or another program."""
    return line.lstrip(BLANKS).startswith(COMMENT_MARKS)


def is_row_with_error(line: str) -> bool:
    """Return whether a line that begins like a comment is a row whose time could not be written."""
    return _ERROR_AS_FIRST_FIELD.match(line.lstrip(BLANKS)) is not None


def is_empty(line: str) -> bool:
    """Return whether a line holds nothing; a spreadsheet writes separators alone for such a one."""
    return not line.strip(PADDING + ';,"')


def named_separator(line: str) -> str | None:
    """Return the separator that a line such as ``sep=;`` names, or None for any other line."""
    match = _SEPARATOR_LINE.fullmatch(line.strip("\r\n"))
    return match["sign"] if match else None


def split_fields(line: str, separator: str) -> list[str]:
    """Split one line into fields without quotes and without the blanks around them.

    A line whose quotes do not pair is split as if they were letters.
    """
    if '"' in line:
        fields = _split_quoted(line, separator)
        if fields is not None:
            return fields
    if separator == " ":
        return [field.strip(PADDING) for field in re.split(r"[ \t]+", line.strip(BLANKS))]
    return [field.strip(PADDING) for field in line.split(separator)]


def _split_quoted(line: str, separator: str) -> list[str] | None:
    """Return the fields, or None where a quote does not begin or end one."""
    fields, position = [], 0
    if separator == " ":
        line = line.strip(BLANKS)
    while match := _FIELDS[separator].match(line, position):
        quoted = match["quoted"]
        field = match["plain"] if quoted is None else quoted.replace('""', '"')
        fields.append(field.strip(PADDING))
        if not match["end"]:
            return fields
        position = match.end()
    return None


def without_padding(fields: list[str], count: int) -> list[str]:
    """Return fields without the empty ones behind the first ``count``.

    A separator at the end of a line makes one, a spreadsheet as many as its widest line has.
    """
    end = len(fields)
    while end > count and not fields[end - 1]:
        end -= 1
    return fields[:end]
