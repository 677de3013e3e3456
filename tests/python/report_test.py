"""The report of a session: the server's is the one that is made again of its recording."""

import unittest

from support import FolderTest


class ReportTest(FolderTest):
    def serve(self, status, *words):
        return self.run_to(status, "haptic_server", "--clock", "virtual", "--duration-s", "4", *words)

    def test_of_the_live_session_is_that_of_its_recording(self):
        (self.folder / "script.csv").write_text("t_s,action,text\n3.0,mark,here\n")
        live = self.serve(0, "--trainee", "Anna", "--report", self.folder / "anna", "--controls", self.folder / "script.csv",
                          "--json", self.folder / "server.json")
        self.assertIn("the session has ended; its report is being made\nreport: ", live.stdout)
        again = self.run_to(0, "packet_replay", self.folder / "anna/session.pcap", "--report", self.folder / "again")
        self.assertEqual(again.stdout, f"report: {self.folder}/again/report.html\n")
        for name in ("report.html", "metrics.csv", "metrics.json"):
            first, second = ((self.folder / made / name).read_bytes() for made in ("anna", "again"))
            self.assertGreater(len(first), 100)
            self.assertEqual(first, second, name)
        measured, report = self.json("server.json"), self.json("anna/metrics.json")
        self.assertEqual(report["session"]["trainee"], "Anna")
        self.assertEqual(report["session"]["bone_checksum"], measured["bone_checksum"])
        self.assertEqual(report["metrics"]["peak_force_n"], measured["peak_force_n"])
        self.assertAlmostEqual(report["metrics"]["removed_mm3"], measured["removed_mm3"]["total"], delta=1e-9)
        self.assertEqual(report["session"]["settings"]["coupling"], measured["settings"]["coupling"])
        self.assertEqual(measured["settings"]["scene"], "tooth")
        self.assertEqual(measured["settings"]["milling_rate_hz"], 1000.0)
        self.assertNotIn("histograms_us", measured)
        self.assertIn("milling_step", self.json("server.histograms.json"))

        second = self.serve(1, "--report", self.folder / "anna")
        self.assertIn("holds a session already (session.pcap); name another folder", second.stderr)

    def test_refuses_what_cannot_be(self):
        folder, nothing = self.folder / "a", self.folder / "nothing.pcap"
        self.serve(2, "--report", folder, "--record", self.folder / "b.pcap")
        self.serve(2, "--trainee", "two\nlines", "--report", folder)
        self.serve(2, "--trainee", b"no UTF-8 \xff", "--report", folder)
        (self.folder / "taken").write_text("a file")
        self.assertIn("taken", self.serve(1, "--report", self.folder / "taken").stderr)
        self.run_to(1, "packet_replay", nothing, "--report", folder)
        self.run_to(2, "packet_replay", nothing, "--report", folder, "--speed", "2")


if __name__ == "__main__":
    unittest.main()
