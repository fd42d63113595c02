#!/usr/bin/env bash
# nodepy, with entries of SymPy:
#     python3 -m venv ENVIRONMENT && ENVIRONMENT/bin/pip install nodepy==1.1.1 six && export PYTHON=$PWD/ENVIRONMENT/bin/python
set -euo pipefail
here=$1
cd "$2"
"${PYTHON:-python3}" -c "import nodepy" 2>/dev/null || { echo "not found, PYTHON is a Python that has it" >&2; exit 77; }
"${PYTHON:-python3}" "$here/nodepy_methods.py"
