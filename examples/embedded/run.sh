#!/usr/bin/env bash
# Builds the firmware for a bare Cortex-M4, runs it on an emulated board and compares every digest
# it prints with the host's.
#
#   examples/embedded/run.sh
#
# Exit code: 0 all digests equal; 1 a build error, another digest, a fault or a timeout;
# 77 something could not be downloaded, so nothing was tested. The last lines on standard output
# say which: PASSED firmware ..., FAILED firmware ..., SKIPPED firmware: ...
#
# Nothing is installed. The compiler, its library's source and the emulator are Debian packages,
# unpacked into .firmware/ at the root of the repository (git-ignored; delete it to start afresh),
# and only when that folder lacks them. They come from the system's own apt sources, checked by
# apt's own signatures, and no root is needed. Installing them would not do: the packaged compiler
# conflicts with rustup and the emulator with other versions of its own utilities.
set -Eeuo pipefail

readonly target=thumbv7em-none-eabihf
readonly emulation_limit_s=60

here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
repo=$(cd -- "$here/../.." && pwd)
readonly here repo
readonly store=$repo/.firmware
readonly root=$store/root
oldest_rust=$(awk -F'"' '/^rust-version/ { print $2 }' "$repo/Cargo.toml")
readonly oldest_rust

# Every apt and dpkg message that this script reads is then in English.
export LC_ALL=C

say() { printf '%s\n' "firmware: $*" >&2; }
fail() {
    printf '%s\n' "FAILED firmware $target $*"
    exit 1
}
skip() {
    printf '%s\n' "SKIPPED firmware: $*"
    exit 77
}
# A command that nobody judged: never a skip, whatever its own exit code was.
trap 'fail "line $LINENO of run.sh: $BASH_COMMAND"' ERR

# --- fetching -------------------------------------------------------------------------------------

# Lists and caches of apt's in the private folder: the system's lists may be missing, or too old to
# know what the mirror still has, and only root may renew those.
apt_options=(
    -o "Dir::State::lists=$store/apt/lists"
    -o "Dir::Cache=$store/apt/cache"
    # As root, apt hands downloads to a user of its own, who may not be able to enter this folder.
    -o APT::Sandbox::User=root
    -o Acquire::Retries=2
    -o Acquire::http::Timeout=30
    -o Acquire::https::Timeout=30
    -q
)

candidate() { # PACKAGE: the version apt would take; nothing if there is none
    # awk reads to the end: leaving early would break apt-cache's pipe, which pipefail reports.
    apt-cache "${apt_options[@]}" policy "$1" |
        awk '/^  Candidate:/ && $2 != "(none)" { print $2 }'
}

