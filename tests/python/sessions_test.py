"""The study of several sessions: equal to the digit with that of version 0.3, and its treatment of odd files."""

import contextlib
import html
import io
import json
import math
import os
import pathlib
import re
import sqlite3
import subprocess
import tempfile
import time
import tomllib
import unittest

import scipy.stats
from support import run_server

from osteomill import _studies
from osteomill.studies.program import main
from osteomill.studies.sessions import page, records, statistics
from osteomill.studies.sessions.cases import HEADLINES, cases_of
from osteomill.studies.sessions.curves import _look_of, learning_curves
from osteomill.studies.sessions.database import SessionStore
from osteomill.studies.sessions.records import Metric, SessionRecord
from osteomill.studies.sessions.words import ENGLISH, Words
from osteomill.studies.tables import csv_of

DATA = pathlib.Path(__file__).parents[1] / "data" / "sessions"


def table_rows(text):
    return [[html.unescape(cell) for cell in re.findall(r"<t[dh][^>]*>(.*?)</t[dh]>", row, re.DOTALL)]
            for row in re.findall(r"<tr>(.*?)</tr>", text, re.DOTALL)]


def of_trainees(group, times_s, attempts=1):
    """Sessions of trainees, one time each."""
    return [SessionRecord(f"{group}{i}{attempt}", "", f"{group}{i}", "molar", attempt, [Metric("time_s", "", time_s, "s", "time")], group)
            for i, time_s in enumerate(times_s) for attempt in range(attempts)]


class GoldenTest(unittest.TestCase):
    """Tables of records whose numbers were drawn by lot, as version 0.3 wrote them."""

    @classmethod
    def setUpClass(cls):
        os.environ["TZ"] = "UTC"
        time.tzset()
        cls.sessions = [SessionRecord(**one | {"metrics": [Metric(*row) for row in one["metrics"]]})
                        for one in json.loads((DATA / "records.json").read_text(encoding="utf-8"))]

    def test_the_table_is_the_same_to_the_byte(self):
        self.assertEqual(csv_of(page.sessions_table(self.sessions), 9), (DATA / "sessions.csv").read_text(encoding="utf-8"))

    def test_the_page_has_the_same_numbers(self):
        found = page.overview(self.sessions, page.compared_groups(self.sessions, []), [])
        self.assertEqual(table_rows(found.html), json.loads((DATA / "page_rows.json").read_text(encoding="utf-8")))
        self.assertEqual(found.charts.keys(), {what.key for what in HEADLINES[:9]} | {what.key + "_2" for what in HEADLINES[:8]})

    def test_the_page_is_safe_and_the_same_twice(self):
        first, second = (page.overview(self.sessions, [], ["<b>x</b>"]).html for _ in range(2))
        self.assertEqual(first, second)
        self.assertNotIn("<Fay>", first)
        self.assertIn("Left out: &lt;b&gt;x&lt;/b&gt;", first)
        names = re.findall(r'<g id="[^"]*"|<script', first)
        self.assertEqual(names, [])

    def test_a_table_wider_than_the_window_scrolls_in_a_box_of_its_own(self):
        html = page.overview(self.sessions, [], []).html
        self.assertGreater(html.count("<table"), 2)
        self.assertEqual(html.count("<table"), html.count("<div class='scroll'><table"))
        self.assertEqual(html.count("</table>"), html.count("</table></div>"))
        self.assertIn(".scroll{overflow-x:auto", html)


