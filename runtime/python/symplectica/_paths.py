"""Texts of files."""

from __future__ import annotations

from pathlib import Path

from ._errors import ArgumentError


def read_text(path: str | Path) -> str:
    """The text of a file.

    Raises
    ------
    ArgumentError
        If it cannot be read.
    """
    try:
        return Path(path).read_text(encoding="utf-8-sig")
    except UnicodeDecodeError:
        raise ArgumentError(f"`{path}` is not a text in UTF-8") from None
    except (OSError, ValueError) as error:
        raise ArgumentError(f"cannot read `{path}`: {getattr(error, 'strerror', None) or error}") from None
