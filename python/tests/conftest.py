"""Shared by the tests: the command line's program, which they compare the package with."""

import os
import subprocess
import sys

import pytest


@pytest.fixture(scope="session")
def tinta():
    """Runs the program that the package brings, or TINTA: `tinta("render", "builtin:gear", "-o", "gear.svg")`; returns its exit code
    and error."""
    program = [os.environ["TINTA"]] if "TINTA" in os.environ else [sys.executable, "-m", "tinta_npr"]

    def run(*words):
        done = subprocess.run([*program, *map(str, words)], capture_output=True, text=True)
        return done.returncode, done.stderr.strip()

    return run


def pytest_configure(config):
    config.addinivalue_line("markers", "slow: takes seconds")


CUBE = (
    [(x, y, z) for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)],
    [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)],
)


@pytest.fixture
def cube():
    """Vertices and squares of the unit cube, counter-clockwise seen from outside."""
    import numpy as np

    return np.array(CUBE[0]), np.array(CUBE[1])


@pytest.fixture(autouse=True)
def in_a_folder_of_its_own(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
