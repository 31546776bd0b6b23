"""Step functions: the form of an effect's equations, compiled and called by the plant.

A step function is plain Python on floats that numba can compile::

    def step(x, other, t, h, a, b, p, s):
        ...
        return y

``x`` is the signal that enters and ``y`` the one that leaves, SI. ``p`` holds the numbers that the
formulation's ``prepare`` made of its parameters, ``s`` its memory, zeros at first, which it may
change. ``t`` is the time since the run began, s. What ``h``, ``other``, ``a`` and ``b`` are is
said by the place in the signal chain (:mod:`rotemina.sim.effects.formulation`).

Memory outlives a change of parameters in mid-run, so figures that are worked out once and kept in
``s`` must be worked out again for another ``p``.

All step functions have one machine signature and are called through their address. So one
compiled plant serves every robot and every effect, a third party's too, with no compilation again.
"""

from collections.abc import Callable, MutableSequence, Sequence
from functools import cache
from typing import Any

from llvmlite import ir  # type: ignore[import-untyped]
from numba import cfunc, types
from numba.extending import intrinsic

StepFunction = Callable[
    [float, float, float, float, float, float, Sequence[float], MutableSequence[float]], float
]

_NUMBERS = 6
_POINTER = types.CPointer(types.float64)  # type: ignore[no-untyped-call]
_SIGNATURE = types.float64(*([types.float64] * _NUMBERS), _POINTER, _POINTER)


@cache
def address_of(step: StepFunction) -> int:
    """Compile a step function, once, and return where it lies in memory.

    The compiled code is kept on disk. Divisions by zero give infinities, as numpy's do.
    """
    return int(_compiled(step).address)


@cache
def _compiled(step: StepFunction) -> Any:
    return cfunc(_SIGNATURE, cache=True, error_model="numpy")(step)


def _call_step(
    typing_context: Any,
    address: Any,
    x: Any,
    other: Any,
    t: Any,
    h: Any,
    a: Any,
    b: Any,
    p: Any,
    p_at: Any,
    s: Any,
    s_at: Any,
) -> Any:
    """Call the step function at ``address`` from compiled code.

    ``p`` and ``s`` are float64 arrays; the function's own numbers begin at ``p_at`` and ``s_at``.
    """
    signature = types.float64(
        types.int64, *([types.float64] * _NUMBERS), p, types.int64, s, types.int64
    )

    def generate(context: Any, builder: Any, _signature: Any, arguments: Any) -> Any:
        where, *numbers, p_array, p_first, s_array, s_first = arguments
        number = ir.DoubleType()
        pointer = number.as_pointer()
        form = ir.FunctionType(number, [number] * _NUMBERS + [pointer, pointer])
        function = builder.inttoptr(where, form.as_pointer())
        own = [
            builder.gep(context.make_array(kind)(context, builder, array).data, [first])
            for kind, array, first in ((p, p_array, p_first), (s, s_array, s_first))
        ]
        return builder.call(function, [*numbers, *own])

    return signature, generate


#: Calls a step function from compiled code; see :func:`_call_step`.
call_step: Callable[..., float] = intrinsic(_call_step)
