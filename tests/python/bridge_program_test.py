"""haptic_server and an arm in a process of its own, and failures of either."""

import re
import signal
import time
import unittest

from running import Running, removed_mm3
from support import FolderTest, eventually

DEVICE_LOST = "the haptic device does not answer: force off"


class BridgeTest(FolderTest):
    def setUp(self):
        super().setUp()
        self.socket = f"unix:{self.folder}/arm"

    def server(self, seconds="600", *words):
        """Waits for an arm."""
        server = Running("haptic_server", "--device", "bridge", "--scene", "cube", "--listen", "none", "--duration-s", seconds,
                         "--json", self.folder / "run.json", "--log-csv", self.folder / "force.csv", "--bridge", self.socket, *words)
        self.addCleanup(server.__exit__)
        self.assertIsNotNone(server.line_after("waiting for an arm at unix:"), server.err)
        return server

    def arm(self, seconds="600", key=""):
        arm = Running("simulated_arm", self.socket, key, seconds)
        self.addCleanup(arm.__exit__)
        return arm

    def removed_mm3(self):
        return removed_mm3(self.folder / "force.part.csv")

    def expect_removed(self, server, more_than_mm3):
        self.assertTrue(eventually(lambda: self.removed_mm3() > more_than_mm3), server.err)

    def end(self, running):
        self.assertEqual(running.end(signal.SIGINT), 0, running.err)

    def told(self, arm, what):
        """The number of newtons behind these words in an arm's last output."""
        self.assertRegex(arm.out, rf"{what} [0-9.]+ N")
        return float(re.search(rf"{what} ([0-9.]+) N", arm.out)[1])

    def expect_no_jump(self, arm):
        """The largest change between two exchanges that osteomill_bridge.h allows, however busy the machine is."""
        self.assertLessEqual(self.told(arm, "largest jump"), 2.0, "1000 N/s, of a loop that is two ticks late at most")
        self.assertLessEqual(self.told(arm, "while it goes"), 0.28, "3.3 N in 12 ms")

    def test_an_arm_mills_and_feels(self):
        server, arm = self.server(), self.arm()
        self.assertIsNotNone(server.line_after("arm simulated arm has joined: 3.3 N, 50 g; "))
        self.expect_removed(server, 1.0)
        self.end(server)
        self.end(arm)
        self.assertGreater(self.told(arm, "largest force"), 0.2)
        self.expect_no_jump(arm)
        self.assertGreater(self.json("run.json")["removed_mm3"]["total"], 1.0)
        self.assertEqual(self.json("run.json")["settings"]["device"], "bridge")

    def test_an_arm_that_is_killed_turns_all_off_and_its_successor_goes_on(self):
        server, killed = self.server(), self.arm()
        self.assertIsNotNone(server.line_after("arm simulated arm has joined"))
        self.expect_removed(server, 0.1)
        killed.end(signal.SIGKILL)
        self.assertTrue(server.has_logged(DEVICE_LOST), server.err)
        before_mm3 = self.removed_mm3()
        arm = self.arm()
        self.expect_removed(server, before_mm3 + 0.5)
        self.end(arm)
        self.assertTrue(server.has_logged(DEVICE_LOST, 2), server.err)
        self.end(server)
        self.expect_no_jump(arm)
        self.assertGreater(self.told(arm, "largest force"), 0.05, "it feels again")
        self.assertEqual(server.err.count(DEVICE_LOST), self.json("run.json")["faults"]["device_lost"], "each is logged once")

    def test_a_server_that_stands_still_takes_the_force_away_without_a_jump(self):
        server, arm = self.server(), self.arm()
        self.assertIsNotNone(server.line_after("arm simulated arm has joined"))
        self.expect_removed(server, 0.1)
        before_mm3 = self.removed_mm3()
        server.process.send_signal(signal.SIGSTOP)
        time.sleep(1.0)  # longer than an arm holds a force that nobody renews
        server.process.send_signal(signal.SIGCONT)
        self.expect_removed(server, before_mm3 + 0.1)
        self.end(arm)
        self.end(server)
        self.expect_no_jump(arm)

    def test_with_another_key_nobody_joins(self):
        for name, letter in (("key", "k"), ("other", "o")):
            (self.folder / name).write_text(40 * letter)
            (self.folder / name).chmod(0o400)
        server = self.server("2", "--bridge-key", self.folder / "key")
        self.run_to(1, "simulated_arm", self.socket, self.folder / "other", "1")
        self.assertIsNotNone(server.line_after("no arm is heard; what comes has another key, version or session"))
        member = self.arm(key=self.folder / "key")
        self.assertEqual(server.wait(), 0, server.err)
        self.end(member)

    def test_stops_on_a_signal_while_it_waits(self):
        self.end(self.server("2"))
        self.assertFalse((self.folder / "arm").exists())

    def test_says_in_one_line_what_is_wrong(self):
        key = self.folder / "open"
        key.write_text(40 * "k")
        key.chmod(0o644)
        for status, reason, *words in ((2, "needs --bridge-key", "--device", "bridge", "--bridge", "udp:0.0.0.0:7020"),
                                       (2, "--bridge: 'here' is no address", "--device", "bridge", "--bridge", "here"),
                                       (2, "--bridge: goes with --device bridge", "--bridge", "unix:/tmp/a"),
                                       (2, "--clock", "--device", "bridge", "--clock", "virtual"),
                                       (1, "/nowhere: cannot be read", "--device", "bridge", "--bridge-key", "/nowhere"),
                                       (1, "open: is a key of the bridge that others may read", "--device", "bridge", "--bridge-key", key),
                                       (1, "no socket can be made", "--device", "bridge", "--bridge", "unix:/nowhere/arm")):
            self.expect_line(status, reason, "haptic_server", "--listen", "none", *words)


if __name__ == "__main__":
    unittest.main()
