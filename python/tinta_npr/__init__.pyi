"""Exact visible lines and cartoons of meshes."""

from collections.abc import Mapping, Sequence
from os import PathLike
from typing import Any, Literal

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
    def svg(
        self,
        *,
        title: str | None = None,
        class_colors: _Text | None = None,
        line_width: _Number | None = None,
        hidden: Literal["none", "dashed", "ghost"] | str | None = None,
        class_widths: _Text | None = None,
        min_length: _Number | None = None,
        fit_curves: _Number | None = None,
        width_mm: _Number | None = None,
        dpi: _Number | None = None,
        page: _Text | None = None,
        margin: _Text | None = None,
        provenance: bool | None = None,
        pen: bool | None = None,
    ) -> str: ...
    def pdf(
        self,
        *,
        title: str | None = None,
        class_colors: _Text | None = None,
        line_width: _Number | None = None,
        hidden: Literal["none", "dashed", "ghost"] | str | None = None,
        class_widths: _Text | None = None,
        min_length: _Number | None = None,
        fit_curves: _Number | None = None,
        width_mm: _Number | None = None,
        dpi: _Number | None = None,
        page: _Text | None = None,
        margin: _Text | None = None,
        provenance: bool | None = None,
        pen: bool | None = None,
    ) -> bytes: ...
    def save(
        self,
        path: _Path,
        *,
        title: str | None = None,
        class_colors: _Text | None = None,
        line_width: _Number | None = None,
        hidden: Literal["none", "dashed", "ghost"] | str | None = None,
        class_widths: _Text | None = None,
        min_length: _Number | None = None,
        fit_curves: _Number | None = None,
        width_mm: _Number | None = None,
        dpi: _Number | None = None,
        page: _Text | None = None,
        margin: _Text | None = None,
        provenance: bool | None = None,
        pen: bool | None = None,
    ) -> None: ...
    def layers(
        self,
        *,
        class_colors: _Text | None = None,
        line_width: _Number | None = None,
        hidden: Literal["none", "dashed", "ghost"] | str | None = None,
        class_widths: _Text | None = None,
        min_length: _Number | None = None,
        fit_curves: _Number | None = None,
        width_mm: _Number | None = None,
        dpi: _Number | None = None,
        page: _Text | None = None,
        margin: _Text | None = None,
        provenance: bool | None = None,
        pen: bool | None = None,
    ) -> list[dict[str, Any]]: ...

def lines(
    mesh: Any,
    faces: ArrayLike | Sequence[Sequence[int]] | None = None,
    *,
    camera: _Camera | None = None,
    look: Literal["print", "technical", "charcoal", "published"] | None = None,
    preset: _Path | None = None,
    name: str | None = None,
    classes: str | Sequence[str] | None = None,
    crease_angle: _Number | None = None,
    lasting_creases: bool | None = None,
    silhouette: Literal["exact", "smooth"] | str | None = None,
    suggestive_threshold: _Number | None = None,
    ridge_threshold: _Number | None = None,
    apparent_ridge_threshold: _Number | None = None,
    surface_crease_angle: _Number | None = None,
    curvature_smoothing: _Number | None = None,
    class_colors: _Text | None = None,
    line_width: _Number | None = None,
    hidden: Literal["none", "dashed", "ghost"] | str | None = None,
    class_widths: _Text | None = None,
    min_length: _Number | None = None,
    fit_curves: _Number | None = None,
    width_mm: _Number | None = None,
    dpi: _Number | None = None,
    page: _Text | None = None,
    margin: _Text | None = None,
    provenance: bool | None = None,
    pen: bool | None = None,
    size: _Text | None = None,
    background: _Color | None = None,
    transparent: bool | None = None,
    color: _Color | None = None,
    bare_color: _Color | None = None,
    surface: Literal["plain", "textured"] | str | None = None,
    copies: _Number | None = None,
    view: _Text | None = None,
    fov: _Number | None = None,
    parallel: bool | None = None,
    framing: Literal["middle", "outline"] | str | None = None,
    height: _Number | None = None,
    eye: _Numbers | None = None,
    target: _Numbers | None = None,
    up: _Numbers | None = None,
    near: _Number | None = None,
    far: _Number | None = None,
    up_axis: Literal["auto", "x", "y", "z", "-x", "-y", "-z"] | str | None = None,
    weld: _Number | None = None,
    normals: Literal["file", "smooth", "lasting", "flat", "dachsbacher"] | str | None = None,
    smooth_angle: _Number | None = None,
    strict: bool | None = None,
    skin: _Path | None = None,
    allow_external: bool | None = None,
    model_frame: _Text | None = None,
) -> Lines: ...

