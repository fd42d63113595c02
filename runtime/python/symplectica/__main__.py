"""The command line of ``symplectic``: ``python -m symplectica derive --basis "polynomial(3)" --nodes "lobatto(3)"``."""

from __future__ import annotations

import signal
import sys

from . import _native


def main() -> int:
    """Runs a command with the arguments of this process."""
    # The library does not look at signals of Python here: Ctrl-C ends the process.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return _native.command(sys.argv[1:])


if __name__ == "__main__":
    sys.exit(main())
