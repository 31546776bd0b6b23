"""The parameters of an inverse, in one form for all kinds.

    command = Σ_r φ_r(z, E) (a_r0 + a_r1 z + Σ_j a_r,j+1 E_j),   E_j = z − P_j(z)

Here z is the desired position after the stages for lag, creep and bend, P_j a play of radius r_j,
and E_j its stop. A single rule (φ = 1) without plays is a straight line. With plays it is the
inverse of Prandtl and Ishlinskii, and with a bend before them the inverse of its modified form
(Kuhnen, European Journal of Control 9 (2003) 407–418). With several rules it is a Takagi–Sugeno
system (IEEE Transactions on Systems, Man, and Cybernetics 15 (1985) 116–132).
"""

from dataclasses import dataclass, field
from typing import Literal, Self

import numpy as np

from rotemina.sim.arrays import FloatArray

InverseKind = Literal["anfis", "modified_prandtl_ishlinskii", "prandtl_ishlinskii", "linear"]
INVERSE_KINDS: tuple[InverseKind, ...] = (
    "anfis",
    "modified_prandtl_ishlinskii",
    "prandtl_ishlinskii",
    "linear",
)


def _make_empty() -> FloatArray:
    return np.zeros(0)


@dataclass(frozen=True, slots=True, eq=False)
class RulePremises:
    """Gaussian memberships on a grid; each combination of one membership per input is a rule.

    Attributes
    ----------
    plays : tuple of int, length k
        Kind of each input: −1 is the position z, and j is the stop E_j divided by its radius.
    centres, widths : (k, m)
        Centres and widths of the memberships. The last input varies fastest in the order of the
        rules.
    """

    plays: tuple[int, ...]
    centres: FloatArray
    widths: FloatArray

    @property
    def rule_count(self) -> int:
        """Number of combinations, 1 without inputs."""
        return int(self.centres.shape[1] ** len(self.plays))

    @classmethod
    def of_single_rule(cls) -> Self:
        """Return the premises of one rule that always holds."""
        return cls((), np.zeros((0, 1)), np.ones((0, 1)))


@dataclass(frozen=True, slots=True, eq=False)
class InverseModel:
    """An inverse of one axis, from the desired position to the command that produces it.

    Internally, positions and commands are shares of a span: ``z = (desired − origin) / span`` and
    ``(command − command_origin) / span``. A play begins in its ``initial`` state at z = 0, the low
    end.

    Attributes
    ----------
    axis, unit, kind : the axis, "m" or "rad", and the kind of inverse.
    sample_s : interval of the training samples, s.
    origin, command_origin, span : zeros and unit of these shares, SI.
    desired_range : lowest and highest position of the training, SI. Requests outside are clamped.
    command_range : lowest and highest command of the machine, SI.
    speed : highest speed of the training, SI per s.
    consequents : (rules, 2 + p)
        Constant, factor of z, factors of the stops.
    radii, initial : (p,)
        Radii of the plays, and their states at the low end, shares.
    premises : premises of the rules.
    lag_s : lag of the axis, including half of ``sample_s`` for the held command.
    mode_s2 : 1/ω² of its resonance, s²; with ``lag = lag_s`` the position y is replaced by
        ``y + lag ẏ + (lag²/2 + mode_s2) ÿ``.
    creep_times_s, creep_weights : (c,)
        Relaxations that are subtracted: ``y − Σ v_i (z_i − y₀)``, ``τ_i ż_i = y − z_i``.
    bend_offset, bend_at, bend : scalar, (b,), (b + 1,)
        One-sided dead zones: ``offset + bend₀ z + Σ bend_i max(z − at_i, 0)``.
    """

    axis: str
    unit: str
    kind: InverseKind
    sample_s: float
    origin: float
    command_origin: float
    span: float
    desired_range: tuple[float, float]
    command_range: tuple[float, float]
    speed: float
    consequents: FloatArray
    radii: FloatArray = field(default_factory=_make_empty)
    initial: FloatArray = field(default_factory=_make_empty)
    premises: RulePremises = field(default_factory=RulePremises.of_single_rule)
    lag_s: float = 0.0
    mode_s2: float = 0.0
    creep_times_s: FloatArray = field(default_factory=_make_empty)
    creep_weights: FloatArray = field(default_factory=_make_empty)
    bend_offset: float = 0.0
    bend_at: FloatArray = field(default_factory=_make_empty)
    bend: FloatArray = field(default_factory=lambda: np.ones(1))

    def lag_at(self, sample_s: float) -> float:
        """Return the lag, s, for commands that are held for ``sample_s`` each."""
        return self.lag_s + 0.5 * (sample_s - self.sample_s)
