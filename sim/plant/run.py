"""What drives a plant over a run."""

from typing import NamedTuple

from rotemina.sim.arrays import FloatArray


class Run(NamedTuple):
    """Samples ``time_s`` (n,), and per axis (n, axes): set-points, added V, open-loop inputs."""

    time_s: FloatArray
    command: FloatArray
    add: FloatArray
    inputs: FloatArray
