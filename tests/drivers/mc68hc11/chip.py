"""An MC68HC11 in little: as many of its instructions as the hot paths use, to see what they do.

Condition codes N, Z, V and C are kept as the reference manual says; interrupts are not taken.
"""

import subprocess


class Chip:
    """The processor with 64 KiB of memory, and the firmware in it."""

    def __init__(self, image: bytes, origin: int, symbols: dict[str, int]) -> None:
        self.memory = bytearray(1 << 16)
        self.memory[origin : origin + len(image)] = image
        self.symbols = symbols
        self.a = self.b = self.x = self.y = 0
        self.n = self.z = self.v = self.c = 0
        self.sp = 0x01FF

    @property
    def d(self) -> int:
        return self.a << 8 | self.b

    @d.setter
    def d(self, value: int) -> None:
        self.a, self.b = value >> 8 & 0xFF, value & 0xFF

    def word(self, at: int) -> int:
        return self.memory[at] << 8 | self.memory[at + 1]

    def poke(self, at: int, value: int, size: int = 2) -> None:
        self.memory[at : at + size] = (value % (1 << 8 * size)).to_bytes(size, "big")

    def call(self, name: str, most: int = 100_000) -> None:
        """Run a routine until it returns."""
        self._push(0xFFFF)
        self.pc = self.symbols[name]
        for _ in range(most):
            if self.pc == 0xFFFF:
                return
            if self.memory[self.pc] == 0x3B:  # RTI ends a routine that was not interrupted into
                self.sp += 2
                return
            self._step()
        raise AssertionError(f"{name} does not end")

    def _push(self, value: int) -> None:
        self.poke(self.sp - 1, value)
        self.sp -= 2

    def _pull(self) -> int:
        self.sp += 2
        return self.word(self.sp - 1)

    def _fetch(self) -> int:
        self.pc += 1
        return self.memory[self.pc - 1]

    def _fetch_word(self) -> int:
        self.pc += 2
        return self.word(self.pc - 2)

    def _flags(self, value: int, bits: int, v: int = 0) -> int:
        value &= (1 << bits) - 1
        self.n, self.z, self.v = value >> (bits - 1), int(value == 0), v
        return value

    def _sum(self, one: int, two: int, carry: int, bits: int) -> int:
        total = one + two + carry
        self.c = total >> bits & 1
        overflow = (one ^ total) & (two ^ total)
        return self._flags(total, bits, overflow >> (bits - 1) & 1)

    def _difference(self, one: int, two: int, bits: int) -> int:
        total = one - two
        self.c = int(total < 0)
        return self._flags(total, bits, (one ^ two) & (one ^ total) >> 0 >> (bits - 1) & 1)

    def _step(self) -> None:
        opcode = self._fetch()
        index, page = "x", opcode
        if opcode in (0x18, 0x1A):
            page, index = opcode, "y" if opcode == 0x18 else "x"
            opcode = self._fetch()
        if page != 0x1A and opcode < 0x40 and self._short(opcode, index):
            return
        if opcode < 0x80:
            self._one_operand(opcode, index)
        else:
            self._two_operands(opcode, index, double_compare=page == 0x1A)

    def _short(self, opcode: int, index: str) -> bool:  # noqa: C901 - a table of instructions
        if 0x20 <= opcode <= 0x2F:
            offset = self._fetch()
            taken = {
                0x20: True, 0x22: not (self.c or self.z), 0x23: bool(self.c or self.z),
                0x24: not self.c, 0x25: bool(self.c), 0x26: not self.z, 0x27: bool(self.z),
                0x28: not self.v, 0x29: bool(self.v), 0x2A: not self.n, 0x2B: bool(self.n),
            }[opcode]  # fmt: skip
            self.pc += (offset - 256 if offset > 127 else offset) if taken else 0
        elif opcode == 0x02:
            self.x, self.d = divmod(self.d, self.x) if self.x else (0xFFFF, self.d)
        elif opcode in (0x08, 0x09):
            value = (getattr(self, index) + (1 if opcode == 0x08 else -1)) & 0xFFFF
            setattr(self, index, value)
            self.z = int(value == 0)
        elif opcode == 0x0E:
            pass
        elif opcode in (0x16, 0x17):
            if opcode == 0x16:
                self.b = self._flags(self.a, 8)
            else:
                self.a = self._flags(self.b, 8)
        elif opcode == 0x32:
            self.sp += 1
            self.a = self.memory[self.sp]
        elif opcode == 0x37:
            self.memory[self.sp] = self.b
            self.sp -= 1
        elif opcode == 0x38:
            self.x = self._pull()
        elif opcode == 0x39:
            self.pc = self._pull()
        elif opcode == 0x3A:
            setattr(self, index, getattr(self, index) + self.b & 0xFFFF)
        elif opcode == 0x3C:
            self._push(self.x)
        elif opcode == 0x3D:
            self.d = self.a * self.b
            self.c = self.b >> 7
        else:
            raise AssertionError(f"opcode {opcode:02x} at {self.pc:04x}")
        return True

    def _one_operand(self, opcode: int, index: str) -> None:  # noqa: C901 - the same
        mode, what = opcode >> 4, opcode & 0xF
        at = None
        if mode == 6:
            at = getattr(self, index) + self._fetch()
        elif mode == 7:
            at = self._fetch_word()
        if what == 0xE:
            self.pc = at
            return
        register = {4: "a", 5: "b"}.get(mode)
        value = self.memory[at] if register is None else getattr(self, register)
        if what == 0x0:
            result = self._difference(0, value, 8)
        elif what == 0x3:
            result, self.c = self._flags(~value, 8), 1
        elif what in (0x8, 0x9):
            carry, self_c = (self.c if what == 0x9 else 0), value >> 7
            result = self._flags(value << 1 | carry, 8)
            self.c = self_c
        elif what == 0xA:
            result = self._flags(value - 1, 8)
        elif what == 0xC:
            result = self._flags(value + 1, 8)
        elif what in (0xD, 0xF):
            result = self._flags(value if what == 0xD else 0, 8)
            self.c = 0
        else:
            raise AssertionError(f"opcode {opcode:02x} at {self.pc:04x}")
        if register is None:
            self.memory[at] = result
        else:
            setattr(self, register, result)

    def _two_operands(self, opcode: int, index: str, *, double_compare: bool) -> None:
        if opcode == 0x8F:
            self.x, self.d = self.d, self.x
            return
        what, wide = opcode & 0xF, opcode & 0xF in (0x3, 0xC, 0xE)
        at = self._operand(opcode, index, wide=wide)
        second = opcode >= 0xC0
        register = "b" if second else "a"
        if opcode & 0xF == 0xD and not second:  # JSR
            self._push(self.pc)
            self.pc = at
        elif double_compare and what == 0x3:
            self._difference(self.d, self.word(at), 16)
        elif what == 0x3:
            if second:
                self.d = self._sum(self.d, self.word(at), 0, 16)
            else:
                self.d = self._difference(self.d, self.word(at), 16)
        elif what in (0x7, 0xD, 0xF):
            self._store(what, at, index, second=second)
        elif what == 0xC and not second:
            self._difference(getattr(self, index), self.word(at), 16)
        elif what == 0xC:
            self.d = self._flags(self.word(at), 16)
        elif what == 0xE:
            setattr(self, index, self._flags(self.word(at), 16))
        else:
            setattr(self, register, self._byte(what, getattr(self, register), self.memory[at]))

    def _operand(self, opcode: int, index: str, *, wide: bool) -> int:
        mode = opcode >> 4 & 3
        if mode == 0:
            self.pc += 2 if wide else 1
            return self.pc - (2 if wide else 1)
        if mode == 1:
            return self._fetch()
        return getattr(self, index) + self._fetch() if mode == 2 else self._fetch_word()

    def _store(self, what: int, at: int, index: str, *, second: bool) -> None:
        if what == 0x7:
            self.memory[at] = self._flags(self.b if second else self.a, 8)
        else:
            self.poke(at, self._flags(self.d if what == 0xD else getattr(self, index), 16))

    def _byte(self, what: int, register: int, value: int) -> int:
        if what in (0x0, 0x1):
            result = self._difference(register, value, 8)
            return register if what == 0x1 else result
        if what in (0x9, 0xB):
            return self._sum(register, value, self.c if what == 0x9 else 0, 8)
        if what in (0x4, 0x5):
            result = self._flags(register & value, 8)
            return register if what == 0x5 else result
        if what in (0x6, 0x8):
            return self._flags(value if what == 0x6 else register ^ value, 8)
        raise AssertionError(f"byte operation {what:x} at {self.pc:04x}")


def built(folder, sources, made) -> Chip:
    """Assemble and link sources; return a chip with them."""
    objects = [str(made / f"{name}.o") for name in sources]
    for name, target in zip(sources, objects, strict=True):
        _tool("as", "-m68hc11", "-I", folder, folder / f"{name}.s", "-o", target)
    whole, image = made / "whole.elf", made / "whole.bin"
    _tool("ld", *objects, "-o", whole, "-e", "isr_tick", "--section-start", ".text=0xE000")
    _tool("objcopy", "-O", "binary", "-j", ".text", whole, image)
    symbols = {}
    for line in _tool("nm", whole).splitlines():
        address, _, name = line.split()
        symbols[name] = int(address, 16) & 0xFFFF
    return Chip(image.read_bytes(), 0xE000, symbols)


def _tool(name, *arguments) -> str:
    command = [f"m68hc11-{name}", *map(str, arguments)]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout
