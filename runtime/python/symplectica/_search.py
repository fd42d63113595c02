"""Methods by design: a search whose results are proved."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import overload

from . import _native
from ._errors import ArgumentError
from ._tableau import Tableau


@dataclass(frozen=True)
class FoundMethod:
    """A method that a search found, and that is proved.

    Attributes
    ----------
    tableau : Tableau
        The exact method; its `definition` has a claim, which is proved again wherever the definition is used.
    error_constant : float
        C in the class of the search, from the exact coefficients.
    efficiency : float
        s C^(1/p): the force evaluations in a unit of time for an error of 1. Fewer are better.
    largest : float
        The largest absolute value of a coefficient.
    stable : float
        The end of the first interval of stable hω, divided by the kicks; 2 for Störmer–Verlet.
    found : int
        How many starts led to it.
    """

    tableau: Tableau
    error_constant: float
    efficiency: float
    largest: float
    stable: float
    found: int


@dataclass(frozen=True)
class Search(Sequence[FoundMethod]):
    """What a search found: a sequence of methods, the best first.

    Attributes
    ----------
    methods : tuple of FoundMethod
        The methods.
    starts, solutions : int
        Random starts, and how many of them led to solutions of the order conditions.
    conditions, unknowns : int
        The numbers of order conditions and of unknown coefficients.
    free : int or None
        The number of free parameters of the solutions; 0 if solutions are isolated, None if there are none.
    """

    methods: tuple[FoundMethod, ...]
    starts: int
    solutions: int
    conditions: int
    unknowns: int
    free: int | None

    @overload
    def __getitem__(self, index: int) -> FoundMethod: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[FoundMethod, ...]: ...
    def __getitem__(self, index: int | slice) -> FoundMethod | tuple[FoundMethod, ...]:
        return self.methods[index]

    def __len__(self) -> int:
        return len(self.methods)

    def __iter__(self) -> Iterator[FoundMethod]:
        return iter(self.methods)

    def __repr__(self) -> str:
        lines = [f"{self.starts} starts, {self.solutions} solutions of {self.conditions} conditions with {self.unknowns} unknowns"]
        lines += [
            f"{number}. efficiency {one.efficiency:.4f}, error constant {one.error_constant:.3e}, largest {one.largest:.3f}, "
            f"stable hω a kick {one.stable:.3f}"
            for number, one in enumerate(self.methods, 1)
        ]
        return "\n".join(lines)


def search(
    order: int | Sequence[int],
    kicks: int,
    hamiltonian: str = "separable",
    *,
    structure: str = "aba",
    minimise: str | None = None,
    dispersion: bool = False,
    at_least_stable: float = 0.0,
    largest: float = 1.0,
    tolerance: float = 1e-8,
    epsilon: float = 1e-2,
    starts: int | None = None,
    time: float | None = None,
    seed: int = 1,
    keep: int = 3,
    resume: str | Path | None = None,
    out: str | Path | None = None,
) -> Search:
    """Finds splittings and compositions of a class and an order, and proves them.

    Random starts are led to solutions of the order conditions, and these to minima of the error. The same seed and number of starts give
    the same methods.

    Parameters
    ----------
    order : int or sequence of int
        The order; for ``"perturbed"`` the orders in ε, ε², …, such as ``(8, 4)``.
    kicks : int
        Force evaluations a step; the steps of a composition.
    hamiltonian : str
        The class: ``"separable"``, ``"nystrom"`` for quadratic kinetic energy, ``"perturbed"`` for H_A + εH_B.
    structure : str
        ``"aba"`` or ``"bab"`` for palindromes that begin with a drift or a kick, ``"plain"`` without symmetry, ``"composition"`` of steps of
        Störmer–Verlet.
    minimise : str, optional
        ``"error"``, ``"modulo-conjugation"``, ``"long-runs"``, ``"perturbed"`` or ``"cost"``; see ``symplectic search --help``.
    dispersion : bool
        Whether the frequency of the harmonic oscillator has an error of higher order.
    at_least_stable : float
        The least end of the first interval of stable hω, divided by the kicks.
    largest : float
        The largest size of a coefficient, a soft bound.
    tolerance, epsilon : float
        The error of ``"cost"`` and the ε of ``"perturbed"``.
    starts : int, optional
        The number of random starts; without it the time decides.
    time : float, optional
        Seconds; 60 without `starts`.
    seed : int
        The seed of the random numbers.
    keep : int
        The number of methods that are proved.
    resume : path, optional
        A file with the state of the search, from which it goes on.
    out : path, optional
        A folder for the methods and their certificates.

    Returns
    -------
    Search

    Raises
    ------
    ArgumentError
        For options that do not go together.

    Examples
    --------
    >>> import symplectica as sy
    >>> found = sy.search(4, kicks=4, starts=64)
    >>> found[0].tableau.order("separable"), found[0].error_constant < 0.0077
    (4, True)
    >>> run = sy.system("q: [x], p: [y]; H = y^2/2 - cos(x)").integrate(0.1, 0, t=10, step=0.1, method=found[0].tableau)
    """
    orders = [order] if isinstance(order, int) else list(order)
    options = ["--order", ",".join(str(one) for one in orders), "--kicks", str(kicks), "--structure", structure]
    if structure != "composition" or hamiltonian != "separable":
        options += ["--class", hamiltonian]
    for name, value in [
        ("--minimise", minimise),
        ("--starts", starts),
        ("--resume", resume),
        ("--out", out),
        ("--at-least-stable", at_least_stable),
        ("--largest", largest),
        ("--tolerance", tolerance),
        ("--epsilon", epsilon),
        ("--seed", seed),
        ("--keep", keep),
    ]:
        if value is not None:
            options += [name, str(value)]
    if time is not None:
        if not time > 0:
            raise ArgumentError(f"`time` is {time}: it must be a positive number of seconds")
        options += ["--time", f"{time}s"]
    if dispersion:
        options.append("--dispersion")
    counts = _native.search(options)
    methods = tuple(
        FoundMethod(Tableau(native), error_constant, efficiency, size, stable, found)
        for native, error_constant, efficiency, size, stable, found in counts[-1]
    )
    return Search(methods, *counts[:-1])
