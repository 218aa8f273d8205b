from collections.abc import Callable, Mapping, Sequence
from os import PathLike
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

version: str

class Series:
    """Named columns over time.

    Parameters
    ----------
    time_s : (n,) array
        Strictly rising.
    columns : dict of (n,) arrays
        Names end in a unit: ``T_room_degC``, ``speed_rpm``, ``z_um``. NaN is a gap.
    roles : dict
        Of columns whose role is not the usual one of their unit: ``{"T_room_degC": "ambient"}``.
    started : str
        Wall clock at time 0, ``2026-11-22T13:05:10``.
    """

    def __init__(
        self,
        time_s: ArrayLike,
        columns: Mapping[str, ArrayLike],
        *,
        roles: Mapping[str, str] = ...,
        started: str | None = ...,
    ) -> None: ...
    @property
    def time_s(self) -> NDArray[np.float64]: ...
    @property
    def names(self) -> list[str]: ...
    @property
    def roles(self) -> dict[str, str]: ...
    @property
    def started(self) -> str | None: ...
    def __getitem__(self, name: str) -> NDArray[np.float64]: ...
    def __len__(self) -> int: ...
    def write(self, path: str | PathLike[str]) -> None: ...

class Recording:
    """One ballbar recording: lengths along a circle (with angles, from +A towards +B) or along a line (without)."""

    def __init__(
        self,
        length_mm: ArrayLike,
        angle_deg: ArrayLike | None = ...,
        *,
        time_s: ArrayLike | None = ...,
        plane: str = ...,
        direction: str = ...,
        motion: str = ...,
        nominal_length_mm: float = ...,
        height_offset_mm: float = ...,
        feed_mm_per_min: float | None = ...,
    ) -> None: ...
    @property
    def length_mm(self) -> NDArray[np.float64]: ...
    @property
    def angle_rad(self) -> NDArray[np.float64]: ...
    @property
    def time_s(self) -> NDArray[np.float64]: ...
    @property
    def plane(self) -> str: ...
    @property
    def direction(self) -> str: ...
    @property
    def motion(self) -> str: ...
    @property
    def nominal_length_mm(self) -> float: ...
    @property
    def height_offset_mm(self) -> float: ...
    @property
    def feed_mm_per_min(self) -> float | None: ...
    def __len__(self) -> int: ...

def read_series(path: str | PathLike[str]) -> Series: ...
def read_recordings(path: str | PathLike[str]) -> list[Recording]: ...
def run(
    words: Sequence[str], given: Mapping[str, Series | Sequence[Recording]], progress: Callable[[str], object] | None = ...
) -> tuple[Any, list[str]]: ...
def fit(recordings: Sequence[Recording], polar: bool, robust: bool) -> dict[str, Any]: ...
def add_effect(
    name: str,
    function: Callable[..., Any],
    *,
    inputs: Mapping[str, str | Sequence[str]],
    gains: Mapping[str, Mapping[str, Any]],
    shapes: Mapping[str, Mapping[str, Any]],
    explanation: Mapping[str, str],
) -> None: ...
def fleet(
    texts: Mapping[str, Sequence[str]],
    numbers: Mapping[str, ArrayLike],
    quantities: Sequence[tuple[str, str]],
    tolerances: Mapping[str, float],
    false_discovery_rate: float,
    title: str | None = ...,
) -> tuple[dict[str, Any], str, str]: ...
def picture(parts: str, conclusion: str) -> str: ...
