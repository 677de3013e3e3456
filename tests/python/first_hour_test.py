"""Mistakes of a first hour get one line that says what would be right."""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import threading
import unittest

from support import plunge, tooth

import osteomill as om


class FirstHourTest(unittest.TestCase):
    def test_one_line_each(self):
        with tempfile.TemporaryDirectory() as folder:
            for wrong, line in (
                (lambda: om.Case("nosuch"), "name: 'nosuch' .*built in are .*tooth"),
                (lambda: om.Case("tooth", set=["wall_frictoin=0.3"]), "set: .*did you mean 'wall_friction'"),
                (lambda: om.Case("tooth", set=["tissues.enaml.cuttable=false"]), "set: .*did you mean 'enamel'"),
                (lambda: om.Case("tooth", burr=1.0), "burr: takes the name"),
                (lambda: om.Case("tooth", burr="9 mm"), "set: .*9 mm"),
                (lambda: om.Session(tooth(), record=f"{folder}/q.h5"), "record: .*pcap"),
                (lambda: om.Env(tooth(), control_hz=0), "control_hz: takes"),
                (lambda: om.Session(tooth(), coupling="implict"), "unknown coupling"),
            ):
                with self.assertRaisesRegex(om.BadInput, line) as caught:
                    wrong()
                self.assertEqual(len(str(caught.exception).splitlines()), 1)
        self.assertTrue(issubclass(om.BadInput, ValueError) and issubclass(om.Fault, RuntimeError))
        session = om.Session(tooth())
        session.close()
        with self.assertRaisesRegex(om.Fault, "ended"):
            session.step()

    def test_a_built_in_tissue_can_be_made_stiffer(self):
        def peak_n(change):
            case = om.Case("tooth", set=["tissues.carious lesion." + change])
            session = om.Session(case)
            session.rollout(plunge(case, 2000, 4.0), pedals=True)
            return session.now.peak_force_n

        for key in ("relative_stiffness", "stiffness_factor"):
            self.assertGreater(peak_n(f"{key}=1.0"), peak_n(f"{key}=0.5"), key)

    def test_everything_says_what_it_is(self):
        session = om.Session(tooth())
        session.rollout(plunge(tooth(), 500, 2.0), pedals=True)
        self.assertIn("burr", repr(session))
        self.assertIn("mm^3 removed", repr(session))
        self.assertIn("<th>removed</th>", session._repr_html_())
        self.assertEqual(repr(session.save_state()), "<State after 500 ms>")
        self.assertIn("<Bone of ", repr(session.bone))
        for thing in (tooth(), tooth().burrs[0], session.now, om.Env(tooth())):
            self.assertNotIn(" object at 0x", repr(thing))

    def test_the_package_without_its_core_says_how_to_build_it(self):
        with tempfile.TemporaryDirectory() as folder:
            package = pathlib.Path(om.__file__).parent
            shutil.copytree(package, f"{folder}/osteomill", ignore=shutil.ignore_patterns("*.so", "studies"))
            done = subprocess.run([sys.executable, "-c", "import osteomill"], env=os.environ | {"PYTHONPATH": folder}, capture_output=True,
                                  text=True, check=False)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("--target osteomill_python", done.stderr.splitlines()[-1])

    def test_threads_read_one_recording(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "a.pcap"
            with om.Session(tooth(), record=file) as session:
                session.rollout(plunge(tooth(), 3000, 3.0), pedals=True)
                checksum = session.bone.checksum()
            recording, seen = om.Recording(file), []
            threads = [threading.Thread(target=lambda: seen.append((len(recording.time_s), recording.bone_at(9.0).checksum())))
                       for _ in range(4)]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
        self.assertEqual(len(seen), 4)
        self.assertEqual({one for _, one in seen}, {checksum})


if __name__ == "__main__":
    unittest.main()
