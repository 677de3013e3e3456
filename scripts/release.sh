#!/usr/bin/env bash
# Makes a release of what is committed: packages, source, wheel and bill of materials for each system of debian_suite.sh, checksums and their
# signature in out/release/VERSION, and then the signed tag. Publishing is copying that folder and pushing the tag; the last lines say how.
#   scripts/release.sh [--dry-run] [--minisign SECRET_KEY]
#     --dry-run    all of it but the tag
#     --minisign   signs the checksums; a key is made by: minisign -G
# Takes what scripts/package.sh has left in out/packages/SUITE, if it is of this commit; has it build those for this system otherwise.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/debian_suite.sh
fail() { echo "release: $*" >&2; exit 1; }

dry_run= key=
while [ $# -gt 0 ]; do
    case $1 in
    --dry-run) dry_run=1 ;;
    --minisign) key=$(realpath -e "${2:-}" 2>/dev/null) || fail "--minisign: there is no key '${2:-}'"; shift ;;
    *) sed -n '2,/^set/{/^#/p}' "$0" >&2; exit 2 ;;
    esac
    shift
done

version=$(sed -n 's/^project(osteomill VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
commit=$(git rev-parse HEAD)
[ -z "$(git status --porcelain)" ] || fail "the tree has changes that are not committed: git status"
# "## 0.3.0" and something below it before the next heading.
awk -v heading="## $version" '$0 == heading { found = 1; next } /^## / { found = 0 } found && NF { lines++ } END { exit !lines }' CHANGELOG.md ||
    fail "CHANGELOG.md says nothing of version $version: it needs a heading '## $version' and what is new"
! git rev-parse -q --verify "refs/tags/v$version" >/dev/null || fail "v$version is tagged already: raise the version in CMakeLists.txt and debian/changelog"
[ -z "$key" ] || command -v minisign >/dev/null || fail "minisign is not installed (apt-get install minisign)"

of_this_commit() { [ "$(cat "out/packages/$1/commit" 2>/dev/null)" = "$commit" ]; }
to_build=
for each in "${supported_suites[@]}"; do
    of_this_commit "$each" && continue
    [ "$each" = "$suite" ] || fail "out/packages/$each holds no packages of this commit: build them by scripts/package.sh on a Debian $each, and bring the folder here"
    to_build=1
done
[ -z "$to_build" ] || scripts/package.sh

out=out/release/$version
rm -rf "$out" && mkdir -p "$out"
for each in "${supported_suites[@]}"; do cp "out/packages/$each"/*osteomill* "$out"; done
(cd "$out" && LC_ALL=C sha256sum -- * >SHA256SUMS)
[ -z "$key" ] || minisign -S -s "$key" -m "$out/SHA256SUMS" -t "osteomill $version, commit $commit" >/dev/null
ls -s --block-size=1k "$out"
[ -n "$key" ] || echo "not signed: --minisign SECRET_KEY"

if [ -n "$dry_run" ]; then
    echo "dry run: v$version of $commit is not tagged"
else
    git tag --sign "v$version" -m "Osteomill $version"
    echo "to publish: git push origin v$version; scripts/apt_repository.sh FOLDER KEY; copy both folders to the server"
fi
