#!/usr/bin/env bash
# fractions and mpmath (also NumPy): python3 -m venv ENVIRONMENT && ENVIRONMENT/bin/pip install mpmath numpy,
# and PYTHON as in nodepy.sh.
set -euo pipefail
here=$1
cd "$2"
"${PYTHON:-python3}" -c "import mpmath, numpy" 2>/dev/null || { echo "mpmath or NumPy not found, PYTHON is a Python that has it" >&2; exit 77; }
"${PYTHON:-python3}" "$here/python_methods.py"
