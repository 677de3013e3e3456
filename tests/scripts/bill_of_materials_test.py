"""The bill of materials against loader, dpkg and sha256sum for the same programs."""

import json
import os
import subprocess
import sys
import unittest

SCRIPT, *PROGRAMS = sys.argv[1:]


def output_of(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def bill_of(*programs):
    return output_of(SCRIPT, *programs)


class BillOfMaterials(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.bill = json.loads(bill_of(*PROGRAMS))
        cls.packages = {p["SPDXID"]: p for p in cls.bill["packages"] if p["SPDXID"].startswith("SPDXRef-package-")}

    def test_names_the_packages_of_every_library_that_is_loaded(self):
        for program in PROGRAMS:
            own = next(p["SPDXID"] for p in self.bill["packages"] if p["name"] == os.path.basename(program))
            linked = {r["relatedSpdxElement"] for r in self.bill["relationships"]
                      if r["spdxElementId"] == own and r["relationshipType"] == "DYNAMIC_LINK"}
            owned = set()
            for package in linked:
                owned.update(output_of("dpkg-query", "-L", self.packages[package]["name"]).split("\n"))
            for line in output_of("ldd", program).splitlines():
                if "=>" in line:
                    path = os.path.realpath(line.split("=>")[1].split()[0])
                    self.assertTrue({path, path.removeprefix("/usr")} & owned, path)

    def test_states_version_and_licences_of_each(self):
        for package in self.packages.values():
            self.assertEqual(package["versionInfo"], output_of("dpkg-query", "-W", "-f", "${Version}", package["name"]))
            self.assertTrue(package["licenseComments"].split(": ")[1])
        named = {p["name"].split(":")[0]: p["licenseComments"] for p in self.packages.values()}
        spdlog = next(name for name in named if name.startswith("libspdlog"))  # its version is the system's
        self.assertIn("Expat", named[spdlog])  # as its copyright file says
        self.assertIn("Zlib", named["zlib1g"])

    def test_digests_are_those_of_sha256sum(self):
        for program in PROGRAMS:
            entry = next(p for p in self.bill["packages"] if p["name"] == os.path.basename(program))
            self.assertEqual(entry["checksums"][0]["checksumValue"], output_of("sha256sum", program).split()[0])
        spdlog = next(package for package in self.packages.values() if package["name"].startswith("libspdlog"))
        library, digest = spdlog["comment"].split(" sha256:")
        self.assertEqual(digest.split(";")[0], output_of("sha256sum", library).split()[0])

    def test_has_the_same_bytes_again(self):
        self.assertEqual(bill_of(*PROGRAMS), bill_of(*reversed(PROGRAMS)))

    def test_refuses_what_is_no_program_in_one_line(self):
        refused = subprocess.run([SCRIPT, "/etc/hostname"], capture_output=True, text=True)
        self.assertNotEqual(refused.returncode, 0)
        self.assertEqual(refused.stderr, "bill_of_materials: /etc/hostname: is no program\n")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
