"""Which notices repeat each other, and which request a refusal is about."""

import re
from collections.abc import Callable, Hashable
from functools import partial

import numpy as np

from rotemina.app.shell.language import FilledText
from rotemina.sim.messages import Message
from rotemina.sim.quantities import Number

_FIGURES = re.compile(r"[+-]?\d+([.,:]\d+)*")


def repeat_key(text: str) -> Hashable:
    """Return what a text has in common with its repeats: all but its numbers and times.

    A text that knows its template is compared by that, for a quantity may change its unit.
    """
    match text:
        case Message():
            return text.template, *(_field_key(value) for _, value in text.fields)
        case FilledText():
            return text.template, *(_field_key(value) for value in text.fields)
    return _FIGURES.sub("0", text)


def _field_key(value: object) -> Hashable:
    if isinstance(value, Number | float | int | np.number | np.ndarray):
        return None
    return repeat_key(value if isinstance(value, str) else str(value))


def request_subject(request: Callable[[], object]) -> Hashable:
    """Return what a request is known by when it is made again: the code that makes it."""
    while isinstance(request, partial):
        request = request.func
    function = getattr(request, "__func__", request)
    code = getattr(function, "__code__", None)
    return code if code is not None else getattr(function, "__qualname__", type(request))
