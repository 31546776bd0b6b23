"""Write the package of a new plugin from templates, completely or not at all."""

import re
from collections.abc import Mapping
from importlib.metadata import entry_points, version
from importlib.resources import files
from pathlib import Path
from shutil import rmtree
from uuid import uuid4

from jinja2 import BaseLoader, Environment, StrictUndefined, TemplateNotFound

from rotemina.app.errors import PluginNameError, PluginWriteError
from rotemina.app.plugin_kit.plugin_kinds import PluginKind
from rotemina.sim.errors import (
    describe_exception,
)

_NAME_PATTERN = re.compile(r"[a-z][a-z0-9]*(_[a-z0-9]+)*")
_MAX_NAME_LENGTH = 30


class _TemplateLoader(BaseLoader):
    def get_source(self, environment: Environment, template: str) -> tuple[str, str, None]:
        """Return a template's text."""
        file = files("rotemina.resources.templates").joinpath(f"{template}.jinja")
        if not file.is_file():
            raise TemplateNotFound(template)
        return file.read_text("utf-8"), template, None


def write_plugin(kind: PluginKind, name: str, folder: Path) -> Path:
    """Write a package with a plugin into a new folder ``rotemina-NAME``; return the folder.

    Parameters
    ----------
    kind : PluginKind
    name : str
        Name of the entry point: small letters, digits and single underscores, a letter first.
    folder : Path
        Existing parent folder of the new one.

    Raises
    ------
    PluginNameError
        If the name is invalid, or another plugin of this kind has it.
    PluginWriteError
        If the new folder exists already, or cannot be written.
    """
    check_name(kind, name)
    if not folder.is_dir():
        raise PluginWriteError(
            "{folder}: folder not found; create it, or name another one", folder=folder
        )
    package_folder = folder / f"rotemina-{name.replace('_', '-')}"
    if package_folder.exists() or package_folder.is_symlink():
        raise PluginWriteError(
            "{place} already exists and is not overwritten; choose another name or folder",
            place=package_folder,
        )
    draft = folder / f".{package_folder.name}.{uuid4().hex}.part"
    try:
        for relative_path, text in render_package(kind, name).items():
            file = draft / relative_path
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text, "utf-8", newline="\n")
        # This fails if another program has meanwhile created the folder and put files into it.
        draft.rename(package_folder)
    except OSError as error:
        raise PluginWriteError(
            "{place} cannot be written ({reason}); choose another folder, or free disk space",
            place=package_folder,
            reason=describe_exception(error),
        ) from error
    finally:
        rmtree(draft, ignore_errors=True)
    return package_folder


def check_name(kind: PluginKind, name: str) -> None:
    """Raise :class:`PluginNameError` if a new plugin cannot have this name."""
    if not _NAME_PATTERN.fullmatch(name) or len(name) > _MAX_NAME_LENGTH:
        raise PluginNameError(
            "{name} cannot be the name of a plugin: it must have small letters, digits "
            "and single underscores, a letter first, at most {longest} characters, such "
            "as 'glass_stage'",
            name=repr(name),
            longest=_MAX_NAME_LENGTH,
        )
    for point in entry_points(group=kind.group, name=name):
        package = f" (of the package {point.dist.name})" if point.dist else ""
        raise PluginNameError(
            "the {kind} {name} already exists{package}; choose another name",
            kind=kind,
            name=repr(name),
            package=package,
        )


def render_package(kind: PluginKind, name: str) -> Mapping[str, str]:
    """Return the text of each file of a new package, by its path in the package folder."""
    module = f"rotemina_{name}"
    words = name.replace("_", " ")
    environment = Environment(
        loader=_TemplateLoader(),
        undefined=StrictUndefined,
        keep_trailing_newline=True,
        trim_blocks=True,
        lstrip_blocks=True,
        autoescape=False,  # noqa: S701 - the output is Python and TOML, with a checked name
    )
    class_prefix = "".join(part.capitalize() for part in name.split("_"))
    fields = {
        "kind": str(kind),
        "name": name,
        "words": words,
        "title": words.capitalize(),
        "module": module,
        "distribution": module.replace("_", "-"),
        "object": name.upper()
        if kind is PluginKind.EFFECT
        else f"{class_prefix}{_CLASS_SUFFIXES[kind]}",
        "camel": class_prefix,
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
        path: environment.get_template(template).render(fields)
        for path, template in templates.items()
    }


_CLASS_SUFFIXES: Mapping[PluginKind, str] = {
    PluginKind.DRIVER: "Driver",
    PluginKind.PANEL: "Panel",
    PluginKind.CAMERA: "Source",
    PluginKind.INPUT: "Source",
}
