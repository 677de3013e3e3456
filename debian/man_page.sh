#!/bin/sh
# A manual page of a program's output for --help: debian/man_page.sh build/package/bin/PROGRAM >PROGRAM.1
set -eu
case ${1##*/} in
haptic_server) what='bone, forces and the haptic arm of the Osteomill simulator' ;;
render_client) what='the window of the Osteomill simulator of bone milling' ;;
bone_import) what='makes a bone or a case for Osteomill of a scan' ;;
bone_export) what='writes the surface of an Osteomill bone' ;;
packet_replay) what='reads a recording of an Osteomill session' ;;
osteomill_slicer) what='shows a session of the Osteomill simulator in 3D Slicer' ;;
osteomill_study) what='measures and compares what the Osteomill simulator does' ;;
esac
exec help2man --no-info --no-discard-stderr --name "$what" "$1"
