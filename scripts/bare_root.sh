# Sourced by scripts that try the project's packages, as root: a bare Debian by debootstrap in a temporary folder, `root`, that is gone
# in the end, and a signed repository of the packages in it. Like try_debian.sh, it makes bare roots once and keeps them in
# OSTEOMILL_ROOTS (/var/tmp/osteomill-roots), of OSTEOMILL_MIRROR (http://deb.debian.org/debian).

named=(osteomill-server osteomill-client osteomill-tools osteomill-study python3-osteomill osteomill-bridge-dev osteomill-doc)

say() { printf '\n== %s\n' "$*"; }
within() { chroot "$root" env DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin "$@"; }

# apt WORD...: as apt-get; speaks only if it fails.
apt() {
    within apt-get -y -qq --no-install-recommends "$@" >"$root/root/apt.log" 2>&1 || { tail -20 "$root/root/apt.log" >&2; exit 1; }
}

# suite_of FOLDER: the suite that the packages in a folder are for.
suite_of() {
    local changes=("$1"/osteomill_*.changes)
    [ -e "${changes[0]}" ] || { echo "$1 holds no packages: scripts/package.sh builds them" >&2; return 1; }
    sed -n 's/^Distribution: //p' "${changes[0]}"
}

# unpack_bare_root SUITE: into the folder `root`. False where there is none and debootstrap makes none; it has said why.
unpack_bare_root() {
    local roots=${OSTEOMILL_ROOTS:-/var/tmp/osteomill-roots} tar
    tar=$roots/$1.tar
    mkdir -p "$roots"
    if [ ! -e "$tar" ]; then
        say "a bare Debian $1"
        debootstrap --variant=minbase "$1" "$root" "${OSTEOMILL_MIRROR:-http://deb.debian.org/debian}" >"$root.log" 2>&1 ||
            { tail -3 "$root.log" >&2; rm "$root.log"; return 1; }
        rm "$root.log"
        tar -C "$root" -cf "$root.tar" . && mv "$root.tar" "$tar"
    else
        tar -C "$root" -xf "$tar"
    fi
    echo force-unsafe-io >"$root/etc/dpkg/dpkg.cfg.d/thrown_away"  # nobody needs this root after a power cut
    chmod 755 "$root"  # apt fetches as a user of its own
    cp /etc/resolv.conf "$root/etc/"
    printf '#!/bin/sh\nexit 101\n' >"$root/usr/sbin/policy-rc.d" && chmod +x "$root/usr/sbin/policy-rc.d"  # no daemon starts
}

# make_bare_root SUITE
make_bare_root() {
    [ "$(id -u)" -eq 0 ] || { echo "debootstrap needs root" >&2; exit 1; }
    command -v debootstrap >/dev/null || { echo "debootstrap is not installed (apt-get install debootstrap)" >&2; exit 1; }
    root=$(mktemp -d)
    export GNUPGHOME=$root.keys
    trap remove_bare_root EXIT
    unpack_bare_root "$1" || exit 1
    mount --bind /dev "$root/dev"
    mount -t proc proc "$root/proc"
}

remove_bare_root() {
    gpgconf --kill all
    umount -q "$root/proc" "$root/dev" || true
    rm -rf --one-file-system "$root" "$GNUPGHOME"
}

# serve_packages FOLDER...: a repository of them in the root, signed by a key of today, and the root's apt told of the first one's suite.
serve_packages() {
    mkdir -m 700 "$GNUPGHOME"
    gpg --batch --quiet --passphrase '' --quick-generate-key try@osteomill.example ed25519 sign 1d
    scripts/apt_repository.sh "$root/srv/packages" try@osteomill.example "$@" >/dev/null
    cp "$root/srv/packages/osteomill.gpg" "$root/usr/share/keyrings/lab.gpg"
    echo "deb [signed-by=/usr/share/keyrings/lab.gpg] file:/srv/packages $(suite_of "$1") main" >"$root/etc/apt/sources.list.d/lab.list"
}

# run_demo: the packages' own test. Programs speak of their progress on standard error.
run_demo() {
    cp debian/tests/demo "$root/root/"
    within /root/demo >"$root/root/demo.log" 2>&1 || { tail -20 "$root/root/demo.log" >&2; exit 1; }
    tail -1 "$root/root/demo.log"
}

# Libraries that came with the packages may stay: they are not ours.
remove_packages() {
    apt purge "${named[@]}"
    local left
    left=$(cd "$root" && find etc usr var -xdev \( -path var/cache -o -path var/lib/apt -o -path var/lib/dpkg \) -prune -o -name '*osteomill*' -print)
    [ -z "$left" ] || { echo "left behind: $left" >&2; exit 1; }
}
