#!/usr/bin/env bash
# Builds the firmware for a bare Cortex-M4, runs it on an emulated board and compares every digest
# it prints with the host's; then does the same with a big-endian processor, s390x.
#
#   examples/embedded/run.sh
#
# Exit code: 0 all digests equal; 1 a build error, another digest, a fault or a timeout;
# 77 something could not be downloaded, so nothing was tested. The last lines on standard output
# say which: PASSED firmware ..., FAILED firmware ..., SKIPPED firmware: ... Where only the second
# processor's emulator could not be downloaded, that is SKIPPED firmware s390x-unknown-linux-gnu:
# ..., and the exit code is the first one's.
#
# Nothing is installed. The compiler, its library's source and the emulator are Debian packages,
# unpacked into .firmware/ at the root of the repository (git-ignored; delete it to start afresh),
# and only when that folder lacks them. They come from the system's own apt sources, checked by
# apt's own signatures, and no root is needed. Installing them would not do: the packaged compiler
# conflicts with rustup and the emulator with other versions of its own utilities.
set -Eeuo pipefail

readonly chip=thumbv7em-none-eabihf
readonly mainframe=s390x-unknown-linux-gnu
readonly emulation_limit_s=60
# Whose verdict is being found, as the verdicts name it.
subject=$chip

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
    printf '%s\n' "FAILED firmware $subject $*"
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
        [[ -z $(unmet_libraries rustc qemu-system-arm) ]] && new_enough "$(<"$store/complete")"
}
complete_mainframe() {
    [[ -e $store/complete-s390x && -x $root/usr/bin/qemu-s390x && -z $(unmet_libraries qemu-s390x) ]]
}
new_enough() { # VERSION: whether that rustc-web compiles what the workspace asks for
    dpkg --compare-versions "$1" ge "$oldest_rust"
}
unmet_libraries() { # PROGRAM...: shared libraries that the unpacked programs lack
    local libraries
    libraries=$(library_path)
    (cd "$root/usr/bin" && LD_LIBRARY_PATH=$libraries ldd "${@/#/./}") |
        awk '/not found/ { print $1 }' | sort -u
}

# Package lists, once for both fetches. Sets `reason` and is false where none came.
look_for_packages() {
    local command
    for command in apt-get apt-cache dpkg dpkg-deb dpkg-query; do
        if ! command -v "$command" >/dev/null; then
            reason="no $command here: it downloads Debian packages"
            return 1
        fi
    done
    rm -rf -- "$store/debs"
    mkdir -p -- "$store"/{debs,root,bin}
    compgen -G "$store/apt/lists/*_Packages*" >/dev/null && return

    say "looking for packages"
    mkdir -p -- "$store"/apt/{lists,cache/archives}/partial
    # One source that does not answer need not matter: whether the packages come is what counts.
    apt-get "${apt_options[@]}" update >"$store/apt/update.log" 2>&1 || true
    if ! compgen -G "$store/apt/lists/*_Packages*" >/dev/null; then
        reason="apt-get update brought no package list: $(first_line '^[EW]:' "$store/apt/update.log")"
        return 1
    fi
}
first_line() { # PATTERN FILE
    grep -m1 "$1" "$2" || echo 'no reason given'
}

download() { # PACKAGE...: into debs. Sets `reason` and is false where one did not come.
    say "downloading $# packages"
    if ! (cd "$store/debs" && apt-get "${apt_options[@]}" download "$@") >"$store/apt/download.log" 2>&1; then
        reason="apt-get download failed: $(first_line '^E:' "$store/apt/download.log")"
        return 1
    fi
    say "downloaded $(du -shc -- "$store"/debs/*.deb "$store/apt/lists" | awk 'END { print $1 }')B"
}

fetch() {
    local version libraries reason
    rm -rf -- "$store/complete" "$store/complete-s390x" "$root"
    look_for_packages || skip "$reason"

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

    download "${packages[@]}" || skip "$reason"

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

    # Last, so that an interrupted run is not taken for a finished one.
    printf '%s\n' "$version" >"$store/complete"
    complete || fail "the unpacked programs lack shared libraries: $(unmet_libraries rustc qemu-system-arm | xargs)"
}

# The second processor's emulator. Sets `reason` and is false where it cannot be had.
fetch_mainframe() {
    local libraries packages deb
    rm -f -- "$store/complete-s390x"
    look_for_packages || return 1
    if [[ -z $(candidate qemu-user) ]]; then
        reason="the system's apt sources do not offer the package qemu-user"
        return 1
    fi
    libraries=$(missing_libraries qemu-user)
    mapfile -t packages < <(printf '%s' "$libraries")
    download qemu-user "${packages[@]}" || return 1
    for deb in "$store"/debs/*.deb; do
        case ${deb##*/} in
        # One processor of thirty.
        qemu-user_*) dpkg-deb --fsys-tarfile "$deb" | tar -x -C "$root" ./usr/bin/qemu-s390x ;;
        *) dpkg -x "$deb" "$root" ;;
        esac
    done
    : >"$store/complete-s390x"
    if ! complete_mainframe; then
        subject=$mainframe
        fail "the unpacked emulator is incomplete: $(unmet_libraries qemu-s390x | xargs)"
    fi
}

mkdir -p -- "$store"
# Two runs at once would unpack over each other.
exec 9>"$store/lock"
command -v flock >/dev/null && flock 9

