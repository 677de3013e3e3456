#!/usr/bin/env bash
# Upgrades a bare Debian that has the project's packages to the next Debian: they are to come along from the repository (apt_repository.sh),
# keep what the lab changed, work, read a recording of before, and leave nothing when they are removed.
#   scripts/try_upgrade.sh [FOLDER NEXT_FOLDER]      packages of both as scripts/package.sh leaves them: the supported suites'
# Needs root.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/debian_suite.sh
. scripts/bare_root.sh
packages=$(realpath -m "${1:-out/packages/${supported_suites[0]}}")
next_packages=$(realpath -m "${2:-out/packages/${supported_suites[1]}}")
suite=$(suite_of "$packages")
next=$(suite_of "$next_packages")
make_bare_root "$suite"

say "$suite with the packages, a recording, and settings that the lab changed"
serve_packages "$packages" "$next_packages"
apt update
apt install "${named[@]}"
versions() { within dpkg-query -W -f '${Package} ${Version}\n' "${named[@]}"; }
versions
run_demo
recording=/root/session.pcap
within haptic_server --clock virtual --duration-s 2 --record $recording >/dev/null
bone() { within packet_replay $recording --info --json /root/info.json >/dev/null; sed -n 's/.*"bone_checksum": "\(.*\)".*/\1/p' "$root/root/info.json"; }
before=$(bone)
limits=$root/etc/security/limits.d/60-osteomill.conf
echo "# of the lab" >>"$limits"

say "to $next"
sed -i "s/\b$suite\b/$next/" "$root/etc/apt/sources.list" "$root/etc/apt/sources.list.d/lab.list"
apt update
apt full-upgrade
versions
version=$(sed -n 's/^Version: //p' "$next_packages"/osteomill_*.changes)
[ -z "$(versions | grep -v " $version$")" ] || { echo "not all packages are $version" >&2; exit 1; }
[ -z "$(within dpkg --audit)" ] || { within dpkg --audit >&2; exit 1; }
grep -q "# of the lab" "$limits" || { echo "the lab's settings are lost" >&2; exit 1; }
run_demo
[ -n "$before" ] && [ "$(bone)" = "$before" ] || { echo "a recording of before reads as another bone" >&2; exit 1; }
echo "the same bone in the recording of before: $before"

say "remove"
remove_packages
say "nothing is left"
