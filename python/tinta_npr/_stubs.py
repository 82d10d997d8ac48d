"""Prints the types that editors read: scripts/python puts the output of `python -m tinta_npr._stubs` into the wheel.

The settings come from the same tables as the functions' own help.
"""

import inspect

import tinta_npr
from tinta_npr import _native

_HEAD = '''"""{doc}"""

from collections.abc import Mapping, Sequence
from os import PathLike
from typing import Any, Literal, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native as _native, mpl as mpl, pv as pv

__version__: str
CLASSES: tuple[str, ...]
STYLES: tuple[str, ...]
LOOKS: tuple[str, ...]
__all__: list[str]

_Number = float | str
_Numbers = Sequence[float] | NDArray[Any] | str
_Path = str | PathLike[str]
_Color = str | Sequence[float]
_Text = str | float | Sequence[Any] | NDArray[Any] | Mapping[str, Any]
_Camera = str | Sequence[float] | Mapping[str, Any] | NDArray[Any] | Any
'''

#: Types of the arguments other than settings; all others are `Any`.
_ARGUMENTS = {
    "faces": "ArrayLike | Sequence[Sequence[int]] | None",
    "name": "str | None",
    "title": "str | None",
    "preset": "_Path | None",
    "camera": "_Camera | None",
    "eye": "ArrayLike",
    "direction": "bool",
    "frames": "int",
    "tolerance": "float",
    "path": "_Path",
    "styles": "Sequence[str | Mapping[str, Any]]",
}
_CHOICES = {"style": "style", "look": "look", "show": "show", "backend": "backend", "left": "style", "right": "style"}
_RETURNS = {
    "mesh": "Mesh",
    "lines": "Lines",
    "edges": "Edges",
    "silhouette": "NDArray[np.uint32]",
    "render": "Picture",
    "measure": "list[dict[str, Any]]",
    "compare": "Comparison",
    "svg": "str",
    "pdf": "bytes",
    "save": "None",
    "layers": "list[dict[str, Any]]",
}
_CLASSES = '''
class Mesh:
    @property
    def name(self) -> str: ...
    @property
    def remarks(self) -> list[str]: ...
    @property
    def vertices(self) -> NDArray[np.float64]: ...
    @property
    def faces(self) -> NDArray[np.uint32]: ...

class Edges:
    vertices: NDArray[np.uint32]
    faces: NDArray[np.int64]
    cls: NDArray[np.str_]
    def __len__(self) -> int: ...

class Picture(NDArray[np.uint8]):
    recipe: str | None
    def png(self) -> bytes: ...
    def save(self, path: _Path) -> None: ...

class Comparison:
    numbers: dict[str, Any]
    left: Picture
    right: Picture
    lines: Picture

class Lines:
    segments: NDArray[np.float64]
    visible: NDArray[np.bool_]
    outline: NDArray[np.bool_]
    covered: NDArray[np.bool_]
    edge: NDArray[np.int64]
    angle: NDArray[np.float64]
    object: NDArray[np.uint32]
    size: tuple[int, int]
    counts: dict[str, int]
    camera: dict[str, Any]
    @property
    def cls(self) -> NDArray[np.str_]: ...
    @property
    def hidden(self) -> NDArray[np.float64]: ...
    def __getitem__(self, name: str) -> NDArray[np.float64]: ...
    def __len__(self) -> int: ...
    def select(self, *names: str, visible: bool | None = True) -> NDArray[np.float64]: ...
    def json(self) -> str: ...
'''


def _literal(names):
    return "Literal[" + ", ".join(f'"{name}"' for name in names) + "]"


def _type(setting):
    names = setting["names"]
    return {
        "numbers": "_Number" if setting["count"] == 1 else "_Numbers",
        "choice": f"{_literal(names)} | str",
        "several": "str | Sequence[str]",
        "switch": "bool",
        "file": "_Path",
        "color": "_Color",
        "text": "_Text",
    }[setting["kind"]]


def _argument(parameter):
    kind = _ARGUMENTS.get(parameter.name, "Any")
    if parameter.name in _CHOICES:
        kind = _literal(_native.names(_CHOICES[parameter.name])) + (" | None" if parameter.default is None else "")
    default = "" if parameter.default is parameter.empty else f" = {_default(parameter.default)}"
    return f"    {parameter.name}: {kind}{default},\n"


def _default(value):
    return f'"{value}"' if isinstance(value, str) else repr(value)


def _signature(function, name, is_method):
    text = f"def {function.__name__}(\n"
    is_keyword = False
    for parameter in inspect.signature(function).parameters.values():
        if parameter.name == "self":
            text += "    self,\n"
        elif parameter.kind is parameter.VAR_KEYWORD:
            if not is_keyword:
                text += "    *,\n"
            for setting in _native.settings(name):
                text += f"    {setting['name']}: {_type(setting)} | None = None,\n"
        else:
            if parameter.kind is parameter.KEYWORD_ONLY and not is_keyword:
                text += "    *,\n"
                is_keyword = True
            text += _argument(parameter)
    text += f") -> {_RETURNS[function.__name__]}: ...\n"
    return "".join(f"    {line}\n" for line in text.splitlines()) if is_method else text


def stubs():
    """The text of the file."""
    methods = [getattr(tinta_npr.Lines, name) for name in ("svg", "pdf", "save", "layers")]
    functions = [getattr(tinta_npr, name) for name in _native.names("function") if "." not in name]
    parts = [_HEAD.format(doc=tinta_npr.__doc__.splitlines()[0]).replace(", overload", ""), _CLASSES]
    parts += [_signature(method, "Lines.svg", True) for method in methods]
    parts += ["\n" + _signature(function, function.__name__, False) for function in functions]
    return "".join(parts)


if __name__ == "__main__":
    print(stubs(), end="")
