"""Writes the types that editors read: `python -m tinta_npr._stubs FOLDER`, which scripts/python puts into the wheel.

The settings come from the same tables as the functions' own help.
"""

import inspect
import pathlib
import sys

import tinta_npr
from tinta_npr import _native

_HEAD = '''"""{doc}"""

from collections.abc import Mapping, Sequence
from os import PathLike
from typing import IO, Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import mpl as mpl, pv as pv

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

#: The modules of other packages' scenes: their first lines, and their functions with what they return.
_MODULES = {
    "mpl": (
        '''"""{doc}"""

from collections.abc import Sequence
from typing import Any, Literal

from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PathCollection
from matplotlib.colors import Colormap, Normalize
from numpy.typing import ArrayLike

from . import Lines, _Color, _Camera, _Number, _Numbers, _Path, _Text

__all__: list[str]

class ExactLines(LineCollection):
    def do_3d_projection(self) -> float: ...

class ExactAreas(PathCollection):
    def do_3d_projection(self) -> float: ...

class ExactScene(PathCollection):
    lines: Lines
    def do_3d_projection(self) -> float: ...
    def remove(self) -> None: ...

''',
        {"draw": "LineCollection", "draw3d": "ExactScene", "fill": "PathCollection"},
    ),
    "pv": (
        '''"""{doc}"""

from collections.abc import Sequence
from typing import IO, Any, Literal

from . import Lines, _Color, _Number, _Numbers, _Path, _Text

__all__: list[str]

''',
        {"lines": "Lines", "export_svg": "None"},
    ),
}

#: What areas are of.
_BY = 'Literal["face", "material", "object", "tone"]'

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
    "file": "_Path | IO[bytes] | IO[str]",
    "format": 'Literal["svg", "pdf", "png", "json"] | None',
    "points": "ArrayLike",
    "ax": "Axes",
    "extent": "Sequence[float] | None",
    "zorder": "float",
    "color": "_Color | None",
    "colors": "ArrayLike | None",
    "values": "ArrayLike | Sequence[ArrayLike] | None",
    "cmap": "str | Colormap | None",
    "norm": "str | Normalize | None",
    "vmin": "float | None",
    "vmax": "float | None",
    "fill": "bool",
    "label": "str | None",
    "linewidth": "float | None",
    "lw": "float | None",
    "by": _BY,
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
    "png": "bytes",
    "save": "None",
    "layers": "list[dict[str, Any]]",
    "regions": "Regions",
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
    @property
    def file_faces(self) -> NDArray[np.uint32]: ...

class Edges:
    vertices: NDArray[np.uint32]
    faces: NDArray[np.int64]
    cls: NDArray[np.str_]
    def __len__(self) -> int: ...

class Picture(NDArray[np.uint8]):
    recipe: str | None
    def png(self) -> bytes: ...
    def save(self, path: _Path) -> None: ...
    def _repr_png_(self) -> bytes | None: ...

class Comparison:
    numbers: dict[str, Any]
    left: Picture
    right: Picture
    lines: Picture
    def _repr_png_(self) -> bytes: ...

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
    def visible_area(self, by: Literal["face", "material", "object"] = "face") -> dict[Any, float]: ...
    def project(self, points: ArrayLike) -> NDArray[np.float64]: ...
    def _repr_svg_(self) -> str: ...
'''
_REGIONS = '''
class Regions:
    object: NDArray[np.int64]
    face: NDArray[np.int64]
    material: NDArray[np.int64]
    tone: NDArray[np.int64]
    area: NDArray[np.float64]
    loops: list[list[NDArray[np.float64]]]
    by: str
    lines: Lines
    size: tuple[int, int]
    def __len__(self) -> int: ...
    def polygons(
        self, units: Literal["pixels", "model"] = "pixels"
    ) -> list[tuple[NDArray[np.float64], list[NDArray[np.float64]]]]: ...
    def of_faces(self, values: ArrayLike | Sequence[ArrayLike]) -> NDArray[np.float64]: ...
    def json(self) -> str: ...
    def _repr_svg_(self) -> str: ...
'''
#: The methods with settings of each class, and the tables of these.
_METHODS = {
    "Lines": {"svg": "Lines.svg", "pdf": "Lines.svg", "png": "Lines.svg", "save": "Lines.svg", "layers": "Lines.svg", "regions": "Lines.regions"},
    "Regions": {"svg": "Lines.svg", "pdf": "Lines.svg", "save": "Lines.svg"},
}


