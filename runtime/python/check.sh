#!/usr/bin/env bash
# Builds the wheel, installs it into a fresh environment, and tests what is installed. `.ci/run` calls it.
set -euo pipefail
cd "$(dirname "$0")"

root=$(cd ../.. && pwd)
work=${CARGO_TARGET_DIR:-$root/target}/python
rm -rf "$work"
python3 -m venv "$work/environment"
python="$work/environment/bin/python"
"$python" -m pip install --quiet --disable-pip-version-check -r requirements.txt
# As for tests, not optimised: its bits are the same.
"$work/environment/bin/maturin" build --quiet --locked --profile dev --out "$work/wheels"
"$python" -m pip install --quiet --disable-pip-version-check --no-deps "$work"/wheels/*.whl

# Outside of the sources, so that the installed files are tested.
installed=$(cd "$work" && "$python" -c "import symplectica, pathlib; print(pathlib.Path(symplectica.__file__).parent)")
case $installed in "$work"/*) ;; *) echo "not the installed package: $installed"; exit 1 ;; esac
package=$PWD tests=$PWD/tests notebooks=$PWD/notebooks
cd "$work"
echo "-- tests"
"$python" -m pytest --quiet --no-header -p no:cacheprovider "$tests"
echo "-- examples of the documentation"
# The examples of the packages that are not installed are among the tests, which skip them.
"$python" -m pytest --quiet --no-header -p no:cacheprovider --doctest-modules "$installed" \
    --ignore "$installed/jax.py" --ignore "$installed/torch.py" --ignore "$installed/rebound.py"
echo "-- types"
# `UPDATE_EXPECT=1 runtime/python/check.sh` writes the stubs of the module.
(cd "$package" && "$work/environment/bin/maturin" generate-stubs --quiet --locked --profile dev --interpreter "$python" --out "$work/stubs")
[ -z "${UPDATE_EXPECT:-}" ] || cp "$work/stubs/symplectica/_native.pyi" "$package/symplectica/_native.pyi"
diff "$package/symplectica/_native.pyi" "$work/stubs/symplectica/_native.pyi"
"$python" -m mypy --config-file "$package/pyproject.toml"
"$python" -m mypy.stubtest symplectica._native
echo "-- notebooks"
"$python" "$notebooks/run.py" "$notebooks/first_orbit.ipynb" "$notebooks/derive_and_prove.ipynb"
echo "-- the command"
"$python" -m symplectica derive --basis "polynomial(3)" --nodes "lobatto(3)" >/dev/null
