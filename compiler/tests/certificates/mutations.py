"""Changes digits of files, one at a time, and prints those changes with which the program for certificates calls a file right.

    python3 mutations.py FOLDER all-of NAME... sampled NAME...
"""

import re
import sys
from pathlib import Path

# What the program checks: exact numbers, decimals, and these claims.
CLAIMS = re.compile(r'(order|refuted_by|value|wanted|residual) = ("[^"]*"|\d+)')


def places(text):
    """The digits that are claims."""
    section, start = "", 0
    for line in text.splitlines(keepends=True):
        if line.startswith("["):
            section = line.strip()
        code = line.partition("#")[0]
        if section in ("[exact]", "[decimals]") or line.startswith("stages"):
            yield from (start + i for i, c in enumerate(code) if c.isdigit())
        elif section == "[order]" and line.startswith(("general", "separable", "nystrom")):
            for claim in CLAIMS.finditer(line):
                # A long value is cut off, and is not compared.
                if "…" not in claim[2]:
                    span = range(*claim.span(2))
                    yield from (start + i for i in span if line[i].isdigit())
        start += len(line)


def is_right(check, text):
    try:
        check.check(text)
    except (check.Rejected, check.Unchecked, KeyError, ValueError, TypeError, ArithmeticError):
        return False
    return True


def main(folder, *names):
    sys.path.insert(0, folder)
    import check_certificate as check

    step, tried = 1, 0
    for name in names:
        if name in ("all-of", "sampled"):
            step = 1 if name == "all-of" else 53
            continue
        text = (Path(folder) / f"{name}.toml").read_text(encoding="utf-8")
        assert is_right(check, text), name
        for place in list(places(text))[::step]:
            changed = text[:place] + str((int(text[place]) + 1) % 10) + text[place + 1 :]
            tried += 1
            if is_right(check, changed):
                line = text[:place].count("\n") + 1
                print(f"{name}, line {line}: {changed.splitlines()[line - 1]}")
    print(f"{tried} changes")


main(*sys.argv[1:])
