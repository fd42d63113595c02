"""Changes digits of certificates and tables, one at a time, and prints those changes with which the program calls them right.

    python3 mutations.py FOLDER all-of NAME... sampled STEP NAME... random COUNT

`random` changes this many digits of each certificate of the folder, the same ones in each run.
"""

import random
import re
import sys
from pathlib import Path

# What the program checks of tables: exact functions of the nodes, decimals, stable steps, and these claims.
CLAIMS = re.compile(r'(order|refuted_by|value|wanted|residual) = ("[^"]*"|\d+)')
UNKNOWN = re.compile(r"root\(|exp\(|tan\(|pi|\be\b")  # Of expressions, which the program does not evaluate.
DIGITS = "0123456789"
HEXADECIMAL = re.compile(r'"-?0x[0-9a-f.]+p[+-][0-9]+"')


def in_certificate(text):
    """All digits, also hexadecimal ones, but those of the name."""
    name = re.search(r'"name": "[^"]*"', text)
    letters = {k for double in HEXADECIMAL.finditer(text) for k in range(*double.span()) if text[k] in "abcdef"}
    for k, c in enumerate(text):
        # The x and the first 0 are the notation.
        notation = text[k + 1 : k + 2] == "x"
        if (c in "0123456789" or k in letters) and not notation and k not in range(*name.span()):
            yield k


def in_table(text, certificate):
    """The digits that are claims and checked without the expressions of fields."""
    section, start = "", 0
    for line in text.splitlines(keepends=True):
        if line.startswith("["):
            section = line.strip()
        code = line.partition("#")[0]
        exact = section == "[exact]" and "node_polynomial" in text
        if exact or section == "[decimals]" or line.startswith("stages"):
            yield from (start + k for k, c in enumerate(code) if c.isdigit())
        elif section == "[order]" and line.startswith(("general", "separable", "nystrom", "perturbed")):
            for claim in CLAIMS.finditer(line):
                known = not UNKNOWN.search(claim[2]) and not (line.startswith("perturbed") and 'layout": "matrices' in certificate)
                yield from (start + k for k in range(*claim.span(2)) if line[k] in DIGITS and known)
        elif section == "[stability]" and line.startswith(("intervals", "decimal", "trace")) and '"stability":' in certificate:
            known = not line.startswith("trace") or "numerator" in certificate
            yield from (start + k for k, c in enumerate(line) if c in DIGITS and known)
        start += len(line)


def changed(text, place):
    digits = "0123456789abcdef" if text[place] in "abcdef" else "0123456789"
    return text[:place] + digits[(digits.index(text[place]) + 1) % len(digits)] + text[place + 1 :]


def main(folder, *names):
    sys.path.insert(0, folder)
    import check_certificate as check
    from checker.tables import table

    def is_right(function, *arguments):
        try:
            return function(*arguments) or True
        except check.WRONG:
            return False

    def report(path, text, place, other):
        line = text[:place].count("\n") + 1
        print(f"{path.name}, line {line}: {other.splitlines()[line - 1]}")

    step, tried, names = 1, 0, list(names)
    while names:
        name = names.pop(0)
        if name == "random":
            count = int(names.pop(0))
            for path in sorted((Path(folder) / "certificates").glob("*.json")):
                text = path.read_text(encoding="utf-8")
                for place in random.Random(path.stem).sample(list(in_certificate(text)), count):
                    tried += 1
                    other = changed(text, place)
                    if is_right(check.check, other):
                        report(path, text, place, other)
            continue
        if name in ("all-of", "sampled"):
            step = 1 if name == "all-of" else int(names.pop(0))
            continue
        paths = [Path(folder) / "certificates" / f"{name}.json", Path(folder) / f"{name}.toml"]
        texts = [path.read_text(encoding="utf-8") for path in paths]
        certificate, exact, _ = check.check(texts[0])
        # The tests of `symplectic check` change all digits of ten tables, and some of each other table that is not long.
        checks = (
            (in_certificate, (), check.check, step),
            (in_table, (texts[0],), lambda text: table(text, certificate, exact), max(step, 11)),
        )
        for path, text, (places, others, is_checked, stride) in zip(paths, texts, checks):
            is_checked(text)
            for place in list(places(text, *others))[stride // 2 :: stride]:
                tried += 1
                other = changed(text, place)
                if is_right(is_checked, other):
                    report(path, text, place, other)
    print(f"{tried} changes")


main(*sys.argv[1:])
