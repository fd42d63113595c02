#!/usr/bin/env bash
# Loads the exports of every method of the catalogue with the libraries that they are for, and prints what became of them:
#     bash tableaux/loaders/catalogue.sh
# Each script beside this one says what its library is and how to install it. A library that is not there is left out.
# PROGRAM is the path of `symplectic`, which is built if there is none. The exit status is 1 if a library holds or steps other
# numbers than `symplectic show NAME --format json`.
set -euo pipefail
cd "$(dirname "$0")"
here=$PWD
work=$(mktemp -d)
trap 'rm -r "$work"' EXIT
if [ -z "${PROGRAM:-}" ]; then
    (cd ../.. && cargo build --quiet --release -p symplectic-cli)
    PROGRAM="${CARGO_TARGET_DIR:-$here/../../target}/release/symplectic"
fi
export PROGRAM

# NAME.json, and NAME.FORMAT for every format that does not refuse the method; the reason is in NAME.FORMAT.refused.
write() {
    for format in json sundials petsc nodepy python fortran; do
        if "$PROGRAM" show "$1" --format "$format" >"$1.$format" 2>error."$1"; then
            continue
        fi
        rm "$1.$format"
        sed -n 's/^error: [A-Za-z]* cannot express this method: //p' error."$1" >"$1.$format.refused"
    done
    rm -f error."$1"
}
export -f write
cd "$work"
for table in "$here"/../*.toml; do basename "$table" .toml; done | xargs -P "$(nproc)" -I {} bash -c 'write {}'

status=0
for library in sundials petsc nodepy python fortran; do
    if reason=$(bash "$here/$library.sh" "$here" "$work" 2>&1 >"$library.loaded"); then
        python3 "$here/compare.py" "$library" || status=1
        # Another last digit is noticed.
        sed -i '2{s/[^0]$/0/;t;s/0$/1/}' "$library.loaded"
        if python3 "$here/compare.py" "$library" >/dev/null; then
            echo "$library: a wrong digit is not noticed"
            status=1
        fi
    elif [ $? -eq 77 ]; then
        echo "$library: $reason"
    else
        echo "$library: $reason"
        status=1
    fi
done
exit $status
