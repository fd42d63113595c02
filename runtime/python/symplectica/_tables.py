"""Tables of others: audits, imports, printed digits."""

from __future__ import annotations

import json
import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _arrays, _native
from ._errors import ArgumentError
from ._exact import Exact, words
from ._paths import read_text
from ._tableau import CLASSES, Doubles, Tableau


@dataclass(frozen=True)
class Audit:
    """The exact method behind a table, and what is proved about it.

    Attributes
    ----------
    tableau : Tableau
        The exact method: the numbers themselves if they are exact, or the method that is proved to be near rounded decimals.
    note : str or None
        How the method differs from the numbers; None if the numbers are exact.
    """

    tableau: Tableau
    note: str | None

    def __repr__(self) -> str:
        orders = ", ".join(f"{kind} {self.tableau.order(kind)}" for kind in CLASSES)
        lines = [f"{self.tableau.stages} stages, proved order {orders}"]
        lines += [f"{name}: {found}" for name, found in self.tableau.properties.items() if name in ("symplectic", "symmetric", "consistent")]
        return "\n".join(lines + ([self.note] if self.note else []))


def _printed(values: Any, key: str) -> str:
    """Numbers as they are printed: doubles with the digits that identify them."""
    if isinstance(values, np.ndarray):
        values = values.tolist()
    if isinstance(values, (list, tuple)):
        return "[" + ", ".join(_printed(value, key) for value in values) + "]"
    if isinstance(values, float):
        if not np.isfinite(values):
            raise ArgumentError(f"`{key}` contains {values}: coefficients must be finite")
        return repr(values)
    return words(values, key)


def audit(
    a: Exact | Doubles | str | Path,
    b: npt.ArrayLike | Exact | None = None,
    a_tilde: npt.ArrayLike | Exact | None = None,
    b_tilde: npt.ArrayLike | Exact | None = None,
) -> Audit | list[dict[str, Any]]:
    """Finds the exact method behind a table of numbers and proves its order and properties; or audits a file of tables with claims.

    Parameters
    ----------
    a, b : array_like
        The table, doubles or exact numbers, shapes (s, s) and (s,). Instead a :class:`Doubles`, or the path of a file as for
        ``symplectic audit``: then the result is a list with a dictionary for each table.
    a_tilde, b_tilde : array_like, optional
        The coefficients of the momenta.

    Examples
    --------
    >>> import symplectica as sy
    >>> found = sy.audit([[0.25, -0.0386751345948], [0.538675134595, 0.25]], [0.5, 0.5])
    >>> found.tableau.order(), found.tableau.exact["a"][0][1]
    (4, '1/4 - sqrt(3)/6')
    """
    if isinstance(a, Doubles):
        made = a
        a, b, a_tilde, b_tilde = made.a, made.b, made.a_tilde, made.b_tilde
    if isinstance(a, (str, Path)) and b is None:
        rows: list[dict[str, Any]] = json.loads(_native.audit(str(a), read_text(a)))["rows"]
        return rows
    if b is None:
        raise ArgumentError("give the weights `b` with the matrix `a`")
    lists = {"a": a, "b": b, "a_tilde": a_tilde, "b_tilde": b_tilde}
    text = "\n".join(f"{key} = {_printed(value, key)}" for key, value in lists.items() if value is not None)
    tableau, note = _native.import_table("nodepy", "the table", text)
    return Audit(Tableau(tableau), note)


def import_table(path: str | Path, library: str) -> Tableau:
    """A table of another library, by that library's convention: see ``symplectic import``.

    Warns if the coefficients are those of an exact method near rounded decimals.

    Parameters
    ----------
    path : str or Path
        A file with one table, in the language of the library.
    library : str
        ``sciml``, ``sundials``, ``petsc``, ``rungekutta.jl``, ``odeint``, ``nodepy``, ``mathematica``, ``principia``, ``rebound``, …
    """
    tableau, note = _native.import_table(library, str(path), read_text(path))
    if note:
        warnings.warn(note, stacklevel=2)
    return Tableau(tableau)


@dataclass(frozen=True)
class Refinement:
    """An exact method that is proved to be near printed digits.

    Attributes
    ----------
    text : str
        Its coefficients with the wanted digits, and what is proved.
    facts : dict
        The same for programs.
    """

    text: str
    facts: dict[str, Any]

    def __repr__(self) -> str:
        return self.text


def refine(
    kick: Exact | str | Path,
    drift: Exact | None = None,
    *,
    order: int | None = None,
    kind: str = "separable",
    perturbed: list[int] | None = None,
    weights: Exact | None = None,
    name: str = "printed digits",
    digits: int = 40,
    nearest: bool = False,
) -> Refinement:
    """Proves that an exact method exists near printed coefficients, and prints it to any number of digits.

    Parameters
    ----------
    kick, drift : list of str
        The printed digits, as texts: floats have lost them. Instead of `kick` the path of a file as for ``symplectic refine``.
    order : int
        The claimed order.
    kind : str
        ``separable`` or ``nystrom``.
    perturbed : list of int, optional
        The claimed orders for perturbed systems, instead of `order`.
    weights : list of str, optional
        The printed weights of a composition instead of kicks and drifts: ``refine(None, weights=[…], order=8)``.
    digits : int
        Significant digits of the result.
    nearest : bool
        Accept the solution that is found, however far it is from the digits.

    Raises
    ------
    ProofError
        If no exact method rounds to the digits.

    Examples
    --------
    >>> import symplectica as sy
    >>> found = sy.refine(["0.2916667", "3/4", "-0.0416667"], ["0.6666667", "-0.6666667", "1"], order=3)
    >>> "0.29166666666666666666" in found.text
    True
    """
    if isinstance(kick, (str, Path)):
        text, name = read_text(kick), str(kick)
    else:
        printed = {"kick": kick, "drift": drift} if weights is None else {"weights": weights}
        lines = [f"name = {json.dumps(name)}", "[claim]"]
        if perturbed is not None:
            lines.append(f"perturbed = {[int(number) for number in perturbed]}")
        elif order is not None:
            lines.append(f"order = {int(order)}")
            if weights is None:
                lines.append(f"class = {json.dumps(kind)}")
        else:
            raise ArgumentError("give the claimed `order`, or `perturbed` orders")
        lines.append("[printed]")
        for key, values in printed.items():
            if not isinstance(values, (list, tuple, np.ndarray)):
                raise ArgumentError(f"`{key}` must be the list of the printed numbers, as texts")
            lines.append(f"{key} = [" + ", ".join(json.dumps(words(value, key)) for value in values) + "]")
        text = "\n".join(lines) + "\n"
    digits = _arrays.count(digits, "digits", 1, 10_000)
    shown = _native.refine(name, text, digits, False, nearest)
    facts: dict[str, Any] = json.loads(_native.refine(name, text, digits, True, nearest))
    return Refinement(shown, facts)
