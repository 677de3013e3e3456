#!/usr/bin/env bash
# Puts the project's packages into a signed apt repository, a folder that any web server can serve.
#   scripts/apt_repository.sh REPOSITORY KEY [PACKAGES]      PACKAGES as of scripts/package.sh: out/packages
# KEY: fingerprint or address of a secret key in GnuPG's keyring; one is made by: gpg --quick-generate-key "Osteomill <me@my.lab>"
# Earlier versions are replaced. Says in the end what a machine needs that is to install from it.
set -euo pipefail
[ $# -ge 2 ] || { sed -n '2,/^set/{/^#/p}' "$0" >&2; exit 2; }
repository=$(realpath -m "$1")
key=$2
packages=$(realpath -m "${3:-$(dirname "$0")/../out/packages}")
fail() { echo "apt_repository: $*" >&2; exit 1; }

command -v reprepro >/dev/null || fail "reprepro is not installed (apt-get install reprepro)"
fingerprint=$(gpg --batch --with-colons --list-secret-keys "$key" 2>/dev/null | awk -F: '$1 == "fpr" { print $10; exit }')
[ -n "$fingerprint" ] || fail "there is no secret key '$key' in GnuPG's keyring"
changes=("$packages"/osteomill_*.changes)
[ -e "${changes[0]}" ] || fail "$packages holds no packages: scripts/package.sh builds them"

mkdir -p "$repository/conf"
cat >"$repository/conf/distributions" <<CONF
Origin: Osteomill
Label: Osteomill
Codename: bookworm
Architectures: $(dpkg --print-architecture) source
Components: main
SignWith: $fingerprint
CONF
for file in "${changes[@]}"; do
    reprepro --silent --basedir "$repository" include bookworm "$file"
done
gpg --batch --export "$fingerprint" >"$repository/osteomill.gpg"

cat <<SAY
$(reprepro --basedir "$repository" list bookworm)
fingerprint: $fingerprint
on the machines, where URL is where $repository is served:
    sudo curl -o /usr/share/keyrings/osteomill.gpg URL/osteomill.gpg
    gpg --show-keys /usr/share/keyrings/osteomill.gpg                    # is to show the fingerprint
    echo "deb [signed-by=/usr/share/keyrings/osteomill.gpg] URL bookworm main" | sudo tee /etc/apt/sources.list.d/osteomill.list
SAY
