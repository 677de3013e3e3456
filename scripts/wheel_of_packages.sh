#!/usr/bin/env bash
# Makes, of the packages in a folder, the wheel for the Python of this system and the bill of materials of the programs, beside them.
#   scripts/wheel_of_packages.sh FOLDER
# The modules in the wheel are the package's, which need this system's libraries: there is nothing to compile anew.
set -euo pipefail
[ $# -eq 1 ] || { sed -n '2,/^set/{/^#/p}' "$0" >&2; exit 2; }
folder=$(realpath "$1")
cd "$(dirname "$0")/.."
. scripts/debian_suite.sh

version=$(sed -n 's/^project(osteomill VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
installed=$(mktemp -d)
trap 'rm -rf "$installed"' EXIT
for package in "$folder"/*.deb; do dpkg-deb -x "$package" "$installed"; done
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
export SOURCE_DATE_EPOCH
OSTEOMILL_MODULES=$(dirname "$(find "$installed" -name "_core.*.so")") \
    /usr/bin/python3 -m pip --quiet wheel --no-build-isolation --no-index --no-deps --wheel-dir "$folder" ./python
# A script loads no library by itself.
programs=()
for program in "$installed"/usr/bin/*; do
    [ "$(head -c 2 "$program")" = '#!' ] || programs+=("$program")
done
scripts/bill_of_materials.py "${programs[@]}" >"$folder/osteomill-$version-$suite.spdx.json"
