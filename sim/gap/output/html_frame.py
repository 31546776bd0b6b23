"""The frame of a report: a single page without scripts and without network resources.

Every text from a file or a third party is escaped where it is inserted, by the template or by the
drawings. The security policy of the page forbids scripts and outside resources.
"""

from collections.abc import Callable
from importlib import resources

from jinja2 import Environment, FunctionLoader, StrictUndefined
from markupsafe import Markup

from rotemina.sim.gap.output.report_words import localize
from rotemina.sim.messages import NumberText, format_rounded
from rotemina.sim.units import (
    format_interval,
    format_percent,
    format_percent_interval,
    format_quantity,
)


def make_environment(localize_text: Callable[..., str]) -> Environment:
    """Return an environment for templates that extend ``frame.html``.

    ``localize_text(template, **fields)`` becomes the filter ``t``, which translates a text into the
    language set by :func:`rotemina.sim.gap.output.use_wording`.
    """
    environment = Environment(
        loader=FunctionLoader(_read_resource),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    environment.globals["style"] = Markup(_read_resource("page.css"))  # noqa: S704 (the program's own)
    environment.filters.update(
        t=localize_text,
        shown=localize,
        amount=_make_number_filter(format_quantity),
        amounts=_make_number_filter(format_interval),
        percent=_make_number_filter(format_percent),
        percents=_make_number_filter(format_percent_interval),
        rounded=_make_number_filter(format_rounded),
    )
    return environment


def _make_number_filter(format_number: Callable[..., NumberText]) -> Callable[..., str]:
    return lambda *values: localize(format_number(*values))


def _read_resource(name: str) -> str:
    return resources.files("rotemina.sim.gap.output").joinpath(name).read_text("utf-8")
