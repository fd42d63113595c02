"""Errors: the texts of the library, with fields."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ._run import Run


class SymplecticError(Exception):
    """Base class of the errors of this package.

    Attributes
    ----------
    message : str
        What is wrong, where, and what to do instead.
    """

    _fields: tuple[str, ...] = ()

    def __init__(self, message: str, **fields: Any) -> None:
        super().__init__(message)
        self.message = message
        for name in self._fields:
            setattr(self, name, fields.pop(name, None))
        if fields:
            raise TypeError(f"unknown fields {sorted(fields)}")

    def __reduce__(self) -> tuple[Any, ...]:
        fields = {name: getattr(self, name) for name in self._fields}
        return (_restored, (type(self), self.message, fields))


def _restored(kind: type[SymplecticError], message: str, fields: dict[str, Any]) -> SymplecticError:
    return kind(message, **fields)


class DefinitionError(SymplecticError, ValueError):
    """A definition of a method or a formula that is wrong.

    Attributes
    ----------
    reason : str
        What is wrong, without the place.
    input : str or None
        The part of the definition: ``basis``, ``nodes``, the name of a file.
    text : str or None
        The text of that part.
    span : (int, int) or None
        The wrong characters of `text`.
    """

    _fields = ("reason", "input", "text", "span")
    reason: str
    input: str | None
    text: str | None
    span: tuple[int, int] | None


class ArgumentError(SymplecticError, ValueError):
    """An argument that does not fit the formula or the method."""


class ProofError(SymplecticError, ValueError):
    """A required property that is refuted or not proved, or a file that does not match its exact method.

    Attributes
    ----------
    reason : str
        The witness.
    requirement : str or None
        The requirement.
    """

    _fields = ("reason", "requirement", "input", "text", "span")
    reason: str
    requirement: str | None
    input: str | None
    text: str | None
    span: tuple[int, int] | None


class StepError(SymplecticError, RuntimeError):
    """A step that failed.

    Attributes
    ----------
    kind : str
        ``not finite``, ``no convergence``, ``stagnation``, ``singular matrix``, ``event is NaN`` or ``other``.
    time : float or None
        The time at the start of the step.
    step : int or None
        The number of the step, from 1.
    step_size : float or None
        Its size.
    run : Run or None
        The run up to the last full step.
    """

    _fields = ("kind", "time", "step", "step_size", "run")
    kind: str
    time: float | None
    step: int | None
    step_size: float | None
    run: Run | None


class Interrupted(KeyboardInterrupt):
    """Ctrl-C during a run.

    Attributes
    ----------
    run : Run or Ensemble
        The result up to the last full step.
    """

    def __init__(self, run: Any) -> None:
        super().__init__("the run was interrupted; `run` of this exception has its states up to the last full step")
        self.run = run
