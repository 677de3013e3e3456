#!/usr/bin/env bash
# Puts the project's packages into a signed apt repository, a folder that any web server can serve: each under the suite that it is for.
#   scripts/apt_repository.sh REPOSITORY KEY [PACKAGES...]      PACKAGES as of scripts/package.sh: all of out/packages/*
# KEY: fingerprint or address of a secret key in GnuPG's keyring; one is made by: gpg --quick-generate-key "Osteomill <me@my.lab>"
# Earlier versions of a suite are replaced. Prints in the end the setup of a machine that installs from it.
set -euo pipefail
[ $# -ge 2 ] || { sed -n '2,/^set/{/^#/p}' "$0" >&2; exit 2; }
repository=$(realpath -m "$1")
key=$2
shift 2
[ $# -gt 0 ] || set -- "$(realpath -m "$(dirname "$0")")"/../out/packages/*
fail() { echo "apt_repository: $*" >&2; exit 1; }

command -v reprepro >/dev/null || fail "reprepro is not installed (apt-get install reprepro)"
fingerprint=$(gpg --batch --with-colons --list-secret-keys "$key" 2>/dev/null | awk -F: '$1 == "fpr" { print $10; exit }')
[ -n "$fingerprint" ] || fail "there is no secret key '$key' in GnuPG's keyring"
changes=()
for packages in "$@"; do
    in_folder=("$packages"/osteomill_*.changes)
    [ -e "${in_folder[0]}" ] || fail "$packages holds no packages: scripts/package.sh builds them"
    changes+=("${in_folder[@]}")
done
suite_of() { sed -n 's/^Distribution: //p' "$1"; }

mkdir -p "$repository/conf"
conf=$repository/conf/distributions
touch "$conf"
# Those that the repository has already, too.
suites=$({ sed -n 's/^Codename: //p' "$conf"; for file in "${changes[@]}"; do suite_of "$file"; done; } | sort -u)
for suite in $suites; do
    cat <<CONF
Origin: Osteomill
Label: Osteomill
Codename: $suite
Architectures: $(dpkg --print-architecture) source
Components: main
SignWith: $fingerprint

CONF
done >"$conf.new"
mv "$conf.new" "$conf"
for file in "${changes[@]}"; do
    reprepro --silent --basedir "$repository" include "$(suite_of "$file")" "$file"
done
gpg --batch --export "$fingerprint" >"$repository/osteomill.gpg"

cat <<SAY
$(for suite in $suites; do reprepro --basedir "$repository" list "$suite"; done)
fingerprint: $fingerprint
on the machines, where URL is where $repository is served:
    sudo curl -o /usr/share/keyrings/osteomill.gpg URL/osteomill.gpg
    gpg --show-keys /usr/share/keyrings/osteomill.gpg                    # is to show the fingerprint
    echo "deb [signed-by=/usr/share/keyrings/osteomill.gpg] URL \$(. /etc/os-release; echo \$VERSION_CODENAME) main" | sudo tee /etc/apt/sources.list.d/osteomill.list
SAY
