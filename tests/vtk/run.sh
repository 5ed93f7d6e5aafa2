#!/usr/bin/env bash
# Opens particle frames with the real VTK and compares them with the CSV beside them, bit by bit.
#
#   tests/vtk/run.sh [RUN_DIRECTORY...]
#
# Without a directory, on frames that a test of the runner writes (2D and 3D, with and without
# walls, awkward numbers); then it also alters one bit of them and expects that to be noticed.
#
# Needs python3 (3.9 or later, with venv). VTK, about 140 MB, is installed from the Python package
# index into a private environment, .vtk/ at the top of the repository, and kept there.
#
# Prints a line PASSED, FAILED or SKIPPED for each check. Exit status: 0 all passed; 77 skipped,
# because there is no python3 or VTK could not be downloaded; 1 anything else.
set -euo pipefail

repository=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
here=$repository/tests/vtk
environment=$repository/.vtk
python=$environment/bin/python
# Written last, so that an installation cut short is begun again.
complete=$environment/complete

skip() {
    echo "SKIPPED vtk: $1"
    exit 77
}

fail() {
    echo "FAILED vtk: $1"
    exit 1
}

install() {
    command -v python3 >/dev/null || skip "there is no python3"
    python3 -c 'import sys; sys.exit(sys.version_info < (3, 9))' || skip "python3 is older than 3.9"
    python3 -c 'import venv, ensurepip' 2>/dev/null || skip "python3 has no venv"
    rm -rf "$environment"
    python3 -m venv "$environment" || fail "no Python environment in $environment"
    local pip=("$python" -m pip --quiet --disable-pip-version-check) wheels=$environment/wheels
    # Its dependencies are for plots; reading files needs none of them.
    "${pip[@]}" download --no-deps --only-binary :all: --dest "$wheels" 'vtk>=9.3,<10' >&2 ||
        skip "VTK could not be downloaded"
    # From here on nothing but an error can go wrong.
    "${pip[@]}" install --no-deps --no-index "$wheels"/*.whl >&2 || fail "VTK could not be installed"
    rm -r "$wheels"
    touch "$complete"
}

# An environment also ends when the Python that it was made with is removed.
if ! [[ -e $complete ]] || ! "$python" -c '' 2>/dev/null; then
    install
fi

if (($# > 0)); then
    "$python" "$here/read_back.py" "$@" || exit 1
    exit
fi

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
if ! LOSCHMIDT_FRAMES_DIR=$scratch/run cargo test --quiet --release \
    --manifest-path "$repository/Cargo.toml" --workspace --test runner -- \
    --exact frames::writes_the_files_of_a_run >"$scratch/log" 2>&1; then
    cat "$scratch/log" >&2
    fail "the frames could not be written"
fi
"$python" "$here/read_back.py" "$scratch/run" || exit 1

# A comparison that cannot fail proves nothing.
"$python" "$here/alter.py" "$scratch/run/frames/particles-000000.vtp" || exit 1
if "$python" "$here/read_back.py" "$scratch/run" >"$scratch/log" 2>&1; then
    fail "an altered bit went unnoticed"
fi
grep -q '^FAILED vtk frames/particles-000000.vtp: pressure\[6\]' "$scratch/log" || {
    cat "$scratch/log" >&2
    fail "an altered bit was noticed in the wrong place"
}
echo "PASSED vtk an altered bit is noticed, and where it is"
