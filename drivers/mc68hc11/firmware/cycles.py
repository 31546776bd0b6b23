"""E cycles of the MC68HC11's instructions, and of routines that were assembled.

Source: Motorola, M68HC11 Reference Manual (M68HC11RM/AD), appendix A. A branch takes as long taken
or not; nothing else depends on data.
"""

import re
import subprocess
from collections.abc import Iterable, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

from rotemina.sim.errors import InputError

PACKAGE = "binutils-m68hc1x"
ASSEMBLER, DISASSEMBLER = "m68hc11-as", "m68hc11-objdump"
ENTRY = 14  # of an interrupt: nine registers go onto the stack
_LABEL = re.compile(r"[0-9a-f]+ <(\w+)>:")
_CODE = re.compile(r"\s*[0-9a-f]+:\t((?:[0-9a-f]{2} )+)\s*\t(\S+)")
_CLEARS_THE_MASK = (0x0E, 0x3B)  # CLI, RTI
_JUMP, _CONDITIONAL = 0x7E, range(0x22, 0x30)

Routines = dict[str, list[tuple[int, ...]]]


class BudgetError(InputError):
    """The firmware cannot be assembled or counted."""


def _page(text: str) -> dict[int, int]:
    """Return cycles by opcode of lines ``first opcode: cycles …``; 0 stands for no instruction."""
    found = {}
    for line in text.split("\n"):
        first, _, cycles = line.strip().partition(": ")
        for number, count in enumerate(cycles.split()):
            if count != "0":
                found[int(first, 16) + number] = int(count)
    return found


_PAGES = {
    0: _page(
        """00: 0 2 41 41 3 3 2 2 3 3 2 2 2 2 2 2
        10: 2 2 6 6 6 6 2 2 0 2 0 2 7 7 7 7
        20: 3 3 3 3 3 3 3 3 3 3 3 3 3 3 3 3
        30: 3 3 4 4 3 3 3 3 5 5 3 12 4 10 14 14
        40: 2 0 0 2 2 0 2 2 2 2 2 0 2 2 0 2
        50: 2 0 0 2 2 0 2 2 2 2 2 0 2 2 0 2
        60: 6 0 0 6 6 0 6 6 6 6 6 0 6 6 3 6
        70: 6 0 0 6 6 0 6 6 6 6 6 0 6 6 3 6
        80: 2 2 2 4 2 2 2 0 2 2 2 2 4 6 3 3
        90: 3 3 3 5 3 3 3 3 3 3 3 3 5 5 4 4
        a0: 4 4 4 6 4 4 4 4 4 4 4 4 6 6 5 5
        b0: 4 4 4 6 4 4 4 4 4 4 4 4 6 6 5 5
        c0: 2 2 2 4 2 2 2 0 2 2 2 2 3 0 3 2
        d0: 3 3 3 5 3 3 3 3 3 3 3 3 4 4 4 4
        e0: 4 4 4 6 4 4 4 4 4 4 4 4 5 5 5 5
        f0: 4 4 4 6 4 4 4 4 4 4 4 4 5 5 5 5"""
    ),
    0x18: _page(
        """08: 4 4
        1c: 8 8 8 8
        30: 4 0 0 0 0 4 0 0 6 0 4 0 5
        60: 7 0 0 7 7 0 7 7 7 7 7 0 7 7 4 7
        8c: 5 0 0 4
        9c: 6
        a0: 5 5 5 7 5 5 5 5 5 5 5 5 7 7 6 6
        bc: 7
        ce: 4
        de: 5 5
        e0: 5 5 5 7 5 5 5 5 5 5 5 5 6 6 6 6
        fe: 6 6"""
    ),
    0x1A: _page("83: 5\n93: 6\na3: 7\nac: 7\nb3: 7\nee: 6 6"),
    0xCD: _page("a3: 7\nac: 7\nee: 6 6"),
}


def cycles_of(code: Sequence[int]) -> int:
    """Return the cycles of one instruction by its bytes.

    Raises
    ------
    BudgetError
        If it is none.
    """
    prefix = code[0] if code[0] in _PAGES and len(code) > 1 else 0
    opcode = code[1] if prefix else code[0]
    try:
        return _PAGES[prefix][opcode]
    except KeyError as error:
        text = " ".join(f"{byte:02x}" for byte in code)
        raise BudgetError(f"{text}: no instruction of the MC68HC11") from error


def counted(code: Iterable[Sequence[int]]) -> int:
    """Return the cycles of a path: every instruction, but jumps that a branch leads around.

    The assembler makes a branch around a jump of one to what is far away; that is never on the way.
    """
    total, before = 0, None
    for instruction in code:
        if not _leads_around(before, instruction):
            total += cycles_of(instruction)
        before = instruction
    return total


def masked(code: Iterable[Sequence[int]]) -> int:
    """Return for how long an interrupt's path keeps others out: from its entry to CLI or RTI."""
    path, before = ENTRY, None
    for instruction in code:
        if not _leads_around(before, instruction):
            path += cycles_of(instruction)
        if instruction[0] in _CLEARS_THE_MASK:
            return path
        before = instruction
    raise BudgetError("an interrupt's path has neither CLI nor RTI")


def _leads_around(before: Sequence[int] | None, code: Sequence[int]) -> bool:
    return (
        before is not None
        and code[0] == _JUMP
        and before[0] in _CONDITIONAL
        and before[1] == len(code)
    )


def assembled(folder: Path, names: Iterable[str]) -> Routines:
    """Assemble sources of a folder; return the instructions from each label to the next one.

    Raises
    ------
    BudgetError
        If the assembler is missing or refuses them.
    """
    routines: Routines = {}
    with TemporaryDirectory() as made:
        for name in names:
            target = Path(made) / f"{name}.o"
            _run([ASSEMBLER, "-m68hc11", "-I", str(folder), str(folder / f"{name}.s"),
                  "-o", str(target)])  # fmt: skip
            routines |= _parsed(_run([DISASSEMBLER, "-d", str(target)]))
    return routines


def _run(command: list[str]) -> str:
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    except FileNotFoundError as error:
        raise BudgetError(
            f"{command[0]}: there is no such program; install the package {PACKAGE}"
        ) from error
    if done.returncode:
        raise BudgetError(f"{command[0]}: {done.stderr.strip()}")
    return done.stdout


def _parsed(listing: str) -> Routines:
    routines: Routines = {}
    label = ""
    for line in listing.splitlines():
        if found := _LABEL.match(line):
            label = found[1]
            routines[label] = []
        elif (found := _CODE.match(line)) and label:
            routines[label].append(tuple(bytes.fromhex(found[1])))
    return routines