def render(
    mesh: Any,
    faces: ArrayLike | Sequence[Sequence[int]] | None = None,
    *,
    style: Literal["phong", "three-pass", "two-pass", "mrt", "inking", "dietrich", "ink", "charcoal", "sand", "suggestive"] | None = None,
    look: Literal["print", "technical", "charcoal", "published"] | None = None,
    preset: _Path | None = None,
    camera: _Camera | None = None,
    show: Literal["final", "normals", "depth", "map", "borders", "tones", "diffuse", "cem", "cet", "paper"] | None = None,
    backend: Literal["auto", "egl", "surfaceless", "osmesa", "wgl", "cgl"] | None = None,
    name: str | None = None,
    no_borders: bool | None = None,
    cull: Literal["none", "back"] | str | None = None,
    supersample: Literal["1", "2", "3", "4"] | str | None = None,
    tones: _Number | None = None,
    tone_thresholds: _Numbers | None = None,
    tone_levels: _Numbers | None = None,
    tone_lookup: Literal["steps", "texture"] | str | None = None,
    filter: Literal["laplacian4", "laplacian8", "mitchell", "mitchell-two", "sobel", "roberts", "gaussian"] | str | None = None,
    detection_factor: _Number | None = None,
    slope_threshold: bool | None = None,
    background_quad: bool | None = None,
    map_encoding: Literal["paper", "biased", "float16", "float", "depth-texture"] | str | None = None,
    crease_angle: _Number | None = None,
    silhouette: Literal["paper", "exact", "smooth"] | str | None = None,
    classes: str | Sequence[str] | None = None,
    class_colors: _Text | None = None,
    line_width: _Number | None = None,
    smooth: bool | None = None,
    joints: bool | None = None,
    back_edges: bool | None = None,
    line_drawing: Literal["gl", "quads"] | str | None = None,
    ink_depth: Literal["test", "write"] | str | None = None,
    polygon_offset: _Numbers | None = None,
    paint: Literal["none", "flat", "ramp", "flat-shaded", "gouraud"] | str | None = None,
    ramp: _Path | None = None,
    ramp_row: Literal["material", "object", "own", "0", "1", "2", "3"] | str | None = None,
    light: Literal["cpu", "vertex-shader"] | str | None = None,
    texture: bool | None = None,
    ink_threshold: _Number | None = None,
    ink_color: _Color | None = None,
    border_width: _Text | None = None,
    map_target: Literal["copy", "texture"] | str | None = None,
    inner_width: _Text | None = None,
    crease_by: Literal["planes", "normals"] | str | None = None,
    remove_specks: bool | None = None,
    quality: Literal["standard", "best"] | str | None = None,
    tone_light: _Numbers | None = None,
    least_gap: _Number | None = None,
    gap_per_slope: _Number | None = None,
    valley_radius: _Number | None = None,
    valley_share: _Number | None = None,
    valley_depth: _Number | None = None,
    charcoal: Literal["plain", "darker", "closure"] | str | None = None,
    seed: _Number | None = None,
    random: Literal["splitmix", "msvc", "glibc"] | str | None = None,
    density: _Number | None = None,
    cet_exponent: _Number | None = None,
    cet_blur: _Number | None = None,
    contrast_exponent: _Number | None = None,
    saturation: _Number | None = None,
    smudge: bool | None = None,
    light_1: _Numbers | None = None,
    light_2: _Numbers | None = None,
    cet: _Path | None = None,
    noise_texture: _Path | None = None,
    paper: _Path | None = None,
    texture_size: _Text | None = None,
    cet_filter: Literal["linear", "mipmap"] | str | None = None,
    cet_coordinate: Literal["original", "saturated"] | str | None = None,
    contrast_operator: Literal["power", "sigmoid", "bias"] | str | None = None,
    noise: Literal["screen", "object"] | str | None = None,
    improve: str | Sequence[str] | None = None,
    ambient: _Number | None = None,
    specular: _Number | None = None,
    shininess: _Number | None = None,
    size: _Text | None = None,
    background: _Color | None = None,
    transparent: bool | None = None,
    color: _Color | None = None,
    bare_color: _Color | None = None,
    surface: Literal["plain", "textured"] | str | None = None,
    copies: _Number | None = None,
    view: _Text | None = None,
    fov: _Number | None = None,
    parallel: bool | None = None,
    framing: Literal["middle", "outline"] | str | None = None,
    height: _Number | None = None,
    eye: _Numbers | None = None,
    target: _Numbers | None = None,
    up: _Numbers | None = None,
    near: _Number | None = None,
    far: _Number | None = None,
    up_axis: Literal["auto", "x", "y", "z", "-x", "-y", "-z"] | str | None = None,
    weld: _Number | None = None,
    normals: Literal["file", "smooth", "lasting", "flat", "dachsbacher"] | str | None = None,
    smooth_angle: _Number | None = None,
    strict: bool | None = None,
    skin: _Path | None = None,
    allow_external: bool | None = None,
    model_frame: _Text | None = None,
) -> Picture: ...

