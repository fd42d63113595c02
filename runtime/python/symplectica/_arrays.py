"""States as arrays: shapes, and parameters that vary between trajectories."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from ._errors import ArgumentError

Array = npt.NDArray[np.float64]


def numbers(value: Any, key: str) -> Array:
    """An array of finite doubles: a copy that nobody changes."""
    try:
        array = np.array(value, dtype=np.float64, order="C")
    except (TypeError, ValueError):
        raise ArgumentError(f"`{key}`: expected numbers, found {_found(value)}") from None
    if not np.isfinite(array).all():
        raise ArgumentError(f"`{key}` contains a number that is not finite")
    array.flags.writeable = False
    return array


def number(value: Any, key: str) -> float:
    """A finite double."""
    array = numbers(value, key)
    if array.ndim != 0:
        raise ArgumentError(f"`{key}` must be one number; it has the shape {array.shape}")
    return float(array)


def count(value: Any, key: str, least: int = 0, most: int = 10**9) -> int:
    """A whole number."""
    try:
        whole = int(value)
    except (TypeError, ValueError, OverflowError):
        whole = least - 1
    if not least <= whole <= most or isinstance(value, bool) or whole != value:
        raise ArgumentError(f"`{key}` must be a whole number from {least} to {most}, found {_found(value)}")
    return whole


def _found(value: Any) -> str:
    text = repr(value)
    return text if len(text) <= 60 else f"{type(value).__name__}"


def rows(array: Array, width: int) -> Array:
    """An array as contiguous rows."""
    return np.ascontiguousarray(array.reshape(-1, width))


#: The values of parameters by name.
Parameters = Mapping[str, Any]


def named(parameters: Any) -> dict[str, Any]:
    """Parameters as a dictionary."""
    if parameters is None:
        return {}
    if not isinstance(parameters, Mapping):
        raise ArgumentError(f"`parameters` must be a dictionary with the values by name, found {_found(parameters)}")
    return {str(name): value for name, value in parameters.items()}


def check_names(parameters: Parameters, known: list[tuple[str, list[str], str | None]]) -> None:
    """Checks that the formula has parameters of these names."""
    names = [name for name, *_ in known]
    for name in parameters:
        if name not in names:
            there = f"the parameters are {', '.join(names)}" if names else "the formula has none"
            raise ArgumentError(f"there is no parameter `{name}`; {there}")


def split(parameters: Parameters, known: list[tuple[str, list[str], str | None]], trajectories: int) -> tuple[dict[str, Array], dict[str, Array]]:
    """Parameters that are the same for all trajectories, and those with a value for each."""
    check_names(parameters, known)
    depth = {name: len(lengths) for name, lengths, _ in known}
    same, varied = {}, {}
    for name, value in parameters.items():
        array = numbers(value, name)
        if array.ndim == depth[name] + 1:
            if array.shape[0] != trajectories:
                raise ArgumentError(f"`{name}` has values for {array.shape[0]} trajectories; there are {trajectories}")
            varied[name] = array
        else:
            same[name] = array
    return same, varied
