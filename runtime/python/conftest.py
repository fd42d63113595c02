"""Examples in modules for packages that are not installed are not run."""

from importlib.util import find_spec

_OPTIONAL = {"jax": ["jax.py"], "torch": ["torch.py"], "rebound": ["rebound.py"], "sympy": ["_sympy.py", "_printed.py"]}

collect_ignore = [f"symplectica/{file}" for package, files in _OPTIONAL.items() if find_spec(package) is None for file in files]
