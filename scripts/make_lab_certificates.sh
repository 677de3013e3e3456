#!/bin/bash
# Makes the certificates with which the programs of a lab know each other over TLS.
#
#   make_lab_certificates.sh FOLDER ca [NAME]                 once: the lab's CA, in FOLDER
#   make_lab_certificates.sh FOLDER server NAME HOST...       for each server; HOST: every name or address that clients connect to
#   make_lab_certificates.sh FOLDER client NAME               for each client
#   make_lab_certificates.sh FOLDER revoke [NAME]             when a key is lost or someone leaves: makes FOLDER/crl.pem
#
# ca.pem goes to every machine. NAME.pem and NAME.key go to the machine they are for, over a channel that is trusted already (scp),
# and nowhere else. ca.key signs new certificates: its owner is the lab, so it belongs on no server and on no client.
#
# Keys are ECDSA P-256, readable by their owner alone. The CA holds for ten years, a certificate for 825 days, unless --days N
# before FOLDER says otherwise; after that it is refused, and a new one is to be made. No key and no certificate is ever
# overwritten.
#
# crl.pem names all certificates that were revoked so far; without a NAME it is only made anew. It is no secret, goes to every machine
# (copied beside the old one and moved over it), and programs read it with --tls-crl FILE. It holds for as long as the CA of today
# would, and after that nobody is accepted until there is a new one. FOLDER/revoked.index, with which it is made, stays with ca.key.
set -euo pipefail
umask 077

fail() {
    echo "make_lab_certificates.sh: $*" >&2
    exit 1
}

usage() {
    sed -n '4,7s/^#   //p' "$0" >&2
    exit 2
}

ca_days=3650
days=825
if [ "${1:-}" = --days ]; then
    [[ ${2:-} =~ ^[1-9][0-9]{0,3}$ ]] || usage
    ca_days=$2
    days=$2
    shift 2
fi
[ $# -ge 2 ] || usage
folder=$1
role=$2
shift 2
command -v openssl >/dev/null || fail "openssl is not installed; as root: apt-get install openssl"

# A name becomes part of a path and of a certificate's subject.
require_name() {
    [[ $1 =~ ^[A-Za-z0-9][A-Za-z0-9._-]{0,62}$ ]] || fail "'$1' is no name; letters, digits, '.', '_' and '-' make one"
}

require_absent() {
    local file
    for file in "$@"; do
        [ ! -e "$file" ] || fail "$file is there already; nothing is overwritten"
    done
}

# alternative_names HOST...: as the extension subjectAltName has them
alternative_names() {
    local host list=()
    for host in "$@"; do
        if [[ $host =~ ^[0-9]+(\.[0-9]+){3}$ || $host == *:* ]]; then
            list+=("IP:$host")
        elif [[ $host =~ ^[A-Za-z0-9]([A-Za-z0-9.-]*[A-Za-z0-9])?$ ]]; then
            list+=("DNS:$host")
        else
            fail "'$host' is neither a host's name nor an address"
        fi
    done
    (IFS=,; echo "${list[*]}")
}

new_key=(-newkey ec -pkeyopt ec_paramgen_curve:P-256 -noenc)

make_ca() {
    require_name "$1"
    mkdir -p "$folder"
    require_absent "$folder/ca.pem" "$folder/ca.key"
    openssl req -x509 "${new_key[@]}" -keyout "$folder/ca.key" -out "$folder/ca.pem" -days "$ca_days" -subj "/CN=$1" \
        -addext basicConstraints=critical,CA:TRUE,pathlen:0 -addext keyUsage=critical,keyCertSign,cRLSign 2>"$log"
    chmod 644 "$folder/ca.pem"
}

# make_certificate NAME USAGE [ALTERNATIVE_NAMES]
make_certificate() {
    require_name "$1"
    [ "$1" != ca ] || fail "'ca' is the name of the CA's own files"
    [ -f "$folder/ca.key" ] || fail "$folder holds no CA yet; first: make_lab_certificates.sh $folder ca"
    require_absent "$folder/$1.pem" "$folder/$1.key"
    local extensions="basicConstraints=critical,CA:FALSE
keyUsage=critical,digitalSignature
extendedKeyUsage=$2
authorityKeyIdentifier=keyid"
    [ -z "${3:-}" ] || extensions+=$'\n'"subjectAltName=$3"
    openssl req "${new_key[@]}" -keyout "$folder/$1.key" -subj "/CN=$1" 2>"$log" |
        openssl x509 -req -CA "$folder/ca.pem" -CAkey "$folder/ca.key" -days "$days" -out "$folder/$1.pem" \
            -extfile <(echo "$extensions") 2>>"$log" || {
        rm -f "$folder/$1.pem" "$folder/$1.key"
        fail "openssl could not make $folder/$1.pem"
    }
    chmod 644 "$folder/$1.pem"
}

# sign_list ARGUMENT...: openssl ca, with the records of whom the CA has revoked
sign_list() {
    openssl ca -batch -config <(printf '[ca]\ndefault_ca = lab\n[lab]\ndatabase = %s\ndefault_md = sha256\n' \
        "$folder/revoked.index") -cert "$folder/ca.pem" -keyfile "$folder/ca.key" "$@" 2>>"$log"
}

revoke() {
    [ -f "$folder/ca.key" ] || fail "$folder holds no CA; only who has its key can revoke what it signed"
    openssl x509 -in "$folder/ca.pem" -noout -ext keyUsage 2>/dev/null | grep -q "CRL Sign" ||
        fail "$folder/ca.pem was made before there were lists of revoked certificates and may sign none; make a new CA"
    # OpenSSL opens what stands there with the folder's name in it.
    [[ $folder != *[\$\#\"\\]* ]] || fail "the folder's name '$folder' has a character that openssl takes for its own"
    touch "$folder/revoked.index"
    if [ $# -gt 0 ]; then
        require_name "$1"
        [ "$1" != ca ] || fail "the CA cannot revoke itself: make a new one, and certificates for all"
        [ -f "$folder/$1.pem" ] || fail "there is no certificate $folder/$1.pem to revoke"
        local serial
        serial=$(openssl x509 -in "$folder/$1.pem" -noout -serial | cut -d= -f2)
        if grep -q "^R.*[[:space:]]${serial}[[:space:]]" "$folder/revoked.index"; then
            echo "$folder/$1.pem is revoked already; the list is made anew" >&2
        else
            sign_list -revoke "$folder/$1.pem" || fail "openssl could not revoke $folder/$1.pem"
        fi
    fi
    sign_list -gencrl -crldays "$ca_days" -out "$folder/crl.pem.new" || fail "openssl could not make $folder/crl.pem"
    chmod 644 "$folder/crl.pem.new"
    mv "$folder/crl.pem.new" "$folder/crl.pem"
}

log=$(mktemp)
trap 'status=$?; [ $status -eq 0 ] || cat "$log" >&2; rm -f "$log"; exit $status' EXIT

case $role in
    ca)
        [ $# -le 1 ] || usage
        make_ca "${1:-osteomill-lab}"
        ;;
    server)
        [ $# -ge 2 ] || usage
        name=$1
        names=$(alternative_names "${@:2}")
        make_certificate "$name" serverAuth "$names"
        ;;
    client)
        [ $# -eq 1 ] || usage
        make_certificate "$1" clientAuth
        ;;
    revoke)
        [ $# -le 1 ] || usage
        revoke "$@"
        ;;
    *)
        usage
        ;;
esac
