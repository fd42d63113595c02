from _typeshed import Incomplete, SupportsGetItem, SupportsLenAndGetItem
from typing import Any, Final, SupportsFloat, SupportsIndex, final

__all__ = ["__version__", "Formula", "Method", "Problem", "Tableau", "audit", "catalogue", "chaos", "command", "ensemble", "import_table", "integrate", "keys", "refine", "search", "section", "transition"]

__version__: Final[str]
"""
The version of the package.
"""

@final
class Formula:
    """
    A system that is given by the formula of H or L.
    """
    def __new__(cls, /, source: str, text: str) -> Formula:
        """
        Reads a formula and checks what it requires and declares.
        """
    @property
    def conserves_energy(self, /) -> bool:
        """
        Whether H is the same along every trajectory.
        """
    @property
    def constraints(self, /) -> bool | None:
        """
        Whether the constraints are holonomic, if there are any.
        """
    @property
    def coordinates(self, /) -> list[list[str]] | None:
        """
        The names of positions and momenta, if they have names.
        """
    def describe(self, /, format: str) -> str:
        """
        The text of `symplectic derive-system`.
        """
    def equations(self, /, latex: bool) -> list[str]:
        """
        The equations of motion.
        """
    def facts(self, /) -> list[str]:
        """
        What was found in the formula, a sentence each.
        """
    @property
    def function(self, /) -> str:
        """
        `H` or `L`.
        """
    def hamiltonian(self, /, latex: bool) -> str:
        """
        The Hamiltonian, also of a Lagrangian.
        """
    @property
    def has_friction(self, /) -> bool: ...
    @property
    def is_separable(self, /) -> bool:
        """
        Whether H = T(t, p) + U(t, q) and no force depends on momenta.
        """
    @property
    def layout(self, /) -> tuple[int | None, int]:
        """
        The number of coordinates, or of bodies, if the formula fixes it, and the number of components of each.
        """
    @property
    def name(self, /) -> str: ...
    def names(self, /, dimension: SupportsIndex) -> list[list[str]]:
        """
        The name of each component of a position and of a momentum, for columns of a table.
        """
    @property
    def parameters(self, /) -> list[tuple[str, list[str], str | None]]:
        """
        Name, lengths (none for a number, `pairs` for pairs of indices) and default of each parameter.
        """
    @property
    def refusal(self, /) -> str | None:
        """
        Why no run is possible with this formula in Python, if so.
        """
    @property
    def text(self, /) -> str: ...

@final
class Method:
    """
    A method that takes steps.
    """
    @staticmethod
    def derived(tableau: Tableau, holonomic: bool | None = None) -> Method:
        """
        A derived method, with its steps for constraints if there are any: holonomic ones or not.
        """
    @property
    def is_explicit(self, /) -> bool: ...
    @property
    def name(self, /) -> str: ...
    @staticmethod
    def of_doubles(name: str, a: SupportsGetItem[int, SupportsGetItem[int, SupportsFloat | SupportsIndex]], a_tilde: SupportsGetItem[int, SupportsGetItem[int, SupportsFloat | SupportsIndex]], b: SupportsGetItem[int, SupportsFloat | SupportsIndex], b_tilde: SupportsGetItem[int, SupportsFloat | SupportsIndex], orders: SupportsLenAndGetItem[SupportsIndex]) -> Method:
        """
        A method of doubles, about which nothing is proved. `orders` are believed.
        """
    @property
    def orders(self, /) -> tuple[int, int, int]:
        """
        The orders for general, separable and Nyström Hamiltonians.
        """
    @property
    def stages(self, /) -> int: ...