# PACKAGE...: the shared-library packages that they need, directly or not, and the system lacks.
# Other kinds of dependency (gcc, firmware of other boards) are not needed to run the programs.
missing_libraries() {
    local installed wanted=() seen=" " fresh name
    installed=" $(dpkg-query -W -f '${db:Status-Status}=${Package}\n' |
        awk -F= '$1 == "installed" { printf "%s ", $2 }')"
    wanted=("$@")
    while ((${#wanted[@]} > 0)); do
        fresh=()
        while read -r name; do
            [[ $seen == *" $name "* || $installed == *" $name "* ]] && continue
            seen+="$name "
            fresh+=("$name")
            printf '%s\n' "$name"
        done < <(apt-cache "${apt_options[@]}" depends "${wanted[@]}" |
            awk '$1 ~ /^[|]?(Pre)?Depends:$/ && $2 ~ /^lib/ { print $2 }')
        wanted=("${fresh[@]}")
    done
}

# The library folders of what was unpacked, as the dynamic linker wants them: joined by colons.
library_path() {
    local folder joined=
    for folder in "$root"/{usr/lib,lib}/*-linux-gnu*; do
        [[ -d $folder ]] && joined+=${joined:+:}$folder
    done
    printf '%s' "$joined"
}

# Whether what is there can run: each program and each library finds all it links to. Also false
# where a system library that was there at the time of the download has gone since, or where the
# workspace has moved on to a newer Rust.
complete() {
    [[ -e $store/complete && -x $root/usr/bin/rustc && -x $root/usr/bin/qemu-system-arm ]] &&
        [[ -z $(unmet_libraries) ]] && new_enough "$(<"$store/complete")"
}
new_enough() { # VERSION: whether that rustc-web compiles what the workspace asks for
    dpkg --compare-versions "$1" ge "$oldest_rust"
}
unmet_libraries() {
    LD_LIBRARY_PATH=$(library_path) ldd "$root"/usr/bin/{rustc,qemu-system-arm} |
        awk '/not found/ { print $1 }' | sort -u
}

fetch() {
    local command version libraries
    for command in apt-get apt-cache dpkg dpkg-deb dpkg-query; do
        command -v "$command" >/dev/null || skip "no $command here: it downloads Debian packages"
    done

    rm -rf -- "$store/complete" "$root" "$store/debs" "$store/apt"
    mkdir -p -- "$store"/{debs,root,bin} "$store"/apt/{lists,cache/archives}/partial

    say "looking for packages"
    # One source that does not answer need not matter: whether the packages come is what counts.
    apt-get "${apt_options[@]}" update >"$store/apt/update.log" 2>&1 || true

    compgen -G "$store/apt/lists/*_Packages*" >/dev/null ||
        skip "apt-get update brought no package list: $(grep -m1 '^[EW]:' "$store/apt/update.log" || echo 'no reason given')"

    version=$(candidate rustc-web)
    [[ -n $version ]] || skip "the system's apt sources do not offer the package rustc-web"
    new_enough "$version" || skip "the newest rustc-web on offer is $version, older than $oldest_rust"
    [[ -n $(candidate qemu-system-arm) ]] ||
        skip "the system's apt sources do not offer the package qemu-system-arm"

    # A compiler and the source of exactly its own library, which cargo builds for the target, and
    # that library built for the host, since build scripts and procedural macros run there.
    local packages=("rustc-web=$version" "rust-web-src=$version" "libstd-rust-web-dev=$version" qemu-system-arm)
    libraries=$(missing_libraries libstd-rust-web-dev qemu-system-arm)
    mapfile -t -O "${#packages[@]}" packages < <(printf '%s' "$libraries")

    say "downloading ${#packages[@]} packages"
    (cd "$store/debs" && apt-get "${apt_options[@]}" download "${packages[@]}") >"$store/apt/download.log" 2>&1 ||
        skip "apt-get download failed: $(grep -m1 '^E:' "$store/apt/download.log" || echo 'no reason given')"
    say "downloaded $(du -shc -- "$store"/debs/*.deb "$store/apt/lists" | awk 'END { print $1 }')B"

    local deb
    for deb in "$store"/debs/*.deb; do
        case ${deb##*/} in
        rust-web-src_*)
            # A tenth of it: the library, without compiler, tools and tests.
            dpkg-deb --fsys-tarfile "$deb" |
                tar -x -C "$root" --wildcards './usr/lib/rustlib/src*' './usr/src/*/library/*'
            ;;
        *) dpkg -x "$deb" "$root" ;;
        esac
    done

    # cargo takes the compiler to be one file.
    cat >"$store/bin/rustc" <<'END'
#!/usr/bin/env bash
store=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
LD_LIBRARY_PATH=$(cat "$store/library_path")${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH} exec "$store/root/usr/bin/rustc" "$@"
END
    chmod +x "$store/bin/rustc"

    rm -rf -- "$store/debs" "$store/apt"
    # Last, so that an interrupted run is not taken for a finished one.
    printf '%s\n' "$version" >"$store/complete"
    complete || fail "the unpacked programs lack shared libraries: $(unmet_libraries | xargs)"
}

mkdir -p -- "$store"
# Two runs at once would unpack over each other.
exec 9>"$store/lock"
command -v flock >/dev/null && flock 9

complete || fetch
library_path >"$store/library_path"

# --- building -------------------------------------------------------------------------------------

host_triple=$(rustc -vV | awk '/^host:/ { print $2 }')
# rustup ships the linker with its compiler.
linker=$(rustc --print sysroot)/lib/rustlib/$host_triple/bin/rust-lld
[[ -x $linker ]] || fail "no rust-lld in the sysroot of $(command -v rustc)"