def mesh(
    mesh: Any,
    faces: ArrayLike | Sequence[Sequence[int]] | None = None,
    *,
    name: str | None = None,
    up_axis: Literal["auto", "x", "y", "z", "-x", "-y", "-z"] | str | None = None,
    weld: _Number | None = None,
    normals: Literal["file", "smooth", "lasting", "flat", "dachsbacher"] | str | None = None,
    smooth_angle: _Number | None = None,
    strict: bool | None = None,
    skin: _Path | None = None,
    allow_external: bool | None = None,
    model_frame: _Text | None = None,
) -> Mesh: ...

def edges(
    mesh: Any,
    faces: ArrayLike | Sequence[Sequence[int]] | None = None,
    *,
    name: str | None = None,
    classes: str | Sequence[str] | None = None,
    crease_angle: _Number | None = None,
    lasting_creases: bool | None = None,
    silhouette: Literal["exact", "smooth"] | str | None = None,
    suggestive_threshold: _Number | None = None,
    ridge_threshold: _Number | None = None,
    apparent_ridge_threshold: _Number | None = None,
    surface_crease_angle: _Number | None = None,
    curvature_smoothing: _Number | None = None,
    up_axis: Literal["auto", "x", "y", "z", "-x", "-y", "-z"] | str | None = None,
    weld: _Number | None = None,
    normals: Literal["file", "smooth", "lasting", "flat", "dachsbacher"] | str | None = None,
    smooth_angle: _Number | None = None,
    strict: bool | None = None,
    skin: _Path | None = None,
    allow_external: bool | None = None,
    model_frame: _Text | None = None,
) -> Edges: ...

def silhouette(
    mesh: Any,
    eye: ArrayLike,
    faces: ArrayLike | Sequence[Sequence[int]] | None = None,
    *,
    direction: bool = False,
    name: str | None = None,
    up_axis: Literal["auto", "x", "y", "z", "-x", "-y", "-z"] | str | None = None,
    weld: _Number | None = None,
    normals: Literal["file", "smooth", "lasting", "flat", "dachsbacher"] | str | None = None,
    smooth_angle: _Number | None = None,
    strict: bool | None = None,
    skin: _Path | None = None,
    allow_external: bool | None = None,
    model_frame: _Text | None = None,
) -> NDArray[np.uint32]: ...

def measure(
    mesh: Any,
    faces: ArrayLike | Sequence[Sequence[int]] | None = None,
    *,
    styles: Sequence[str | Mapping[str, Any]] = (),
    frames: int = 21,
    tolerance: float = 2.0,
    camera: _Camera | None = None,
    backend: Literal["auto", "egl", "surfaceless", "osmesa", "wgl", "cgl"] | None = None,
    name: str | None = None,
    size: _Text | None = None,
    background: _Color | None = None,
    transparent: bool | None = None,
    color: _Color | None = None,
    bare_color: _Color | None = None,
    surface: Literal["plain", "textured"] | str | None = None,
    copies: _Number | None = None,
    view: _Text | None = None,
    fov: _Number | None = None,
    parallel: bool | None = None,
    framing: Literal["middle", "outline"] | str | None = None,
    height: _Number | None = None,
    eye: _Numbers | None = None,
    target: _Numbers | None = None,
    up: _Numbers | None = None,
    near: _Number | None = None,
    far: _Number | None = None,
    up_axis: Literal["auto", "x", "y", "z", "-x", "-y", "-z"] | str | None = None,
    weld: _Number | None = None,
    normals: Literal["file", "smooth", "lasting", "flat", "dachsbacher"] | str | None = None,
    smooth_angle: _Number | None = None,
    strict: bool | None = None,
    skin: _Path | None = None,
    allow_external: bool | None = None,
    model_frame: _Text | None = None,
) -> list[dict[str, Any]]: ...