@final
class Problem:
    """
    A formula with values.
    """
    def __new__(cls, /, formula: Formula, dimension: SupportsIndex, parameters: SupportsGetItem[int, tuple[str, SupportsGetItem[int, SupportsIndex], SupportsGetItem[int, SupportsFloat | SupportsIndex]]], varied: SupportsGetItem[int, tuple[str, SupportsGetItem[int, SupportsIndex]]], further: SupportsGetItem[int, tuple[str, SupportsGetItem[int, SupportsIndex]]], start: SupportsFloat | SupportsIndex) -> Problem:
        """
        A formula in a number of coordinates. `parameters` have their values; each of `varied` has its dimensions only, because its values
        differ between trajectories. So has each of `further`, whose values are further coordinates, after the positions and after the momenta.
        """
    def constraint_errors(self, /, t: Incomplete, q: Incomplete, p: Incomplete, varied: Incomplete) -> Incomplete | None:
        """
        The largest |φ| or |w·q'| at states in rows.
        """
    def energies(self, /, t: Incomplete, q: Incomplete, p: Incomplete, varied: Incomplete) -> Incomplete:
        """
        H at states in rows.
        """
    @property
    def energy_is_conserved(self, /) -> bool: ...
    def energy_unit(self, /, t: SupportsFloat | SupportsIndex, q: SupportsGetItem[int, SupportsFloat | SupportsIndex], p: SupportsGetItem[int, SupportsFloat | SupportsIndex], varied: SupportsGetItem[int, SupportsFloat | SupportsIndex]) -> float:
        """
        What errors of H are relative to: |H| at a start, or the size of its terms if H there is nothing but rounding.
        """
    def evaluate(self, /, text: str, t: Incomplete, q: Incomplete, p: Incomplete, varied: Incomplete) -> Incomplete:
        """
        An expression at states in rows.
        """
    def invariant(self, /, number: SupportsIndex, t: Incomplete, q: Incomplete, p: Incomplete, varied: Incomplete) -> list[Incomplete]:
        """
        The components of a conserved function at states in rows, one after another.
        """
    @property
    def invariants(self, /) -> list[tuple[str, int]]:
        """
        Names of the conserved functions, with their numbers of components.
        """
    def momentum(self, /, t: SupportsFloat | SupportsIndex, q: SupportsGetItem[int, SupportsFloat | SupportsIndex], v: SupportsGetItem[int, SupportsFloat | SupportsIndex], varied: SupportsGetItem[int, SupportsFloat | SupportsIndex]) -> list[float]:
        """
        The momentum of a velocity. H must be quadratic in the momenta.
        """
    @property
    def size(self, /) -> tuple[int, int]:
        """
        The numbers of coordinates, and of parameters that vary.
        """
    def velocity(self, /, t: SupportsFloat | SupportsIndex, q: SupportsGetItem[int, SupportsFloat | SupportsIndex], p: SupportsGetItem[int, SupportsFloat | SupportsIndex], varied: SupportsGetItem[int, SupportsFloat | SupportsIndex]) -> list[float]:
        """
        The velocity at a state.
        """

@final
class Tableau:
    """
    A derived tableau, with its proofs.
    """
    def adjoint(self, /) -> Tableau:
        """
        The adjoint method.
        """
    def certificate(self, /) -> str:
        """
        The certificate for the independent checker.
        """
    @property
    def definition(self, /) -> list[tuple[str, str]]:
        """
        The keys of its definition with their values.
        """
    @staticmethod
    def derive(parts: SupportsGetItem[int, tuple[str, str]], name: str | None = None, max_stages: SupportsIndex | None = None) -> Tableau:
        """
        Derives the tableau of a definition: its keys with their values.
        """
    def doubles(self, /) -> list[tuple[str, list[list[float]]]]:
        """
        The correctly rounded doubles: `a`, `a_tilde`, and one row for each of `b`, `b_tilde`, `c`, `c_tilde`.
        """
    def emit(self, /, language: str, formula: Formula | None = None, kind: str | None = None) -> str:
        """
        A program that takes steps with the method, and with a formula if there is one.
        """
    def exact(self, /) -> list[tuple[str, list[list[str | None]]]]:
        """
        The exact forms, `None` where there is no short one.
        """
    @property
    def forces(self, /) -> int | None:
        """
        Forces per step of a method that is explicit for separable H.
        """
    def has_coefficients_of(self, /, other: Tableau) -> bool:
        """
        Whether another tableau has the same coefficients.
        """
    @property
    def name(self, /) -> str | None:
        """
        Its name, if it has one.
        """
    @staticmethod
    def of_catalogue(name: str, max_stages: SupportsIndex | None = None) -> Tableau:
        """
        A method of the catalogue.
        """
    @staticmethod
    def read(source: str, text: str, max_stages: SupportsIndex | None = None) -> Tableau:
        """
        The tableau of a text in TOML or JSON, proved again and compared with the text.
        """
    def require(self, /, requirement: str, accepted_bits: SupportsIndex | None = None) -> None:
        """
        Decides a requirement such as `symplectic` or `order(separable) == 4`.
        """
    def separable_properties(self, /) -> list[tuple[str, bool, str, int | None, str | None]]:
        """
        What holds for separable H: name, whether it holds, evidence, binary places of a verification, witness.
        """
    @property
    def source(self, /) -> str | None:
        """
        The source of the method, if it is known.
        """
    @property
    def stable_steps(self, /) -> str:
        """
        The stable steps hω on the oscillator, as text.
        """
    @property
    def stages(self, /) -> int:
        """
        The number of stages.
        """
    def toml(self, /) -> str:
        """
        All exact data, to derive it again.
        """
    def write(self, /, format: str, digits: SupportsIndex | None = None) -> str:
        """
        The tableau in a format of the command line.
        """
    @property
    def wrong_digits(self, /) -> list[str]:
        """
        The printed numbers of a claim that are not correctly rounded.
        """

