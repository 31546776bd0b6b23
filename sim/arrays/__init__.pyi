from .arrays import (
    BoolArray as BoolArray,
    ComplexArray as ComplexArray,
    FloatArray as FloatArray,
    IntArray as IntArray,
    decimate_to_envelope as decimate_to_envelope,
    make_read_only as make_read_only,
)
