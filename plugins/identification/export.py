"""Findings as text for the clipboard and as a CSV file."""

import csv
import io

from rotemina.plugins.identification.findings import Findings


def as_text(findings: Findings, view: str) -> str:
    """Return the sheet of figures as aligned text, with what was asked and all notices."""
    rows = [findings.head, *findings.rows] if findings.rows else []
    widths = [max(len(row[column]) for row in rows) for column in range(len(findings.head))]
    lines = [
        "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
        for row in rows
    ]
    asked = [f"{name}: {value}" for name, value in _asked(findings, view)]
    notices = [f"notice: {text}" for text in findings.notices]
    return "\n".join([*asked, *lines, *notices]) + "\n"


def as_csv(findings: Findings, view: str) -> str:
    """Return ``# key: value`` lines (what was asked, figures, notices) and a table of numbers."""
    file = io.StringIO()
    for name, value in _asked(findings, view):
        file.write(f"# {name}: {value}\n")
    for name, *values in findings.rows:
        file.write(f"# {name}: {'; '.join(value for value in values if value)}\n")
    for text in findings.notices:
        file.write(f"# notice: {_one_line(text)}\n")
    writer = csv.writer(file, lineterminator="\n")
    if findings.columns:
        writer.writerow([column.heading for column in findings.columns])
        table = zip(*(column.values for column in findings.columns), strict=True)
        writer.writerows(["" if v is None else repr(v) for v in row] for row in table)
    return file.getvalue()


def _asked(findings: Findings, view: str) -> list[tuple[str, str]]:
    question = findings.question
    pair = f"{question.axis}.{question.drive} to {question.axis}.{question.answer}"
    return [("identification", view), ("record", _one_line(question.name)), ("pair", pair)]


def _one_line(text: str) -> str:
    return " ".join(text.split())