class LanguageTest(unittest.TestCase):
    FOLDER = pathlib.Path(page.__file__).parent

    def texts_of_the_page(self):
        """All that its sources hand to tr, but names and headlines, as it is looked up."""
        texts = set()
        for file in (*self.FOLDER.glob("*.py"), *self.FOLDER.glob("*.jinja")):
            for quote, text in re.findall(r"""\btr\((["'])(.*?)(?<!\\)\1""", file.read_text(encoding="utf-8"), re.DOTALL):
                texts.add(" ".join(text.split()))
        return texts

    def test_each_text_has_its_german_and_no_german_is_of_nothing(self):
        own = tomllib.loads((self.FOLDER / "de.toml").read_text(encoding="utf-8"))
        shared = _studies.words_in("de")
        said = self.texts_of_the_page()
        self.assertGreater(len(said), 40)
        self.assertEqual({text for text in said if text not in own and text not in shared}, set())
        settings = {"coupling", "device", "force model", "force scale", "grip", "milling rate hz", "rpm", "vibration"}  # docs/metrics.md
        self.assertEqual(set(own) - said, settings)
        self.assertEqual({text for text in own if text in shared}, set())
        for english, german in own.items():
            self.assertEqual(re.findall(r"\{.*?\}", english), re.findall(r"\{.*?\}", german), english)
        for what in HEADLINES:
            self.assertIn(what.text, shared)

    def test_the_page_is_german_and_its_numbers_are_the_same(self):
        sessions = of_trainees("expert", (155.7, 162.3, 149.0), attempts=2) + of_trainees("student", (201.4, 188.9, 240.2), attempts=2)
        for session in sessions:
            session.case_name = "jaw"
            session.began_unix_ns += 1_764_000_000_000_000_000
            session.metrics += [Metric("passed", "", 1.0, "", ""), Metric("structure_dose_mm3", "nerve_canal", 3.0, "mm^3", ""),
                                Metric("rating_points", "", 1.0, "", ""), Metric("rating_most_points", "", 2.0, "", ""),
                                Metric("rating_item_points", "Floor: the pulp is closed", 1.0, "", ""), Metric("undos", "", 1.0, "", "")]
        sessions[0].bone_at_start = "carved"
        pages = {tr.language: page.overview(sessions, ["expert", "student"], ["x.pcap: torn"], [], tr) for tr in (ENGLISH, Words("de"))}
        english, german = (table_rows(pages[language].html) for language in ("en", "de"))
        self.assertEqual([len(row) for row in english], [len(row) for row in german])
        began = {tr.language: tr.time(sessions[0].began_unix_ns) for tr in (ENGLISH, Words("de"))}
        numbers = [[re.findall(rf"\d+(?:{sign}\d+)?", cell.replace(began[language], "")) for row in rows for cell in row]
                   for language, sign, rows in (("en", r"\.", english), ("de", ",", german))]
        self.assertEqual(numbers[0], [[number.replace(",", ".") for number in cell] for cell in numbers[1]])
        text_of = {language: re.sub(r"<style>.*?</style>|<[^>]*>", " ", one.html, flags=re.DOTALL) for language, one in pages.items()}
        self.assertIn(" 155,7 ", text_of["de"])
        self.assertEqual(re.findall(r"(?<![\w.])\d+\.\d+(?!\w|\.\d)", text_of["de"]), [])
        self.assertRegex(began["de"], r"^\d\d\.\d\d\.\d{4}, \d\d:\d\d Uhr$")
        self.assertIn(began["de"], text_of["de"])
        self.assertEqual(german[0][:6], ["Name", "Versuch", "Beginn", "bestanden", "Punkte", "dafür zurückgenommen"])
        for words in ("<html lang='de'>", "<h1>12 Sitzungen</h1>", "Ausgelassen: x.pcap: torn", "<h2>Kiefer</h2>", "✓ ja", "Nervkanal 3 mm³", "1 von 2",
                      "1 Zurücknehmen", "Zeit (s)", "weniger ist besser", "Boden: die Pulpa ist geschlossen", "Lernkurven",
                      "Kiefer (ein anderer Knochen am Anfang)", ">Trend</text>", ">Versuch</text>"):
            self.assertTrue(words in pages["de"].html, words)
        text = re.sub(r"<[^>]*>", " ", re.sub(r"<(style|svg).*?</\1>", "", pages["de"].html, flags=re.DOTALL))
        self.assertEqual(set(re.findall(r"\b(the|of|and|are|is|trainees?|attempts?|sessions?(?!\.csv)|mean)\b", text)), set())
        self.assertIn("<h2>jaw</h2>", pages["en"].html)
        with self.assertRaisesRegex(ValueError, "'xx' is not one of en, de"):
            Words("xx")


