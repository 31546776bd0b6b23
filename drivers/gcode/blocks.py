"""The queue of straight blocks of the emulated controller, and how its axes follow them."""

from collections import deque
from collections.abc import Sequence
from math import inf, sqrt

_STRAIGHT = 0.9999  # cosine: blocks that go on so are passed without braking
_DONE = 1e-7  # mm or degrees


class _Block:
    """One straight way, mm or degrees, with its unit direction."""

    def __init__(self, start: Sequence[float], end: Sequence[float]) -> None:
        way = [to - since for since, to in zip(start, end, strict=True)]
        self.length = sqrt(sum(part * part for part in way))
        self.direction = [part / self.length if self.length else 0.0 for part in way]
        self.end = tuple(end)
        self.speed = inf

    def goes_on_as(self, other: "_Block") -> bool:
        """Whether it has the direction of the one before."""
        pairs = zip(self.direction, other.direction, strict=True)
        return sum(one * two for one, two in pairs) > _STRAIGHT


class Blocks:
    """Blocks in their order; the axes speed up and brake along them, by the slowest axis' limits.

    Parameters
    ----------
    position : sequence of float
        Where the axes are, mm or degrees.
    rates, accelerations : sequence of float
        Of each axis: per minute, per s².
    """

    def __init__(
        self, position: Sequence[float], rates: Sequence[float], accelerations: Sequence[float]
    ) -> None:
        self.position = list(position)
        self.speed = 0.0
        self._queue: deque[_Block] = deque()
        self.limits(rates, accelerations)

    def limits(self, rates: Sequence[float], accelerations: Sequence[float]) -> None:
        """Set what each axis may do."""
        self._rates = [rate / 60.0 for rate in rates]
        self._accelerations = list(accelerations)

    @property
    def count(self) -> int:
        """How many blocks wait or are under way."""
        return len(self._queue)

    @property
    def waiting(self) -> bool:
        """Whether any block is left."""
        return bool(self._queue)

    @property
    def moving(self) -> bool:
        """Whether the axes have a speed."""
        return self.speed > 0.0

    @property
    def end(self) -> tuple[float, ...]:
        """Where the last block ends."""
        return self._queue[-1].end if self._queue else tuple(self.position)

    def counted(self, steps: Sequence[float]) -> list[float]:
        """Return the position in whole steps of so many in a mm or degree."""
        return [round(at * per) / per for at, per in zip(self.position, steps, strict=True)]

    def add(self, end: Sequence[float], speed: float) -> None:
        """Put a straight way to `end` behind the others, no faster than `speed`, per s."""
        block = _Block(self.end, end)
        if block.length < _DONE:
            return
        block.speed = min(speed, self._slowest(block, self._rates))
        self._queue.append(block)

    def set(self, axis: int, position: float) -> None:
        """Take an axis, at rest, to be there."""
        self.position[axis] = position

    def clear(self) -> None:
        """Forget all blocks; the axes rest."""
        self._queue.clear()
        self.speed = 0.0

    halt = clear

    def step(self, dt_s: float, *, hold: bool) -> None:
        """Advance the axes by a while; with `hold` they brake, and keep the rest."""
        left_s = dt_s
        while self._queue and left_s > 0.0:
            block = self._queue[0]
            acceleration = self._slowest(block, self._accelerations)
            aim = 0.0 if hold else min(block.speed, self._stoppable(acceleration, dt_s))
            change = acceleration * left_s
            self.speed = min(max(aim, self.speed - change), self.speed + change)
            if self.speed <= 0.0:
                return
            rest = self._rest(block)
            way = min(self.speed * left_s, rest)
            self._go(block, way, rest)
            left_s = left_s - way / self.speed if way == rest else 0.0
            if self._queue and self._queue[0] is not block:
                continue
            if not self._queue:
                self.speed = 0.0

    def _go(self, block: _Block, way: float, rest: float) -> None:
        if rest - way < _DONE:
            self.position = list(block.end)
            self._queue.popleft()
            if self._queue and not self._queue[0].goes_on_as(block):
                self.speed = 0.0
        else:
            pairs = zip(self.position, block.direction, strict=True)
            self.position = [at + way * part for at, part in pairs]

    def _stoppable(self, acceleration: float, dt_s: float) -> float:
        """Return the greatest speed from which the axes still halt at the end of what goes on."""
        rest, before = 0.0, None
        for block in self._queue:
            if before is not None and not block.goes_on_as(before):
                break
            rest += self._rest(block) if before is None else block.length
            before = block
        return acceleration * (sqrt(dt_s**2 + 2.0 * rest / acceleration) - dt_s)

    def _rest(self, block: _Block) -> float:
        """Return what is left of the first block."""
        pairs = zip(block.end, self.position, strict=True)
        return sqrt(sum((end - at) ** 2 for end, at in pairs))

    def _slowest(self, block: _Block, bounds: Sequence[float]) -> float:
        """Return the bound along a block, by the axis that reaches its own first."""
        parts = zip(bounds, block.direction, strict=True)
        return min(bound / abs(part) for bound, part in parts if part)
