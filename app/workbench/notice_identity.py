"""Identities of notices, to recognise repeats, and of requests, to match refusals to them."""

import re
from collections.abc import Callable, Hashable
from functools import partial

import numpy as np

from rotemina.app.language import FilledText
from rotemina.sim.messages import Message, NumberText

_NUMBER_PATTERN = re.compile(r"[+-]?\d+([.,:]\d+)*")


def make_repeat_key(text: str) -> Hashable:
    """Return what a text has in common with its repeats: everything except numbers and times.

    If the text has a template, the template is compared, because a quantity may change its unit.
    """
    match text:
        case Message():
            return text.template, *(_make_field_key(value) for _, value in text.fields)
        case FilledText():
            return text.template, *(_make_field_key(value) for value in text.fields)
    return _NUMBER_PATTERN.sub("0", text)


def _make_field_key(value: object) -> Hashable:
    if isinstance(value, NumberText | float | int | np.number | np.ndarray):
        return None
    return make_repeat_key(value if isinstance(value, str) else str(value))


def identify_request(request: Callable[[], object]) -> Hashable:
    """Return the identity that a request shares with its repeats: the code object that makes it."""
    while isinstance(request, partial):
        request = request.func
    function = getattr(request, "__func__", request)
    code = getattr(function, "__code__", None)
    return code if code is not None else getattr(function, "__qualname__", type(request))