# In a subshell each, so that neither changes what the other builds with.
firmware_cargo() (
    cd "$here"
    # Flags meant for the host.
    unset RUSTFLAGS CARGO_ENCODED_RUSTFLAGS CARGO_BUILD_RUSTFLAGS
    export RUSTC=$store/bin/rustc
    # A released compiler knows build-std, but lets only its own build use it unless told so.
    export RUSTC_BOOTSTRAP=1
    export CARGO_TARGET_THUMBV7EM_NONE_EABIHF_LINKER=$linker
    cargo "$@" --locked --target "$target" -Zbuild-std=core
)
host_cargo() (
    cd "$repo"
    cargo "$@" --locked
)

# COMMAND...: fetches crates, all that the builds below need: those are kept offline, so that
# whatever goes wrong in them is theirs. Cached crates ask nobody.
fetch_crates() {
    local log=$store/cargo-fetch.log
    "$@" >"$log" 2>&1 && return
    cat "$log" >&2
    # cargo exits alike for a download that failed and for a manifest or lock file that is wrong.
    if grep -Eq '^(warning: spurious network error|  (failed to download|download of|\[[0-9]+\] ))' "$log"; then
        skip "cargo could not download crates: $(grep -m1 '^error' "$log" || echo 'no reason given')"
    fi
    fail "cargo fetch: $(grep -m1 '^error' "$log" || echo 'no reason given')"
}

say "fetching crates"
fetch_crates firmware_cargo fetch
fetch_crates host_cargo fetch --target "$host_triple"

say "building for $target with $("$store/bin/rustc" --version)"
firmware_cargo build --offline --release -p loschmidt-firmware --target-dir "$here/target" >&2 ||
    fail "the firmware does not build"
readonly elf=$here/target/$target/release/loschmidt-firmware

say "building and running the host twin"
host_cargo build --offline --quiet --release -p loschmidt-examples --example embedded_twin >&2 ||
    fail "the host twin does not build"
if ! host=$(host_cargo run --offline --quiet --release -p loschmidt-examples --example embedded_twin); then
    say "the host printed:"$'\n'"$host"
    fail "the host twin ended with an error, or not in its first state"
fi

# --- running --------------------------------------------------------------------------------------

say "emulating"
started=$EPOCHREALTIME
status=0
# -nographic joins the board's serial line to standard input: give it none to read.
chip=$(LD_LIBRARY_PATH=$(library_path) timeout "$emulation_limit_s" \
    "$root/usr/bin/qemu-system-arm" -machine mps2-an386 -cpu cortex-m4 -nographic \
    -semihosting-config enable=on,target=native -kernel "$elf" </dev/null) || status=$?
elapsed=$(awk -v a="$started" -v b="$EPOCHREALTIME" 'BEGIN { printf "%.1f", b - a }')
case $status in
0) ;;
124) fail "timeout: not done after $emulation_limit_s s" ;;
*)
    say "the emulated board printed:"$'\n'"$chip"
    fail "the emulator ended with $status"
    ;;
esac

# --- comparing ------------------------------------------------------------------------------------

value() { # TEXT NAME
    awk -v name="$2" '$1 == name { print $2 }' <<<"$1"
}

failures=0
for name in digest.initial digest.turnaround digest.final; do
    ours=$(value "$chip" "$name")
    theirs=$(value "$host" "$name")
    if [[ $theirs =~ ^[0-9a-f]{32}$ && $ours == "$theirs" ]]; then
        echo "PASSED firmware $target $name $ours, the host's"
    else
        echo "FAILED firmware $target $name ${ours:-none}, the host's is ${theirs:-none}"
        failures=$((failures + 1))
    fi
done
# What else they print: particles and steps.
if [[ $chip == "$host" ]]; then
    echo "PASSED firmware $target $(value "$chip" particles) particles, $(value "$chip" steps) steps each way, emulated in $elapsed s"
else
    echo "FAILED firmware $target prints another text than the host"
    diff <(printf '%s\n' "$host") <(printf '%s\n' "$chip") >&2 || true
    failures=$((failures + 1))
fi
exit $((failures > 0))
