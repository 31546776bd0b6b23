"""Step functions: the equations of an effect, compiled and called by the plant.

A step function is plain Python on floats that numba can compile::

    def step(x, other, t, h, a, b, p, s):
        ...
        return y

``x`` is the input signal and ``y`` the output signal, SI. ``p`` holds the numbers that the
formulation's ``prepare`` computes from its parameters. ``s`` is the memory of the function: it
may change it, and it is zero at first. ``t`` is the time since the run began, s. The meaning of
``h``, ``other``, ``a`` and ``b`` depends on the place in the signal chain
(:mod:`rotemina.sim.effects.formulation`).

Memory outlives a change of parameters during a run. Values that are computed from ``p`` and cached
in ``s`` must therefore be computed again when ``p`` changes.

All step functions have the same machine signature and are called through their address. One
compiled plant therefore serves every robot and every effect, including those of third parties,
without being compiled again.
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

_NUMBER_ARGUMENT_COUNT = 6
_POINTER = types.CPointer(types.float64)  # type: ignore[no-untyped-call]
_SIGNATURE = types.float64(*([types.float64] * _NUMBER_ARGUMENT_COUNT), _POINTER, _POINTER)


@cache
def compile_step_address(step: StepFunction) -> int:
    """Compile a step function once, and return its address in memory.

    The compiled code is cached on disk. A division by zero gives infinity, as in numpy.
    """
    return int(_compile_step(step).address)


@cache
def _compile_step(step: StepFunction) -> Any:
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
    p_offset: Any,
    s: Any,
    s_offset: Any,
) -> Any:
    """Call the step function at ``address`` from compiled code.

    ``p`` and ``s`` are float64 arrays. The numbers of this function begin at ``p_offset`` and
    ``s_offset``.
    """
    signature = types.float64(
        types.int64, *([types.float64] * _NUMBER_ARGUMENT_COUNT), p, types.int64, s, types.int64
    )

    def generate(context: Any, builder: Any, _signature: Any, arguments: Any) -> Any:
        address_value, *numbers, p_array, p_start, s_array, s_start = arguments
        float_type = ir.DoubleType()
        pointer = float_type.as_pointer()
        function_type = ir.FunctionType(
            float_type, [float_type] * _NUMBER_ARGUMENT_COUNT + [pointer, pointer]
        )
        function = builder.inttoptr(address_value, function_type.as_pointer())
        pointers = [
            builder.gep(context.make_array(array_type)(context, builder, array).data, [start])
            for array_type, array, start in ((p, p_array, p_start), (s, s_array, s_start))
        ]
        return builder.call(function, [*numbers, *pointers])

    return signature, generate


#: Calls a step function from compiled code; see :func:`_call_step`.
call_step: Callable[..., float] = intrinsic(_call_step)
