"""The files that a session leaves are old or new, never half of either, and no two of them are one."""

import os
import shutil
import signal
import unittest

from images import nrrd_header, write_block
from running import Running
from support import FolderTest, disk_of, eventually, run

VIRTUAL = ("--clock", "virtual", "--duration-s")


class OutputFilesTest(FolderTest):
    def setUp(self):
        super().setUp()
        write_block(self.file("block.nrrd"))

    def file(self, name):
        return self.folder / name

    def put(self, *names, text="old"):
        for name in names:
            self.file(name).write_text(text)

    def server(self, *words):
        return "haptic_server", "--bone", self.file("block.nrrd"), *words

    def listening(self, *words):
        """A session that has begun."""
        session = Running(*self.server("--listen", "127.0.0.1:0", *words))
        self.addCleanup(session.__exit__)
        self.assertIsNotNone(session.address(), session.err)
        return session

    def expect_old(self, *names):
        for name in names:
            self.assertEqual(self.file(name).read_text(), "old", name)

    def expect_refused(self, one, other, *command):
        """In one line that names the two options."""
        self.assertIn(other, self.expect_line(2, one, *command))

    def expect_readable(self, recording):
        self.run_to(0, "packet_replay", self.file(recording), "--info")

    def test_of_a_killed_session_leave_the_old_ones_as_they_were(self):
        names = ("a.json", "force.csv", "milling.csv", "a.pcap")
        self.put(*names)
        log, part, torn = (self.file(f"force{of}.csv") for of in ("", ".part", ".torn-1"))
        words = ("--json", self.file("a.json"), "--log-csv", log, "--record", self.file("a.pcap"))
        with Running(*self.server("--listen", "none", "--log-milling-csv", self.file("milling.csv"), *words)) as session:
            self.assertTrue(eventually(lambda: part.exists() and part.stat().st_size > 10_000))
            self.assertEqual(session.end(signal.SIGKILL), -signal.SIGKILL)
        self.expect_old(*names)
        self.expect_readable("a.part.pcap")
        torn_bytes = part.stat().st_size

        said = self.run_to(0, *self.server(*VIRTUAL, "0.2", *words)).stderr
        self.assertIn("force.torn-1.csv", said)
        self.assertIn("a.torn-1.pcap", said)
        self.assertEqual(torn.stat().st_size, torn_bytes)
        self.expect_readable("a.torn-1.pcap")
        self.assertEqual(len(log.read_text().splitlines()), 1 + 201)
        self.expect_readable("a.pcap")
        self.assertFalse(part.exists())

    def test_on_a_full_disk_leave_the_old_ones_as_they_were(self):
        self.put("a.json", "force.csv")
        said = self.run_to(1, *self.server(*VIRTUAL, "1", "--json", self.file("a.json"), "--log-csv", self.file("force.csv")),
                           preexec_fn=disk_of(1)).stderr
        self.assertIn("force.csv: the log is not complete: File too large", said)
        self.assertIn("force.part.csv\n", said)
        self.expect_old("a.json", "force.csv")
        self.assertEqual(self.file("force.part.csv").stat().st_size, 1024)

        self.run_to(0, *self.server(*VIRTUAL, "1", "--record", self.file("a.pcap")))
        self.put("b.json", "b.csv")
        for option, name in (("--json", "b.json"), ("--csv", "b.csv")):
            self.run_to(1, "packet_replay", self.file("a.pcap"), option, self.file(name), preexec_fn=disk_of(1))
        self.expect_old("b.json", "b.csv")
        self.assertFalse(self.file("b.part.csv").exists())

    def test_that_cannot_be_written_are_refused_at_the_start(self):
        self.file("folder.nrrd").mkdir()
        for option in ("--json", "--save-bone"):
            for place in (self.file("folder.nrrd"), self.file(250 * "n" + ".nrrd"), "/proc/x.nrrd"):
                said = self.run_to(1, *self.server(*VIRTUAL, "1000000", option, place)).stderr
                self.assertIn(str(place), said, "and no session is run")
        self.assertEqual(list(self.file("folder.nrrd").iterdir()), [])

    def test_are_refused_at_the_start_where_two_are_one(self):
        self.put("a.csv")
        self.file("link.csv").symlink_to("a.csv")
        os.link(self.file("a.csv"), self.file("hard.csv"))
        for one, same, other, file in (("--json", "a.csv", "--log-csv", "a.csv"), ("--json", "./a.csv", "--log-csv", "a.csv"),
                                       ("--json", "link.csv", "--log-csv", "a.csv"), ("--json", "hard.csv", "--log-csv", "a.csv"),
                                       ("--record", "new", "--log-milling-csv", "new"), ("--json", "new.nrrd", "--save-bone", "new.nrrd")):
            self.expect_refused(one, other, *self.server("--duration-s", "0.2", one, f"{self.folder}/{same}", other, self.file(file)))
        self.expect_old("a.csv")
        self.run_to(0, *self.server(*VIRTUAL, "0.1", "--json", "/dev/null", "--log-csv", "/dev/null"))

    def test_are_refused_where_they_would_destroy_what_is_read(self):
        motion, bone, recording, other = (self.file(name) for name in ("motion.csv", "block.nrrd", "a.pcap", "b"))
        motion.write_text("t_s,x_mm,y_mm,z_mm,axis_x,axis_y,axis_z,pedal\n0,0,0,6,0,0,1,0\n0.2,0,0,6,0,0,1,0\n")
        self.expect_refused("--trajectory", "--log-csv", *self.server("--duration-s", "0.2", "--trajectory", motion, "--log-csv", motion))
        self.expect_refused("--bone", "--json", *self.server("--duration-s", "0.2", "--json", bone))
        self.run_to(0, *self.server(*VIRTUAL, "0.1", "--record", recording))
        self.expect_refused("FILE", "--csv", "packet_replay", recording, "--csv", recording)
        self.expect_refused("--json", "--csv", "packet_replay", recording, "--json", other, "--csv", other)
        self.expect_refused("--replay", "--json", "render_client", "--offscreen", "--replay", recording, "--json", recording)
        self.expect_readable("a.pcap")

        # A bone is taken up and saved under its own name every day.
        self.run_to(0, *self.server("--trajectory", motion, "--clock", "virtual", "--save-bone", bone))
        self.run_to(0, *self.server("--trajectory", motion, "--clock", "virtual"))

    def test_are_refused_where_they_would_destroy_a_key_or_a_certificate(self):
        self.put("own.pem", "key.pem", "ca.pem", "crl.pem", "a.pcap")
        files = {"--tls-cert": "own.pem", "--tls-key": "key.pem", "--tls-ca": "ca.pem", "--tls-crl": "crl.pem"}
        tls = [word for option, name in files.items() for word in (option, self.file(name))]
        for option, name in files.items():
            for output, *command in (("--json", *self.server()), ("--log-csv", *self.server("--listen", "none")),
                                     ("--csv", "packet_replay", self.file("a.pcap")), ("--record", "render_client", "--offscreen")):
                self.expect_refused(option, output, *command, *tls, output, self.file(name))
        self.expect_old("key.pem")

    def test_of_an_import_are_never_the_scan(self):
        scan, link, hard, stack, case = (self.file(name) for name in ("block.nrrd", "link", "hard.nrrd", "stack", "case"))
        before = scan.read_bytes()
        link.symlink_to(".")
        os.link(scan, hard)
        for same in (scan, link / "block.nrrd", hard):
            self.expect_refused("INPUT", "OUTPUT", "bone_import", scan, same, "--spacing-mm", "1")
            self.expect_refused("INPUT", "--preview", "bone_import", scan, "--preview", same)
        stack.mkdir()
        shutil.copy(scan, stack / "1.nrrd")
        for output in (stack / "1.nrrd", stack / "new.nrrd", link / "stack/new.nrrd"):
            self.expect_refused("INPUT", "OUTPUT", "bone_import", stack, output)
        self.expect_refused("INPUT", "--case", "bone_import", stack, "--case", stack)
        case.mkdir()
        shutil.copy(scan, case / "bone.nrrd")
        self.expect_refused("INPUT", "--case", "bone_import", case / "bone.nrrd", "--case", case)
        # The voxels of a header that names their file are read, too.
        self.file("scan.nhdr").write_bytes(nrrd_header((4, 4, 4), more="data file: voxels.raw\n"))
        self.put("voxels.raw", text=128 * "x")
        self.expect_refused("INPUT", "--preview", "bone_import", self.file("scan.nhdr"), "--preview", self.file("voxels.raw"))
        self.file("dangling.nrrd").symlink_to("nowhere.nrrd")
        self.expect_refused("dangling.nrrd", "nowhere.nrrd", "bone_import", scan, self.file("dangling.nrrd"))
        self.assertEqual(scan.read_bytes(), before)
        self.assertEqual(self.file("voxels.raw").read_text(), 128 * "x")
        self.assertTrue(self.file("dangling.nrrd").is_symlink())

    def test_of_a_session_are_none_that_its_case_or_scene_is_made_of(self):
        case = self.file("case")
        case.mkdir()
        bone, scan, scene = (case / name for name in ("bone.nrrd", "scan.nrrd", "case.toml"))
        for file in (bone, scan):
            shutil.copy(self.file("block.nrrd"), file)
        before = scan.read_bytes()
        session = ("haptic_server", *VIRTUAL, "0.01")
        scene.write_text('name = "x"\n[bone]\nfile = "bone.nrrd"\n')
        for option in ("--record", "--save-bone", "--json", "--log-csv"):
            self.expect_refused("--case", option, *session, option, bone, "--case", case)
            of_scene = run(*session, option, bone, "--scene", scene)
            self.assertNotEqual(of_scene.returncode, 0, option)
            self.assertIn("are the same file", of_scene.stderr, option)
        scene.write_text('name = "x"\n[bone]\nfile = "scan.nrrd"\n')
        self.assertIn("are the same file", self.run_to(1, *session, "--record", scan, "--case", case).stderr)
        self.expect_refused("--case", "--record", *session, "--record", case / "placement.toml", "--case", case)
        for file in (bone, scan):
            self.assertEqual(file.read_bytes(), before)

    def test_that_a_link_to_nothing_names_are_refused(self):
        dangling = self.file("dangling.nrrd")
        dangling.symlink_to("nowhere.nrrd")
        for option in ("--save-bone", "--json", "--record"):
            self.expect_refused(option, "nowhere.nrrd", *self.server("--duration-s", "0.2", option, dangling))
        self.assertTrue(dangling.is_symlink())
        self.assertFalse(self.file("nowhere.nrrd").exists())

    def test_of_pictures_are_none_that_is_replayed(self):
        shots = self.file("shots")
        shots.mkdir()
        self.put("shots/final.png", "shots/dataset.json", text="a recording")
        self.expect_refused("--replay", "--screenshots", "render_client", "--offscreen", "--replay", shots / "final.png", "--screenshots", shots)
        self.expect_refused("--replay", "--dataset", "render_client", "--replay", shots / "dataset.json", "--dataset", shots)

    def test_are_one_sessions_from_its_start(self):
        outputs = ("--save-bone", self.file("a.nrrd")), ("--json", self.file("a.json"))
        first = self.listening(*outputs[0], *outputs[1])
        for option, file in outputs:
            said = self.run_to(1, *self.server(*VIRTUAL, "0.1", option, file)).stderr
            self.assertIn(str(file), said)
            self.assertIn("another session will write it", said)
        self.assertEqual(first.end(signal.SIGKILL), -signal.SIGKILL)
        self.run_to(0, *self.server(*VIRTUAL, "0.1", *outputs[0]))
        self.assertFalse(self.file(".a.nrrd.lock").exists())

    def test_whose_folder_is_removed_are_elsewhere_and_that_is_said_at_once(self):
        lab = self.file("lab")
        for place, lose in ((self.file("lab.rescued/a.nrrd"), lambda: shutil.rmtree(lab)),
                            (self.file("moved/a.nrrd"), lambda: lab.rename(self.file("moved")))):
            lab.mkdir()
            session = self.listening("--save-bone", lab / "a.nrrd")
            lose()
            self.assertTrue(session.has_logged(f"it will be {place}"), session.err)
            self.assertEqual(session.end(), 0, session.err)
            self.assertTrue(place.exists())
            self.run_to(0, "bone_export", place, self.file("a.stl"))

    def test_are_all_named_where_several_cannot_be_written(self):
        names = bone, numbers, recording = tuple(self.file(name) for name in ("a.nrrd", "a.json", "a.pcap"))
        session = self.listening("--save-bone", bone, "--json", numbers, "--record", recording)
        for name in names:
            name.mkdir()
        self.assertEqual(session.end(), 1)
        for words in (f"{bone}: ", f"{numbers}: ", f"lies in {self.file('a.part.pcap')}, which packet_replay reads"):
            self.assertIn(words, session.err)
        self.expect_readable("a.part.pcap")

    def test_whose_source_is_written_over_are_saved_and_that_is_said_at_once(self):
        carved, saved = self.file("carved.nrrd"), self.file("a.nrrd")
        self.run_to(0, *self.server(*VIRTUAL, "0.1", "--save-bone", carved))
        with Running("haptic_server", "--bone", carved, "--listen", "127.0.0.1:0", "--save-bone", saved) as session:
            self.assertIsNotNone(session.address(), session.err)
            os.truncate(carved, 1000)
            self.assertTrue(session.has_logged("carved.nrrd: was written to since it was loaded"), session.err)
            self.assertEqual(session.end(), 1)
            self.assertIn("is saved with CT numbers that only say where bone is left", session.err)
        self.run_to(0, "bone_export", saved, self.file("a.stl"))


if __name__ == "__main__":
    unittest.main()