class StatisticsTest(unittest.TestCase):
    def test_groups_are_compared_as_by_hand(self):
        sessions = of_trainees("expert", (155.7, 162.3, 149.0, 171.2, 158.8)) + of_trainees(
            "student", (201.4, 188.9, 240.2, 195.0, 222.6, 210.7))
        rows = table_rows(page.overview(sessions, page.compared_groups(sessions, []), []).html)
        self.assertEqual(rows[-1], ["time (s)", "lower is better", "6", "209.8 [190.3 to 230.3]", "155.7 to 162.3", "–", "–",
                                    "159.4 (5)", "209.8 (6)", "-50.4 [-70.7 to -30.1]", "g -3.03", "< 0.001", "Welch"])
        with self.assertRaisesRegex(RuntimeError, 'no session is of a trainee in group "nobody"; take one of "expert", "student"'):
            page.compared_groups(sessions, ["expert", "nobody"])

    def test_a_trainee_counts_once_and_the_trend_is_within_trainees(self):
        anna = [SessionRecord(str(i), "", "Anna", "molar", i, [Metric("time_s", "", time_s, "s", "time")])
                for i, time_s in enumerate((300.0, 251.0, 230.0, 222.0, 210.0))]
        sessions = anna + of_trainees("", [200.0])
        case = cases_of(sessions)[0]
        self.assertEqual([one.number for one in case.attempts], [1, 2, 3, 4, 5, 1])
        self.assertEqual(sorted(case.trainee_means(HEADLINES[0])), [200.0, 242.6])
        trend = statistics.practice_trend(cases_of(anna)[0].values(HEADLINES[0]))
        line = scipy.stats.linregress([math.log(n) for n in range(1, 6)], [300.0, 251.0, 230.0, 222.0, 210.0])
        self.assertAlmostEqual(trend.slope, line.slope, places=9)
        self.assertAlmostEqual(trend.p(), line.pvalue, places=12)
        self.assertIn(">trend</text>", page.overview(sessions, [], []).html)

    def test_sessions_that_began_otherwise_are_apart(self):
        def session(number, bone, **settings):
            return SessionRecord(str(number), "", "Anna", "tooth", number, [Metric("time_s", "", 1.0, "s", "time")],
                                 bone_at_start=bone, settings=settings)

        sessions = [session(1, "whole", force_model="voxels"), session(2, "carved", force_model="voxels"),
                    session(3, "whole", force_model="point-spring"), session(4, "whole", force_model="voxels"),
                    session(5, "whole", force_model="voxels", vibration="true")]
        found = {case.name: [(one.session.digest, one.number) for one in case.attempts] for case in cases_of(sessions)}
        self.assertEqual(found, {"tooth": [("1", 1), ("4", 2)], "tooth (another bone at the start)": [("2", 1)],
                                 "tooth (force model point-spring)": [("3", 1)], "tooth (vibration true)": [("5", 1)]})
        table = page.sessions_table(sessions)
        self.assertEqual(len(table[["case", "attempt"]].drop_duplicates()), 5)
        self.assertIn("because these sessions began otherwise: force model point-spring", page.overview(sessions, [], []).html)

    def test_intervals_stay_within_what_is_possible(self):
        for values, possible in (([1.0, 2.0, 60.0], statistics.Possible.NOT_NEGATIVE), ([0.0, 0.0, 1.0], statistics.Possible.NOT_NEGATIVE),
                                 ([0.9, 0.7, 1.0], statistics.Possible.SHARE), ([0.01, 0.99], statistics.Possible.SHARE),
                                 ([1.0, 1.0], statistics.Possible.SHARE), ([0.0, 0.0], statistics.Possible.NOT_NEGATIVE)):
            mean = statistics.mean_of(values, possible)
            low, high = mean.interval
            self.assertTrue(0.0 <= low <= mean.mean + 1e-9, (values, mean))
            self.assertTrue(mean.mean - 1e-9 <= high <= (1.0 if possible is statistics.Possible.SHARE else math.inf), (values, mean))
        near = statistics.mean_of([100.0, 101.0, 102.0], statistics.Possible.NOT_NEGATIVE).interval
        plain = statistics.mean_of([100.0, 101.0, 102.0]).interval
        self.assertLess(max(abs(a - b) for a, b in zip(near, plain)), 0.02)  # far from the bound it is Student's

    def test_one_is_not_compared_with_three(self):
        sessions = of_trainees("expert", (155.7,)) + of_trainees("student", (201.4, 188.9, 240.2))
        row = table_rows(page.overview(sessions, page.compared_groups(sessions, []), []).html)[-1]
        self.assertEqual(row[-6:], ["155.7 (1)", "210.2 (3)", "–", "–", "–", ""])

    def test_an_opened_structure_is_named_with_its_volume(self):
        sessions = of_trainees("", (1.0, 2.0))
        sessions[0].metrics += [Metric("structure_dose_mm3", "pulp", 3.0, "mm^3", ""), Metric("structure_undone_mm3", "pulp", 0.27, "mm^3", ""),
                                Metric("structure_dose_mm3", "nerve", 0.0, "mm^3", "")]
        found = page.overview(sessions, [], []).html
        self.assertIn("<td class='no'>pulp 3.27 mm³</td>", found)
        self.assertIn("<td class='no'></td>", found)

    def test_a_rating_has_its_points_what_was_undone_for_them_and_its_items(self):
        sessions = of_trainees("", (1.0, 2.0, 3.0))
        for session, points, undos in ((sessions[0], 3.0, 0.0), (sessions[1], 1.0, 2.0)):
            session.metrics += [Metric("rating_points", "", points, "", ""), Metric("rating_most_points", "", 3.0, "", ""),
                                Metric("rating_item_points", "Pulp <closed>", 1.0, "", ""), Metric("rating_item_points", "All gone", points - 1.0, "", ""),
                                Metric("undos", "", undos, "", ""), Metric("undone_mm3", "", 4.25 * undos, "mm^3", "")]
        found = page.overview(sessions, [], []).html
        self.assertIn("<td class='n w'>3 of 3</td><td class='no'></td>", found)
        self.assertIn("<td class='n w'>1 of 3</td><td class='no'>2 undos, 8.50 mm³</td>", found)
        self.assertIn("<td class='n w'></td><td class='no'></td>", found)
        self.assertIn("<tr><td>Pulp &lt;closed&gt;</td><td class='n'>2 of 2</td></tr>", found)
        self.assertIn("<tr><td>All gone</td><td class='n'>1 of 2</td></tr>", found)
        self.assertNotIn("undone for them", page.overview(of_trainees("", (1.0, 2.0)), [], []).html)

    def test_the_curves_tell_trainees_apart_and_hold_nothing_impossible(self):
        case = cases_of(of_trainees("t", [20.0 + i for i in range(30)], attempts=2))[0]
        looks = {tuple(sorted(_look_of(case, f"t{i}").items())) for i in range(30)}
        self.assertEqual(len(looks), 30)
        low = cases_of(of_trainees("a", [0.5, 90.0, 1.0], attempts=2))[0]
        self.assertEqual(learning_curves(low)["time_s"].axes[0].get_ylim()[0], 0.0)

    def test_an_attempt_is_a_whole_number_and_the_highest_marker_is_whole_though_there_is_one_attempt(self):
        axes = learning_curves(cases_of(of_trainees("a", [97.0, 98.0, 100.0]))[0])["time_s"].axes[0]
        low, high = axes.get_xlim()
        self.assertEqual([at for at in axes.get_xticks() if low <= at <= high], [1.0])
        self.assertGreater(axes.get_ylim()[1], 103.0)

    def test_ranks_are_exact_with_ties_and_without(self):
        without = statistics.compare_ranks([1.0, 4.0, 6.0], [2.0, 3.0, 9.0, 10.0])
        exact = scipy.stats.mannwhitneyu([1.0, 4.0, 6.0], [2.0, 3.0, 9.0, 10.0], method="exact")
        self.assertEqual((without.u, round(without.p, 12)), (exact.statistic, round(exact.pvalue, 12)))
        # 0 0 1 and 1 2: two of the ten ways to deal out the midranks 1.5 1.5 3.5 3.5 5 have a sum of 6.5 or less.
        tied = statistics.compare_ranks([0.0, 0.0, 1.0], [1.0, 2.0])
        self.assertEqual((tied.u, tied.p, round(tied.cliffs_delta, 6)), (0.5, 0.4, -0.833333))
        self.assertIsNone(statistics.compare_ranks([0.0] * 101, [1.0] * 100))
        self.assertLess(statistics.compare_ranks([0.0] * 40, [1.0] * 60).p, 1e-25)

    def test_what_is_too_little_has_no_number(self):
        self.assertIsNone(statistics.mean_of([]))
        self.assertIsNone(statistics.mean_of([1.0]).interval)
        self.assertIsNone(statistics.compare_means([1.0, 1.0], [2.0, 2.0]))
        self.assertIsNone(statistics.compare_means([1.0], [2.0, 3.0]))
        self.assertIsNone(statistics.middle_half([1.0, 2.0, 3.0]))
        self.assertIsNone(statistics.practice_trend(cases_of(of_trainees("a", (1.0, 2.0)))[0].values(HEADLINES[0])))
        # A steady trainee: no variance, no trend.
        steady = statistics.practice_trend(cases_of(of_trainees("a", [5.0], attempts=3))[0].values(HEADLINES[0]))
        self.assertEqual((steady.slope, steady.p()), (0.0, 1.0))

    def test_runs_of_passes(self):
        design = statistics.CusumDesign()
        self.assertAlmostEqual(design.step(), 0.2933, places=4)
        self.assertAlmostEqual(design.level(), 2.2400, places=3)
        self.assertEqual([round(s, 3) for s in design.sums([True, False])], [0.0, -0.293, 0.413])


class ProgramTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.scratch.cleanup)
        cls.folder = pathlib.Path(cls.scratch.name)
        for name, trainee, seconds in (("a1", "Anna", 1), ("a2", "Anna", 1.2), ("b", "<script>Bo", 1.4)):
            (cls.folder / "term" / name).mkdir(parents=True)
            run_server(cls.folder, "--scene", "cube", "--duration-s", str(seconds), "--trainee", trainee,
                       "--record", str(cls.folder / "term" / name / "session.pcap"))

    def setUp(self):
        self.out = pathlib.Path(tempfile.mkdtemp(dir=self.folder))

    def study(self, *words, out=None, code=0):
        """In this process, for pandas, SciPy and matplotlib take longer to load than most of these to run."""
        command = ["sessions", *map(str, words), "--out", str(out or self.out / "out")]
        with contextlib.chdir(self.folder), contextlib.redirect_stdout(io.StringIO()) as said, contextlib.redirect_stderr(io.StringIO()) as aside:
            found = main(command)
        done = subprocess.CompletedProcess(command, found, said.getvalue(), aside.getvalue())
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def refusal(self, *words, code=1):
        lines = self.study(*words, code=code).stderr.splitlines()
        self.assertTrue(lines[-1].startswith("osteomill_study: "), lines)
        return lines[-1]

    def text(self, name):
        return (self.out / "out" / name).read_text(encoding="utf-8")

    def test_writes_the_same_whole_from_the_store_and_in_parts(self):
        (self.folder / "term" / "a1" / "report.html").write_text("a report")
        self.addCleanup((self.folder / "term" / "a1" / "report.html").unlink)
        self.assertIn("3 sessions in ", self.study("term").stdout)
        csv, html_text = self.text("sessions.csv"), self.text("sessions.html")
        self.assertIn("session,trainee,case,attempt,began_unix_s,metric,of,value,unit\n", csv)
        self.assertRegex(csv, r"term/a2/session.pcap,Anna,cube,2,\d+,time_s,,1.\d+,s\n")
        self.assertIn("&lt;script&gt;Bo", html_text)
        self.assertRegex(html_text, "<a href='[./]*term/a1/report.html'>")
        self.assertEqual(html_text.count("<a href"), 1)
        self.assertFalse((self.out / "out" / "cases-1-of-1.jsonl").exists())
        said = json.loads(self.text("manifest.json"))
        self.assertEqual((said["command"], said["settings"]["DIR"]), (["sessions", "term"], "term"))
        self.study("term")
        self.assertEqual((self.text("sessions.csv"), self.text("sessions.html")), (csv, html_text))
        (self.out / "out" / "sessions.sqlite").write_bytes(b"x" * 5000)
        self.study("term")
        self.assertEqual((self.text("sessions.csv"), self.text("sessions.html")), (csv, html_text))
        for part in ("1/2", "2/2"):
            self.study("term", "--shard", part, out=self.out / "parts")
        joined = self.out / "out2"
        self.study("--merge", self.out / "parts", out=joined)
        for file in (self.out / "out").iterdir():
            if file.suffix != ".sqlite":
                self.assertEqual((joined / file.name).read_bytes(), file.read_bytes(), file.name)
        self.assertIn("leave --groups out", self.refusal("--merge", self.out / "parts", "--groups", "x", code=2))
        (self.out / "parts" / "cases-1-of-2.jsonl").unlink()
        self.assertIn("missing of 2 parts: 1", self.refusal("--merge", self.out / "parts"))

    def test_names_each_that_is_no_recording_and_does_the_rest(self):
        term = self.out / "term"
        subprocess.run(["cp", "-r", self.folder / "term", term], check=True)
        for name, leads_to in (("circle.pcap", "circle.pcap"), ("dangling.pcap", "gone.pcap"), ("lost_folder", "folder_gone"),
                               ("round", "round"), ("good.pcap", "b/session.pcap"), ("a1/report.html", "report.html")):
            (term / name).symlink_to(leads_to)
        for name in ("folder.pcap", "deep/session.pcap", "linked"):
            (term / name).mkdir(parents=True)
        (term / "linked" / "session.pcap").symlink_to("session.pcap")
        os.mkfifo(term / "pipe.pcap")
        (term / "notes.pcap").write_text("no recording")
        torn = term / "a2" / "session.pcap"
        torn.write_bytes(torn.read_bytes()[:-40])
        (term / os.fsdecode(b"l\xe4tin.pcap")).write_text("no recording")
        done = self.study(term)
        self.assertIn("2 sessions, 11 left out, in ", done.stdout)
        said = [line for line in done.stderr.splitlines() if line.startswith("left out: ")]
        self.assertEqual(len(said), 11, done.stderr)
        for what in ("circle.pcap: Too many levels of symbolic links", "dangling.pcap: No such file", "lost_folder: No such file",
                     "round: Too many levels of symbolic links", "folder.pcap: is no file", "deep/session.pcap: is no file",
                     "linked/session.pcap: Too many levels", "pipe.pcap: is no file", "notes.pcap", "a2/session.pcap: ", "l\\xe4tin.pcap"):
            self.assertTrue(any(what in line for line in said), (what, said))
        self.assertIn("Left out: ", self.text("sessions.html"))

    def test_names_a_session_that_was_broken_off_with_how_far_it_goes(self):
        term = self.out / "term"
        subprocess.run(["cp", "-r", self.folder / "term", term], check=True)
        whole = term / "b" / "session.pcap"
        for name in ("part", "torn-1"):  # killed; killed, and begun again under its name
            (whole.parent / f"session.{name}.pcap").write_bytes(whole.read_bytes()[:-500])
        whole.unlink()
        done = self.study(term)
        self.assertIn("2 sessions, 1 left out, in ", done.stdout, "the same bytes count once")
        for said in (done.stderr, html.unescape(self.text("sessions.html"))):
            self.assertRegex(said, r"b/session\.(part|torn-1)\.pcap: \S+Bo, cube, .*: broken off, or still under way: goes to 1\.\d+ s, without")
        self.study(term, "--language", "de")
        self.assertRegex(html.unescape(self.text("sessions.html")), r"Bo, Würfel, .* Uhr: abgebrochen oder noch im Gang: reicht bis 1,\d+ s,")

    def test_takes_the_groups_that_lie_beside_the_sessions(self):
        groups = self.folder / "term" / "groups.csv"
        self.addCleanup(groups.unlink)
        groups.write_text("Anna,novice\n<script>Bo,expert\n")
        self.study("term")
        self.assertIn("Anna (novice)", self.text("sessions.html"))
        self.assertIn(">novice (n)<", self.text("sessions.html"))
        csv = self.text("sessions.csv")
        self.study("term", "--language", "de")
        self.assertIn("<html lang='de'>", self.text("sessions.html"))
        self.assertIn("<h1>3 Sitzungen</h1>", self.text("sessions.html"))
        self.assertEqual(self.text("sessions.csv"), csv)
        groups.write_text("Anna\n")
        self.assertIn("groups.csv:1: a line is TRAINEE,GROUP", self.refusal("term"))

    def test_names_each_line_of_the_groups_that_matches_nobody(self):
        groups = self.folder / "term" / "groups.csv"
        self.addCleanup(groups.unlink)
        groups.write_bytes(b"trainee;group\r\nZo\xeb;novice\r\nAnna;expert\r\n")
        done = self.study("term")
        self.assertIn('groups.csv:2: no session is of "Zoë"', done.stderr)
        self.assertIn("; groups: 1 expert", done.stdout)
        self.assertIn("Anna (expert)", self.text("sessions.html"))
        self.assertIn("groups.csv:2: no session is of", self.text("sessions.html"))
        groups.write_text("Ana,expert\nAnna,expert,left-handed\n")
        said = self.study("term").stderr
        self.assertIn('groups.csv:1: no session is of "Ana"; is it "Anna"?', said)
        self.assertIn('groups.csv:2: no session is of "Anna,expert"; a line is TRAINEE,GROUP: is it "Anna"?', said)

    def test_a_table_with_more_than_ascii_says_that_it_is_utf8(self):
        (self.folder / "umlaut").mkdir(exist_ok=True)
        run_server(self.folder, "--scene", "cube", "--duration-s", "0.5", "--trainee", "Jürgen",
                   "--record", str(self.folder / "umlaut" / "session.pcap"))
        self.study("umlaut")
        self.assertEqual((self.out / "out" / "sessions.csv").read_bytes()[:10], b"\xef\xbb\xbfsession")

    def test_says_in_one_line_what_is_wrong(self):
        self.assertIn("nowhere: there is no such recording or folder", self.refusal("nowhere"))
        (self.out / "empty").mkdir()
        self.assertIn("empty: holds no recording (*.pcap)", self.refusal(self.out / "empty"))
        self.assertIn("there are no groups: write groups.csv", self.refusal("term/b", "--compare", "a", "b"))
        self.assertIn("--compare", self.refusal("term", "--compare", "a", code=2))
        self.assertIn("--groups: File does not exist: x", self.refusal("term", "--groups", "x", code=2))
        self.assertIn("holds a password", self.refusal("term", "--database", "postgresql://me:secret@here/x", code=2))
        (self.out / "out").mkdir(exist_ok=True)
        groups = self.out / "out" / "sessions.csv"
        groups.write_text("Anna,novice\n")
        self.assertIn("--out and --groups are the same file", self.refusal("term", "--groups", groups, code=2))
        self.assertEqual(groups.read_text(), "Anna,novice\n")

    def test_finds_each_recording_once(self):
        term = self.folder / "term"
        self.assertEqual(len(records.recordings_in([term, term / "b", term / "b" / "session.pcap"])), 3)


