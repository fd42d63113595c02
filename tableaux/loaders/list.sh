#!/usr/bin/env bash
# The exports of a library as one header, and the names of the functions in it of each kind: list.sh FORMAT KIND KIND
#     #define ALL_KIND(X) X(forest_ruth_1990) X(ruth_1983)
# A kind is the type of a function, or the end of its name.
set -euo pipefail
for file in *."$1"; do echo "#include \"$file\""; done
for kind in "${@:2}"; do
    names=$(sed -nE "s/^static ($kind ([a-z0-9_]+)\(void\)|[A-Za-z]+ ([a-z0-9_]+)_$kind\().*/X(\2\3)/p" ./*."$1" | tr '\n' ' ')
    echo "#define ALL_$kind(X) $names"
done
