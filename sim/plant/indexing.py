"""Access to an array in compiled code by an index that is never negative.

numba tests each signed index for a negative value, which takes as long as the arithmetic of a short
step itself.
"""

from collections.abc import Callable
from typing import Any

from numba import types
from numba.core.errors import TypingError
from numba.extending import intrinsic

from rotemina.sim.messages import message


def _item(typing_context: Any, array: Any, index: Any) -> Any:
    """Read the flat, contiguous ``array`` at ``index``, which must lie within it."""
    if array.layout != "C" or array.ndim != 1:
        raise TypingError(
            message("engine", "{array} is not a flat, contiguous array").fill(array=array)
        )
    signature = array.dtype(array, types.intp)

    def generate(context: Any, builder: Any, _signature: Any, arguments: Any) -> Any:
        values, offset = arguments
        data = context.make_array(array)(context, builder, values).data
        return builder.load(builder.gep(data, [offset]))

    return signature, generate


#: Reads an array from compiled code; see :func:`_item`.
item: Callable[..., Any] = intrinsic(_item)
