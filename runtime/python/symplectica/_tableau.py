"""Methods: derived tableaux with their proofs, and methods of doubles."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from fractions import Fraction
from functools import cached_property, lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _arrays, _native
from ._errors import ArgumentError, DefinitionError
from ._exact import Exact, fraction, to_sympy, unbracketed, words
from ._paths import read_text

if TYPE_CHECKING:
    from ._system import System

Array = npt.NDArray[np.float64]

#: The classes of Hamiltonians: every H(q, p), T(p) + U(q), and T quadratic in p.
CLASSES = ("general", "separable", "nystrom")


@dataclass(frozen=True)
class Property:
    """A property of a method with its evidence; true if it holds.

    Attributes
    ----------
    holds : bool
        Whether it holds.
    evidence : str
        ``proved``, ``refuted``, ``verified`` (by intervals, to `bits` binary places), ``certified`` or ``undecided``.
    bits : int or None
        The binary places of a verification.
    witness : str or None
        Why it does not hold.
    """

    holds: bool
    evidence: str
    bits: int | None
    witness: str | None

    def __bool__(self) -> bool:
        return self.holds

    def __str__(self) -> str:
        how = self.evidence if self.bits is None else f"{self.evidence} to 2^-{self.bits}"
        why = f": {self.witness}" if self.witness else ""
        return f"{'yes' if self.holds else 'no'}, {how}{why}"


class Properties(Mapping[str, Property]):
    """Properties of a method by name."""

    def __init__(self, found: dict[str, Property]) -> None:
        self._found = found

    def __getitem__(self, name: str) -> Property:
        return self._found[name]

    def __getattr__(self, name: str) -> Property:
        found: dict[str, Property] = self.__dict__.get("_found", {})
        if name not in found:
            raise AttributeError(name)
        return found[name]

    def __dir__(self) -> list[str]:
        return sorted({*object.__dir__(self), *self._found})

    def __iter__(self) -> Iterator[str]:
        return iter(self._found)

    def __len__(self) -> int:
        return len(self._found)

    def __repr__(self) -> str:
        width = max(map(len, self._found), default=0)
        return "\n".join(f"{name:{width}}  {found}" for name, found in self._found.items())


@dataclass(frozen=True)
class Order:
    """The order of a method for a class of Hamiltonians.

    Attributes
    ----------
    order : int
        The order.
    evidence : str
        As for :class:`Property`.
    bits : int or None
        The binary places of a verification.
    refuted_by : str or None
        The tree whose condition of the next order does not hold; None if the order is only a lower bound.
    residual : str or None
        By how much.
    error_constant : float or None
        The norm of the leading error.
    """

    order: int
    evidence: str
    bits: int | None
    refuted_by: str | None
    residual: str | None
    error_constant: float | None

    def __int__(self) -> int:
        return self.order

    __index__ = __int__


@dataclass(frozen=True)
class Stability:
    """Linear stability on the oscillator H = (p² + ω²q²)/2; ν = hω.

    Attributes
    ----------
    trace, determinant : str
        Of the matrix of a step, as functions of ν.
    intervals : list of (float, float)
        Where the method is stable; `exact` has their exact ends.
    exact : list of (str, str)
        The exact ends.
    p_stable : bool
        Whether it is stable for every ν.
    evidence : str
        As for :class:`Property`.
    dispersion_order : int or None
        The order of the error of the frequency.
    dispersion : str or None
        The leading coefficient of that error.
    """

    trace: str
    determinant: str
    intervals: list[tuple[float, float]]
    exact: list[tuple[str, str]]
    p_stable: bool
    evidence: str
    dispersion_order: int | None
    dispersion: str | None


class Tableau:
    """The exact tableau of a symplectic partitioned Runge–Kutta method, with its proofs.

    ::

        Q_i = q0 + h Σ_j a_ij  ∂H/∂p(Q_j, P_j)      q1 = q0 + h Σ_i b_i  ∂H/∂p(Q_i, P_i)
        P_i = p0 - h Σ_j ã_ij  ∂H/∂q(Q_j, P_j)      p1 = p0 - h Σ_i b̃_i  ∂H/∂q(Q_i, P_i)

    Made by :func:`tableau`, :func:`splitting`, :func:`composition`, :func:`method`. Two tableaux are equal if their coefficients are.

    Examples
    --------
    >>> import symplectica as sy
    >>> gauss = sy.tableau(basis="polynomial(2)", nodes="gauss(2)")
    >>> gauss.a
    array([[ 0.25      , -0.03867513],
           [ 0.53867513,  0.25      ]])
    >>> gauss.exact["a"][0]
    ['1/4', '1/4 - sqrt(3)/6']
    >>> gauss.order(), bool(gauss.properties.symplectic)
    (4, True)
    """

    def __init__(self, native: _native.Tableau) -> None:
        self._native = native
        self._steps: dict[bool | None, _native.Method] = {}

    def _stepping(self, holonomic: bool | None) -> _native.Method:
        """The method that takes steps, for constraints if there are any."""
        if holonomic not in self._steps:
            self._steps[holonomic] = _native.Method.derived(self._native, holonomic)
        return self._steps[holonomic]

    # What it is.

    @property
    def name(self) -> str | None:
        """Its name, if it has one."""
        return self._native.name

    @property
    def stages(self) -> int:
        """The number of stages s."""
        return self._native.stages

    @property
    def definition(self) -> dict[str, str]:
        """The keys of its definition with their values: what it is derived from."""
        return dict(self._native.definition)

    @property
    def source(self) -> str | None:
        """The paper or book that it is from, if that is known."""
        return self._native.source

    @property
    def wrong_digits(self) -> list[str]:
        """The printed numbers of a claim that are not the correctly rounded exact coefficients."""
        return self._native.wrong_digits

    # Its coefficients.

    @cached_property
    def _doubles(self) -> dict[str, Array]:
        made = {}
        for name, rows in self._native.doubles():
            array = np.array(rows if name.startswith("a") else rows[0], dtype=float)
            array.flags.writeable = False
            made[name] = array
        return made

    @property
    def a(self) -> Array:
        """The matrix a, shape (s, s); every double is the correctly rounded one."""
        return self._doubles["a"]

    @property
    def a_tilde(self) -> Array:
        """The matrix ã, shape (s, s)."""
        return self._doubles["a_tilde"]

    @property
    def b(self) -> Array:
        """The weights b, shape (s,)."""
        return self._doubles["b"]

    @property
    def b_tilde(self) -> Array:
        """The weights b̃, shape (s,)."""
        return self._doubles["b_tilde"]

    @property
    def c(self) -> Array:
        """The nodes c, the row sums of a, shape (s,)."""
        return self._doubles["c"]

    @property
    def c_tilde(self) -> Array:
        """The nodes c̃, the row sums of ã, shape (s,)."""
        return self._doubles["c_tilde"]

    @cached_property
    def exact(self) -> dict[str, Any]:
        """The exact coefficients as texts by name, None where there is no short form: see :meth:`to_fractions`, :meth:`to_sympy`."""
        return {name: rows if name.startswith("a") else rows[0] for name, rows in self._native.exact()}

    def to_fractions(self) -> dict[str, Any]:
        """The coefficients as :class:`fractions.Fraction`.

        Raises
        ------
        ArgumentError
            If one of them is not rational.

        Examples
        --------
        >>> import symplectica as sy
        >>> sy.method("lobatto-3").to_fractions()["b"]
        [Fraction(1, 6), Fraction(2, 3), Fraction(1, 6)]
        """

        def read(text: str | None) -> Fraction:
            found = None if text is None else fraction(text)
            if found is None:
                raise ArgumentError(f"the coefficient {text or 'without a short form'} is not rational: see `exact` and `to_sympy`")
            return found

        return self._mapped(read)

    def to_sympy(self) -> dict[str, Any]:
        """The coefficients as SymPy expressions, lists of lists; a coefficient without a short form has 40 digits."""
        import sympy

        decimals = self._facts

        def entry(name: str, text: str | None, *place: int) -> Any:
            if text is not None:
                return to_sympy(text)
            found = decimals[name]
            for index in place:
                found = found[index]
            return sympy.Float(found["decimal"], 40)

        made: dict[str, Any] = {}
        for name, rows in self.exact.items():
            if name.startswith("a"):
                made[name] = [[entry(name, text, i, j) for j, text in enumerate(row)] for i, row in enumerate(rows)]
            else:
                made[name] = [entry(name, text, i) for i, text in enumerate(rows)]
        return made

    def _mapped(self, read: Any) -> dict[str, Any]:
        return {
            name: [[read(text) for text in row] for row in rows] if name.startswith("a") else [read(text) for text in rows]
            for name, rows in self.exact.items()
        }

    # What is proved.

    @cached_property
    def _facts(self) -> dict[str, Any]:
        facts: dict[str, Any] = json.loads(self._native.write("json"))
        return facts

    @cached_property
    def properties(self) -> Properties:
        """What is proved or refuted: ``symplectic``, ``symmetric``, ``explicit``, ``stiffly_accurate``, …, and for separable H alone
        ``symplectic(separable)``, ``symmetric(separable)``."""
        found = {name: Property(**entry) for name, entry in self._facts["properties"].items()}
        for name, holds, evidence, bits, witness in self._native.separable_properties():
            found[f"{name}(separable)"] = Property(holds, evidence, bits, witness)
        return Properties(found)

    @cached_property
    def orders(self) -> dict[str, Order]:
        """The order for each class of Hamiltonians: ``general``, ``separable``, ``nystrom``."""

        def read(entry: dict[str, Any]) -> Order:
            constant = entry["error_constant"]
            return Order(
                entry["order"],
                entry["evidence"],
                entry["bits"],
                entry["refuted_by"],
                entry["residual"],
                None if constant is None else float(constant),
            )

        return {name: read(self._facts["order"][name]) for name in CLASSES}

    def order(self, kind: str = "general") -> int:
        """The proved order.

        Parameters
        ----------
        kind : str
            ``general`` for every H(q, p), ``separable`` for T(p) + U(q), ``nystrom`` if T is also quadratic.
        """
        if kind not in CLASSES:
            raise ArgumentError(f"unknown class `{kind}`; known here: {', '.join(CLASSES)}")
        return self.orders[kind].order

    @property
    def perturbed_order(self) -> list[int] | None:
        """The orders in ε, ε², … of a splitting for H = H_A + εH_B; the last one holds for all higher powers."""
        found = self._facts["order"]["perturbed"]
        if found is None:
            return None
        orders = found.get("orders", found) if isinstance(found, dict) else found
        return [entry["order"] if isinstance(entry, dict) else int(entry) for entry in orders]

    @cached_property
    def stability(self) -> Stability | None:
        """Linear stability on the oscillator; None if it is not computed for so many stages: see `stable_steps`."""
        found = self._facts["stability"]
        if not isinstance(found, dict) or "trace" not in found:
            return None

        def end(text: str) -> float:
            return float("inf") if text == "infinity" else float(text)

        return Stability(
            found["trace"],
            found["determinant"],
            [(end(low), end(high)) for low, high in found["decimal"]],
            [(low, high) for low, high in found["intervals"]],
            found["p_stable"],
            found["evidence"],
            found["dispersion_order"],
            found["dispersion"],
        )

    @property
    def stable_steps(self) -> str:
        """The stable steps hω on the oscillator, as text."""
        return self._native.stable_steps

    @property
    def forces(self) -> int | None:
        """Forces per step, if the method is explicit for separable H."""
        return self._native.forces

    def require(self, *requirements: str, accepted_bits: int | None = None) -> Tableau:
        """Proves requirements, and returns the tableau.

        Parameters
        ----------
        *requirements : str
            As in the macro: ``symplectic``, ``symmetric``, ``order == 8``, ``order(separable) >= 4``, ``stable_to(2)``, ``p_stable``.
        accepted_bits : int, optional
            Accept what is verified to this number of binary places.

        Raises
        ------
        ProofError
            If one is refuted, with the witness, or is not proved.

        Examples
        --------
        >>> import symplectica as sy
        >>> sy.method("gauss-2").require("symplectic", "order == 4").stages
        2
        >>> sy.method("gauss-2").require("order == 5")
        Traceback (most recent call last):
            ...
        symplectica._errors.ProofError: `order == 5`: ...
        """
        for requirement in requirements:
            self._native.require(requirement, accepted_bits)
        return self

    def certificate(self, path: str | Path | None = None) -> str:
        """Everything that is proved, for the independent checker ``check_certificate.py``; written to `path` if it is given."""
        text = self._native.certificate()
        if path is not None:
            Path(path).write_text(text, encoding="utf-8")
        return text

    # Other tableaux, other languages.

    @property
    def adjoint(self) -> Tableau:
        """The adjoint method."""
        return Tableau(self._native.adjoint())

    def to(self, format: str = "text", digits: int | None = None) -> str:
        """The tableau in a format of the command line.

        Parameters
        ----------
        format : str
            ``text``, ``toml``, ``json``, ``latex``, ``c``, ``fortran``, ``julia``, ``python``, ``sundials``, ``petsc``, ``nodepy``,
            ``tsv``, ``coq``.
        digits : int, optional
            Significant digits of decimals; every digit is correct.
        """
        return self._native.write(format, None if digits is None else _arrays.count(digits, "digits", 1, 10_000))

    def emit(self, language: str, system: System | None = None, kind: str | None = None) -> str:
        """A program that takes steps, one file without dependencies.

        Parameters
        ----------
        language : str
            ``c``, ``rust``, ``julia`` or ``python``.
        system : System, optional
            A formula: the program also has its velocity, force and energy.
        kind : str, optional
            ``general`` or ``separable``.
        """
        return self._native.emit(language, None if system is None else system._native, kind)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Tableau):
            return NotImplemented
        return self._native.has_coefficients_of(other._native)

    def __hash__(self) -> int:
        return hash((self.stages, tuple(self.b.tolist())))

    def __repr__(self) -> str:
        name = self.name or "Tableau"
        orders = ", ".join(f"{kind} {self.orders[kind].order}" for kind in CLASSES)
        return f"<{name}: {self.stages} stages, order {orders}>"

    def __str__(self) -> str:
        return self.to("text")

    def _repr_latex_(self) -> str | None:
        # MathJax knows neither booktabs nor \\multicolumn. Tables that are too wide are lists, which notebooks show as text.
        arrays = re.findall(r"\\begin\{array\}.*?\\end\{array\}", self.to("latex"), re.DOTALL)
        if not arrays:
            return None
        shown = []
        for array in arrays:
            array = re.sub(r"\\(toprule|bottomrule)\n", "", array).replace("\\midrule", "\\hline").replace("@{\\quad}", "|")
            shown.append(re.sub(r"\\multicolumn\{\d+\}\{c\}\{(.*?)\} \\\\", r"\1 \\\\", array))
        return "$$\n" + "\n\\qquad\n".join(shown) + "\n$$"

    def __reduce__(self) -> tuple[Any, ...]:
        if self.name is not None and _is_known(self):
            return (_of_catalogue, (self.name,))
        return (_restored, (self._native.toml(), self.stages))


def _restored(toml: str, stages: int) -> Tableau:
    return Tableau(_native.Tableau.read("pickled.toml", toml, max(stages, 36)))


def tableau(*, name: str | None = None, require: str | Sequence[str] = (), max_stages: int | None = None, **definition: Exact) -> Tableau:
    """Derives a tableau with proofs, from the keys of a definition.

    Parameters
    ----------
    basis : str or list
        The functions of t that approximate velocities: ``"polynomial(4)"``, ``["1", "cos(pi*t)", "sin(pi*t)"]``.
    nodes, quadrature : str or list
        ``"gauss(4)"``, ``"lobatto(3)"``, or exact numbers in [0, 1]. With `quadrature` the rectangular construction: as many nodes as
        functions, or more.
    weights : str or list
        Weights of the quadrature; with `base` the fractions of its steps: ``"triple_jump(4)"``.
    a, b, a_tilde, b_tilde : list
        Given coefficients; ``a_tilde="symplectic_partner"``.
    kick, drift, first, claim : see :func:`splitting`
    base, compose : see :func:`composition`
    symmetric, exchange, adjoint : bool
        Continue in reverse order; exchange the coefficients of positions and momenta; take the adjoint.
    name : str, optional
        A name.
    require : str or list of str
        What must be proved: see :meth:`Tableau.require`.
    max_stages : int, optional
        The largest number of stages, 36 if it is not given.

    Raises
    ------
    DefinitionError
        For a wrong definition, with the place of the fault.
    ProofError
        If a requirement is not proved.
    ArgumentError
        For an unknown key, or a float that is not exact.

    Examples
    --------
    >>> import symplectica as sy
    >>> lobatto = sy.tableau(basis="polynomial(3)", nodes="lobatto(3)", require=["symplectic", "order == 4"])
    >>> lobatto
    <Tableau: 3 stages, order general 4, separable 4, nystrom 4>
    >>> waves = sy.tableau(basis=["1", "cos(pi*t)", "sin(pi*t)"], nodes=["0", "1/2", "1"])
    >>> waves.exact["b"]
    ['(pi - 2)/(2*pi)', '2/pi', '(pi - 2)/(2*pi)']
    """
    parts = []
    for key, value in definition.items():
        if value is None or value is False:
            continue
        text = words(value, key)
        is_matrix = key in ("a", "a_tilde")
        parts.append((key, text if is_matrix or isinstance(value, str) else unbracketed(text)))
    made = Tableau(_native.Tableau.derive(parts, name, max_stages))
    return made.require(*([require] if isinstance(require, str) else require))


def splitting(
    kick: Exact,
    drift: Exact,
    *,
    first: str = "kick",
    symmetric: bool = False,
    claim: str | None = None,
    name: str | None = None,
    require: str | Sequence[str] = (),
    max_stages: int | None = None,
) -> Tableau:
    """A splitting for H = T(p) + U(q): kicks p -= kick_i h ∂U/∂q and drifts q += drift_i h ∂T/∂p, one after the other.

    Parameters
    ----------
    kick, drift : list of exact numbers
        Fractions, texts such as ``"7/24"``, integers; printed digits as texts together with `claim`.
    first : str
        ``kick`` or ``drift``.
    symmetric : bool
        Continue in reverse order; the last entry is the middle one.
    claim : str, optional
        The claimed order of printed digits, ``"separable(6)"``: the exact method near them is found and proved.
    name, require, max_stages : see :func:`tableau`

    Examples
    --------
    >>> import symplectica as sy
    >>> ruth = sy.splitting(kick=["7/24", "3/4", "-1/24"], drift=["2/3", "-2/3", 1])
    >>> ruth.order("separable")
    3
    >>> sy.splitting(kick=[7 / 24, 3 / 4, -1 / 24], drift=[2 / 3, -2 / 3, 1])
    Traceback (most recent call last):
        ...
    symplectica._errors.ArgumentError: `kick` contains the float 0.2916666666666667, ...
    """
    return tableau(
        kick=kick,
        drift=drift,
        first=None if first == "kick" else first,
        symmetric=symmetric,
        claim=claim,
        name=name,
        require=require,
        max_stages=max_stages,
    )


def composition(
    base: str | Tableau,
    weights: Exact,
    *,
    symmetric: bool = False,
    claim: str | None = None,
    name: str | None = None,
    require: str | Sequence[str] = (),
    max_stages: int | None = None,
) -> Tableau:
    """Steps of a method one after another, with fractions of the step.

    Parameters
    ----------
    base : str or Tableau
        A name of the catalogue, a definition in brackets, or a derived method.
    weights : str or list
        ``"triple_jump(4)"``, ``"suzuki(4)"``, or exact numbers.
    symmetric, claim, name, require, max_stages : see :func:`splitting`

    Examples
    --------
    >>> import symplectica as sy
    >>> sy.composition("velocity-verlet", "triple_jump(4)").order("separable")
    4
    """
    if isinstance(base, Tableau):
        base = "[" + ", ".join(f"{key}: {value if key == 'base' or value.startswith('[') else _bracketed(value)}" for key, value in base.definition.items()) + "]"
    return tableau(base=base, weights=weights, symmetric=symmetric, claim=claim, name=name, require=require, max_stages=max_stages)


def _bracketed(value: str) -> str:
    """A list as a definition in brackets has it."""
    return f"[{value}]" if "," in re.sub(r"\([^()]*\)", "", value) else value


@dataclass(frozen=True)
class Entry:
    """A method of the catalogue.

    Attributes
    ----------
    name, title, definition, source : str
        Its name, what it is, what it is derived from, where it is from.
    stages : int
        The number of stages.
    """

    name: str
    title: str
    definition: str
    stages: int
    source: str

    @property
    def tableau(self) -> Tableau:
        """The derived method."""
        return _of_catalogue(self.name)


@lru_cache(maxsize=1)
def _known() -> dict[str, Entry]:
    return {entry[0]: Entry(*entry) for entry in _native.catalogue()}


def catalogue() -> dict[str, Entry]:
    """The known methods by name.

    Examples
    --------
    >>> import symplectica as sy
    >>> len(sy.catalogue()) > 100
    True
    >>> sy.catalogue()["ruth-1983"].tableau.order("separable")
    3
    """
    return dict(_known())


@lru_cache(maxsize=256)
def _of_catalogue(name: str) -> Tableau:
    if name not in _known():
        near = get_close_matches(name, _known(), 3, 0.5)
        hint = f"did you mean {' or '.join(f'`{one}`' for one in near)}? " if near else ""
        raise DefinitionError(f"unknown method `{name}`; {hint}all names are in `symplectica.catalogue()`", reason=f"unknown method `{name}`", input="method", text=name)
    return Tableau(_native.Tableau.of_catalogue(name))


def _is_known(made: Tableau) -> bool:
    """Whether a tableau is the method of the catalogue that has its name."""
    known = _known().get(made.name or "")
    return known is not None and known.tableau == made


class Doubles:
    """A method of doubles, about which nothing is proved.

    Symplecticity is tested up to rounding; the order is what you say. :func:`audit` finds the exact method near it.

    Parameters
    ----------
    a, b : array_like
        Shapes (s, s) and (s,).
    a_tilde, b_tilde : array_like, optional
        Those of the momenta; `a` and `b` if they are not given.
    order : int
        The order for every class, believed.
    name : str
        A name.

    Examples
    --------
    >>> import symplectica as sy
    >>> midpoint = sy.Doubles([[0.5]], [1.0], order=2)
    >>> midpoint.proved
    False
    """

    #: Nothing is proved.
    proved = False

    def __init__(
        self,
        a: npt.ArrayLike,
        b: npt.ArrayLike,
        a_tilde: npt.ArrayLike | None = None,
        b_tilde: npt.ArrayLike | None = None,
        *,
        order: int = 0,
        name: str = "a method of doubles",
    ) -> None:
        self.a = _arrays.numbers(a, "a")
        self.b = _arrays.numbers(b, "b")
        self.a_tilde = self.a if a_tilde is None else _arrays.numbers(a_tilde, "a_tilde")
        self.b_tilde = self.b if b_tilde is None else _arrays.numbers(b_tilde, "b_tilde")
        for key, array, dimensions in (("a", self.a, 2), ("a_tilde", self.a_tilde, 2), ("b", self.b, 1), ("b_tilde", self.b_tilde, 1)):
            if array.ndim != dimensions:
                raise ArgumentError(f"`{key}` has {array.ndim} dimensions; it needs {dimensions}")
        self.name, self._order = str(name), _arrays.count(order, "order", 0, 1000)
        self._native = _native.Method.of_doubles(
            self.name, self.a.tolist(), self.a_tilde.tolist(), self.b.tolist(), self.b_tilde.tolist(), [self._order] * 3
        )

    def order(self, kind: str = "general") -> int:
        """The order that was given."""
        return self._order

    def __repr__(self) -> str:
        return f"<{self.name}: {len(self.b)} stages, order {self._order} as given, nothing proved>"

    def __reduce__(self) -> tuple[Any, ...]:
        return (_doubles, (self.a, self.b, self.a_tilde, self.b_tilde, self._order, self.name))


def _doubles(a: Array, b: Array, a_tilde: Array, b_tilde: Array, order: int, name: str) -> Doubles:
    return Doubles(a, b, a_tilde, b_tilde, order=order, name=name)


def method(given: str | Path | Mapping[str, Exact] | Tableau | Doubles | Any) -> Tableau | Doubles:
    """A method from whatever names or contains one.

    Parameters
    ----------
    given : str, Path, dict, Tableau, Doubles, or an object with A and b
        A name of :func:`catalogue`; the path of a file in TOML or JSON; the text of such a file; the keys of a definition; a method of
        `nodepy` (``A``, ``b``) or a solver class of SciPy (``A``, ``B``), whose numbers are doubles.

    Examples
    --------
    >>> import symplectica as sy
    >>> sy.method("gauss-8").order()
    16
    >>> sy.method({"base": "lobatto-2", "weights": "triple_jump(4)"}).order()
    4
    >>> sy.method("gaus-8")
    Traceback (most recent call last):
        ...
    symplectica._errors.DefinitionError: unknown method `gaus-8`; did you mean `gauss-8`...
    """
    if isinstance(given, (Tableau, Doubles)):
        return given
    if isinstance(given, Entry):
        return given.tableau
    if isinstance(given, Mapping):
        return tableau(**given)
    if isinstance(given, Path) or (isinstance(given, str) and given.endswith((".toml", ".json")) and "\n" not in given):
        return Tableau(_native.Tableau.read(str(given), read_text(given)))
    if isinstance(given, str):
        if "\n" not in given and "=" not in given:
            return _of_catalogue(given)
        return Tableau(_native.Tableau.read("definition.json" if given.lstrip().startswith("{") else "definition.toml", given))
    a, b = getattr(given, "A", None), getattr(given, "b", getattr(given, "B", None))
    if a is not None and b is not None:
        a, b = np.array(a, dtype=float), np.array(b, dtype=float)
        if a.ndim == 2 and a.shape[0] == len(b) and a.shape[1] < a.shape[0]:
            a = np.pad(a, ((0, 0), (0, a.shape[0] - a.shape[1])))
        order = getattr(given, "order", getattr(given, "p", 0))
        name = getattr(given, "shortname", None) or getattr(given, "__name__", None) or type(given).__name__
        return Doubles(a, b, order=int(order() if callable(order) else order or 0), name=str(name))
    raise ArgumentError(f"found {type(given).__name__}, expected a method: a name such as 'gauss-8', a Tableau, a definition")


def stepping(given: Any, holonomic: bool | None) -> _native.Method:
    """The native method that takes steps."""
    found = method(given)
    if isinstance(found, Tableau):
        return found._stepping(holonomic)
    if holonomic is not None:
        raise ArgumentError("a method of doubles has no steps for constraints: take a derived one, such as 'lobatto-3'")
    return found._native
