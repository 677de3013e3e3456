#!/usr/bin/env bash
# The documents as a site of files, to be read offline: out/site/docs/site/index.html.
# Pages, protocol, Python, the bridge's header and all C++ headers. Fails where a link leads nowhere, or a page takes from elsewhere.
set -euo pipefail
cd "$(dirname "$0")/.."
source scripts/prepare.sh

install_packages scripts/site_packages.txt
mkdir -p out/site-xml out/site-cpp

# Doxyfile settings, on standard input.
settings="QUIET=YES
WARNINGS=NO
WARN_LOGFILE=/dev/null
PROJECT_NAME=Osteomill
EXTRACT_ALL=YES
FULL_PATH_NAMES=YES
STRIP_FROM_PATH=.
HAVE_DOT=NO
TYPEDEF_HIDES_STRUCT=YES"
doxygen - <<<"$settings
INPUT=bridge/osteomill_bridge.h
INPUT_FILTER=\"sed -E '1s,^/[*],/** @file\n *,;s,^( *)/[*] ([^-]),\\1/** \\2,;s/([;,}] +).[*] /\\1\/**< /'\"
OPTIMIZE_OUTPUT_FOR_C=YES
GENERATE_XML=YES
GENERATE_HTML=NO
GENERATE_LATEX=NO
OUTPUT_DIRECTORY=out/site-xml"
doxygen - <<<"$settings
INPUT=common simulation devices imaging analysis haptic_server render_client studies
FILE_PATTERNS=*.h
RECURSIVE=YES
GENERATE_LATEX=NO
OUTPUT_DIRECTORY=out/site-cpp
HTML_OUTPUT=cpp"
/usr/bin/python3 -m sphinx -q -W --keep-going -b html -c docs/site . out/site
/usr/bin/python3 scripts/check_site.py out/site
echo "out/site/docs/site/index.html"
