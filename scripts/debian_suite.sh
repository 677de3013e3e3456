# Sourced: which system packages are built for, that of the machine that builds them.
#   suite             its name in apt's sources, and that of the packages' folder below out/packages
#   version_suffix    what their version ends with; a newer system's sorts above an older one's: a machine that is upgraded takes them along
# supported_suites are those that a release has packages for, the oldest first.
supported_suites=(bookworm trixie)

suite=$(. /etc/os-release && echo "${VERSION_CODENAME:-}")
[ -n "$suite" ] || { echo "/etc/os-release names no VERSION_CODENAME: packages are built on a release of Debian, such as 12 or 13" >&2; exit 1; }
version_suffix=$(. /etc/os-release && echo "+${ID/#debian/deb}${VERSION_ID:-$suite}u1")