# Lists of an interrupted run may name what the mirror has replaced since.
rm -rf -- "$store/debs" "$store/apt"
complete || fetch
mainframe_missing=
complete_mainframe || fetch_mainframe || mainframe_missing=$reason
rm -rf -- "$store/debs" "$store/apt"
library_path >"$store/library_path"

# --- building -------------------------------------------------------------------------------------

host_triple=$(rustc -vV | awk '/^host:/ { print $2 }')
# rustup ships the linker with its compiler.
linker=$(rustc --print sysroot)/lib/rustlib/$host_triple/bin/rust-lld
[[ -x $linker ]] || fail "no rust-lld in the sysroot of $(command -v rustc)"

# In a subshell each, so that neither changes what the other builds with.
firmware_cargo() ( # SUBCOMMAND TARGET ARGUMENT...
    cd "$here"
    # Flags meant for the host.
    unset RUSTFLAGS CARGO_ENCODED_RUSTFLAGS CARGO_BUILD_RUSTFLAGS
    export RUSTC=$store/bin/rustc
    # A released compiler knows build-std, but lets only its own build use it unless told so.
    export RUSTC_BOOTSTRAP=1
    export CARGO_TARGET_THUMBV7EM_NONE_EABIHF_LINKER=$linker
    export CARGO_TARGET_S390X_UNKNOWN_LINUX_GNU_LINKER=$linker
    # This target expects a C compiler for a linker, which would look for a C library.
    export CARGO_TARGET_S390X_UNKNOWN_LINUX_GNU_RUSTFLAGS="-Clinker-flavor=ld.lld -Crelocation-model=static"
    # Without a C library, memcpy and its like are those of the compiler's own library.
    cargo "$1" --locked --target "$2" -Zbuild-std=core -Zbuild-std-features=compiler-builtins-mem "${@:3}"
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
fetch_crates firmware_cargo fetch "$chip"
fetch_crates firmware_cargo fetch "$mainframe"
fetch_crates host_cargo fetch --target "$host_triple"

build() { # TARGET PACKAGE: to target/TARGET/release/PACKAGE
    subject=$1
    say "building $2 with $("$store/bin/rustc" --version)"
    firmware_cargo build "$1" --offline --release -p "$2" --target-dir "$here/target" >&2 ||
        fail "$2 does not build"
}
build "$chip" loschmidt-firmware
[[ -n $mainframe_missing ]] || build "$mainframe" loschmidt-big-endian

subject=$chip
say "building and running the host twin"
# Of the whole workspace: a package by itself gets other features, and is built anew.
host_cargo build --offline --quiet --release --workspace --example embedded_twin >&2 ||
    fail "the host twin does not build"
if ! host=$("${CARGO_TARGET_DIR:-$repo/target}/release/examples/embedded_twin"); then
    say "the host printed:"$'\n'"$host"
    fail "the host twin ended with an error, or not in its first state"
fi

# --- running and comparing ------------------------------------------------------------------------

value() { # TEXT NAME
    awk -v name="$2" '$1 == name { print $2 }' <<<"$1"
}

failures=0
verdict() { # PASSED|FAILED TEXT
    printf '%s\n' "$1 firmware $subject $2"
    [[ $1 == PASSED ]] || failures=$((failures + 1))
}

emulate() { # TARGET EMULATOR ARGUMENT...: judges what the emulated program prints
    local started elapsed printed status=0 name ours theirs
    subject=$1
    say "emulating with $2"
    started=$EPOCHREALTIME
    # Nothing on standard input: -nographic would join it to the board's serial line.
    printed=$(LD_LIBRARY_PATH=$(library_path) timeout "$emulation_limit_s" \
        "$root/usr/bin/$2" "${@:3}" </dev/null) || status=$?
    elapsed=$(awk -v a="$started" -v b="$EPOCHREALTIME" 'BEGIN { printf "%.1f", b - a }')
    case $status in
    0) ;;
    124)
        verdict FAILED "timeout: not done after $emulation_limit_s s"
        return
        ;;
    *)
        say "the emulated program printed:"$'\n'"$printed"
        verdict FAILED "the emulator ended with $status"
        return
        ;;
    esac

    for name in digest.initial digest.turnaround digest.final; do
        ours=$(value "$printed" "$name")
        theirs=$(value "$host" "$name")
        if [[ $theirs =~ ^[0-9a-f]{32}$ && $ours == "$theirs" ]]; then
            verdict PASSED "$name $ours, the host's"
        else
            verdict FAILED "$name ${ours:-none}, the host's is ${theirs:-none}"
        fi
    done
    # What else they print: particles, steps, the water's front.
    if [[ $printed == "$host" ]]; then
        verdict PASSED "$(value "$host" fluid) + $(value "$host" walls) particles, $(value "$host" steps) steps each way, emulated in $elapsed s"
    else
        verdict FAILED "prints another text than the host"
        diff <(printf '%s\n' "$host") <(printf '%s\n' "$printed") >&2 || true
    fi
}

emulate "$chip" qemu-system-arm -machine mps2-an386 -cpu cortex-m4 -nographic \
    -semihosting-config enable=on,target=native -kernel "$here/target/$chip/release/loschmidt-firmware"
if [[ -z $mainframe_missing ]]; then
    emulate "$mainframe" qemu-s390x "$here/target/$mainframe/release/loschmidt-big-endian"
else
    printf '%s\n' "SKIPPED firmware $mainframe: $mainframe_missing"
fi
exit $((failures > 0))