def compare(
    mesh: Any,
    faces: ArrayLike | Sequence[Sequence[int]] | None = None,
    *,
    left: Literal["phong", "three-pass", "two-pass", "mrt", "inking", "dietrich", "ink", "charcoal", "sand", "suggestive"] = "three-pass",
    right: Literal["phong", "three-pass", "two-pass", "mrt", "inking", "dietrich", "ink", "charcoal", "sand", "suggestive"] = "inking",
    tolerance: float = 2,
    camera: _Camera | None = None,
    backend: Literal["auto", "egl", "surfaceless", "osmesa", "wgl", "cgl"] | None = None,
    name: str | None = None,
    no_borders: bool | None = None,
    cull: Literal["none", "back"] | str | None = None,
    supersample: Literal["1", "2", "3", "4"] | str | None = None,
    tones: _Number | None = None,
    tone_thresholds: _Numbers | None = None,
    tone_levels: _Numbers | None = None,
    tone_lookup: Literal["steps", "texture"] | str | None = None,
    filter: Literal["laplacian4", "laplacian8", "mitchell", "mitchell-two", "sobel", "roberts", "gaussian"] | str | None = None,
    detection_factor: _Number | None = None,
    slope_threshold: bool | None = None,
    background_quad: bool | None = None,
    map_encoding: Literal["paper", "biased", "float16", "float", "depth-texture"] | str | None = None,
    crease_angle: _Number | None = None,
    silhouette: Literal["paper", "exact", "smooth"] | str | None = None,
    classes: str | Sequence[str] | None = None,
    class_colors: _Text | None = None,
    line_width: _Number | None = None,
    smooth: bool | None = None,
    joints: bool | None = None,
    back_edges: bool | None = None,
    line_drawing: Literal["gl", "quads"] | str | None = None,
    ink_depth: Literal["test", "write"] | str | None = None,
    polygon_offset: _Numbers | None = None,
    paint: Literal["none", "flat", "ramp", "flat-shaded", "gouraud"] | str | None = None,
    ramp: _Path | None = None,
    ramp_row: Literal["material", "object", "own", "0", "1", "2", "3"] | str | None = None,
    light: Literal["cpu", "vertex-shader"] | str | None = None,
    texture: bool | None = None,
    ink_threshold: _Number | None = None,
    ink_color: _Color | None = None,
    border_width: _Text | None = None,
    map_target: Literal["copy", "texture"] | str | None = None,
    inner_width: _Text | None = None,
    crease_by: Literal["planes", "normals"] | str | None = None,
    remove_specks: bool | None = None,
    quality: Literal["standard", "best"] | str | None = None,
    tone_light: _Numbers | None = None,
    least_gap: _Number | None = None,
    gap_per_slope: _Number | None = None,
    valley_radius: _Number | None = None,
    valley_share: _Number | None = None,
    valley_depth: _Number | None = None,
    charcoal: Literal["plain", "darker", "closure"] | str | None = None,
    seed: _Number | None = None,
    random: Literal["splitmix", "msvc", "glibc"] | str | None = None,
    density: _Number | None = None,
    cet_exponent: _Number | None = None,
    cet_blur: _Number | None = None,
    contrast_exponent: _Number | None = None,
    saturation: _Number | None = None,
    smudge: bool | None = None,
    light_1: _Numbers | None = None,
    light_2: _Numbers | None = None,
    cet: _Path | None = None,
    noise_texture: _Path | None = None,
    paper: _Path | None = None,
    texture_size: _Text | None = None,
    cet_filter: Literal["linear", "mipmap"] | str | None = None,
    cet_coordinate: Literal["original", "saturated"] | str | None = None,
    contrast_operator: Literal["power", "sigmoid", "bias"] | str | None = None,
    noise: Literal["screen", "object"] | str | None = None,
    improve: str | Sequence[str] | None = None,
    ambient: _Number | None = None,
    specular: _Number | None = None,
    shininess: _Number | None = None,
    size: _Text | None = None,
    background: _Color | None = None,
    transparent: bool | None = None,
    color: _Color | None = None,
    bare_color: _Color | None = None,
    surface: Literal["plain", "textured"] | str | None = None,
    copies: _Number | None = None,
    view: _Text | None = None,
    fov: _Number | None = None,
    parallel: bool | None = None,
    framing: Literal["middle", "outline"] | str | None = None,
    height: _Number | None = None,
    eye: _Numbers | None = None,
    target: _Numbers | None = None,
    up: _Numbers | None = None,
    near: _Number | None = None,
    far: _Number | None = None,
    up_axis: Literal["auto", "x", "y", "z", "-x", "-y", "-z"] | str | None = None,
    weld: _Number | None = None,
    normals: Literal["file", "smooth", "lasting", "flat", "dachsbacher"] | str | None = None,
    smooth_angle: _Number | None = None,
    strict: bool | None = None,
    skin: _Path | None = None,
    allow_external: bool | None = None,
    model_frame: _Text | None = None,
) -> Comparison: ...
