#!/usr/bin/env bash
# Lets Coq check the theorem of every method of the catalogue, for two minutes of processor time at most: bash tableaux/coq/catalogue.sh
set -euo pipefail
cd "$(dirname "$0")/../.."
library=$(mktemp -d)
trap 'rm -r "$library"' EXIT
cp tableaux/coq/*.v "$library"
cargo build --quiet --release -p symplectic-cli
cd "$library"
for file in Definitions Orders Symplectic Tables Nodes; do coqc -R . SPRK "$file.v"; done
TIMEFORMAT=%U
program="${CARGO_TARGET_DIR:-$OLDPWD/target}/release/symplectic"
for table in "$OLDPWD"/tableaux/*.toml; do
    name=$(basename "$table" .toml)
    file="${name//-/_}.v"
    if ! "$program" show "$name" --format coq >"$file" 2>error; then
        echo "$name: no theorem: $(head -1 error)"
    elif time=$( { ulimit -t 120; time coqc -R . SPRK "$file" >output 2>&1; } 2>&1 ); then
        echo "$name: $(head -1 output), $time s"
    else
        echo "$name: not accepted in two minutes"
    fi
done
