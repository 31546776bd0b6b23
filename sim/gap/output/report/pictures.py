"""Drawings as SVG for a page, in the page's light or dark colours.

A drawing names its colours by role. They are written as placeholders that no drawing uses
otherwise, and become the page's own (``var(--real)``) in the tags of the SVG, never in its texts.
"""

import re
import warnings
from collections.abc import Callable
from enum import StrEnum
from html import escape
from io import BytesIO
from typing import Any

import matplotlib as mpl
from markupsafe import Markup
from matplotlib.axes import Axes
from matplotlib.figure import Figure

_MOST_LETTERS = 40  # of a name in a drawing


class Role(StrEnum):
    """Role of a colour."""

    INK = "#00a001"
    QUIET = "#00a002"
    GRID = "#00a003"
    REAL = "#00a004"
    RAW = "#00a005"
    CORRECTED = "#00a006"
    FLOOR = "#00a007"
    CEILING = "#00a008"
    THIRD = "#00a009"
    FOURTH = "#00a00a"


# The names that matplotlib's types allow differ from version to version.
_STYLE: dict[Any, Any] = {
    "svg.fonttype": "none",
    "svg.hashsalt": "rotemina",  # the same drawing gives the same text
    "text.parse_math": False,  # a dollar sign in a name is a dollar sign
    "font.family": "DejaVu Sans",
    "font.size": 9.0,
    "text.color": Role.INK,
    "axes.labelcolor": Role.INK,
    "axes.edgecolor": Role.QUIET,
    "axes.facecolor": "none",
    "axes.titlesize": 9.0,
    "axes.titlelocation": "left",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "figure.facecolor": "none",
    "grid.color": Role.GRID,
    "grid.linewidth": 0.6,
    "xtick.color": Role.QUIET,
    "ytick.color": Role.QUIET,
    "legend.frameon": False,
    "lines.linewidth": 1.0,
}
_NO_METADATA = dict.fromkeys(("Creator", "Date", "Format", "Type"))
_TAG = re.compile(r"<[^<>]*>")
_PROLOGUE = re.compile(r"\A.*?(?=<svg )", re.DOTALL)
_STYLE_SHEET = re.compile(r"<style[^<>]*>.*?</style>", re.DOTALL)
_OWN_ID = re.compile(r' id="([^"<>]*)"')
_REFERENCE = re.compile(r'(?:href="|url\()#([^")<>]+)')
_SPACES = re.compile(r'\s+xmlns(?::\w+)?="[^"]*"')
_SIZE = re.compile(r' (?:width|height|version)="[^"]*"')


def picture(width: float, height: float, draw: Callable[[Figure], None], about: str) -> Markup:
    """Return the drawing of ``draw`` as an ``<svg>`` element; sizes in inches, with 10 pt text.

    ``about`` describes the drawing in words.
    """
    file = BytesIO()
    with mpl.rc_context(_STYLE), warnings.catch_warnings():
        # The browser draws the texts, with fonts of its own.
        warnings.filterwarnings("ignore", message="Glyph .* missing from")
        figure = Figure(figsize=(width, height), layout="constrained")
        draw(figure)
        figure.savefig(file, format="svg", metadata=_NO_METADATA)
    return Markup(_inlined(file.getvalue().decode("utf-8"), about))  # noqa: S704 (escaped there)


def short(name: str) -> str:
    """Return a name that a drawing has room for, in one line."""
    plain = "".join(letter if letter.isprintable() else " " for letter in name)
    return plain if len(plain) <= _MOST_LETTERS else f"{plain[: _MOST_LETTERS - 1]}…"


def legend(figure: Figure, axes: Axes) -> None:
    """Name the curves of ``axes`` above the drawing."""
    handles, labels = axes.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper right", ncols=len(labels))


def _inlined(svg: str, about: str) -> str:
    svg = _STYLE_SHEET.sub("", _PROLOGUE.sub("", svg))
    used = set(_REFERENCE.findall(svg))
    svg = _TAG.sub(lambda tag: _plain_tag(tag[0], used), svg)
    return svg.replace("<svg ", f'<svg role="img" aria-label="{escape(about)}" ', 1).strip()


def _plain_tag(tag: str, used: set[str]) -> str:
    """Return a tag in the page's colours, without attributes that the page does not use."""
    tag = _OWN_ID.sub(lambda own: own[0] if own[1] in used else "", tag)
    tag = _SPACES.sub("", tag.replace("xlink:href=", "href="))
    if tag.startswith("<svg"):
        tag = _SIZE.sub("", tag)
    for role in Role:
        tag = tag.replace(role.value, f"var(--{role.name.lower()})")
    return tag
