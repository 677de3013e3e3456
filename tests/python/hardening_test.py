"""The programs as they were linked, and the units that start them: hardened as cmake/osteomill_hardening.cmake says, and confined."""

import pathlib
import platform
import re
import shutil
import subprocess
import unittest

from support import IS_OPTIMISED, IS_SANITIZED, REPOSITORY, program


def output(*words):
    return subprocess.run(words, capture_output=True, text=True).stdout


class HardeningTest(unittest.TestCase):
    @unittest.skipUnless(IS_OPTIMISED and not IS_SANITIZED, "only what is optimised, and without sanitizers, is hardened")
    @unittest.skipUnless(shutil.which("readelf"), "there is no readelf (binutils)")
    def test_is_in_the_programs(self):
        for name in ("haptic_server", "packet_replay", "render_client", "bone_import"):
            with self.subTest(name):
                headers = output("readelf", "-hldW", program(name))
                self.assertRegex(headers, "Type: +DYN", "it is loaded anywhere")
                self.assertIn("GNU_RELRO", headers)
                self.assertRegex(headers, "FLAGS_1.*NOW", "with all functions found at the start")
                self.assertRegex(headers, "GNU_STACK .* RW ", "and no code on the stack")
                symbols = output("readelf", "-W", "--dyn-syms", program(name))
                self.assertIn("__stack_chk_fail", symbols)
                self.assertRegex(symbols, "__[a-z]+_chk@", "copies are checked")
                if platform.machine() == "x86_64":
                    mark = b"\xf3\x0f\x1e\xfa"  # endbr64; the C library's own code has a handful
                    self.assertGreater(pathlib.Path(program(name)).read_bytes().count(mark), 500)


class ConfinementTest(unittest.TestCase):
    def test_of_the_service_is_what_systemd_calls_ok(self):
        if not shutil.which("systemd-analyze") or "--offline" not in output("systemd-analyze", "security", "--help"):
            self.skipTest("there is no systemd-analyze that judges a unit offline (systemd 250)")
        unit = REPOSITORY / "scripts/systemd/osteomill.service"
        # In tenths: below 3.0.
        judged = subprocess.run(["systemd-analyze", "security", "--offline=yes", "--threshold=30", "--no-pager", unit],
                                capture_output=True, text=True)
        self.assertEqual(judged.returncode, 0, judged)
        self.assertIn("Overall exposure level for osteomill.service", judged.stdout)
        self.assertNotIn("Unknown", judged.stderr, "a directive that systemd does not know confines nothing")
        # And yet its loops and its arm have the permissions that they need.
        for needed in ("DeviceAllow=char-hidraw rw", "LimitRTPRIO=50", "LimitMEMLOCK=infinity", "RestrictRealtime=no",
                       "SupplementaryGroups=plugdev", "StateDirectory=osteomill", "RuntimeDirectory=osteomill",
                       "RestrictAddressFamilies=AF_INET AF_INET6 AF_UNIX"):
            self.assertIn(f"\n{needed}\n", unit.read_text())

    def test_gives_real_time_priority_to_a_group_of_its_own_alone(self):
        lines = (REPOSITORY / "scripts/limits/60-osteomill.conf").read_text().splitlines()
        rights = [line for line in lines if line and not line.startswith("#")]
        self.assertEqual(len(rights), 2)
        for right in rights:
            self.assertTrue(right.startswith("@osteomill-rt - "), f"everybody at the machine is in plugdev: {right}")
        self.assertIn("\ng osteomill-rt -\n", (REPOSITORY / "debian/osteomill-server.sysusers").read_text(), "the package makes it")

    def test_of_the_containers_leaves_no_capability_and_nothing_to_write_on(self):
        compose, realtime, image = ((REPOSITORY / "docker" / name).read_text()
                                    for name in ("compose.yaml", "compose.realtime.yaml", "server.Dockerfile"))
        self.assertGreaterEqual(compose.count("    image: "), 4)
        self.assertEqual(compose.count("    <<: *confined"), compose.count("    image: "), "each service is confined")
        for line in ("  cap_drop: [ALL]", "  read_only: true", '  security_opt: ["no-new-privileges:true"]'):
            self.assertEqual(compose.count(line), 1, line)
        self.assertIn("compose.realtime.yaml", compose)
        for refused in ("cap_add:", "privileged:", "ulimits:", "devices:", "network_mode:", "cpu_rt_"):
            self.assertEqual(compose.count(refused), 0, f"{refused} is what a host may refuse")
        self.assertEqual(realtime.count("\n  server:\n    ulimits: {rtprio: 50, memlock: -1}\n"), 1)
        self.assertRegex(image, "\nCMD .*\n")
        command = re.search("\nCMD (.*)\n", image)[1]
        self.assertIn("127.0.0.1:", command)
        self.assertNotIn("--insecure-network", command)


if __name__ == "__main__":
    unittest.main()
