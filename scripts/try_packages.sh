#!/usr/bin/env bash
# Installs the project's packages into a bare Debian 12, uses them, installs them anew, and removes them: nothing is to be left.
#   scripts/try_packages.sh [FOLDER [MIRROR]]      FOLDER as of scripts/package.sh: out/packages
# As root. The bare root is made once by debootstrap and kept in OSTEOMILL_BARE_ROOT (/var/tmp/osteomill-bare-root.tar).
set -euo pipefail
cd "$(dirname "$0")/.."
packages=$(realpath "${1:-out/packages}")
mirror=${2:-http://deb.debian.org/debian}
[ "$(id -u)" -eq 0 ] || { echo "debootstrap needs root" >&2; exit 1; }
command -v debootstrap >/dev/null || { echo "debootstrap is not installed (apt-get install debootstrap)" >&2; exit 1; }

tar=${OSTEOMILL_BARE_ROOT:-/var/tmp/osteomill-bare-root.tar}
root=$(mktemp -d)
chmod 755 "$root"  # apt fetches as a user of its own
trap 'umount -q "$root/proc" "$root/dev" 2>/dev/null || true; rm -rf --one-file-system "$root"' EXIT
say() { printf '\n== %s\n' "$*"; }
within() { chroot "$root" env DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin "$@"; }

if [ ! -e "$tar" ]; then
    say "a bare Debian 12"
    debootstrap --variant=minbase bookworm "$root" "$mirror" >/dev/null
    tar -C "$root" -cf "$tar.new" . && mv "$tar.new" "$tar"
else
    tar -C "$root" -xf "$tar"
fi
cp /etc/resolv.conf "$root/etc/"
printf '#!/bin/sh\nexit 101\n' >"$root/usr/sbin/policy-rc.d" && chmod +x "$root/usr/sbin/policy-rc.d"  # no daemon starts
mount --bind /dev "$root/dev"
mount -t proc proc "$root/proc"
cp "$packages"/*.deb "$root/root/"

# Libraries that came with the packages may stay: they are not ours.
ours() { (cd "$root" && find etc usr var -xdev \( -path var/cache -o -path var/lib/apt -o -path var/lib/dpkg \) -prune -o -name '*osteomill*' -print); }

say "install"
within apt-get update -qq
within sh -c 'apt-get install -y -qq --no-install-recommends /root/*.deb >/root/apt.log 2>&1' || { tail -20 "$root/root/apt.log" >&2; exit 1; }
within getent passwd osteomill
[ ! -e "$root/etc/systemd/system/multi-user.target.wants/osteomill.service" ] || { echo "the unit starts by itself" >&2; exit 1; }

say "use"
cp debian/tests/demo "$root/root/"
within /root/demo
within test -s /usr/share/man/man1/haptic_server.1.gz
within sh -c 'haptic_server --check --listen 127.0.0.1:0 || true' | tail -3

say "install anew, as an upgrade does"
within sh -c 'dpkg -i /root/*.deb >/dev/null'

say "remove"
within sh -c 'dpkg --purge $(dpkg-query -W -f "\${Package}\n" | grep osteomill) >/dev/null'
left=$(ours)
[ -z "$left" ] || { echo "left behind: $left" >&2; exit 1; }
say "nothing is left"
