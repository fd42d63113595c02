"""In place of ``scipy.integrate.solve_ivp``."""

from __future__ import annotations

from typing import Any


def solve_ivp(*arguments: Any, **keywords: Any) -> Any:
    """To be written."""
    raise NotImplementedError
