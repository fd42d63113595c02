"""Shared systems of the tests."""

import pytest

import symplectica as sy

KEPLER = "q: [2], p: [2]; H = |p|^2/2 - 1/|q|"
PENDULUM = "Pendulum { g: 9.81 } q: [a], p: [pa]; H = pa^2/2 - g cos(a)"
OSCILLATOR = "q: [x], p: [px]; H = px^2/2 + x^2/2"


@pytest.fixture
def kepler() -> sy.System:
    return sy.system(KEPLER)


@pytest.fixture
def pendulum() -> sy.System:
    return sy.system(PENDULUM)


@pytest.fixture
def oscillator() -> sy.System:
    return sy.system(OSCILLATOR)
