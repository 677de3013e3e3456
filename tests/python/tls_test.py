"""haptic_server, packet_replay and render_client as they run on two machines: TLS, on all addresses."""

import shutil
import signal
import subprocess
import tempfile
import unittest

from running import Running, removed_mm3
from support import REPOSITORY, FolderTest, eventually


def tls(folder, name):
    return "--tls-cert", f"{folder}/{name}.pem", "--tls-key", f"{folder}/{name}.key", "--tls-ca", f"{folder}/ca.pem"


class TlsTest(FolderTest):
    def client(self, address, json_name, *files):
        """Draws until the session at an address (0.0.0.0:PORT, as the server says it) is over."""
        return Running("render_client", "--connect", "127.0.0.1:" + address.rpartition(":")[2], "--offscreen", "--window-size", "160x120",
                       "--frames", "100000", "--json", self.folder / json_name, *files)

    @unittest.skipUnless(shutil.which("openssl"), "there is no openssl to make certificates with")
    def test_serve_the_lab_on_all_addresses_and_the_bones_are_equal(self):
        with tempfile.TemporaryDirectory() as lab:
            for words in (["ca"], ["server", "bench", "127.0.0.1", "localhost"], ["client", "viewer"]):
                subprocess.run([REPOSITORY / "scripts/make_lab_certificates.sh", lab, *words], check=True, stdout=subprocess.DEVNULL)
            bench, viewer = tls(lab, "bench"), tls(lab, "viewer")
            with Running("haptic_server", "--listen", "0.0.0.0:0", "--json", self.folder / "server.json", "--record", self.folder / "a.pcap",
                         "--log-csv", self.folder / "force.csv", *bench) as server:
                address = server.address()
                self.assertTrue(address, server.err)
                with self.client(address, "member.json", *viewer) as member:
                    self.assertTrue(server.has_logged("(viewer) joined"), server.err)
                    self.assertTrue(eventually(lambda: removed_mm3(self.folder / "force.part.csv") > 0.1), server.err)
                    self.assertEqual(server.end(signal.SIGINT), 0, server.err)
                    self.assertEqual(member.wait(), 0, member.err)
            checksum = self.json("server.json")["bone_checksum"]
            self.assertEqual(self.json("member.json")["bone_checksum"], checksum)
            self.assertEqual(self.json("member.json")["checksum_mismatches"], 0)

            with Running("packet_replay", self.folder / "a.pcap", "--listen", "0.0.0.0:0", "--speed", "4", *bench) as replay:
                address = replay.address()
                self.assertTrue(address, replay.err)
                with self.client(address, "again.json", *viewer) as again:
                    self.assertEqual(replay.wait(), 0, replay.err)
                    self.assertEqual(again.wait(), 0, again.err)
            self.assertEqual(self.json("again.json")["bone_checksum"], checksum)

    def test_say_in_one_line_what_is_missing(self):
        nowhere = tls("/nowhere", "a")
        for status, reason, *command in (
                (2, "--tls-key: is missing", "haptic_server", "--tls-cert", "a.pem"),
                (2, "--tls-cert: is missing", "packet_replay", "a.pcap", "--tls-key", "a.key"),
                (2, "--tls-cert: is missing", "render_client", "--tls-ca", "ca.pem"),
                (2, "--insecure-network", "haptic_server", "--listen", "0.0.0.0:0"),
                (2, "--insecure-network", "packet_replay", "a.pcap", "--listen", "0.0.0.0:0"),
                (1, "/nowhere/a.pem: cannot be read", "haptic_server", *nowhere),
                (1, "/nowhere/a.pem: cannot be read", "packet_replay", "a.pcap", *nowhere),
                (1, "/nowhere/a.pem: cannot be read", "render_client", "--offscreen", *nowhere)):
            self.expect_line(status, reason, *command)


if __name__ == "__main__":
    unittest.main()
