"""The numbers of an inverse: one form that holds all kinds.

    command = Σ_r φ_r(z, E) (a_r0 + a_r1 z + Σ_j a_r,j+1 E_j),   E_j = z − P_j(z)

z is the desired position behind the stages before it (lag, creep, bend), P_j a play of radius r_j
and E_j its stop. A single rule (φ = 1) without plays is a straight line; with plays the inverse of
Prandtl and Ishlinskii; with a bend before them that of its modified form (Kuhnen, European Journal
of Control 9 (2003) 407–418); with several rules a Takagi–Sugeno system (IEEE Transactions on
Systems, Man, and Cybernetics 15 (1985) 116–132).
"""

from dataclasses import dataclass, field
from typing import Literal, Self

import numpy as np

from rotemina.sim.arrays import FloatArray

Kind = Literal["anfis", "modified_prandtl_ishlinskii", "prandtl_ishlinskii", "linear"]
KINDS: tuple[Kind, ...] = ("anfis", "modified_prandtl_ishlinskii", "prandtl_ishlinskii", "linear")


def _none() -> FloatArray:
    return np.zeros(0)


@dataclass(frozen=True, slots=True, eq=False)
class Premises:
    """Gaussian memberships on a grid: every combination of one of each input is a rule.

    Attributes
    ----------
    plays : tuple of int, length k
        What each input is: −1 the position z itself, j the stop E_j over its radius.
    centres, widths : (k, m)
        Of the memberships; those of the last input vary fastest among the rules.
    """

    plays: tuple[int, ...]
    centres: FloatArray
    widths: FloatArray

    @property
    def rules(self) -> int:
        """How many combinations there are; 1 without inputs."""
        return int(self.centres.shape[1] ** len(self.plays))

    @classmethod
    def single(cls) -> Self:
        """Return the premises of one rule that always holds."""
        return cls((), np.zeros((0, 1)), np.ones((0, 1)))


@dataclass(frozen=True, slots=True, eq=False)
class InverseModel:
    """An inverse of one axis: from the desired position to the command that brings it about.

    Inside, positions and commands are shares: ``z = (desired − origin) / span``, likewise the
    command with an origin of its own. A play begins in its ``initial`` state at z = 0, the low end.

    Attributes
    ----------
    axis, unit, kind : whose it is, "m" or "rad", and which form.
    sample_s : from sample to sample of what it was trained on, s.
    origin, command_origin, span : of the shares, SI.
    desired_range : lowest and highest position that it saw, SI; it is asked no further.
    command_range : of the machine, SI.
    speed : highest speed that it saw, SI per s.
    consequents : (rules, 2 + p)
        Constant, factor of z, factors of the stops.
    radii, initial : (p,)
        Of the plays and where they are at the low end, shares.
    premises : of the rules.
    lag_s : by which the axis comes late, half of ``sample_s`` for the held command in it.
    mode_s2 : 1/ω² of its resonance, s²; with ``lag = lag_s`` the position y is taken as
        ``y + lag ẏ + (lag²/2 + mode_s2) ÿ``.
    creep_times_s, creep_weights : (c,)
        Relaxations that are taken off: ``y − Σ v_i (z_i − y₀)``, ``τ_i ż_i = y − z_i``.
    bend_offset, bend_at, bend : scalar, (b,), (b + 1,)
        One-sided dead zones: ``offset + bend₀ z + Σ bend_i max(z − at_i, 0)``.
    """

    axis: str
    unit: str
    kind: Kind
    sample_s: float
    origin: float
    command_origin: float
    span: float
    desired_range: tuple[float, float]
    command_range: tuple[float, float]
    speed: float
    consequents: FloatArray
    radii: FloatArray = field(default_factory=_none)
    initial: FloatArray = field(default_factory=_none)
    premises: Premises = field(default_factory=Premises.single)
    lag_s: float = 0.0
    mode_s2: float = 0.0
    creep_times_s: FloatArray = field(default_factory=_none)
    creep_weights: FloatArray = field(default_factory=_none)
    bend_offset: float = 0.0
    bend_at: FloatArray = field(default_factory=_none)
    bend: FloatArray = field(default_factory=lambda: np.ones(1))

    def lag_at(self, sample_s: float) -> float:
        """Return the lag, s, where commands come ``sample_s`` apart: each is held that long."""
        return self.lag_s + 0.5 * (sample_s - self.sample_s)
