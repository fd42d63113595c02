"""Runs from a file, as by ``symplectic run``."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from . import _arrays
from ._errors import ArgumentError


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
        arguments += ["--shard", f"{shard[0]}/{shard[1]}"]
    if resume:
        arguments.append("--resume")
    done = subprocess.run(arguments, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise ArgumentError(done.stderr.removeprefix("error: ").rstrip() or done.stdout.rstrip())
    return done.stdout
