#!/usr/bin/env bash
# Records the dashboard for the README: plays the program on a terminal of tmux, types what a user
# would type, and turns what the terminal shows into an animation.
#
#   tui/record/record.sh [OUT.gif]
#
# Needs tmux, python3 with Pillow, and the font DejaVu Sans Mono.
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
out=${1:-$root/tui/record/dashboard.gif}
columns=120 rows=36
for tool in tmux python3; do
  command -v "$tool" >/dev/null || { echo "record.sh: $tool is missing" >&2; exit 2; }
done
python3 -c 'import PIL' 2>/dev/null || { echo 'record.sh: python3 has no Pillow (pip install pillow)' >&2; exit 2; }
cargo build --release --quiet --manifest-path "$root/Cargo.toml" -p loschmidt-tui
program=${CARGO_TARGET_DIR:-$root/target}/release/loschmidt

place=$(mktemp -d)
socket=loschmidt-record-$$
tm() { tmux -L "$socket" "$@"; }
trap 'tm kill-server 2>/dev/null || true; rm -rf "$place"' EXIT

cd "$place"
tm new-session -d -s film -x "$columns" -y "$rows" \
  "env -u NO_COLOR TERM=xterm-256color COLORTERM=truecolor '$program' tui dam-break --set particle_spacing=0.025"
shots=0
# film SECONDS: takes ten pictures a second for so long.
film() {
  local until
  until=$(python3 -c "import time; print(time.monotonic() + $1)")
  while python3 -c "import sys, time; sys.exit(time.monotonic() >= $until)"; do
    tm capture-pane -t film -peN >"$(printf 'shot-%05d' "$shots")"
    shots=$((shots + 1))
    sleep 0.05
  done
}
# await WORDS: films until they are on the screen.
await() {
  local tries=0
  until tm capture-pane -t film -p | grep -q "$1"; do
    film 0.2
    tries=$((tries + 1))
    [ "$tries" -lt 900 ] || { echo "record.sh: no '$1'" >&2; exit 1; }
  done
}
key() { tm send-keys -t film "$@"; }

await forward
key ']' ']'          # 0.07 s of the scene in a second
await 't = 0.6'
key r                # time is reversed
await 'bit-identical'
film 2.5
key r                # again, and this time with one bit flipped on the way back
await 't = 0.6'
key r
film 0.5
key b
await 'DID NOT COME BACK'
film 3
key q
python3 "$root/tui/record/film.py" "$out" shot-*
ls -l "$out"
