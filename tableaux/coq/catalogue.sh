#!/usr/bin/env bash
# Lets Coq check the theorem of every method of the catalogue, for two minutes of processor time at most: bash tableaux/coq/catalogue.sh
# The exit status is 1 if Coq rejects one, also if it crashes, and 2 without Coq. A theorem that needs more time is no error.
set -euo pipefail
cd "$(dirname "$0")/../.."
if ! command -v coqc >/dev/null; then
    echo "coqc is missing: install Coq, as with 'apt install coq' or 'opam install coq'" >&2
    exit 2
fi
library=$(mktemp -d)
trap 'rm -r "$library"' EXIT
cp tableaux/coq/*.v "$library"
cargo build --quiet --release -p symplectic-cli
cd "$library"
for file in Definitions Orders Symplectic Tables Nodes; do coqc -R . SPRK "$file.v"; done
TIMEFORMAT=%U
rejected=0
program="${CARGO_TARGET_DIR:-$OLDPWD/target}/release/symplectic"
for table in "$OLDPWD"/tableaux/*.toml; do
    name=$(basename "$table" .toml)
    file="${name//-/_}.v"
    if ! "$program" show "$name" --format coq >"$file" 2>error; then
        echo "$name: no theorem: $(head -1 error)"
        continue
    fi
    status=0
    time=$( { ulimit -t 120; time coqc -R . SPRK "$file" >output 2>&1; } 2>&1 ) || status=$?
    # 128 and the number of the signal with which the limit ends Coq: XCPU (24) or, after it, KILL (9).
    case $status in
        0) echo "$name: $(head -1 output), $time s" ;;
        137 | 152) echo "$name: not accepted in two minutes" ;;
        *)
            rejected=1
            echo "$name: REJECTED: $(grep -m 1 -A 1 '^Error' output | tr '\n' ' ' || head -1 output)"
            ;;
    esac
done
exit "$rejected"
