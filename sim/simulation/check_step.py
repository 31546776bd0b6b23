"""Checks of a step function by itself: its memory, and that compiled code does as Python does."""

import ctypes
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.effects.formulation import Drive, Force, Motion, Reading, Stage
from rotemina.sim.effects.step import address_of
from rotemina.sim.simulation.check_bench import SEED, Bench
from rotemina.sim.simulation.check_result import Check, measured, stated

_CALLS = 400
_GUARD = 64  # numbers before and behind a memory that must stay as they are
_SENTINEL = 1.2345678e-77
_ALIKE = 1e-7  # relative; compiled mathematics may differ from Python's in the last digits
_EDGES = 0.01  # share of calls that may fall on the other side of a jump by rounding

_C_STEP = ctypes.CFUNCTYPE(
    ctypes.c_double,
    *[ctypes.c_double] * 6,
    ctypes.POINTER(ctypes.c_double),
    ctypes.POINTER(ctypes.c_double),
)


class _Guarded:
    """Numbers that may be reached by their own indices alone, as plain Python sees them."""

    def __init__(self, values: FloatArray, what: str) -> None:
        self._values = [np.float64(value) for value in values]
        self._what = what

    def __getitem__(self, index: int) -> np.float64:
        return self._values[self._checked(index)]

    def __setitem__(self, index: int, value: float) -> None:
        if self._what == "p":
            raise IndexError("p is written to")
        self._values[self._checked(index)] = np.float64(value)

    def _checked(self, index: int) -> int:
        if not 0 <= index < len(self._values):
            raise IndexError(f"{self._what}[{index}] of {len(self._values)} numbers")
        return int(index)

    @property
    def numbers(self) -> FloatArray:
        return np.array(self._values, dtype=np.float64)


@dataclass(eq=False)
class _Compiled:
    """A step function with its numbers, and its memory between guards."""

    step: Any
    numbers: FloatArray
    states: int

    def __post_init__(self) -> None:
        self._call = _C_STEP(address_of(self.step))
        self.whole = np.full(self.states + 2 * _GUARD, _SENTINEL)
        self.whole[_GUARD : _GUARD + self.states] = 0.0
        self._p = np.concatenate([self.numbers, np.zeros(1)])

    @property
    def memory(self) -> FloatArray:
        """A view of the memory."""
        return self.whole[_GUARD : _GUARD + self.states]

    @property
    def overrun(self) -> int:
        """How many numbers beside the memory were written to."""
        return int(np.count_nonzero(self.whole != _SENTINEL)) - int(
            np.count_nonzero(self.memory != _SENTINEL)
        )

    def __call__(self, values: FloatArray) -> float:
        pointer = ctypes.POINTER(ctypes.c_double)
        at = self.whole.ctypes.data + _GUARD * self.whole.itemsize
        answer: float = self._call(
            *values.tolist(), self._p.ctypes.data_as(pointer), ctypes.cast(at, pointer)
        )
        return answer


def check_step(bench: Bench) -> Iterator[Check]:
    """Check the step function of a formulation, if it has one."""
    acts = bench.formulation.acts
    if not isinstance(acts, Drive | Force | Motion | Reading):
        return
    numbers = bench.formulation.numbers(bench.presets, bench.facts)
    calls = _calls(bench)
    beyond = _reached_beyond(acts.step, numbers, acts.states, calls)
    yield stated("stays within its memory", beyond)
    guarded = np.append(numbers, np.zeros(_GUARD)), acts.states + _GUARD
    if beyond and _reached_beyond(acts.step, *guarded, calls):
        return  # compiled, it would write behind the guards too, and might end the program
    compiled = _Compiled(acts.step, numbers, acts.states)
    differ, gap = _against_python(compiled, calls)
    yield measured("does in Python as compiled", differ, _EDGES, f"they differ by {gap:.3g}")
    yield measured("leaves other memory alone", float(compiled.overrun), 0.0, "it writes beyond s")
    if isinstance(acts, Drive):
        yield _check_reads(acts, numbers, calls)


def _calls(bench: Bench) -> FloatArray:
    """Return arguments (n, 6) such as a run would bring: x, other, t, h, a, b."""
    rng = np.random.default_rng(SEED)
    facts, acts = bench.facts, bench.formulation.acts
    h = np.where(rng.random(_CALLS) < 0.1, 0.0, rng.uniform(0.2, 2.0, _CALLS) / bench.rate_hz)
    way = np.cumsum(rng.standard_normal(_CALLS))
    share = 0.5 + 0.45 * np.sin(0.3 * way)
    x = facts.low + facts.span * share
    volts = isinstance(acts, Drive) and (
        facts.kind == "force" or bench.effect.stage is Stage.ELECTRONICS
    )
    if volts:
        x = facts.input_low + facts.input_span * share
    other, a, b = x.copy(), np.zeros(_CALLS), np.zeros(_CALLS)
    if isinstance(acts, Drive):
        other = facts.low + facts.span * share
    if isinstance(acts, Reading) and acts.random:
        a = rng.standard_normal(_CALLS)
    if isinstance(acts, Force):
        h = np.maximum(h, 0.1 / bench.rate_hz)
        other = 0.1 * facts.span * facts.pace_hz * rng.standard_normal(_CALLS)
        a, b = 0.5 * h**2 / (facts.mass or 1.0), h / (facts.mass or 1.0)
    return np.stack([x, other, np.cumsum(h), h, a, b], axis=1)


def _reached_beyond(step: Any, numbers: FloatArray, states: int, calls: FloatArray) -> list[str]:
    p, s = _Guarded(numbers, "p"), _Guarded(np.zeros(states), "s")
    with np.errstate(all="ignore"):
        for row in calls:
            try:
                step(*row, p, s)
            except IndexError as error:
                return [str(error)]
            except ArithmeticError:
                return ["plain Python divides by zero"]
    return []


def _against_python(compiled: _Compiled, calls: FloatArray) -> tuple[float, float]:
    """Return the share of calls in which the two differ, and by how much at most, relative."""
    differ, worst = 0, 0.0
    for row in calls:
        s = _Guarded(np.concatenate([compiled.memory, np.zeros(_GUARD)]), "s")
        p = _Guarded(np.concatenate([compiled.numbers, np.zeros(_GUARD)]), "p")
        with np.errstate(all="ignore"):
            try:
                plain = float(compiled.step(*row, p, s))
            except (ArithmeticError, IndexError):
                plain = float("nan")
        fast = compiled(row)
        mine = np.append(s.numbers[: compiled.states], plain)
        theirs = np.append(compiled.memory, fast)
        scale = np.abs(theirs) + 1e-6 * abs(fast) + 1e-30
        gap = float(np.max(np.where(mine == theirs, 0.0, np.abs(mine - theirs) / scale)))
        if not gap <= _ALIKE:
            differ += 1
            worst = max(worst, gap) if np.isfinite(gap) else float("inf")
    return differ / len(calls), worst


def _check_reads(acts: Drive, numbers: FloatArray, calls: FloatArray) -> Check:
    """Check that asking with h = 0 before each step changes nothing that follows."""
    plain, asked = (_Compiled(acts.step, numbers, acts.states) for _ in range(2))
    moving = calls[calls[:, 3] > 0.0]
    gaps = []
    for row in moving:
        expected = plain(row)
        still = row.copy()
        still[3] = 0.0
        asked(still)
        gaps.append(abs(asked(row) - expected))
    scale = float(np.ptp(moving[:, 0]))
    return measured(
        "reads without forgetting", max(gaps) / scale, 1e-9, "a call with h = 0 moves its memory"
    )
