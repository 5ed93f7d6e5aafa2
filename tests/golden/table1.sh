#!/usr/bin/env bash
# The paper's whole experiment (Table 1: 80,000 particles, 40,000 steps out and 40,000 back), compared
# with the digests that stand beside this script in table1.txt. It takes minutes, so CI does not run
# it every time.
#
#   tests/golden/table1.sh [OPTIONS OF loschmidt run]     e.g. --threads 2 --backend avx2
#
# Prints a PASSED or FAILED line for each of the three digests, and how long it took.
set -euo pipefail
cd "$(dirname "$0")/../.."
cargo build --release --quiet
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
"${CARGO_TARGET_DIR:-target}/release/loschmidt" run dam-break --json --quiet --out "$out/run" "$@" > "$out/result.json"
grep -o '"wall_time_s":[0-9.]*' "$out/result.json"
failed=0
while read -r moment digest; do
  found=$(sed -nE "s/.*\"digest\":\{[^}]*\"$moment\":\"([0-9a-f]+)\".*/\1/p" "$out/result.json")
  if [ "$found" = "$digest" ]; then
    echo "PASSED table 1, $moment: $digest"
  else
    echo "FAILED table 1, $moment: expected $digest, found ${found:-nothing}"
    failed=1
  fi
done < tests/golden/table1.txt
exit "$failed"
