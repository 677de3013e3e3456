#!/usr/bin/env bash
# Unpacks a Debian kernel, and the modules for virtual HID devices, for the tests that run in a virtual machine; installs nothing.
#
#     scripts/fetch_vm_kernel.sh [FOLDER]        build/vm-kernel where nothing is said; does nothing where it is there already
set -euo pipefail
cd "$(dirname "$0")/.."
folder=${1:-build/vm-kernel}
[ -e "$folder/vmlinuz" ] && exit

package=$(apt-cache depends linux-image-cloud-amd64 | sed -n 's/^ *Depends: \(linux-image-[0-9].*\)$/\1/p' | head -n 1)
[ -n "$package" ] || { echo "apt knows no linux-image-cloud-amd64: is this Debian, and has apt-get update been run?" >&2; exit 1; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
(cd "$scratch" && apt-get download -q "$package" >download.log 2>&1) || { cat "$scratch/download.log" >&2; exit 1; }
dpkg-deb -x "$scratch"/*.deb "$scratch/unpacked"
mkdir -p "$folder/modules"
# Below lib/modules in Debian 12, below usr/lib/modules and compressed in 13.
for module in hid uhid hid-generic; do
    found=$(find "$scratch/unpacked" -path "*/lib/modules/*/$module.ko*" -print -quit)
    case $found in
        *.ko) cp "$found" "$folder/modules/" ;;
        *.ko.xz) xz --decompress --stdout "$found" >"$folder/modules/$module.ko" ;;
        *) echo "$package has no module $module, as .ko or .ko.xz" >&2; exit 1 ;;
    esac
done
cp "$scratch"/unpacked/boot/vmlinuz-* "$folder/vmlinuz.part"
mv "$folder/vmlinuz.part" "$folder/vmlinuz"
