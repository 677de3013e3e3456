#!/usr/bin/env python3
"""The bill of materials of built programs in SPDX 2.3's JSON: the Debian packages whose libraries they load.

    scripts/bill_of_materials.py PROGRAM... > osteomill.spdx.json

For each package: version, licences as its debian/copyright states them, and the SHA-256 of each library that is loaded. The
time is SOURCE_DATE_EPOCH's, else that of the newest commit, so that the same programs on the same machine give the same bytes.
Reads what ldd and dpkg say; a library that belongs to no package is an error, for nobody could say what it is.
"""

import datetime
import gzip
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent


def output_of(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def libraries_of(program):
    """The files that the loader maps for a program; the kernel's own page is none."""
    said = subprocess.run(["ldd", program], capture_output=True, text=True)
    if said.returncode != 0:
        sys.exit(f"bill_of_materials: {program}: is no program")
    return {os.path.realpath(path) for path in re.findall(r"(/\S+) \(0x", said.stdout)}


def packages_of(libraries):
    """The package that each library's file belongs to. Before /usr was merged its files were under /lib."""
    names = {path: library for library in libraries for path in (library, library.removeprefix("/usr"))}
    said = subprocess.run(["dpkg-query", "-S", *names], capture_output=True, text=True).stdout
    found = {}
    for line in said.splitlines():
        packages, _, path = line.rpartition(": ")
        if path in names:
            found[names[path]] = packages.split(",")[0]
    for library in sorted(libraries - found.keys()):
        sys.exit(f"bill_of_materials: {library} belongs to no Debian package")
    return found


def licences_of(package):
    """The short names of all licences in the package's copyright file (DEP-5), sorted; none if it is prose."""
    name = package.split(":")[0]
    folder = pathlib.Path("/usr/share/doc") / name
    for file in (folder / "copyright", folder / "copyright.gz"):
        if file.exists():
            text = gzip.open(file, "rt", errors="replace").read() if file.suffix == ".gz" else file.read_text(errors="replace")
            named = re.findall(r"^License: *(\S.*)$", text, re.MULTILINE) if "Format:" in text.split("\n\n")[0] else []
            return sorted({part for names in named for part in re.split(r" (?:and|or|with .*)(?: |$)|, *| *\| *", names) if part})
    return []


def sha256_of(path):
    return hashlib.sha256(pathlib.Path(path).read_bytes()).hexdigest()


def spdx_id(text):
    return "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]", "-", text)


def created():
    seconds = os.environ.get("SOURCE_DATE_EPOCH") or output_of("git", "-C", str(ROOT), "log", "-1", "--format=%ct")
    return datetime.datetime.fromtimestamp(int(seconds), datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")


def package_entry(package, libraries):
    version, source = output_of("dpkg-query", "-W", "-f", "${Version}\t${source:Package}", package).split("\t")
    licences = ", ".join(licences_of(package)) or "in prose"
    return {
        "SPDXID": spdx_id("package-" + package), "name": package, "versionInfo": version, "supplier": "Organization: Debian",
        "sourceInfo": f"Debian source package {source}", "downloadLocation": "NOASSERTION", "filesAnalyzed": False,
        "licenseConcluded": "NOASSERTION", "licenseDeclared": "NOASSERTION",
        "licenseComments": f"/usr/share/doc/{package.split(':')[0]}/copyright: {licences}",
        "copyrightText": "NOASSERTION",
        "comment": "; ".join(f"{library} sha256:{sha256_of(library)}" for library in sorted(libraries)),
    }


def program_entry(program, version):
    name = os.path.basename(program)
    return {
        "SPDXID": spdx_id("program-" + name), "name": name, "versionInfo": version, "downloadLocation": "NOASSERTION",
        "filesAnalyzed": False, "licenseConcluded": "Apache-2.0", "licenseDeclared": "Apache-2.0",
        "copyrightText": "NOASSERTION", "checksums": [{"algorithm": "SHA256", "checksumValue": sha256_of(program)}],
    }


def bill(programs):
    version = re.search(r"project\(osteomill VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text()).group(1)
    libraries = {program: libraries_of(program) for program in sorted(programs)}
    package_of = packages_of(set().union(*libraries.values()))
    loaded = {}
    for library, package in package_of.items():
        loaded.setdefault(package, set()).add(library)
    relations = []
    for program, needed in libraries.items():
        own = spdx_id("program-" + os.path.basename(program))
        relations.append(("SPDXRef-DOCUMENT", "DESCRIBES", own))
        relations += [(own, "DYNAMIC_LINK", spdx_id("package-" + package))
                      for package in sorted({package_of[library] for library in needed})]
    entries = [program_entry(program, version) for program in libraries]
    entries += [package_entry(package, libraries) for package, libraries in sorted(loaded.items())]
    digest = hashlib.sha256("".join(sorted(sha256_of(program) for program in programs)).encode()).hexdigest()
    return {
        "spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT", "name": f"osteomill-{version}",
        "documentNamespace": f"urn:osteomill:{version}:{digest}",
        "creationInfo": {"created": created(), "creators": ["Tool: scripts/bill_of_materials.py"]},
        "packages": entries,
        "relationships": [{"spdxElementId": a, "relationshipType": kind, "relatedSpdxElement": b} for a, kind, b in relations],
    }


if __name__ == "__main__":
    if len(sys.argv) < 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    json.dump(bill(sys.argv[1:]), sys.stdout, indent=1, ensure_ascii=False)
    print()
