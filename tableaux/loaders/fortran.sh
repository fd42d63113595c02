#!/usr/bin/env bash
# gfortran (Debian's package), strictly Fortran 2008 and without a warning.
set -euo pipefail
cd "$2"
command -v gfortran >/dev/null || { echo "gfortran not found" >&2; exit 77; }
echo "version $(gfortran --version | sed -n '1s/ (.*) / /p'), -std=f2008"
for file in *.fortran; do
    name=$(basename "$file" .fortran | tr - _)
    {
        cat "$file"
        echo "program show"
        echo "  use, intrinsic :: iso_fortran_env, only: int64"
        echo "  use ${name}_tableau"
        echo "  implicit none"
        sed -nE 's/^  real\(real64\), parameter :: (c|b|c_tilde|b_tilde)\(.*/\1 \1/p
            s/^  real\(real64\), parameter :: (a|a_tilde)\(.*/\1 transpose(\1)/p' "$file" |
            while read -r part values; do
                echo "  print '(a,*(1x,z16.16))', '$name $part', transfer($values, [0_int64])"
            done
        echo "end program show"
    } >show.f90
    gfortran -std=f2008 -pedantic -Wall -Werror show.f90 -o show >&2
    ./show | tr A-F a-f
done
