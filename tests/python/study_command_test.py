"""The program osteomill_study: its errors for a wrong command line, and the options that every study has."""

import contextlib
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import unittest

from support import NO_STUDY, FolderTest, eventually, run_study

from osteomill.studies import kept_command, manifest, options
from osteomill.studies.program import STUDIES


def a_study():
    """Options as a study has them."""
    parser = options.Parser(prog="osteomill_study made")
    parser.add_argument("data", nargs="+", metavar="DATA")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--rate-hz", type=options.number_above_zero, default=100.0)
    parser.add_argument("--names", type=options.listed(options.one_of("a", "b")))
    options.add_common(parser, "made", 1)
    return parser


A_SLOW_STUDY = """
import pathlib, sys, time, types
from osteomill.studies import program

def slow(case):
    pathlib.Path(case).touch()
    time.sleep(600)

made = types.ModuleType("osteomill.studies.made")
made.add_options = lambda parser: parser.add_argument("files", nargs="+")
made.run = lambda options, study: study.sweep(slow, options.files)
sys.modules[made.__name__] = made
program.STUDIES = (("made", "made", "a slow one"),)
sys.exit(program.main(sys.argv[1:]))
"""


class InterruptedTest(FolderTest):
    def started(self):
        """A study of two processes, both at work, with a session of its own."""
        (self.folder / "slow.py").write_text(A_SLOW_STUDY)
        files = [self.folder / name for name in ("a", "b", "c")]
        for file in files:
            file.unlink(missing_ok=True)
        study = subprocess.Popen([sys.executable, self.folder / "slow.py", "made", *files, "--jobs", "2", "--out", self.folder / "out"],
                                 stderr=subprocess.PIPE, text=True, start_new_session=True)
        self.assertTrue(eventually(lambda: sum(file.exists() for file in files) == 2))
        return study

    def has_ended(self, group):
        """In a container nobody may reap what has ended (state Z)."""
        for stat in pathlib.Path("/proc").glob("[0-9]*/stat"):
            with contextlib.suppress(OSError):  # it has gone
                state, _, of_group = stat.read_text().rpartition(")")[2].split()[:3]
                if int(of_group) == group and state not in "ZX":
                    return False
        return True

    def test_ends_in_a_line_and_leaves_no_process(self):
        for kill in (os.kill, os.killpg):  # by somebody else, and by Ctrl-C
            study = self.started()
            kill(study.pid, signal.SIGINT)
            error = study.communicate(timeout=120)[1]
            self.assertEqual(study.returncode, 130, error)
            self.assertEqual(error.splitlines()[-1], "osteomill_study: interrupted; the same command goes on with the cases that are done")
            self.assertNotIn("Traceback", error)
            self.assertTrue(eventually(lambda: self.has_ended(study.pid)))

    def test_its_processes_end_with_it(self):
        study = self.started()
        study.kill()
        study.communicate(timeout=120)
        self.assertTrue(eventually(lambda: self.has_ended(study.pid)))


