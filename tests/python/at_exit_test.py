"""The interpreter's end, its signals and its forks, while C++ is at work."""

import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import unittest

import numpy as np
from support import plunge, tooth

import osteomill as om

AT_EXIT = """
import threading, time, numpy as np
import osteomill as om
case = om.Case("tooth")
recorded = om.Session(case, record="s.pcap"); recorded.step(ms=200)
hands = case.start_mm - np.linspace(0, 3, 60000)[:, None] * case.start_axis
begun = threading.Event()
def work():
    session = om.Session(case); begun.set(); session.rollout(hands, pedals=True)
threading.Thread(target=work, daemon=True).start()
begun.wait()
"""


class AtExitTest(unittest.TestCase):
    def test_a_daemon_thread_at_work_does_not_abort_the_end(self):
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([sys.executable, "-c", AT_EXIT], cwd=folder, capture_output=True, text=True, check=False, timeout=300)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertEqual(os.listdir(folder), ["s.pcap"])
            self.assertTrue(om.Recording(pathlib.Path(folder) / "s.pcap").info()["ends_with_goodbye"])

    def test_ctrl_c_in_load_state_leaves_the_session_as_it_was(self):
        first = om.Session(tooth())
        hands = tooth().start_mm - np.minimum(np.arange(60000) / 500.0, 3.0)[:, None] * tooth().start_axis
        hands[:, 0] += 2 * np.sin(np.arange(60000) / 300.0)
        first.rollout(hands, pedals=True)
        second = om.Session(tooth())
        second.rollout(plunge(tooth(), 500, 2.0), pedals=True)
        before = second.bone.checksum()
        threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT)).start()
        with self.assertRaises(KeyboardInterrupt):
            second.load_state(first.save_state())
        self.assertEqual(second.bone.checksum(), before)
        self.assertEqual(second.save_state().ticks, 500)
        second.step(pedal=True, ms=10)

    def test_drawing_in_a_forked_child_is_refused(self):
        next(om.render(tooth()))
        read, write = os.pipe()
        child = os.fork()
        if child == 0:
            try:
                next(om.render(tooth()))
                line = "it drew"
            except om.Fault as error:
                line = str(error)
            os.write(write, line.encode())
            os._exit(0)
        os.close(write)
        with os.fdopen(read) as pipe:
            self.assertIn("spawn", pipe.read())
        self.assertEqual(os.waitpid(child, 0)[1], 0)


if __name__ == "__main__":
    unittest.main()
