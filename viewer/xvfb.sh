#!/usr/bin/env bash
# Opens the window on an X server without a display and uses it as a person would, by keys.
#
#   viewer/xvfb.sh
#
# It plays, turns on a key, comes back bit-identical, is resized; its pixels on the screen are compared
# with its PNG, and the particles in it with those that the rasteriser draws in a run of its own. A
# display, a library or the server that is missing must be told in one line.
#
# Prints a line PASSED, FAILED or SKIPPED for each check. Exit status: 0 all passed; 77 skipped, because
# the server could not be had; 1 anything else.
#
# Nothing is installed: Xvfb and xdotool are Debian packages, unpacked into .xvfb/ at the root of the
# repository (git-ignored; delete it to start afresh).
set -uo pipefail

here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
repo=$(cd -- "$here/.." && pwd)
store=$repo/.xvfb
root=$store/root
libraries=$root/usr/lib/$(uname -m)-linux-gnu
export LC_ALL=C

skip() { echo "SKIPPED window: $1"; exit 77; }
pass() { echo "PASSED window $1"; }
failures=0
fail() { echo "FAILED window $1"; failures=$((failures + 1)); }

# --- fetching -------------------------------------------------------------------------------------

fetch() {
    local command options packages deb
    for command in apt-get dpkg; do
        command -v "$command" >/dev/null || skip "no $command here: it downloads Debian packages"
    done
    rm -rf -- "$root" "$store/debs"
    mkdir -p -- "$root" "$store"/debs "$store"/apt/lists/partial "$store"/apt/cache/archives/partial
    options=(-q -o "Dir::State::lists=$store/apt/lists" -o "Dir::Cache=$store/apt/cache"
        -o APT::Sandbox::User=root -o Acquire::Retries=2 -o Acquire::http::Timeout=30)
    apt-get "${options[@]}" update >"$store/update.log" 2>&1
    packages=(xvfb xdotool libxdo3 libxfont2 libfontenc1 x11-xkb-utils xkb-data libgl1 libglvnd0 libglx0
        libunwind8 libxtst6 libpixman-1-0 libxkbfile1 libx11-6 libx11-xcb1 libxcb1 libxau6 libxdmcp6
        libbsd0 libmd0 libxcursor1 libxi6 libxrender1 libxfixes3 libxext6 libxinerama1 libxkbcommon0
        libxkbcommon-x11-0 libxcb-xkb1 libxcb-randr0 libxcb-xinput0 libaudit1 libselinux1 libxt6 libsm6
        libice6 libxpm4 libxaw7 libxmu6)
    (cd "$store/debs" && apt-get "${options[@]}" download "${packages[@]}") >"$store/download.log" 2>&1 ||
        skip "the packages could not be downloaded: $(grep -m1 '^E:' "$store/download.log" || echo 'no reason given')"
    for deb in "$store"/debs/*.deb; do
        dpkg -x "$deb" "$root" || skip "$deb cannot be unpacked"
    done
    rm -rf -- "$store/debs" "$store/apt"
    # The server calls the keymap compiler in the folder of installed programs: here, in ours.
    mkdir -p "$root/xkbbin"
    cp "$root/usr/bin/xkbcomp" "$root/xkbbin/"
    sed 's#/usr/bin\x00#./xkbbin\x00#g' "$root/usr/bin/Xvfb" >"$root/Xvfb"
    chmod +x "$root/Xvfb"
    touch "$store/complete"
}

mkdir -p -- "$store"
[[ -e $store/complete ]] || fetch

# --- building -------------------------------------------------------------------------------------

cd "$repo" || exit 1
# Of the whole workspace: a package by itself gets other features, and is built anew.
if ! cargo build --quiet --release --workspace --bin loschmidt-viewer --example screen >&2; then
    fail "it does not build"
    exit 1
fi
target=${CARGO_TARGET_DIR:-$repo/target}/release
program=$target/loschmidt-viewer

# --- running --------------------------------------------------------------------------------------

scratch=$(mktemp -d)
server= window=
cleanup() {
    [[ -z $window ]] || kill "$window" 2>/dev/null
    [[ -z $server ]] || kill "$server" 2>/dev/null
    wait 2>/dev/null
    rm -rf -- "$scratch"
}
trap cleanup EXIT
log=$scratch/log

# The server chooses a number that is free.
start_server() {
    cd "$root" || exit 1
    LD_LIBRARY_PATH=$libraries exec ./Xvfb -displayfd 3 -screen 0 1400x900x24 -nolisten tcp \
        -fbdir "$scratch" -xkbdir "$root/usr/share/X11/xkb" 3>"$scratch/display" 2>"$scratch/server.log"
}
start_server &
server=$!
for _ in {1..100}; do
    [[ -s $scratch/display ]] && break
    sleep 0.1
done
[[ -s $scratch/display ]] || skip "the server does not start: $(head -n1 "$scratch/server.log")"
DISPLAY=:$(<"$scratch/display")
export DISPLAY
unset WAYLAND_DISPLAY WAYLAND_SOCKET

# The program, in the place of this shell.
# Libraries of the system, where it has them, come first: those are the ones of users.
launch() {
    if ldconfig -p 2>/dev/null | grep -q libXcursor.so.1 && ldconfig -p | grep -q libxkbcommon-x11.so.0; then
        exec "$@"
    else
        LD_LIBRARY_PATH=$libraries exec "$@"
    fi
}
keys() { LD_LIBRARY_PATH=$libraries timeout 10 "$root/usr/bin/xdotool" key --delay 60 "$@" 2>/dev/null; }
# wait_for PATTERN: in the log, within 20 s.
wait_for() {
    for _ in {1..200}; do
        grep -Eq -- "$1" "$log" && return
        sleep 0.1
    done
    return 1
}
# expect PATTERN TEXT
expect() {
    if wait_for "$1"; then
        pass "$2"
    else
        fail "$2"
        tail -n 5 "$log" >&2
    fi
}

scene=(dam-break particle_spacing=0.05)
cd "$scratch" || exit 1
launch "$program" "${scene[0]}" --set "${scene[1]}" --log >"$scratch/out" 2>"$log" &
window=$!
expect '^window opened' 'it opens'
expect '^speed .* [1-9][0-9.]* steps/s' 'it plays'
# There is no window manager to give it the keyboard.
LD_LIBRARY_PATH=$libraries timeout 10 "$root/usr/bin/xdotool" search --name loschmidt windowfocus --sync

# The pixels, at a step that the log tells.
keys space
wait_for '^stands at'
keys Escape
sleep 0.5
cp "$scratch/Xvfb_screen0" "$scratch/before"
step=$(sed -n 's/^stands at //p' "$log" | tail -n1)
keys p
if wait_for '^picture '; then
    picture=$(sed -n 's/^picture //p' "$log" | tail -n1)
    if "$target/examples/screen" "$scratch/before" "$picture" "${scene[0]}" "$step" "${scene[1]}" >"$scratch/pixels"; then
        pass "every pixel on the screen is the PNG's, and every one of the particles the rasteriser's, step $step"
    else
        fail "pixels differ: $(xargs <"$scratch/pixels")"
    fi
else
    fail 'it writes a PNG'
fi

keys r space
expect '^turned backward' 'time turns on a key'
expect '^arrived bit-identical' 'it comes back bit-identical'
for _ in {1..50}; do
    title=$(LD_LIBRARY_PATH=$libraries timeout 10 "$root/usr/bin/xdotool" search --name 'bit-identical' 2>/dev/null)
    [[ -n $title ]] && break
    sleep 0.1
done
if [[ -n $title ]]; then pass 'its title says so'; else fail 'its title says so'; fi

id=$(LD_LIBRARY_PATH=$libraries timeout 10 "$root/usr/bin/xdotool" search --name loschmidt 2>/dev/null | head -n1)
LD_LIBRARY_PATH=$libraries timeout 10 "$root/usr/bin/xdotool" windowsize "$id" 900 640
expect '^size 900x640' 'it is resized'
sleep 0.5
cp "$scratch/Xvfb_screen0" "$scratch/before"
count=$(grep -c '^picture ' "$log")
keys Escape
sleep 0.5
cp "$scratch/Xvfb_screen0" "$scratch/before"
keys p
for _ in {1..50}; do
    [[ $(grep -c '^picture ' "$log") -gt $count ]] && break
    sleep 0.1
done
picture=$(sed -n 's/^picture //p' "$log" | tail -n1)
if "$target/examples/screen" "$scratch/before" "$picture" "${scene[0]}" 0 "${scene[1]}" >"$scratch/pixels"; then
    pass 'resized, its pixels are the same as well'
else
    fail "resized, pixels differ: $(xargs <"$scratch/pixels")"
fi

# ended PID SECONDS: whether it ends; its exit code in $code.
ended() {
    for _ in $(seq $((10 * $2))); do
        if ! kill -0 "$1" 2>/dev/null; then
            wait "$1"
            code=$?
            return 0
        fi
        sleep 0.1
    done
    return 1
}
kill -TERM "$window"
if ended "$window" 20 && [[ $code -eq 130 ]]; then pass 'a signal ends it'; else fail 'a signal ends it'; fi

# A library that is there but cannot be loaded is as good as missing.
mkdir -p "$scratch/broken"
echo no library >"$scratch/broken/libXcursor.so.1"
cp "$scratch/broken/libXcursor.so.1" "$scratch/broken/libXcursor.so"
LD_LIBRARY_PATH=$scratch/broken timeout 20 "$program" >"$scratch/out" 2>"$scratch/why"
code=$?
if [[ $code -eq 2 && $(wc -l <"$scratch/why") -eq 1 ]] && grep -q 'libXcursor.so' "$scratch/why"; then
    pass 'a missing library is named'
else
    fail "a missing library is named: exit code $code, $(head -c 300 "$scratch/why")"
fi
echo no library >"$scratch/broken/libxkbcommon-x11.so.0"
rm "$scratch"/broken/libXcursor*
cp "$scratch/broken/libxkbcommon-x11.so.0" "$scratch/broken/libxkbcommon-x11.so"
LD_LIBRARY_PATH=$scratch/broken timeout 20 "$program" >"$scratch/out" 2>"$scratch/why"
code=$?
if [[ $code -eq 2 && $(wc -l <"$scratch/why") -eq 1 ]] && grep -q 'libxkbcommon-x11' "$scratch/why"; then
    pass 'a missing keyboard library is named'
else
    fail "a missing keyboard library is named: exit code $code, $(head -c 300 "$scratch/why")"
fi

# A server that goes away takes the window with it.
launch "$program" "${scene[0]}" --set "${scene[1]}" --log >"$scratch/out" 2>"$log" &
window=$!
wait_for '^speed'
kill "$server"
server=
if ended "$window" 20; then pass 'it ends with its display'; else fail 'it ends with its display'; fi

env -u DISPLAY timeout 20 "$program" >"$scratch/out" 2>"$scratch/why"
code=$?
if [[ $code -eq 2 && $(wc -l <"$scratch/why") -eq 1 ]] && grep -q 'loschmidt tui.*loschmidt movie' "$scratch/why"; then
    pass 'without a display one line points to tui and movie'
else
    fail "without a display: exit code $code, $(head -c 300 "$scratch/why")"
fi
exit $((failures > 0))
