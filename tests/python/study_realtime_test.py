"""The studies `realtime` and `bridge`: latencies and their evaluation; no time is asserted."""

import json
import os
import pathlib
import tempfile
import unittest

from study_files import run_of

from osteomill import _studies
from osteomill.studies import bridge, installed_programs, latencies, realtime
from osteomill.studies.latencies import Latencies


class LatenciesTest(unittest.TestCase):
    def test_read_those_of_the_server_and_gather_them(self):
        found = latencies.of_server([[1.5, 990], [40.0, 9], [1200.0, 1]])
        self.assertEqual([found.quantile_us(share) for share in (0.5, 0.999, 1.0)], [1.5, 40.0, 1200.0])
        self.assertEqual((found.count(), found.over(1000.0)), (1000, 1))
        found.add([(1.5, 5), (1000.0, 2)])
        self.assertEqual((found.count(), found.over(1000.0), found.max_us()), (1007, 1, 1200.0), "1000 us are not over")

    def test_read_those_of_cyclictest_and_the_ones_beyond_its_histogram(self):
        found = latencies.of_cyclictest(
            {"thread": {"0": {"histogram": {"12": 900, "999": 90, "1000": 7}, "cycles": 1000, "max": 31000}}})
        self.assertEqual(found.quantile_us(0.9), 13.0, "12 is up to 13")
        self.assertEqual((found.count(), found.over(1000.0), found.max_us()), (1000, 10, 31001.0))

    def test_are_nothing_where_there_are_none(self):
        self.assertEqual((Latencies().quantile_us(0.999), Latencies().bins()), (0.0, []))

    def test_come_as_bins_whose_shares_add_up(self):
        bins = Latencies([(0.1, 10), (13.0, 980), (250.0, 10)]).bins()
        self.assertAlmostEqual(sum(one["share"] for one in bins), 1.0)
        self.assertEqual(bins[-1]["share_above"], 0.0)
        self.assertAlmostEqual(next(one["share"] for one in bins if one["from_us"] < 13.0 <= one["up_to_us"]), 0.98)
        for one, following in zip(bins, bins[1:]):
            self.assertEqual(one["up_to_us"], following["from_us"])
            self.assertAlmostEqual(following["share_above"], one["share_above"] - following["share"])


class RealtimeTest(unittest.TestCase):
    def gathered(self, **changes):
        one = {"wakeup_latency": [[10.0, 990], [1500.0, 10]], "haptic_tick": [[5.0, 1000]], "milling_step": [[20.0, 1000]],
               "ticks": 1000, "late_ticks": 10, "missed_deadlines": 1, "missed_milling_steps": 0, "page_faults": 0, "overrun_faults": 0,
               "client_frames": 60, "removed_mm3": 1.5, "real_time_priority": True, "memory_locked": True, "cyclictest": []}
        return realtime.gather("no load", [one, one | changes])

    def test_sums_slices_up(self):
        gathered = self.gathered(real_time_priority=False)
        summary = realtime.summary_of(gathered)
        self.assertEqual((summary["ticks"], summary["removed_mm3"], summary["real_time_priority"]), (2000, 3.0, False))
        self.assertEqual(summary["wakeup_latency_us"]["over_1_ms"], 20)
        self.assertIsNone(summary["cyclictest_us"])
        self.assertEqual(len(realtime.lines_of(gathered)), 2)
        self.assertTrue(json.dumps(summary))

    def test_compares_with_cyclictest(self):
        gathered = self.gathered(cyclictest=[[5.0, 1990], [1001.0, 10]])
        self.assertAlmostEqual(realtime.allowed_late_ticks(gathered), 2000 * (10 / 2000 + 1e-5))
        self.assertAlmostEqual(realtime.summary_of(gathered)["p999_times_cyclictest"], 1500.0 / 1001.0)
        self.assertIn("late ticks 20 (bar: 10.0)", realtime.lines_of(gathered)[-1])

    def test_finds_where_the_server_listens_once_the_line_is_there(self):
        self.assertIsNone(realtime.port_said_in("tooth\nlistening on 127.0.0.1:70"))
        self.assertEqual(realtime.port_said_in("tooth\nlistening on 127.0.0.1:7010\nready\n"), 7010)

    def test_serves_a_slice_with_two_clients(self):
        with tempfile.TemporaryDirectory() as folder:
            measured = realtime.serve(1.0, pathlib.Path(folder))
        self.assertGreater(measured["client_frames"], 0)
        self.assertGreater(Latencies(measured["wakeup_latency"]).count(), 0)


class BridgeTest(unittest.TestCase):
    def test_measures_every_way_that_can_be_had(self):
        with run_of("bridge", bridge, "--seconds", "1", jobs=1) as (out, said):
            found = json.loads((out / "bridge.json").read_text())
        ways = [way for way, its in bridge.WAYS.items() if its["over"] != "namespaces" or not _studies.why_no_namespaces()]
        self.assertEqual(list(found), ways)
        for way in ways:
            self.assertGreater(found[way]["bridge"]["count"], 0)
            self.assertIn(f"\n{way}", said)


class InstalledProgramsTest(unittest.TestCase):
    def test_a_child_says_what_it_has_to_and_ends_with_the_block(self):
        with installed_programs.ChildProgram(["/bin/sh", "-c", "echo one; echo two >&2; sleep 600"]) as child:
            child.wait(60.0, lambda: "two" in child.output())
            self.assertEqual(child.output(), "one\ntwo\n")
            process = child._process.pid
        with self.assertRaises(ProcessLookupError):
            os.kill(process, 0)

    def test_a_child_that_fails_is_told_in_one_line(self):
        with installed_programs.ChildProgram(["/bin/sh", "-c", "echo why; exit 3"]) as child:
            child.wait(60.0)
            with self.assertRaisesRegex(RuntimeError, "^sh failed: why$"):
                child.require_success()
        with self.assertRaisesRegex(RuntimeError, "^/nowhere: cannot be run: No such file"):
            installed_programs.ChildProgram(["/nowhere"])

    def test_names_a_program_that_is_not_there(self):
        self.assertTrue(installed_programs.own_program("haptic_server").is_file())
        with self.assertRaisesRegex(RuntimeError, "no_such_program: is not there; build it, too"):
            installed_programs.own_program("no_such_program")


if __name__ == "__main__":
    unittest.main()
