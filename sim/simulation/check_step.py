"""Checks of a step function by itself: its memory, and equal results compiled and in Python."""

import ctypes
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.effects import (
    EffectStage,
    ForceFunction,
    InputFunction,
    PositionFunction,
    ReadingFunction,
    compile_step_address,
)
from rotemina.sim.simulation.check_bench import SEED, EffectBench
from rotemina.sim.simulation.check_result import CheckResult, check_at_most, check_no_faults

_CALL_COUNT = 400
# Numbers before and after a memory that must stay unchanged.
_GUARD_COUNT = 64
_SENTINEL = 1.2345678e-77
# Largest relative difference; compiled functions may differ from those of Python in the last
# digits.
_MAX_DIFFERENCE_RATIO = 1e-7
# Rounding may make this share of calls fall on the other side of a jump.
_MAX_DIFFERING_SHARE = 0.01

_C_STEP = ctypes.CFUNCTYPE(
    ctypes.c_double,
    *[ctypes.c_double] * 6,
    ctypes.POINTER(ctypes.c_double),
    ctypes.POINTER(ctypes.c_double),
)


class _GuardedNumbers:
    """Numbers as plain Python sees them; only indices within their range are accepted."""

    def __init__(self, values: FloatArray, name: str) -> None:
        self._values = [np.float64(value) for value in values]
        self._name = name

    def __getitem__(self, index: int) -> np.float64:
        return self._values[self._check_index(index)]

    def __setitem__(self, index: int, value: float) -> None:
        if self._name == "p":
            raise IndexError("p is written to")
        self._values[self._check_index(index)] = np.float64(value)

    def _check_index(self, index: int) -> int:
        if not 0 <= index < len(self._values):
            raise IndexError(f"{self._name}[{index}] of {len(self._values)} numbers")
        return int(index)

    @property
    def numbers(self) -> FloatArray:
        return np.array(self._values, dtype=np.float64)


@dataclass(eq=False)
class _CompiledStep:
    """Compiled step function with its numbers, and with its memory between guards."""

    step: Any
    numbers: FloatArray
    states: int

    def __post_init__(self) -> None:
        self._call = _C_STEP(compile_step_address(self.step))
        self.guarded = np.full(self.states + 2 * _GUARD_COUNT, _SENTINEL)
        self.guarded[_GUARD_COUNT : _GUARD_COUNT + self.states] = 0.0
        self._p = np.concatenate([self.numbers, np.zeros(1)])

    @property
    def memory(self) -> FloatArray:
        """View of the memory."""
        return self.guarded[_GUARD_COUNT : _GUARD_COUNT + self.states]

    @property
    def overrun(self) -> int:
        """Number of values outside the memory that were changed."""
        return int(np.count_nonzero(self.guarded != _SENTINEL)) - int(
            np.count_nonzero(self.memory != _SENTINEL)
        )

    def __call__(self, values: FloatArray) -> float:
        pointer = ctypes.POINTER(ctypes.c_double)
        memory_address = self.guarded.ctypes.data + _GUARD_COUNT * self.guarded.itemsize
        result: float = self._call(
            *values.tolist(), self._p.ctypes.data_as(pointer), ctypes.cast(memory_address, pointer)
        )
        return result


def check_step(bench: EffectBench) -> Iterator[CheckResult]:
    """Check the step function of a formulation, if it has one."""
    acts = bench.formulation.acts
    if not isinstance(acts, InputFunction | ForceFunction | PositionFunction | ReadingFunction):
        return
    numbers = bench.formulation.compute_numbers(bench.presets, bench.facts)
    calls = _make_calls(bench)
    memory_faults = _find_memory_faults(acts.step, numbers, acts.states, calls)
    yield check_no_faults("stays within its memory", memory_faults)
    padded_arguments = np.append(numbers, np.zeros(_GUARD_COUNT)), acts.states + _GUARD_COUNT
    if memory_faults and _find_memory_faults(acts.step, *padded_arguments, calls):
        # Compiled, it would write even beyond the guards, and might crash the program.
        return
    compiled = _CompiledStep(acts.step, numbers, acts.states)
    differing_share, difference = _compare_with_python(compiled, calls)
    yield check_at_most(
        "gives the same in Python and compiled",
        differing_share,
        _MAX_DIFFERING_SHARE,
        f"they differ by {difference:.3g}",
    )
    yield check_at_most(
        "leaves other memory alone", float(compiled.overrun), 0.0, "it writes beyond s"
    )
    if isinstance(acts, InputFunction):
        yield _check_read_calls(acts, numbers, calls)


