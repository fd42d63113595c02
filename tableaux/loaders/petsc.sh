#!/usr/bin/env bash
# TS of PETSc, 3.19.4 or later; Debian 12 has an older one. The Python package has the source:
#     pip download --no-deps --no-binary :all: petsc==3.26.1 && tar xf petsc-3.26.1.tar.gz && cd petsc-3.26.1
#     ./configure PETSC_ARCH=arch --with-mpi=0 --with-fc=0 --with-cxx=0 --with-debugging=0 --with-x=0   # needs libopenblas-dev
#     make PETSC_ARCH=arch CC_FLAGS="-fPIC -fvisibility=hidden -O0 -w" all
#     export PETSC_PKG_CONFIG=$PWD/arch/lib/pkgconfig
set -euo pipefail
here=$1
cd "$2"
export PKG_CONFIG_PATH=${PETSC_PKG_CONFIG:-}
pkg-config --exists 'PETSc >= 3.19.4' || { echo "not found in version 3.19.4 or later, PETSC_PKG_CONFIG is its pkgconfig" >&2; exit 77; }
bash "$here/list.sh" petsc register create >petsc.h
# What the comment says about the call: TSIRKSetNumStages(ts, 2), TSIRKSetType(ts, "gauss_2").
sed -nE 's/.*TSIRKSetNumStages\(ts, ([0-9]+)\), TSIRKSetType\(ts, "(.*)"\).*/#define STAGES_\2 \1/p' ./*.petsc >>petsc.h
read -ra flags <<<"$(pkg-config --cflags --libs PETSc)"
cc -std=c99 -Wall -Wno-unused-function -I. "$here/petsc.c" -o petsc.program "${flags[@]}" \
    -Wl,-rpath,"$(pkg-config --variable=libdir PETSc)" -lm
OPENBLAS_NUM_THREADS=1 ./petsc.program
