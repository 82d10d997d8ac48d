"""The program `tinta`: `python -m tinta_npr render cow.obj -o cow.svg`. It has all commands but `tinta view`."""

import os
import signal
import sys

from . import _native


def main():
    """Carry out the command line of the process; returns the exit code."""
    # The program itself, or the system, answers Ctrl-C.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    # A batch starts workers by it: this process is Python's.
    os.environ["TINTA_PYTHON"] = sys.executable
    return _native.command(["tinta", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