class StudyCommandTest(unittest.TestCase):
    def refusal(self, *words):
        with self.assertRaises(options.UsageError) as refused:
            a_study().parse(words)
        self.assertNotIn("\n", str(refused.exception))
        return str(refused.exception)

    def test_says_in_one_line_what_is_wrong(self):
        for words, code, reason in (
            ([], 2, "a study to run: " + ", ".join(name for name, _, _ in STUDIES[:-1])),
            (["farce"], 2, "farce"),
            (["--fast"], 2, "--fast"),
            ([b"f\xe4rce"], 2, "is no UTF-8"),
            (["fa\nrce"], 2, "holds a control character"),
        ):
            outcome = run_study(*words)
            self.assertEqual(outcome.returncode, code, words)
            self.assertTrue(outcome.stderr.startswith("osteomill_study: ") and outcome.stderr.endswith(" (see --help)\n"))
            self.assertEqual(outcome.stderr.count("\n"), 1)
            self.assertIn(reason, outcome.stderr)

    def test_has_help_and_a_version(self):
        help_text = run_study("--help")
        self.assertEqual(help_text.returncode, 0, help_text.stderr)
        for name, _, what in STUDIES:
            self.assertRegex(help_text.stdout, f"(?m)^  {name} +{what[:40]}")
        self.assertRegex(run_study("--version").stdout, r"^\d+\.\d+\.\d+\n$")

    def test_starts_in_any_locale_and_folder(self):
        with tempfile.TemporaryDirectory() as folder:
            for module in ("json.py", "argparse.py", "osteomill.py"):
                pathlib.Path(folder, module).write_text("raise SystemExit('the wrong one')")
            outcome = run_study("--version", cwd=folder, env=os.environ | {"LC_ALL": "C", "PYTHONIOENCODING": "latin-1", "PYTHONPATH": ""})
        self.assertEqual(outcome.returncode, 0, outcome.stderr)

    def test_options_are_checked_where_they_are_read(self):
        self.assertEqual(self.refusal("--quick"), "DATA is required")
        self.assertEqual(self.refusal("a", "--rate-hz", "0"), "--rate-hz: 0 is not above 0")
        self.assertEqual(self.refusal("a", "--rate-hz", "nan"), "--rate-hz: 'nan' is no number")
        self.assertEqual(self.refusal("a", "--rate-hz="), "--rate-hz: is given without a value")
        self.assertEqual(self.refusal("a", "--names", "a,c"), "--names: 'c' is not one of a, b")
        self.assertEqual(self.refusal("a", "--jobs", "0"), "--jobs: Value 0 not in range 1 to 1024")
        self.assertIn("no part I/N", self.refusal("a", "--shard", "3/2"))
        self.assertIn("--qui", self.refusal("a", "--qui"))
        read = a_study().parse(["a", "--names", "b,a", "c"])
        self.assertEqual((read.data, read.names, read.rate_hz, read.jobs), (["a", "c"], ["b", "a"], 100.0, 1))

    def test_keeps_the_words_that_say_what_is_run(self):
        words = ["made", "--quick", "--out", "x", "a", "--jobs=3", "--shard", "1/2", "--rate-hz", "5"]
        self.assertEqual(kept_command.words_of_study(words), ["made", "--quick", "a", "--rate-hz", "5"])
        for kept in ([], "made", ["made", 1], ["other", "a"], ["made", "a", "--out=x"], ["made", "a", "-h"], ["made", "a", "--"],
                     ["made", "a", "--help"], ["made", "--quick"], ["made", "a", "--merge", "x"], ["made", "a", "--database", "x"],
                     ["made", "a", "--no\x1b[2J"]):
            with self.assertRaises(RuntimeError, msg=kept) as refused:
                kept_command.require_study_words(kept, "made", a_study(), pathlib.Path("file"))
            self.assertIn(NO_STUDY, str(refused.exception))
            self.assertNotIn("\x1b", str(refused.exception))
        good = ["made", "a", "--rate-hz", "5"]
        self.assertEqual(kept_command.require_study_words(good, "made", a_study(), pathlib.Path("file")), good)

    def test_a_manifest_says_every_setting(self):
        parser = a_study()
        said = manifest.manifest_of(["made", "a"], parser, parser.parse(["a", "b", "--out", "x"]))
        self.assertEqual(said["settings"], {"DATA": "a,b", "--quick": "", "--rate-hz": "100", "--names": "", "--jobs": "1"})
        self.assertEqual(said["command"], ["made", "a"])
        self.assertEqual(sorted(said["machine"]), ["compiler", "processor", "processors", "system"])
        self.assertEqual(manifest.setting_text("postgresql://me:secret@here/x"), "postgresql://me:***@here/x")


if __name__ == "__main__":
    unittest.main()
