#!/usr/bin/env bash
# Has a bare Debian of their suite install the project's packages from a signed repository of them (apt_repository.sh), use them, also as
# two machines, upgrade them, and remove them: nothing is to be left. try_upgrade.sh goes from a suite to the next.
#   scripts/try_packages.sh [FOLDER]      FOLDER as of scripts/package.sh: out/packages/SUITE
# Needs root.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/debian_suite.sh
. scripts/bare_root.sh
packages=$(realpath -m "${1:-out/packages/$suite}")
suite=$(suite_of "$packages")
make_bare_root "$suite"
network=$(basename "$root")
clean_up() {
    for end in server client; do ip netns del "$network.$end" 2>/dev/null || true; done
    remove_bare_root
}
trap clean_up EXIT

say "a repository, signed by a key of today"
serve_packages "$packages"

say "install"
sed -i.as_signed 's/^Label: Osteomill$/Label: Osteomi11/' "$root/srv/packages/dists/$suite/InRelease"
! within apt-get update -qq 2>/dev/null || { echo "apt takes a repository that somebody changed" >&2; exit 1; }
mv "$root/srv/packages/dists/$suite/InRelease"{.as_signed,}
apt update
apt install "${named[@]}"
within getent passwd osteomill
[ ! -e "$root/etc/systemd/system/multi-user.target.wants/osteomill.service" ] || { echo "the unit starts by itself" >&2; exit 1; }

say "use"
run_demo
within test -s /usr/share/man/man1/haptic_server.1.gz
within sh -c 'haptic_server --check --listen 127.0.0.1:0 || true' | tail -3

say "two machines: network namespaces, and TLS by the certificates of a lab"
apt install openssl
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
    sed -i 's/^Version: .*/&~older/; s/(= [^)]*/&~older/g' "$older/DEBIAN/control"  # packages of one version name one another
    mkdir -p "$older/usr/share/osteomill"
    touch "$older/usr/share/osteomill/$(basename "$package").no_more"
    dpkg-deb -Znone --root-owner-group --build "$older" "$older.$(basename "$package")" >/dev/null
    rm -r "$older"
done
older_packages=("$root"/root/older.*.deb)
apt --allow-downgrades install "${older_packages[@]#"$root"}"
within dpkg-query -W -f '${Package} ${Version}\n' "${named[@]}"
limits=$root/etc/security/limits.d/60-osteomill.conf
echo "# of the lab" >>"$limits"
apt install "${named[@]}"
[ -z "$(find "$root/usr/share" -name '*.no_more')" ] || { echo "files of the older version stay" >&2; exit 1; }
grep -q "# of the lab" "$limits" || { echo "the lab's settings are lost" >&2; exit 1; }
run_demo >/dev/null

say "remove"
remove_packages
say "nothing is left"
