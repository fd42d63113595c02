"""Symplectic integrators for Hamiltonian systems: methods derived and proved exactly, at the speed of compiled code.

A formula as text or from SymPy, a method by name or derived and proved on the spot, NumPy arrays in and out:

>>> import symplectica as sy
>>> kepler = sy.system("q: [2], p: [2]; H = |p|^2/2 - 1/|q|")
>>> run = kepler.integrate([0.4, 0], [0, 2], t=1000, step=0.05, method="gauss-8")
>>> bool(abs(run.energy_error).max() < 1e-13)
True

================================  =====================================================================================
methods                           :func:`tableau`, :func:`splitting`, :func:`composition`, :func:`catalogue`,
                                  :func:`method`, :class:`Doubles`
methods by design                 :func:`search`
tables of others                  :func:`audit`, :func:`import_table`, :func:`refine`
systems                           :func:`system`, :class:`System`
runs                              :meth:`System.integrate`, :meth:`System.ensemble`, :meth:`System.compare`
derivatives of runs               :meth:`System.state_transition`, ``symplectica.jax``, ``symplectica.torch``
in place of SciPy's               :func:`solve_ivp`
Python functions, slowly          :func:`python_function`
from and to REBOUND               ``symplectica.rebound``
the command line                  ``python -m symplectica``, :func:`run_file`
================================  =====================================================================================
"""

from ._compare import Comparison, Measurement
from ._ensemble import Ensemble, Failure
from ._errors import ArgumentError, DefinitionError, Interrupted, ProofError, StepError, SymplecticError
from ._events import Event, Events, States
from ._files import run_file
from ._function import python_function
from ._native import __version__
from ._run import Run
from ._scipy import solve_ivp
from ._search import FoundMethod, Search, search
from ._system import Equations, System, system
from ._tableau import Doubles, Entry, Order, Properties, Property, Stability, Tableau, catalogue, composition, method, splitting, tableau
from ._tables import Audit, Refinement, audit, import_table, refine

__all__ = [
    "ArgumentError",
    "Audit",
    "Comparison",
    "DefinitionError",
    "Doubles",
    "Ensemble",
    "Entry",
    "Equations",
    "Event",
    "Events",
    "Failure",
    "FoundMethod",
    "Interrupted",
    "Measurement",
    "Order",
    "ProofError",
    "Properties",
    "Property",
    "Refinement",
    "Run",
    "Search",
    "Stability",
    "States",
    "StepError",
    "SymplecticError",
    "System",
    "Tableau",
    "__version__",
    "audit",
    "catalogue",
    "composition",
    "import_table",
    "method",
    "python_function",
    "refine",
    "run_file",
    "search",
    "solve_ivp",
    "splitting",
    "system",
    "tableau",
]