def audit(name: str, text: str) -> str:
    """
    Compares the claims of a text in TOML with proofs; the result is JSON.
    """

def catalogue() -> list[tuple[str, str, str, int, str]]:
    """
    Name, title, definition, number of stages and source of each method.
    """

def chaos(problem: Problem, method: Method, setting: Incomplete, time: SupportsFloat | SupportsIndex, q: Incomplete, p: Incomplete, varied: Incomplete, displacements: Incomplete, end: SupportsFloat | SupportsIndex, progress: Any | None) -> dict:
    """
    Mean MEGNO and largest Lyapunov exponent of many starts, with a displacement (δq, δp) of each.
    """

def command(arguments: SupportsGetItem[int, str]) -> int:
    """
    Runs a command with its arguments and returns its exit status. Wrong arguments end the process.
    """

def ensemble(problem: Problem, method: Method, setting: Incomplete, time: SupportsFloat | SupportsIndex, q: Incomplete, p: Incomplete, varied: Incomplete, end: SupportsFloat | SupportsIndex, times: SupportsGetItem[int, SupportsFloat | SupportsIndex], progress: Any | None) -> dict:
    """
    Trajectories of many starts: their ends, and with `times` the states there in arrays of shape (n, times, dimension).
    """

def import_table(library: str, name: str, text: str) -> tuple[Tableau, str | None]:
    """
    Reads a table in the language of another library; returns the tableau, and how its coefficients follow from the numbers if these are
    not exact.
    """

def integrate(problem: Problem, method: Method, setting: Incomplete, time: SupportsFloat | SupportsIndex, q: Incomplete, p: Incomplete, varied: Incomplete, end: SupportsFloat | SupportsIndex, output: SupportsGetItem[int, SupportsFloat | SupportsIndex] | SupportsIndex, events: SupportsGetItem[int, tuple[str, str, bool, SupportsIndex | None, SupportsGetItem[int, tuple[str, str]], SupportsIndex | None]], progress: Any | None) -> dict:
    """
    The trajectory of a start: a dictionary with the states at the output times and at events, the last state, the counts, the error of a
    step that failed, and the exception of a signal.
    """

def keys() -> list[tuple[str, str | None, str]]:
    """
    The keys of a definition: name, what the value is called (nothing for a switch), and what it is.
    """

def refine(name: str, text: str, digits: SupportsIndex, json: bool, nearest: bool) -> str:
    """
    Proves that an exact method is near printed digits; the result is text or JSON.
    """

def search(options: SupportsGetItem[int, str]) -> tuple[int, int, int, int, int | None, list[tuple[Tableau, float, float, float, float, int]]]:
    """
    Searches with the options of the command line.
    """

def section(problem: Problem, method: Method, setting: Incomplete, time: SupportsFloat | SupportsIndex, q: Incomplete, p: Incomplete, varied: Incomplete, end: SupportsFloat | SupportsIndex, events: SupportsGetItem[int, tuple[str, str, bool, SupportsIndex | None, SupportsGetItem[int, tuple[str, str]], SupportsIndex | None]], progress: Any | None) -> dict:
    """
    Trajectories with the states at events: these one after another, with the number of states of each trajectory.
    """

def transition(problem: Problem, method: Method, setting: Incomplete, time: SupportsFloat | SupportsIndex, q: Incomplete, p: Incomplete, varied: Incomplete, displacements: Incomplete, end: SupportsFloat | SupportsIndex) -> dict:
    """
    The ends of displacements (δq, δp) of starts.
    """
