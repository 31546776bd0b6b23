"""A small MC68HC11 simulator with the instructions that the time-critical routines use.

Condition codes N, Z, V and C follow the reference manual; there are no interrupts.
"""

import subprocess


class Chip:
    """The processor with 64 KiB of memory that contains the firmware."""

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

    def word(self, address: int) -> int:
        return self.memory[address] << 8 | self.memory[address + 1]

    def poke(self, address: int, value: int, size: int = 2) -> None:
        self.memory[address : address + size] = (value % (1 << 8 * size)).to_bytes(size, "big")

    def call(self, name: str, max_instructions: int = 100_000) -> None:
        """Run a routine until it returns."""
        self._push(0xFFFF)
        self.pc = self.symbols[name]
        for _ in range(max_instructions):
            if self.pc == 0xFFFF:
                return
            # RTI ends a routine too; since it was called, only the return address is on the stack.
            if self.memory[self.pc] == 0x3B:
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

    def _set_flags(self, value: int, bits: int, v: int = 0) -> int:
        value &= (1 << bits) - 1
        self.n, self.z, self.v = value >> (bits - 1), int(value == 0), v
        return value

    def _add(self, first: int, second: int, carry: int, bits: int) -> int:
        total = first + second + carry
        self.c = total >> bits & 1
        overflow = (first ^ total) & (second ^ total)
        return self._set_flags(total, bits, overflow >> (bits - 1) & 1)

    def _subtract(self, first: int, second: int, bits: int) -> int:
        total = first - second
        self.c = int(total < 0)
        return self._set_flags(
            total, bits, (first ^ second) & (first ^ total) >> 0 >> (bits - 1) & 1
        )

    def _step(self) -> None:
        opcode = self._fetch()
        index, page = "x", opcode
        if opcode in (0x18, 0x1A):
            page, index = opcode, "y" if opcode == 0x18 else "x"
            opcode = self._fetch()
        if page != 0x1A and opcode < 0x40 and self._execute_short(opcode, index):
            return
        if opcode < 0x80:
            self._execute_one_operand(opcode, index)
        else:
            self._execute_two_operands(opcode, index, double_compare=page == 0x1A)

    def _execute_short(self, opcode: int, index: str) -> bool:  # noqa: C901 - a table of instructions
        if 0x20 <= opcode <= 0x2F:
            offset = self._fetch()
            is_taken = {
                0x20: True, 0x22: not (self.c or self.z), 0x23: bool(self.c or self.z),
                0x24: not self.c, 0x25: bool(self.c), 0x26: not self.z, 0x27: bool(self.z),
                0x28: not self.v, 0x29: bool(self.v), 0x2A: not self.n, 0x2B: bool(self.n),
            }[opcode]  # fmt: skip
            self.pc += (offset - 256 if offset > 127 else offset) if is_taken else 0
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
                self.b = self._set_flags(self.a, 8)
            else:
                self.a = self._set_flags(self.b, 8)
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

    def _execute_one_operand(self, opcode: int, index: str) -> None:  # noqa: C901 - a table of instructions
        mode, operation = opcode >> 4, opcode & 0xF
        address = None
        if mode == 6:
            address = getattr(self, index) + self._fetch()
        elif mode == 7:
            address = self._fetch_word()
        if operation == 0xE:
            self.pc = address
            return
        register = {4: "a", 5: "b"}.get(mode)
        value = self.memory[address] if register is None else getattr(self, register)
        if operation == 0x0:
            result = self._subtract(0, value, 8)
        elif operation == 0x3:
            result, self.c = self._set_flags(~value, 8), 1
        elif operation in (0x8, 0x9):
            carry, carry_out = (self.c if operation == 0x9 else 0), value >> 7
            result = self._set_flags(value << 1 | carry, 8)
            self.c = carry_out
        elif operation == 0xA:
            result = self._set_flags(value - 1, 8)
        elif operation == 0xC:
            result = self._set_flags(value + 1, 8)
        elif operation in (0xD, 0xF):
            result = self._set_flags(value if operation == 0xD else 0, 8)
            self.c = 0
        else:
            raise AssertionError(f"opcode {opcode:02x} at {self.pc:04x}")
        if register is None:
            self.memory[address] = result
        else:
            setattr(self, register, result)

    def _execute_two_operands(self, opcode: int, index: str, *, double_compare: bool) -> None:
        if opcode == 0x8F:
            self.x, self.d = self.d, self.x
            return
        operation, is_word = opcode & 0xF, opcode & 0xF in (0x3, 0xC, 0xE)
        address = self._find_operand(opcode, index, is_word=is_word)
        is_register_b = opcode >= 0xC0
        register = "b" if is_register_b else "a"
        if opcode & 0xF == 0xD and not is_register_b:  # JSR
            self._push(self.pc)
            self.pc = address
        elif double_compare and operation == 0x3:
            self._subtract(self.d, self.word(address), 16)
        elif operation == 0x3:
            if is_register_b:
                self.d = self._add(self.d, self.word(address), 0, 16)
            else:
                self.d = self._subtract(self.d, self.word(address), 16)
        elif operation in (0x7, 0xD, 0xF):
            self._store(operation, address, index, is_register_b=is_register_b)
        elif operation == 0xC and not is_register_b:
            self._subtract(getattr(self, index), self.word(address), 16)
        elif operation == 0xC:
            self.d = self._set_flags(self.word(address), 16)
        elif operation == 0xE:
            setattr(self, index, self._set_flags(self.word(address), 16))
        else:
            setattr(
                self,
                register,
                self._compute_byte(operation, getattr(self, register), self.memory[address]),
            )

    def _find_operand(self, opcode: int, index: str, *, is_word: bool) -> int:
        mode = opcode >> 4 & 3
        if mode == 0:
            self.pc += 2 if is_word else 1
            return self.pc - (2 if is_word else 1)
        if mode == 1:
            return self._fetch()
        return getattr(self, index) + self._fetch() if mode == 2 else self._fetch_word()

    def _store(self, operation: int, address: int, index: str, *, is_register_b: bool) -> None:
        if operation == 0x7:
            self.memory[address] = self._set_flags(self.b if is_register_b else self.a, 8)
        else:
            self.poke(
                address, self._set_flags(self.d if operation == 0xD else getattr(self, index), 16)
            )

    def _compute_byte(self, operation: int, register: int, value: int) -> int:
        if operation in (0x0, 0x1):
            result = self._subtract(register, value, 8)
            return register if operation == 0x1 else result
        if operation in (0x9, 0xB):
            return self._add(register, value, self.c if operation == 0x9 else 0, 8)
        if operation in (0x4, 0x5):
            result = self._set_flags(register & value, 8)
            return register if operation == 0x5 else result
        if operation in (0x6, 0x8):
            return self._set_flags(value if operation == 0x6 else register ^ value, 8)
        raise AssertionError(f"byte operation {operation:x} at {self.pc:04x}")


def build_chip(folder, sources, build_folder) -> Chip:
    """Assemble and link sources, and return a chip with the result."""
    objects = [str(build_folder / f"{name}.o") for name in sources]
    for name, target in zip(sources, objects, strict=True):
        _run_tool("as", "-m68hc11", "-I", folder, folder / f"{name}.s", "-o", target)
    elf, image = build_folder / "whole.elf", build_folder / "whole.bin"
    _run_tool("ld", *objects, "-o", elf, "-e", "isr_tick", "--section-start", ".text=0xE000")
    _run_tool("objcopy", "-O", "binary", "-j", ".text", elf, image)
    symbols = {}
    for line in _run_tool("nm", elf).splitlines():
        address, _, name = line.split()
        symbols[name] = int(address, 16) & 0xFFFF
    return Chip(image.read_bytes(), 0xE000, symbols)


def _run_tool(name, *arguments) -> str:
    command = [f"m68hc11-{name}", *map(str, arguments)]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout
