"""Executes notebooks, and fails at the first error: ``python run.py [--save FOLDER] FILES…``."""

import argparse
import sys
import time
from pathlib import Path

import nbformat
from jupyter_client.kernelspec import KernelSpecManager
from jupyter_client.manager import AsyncKernelManager
from nbclient import NotebookClient


def execute(path: Path) -> nbformat.NotebookNode:
    """The executed copy of a notebook."""
    notebook = nbformat.read(path, as_version=4)
    # Without folders of kernels there is only that of this interpreter.
    specs = KernelSpecManager()
    specs.kernel_dirs = []
    kernel = AsyncKernelManager(kernel_name="python3", kernel_spec_manager=specs)
    client = NotebookClient(notebook, km=kernel, timeout=600, resources={"metadata": {"path": str(path.parent)}})
    return client.execute()


def main() -> None:
    parser = argparse.ArgumentParser(description="Executes notebooks; fails at the first error.")
    parser.add_argument("files", nargs="+", type=Path)
    parser.add_argument("--save", type=Path, metavar="FOLDER", help="write the executed copies to this folder")
    arguments = parser.parse_args()
    if arguments.save:
        arguments.save.mkdir(parents=True, exist_ok=True)
    for path in arguments.files:
        start = time.monotonic()
        done = execute(path)
        print(f"{path.name}: {time.monotonic() - start:.1f} s")
        if arguments.save:
            nbformat.write(done, arguments.save / path.name)


if __name__ == "__main__":
    sys.exit(main())
