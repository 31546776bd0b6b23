"""E-clock cycles of the MC68HC11's instructions and of assembled routines.

Source: Motorola, M68HC11 Reference Manual (M68HC11RM/AD), appendix A. A branch takes the same time
whether it is taken or not, and no other instruction time depends on data.
"""

import re
import subprocess
from collections.abc import Iterable, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

from rotemina.drivers.contract import BudgetError

ASSEMBLER_PACKAGE = "binutils-m68hc1x"
ASSEMBLER, DISASSEMBLER = "m68hc11-as", "m68hc11-objdump"
# Cycles of an interrupt entry, which pushes nine bytes of registers onto the stack.
INTERRUPT_ENTRY_CYCLES = 14
_LABEL_PATTERN = re.compile(r"[0-9a-f]+ <(\w+)>:")
_INSTRUCTION_PATTERN = re.compile(r"\s*[0-9a-f]+:\t((?:[0-9a-f]{2} )+)\s*\t(\S+)")
# CLI and RTI enable interrupts.
_UNMASKING_OPCODES = (0x0E, 0x3B)
_JUMP_OPCODE, _BRANCH_OPCODES = 0x7E, range(0x22, 0x30)

# Instructions, as bytes, from each label to the next one.
Routines = dict[str, list[tuple[int, ...]]]


def _parse_cycle_table(text: str) -> dict[int, int]:
    """Return the cycles by opcode from lines ``first opcode: cycles …``.

    A 0 in the table means that there is no instruction with this opcode.
    """
    cycles_by_opcode = {}
    for line in text.split("\n"):
        first_opcode, _, cycles = line.strip().partition(": ")
        for offset, count in enumerate(cycles.split()):
            if count != "0":
                cycles_by_opcode[int(first_opcode, 16) + offset] = int(count)
    return cycles_by_opcode


_CYCLES_BY_PAGE = {
    0: _parse_cycle_table(
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
    0x18: _parse_cycle_table(
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
    0x1A: _parse_cycle_table("83: 5\n93: 6\na3: 7\nac: 7\nb3: 7\nee: 6 6"),
    0xCD: _parse_cycle_table("a3: 7\nac: 7\nee: 6 6"),
}


def find_cycles(instruction: Sequence[int]) -> int:
    """Return the cycles of an instruction, given its bytes.

    Raises
    ------
    BudgetError
        If the bytes are not an instruction.
    """
    prefix = instruction[0] if instruction[0] in _CYCLES_BY_PAGE and len(instruction) > 1 else 0
    opcode = instruction[1] if prefix else instruction[0]
    try:
        return _CYCLES_BY_PAGE[prefix][opcode]
    except KeyError as error:
        text = " ".join(f"{byte:02x}" for byte in instruction)
        raise BudgetError(f"{text}: no instruction of the MC68HC11") from error


def count_cycles(instructions: Iterable[Sequence[int]]) -> int:
    """Return the cycles of all instructions of a path, except jumps that a branch skips.

    For a branch to a distant label, the assembler inserts an inverted branch that skips a jump. The
    measured paths never take these jumps.
    """
    total, previous = 0, None
    for instruction in instructions:
        if not _is_skipped_jump(previous, instruction):
            total += find_cycles(instruction)
        previous = instruction
    return total


def count_masked_cycles(instructions: Iterable[Sequence[int]]) -> int:
    """Return the cycles for which an interrupt blocks others: from its entry to CLI or RTI.

    Raises
    ------
    BudgetError
        If there is neither CLI nor RTI.
    """
    cycles, previous = INTERRUPT_ENTRY_CYCLES, None
    for instruction in instructions:
        if not _is_skipped_jump(previous, instruction):
            cycles += find_cycles(instruction)
        if instruction[0] in _UNMASKING_OPCODES:
            return cycles
        previous = instruction
    raise BudgetError("an interrupt's path has neither CLI nor RTI")


def _is_skipped_jump(previous: Sequence[int] | None, instruction: Sequence[int]) -> bool:
    return (
        previous is not None
        and instruction[0] == _JUMP_OPCODE
        and previous[0] in _BRANCH_OPCODES
        and previous[1] == len(instruction)
    )


def assemble_sources(folder: Path, names: Iterable[str]) -> Routines:
    """Assemble sources of a folder; return the instructions from each label to the next one.

    Raises
    ------
    BudgetError
        If the assembler is missing or reports an error.
    """
    routines: Routines = {}
    with TemporaryDirectory() as build_folder:
        for name in names:
            target = Path(build_folder) / f"{name}.o"
            _run_tool([ASSEMBLER, "-m68hc11", "-I", str(folder), str(folder / f"{name}.s"),
                  "-o", str(target)])  # fmt: skip
            routines |= _parse_listing(_run_tool([DISASSEMBLER, "-d", str(target)]))
    return routines


def _run_tool(command: list[str]) -> str:
    try:
        result = subprocess.run(command, capture_output=True, text=True, check=False)
    except FileNotFoundError as error:
        raise BudgetError(
            f"{command[0]}: there is no such program; install the package {ASSEMBLER_PACKAGE}"
        ) from error
    if result.returncode:
        raise BudgetError(f"{command[0]}: {result.stderr.strip()}")
    return result.stdout


def _parse_listing(listing: str) -> Routines:
    routines: Routines = {}
    label = ""
    for line in listing.splitlines():
        if match := _LABEL_PATTERN.match(line):
            label = match[1]
            routines[label] = []
        elif (match := _INSTRUCTION_PATTERN.match(line)) and label:
            routines[label].append(tuple(bytes.fromhex(match[1])))
    return routines
