#!/usr/bin/env bash
# Tries what is committed as a new user would, in a bare Debian: a root file system by debootstrap, a clone, the commands, nothing else.
#   scripts/try_debian.sh 12|13|testing [demo] [test] [packages]      the demo unless said otherwise
# demo and test are ./demo.sh and ./test.sh; packages builds the Debian packages there, installs, upgrades and removes them. Each ends with
# its minutes and its seconds of a core, and what it leaves in out/ is copied to out/try/SYSTEM. Needs root.
#   OSTEOMILL_ROOTS   where bare roots are kept, made once each: /var/tmp/osteomill-roots
#   OSTEOMILL_MIRROR  of Debian
#   OSTEOMILL_SCANS   real scans for the tests, as in ./test.sh
#   CCACHE_DIR        a compiler cache, for who comes again; the figures are not a new user's then
# Exits with 3 where no bare root can be made, and says why.
set -euo pipefail
cd "$(dirname "$0")/.."
source scripts/bare_root.sh

usage() { sed -n '2,/^set/{/^#/p}' "$0" >&2; exit 2; }
cannot() { echo "no bare Debian can be tried here: $*" >&2; exit 3; }

system=${1:-}
case $system in
    12) suite=bookworm ;;
    13) suite=trixie ;;
    testing) suite=testing ;;
    *) usage ;;
esac
shift
[ $# -gt 0 ] || set -- demo
for what; do
    case $what in demo | test | packages) ;; *) usage ;; esac
done

# Twice: outside it makes the root, and removes it in the end. Within, in namespaces of its own, it mounts and runs: mounts and processes
# are gone before the root is removed.
if [ -z "${OSTEOMILL_ROOT_TO_TRY:-}" ]; then
    [ "$(id -u)" -eq 0 ] || cannot "debootstrap needs root"
    command -v debootstrap >/dev/null || cannot "debootstrap is not installed (apt-get install debootstrap)"
    unshare --mount --pid --fork true 2>/dev/null || cannot "this machine gives no namespaces (unshare --mount --pid)"
    root=$(mktemp -d)
    trap 'rm -rf --one-file-system "$root"' EXIT
    unpack_bare_root "$suite" || cannot "debootstrap of $suite failed"
    git clone --quiet --no-hardlinks . "$root/root/osteomill"
    OSTEOMILL_ROOT_TO_TRY=$root unshare --mount --pid --fork --kill-child "$0" "$system" "$@"
    exit
fi
root=$OSTEOMILL_ROOT_TO_TRY

mount --bind "$root" "$root"  # `ip netns exec`, by which packages are tried on two machines, wants a root that is mounted
mount -t proc proc "$root/proc"
mount --rbind /dev "$root/dev"
mount --rbind /sys "$root/sys"
settings=(HOME=/root LC_ALL=C.UTF-8 TERM=dumb PATH=/usr/sbin:/usr/bin:/sbin:/bin
    "OSTEOMILL_WARNINGS_AS_ERRORS=${OSTEOMILL_WARNINGS_AS_ERRORS:-}")
# share FOLDER PLACE NAME: a folder of this machine at a place within, which the variable NAME names there.
share() {
    mkdir -p "$root$2"
    mount --bind "$1" "$root$2"
    settings+=("$3=$2")
}
within() { chroot "$root" env -i "${settings[@]}" bash -c "cd /root/osteomill && $1"; }
[ -z "${OSTEOMILL_SCANS:-}" ] || share "$OSTEOMILL_SCANS" /scans OSTEOMILL_SCANS
if [ -n "${CCACHE_DIR:-}" ]; then
    share "$CCACHE_DIR" /ccache CCACHE_DIR
    settings+=(CMAKE_C_COMPILER_LAUNCHER=ccache CMAKE_CXX_COMPILER_LAUNCHER=ccache)
    within "source scripts/prepare.sh && install_packages <(echo ccache)"
fi

failed=()
for what; do
    say "Debian $system: $what"
    case $what in
        demo | test) command=./$what.sh ;;
        packages) command='source scripts/prepare.sh && install_packages scripts/packages.txt scripts/package_packages.txt &&
            scripts/package.sh && scripts/try_packages.sh' ;;
    esac
    TIMEFORMAT="Debian $system, $what: %0lR, %0U s of a core by programs and %0S s by the system"
    time within "$command" || failed+=("$what")
    mkdir -p "out/try/$system"
    [ ! -d "$root/root/osteomill/out" ] || cp -r "$root/root/osteomill/out/." "out/try/$system"
done
[ ${#failed[@]} -eq 0 ] || { echo "Debian $system: ${failed[*]} failed" >&2; exit 1; }
