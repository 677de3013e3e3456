# Sourced by demo.sh and test.sh: installs missing packages, then configures and builds a preset. Works offline once the packages are
# there.

# While ninja builds: how far it is, and since when.
export NINJA_STATUS="[%p after %e s] "

say() { printf '\n== %s\n' "$*"; }

# install_packages LIST...: installs the listed packages that are missing; asks for root only then.
install_packages() {
    local wanted missing=() package
    mapfile -t wanted < <(grep -hv '^#' "$@")
    for package in "${wanted[@]}"; do
        dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
    done
    [ ${#missing[@]} -eq 0 ] && return
    local as_root=()
    if [ "$(id -u)" -ne 0 ]; then
        command -v sudo >/dev/null || {
            echo "missing packages and neither root nor sudo; as root, run: apt-get install ${missing[*]}" >&2
            exit 1
        }
        as_root=(sudo)
    fi
    say "installing ${#missing[@]} packages"
    "${as_root[@]}" apt-get update -qq
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" \
        >/dev/null
}

# build PRESET [TARGET...], configured with the array `configure`, too, where there is one.
build() {
    local preset=$1
    shift
    say "building: $preset"
    cmake --preset "$preset" "${configure[@]}" >"build-$preset.log" 2>&1 || { cat "build-$preset.log"; rm "build-$preset.log"; exit 1; }
    rm "build-$preset.log"
    cmake --build --preset "$preset" ${1:+--target "$@"}
}

# about_minutes CORE_S: so many seconds of a core, on this machine's cores.
about_minutes() {
    local minutes=$((($1 + 59) / 60 / $(nproc)))
    echo "about $((minutes > 0 ? minutes : 1)) minutes on $(nproc) cores"
}

# try_other_debian WHAT...: scripts/try_debian.sh for the Debian that this machine is not. If no bare root can be made, it says why, and
# that is no failure.
try_other_debian() {
    local other=13 result=0
    [ "$(. /etc/os-release && echo "${VERSION_ID:-}")" != 13 ] || other=12
    install_packages <(echo debootstrap)
    scripts/try_debian.sh "$other" "$@" || result=$?
    [ "$result" -eq 0 ] || [ "$result" -eq 3 ]
}
