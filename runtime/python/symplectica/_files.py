"""Files of results, and runs from a file as by ``symplectic run``."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from . import _arrays
from ._errors import ArgumentError


def save(path: str | Path, arrays: Mapping[str, Any], facts: Mapping[str, Any], table: Callable[[], Any]) -> None:
    """Writes arrays with facts about them to a file, or the table to a file of a table."""
    suffix = Path(path).suffix
    if suffix == ".npz":
        np.savez(path, **arrays, **facts)
    elif suffix in (".h5", ".hdf5"):
        import h5py

        with h5py.File(path, "w") as file:
            for name, array in arrays.items():
                file[name] = array
            file.attrs.update(facts)
    elif suffix == ".parquet":
        table().to_parquet(path)
    elif suffix == ".csv":
        table().to_csv(path, index=False)
    else:
        raise ArgumentError(f"the name of the file `{path}` must end in .npz, .h5, .parquet or .csv")


def parameter_facts(parameters: Mapping[str, Any]) -> dict[str, Any]:
    """Values of parameters by the names that they have in files."""
    return {f"parameter_{name}": value for name, value in parameters.items()}


def run_file(path: str | Path, *, threads: int | None = None, shard: tuple[int, int] | None = None, resume: bool = False) -> str:
    """Integrates the ensemble of a setup file in TOML and writes its results to NPZ, Parquet or CSV, as ``symplectic run`` does.

    The run has its own process: results need no memory in this one, and an interrupted run can be resumed.

    Parameters
    ----------
    path : str or Path
        The setup file: see "Runs from a file" in the book.
    threads : int, optional
        The number of threads.
    shard : (int, int), optional
        Run only part i of n.
    resume : bool
        Continue an interrupted run.

    Returns
    -------
    str
        The summary of the run.

    Raises
    ------
    ArgumentError
        For a wrong file, with the place of the fault.
    """
    arguments = [sys.executable, "-m", "symplectica", "run", str(path)]
    if threads is not None:
        arguments += ["--threads", str(_arrays.count(threads, "threads", 1))]
    if shard is not None:
        if not isinstance(shard, tuple) or len(shard) != 2:
            raise ArgumentError(f"`shard` must be (part, number of parts), such as (0, 4), found {shard!r}")
        arguments += ["--shard", f"{shard[0]}/{shard[1]}"]
    if resume:
        arguments.append("--resume")
    done = subprocess.run(arguments, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise ArgumentError(done.stderr.removeprefix("error: ").rstrip() or done.stdout.rstrip())
    return done.stdout