def _make_calls(bench: EffectBench) -> FloatArray:
    """Return arguments (n, 6) as a run would pass them: x, other, t, h, a, b."""
    rng = np.random.default_rng(SEED)
    facts, acts = bench.facts, bench.formulation.acts
    h = np.where(
        rng.random(_CALL_COUNT) < 0.1, 0.0, rng.uniform(0.2, 2.0, _CALL_COUNT) / bench.rate_hz
    )
    random_walk = np.cumsum(rng.standard_normal(_CALL_COUNT))
    relative_position = 0.5 + 0.45 * np.sin(0.3 * random_walk)
    x = facts.low + facts.span * relative_position
    is_voltage = isinstance(acts, InputFunction) and (
        facts.kind == "force" or bench.effect.stage is EffectStage.ELECTRONICS
    )
    if is_voltage:
        x = facts.input_low + facts.input_span * relative_position
    other, a, b = x.copy(), np.zeros(_CALL_COUNT), np.zeros(_CALL_COUNT)
    if isinstance(acts, InputFunction):
        other = facts.low + facts.span * relative_position
    if isinstance(acts, ReadingFunction) and acts.random:
        a = rng.standard_normal(_CALL_COUNT)
    if isinstance(acts, ForceFunction):
        h = np.maximum(h, 0.1 / bench.rate_hz)
        other = 0.1 * facts.span * facts.pace_hz * rng.standard_normal(_CALL_COUNT)
        a, b = 0.5 * h**2 / (facts.mass or 1.0), h / (facts.mass or 1.0)
    return np.stack([x, other, np.cumsum(h), h, a, b], axis=1)


def _find_memory_faults(
    step: Any, numbers: FloatArray, states: int, calls: FloatArray
) -> list[str]:
    p, s = _GuardedNumbers(numbers, "p"), _GuardedNumbers(np.zeros(states), "s")
    with np.errstate(all="ignore"):
        for row in calls:
            try:
                step(*row, p, s)
            except IndexError as error:
                return [str(error)]
            except ArithmeticError:
                return ["plain Python divides by zero"]
    return []


def _compare_with_python(compiled: _CompiledStep, calls: FloatArray) -> tuple[float, float]:
    """Return the share of calls with different results, and the largest relative difference."""
    differing_count, largest_difference = 0, 0.0
    for row in calls:
        s = _GuardedNumbers(np.concatenate([compiled.memory, np.zeros(_GUARD_COUNT)]), "s")
        p = _GuardedNumbers(np.concatenate([compiled.numbers, np.zeros(_GUARD_COUNT)]), "p")
        with np.errstate(all="ignore"):
            try:
                python_value = float(compiled.step(*row, p, s))
            except (ArithmeticError, IndexError):
                python_value = float("nan")
        compiled_value = compiled(row)
        expected = np.append(s.numbers[: compiled.states], python_value)
        actual = np.append(compiled.memory, compiled_value)
        scale = np.abs(actual) + 1e-6 * abs(compiled_value) + 1e-30
        difference = float(
            np.max(np.where(expected == actual, 0.0, np.abs(expected - actual) / scale))
        )
        if not difference <= _MAX_DIFFERENCE_RATIO:
            differing_count += 1
            largest_difference = (
                max(largest_difference, difference) if np.isfinite(difference) else float("inf")
            )
    return differing_count / len(calls), largest_difference


def _check_read_calls(acts: InputFunction, numbers: FloatArray, calls: FloatArray) -> CheckResult:
    """Check that a call with h = 0 before each step changes no later result."""
    without_reads, with_reads = (_CompiledStep(acts.step, numbers, acts.states) for _ in range(2))
    steps = calls[calls[:, 3] > 0.0]
    differences = []
    for row in steps:
        expected = without_reads(row)
        read_call = row.copy()
        read_call[3] = 0.0
        with_reads(read_call)
        differences.append(abs(with_reads(row) - expected))
    scale = float(np.ptp(steps[:, 0]))
    return check_at_most(
        "keeps its memory when read",
        max(differences) / scale,
        1e-9,
        "a call with h = 0 changes its memory",
    )
