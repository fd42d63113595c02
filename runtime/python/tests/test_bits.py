"""The same system, method and step give the same doubles as a compiled program: `tests/tests/python_bits.rs` wrote the file, and tests it too."""

import json
import struct
from pathlib import Path

import pytest

import symplectica as sy

ROWS = json.loads((Path(__file__).parent / "data" / "bits.json").read_text(encoding="utf-8"))


@pytest.mark.parametrize("row", ROWS, ids=[f"{row['scene']}-{row['method']}" for row in ROWS])
def test_ends_have_the_bits_of_compiled_programs(row):
    system = sy.system(row["formula"], parameters=row["parameters"])
    run = system.integrate(row["q"], row["p"], t=row["end"], step=row["step"], method=row["method"], output=0)
    found = [*run.state[1].ravel().tolist(), *run.state[2].ravel().tolist()]
    assert [struct.pack(">d", value).hex() for value in found] == row["bits"]


def test_the_table_has_all_scenes_and_methods():
    assert len({row["scene"] for row in ROWS}) >= 5 and len({row["method"] for row in ROWS}) >= 6
