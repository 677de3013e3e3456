#!/usr/bin/env bash
# Has a bare Debian 12 install the project's packages from a signed repository of them (apt_repository.sh), use them, also as two machines,
# upgrade them, and remove them: nothing is to be left.
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
export GNUPGHOME=$root.keys
network=$(basename "$root")
clean_up() {
    gpgconf --kill all
    umount -q "$root/proc" "$root/dev" || true
    rm -rf --one-file-system "$root" "$GNUPGHOME"
    for end in server client; do ip netns del "$network.$end" 2>/dev/null || true; done
}
trap clean_up EXIT
say() { printf '\n== %s\n' "$*"; }
within() { chroot "$root" env DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin "$@"; }

if [ ! -e "$tar" ]; then
    say "a bare Debian 12"
    debootstrap --variant=minbase bookworm "$root" "$mirror" >/dev/null
    tar -C "$root" -cf "$tar.new" . && mv "$tar.new" "$tar"
else
    tar -C "$root" -xf "$tar"
fi
chmod 755 "$root"  # apt fetches as a user of its own
cp /etc/resolv.conf "$root/etc/"
printf '#!/bin/sh\nexit 101\n' >"$root/usr/sbin/policy-rc.d" && chmod +x "$root/usr/sbin/policy-rc.d"  # no daemon starts
mount --bind /dev "$root/dev"
mount -t proc proc "$root/proc"

say "a repository, signed by a key of today"
mkdir -m 700 "$GNUPGHOME"
gpg --batch --quiet --passphrase '' --quick-generate-key try@osteomill.example ed25519 sign 1d
scripts/apt_repository.sh "$root/srv/packages" try@osteomill.example "$packages" >/dev/null
cp "$root/srv/packages/osteomill.gpg" "$root/usr/share/keyrings/lab.gpg"
echo "deb [signed-by=/usr/share/keyrings/lab.gpg] file:/srv/packages bookworm main" >"$root/etc/apt/sources.list.d/lab.list"
named=(osteomill-server osteomill-client osteomill-tools python3-osteomill osteomill-bridge-dev osteomill-doc)

# Libraries that came with the packages may stay: they are not ours.
ours() { (cd "$root" && find etc usr var -xdev \( -path var/cache -o -path var/lib/apt -o -path var/lib/dpkg \) -prune -o -name '*osteomill*' -print); }

say "install"
sed -i.as_signed 's/^Label: Osteomill$/Label: Osteomi11/' "$root/srv/packages/dists/bookworm/InRelease"
! within apt-get update -qq 2>/dev/null || { echo "apt takes a repository that somebody changed" >&2; exit 1; }
mv "$root/srv/packages/dists/bookworm/InRelease"{.as_signed,}
within apt-get update -qq
apt() { within apt-get -y -qq --no-install-recommends "$@" "${named[@]}" >"$root/root/apt.log" 2>&1 || { tail -20 "$root/root/apt.log" >&2; exit 1; }; }
apt install
within getent passwd osteomill
[ ! -e "$root/etc/systemd/system/multi-user.target.wants/osteomill.service" ] || { echo "the unit starts by itself" >&2; exit 1; }

say "use"
cp debian/tests/demo "$root/root/"
within /root/demo
within test -s /usr/share/man/man1/haptic_server.1.gz
within sh -c 'haptic_server --check --listen 127.0.0.1:0 || true' | tail -3

say "two machines: network namespaces, and TLS by the certificates of a lab"
within apt-get -y -qq --no-install-recommends install openssl >/dev/null 2>&1
on() { local machine=$1; shift; ip netns exec "$network.$machine" chroot "$root" env --chdir=/root LC_ALL=C.UTF-8 PATH=/usr/bin:/bin "$@"; }
ip netns add "$network.server" && ip netns add "$network.client"
ip -n "$network.server" link add cable type veth peer name cable netns "$network.client"
for end in server:1 client:2; do
    ip -n "$network.${end%:*}" address add "10.213.78.${end#*:}/24" dev cable
    ip -n "$network.${end%:*}" link set cable up
done
lab=/usr/share/doc/osteomill-server/examples/make_lab_certificates.sh
for what in "ca" "server server 10.213.78.1" "client client"; do within bash $lab /root/lab $what >/dev/null; done
tls() { echo --tls-cert "lab/$1.pem" --tls-key "lab/$1.key" --tls-ca lab/ca.pem; }
on server haptic_server --case cube --listen 10.213.78.1:7010 $(tls server) --duration-s 10 --json server.json >"$root/root/server.log" 2>&1 &
on client render_client --connect 10.213.78.1:7010 $(tls client) --offscreen --frames 100000 --json client.json >"$root/root/client.log" 2>&1 &&
    wait $! || { tail -5 "$root/root/server.log" "$root/root/client.log" >&2; exit 1; }
bone() { sed -n 's/.*"bone_checksum": "\(.*\)".*/\1/p' "$root/root/$1.json"; }
[ -n "$(bone server)" ] && [ "$(bone server)" = "$(bone client)" ] || { echo "the client's bone is not the server's" >&2; exit 1; }
echo "the same bone at both ends: $(bone server)"

say "upgrade: from the same with an older version, a file that is no more, and settings that the lab changed"
older=$root/root/older
for package in "$packages"/*.deb; do
    dpkg-deb -R "$package" "$older"
    sed -i 's/^Version: .*/&~older/' "$older/DEBIAN/control"
    mkdir -p "$older/usr/share/osteomill"
    touch "$older/usr/share/osteomill/$(basename "$package").no_more"
    dpkg-deb -Znone --root-owner-group --build "$older" "$older.$(basename "$package")" >/dev/null
    rm -r "$older"
done
within sh -c 'apt-get -y -qq --allow-downgrades --no-install-recommends install /root/older.*.deb' >"$root/root/apt.log" 2>&1 || { tail -20 "$root/root/apt.log" >&2; exit 1; }
within dpkg-query -W -f '${Package} ${Version}\n' "${named[@]}"
limits=$root/etc/security/limits.d/60-osteomill.conf
echo "# of the lab" >>"$limits"
apt install
[ -z "$(find "$root/usr/share/osteomill" -name '*.no_more')" ] || { echo "files of the older version stay" >&2; exit 1; }
grep -q "# of the lab" "$limits" || { echo "the lab's settings are lost" >&2; exit 1; }
within /root/demo >/dev/null

say "remove"
apt purge
left=$(ours)
[ -z "$left" ] || { echo "left behind: $left" >&2; exit 1; }
say "nothing is left"
