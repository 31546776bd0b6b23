"""Former names of the plugin interface: each works for one more release and warns about it."""

import warnings
from collections.abc import Callable
from importlib import import_module
from operator import attrgetter
from typing import Any


def warn_of_former_name(former: str, current: str, stacklevel: int = 3) -> None:
    """Warn the caller's caller that a name has been replaced.

    Parameters
    ----------
    former, current : str
        The names with their module or class, such as ``rotemina.drivers.abilities.AxisHomer``.
    stacklevel : int
        The frame that the warning points to, as in :func:`warnings.warn`.
    """
    warnings.warn(
        f"{former} is now {current}. The former name works until the next release.",
        DeprecationWarning,
        stacklevel=stacklevel,
    )


def serve_former_names(module: str, **current: str) -> Callable[[str], Any]:
    """Return a ``__getattr__`` with which a module answers to former names.

    Hide its assignment behind ``if not TYPE_CHECKING``: type checkers accept any name from a
    module that has a ``__getattr__``.

    Parameters
    ----------
    module : str
        The module's ``__name__``.
    **current : str
        Maps each former name to the current one in the same module, or to a full path such as
        ``"rotemina.sim.units.units.Unit"``.
    """

    def find_current(name: str) -> Any:
        if name not in current:
            raise AttributeError(f"module {module!r} has no attribute {name!r}")
        path = current[name] if "." in current[name] else f"{module}.{current[name]}"
        warn_of_former_name(f"{module}.{name}", path)
        module_path, _, member_name = path.rpartition(".")
        return getattr(import_module(module_path), member_name)

    return find_current


class FormerMember:
    """Class attribute under which a member still answers to its former name.

    Parameters
    ----------
    current : str
        The current name of the method, property or field. If a part of the object has it, the
        name begins with the part, as in ``"jobs.progress"``.
    """

    def __init__(self, current: str) -> None:
        self.current = current

    def _warn(self, owner: type) -> None:
        # Named tuples do not call __set_name__, so the class is searched for the former name.
        former = next(
            f"{base.__module__}.{base.__qualname__}.{name}"
            for base in owner.__mro__
            for name, member in vars(base).items()
            if member is self
        )
        warn_of_former_name(former, self.current, stacklevel=4)

    def __get__(self, instance: object, owner: type) -> Any:
        self._warn(owner)
        return attrgetter(self.current)(owner if instance is None else instance)

    def __set__(self, instance: object, value: object) -> None:
        self._warn(type(instance))
        part, _, name = self.current.rpartition(".")
        setattr(attrgetter(part)(instance) if part else instance, name, value)


def adopt_former_methods(plugin: type) -> None:
    """Make methods that a plugin defines under former names available under the current ones.

    Call it from ``__init_subclass__`` of an interface whose methods plugins define. The former
    names are those of the :class:`FormerMember` attributes of its bases.

    Parameters
    ----------
    plugin : type
        The class that may define methods under former names.
    """
    defined_members = vars(plugin)
    members = {
        name: member
        for base in reversed(plugin.__mro__[1:])
        for name, member in vars(base).items()
        if isinstance(member, FormerMember)
    }
    for former, member in members.items():
        if former in defined_members and member.current not in defined_members:
            warn_of_former_name(f"{plugin.__qualname__}.{former}", member.current, stacklevel=4)
            setattr(plugin, member.current, defined_members[former])
