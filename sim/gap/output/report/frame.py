"""The frame of a report: one page that holds everything, and asks for no network and no script.

Every text that comes from a file or a third party is escaped where it is put in (by the template,
and by the drawings for their own texts); the page's policy forbids scripts and outside resources.
"""

from collections.abc import Callable
from importlib import resources

from jinja2 import Environment, FunctionLoader, StrictUndefined
from markupsafe import Markup

from rotemina.sim.gap.output.report.words import shown
from rotemina.sim.quantities import Number, amount, amounts, percent, percents, rounded


def environment(said: Callable[..., str]) -> Environment:
    """Return what renders templates that extend ``frame.html`` and fill its title and body.

    ``said(template, **fields)`` is what the filter ``t`` does with a text: it tells it in the
    language of :func:`rotemina.sim.gap.output.report.words.worded`.
    """
    made = Environment(
        loader=FunctionLoader(_resource),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    made.globals["style"] = Markup(_resource("page.css"))  # noqa: S704 (the program's own)
    made.filters.update(
        t=said,
        shown=shown,
        amount=_shown(amount),
        amounts=_shown(amounts),
        percent=_shown(percent),
        percents=_shown(percents),
        rounded=_shown(rounded),
    )
    return made


def _shown(number: Callable[..., Number]) -> Callable[..., str]:
    """Return what writes a number in the page's language."""
    return lambda *value: shown(number(*value))


def _resource(name: str) -> str:
    return resources.files("rotemina.sim.gap.output.report").joinpath(name).read_text("utf-8")
