"""Events: zeros of expressions along a trajectory."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from . import _arrays
from ._arrays import Array
from ._errors import ArgumentError


@dataclass(frozen=True)
class Event:
    """A zero of an expression along a trajectory.

    Parameters
    ----------
    of : str
        An expression with the names of the formula, such as ``"q[1]"``, ``"x - 1"``, ``"q·p"``, ``"t - 10"``.
    direction : str
        ``rising``, ``falling`` or ``both``.
    terminal : bool or int
        End the run at the event, or at this occurrence of it.
    wall : bool
        The trajectory stays at ``of >= 0``: an event is a fall to zero, and the run continues from there, after `set`.
    set : dict
        New values of coordinates at the event, from the state before: ``{"py": "-0.8 py"}``.
    samples : int, optional
        Evaluate the expression at this number of points in every step, at most 10 000, if it varies much faster than the motion.

    Notes
    -----
    A zero is located by steps of the method, so its state has the order of the method.

    Examples
    --------
    A ball that bounces:

    >>> import symplectica as sy
    >>> ball = sy.system("q: [y], p: [py]; H = py^2/2 + 9.81 y")
    >>> floor = sy.Event("y", wall=True, set={"py": "-0.8 py"})
    >>> run = ball.integrate([1.0], [0.0], t=2, step=0.01, method="stormer-verlet", events=floor)
    >>> run.events[0].t.round(4).tolist()
    [0.4515, 1.174, 1.7519]
    """

    of: str
    direction: str = "both"
    terminal: bool | int = False
    wall: bool = False
    set: Mapping[str, str] = field(default_factory=dict)
    samples: int | None = None

    def _native(self) -> tuple[str, str, bool, int | None, list[tuple[str, str]], int | None]:
        if not isinstance(self.of, str):
            raise ArgumentError(f"an event is an expression in text, found {type(self.of).__name__}")
        last = None
        if self.terminal is not False:
            last = 1 if self.terminal is True else _arrays.count(self.terminal, "terminal", 1)
        samples = None if self.samples is None else _arrays.count(self.samples, "samples", 1, 10_000)
        changes = [(str(name), str(value)) for name, value in self.set.items()]
        return (self.of, str(self.direction), bool(self.wall), samples, changes, last)


@dataclass(frozen=True, eq=False)
class States:
    """States at events, or of a section.

    Attributes
    ----------
    t : ndarray, shape (n,)
        Times.
    q, p : ndarray, shape (n, …)
        Positions and momenta.
    """

    t: Array
    q: Array
    p: Array

    def __len__(self) -> int:
        return len(self.t)


class Events(Mapping[Any, States]):
    """The states at events: by name if the events have names, otherwise by number; in both cases also by expression."""

    def __init__(self, names: list[Any], found: list[States], texts: list[str]) -> None:
        self._names, self._found, self._texts = names, found, texts

    def __getitem__(self, name: Any) -> States:
        for known in (self._names, self._texts):
            if name in known:
                return self._found[known.index(name)]
        raise KeyError(f"there is no event {name!r}; the events are {', '.join(map(repr, self._names)) or 'none'}")

    def __iter__(self) -> Any:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    def __repr__(self) -> str:
        counts = ", ".join(f"{name!r}: {len(states)}" for name, states in self.items())
        return f"<Events {{{counts}}}>"


#: Events as a caller gives them.
Given = Event | str | Sequence[Event | str] | Mapping[str, Event | str] | None


def events_of(given: Given, direction: str = "both") -> tuple[list[Any], list[Any]]:
    """The names of events and their native form."""

    def event(one: Any) -> Event:
        if isinstance(one, Event):
            return one
        if isinstance(one, str):
            return Event(one, direction=direction)
        raise ArgumentError(f"an event is an expression in text or an `Event`, found {type(one).__name__}")

    if given is None:
        return [], []
    if isinstance(given, (Event, str)):
        given = [given]
    if not isinstance(given, (Mapping, Sequence)):
        raise ArgumentError(f"events are an expression in text, an `Event`, or a list or dict of these, found {type(given).__name__}")
    if isinstance(given, Mapping):
        return list(given), [event(one)._native() for one in given.values()]
    return list(range(len(given))), [event(one)._native() for one in given]
