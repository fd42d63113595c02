"""Systems that are given by formulas."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _arrays, _native
from ._arrays import Array
from ._errors import ArgumentError, Interrupted, StepError
from ._events import Event, events_of
from ._progress import shown
from ._tableau import Doubles, Tableau, method as method_of, stepping

if TYPE_CHECKING:
    from ._compare import Comparison
    from ._ensemble import Ensemble
    from ._run import Run

#: A method: a name, a tableau, a definition.
Method = str | Tableau | Doubles | Mapping[str, Any] | Any

#: The |energy error| above which a run warns, as `symplectic run` does.
_LARGE = 0.01

#: Rows of a run without `output`.
_ROWS = 1001


class Equations:
    """The equations of motion; readable as text, typeset in notebooks."""

    def __init__(self, native: _native.Formula) -> None:
        self._native = native

    def __str__(self) -> str:
        return "\n".join(self._native.equations(False))

    __repr__ = __str__

    @property
    def latex(self) -> str:
        """The equations in an ``aligned`` environment."""
        return self._native.describe("latex")

    def _repr_latex_(self) -> str:
        lines = self._native.equations(True)
        rows = [line.replace("=", "&=", 1) for line in lines]
        return "$$\n\\begin{aligned}\n" + " \\\\\n".join(rows) + "\n\\end{aligned}\n$$"


class System:
    """A mechanical system that is given by the formula of H or L: see :func:`system`.

    Its derivatives, its class and its conserved momenta are derived exactly.
    """

    def __init__(self, text: str, parameters: Mapping[str, Any] | None = None, *, source: str = "the formula") -> None:
        self._native = _native.Formula(source, text)
        self._set(_arrays.named(parameters))

    def _set(self, parameters: Mapping[str, Any]) -> None:
        _arrays.check_names(parameters, self._native.parameters)
        self._parameters = {name: _arrays.numbers(value, name) for name, value in parameters.items()}
        self._problems: dict[Any, _native.Problem] = {}

    # What it is.

    @property
    def text(self) -> str:
        """The formula."""
        return self._native.text

    @property
    def name(self) -> str:
        """Its name, if the formula has one."""
        return self._native.name

    @property
    def parameters(self) -> dict[str, Any]:
        """The values of the parameters that are set."""
        return {name: value.item() if value.ndim == 0 else value.copy() for name, value in self._parameters.items()}

    @property
    def parameter_names(self) -> list[str]:
        """The names of the parameters of the formula."""
        return [name for name, *_ in self._native.parameters]

    def with_parameters(self, **parameters: Any) -> System:
        """The same system with other values of parameters.

        Examples
        --------
        >>> import symplectica as sy
        >>> pendulum = sy.system("Pendulum { g: 9.81 } q: [a], p: [pa]; H = pa^2/2 - g cos(a)")
        >>> pendulum.with_parameters(g=1.62).parameters
        {'g': 1.62}
        """
        other = System.__new__(System)
        other._native = self._native
        other._set({**self._parameters, **parameters})
        return other

    @property
    def equations(self) -> Equations:
        """The equations of motion.

        Examples
        --------
        >>> import symplectica as sy
        >>> sy.system("q: [x], p: [px]; H = px^2/2 + x^4/4").equations
        x' = px
        px' = −x³
        """
        return Equations(self._native)

    @property
    def hamiltonian(self) -> str:
        """H as text, also of a Lagrangian."""
        return self._native.hamiltonian(False)

    @property
    def facts(self) -> list[str]:
        """What was found in the formula: class, kinetic energy, conserved quantities."""
        return self._native.facts()

    @property
    def is_separable(self) -> bool:
        """Whether H = T(p) + U(q), and no force depends on momenta: splittings are then explicit."""
        return self._native.is_separable

    def describe(self, format: str = "text") -> str:
        """The report of ``symplectic derive-system`` as ``text``, ``latex`` or ``json``."""
        return self._native.describe(format)

    def __repr__(self) -> str:
        values = ", ".join(f"{name}={value!r}" if np.ndim(value) == 0 else f"{name}: {value.shape}" for name, value in self.parameters.items())
        name = "" if self.name == "System" else f" {self.name}:"
        return f"<System{name} H = {self.hamiltonian}{'; ' if values else ''}{values}>"

    def to_sympy(self) -> dict[str, Any]:
        """H, the coordinates and the parameters as SymPy expressions and symbols, for formulas with a fixed number of coordinates.

        Returns
        -------
        dict
            ``H``; ``q``, ``p``: lists of symbols; ``t``: the time; ``parameters``: symbols by name; ``values``: their values.

        Examples
        --------
        >>> import symplectica as sy
        >>> found = sy.system("q: [x], p: [px]; H = px^2/2 + x^4/4").to_sympy()
        >>> found["H"].diff(found["q"][0])
        x**3
        """
        from ._sympy import expression_of

        return expression_of(self)

    def _repr_latex_(self) -> str:
        return f"$$H = {self._native.hamiltonian(True)}$$"

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, System):
            return NotImplemented
        mine, others = self._parameters, other._parameters
        return self.text == other.text and mine.keys() == others.keys() and all(np.array_equal(mine[name], others[name]) for name in mine)

    def __hash__(self) -> int:
        return hash(self.text)

    def __reduce__(self) -> tuple[Any, ...]:
        return (System, (self.text, self._parameters))

    # States.

    def _problem(self, dimension: int, start: float, parameters: Mapping[str, Any], varied: dict[str, Array]) -> _native.Problem:
        """The formula with values, kept for the next run."""
        if (refusal := self._native.refusal) is not None:
            raise ArgumentError(f"runs in Python do not support {refusal}: write a program with the macros, as the book describes")
        values = {name: value for name, value in {**self._parameters, **parameters}.items() if name not in varied}
        arrays = {name: value if isinstance(value, np.ndarray) and not value.flags.writeable else _arrays.numbers(value, name) for name, value in values.items()}
        shapes = {name: array.shape[1:] for name, array in varied.items()}
        from_ = start if self._native.has_friction else 0.0
        key = (dimension, from_, tuple((name, array.shape, array.tobytes()) for name, array in arrays.items()), tuple(shapes.items()))
        found = self._problems.get(key)
        if found is None:
            _arrays.check_names(values, self._native.parameters)
            if len(self._problems) >= 16:
                self._problems.clear()
            given = [(name, list(array.shape), array.ravel().tolist()) for name, array in arrays.items()]
            found = _native.Problem(self._native, dimension, given, [(name, list(shape)) for name, shape in shapes.items()], [], from_)
            self._problems[key] = found
        return found

    def _halves(self, q: Any, p: Any, v: Any, start: float, parameters: Mapping[str, Any]) -> tuple[Array, Array]:
        """Positions and momenta of equal shape; momenta from velocities if these are given."""
        q = _arrays.numbers(q, "q")
        if (p is None) == (v is None):
            raise ArgumentError("give either the momenta `p` or the velocities `v`")
        key, other = ("p", p) if v is None else ("v", v)
        other = _arrays.numbers(other, key)
        if q.shape != other.shape:
            raise ArgumentError(f"`q` has the shape {q.shape} and `{key}` the shape {other.shape}: they must be the same")
        if q.size == 0:
            raise ArgumentError("`q` is empty: give at least one coordinate")
        self._check_shape(q.shape)
        if v is not None:
            problem = self._problem(q.size, start, parameters, {})
            other = np.array(problem.momentum(start, q.ravel().tolist(), other.ravel().tolist(), [])).reshape(q.shape)
        return q, other

    def _check_shape(self, shape: tuple[int, ...]) -> None:
        """Positions that are vectors are rows, or one list."""
        components = self._native.layout[1]
        if components > 1 and len(shape) > 1 and shape[-1] != components:
            raise ArgumentError(f"`q` has the shape {shape}; its rows must have {components} components, as the formula says")

    def momentum(self, q: npt.ArrayLike, v: npt.ArrayLike, *, t: float = 0.0, parameters: Mapping[str, Any] | None = None) -> Array:
        """The momenta of velocities; H must be quadratic in the momenta.

        Examples
        --------
        >>> import symplectica as sy
        >>> body = sy.system("{ m: 2 } q: [x], p: [px]; H = px^2/(2 m)")
        >>> body.momentum([0.0], [3.0])
        array([6.])
        """
        return self._halves(q, None, v, _arrays.number(t, "t"), _arrays.named(parameters))[1]

    def energy(self, q: npt.ArrayLike, p: npt.ArrayLike, *, t: float = 0.0, parameters: Mapping[str, Any] | None = None) -> float:
        """H at a state.

        Examples
        --------
        >>> import symplectica as sy
        >>> sy.system("q: [x], p: [px]; H = px^2/2 + x^2/2").energy([1.0], [0.0])
        0.5
        """
        start, values = _arrays.number(t, "t"), _arrays.named(parameters)
        q, p = self._halves(q, p, None, start, values)
        problem = self._problem(q.size, start, values, {})
        return float(problem.energies(np.array([start]), q.reshape(1, -1), p.reshape(1, -1), np.empty((1, 0)))[0])

    # Runs.

    def integrate(
        self,
        q: npt.ArrayLike,
        p: npt.ArrayLike | None = None,
        *,
        t: float,
        step: float,
        v: npt.ArrayLike | None = None,
        t0: float = 0.0,
        method: Method | None = None,
        output: npt.ArrayLike | int | None = None,
        events: Event | str | Sequence[Event | str] | Mapping[str, Event | str] | None = None,
        parameters: Mapping[str, Any] | None = None,
        progress: bool | Callable[[float], object] = False,
        solver: str | None = None,
        accept_lower_order: bool = False,
        project_starts: bool = False,
        halvings: int = 0,
    ) -> Run:
        """Integrates from a state to the time `t`, in equal steps.

        Parameters
        ----------
        q, p : array_like
            Positions and momenta, of the same shape.
        t : float
            The end; it is reached exactly, by equal steps of about `step`.
        step : float
            The step size h.
        v : array_like, optional
            The velocities instead of the momenta.
        t0 : float
            The time of the start.
        method : str, Tableau, dict, optional
            A name of the catalogue, a derived tableau, a definition. By default ``gauss-4``, of order 8 for every H; with holonomic
            constraints ``lobatto-3``, with non-holonomic ones ``gauss-1``.
        output : array_like or int, optional
            The times of the states that are kept: sorted, from `t0` to `t`. A state inside a step comes from a shorter step of the method,
            so it has the order of the method. A whole number keeps at most as many states, at ends of steps; 0 only the last one. By
            default at most 1001.
        events : Event, str, or a list or dict of these, optional
            Zeros of expressions: see :class:`Event`.
        parameters : dict, optional
            Values of parameters for this run.
        progress : bool or callable
            Show a bar, or call a function with the fraction that is done.
        solver : str, optional
            ``newton`` for stiff systems.
        accept_lower_order : bool
            Accept a method whose order is lower for this H.
        project_starts : bool
            Move the start onto the constraints.
        halvings : int
            Repeat a step that fails as 2, 4, …, 2^halvings steps.

        Returns
        -------
        Run

        Raises
        ------
        ArgumentError
            For an argument that does not fit.
        StepError
            If a step fails; its `run` ends with the last full step.
        Interrupted
            At Ctrl-C; its `run` ends with the last full step.

        Examples
        --------
        >>> import symplectica as sy
        >>> kepler = sy.system("q: [2], p: [2]; H = |p|^2/2 - 1/|q|")
        >>> run = kepler.integrate([0.4, 0], [0, 2], t=100, step=0.05, method="gauss-8")
        >>> bool(abs(run.energy_error).max() < 1e-13)
        True
        >>> run.q.shape[1:], float(run.t[-1])
        ((2,), 100.0)
        """
        from ._run import Run

        values = _arrays.named(parameters)
        start, end = _arrays.number(t0, "t0"), _arrays.number(t, "t")
        q0, p0 = self._halves(q, p, v, start, values)
        problem = self._problem(q0.size, start, values, {})
        made = method_of(method if method is not None else self._default())
        setting = self._setting(step, end - start, solver, accept_lower_order, project_starts, halvings, None)
        names, given = events_of(events)
        bar = shown(progress, end - start, None)
        found = _native.integrate(
            problem,
            stepping(made, self._constraints),
            setting,
            start,
            q0.reshape(1, -1),
            p0.reshape(1, -1),
            np.empty((1, 0)),
            end,
            self._output(output, start, end),
            given,
            bar,
        )
        texts = [event[0] for event in given]
        run = Run._of(self.with_parameters(**values) if values else self, made, q0, p0, start, setting, names, texts, found)
        if bar is not None:
            bar.end(found["error"] is None and found["interrupted"] is None)
        if (signal := found["interrupted"]) is not None:
            raise _interrupted(signal, run) from None
        if (error := found["error"]) is not None:
            error.run = run
            raise error
        changes = any(event[4] for event in given)
        if problem.energy_is_conserved and not changes and not abs(error := run._last_energy_error) < _LARGE:
            warnings.warn(f"the energy error at the end is {error:.1e}: take a smaller step or another method", stacklevel=2)
        return run

    @property
    def _constraints(self) -> bool | None:
        return self._native.constraints

    def _default(self) -> str:
        return {None: "gauss-4", True: "lobatto-3", False: "gauss-1"}[self._constraints]

    def _setting(
        self,
        step: Any,
        length: float,
        solver: str | None,
        accept_lower_order: bool,
        project_starts: bool,
        halvings: int,
        threads: int | None,
    ) -> dict[str, Any]:
        size = _arrays.number(step, "step")
        if size <= 0:
            raise ArgumentError(f"the step is {size}: it must be positive; to go backward, give an end `t` before the start")
        if abs(length) / size > 2**53:
            raise ArgumentError(f"there are more than 2^53 steps of {size}")
        if solver not in (None, "fixed-point", "newton"):
            raise ArgumentError(f"unknown solver `{solver}`; known here: fixed-point, newton")
        if threads is not None:
            threads = _arrays.count(threads, "threads", 1, 256)
        return {
            "step": float(np.copysign(size, length)),
            "newton": solver == "newton",
            "accept_lower_order": bool(accept_lower_order),
            "project": bool(project_starts),
            "halvings": min(_arrays.count(halvings, "halvings"), 16),
            "threads": threads,
        }

    def _output(self, output: Any, start: float, end: float) -> list[float] | int:
        if output is None:
            return _ROWS
        if isinstance(output, (int, np.integer, bool)):
            return _arrays.count(output, "output", 0, 10**9)
        return _times(output, start, end)

    def ensemble(
        self,
        q: npt.ArrayLike,
        p: npt.ArrayLike | None = None,
        *,
        t: float,
        step: float,
        v: npt.ArrayLike | None = None,
        t0: float = 0.0,
        method: Method | None = None,
        output: npt.ArrayLike | None = None,
        section: Event | str | None = None,
        megno: bool = False,
        parameters: Mapping[str, Any] | None = None,
        threads: int | None = None,
        progress: bool | Callable[[float], object] = False,
        solver: str | None = None,
        accept_lower_order: bool = False,
        project_starts: bool = False,
        halvings: int = 0,
    ) -> Ensemble:
        """Integrates many trajectories, in SIMD lanes and on all cores.

        Parameters
        ----------
        q, p : array_like
            Starts of n trajectories, shapes (n, …). One start is enough if parameters vary.
        output : array_like, optional
            Times of the states that are kept, in arrays of shape (n, times, …). By default only the last states.
        section : Event or str, optional
            Keep the states at which an expression goes through zero; upward if it is given as text.
        megno : bool
            Compute the mean MEGNO and the largest Lyapunov exponent.
        parameters : dict, optional
            Values of parameters: with one axis more than the formula has, the first one of length n, they vary between trajectories.
        threads : int, optional
            The number of threads; by default one per core. The bits of the results do not depend on it.
        t, step, v, t0, method, progress, solver, accept_lower_order, project_starts, halvings
            See :meth:`integrate`.

        Returns
        -------
        Ensemble
            Trajectories that fail end with their last full step; the others go on.

        Examples
        --------
        >>> import numpy as np
        >>> import symplectica as sy
        >>> pendulum = sy.system("q: [a], p: [pa]; H = pa^2/2 - cos(a)")
        >>> many = pendulum.ensemble(np.linspace(0.1, 3.0, 100)[:, None], np.zeros((100, 1)), t=50, step=0.05, method="gauss-4")
        >>> many.q.shape, int(many.failed.sum())
        ((100, 1), 0)
        """
        from ._ensemble import Ensemble

        start, end = _arrays.number(t0, "t0"), _arrays.number(t, "t")
        q0 = _arrays.numbers(q, "q")
        if (p is None) == (v is None):
            raise ArgumentError("give either the momenta `p` or the velocities `v`")
        key, other = ("p", p) if v is None else ("v", v)
        p0 = _arrays.numbers(other, key)
        if q0.shape != p0.shape:
            raise ArgumentError(f"`q` has the shape {q0.shape} and `{key}` the shape {p0.shape}: they must be the same")
        if q0.ndim < 2:
            raise ArgumentError(f"`q` has the shape {q0.shape}; the starts of an ensemble have a first axis for the trajectories")
        values = {name: _arrays.numbers(value, name) for name, value in _arrays.named(parameters).items()}
        trajectories = q0.shape[0] if q0.shape[0] != 1 else self._varied_length({**self._parameters, **values})
        if trajectories > q0.shape[0]:
            q0, p0 = (np.repeat(half, trajectories, axis=0) for half in (q0, p0))
        shape = q0.shape[1:]
        self._check_shape(shape)
        dimension = int(np.prod(shape))
        if q0.size == 0:
            raise ArgumentError("there are no starts: give at least one")
        same, varied = _arrays.split({**self._parameters, **values}, self._native.parameters, trajectories)
        problem = self._problem(dimension, start, same, varied)
        table = np.concatenate([array.reshape(trajectories, -1) for array in varied.values()], axis=1) if varied else np.empty((trajectories, 0))
        table = np.ascontiguousarray(table)
        qs, ps = _arrays.rows(q0, dimension), _arrays.rows(p0, dimension)
        if v is not None:
            momenta = [problem.momentum(start, *row) for row in zip(qs.tolist(), ps.tolist(), table.tolist(), strict=True)]
            ps = np.array(momenta).reshape(-1, dimension)
        made = method_of(method if method is not None else self._default())
        setting = self._setting(step, end - start, solver, accept_lower_order, project_starts, halvings, threads)
        steps = stepping(made, self._constraints)
        if sum((output is not None, section is not None, bool(megno))) > 1:
            raise ArgumentError("give one of `output`, `section` and `megno`")
        base = (problem, steps, setting, start, qs, ps, table)
        bar = shown(progress, end - start, trajectories)
        names: list[str] = []
        if section is not None:
            if not isinstance(section, (Event, str)):
                raise ArgumentError(f"`section` must be an expression in text or an `Event`, found {type(section).__name__}")
            names, given = events_of(section, direction="rising")
            found = _native.section(*base, end, given, bar)
        elif megno:
            found = _native.chaos(*base, _displacements(qs, ps, self.is_separable and steps.is_explicit), end, bar)
        else:
            if isinstance(output, (int, np.integer)):
                raise ArgumentError("`output` of an ensemble is a list of times, such as numpy.linspace(0, 10, 101)")
            times = [] if output is None else _times(output, start, end)
            self._warn_of_times(times, start, (end - start) / max(np.ceil(abs((end - start) / setting["step"]) * (1 - 1e-12)), 1.0), steps)
            found = _native.ensemble(*base, end, times, bar)
            if output is not None:
                found["t"] = np.array(times)
        result = Ensemble._of(self, made, shape, start, setting, base, names, same, varied, found)
        if bar is not None:
            bar.end(found["interrupted"] is None)
        if (signal := found["interrupted"]) is not None:
            raise _interrupted(signal, result) from None
        return result

    def _varied_length(self, parameters: Mapping[str, Array]) -> int:
        """The number of trajectories by the parameters that vary."""
        depth = {name: len(lengths) for name, lengths, _ in self._native.parameters}
        lengths = [value.shape[0] for name, value in parameters.items() if name in depth and value.ndim == depth[name] + 1]
        return max(lengths, default=1)

    def _warn_of_times(self, times: list[float], start: float, step: float, method: _native.Method) -> None:
        """Inside steps an ensemble interpolates."""
        order = method.orders[1 if self.is_separable else 0]
        steps = (np.array(times) - start) / step
        inside = int((abs(steps - steps.round()) > 1e-9 * np.maximum(abs(steps), 1.0)).sum())
        if inside and order > 4:
            warnings.warn(
                f"{inside} of the times in `output` are inside steps, where an ensemble interpolates with order 4; the method has order {order} "
                "at ends of steps",
                stacklevel=3,
            )

    def state_transition(
        self,
        q: npt.ArrayLike,
        p: npt.ArrayLike | None = None,
        *,
        t: float,
        step: float,
        v: npt.ArrayLike | None = None,
        t0: float = 0.0,
        method: Method | None = None,
        parameters: Mapping[str, Any] | None = None,
        threads: int | None = None,
        solver: str | None = None,
        accept_lower_order: bool = False,
    ) -> tuple[Array, Array, Array]:
        """The end of a run and its derivatives by the start, from the variational equations of the method.

        Returns
        -------
        q, p : ndarray
            The end.
        derivative : ndarray, shape (2d, 2d)
            ∂(q, p)(t)/∂(q, p)(t0); a symplectic matrix up to rounding.

        Examples
        --------
        >>> import numpy as np
        >>> import symplectica as sy
        >>> oscillator = sy.system("q: [x], p: [px]; H = px^2/2 + x^2/2")
        >>> q, p, derivative = oscillator.state_transition([1.0], [0.0], t=1.0, step=0.1, method="gauss-4")
        >>> np.allclose(derivative, [[np.cos(1), np.sin(1)], [-np.sin(1), np.cos(1)]], atol=1e-12)
        True
        """
        values = _arrays.named(parameters)
        start, end = _arrays.number(t0, "t0"), _arrays.number(t, "t")
        q0, p0 = self._halves(q, p, v, start, values)
        dimension = q0.size
        problem = self._problem(dimension, start, values, {})
        setting = self._setting(step, end - start, solver, accept_lower_order, False, 0, threads)
        directions = 2 * dimension
        found = _native.transition(
            problem,
            stepping(method if method is not None else self._default(), self._constraints),
            setting,
            start,
            np.repeat(q0.reshape(1, -1), directions, axis=0),
            np.repeat(p0.reshape(1, -1), directions, axis=0),
            np.empty((directions, 0)),
            np.eye(directions),
            end,
        )
        _raise_of(found)
        derivative = np.ascontiguousarray(found["displacements"].T)
        return found["end_q"][0].reshape(q0.shape), found["end_p"][0].reshape(p0.shape), derivative

    def parameter_derivatives(
        self,
        *names: str,
        q: npt.ArrayLike,
        p: npt.ArrayLike | None = None,
        v: npt.ArrayLike | None = None,
        t: float,
        step: float,
        t0: float = 0.0,
        method: Method | None = None,
        parameters: Mapping[str, Any] | None = None,
        threads: int | None = None,
        solver: str | None = None,
        accept_lower_order: bool = False,
    ) -> dict[str, Array]:
        """The derivatives of the end of a run by parameters, from the variational equations of the method.

        Parameters
        ----------
        *names : str
            Names of parameters with values; all of them if none is given.
        q, p, v, t, step, t0, method, parameters, threads, solver, accept_lower_order
            See :meth:`integrate`.

        Returns
        -------
        dict of ndarray
            ∂(q, p)(t)/∂λ for each parameter λ, shape (2d,) for a number, (2d, …) for an array.

        Examples
        --------
        >>> import numpy as np
        >>> import symplectica as sy
        >>> oscillator = sy.system("{ k } q: [x], p: [px]; H = px^2/2 + k x^2/2", parameters={"k": 1.0})
        >>> found = oscillator.parameter_derivatives("k", q=[1.0], p=[0.0], t=1.0, step=0.1, method="gauss-4")
        >>> bool(abs(found["k"][0] + np.sin(1) / 2) < 1e-12)
        True
        """
        defaults = {name: np.asarray(float(Fraction(default))) for name, _, default in self._native.parameters if default is not None}
        given = {name: _arrays.numbers(value, name) for name, value in _arrays.named(parameters).items()}
        values: dict[str, Array] = {**defaults, **self._parameters, **given}
        chosen = names or tuple(values)
        for name in chosen:
            if name not in values:
                known = ", ".join(values) or "none"
                raise ArgumentError(f"there is no parameter `{name}` with a value; known here: {known}")
        start, end = _arrays.number(t0, "t0"), _arrays.number(t, "t")
        q0, p0 = self._halves(q, p, v, start, values)
        dimension, further = q0.size, sum(values[name].size for name in chosen)
        if further == 0:
            return {}
        self._problem(dimension, start, values, {})
        fixed = [(name, list(value.shape), value.ravel().tolist()) for name, value in values.items() if name not in chosen]
        shapes = [(name, list(values[name].shape)) for name, *_ in self._native.parameters if name in chosen]
        problem = _native.Problem(self._native, dimension, fixed, [], shapes, start if self._native.has_friction else 0.0)
        numbers = np.concatenate([values[name].ravel() for name, _ in shapes])
        displacements = np.zeros((further, 2, dimension + further))
        for number in range(further):
            displacements[number, :, dimension + number] = 1.0
        found = _native.transition(
            problem,
            stepping(method if method is not None else self._default(), self._constraints),
            self._setting(step, end - start, solver, accept_lower_order, False, 0, threads),
            start,
            np.tile(np.concatenate([q0.ravel(), numbers]), (further, 1)),
            np.tile(np.concatenate([p0.ravel(), numbers]), (further, 1)),
            np.empty((further, 0)),
            displacements.reshape(further, -1),
            end,
        )
        _raise_of(found)
        halves = found["displacements"].reshape(further, 2, dimension + further)[:, :, :dimension].reshape(further, 2 * dimension)
        made, first = {}, 0
        for name, shape in shapes:
            size = values[name].size
            made[name] = np.ascontiguousarray(halves[first : first + size].T).reshape(2 * dimension, *shape)
            first += size
        return {name: made[name] for name in chosen}

    def compare(
        self,
        methods: Sequence[Method] | None = None,
        q: npt.ArrayLike | None = None,
        p: npt.ArrayLike | None = None,
        *,
        t: float,
        steps: npt.ArrayLike,
        v: npt.ArrayLike | None = None,
        t0: float = 0.0,
        parameters: Mapping[str, Any] | None = None,
        reference: tuple[npt.ArrayLike, npt.ArrayLike] | None = None,
        repeats: int = 3,
    ) -> Comparison:
        """Error against run time of methods on this system: see :class:`Comparison`.

        Parameters
        ----------
        methods : list, optional
            Methods; by default those of the README's table for this kind of system.
        q, p : array_like
            The start.
        t : float
            The end.
        steps : list of float
            Step sizes.
        reference : (q, p), optional
            The exact end. By default it is computed with ``gauss-8`` and a step small enough that halving it changes nothing but rounding.
        repeats : int
            The time of a run is the median of this number of runs.
        """
        from ._compare import compare

        if q is not None and v is not None:
            q, p = self._halves(q, p, v, _arrays.number(t0, "t0"), _arrays.named(parameters))
        return compare(self, methods, q, p, t=t, steps=steps, t0=t0, parameters=parameters, reference=reference, repeats=repeats)


def _times(output: Any, start: float, end: float) -> list[float]:
    times = _arrays.numbers(output, "output")
    if times.ndim != 1 or times.size == 0:
        raise ArgumentError("`output` must be a list of at least one time, or a whole number")
    sign = 1.0 if end >= start else -1.0
    if (np.diff(times) * sign < 0).any():
        raise ArgumentError("the times in `output` must be sorted from `t0` to `t`")
    if (times[0] - start) * sign < 0 or (end - times[-1]) * sign < 0:
        raise ArgumentError(f"the times in `output` must be from t0 = {start} to t = {end}; found {times[0]} to {times[-1]}")
    return list(times.tolist())


def _displacements(q: Array, p: Array, is_explicit: bool) -> Array:
    """A displacement of each start in a direction without any symmetry, the same in every run."""
    count, dimension = q.shape
    direction = np.sin(1.0 + 7.3 * np.arange(2 * dimension) ** 1.1)
    direction /= np.linalg.norm(direction)
    largest = np.maximum(abs(q).max(axis=1), abs(p).max(axis=1))
    length = np.where(largest > 0, largest, 1.0)
    if is_explicit:
        # It may grow by 10^580 without an overflow.
        length = np.maximum(1e-280 * length, 1e-290)
    return np.ascontiguousarray(length[:, None] * direction[None, :])


def _raise_of(found: dict[str, Any]) -> None:
    """Raises what stopped trajectories that belong together."""
    if (signal := found["interrupted"]) is not None:
        raise signal
    if found["failures"]:
        _, message, kind = found["failures"][0]
        raise StepError(message, kind=kind)


def _interrupted(signal: BaseException, result: Any) -> BaseException:
    return Interrupted(result) if isinstance(signal, KeyboardInterrupt) else signal


def system(
    formula: Any,
    *,
    q: Sequence[Any] | None = None,
    p: Sequence[Any] | None = None,
    v: Sequence[Any] | None = None,
    t: Any = None,
    parameters: Mapping[str, Any] | None = None,
    constraints: Any = None,
    nonholonomic: Any = None,
    force: Mapping[Any, Any] | None = None,
    friction: Any = None,
) -> System:
    """A system from the formula of its Hamiltonian or Lagrangian.

    Parameters
    ----------
    formula : str or SymPy expression
        A text in the language of the macros ``hamiltonian!`` and ``lagrangian!``, or H or L in SymPy together with `q` and `p`, or `v`.
    q, p, v : list of SymPy symbols
        Positions and momenta of H; positions and velocities of L.
    t : SymPy symbol, optional
        The time.
    parameters : dict
        Values by name (or by symbol).
    constraints, nonholonomic, force, friction
        SymPy expressions: see the chapter on Python of the book.

    Raises
    ------
    DefinitionError
        For a wrong formula, with the place of the fault.

    Examples
    --------
    >>> import symplectica as sy
    >>> kepler = sy.system("q: [2], p: [2]; H = |p|^2/2 - 1/|q|")
    >>> kepler.is_separable
    True
    >>> sy.system("q: [x], p: [px]; H = px^2/2 + y")
    Traceback (most recent call last):
        ...
    symplectica._errors.DefinitionError: unknown name `y`; ...
    """
    if isinstance(formula, str):
        others = (q, p, v, t, constraints, nonholonomic, force, friction)
        if any(other is not None for other in others):
            raise ArgumentError("a formula in text contains its coordinates, constraints and forces itself: leave out the other arguments")
        return System(formula, parameters)
    from ._sympy import text_of

    text, values = text_of(
        formula,
        q=q,
        p=p,
        v=v,
        t=t,
        parameters=parameters,
        constraints=constraints,
        nonholonomic=nonholonomic,
        force=force,
        friction=friction,
    )
    return System(text, values, source="the formula from SymPy")