def _literal(names):
    return "Literal[" + ", ".join(f'"{name}"' for name in names) + "]"


def _type(setting):
    names = setting["names"]
    return {
        "numbers": "_Number" if setting["count"] == 1 else "_Numbers",
        "choice": _literal(names) + (" | int" if any(name.isdigit() for name in names) else ""),
        "several": "str | Sequence[str]",
        "switch": "bool",
        "file": "_Path",
        "color": "_Color",
        "text": "_Text",
    }[setting["kind"]]


def _argument(parameter, function, settings):
    # Some of a function's own arguments are named like a setting.
    code = function.__code__
    is_own = parameter.name in code.co_varnames[: code.co_argcount + code.co_kwonlyargcount]
    names = _CHOICES.get(parameter.name)
    if not is_own:
        kind = f"{_type(settings[parameter.name])} | None"
    elif names:
        of_lines = function.__name__ != "render"
        kind = _literal(_native.names(("look of lines" if of_lines else "look of pictures") if names == "look" else names))
        kind += " | None" if parameter.default is None else ""
    else:
        of_setting = f"{_type(settings[parameter.name])} | None" if parameter.name in settings else "Any"
        kind = _ARGUMENTS.get(parameter.name, of_setting)
    default = "" if parameter.default is parameter.empty else f" = {_default(parameter.default)}"
    return f"    {parameter.name}: {kind}{default},\n"


def _default(value):
    return f'"{value}"' if isinstance(value, str) else repr(value)


def _signature(function, table, returns, is_method=False):
    text = f"def {function.__name__}(\n"
    is_keyword = False
    settings = {setting["name"]: setting for setting in _native.settings(table)}
    for parameter in inspect.signature(function).parameters.values():
        if parameter.name == "self":
            text += "    self,\n"
            continue
        if parameter.kind is parameter.KEYWORD_ONLY and not is_keyword:
            text += "    *,\n"
            is_keyword = True
        text += _argument(parameter, function, settings)
    text += f") -> {returns}: ...\n"
    return "".join(f"    {line}\n" for line in text.splitlines()) if is_method else text


def stubs():
    """The texts of the files by their modules' names."""
    methods = {
        owner: [
            _signature(getattr(getattr(tinta_npr, owner), name), table, _RETURNS[name], True)
            for name, table in tables.items()
        ]
        for owner, tables in _METHODS.items()
    }
    functions = [getattr(tinta_npr, name) for name in _native.names("function") if "." not in name]
    parts = [_HEAD.format(doc=tinta_npr.__doc__.splitlines()[0]), _CLASSES]
    parts += [*methods["Lines"], _REGIONS, *methods["Regions"]]
    parts += ["\n" + _signature(function, function.__name__, _RETURNS[function.__name__]) for function in functions]
    texts = {"__init__": "".join(parts)}
    for name, (head, returned) in _MODULES.items():
        module = getattr(tinta_npr, name)
        drawn = [_signature(getattr(module, function), "lines", returns) for function, returns in returned.items()]
        texts[name] = head.format(doc=module.__doc__.splitlines()[0]) + "\n".join(drawn)
    return texts


if __name__ == "__main__":
    for _module, _text in stubs().items():
        pathlib.Path(sys.argv[1], f"{_module}.pyi").write_text(_text)
