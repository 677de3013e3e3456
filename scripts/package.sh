#!/usr/bin/env bash
# Builds the Debian packages of what is committed, for the system that it runs on (debian_suite.sh), looks at them with lintian, which is to be
# silent, and puts the wheel and the bill of materials beside them.
#   scripts/package.sh [FOLDER]      into FOLDER, out/packages/SUITE unless said otherwise
# Needs scripts/packages.txt and scripts/package_packages.txt. The environment may choose build tools:
# CMAKE_CXX_COMPILER_LAUNCHER=ccache.
set -euo pipefail
umask 022  # modes go into the packages
cd "$(dirname "$0")/.."
. scripts/debian_suite.sh
out=$(realpath -m "${1:-out/packages/$suite}")

version=$(sed -n 's/^project(osteomill VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
in_changelog=$(dpkg-parsechangelog -S Version)
[ "$version" = "$in_changelog" ] ||
    { echo "CMakeLists.txt says version $version, debian/changelog $in_changelog: bring them together" >&2; exit 1; }

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/osteomill-$version"
git archive HEAD | tar -x --no-same-permissions -C "$work/osteomill-$version"
git rev-parse --short=12 HEAD >"$work/osteomill-$version/COMMIT"
sed -i "1s/($version) UNRELEASED;/($version$version_suffix) $suite;/" "$work/osteomill-$version/debian/changelog"
(cd "$work/osteomill-$version" && dpkg-buildpackage --no-sign --build=full --jobs="${JOBS:-$(nproc)}" >"$work/build.log" 2>&1) ||
    { tail -40 "$work/build.log" >&2; exit 1; }
lintian --allow-root --fail-on error,warning --tag-display-limit 0 "$work"/*.changes
mkdir "$work/installed"
for package in "$work"/*.deb; do dpkg-deb -x "$package" "$work/installed"; done
if grep -rlF "$work/" "$work/installed"; then echo "these hold the folder that they were built in" >&2; exit 1; fi
mkdir -p "$out"
rm -f "$out"/*osteomill* "$out/commit"
mv "$work"/*.deb "$work"/*.dsc "$work"/*.tar.* "$work"/*.changes "$work"/*.buildinfo "$out"
scripts/wheel_of_packages.sh "$out"
git rev-parse HEAD >"$out/commit"  # scripts/release.sh accepts the packages of this commit
(cd "$out" && ls -sh --block-size=1k ./*.deb)