class StoreTest(unittest.TestCase):
    def test_keeps_a_record_as_it_is(self):
        record = SessionRecord("d1", "a'b.pcap", "O'Neil; DROP TABLE session", "molar", 1_700_000_000_123_456_789,
                               [Metric("time_s", "", 1.0 / 3.0, "s", "time"), Metric("nothing", "pulp", None, "", "")],
                               bone_at_start="0123", settings={"force_model": "voxels"})
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "s?#.sqlite")
            store = SessionStore(file, "1")
            self.assertIsNone(store.find("d1"))
            store.keep(record)
            store.keep(record)
            self.assertEqual(SessionStore(file, "1").find("d1"), record)
            self.assertEqual([path.name for path in file.parent.iterdir()], [file.name])
            self.assertIsNone(SessionStore(file, "2").find("d1"), "another version measures otherwise")
            for content in (b"no database", b""):
                file.write_bytes(content)
                SessionStore(file, "1").keep(record)
            file.unlink()
            with contextlib.closing(sqlite3.connect(file)) as other:
                other.execute("CREATE TABLE session(something TEXT)")
            SessionStore(file, "1").keep(record)
            precious = pathlib.Path(folder, "precious")
            precious.write_text("mine")
            file.unlink()
            file.symlink_to(precious)
            SessionStore(file, "1").keep(record)
            self.assertEqual(precious.read_text(), "mine")
            with self.assertRaisesRegex(RuntimeError, "no/folder/s.sqlite: cannot be made"):
                SessionStore(pathlib.Path(folder, "no", "folder", "s.sqlite"), "1")


if __name__ == "__main__":
    unittest.main()
