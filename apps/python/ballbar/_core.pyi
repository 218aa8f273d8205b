from collections.abc import Callable, Iterator, Mapping, Sequence
from os import PathLike
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

version: str

class Series:
    def __init__(
        self,
        time_s: ArrayLike,
        columns: Mapping[str, ArrayLike],
        *,
        roles: Mapping[str, str] = ...,
        started: str | None = ...,
        five_probe: Mapping[str, Any] | None = ...,
    ) -> None: ...
    @property
    def five_probe(self) -> dict[str, Any] | None: ...
    @property
    def time_s(self) -> NDArray[np.float64]: ...
    @property
    def names(self) -> list[str]: ...
    @property
    def roles(self) -> dict[str, str]: ...
    @property
    def units(self) -> dict[str, str]: ...
    @property
    def started(self) -> str | None: ...
    def __getitem__(self, name: str) -> NDArray[np.float64]: ...
    def __contains__(self, name: object) -> bool: ...
    def __iter__(self) -> Iterator[str]: ...
    def __len__(self) -> int: ...
    def write(self, path: str | PathLike[str]) -> None: ...

class Recording:
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

class Effect: ...
class Bench: ...

def read_series(path: str | PathLike[str]) -> Series: ...
def read_recordings(path: str | PathLike[str]) -> list[Recording]: ...
def call(
    command: str,
    places: Sequence[str],
    options: Sequence[tuple[str, bool | Sequence[str]]],
    data: Mapping[str, Series | Sequence[Recording] | str],
    effects: Sequence[Effect],
    progress: Callable[[str], object] | None = ...,
) -> tuple[Any, list[str], list[str]]: ...
def bench(
    places: Sequence[str],
    held: Mapping[str, Series | Sequence[Recording] | str],
    model: str,
    effects: Sequence[Effect],
    *,
    target: Sequence[str],
    also_input: Sequence[str],
    set: Sequence[str],
    max_gap_s: float | None,
    robust: bool,
    white: bool,
    progress: Callable[[str], object] | None = ...,
) -> tuple[Any, list[str]]: ...
def model_text(text: str, name: str, effects: Sequence[Effect]) -> str: ...
def model_of_effect(text: str, of_recordings: bool, effects: Sequence[Effect]) -> str: ...
def fit(recordings: Sequence[Recording], polar: bool, robust: bool) -> dict[str, Any]: ...
def numbers(data: ArrayLike, name: str) -> NDArray[np.float64]: ...
def effect(
    name: str,
    function: Callable[..., Any],
    *,
    inputs: Mapping[str, str | Sequence[str]],
    gains: Mapping[str, Mapping[str, Any]],
    shapes: Mapping[str, Mapping[str, Any]],
    explanation: Mapping[str, str],
) -> Effect: ...
def tests(files: Sequence[str]) -> dict[str, Any]: ...
def fleet(
    texts: Mapping[str, Sequence[str]],
    numbers: Mapping[str, ArrayLike],
    quantities: Sequence[tuple[str, str]],
    tolerances: Mapping[str, float],
    false_discovery_rate: float,
    title: str | None = ...,
    remarks: Sequence[str] = ...,
) -> tuple[dict[str, Any], str, str]: ...
