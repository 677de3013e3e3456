"""The server as its users start it: its output, its files, its exit status."""

import pathlib
import unittest

from support import IS_OPTIMISED, FolderTest, run

COLUMNS = "t_s,x_mm,y_mm,z_mm,axis_x,axis_y,axis_z,pedal\n"
A_BURR_WITH_A_SHANK = """name = "shank"
[bone]
phantom = "cube"
[[burrs]]
name = "5 mm"
diameter_mm = 5.0
shank = [[3.0, 2.4], [40.0, 2.4]]
[start_pose]
position_mm = [-20.0, 0.0, 4.0]
spindle_axis = [1.0, 0.0, 0.0]
[trajectory]
file = "motion.csv"
"""


class HapticServerTest(FolderTest):
    def serve(self, *words):
        """A session on the virtual clock that ends well."""
        return self.run_to(0, "haptic_server", "--clock", "virtual", *words)

    def test_mills_on_the_virtual_clock_and_writes_what_it_measured(self):
        self.serve("--duration-s", "3", "--json", self.folder / "a.json", "--log-csv", self.folder / "forces.csv")
        measured = self.json("a.json")
        self.assertEqual(measured["ticks"], 3001)
        self.assertEqual(measured["missed_deadlines"], 0)
        for key in ("p50", "p99", "p999", "max"):
            self.assertIn(key, measured["wakeup_latency_us"])
            self.assertGreater(measured["milling_step_us"][key], 0.0)
        self.assertGreater(measured["removed_mm3"]["total"], 0.0)
        self.assertIn("carious lesion", measured["removed_mm3"])
        self.assertGreater(measured["peak_force_n"], 0.0)
        self.assertEqual(len(measured["bone_checksum"]), 16)
        self.assertEqual(len((self.folder / "forces.csv").read_text().splitlines()), 1 + 3001)

    def test_says_in_one_line_why_it_measures_no_arm(self):
        profile = self.folder / "arm.toml"
        for reason, *words in (("is no arm", "--device", "client"),
                               ("which runs no session", "--json", self.folder / "a.json"),
                               ("there is no folder", "--clock", "virtual", "--save-profile", self.folder / "nowhere/arm.toml"),
                               ("is it plugged in and powered?", "--device", "hid", "--save-profile", profile)):
            said = run("haptic_server", "--measure-arm", *words)
            self.assertGreater(said.returncode, 0, words)
            self.assertIn(reason, said.stderr)
            self.assertEqual(said.stderr.count("\n"), 1, said.stderr)
            self.assertFalse(profile.exists())

    def test_feels_a_shank_and_is_repeatable(self):
        # A burr on its side cuts its way along the top of the cube, its shank over the bone that is still to come.
        (self.folder / "motion.csv").write_text(COLUMNS + "0,-20,0,4,1,0,0,0\n0.5,-20,0,2.2,1,0,0,1\n3,-10,0,2.2,1,0,0,1\n")
        (self.folder / "shank.toml").write_text(A_BURR_WITH_A_SHANK)
        for name in ("a", "b"):
            self.serve("--scene", self.folder / "shank.toml", "--duration-s", "3", "--json", self.folder / f"{name}.json",
                       "--log-csv", self.folder / f"{name}.csv")
        log, again = ((self.folder / name).read_text() for name in ("a.csv", "b.csv"))
        self.assertEqual(log, again)
        self.assertEqual(self.json("a.json")["bone_checksum"], self.json("b.json")["bone_checksum"])
        header, *lines = log.splitlines()
        self.assertIn(",fault,shank_torque_x_n_mm", header)
        self.assertFalse(all(line.endswith(",0.0000,0.0000,0.0000") for line in lines), "there is a torque")

    def test_takes_up_a_carved_bone_where_it_was_left(self):
        carved = self.folder / "carved.nrrd"
        self.serve("--scene", "tooth", "--duration-s", "3", "--save-bone", carved, "--json", self.folder / "a.json")
        (self.folder / "rest.csv").write_text(COLUMNS + "0,0,0,20,0,0,1,0\n")
        first = self.json("a.json")
        self.assertNotIn("removed_before_mm3", first)
        for _ in range(2):  # and once more, from the file that was saved over
            said = self.serve("--bone", carved, "--trajectory", self.folder / "rest.csv", "--duration-s", "0.1", "--save-bone", carved,
                              "--json", self.folder / "b.json").stderr
            self.assertIn("mm^3 were removed before; the count goes on from there", said)
            second = self.json("b.json")
            self.assertEqual(second["bone_checksum"], first["bone_checksum"])
            self.assertAlmostEqual(second["removed_mm3"]["total"], first["removed_mm3"]["total"], delta=1e-6)
            self.assertEqual(second["removed_before_mm3"], second["removed_mm3"])

    @unittest.skipUnless(IS_OPTIMISED, "half a minute of drilling takes its time unless optimised")
    def test_drills_the_caries_out_of_the_jaw_and_leaves_the_pulp_closed(self):
        self.serve("--case", "jaw", "--duration-s", "40", "--json", self.folder / "a.json", "--report", self.folder / "report")
        removed_mm3 = self.json("a.json")["removed_mm3"]
        for kept in ("pulp", "nerve canal", "gum"):
            self.assertEqual(removed_mm3[kept], 0.0, kept)
        metrics = self.json("report/metrics.json")["metrics"]
        self.assertGreater(metrics["plan_removed_share"], 0.8)
        self.assertLess(metrics["plan_excess_mm3"], 0.5, "sound tissue beyond the margin of 0.5 mm")

    @unittest.skipUnless(IS_OPTIMISED, "the head takes its time unless optimised")
    def test_mills_a_head_in_memory_that_follows_its_bone(self):
        session = ("--scene", "head", "--duration-s", "4", "--json")
        self.serve(*session, self.folder / "alone.json")
        alone = self.json("alone.json")
        self.assertAlmostEqual(alone["bone"]["bone_mm3"], 0.02 * 204.8**3, delta=5000.0)
        self.assertLess(alone["bone"]["peak_resident_bytes"], 1.3 * alone["bone"]["memory_bytes"], "nothing is copied while it is built")
        self.assertGreater(alone["removed_mm3"]["total"], 0.1)

        self.serve(*session, self.folder / "shown.json", "--listen", "127.0.0.1:0")
        shown = self.json("shown.json")
        self.assertLess(shown["bone"]["peak_resident_bytes"], 1024**3, "with the copy for clients")
        self.assertEqual(shown["bone_checksum"], alone["bone_checksum"])

    def test_ends_with_the_trajectory(self):
        (self.folder / "short.csv").write_text(COLUMNS + "0,0,0,20,0,0,1,0\n0.4,1,0,20,0,0,1,0\n")
        self.serve("--trajectory", self.folder / "short.csv", "--json", self.folder / "a.json")
        self.assertAlmostEqual(self.json("a.json")["duration_s"], 0.4, delta=0.1)

    def test_returns_two_for_wrong_usage_and_one_for_a_failure_with_one_line(self):
        for status, reason, *words in ((2, "", "--coupling", "magic"),
                                       (1, "/nowhere/scene.toml", "--scene", "/nowhere/scene.toml"),
                                       (1, "", "--clock", "virtual", "--duration-s", "1", "--json", "/nowhere/a.json")):
            self.assertTrue(self.expect_line(status, reason, "haptic_server", *words).startswith("haptic_server: "))
        (self.folder / "endless.csv").write_text(COLUMNS + "0,0,0,20,0,0,1,0\n")
        self.assertIn("--duration-s", self.run_to(1, "haptic_server", "--clock", "virtual", "--trajectory", self.folder / "endless.csv").stderr)

    @unittest.skipUnless(pathlib.Path("/dev/full").exists(), "there is no /dev/full here")
    def test_reports_a_full_disk_in_one_line_and_still_writes_the_rest(self):
        said = self.run_to(1, "haptic_server", "--clock", "virtual", "--duration-s", "1", "--log-csv", "/dev/full",
                           "--json", self.folder / "a.json").stderr
        self.assertIn("haptic_server: /dev/full: ", said)
        self.assertEqual(self.json("a.json")["ticks"], 1001)


if __name__ == "__main__":
    unittest.main()
