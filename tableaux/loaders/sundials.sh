#!/usr/bin/env bash
# ARKODE of SUNDIALS, 6.6 or later. Its source is in the crate sundials-sys 0.6.2 (SUNDIALS 7.1.1), folder `vendor`:
#     cmake -S vendor -B build -DCMAKE_INSTALL_PREFIX=$SUNDIALS_DIR -DBUILD_SHARED_LIBS=OFF -DEXAMPLES_ENABLE_C=OFF \
#         -DBUILD_CVODE=OFF -DBUILD_CVODES=OFF -DBUILD_IDA=OFF -DBUILD_IDAS=OFF -DBUILD_KINSOL=OFF && make -C build install
set -euo pipefail
here=$1
cd "$2"
include=${SUNDIALS_DIR:-/usr/local}/include
[ -e "$include/arkode/arkode_sprk.h" ] || { echo "not found, SUNDIALS_DIR is its folder" >&2; exit 77; }
bash "$here/list.sh" sundials ARKodeSPRKTable ARKodeButcherTable >sundials.h
lib=${SUNDIALS_DIR:-/usr/local}/lib
cc -std=c99 -Wall -Wno-unused-function -I. -I"$include" "$here/sundials.c" -o sundials.program -L"$lib" -Wl,-rpath,"$lib" \
    -lsundials_arkode -lsundials_nvecserial -lsundials_sunnonlinsolfixedpoint -lsundials_core -lm
./sundials.program
