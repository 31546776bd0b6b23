"""Tooltips of texts that may hold anything."""

from html import escape


def tip(*lines: str) -> str:
    """Return a tooltip whose lines are no markup, whatever they hold."""
    return f"<qt>{'<br>'.join(escape(line) for line in lines if line)}</qt>"
