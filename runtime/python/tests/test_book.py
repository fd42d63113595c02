"""The chapter on Python of the book: its blocks of code run, one after the other."""

import re
from pathlib import Path

import pytest

BOOK = Path(__file__).parents[3] / "docs" / "src" / "guide" / "python.md"

#: Packages without which a block is left out.
OPTIONAL = {"jax", "rebound"}


@pytest.mark.skipif(not BOOK.is_file(), reason="the book is not here")
def test_the_code_of_the_book_runs(tmp_path, monkeypatch):
    pytest.importorskip("sympy")
    monkeypatch.chdir(tmp_path)
    text, names, count = BOOK.read_text(encoding="utf-8"), {"__name__": "book"}, 0
    for block in re.finditer(r"^```python\n(.*?)^```", text, re.MULTILINE | re.DOTALL):
        # With its line numbers, so that an error shows the place.
        code = "\n" * text.count("\n", 0, block.start(1)) + block[1]
        try:
            exec(compile(code, str(BOOK), "exec"), names)
        except ModuleNotFoundError as error:
            if error.name not in OPTIONAL:
                raise
        count += 1
    assert count >= 15
