"""Writes the package of a new plugin from templates, completely or not at all."""

import re
from collections.abc import Mapping
from importlib.metadata import entry_points, version
from importlib.resources import files
from pathlib import Path
from shutil import rmtree
from uuid import uuid4

from jinja2 import BaseLoader, Environment, StrictUndefined, TemplateNotFound

from rotemina.app.plugin_kit.plugin_kinds import Kind
from rotemina.sim.errors import InputError, reason_of
from rotemina.sim.messages import message

_NAME = re.compile(r"[a-z][a-z0-9]*(_[a-z0-9]+)*")
_LONGEST = 30


class PluginNameError(InputError):
    """A name that a plugin cannot have."""


class PluginWriteError(InputError):
    """A package that cannot be written where it was to be."""


class _Templates(BaseLoader):
    """The templates among the program's own files."""

    def get_source(self, environment: Environment, template: str) -> tuple[str, str, None]:
        """Return a template's text."""
        file = files("rotemina.resources.templates").joinpath(f"{template}.jinja")
        if not file.is_file():
            raise TemplateNotFound(template)
        return file.read_text("utf-8"), template, None


def new_plugin(kind: Kind, name: str, folder: Path) -> Path:
    """Write a package with a plugin into a new folder ``rotemina-NAME`` and return that.

    Parameters
    ----------
    kind : Kind
    name : str
        Of the entry point: small letters, digits and single underscores, a letter first.
    folder : Path
        Where the package's own folder goes; it must be there.

    Raises
    ------
    PluginNameError
        If a plugin cannot be called that, or one of this kind is.
    PluginWriteError
        If the package is there already, or nothing can be written there.
    """
    check_name(kind, name)
    if not folder.is_dir():
        raise PluginWriteError(
            message("engine", "{folder}: folder not found; create it, or name another one").fill(
                folder=folder
            )
        )
    place = folder / f"rotemina-{name.replace('_', '-')}"
    if place.exists() or place.is_symlink():
        raise PluginWriteError(
            message(
                "engine",
                "{place} already exists and is not overwritten; choose another name or folder",
            ).fill(place=place)
        )
    draft = folder / f".{place.name}.{uuid4().hex}.part"
    try:
        for inside, text in rendered(kind, name).items():
            file = draft / inside
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text, "utf-8", newline="\n")
        draft.rename(place)  # fails where anything but an empty folder has come meanwhile
    except OSError as error:
        raise PluginWriteError(
            message(
                "engine",
                "{place} cannot be written ({reason}); choose another folder, or free disk space",
            ).fill(place=place, reason=reason_of(error))
        ) from error
    finally:
        rmtree(draft, ignore_errors=True)
    return place


def check_name(kind: Kind, name: str) -> None:
    """Refuse what cannot be the name of a new plugin, with :class:`PluginNameError`."""
    if not _NAME.fullmatch(name) or len(name) > _LONGEST:
        raise PluginNameError(
            message(
                "engine",
                "{name} cannot be the name of a plugin: it must have small letters, digits "
                "and single underscores, a letter first, at most {longest} characters, such "
                "as 'glass_stage'",
            ).fill(name=repr(name), longest=_LONGEST)
        )
    for point in entry_points(group=kind.group, name=name):
        package = f" (of the package {point.dist.name})" if point.dist else ""
        raise PluginNameError(
            message(
                "engine", "the {kind} {name} already exists{package}; choose another name"
            ).fill(kind=kind, name=repr(name), package=package)
        )


def rendered(kind: Kind, name: str) -> Mapping[str, str]:
    """Return the files of a new package: path in its folder -> text."""
    module = f"rotemina_{name}"
    words = name.replace("_", " ")
    environment = Environment(
        loader=_Templates(),
        undefined=StrictUndefined,
        keep_trailing_newline=True,
        trim_blocks=True,
        lstrip_blocks=True,
        autoescape=False,  # noqa: S701 - Python and TOML, of a checked name, are written
    )
    camel = "".join(part.capitalize() for part in name.split("_"))
    about = {
        "kind": str(kind),
        "name": name,
        "words": words,
        "title": words.capitalize(),
        "module": module,
        "distribution": module.replace("_", "-"),
        "object": name.upper() if kind is Kind.EFFECT else f"{camel}{_ENDINGS[kind]}",
        "camel": camel,
        "group": kind.group,
        "api_version": kind.api_version,
        "rotemina_version": version("rotemina"),
    }
    templates = {
        "pyproject.toml": "pyproject.toml",
        "README.md": "README.md",
        "LICENSE": "LICENSE",
        f"src/{module}/__init__.py": "package.py",
        f"src/{module}/{kind}.py": f"{kind}.py",
        f"tests/test_{name}_{kind}.py": f"{kind}_test.py",
    }
    return {
        place: environment.get_template(template).render(about)
        for place, template in templates.items()
    }


_ENDINGS: Mapping[Kind, str] = {
    Kind.DRIVER: "Driver",
    Kind.PANEL: "Panel",
    Kind.CAMERA: "Source",
    Kind.INPUT: "Source",
}
