"""The chapter on Python of the book: its blocks of code run, one after the other. The notebooks are committed without results."""

import json
import re
from pathlib import Path

import pytest

BOOK = Path(__file__).parents[3] / "docs" / "src" / "guide" / "python.md"

NOTEBOOKS = sorted((Path(__file__).parents[1] / "notebooks").glob("*.ipynb"))

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


@pytest.mark.parametrize("path", NOTEBOOKS, ids=[path.stem for path in NOTEBOOKS])
def test_notebooks_have_code_that_compiles_and_no_results(path):
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    assert 8 <= len(cells) <= 25 and cells[0]["cell_type"] == "markdown"
    for cell in cells:
        if cell["cell_type"] == "code":
            compile("".join(cell["source"]), f"{path.name}, {cell['id']}", "exec")
            assert cell["outputs"] == [] and cell["execution_count"] is None
