"""Drawings as SVG for a page, in the light or dark colours of the page.

A drawing refers to its colours by role. Matplotlib gets placeholder colours that no drawing uses
otherwise. In the tags of the SVG, but never in its texts, variables of the page replace them
(``var(--real)``).
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

_MAX_NAME_LENGTH = 40


class ColourRole(StrEnum):
    """The role of a colour; the value is its placeholder."""

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
    # The salt is fixed, so that the same drawing gives the same text.
    "svg.hashsalt": "rotemina",
    # A dollar sign in a name does not begin a formula.
    "text.parse_math": False,
    "font.family": "DejaVu Sans",
    "font.size": 9.0,
    "text.color": ColourRole.INK,
    "axes.labelcolor": ColourRole.INK,
    "axes.edgecolor": ColourRole.QUIET,
    "axes.facecolor": "none",
    "axes.titlesize": 9.0,
    "axes.titlelocation": "left",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "figure.facecolor": "none",
    "grid.color": ColourRole.GRID,
    "grid.linewidth": 0.6,
    "xtick.color": ColourRole.QUIET,
    "ytick.color": ColourRole.QUIET,
    "legend.frameon": False,
    "lines.linewidth": 1.0,
}
_NO_METADATA = dict.fromkeys(("Creator", "Date", "Format", "Type"))
_TAG = re.compile(r"<[^<>]*>")
_PROLOGUE = re.compile(r"\A.*?(?=<svg )", re.DOTALL)
_STYLE_SHEET = re.compile(r"<style[^<>]*>.*?</style>", re.DOTALL)
_ID_ATTRIBUTE = re.compile(r' id="([^"<>]*)"')
_REFERENCE = re.compile(r'(?:href="|url\()#([^")<>]+)')
_NAMESPACE_ATTRIBUTE = re.compile(r'\s+xmlns(?::\w+)?="[^"]*"')
_SIZE_ATTRIBUTE = re.compile(r' (?:width|height|version)="[^"]*"')


def draw_picture(width: float, height: float, draw: Callable[[Figure], None], about: str) -> Markup:
    """Return a drawing as an ``<svg>`` element.

    Parameters
    ----------
    width, height : float
        Size in inches.
    draw : callable
        Function that draws into a figure.
    about : str
        Description of the drawing for screen readers.
    """
    file = BytesIO()
    with mpl.rc_context(_STYLE), warnings.catch_warnings():
        # The browser uses other fonts for the texts, so missing glyphs do not matter.
        warnings.filterwarnings("ignore", message="Glyph .* missing from")
        figure = Figure(figsize=(width, height), layout="constrained")
        draw(figure)
        figure.savefig(file, format="svg", metadata=_NO_METADATA)
    return Markup(_make_inline(file.getvalue().decode("utf-8"), about))  # noqa: S704 (escaped there)


def shorten_name(name: str) -> str:
    """Return a name, shortened so that it fits into a drawing."""
    printable = "".join(character if character.isprintable() else " " for character in name)
    return (
        printable if len(printable) <= _MAX_NAME_LENGTH else f"{printable[: _MAX_NAME_LENGTH - 1]}…"
    )


def add_legend(figure: Figure, axes: Axes) -> None:
    """Add a legend of the curves of ``axes`` above the drawing."""
    handles, labels = axes.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper right", ncols=len(labels))


def _make_inline(svg: str, about: str) -> str:
    svg = _STYLE_SHEET.sub("", _PROLOGUE.sub("", svg))
    used_ids = set(_REFERENCE.findall(svg))
    svg = _TAG.sub(lambda tag: _clean_tag(tag[0], used_ids), svg)
    return svg.replace("<svg ", f'<svg role="img" aria-label="{escape(about)}" ', 1).strip()


def _clean_tag(tag: str, used_ids: set[str]) -> str:
    tag = _ID_ATTRIBUTE.sub(lambda match: match[0] if match[1] in used_ids else "", tag)
    tag = _NAMESPACE_ATTRIBUTE.sub("", tag.replace("xlink:href=", "href="))
    if tag.startswith("<svg"):
        tag = _SIZE_ATTRIBUTE.sub("", tag)
    for role in ColourRole:
        tag = tag.replace(role.value, f"var(--{role.name.lower()})")
    return tag
