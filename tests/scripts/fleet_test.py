"""Sessions of several stations in one PostgreSQL database: a real server, started here, that two stations fill at once.

    fleet_test.py HAPTIC_SERVER OSTEOMILL_STUDY exits 77 if PostgreSQL is not installed"""

import csv
import glob
import os
import pathlib
import pwd
import socket
import subprocess
import sys
import tempfile
import unittest

SERVER, STUDY = sys.argv[1:]
POSTGRES = sorted(glob.glob("/usr/lib/postgresql/*/bin"))


def run(*command, **options):
    return subprocess.run([str(word) for word in command], check=True, capture_output=True, text=True, **options).stdout


class Database:
    """A PostgreSQL of its own, reached by a socket in its folder."""

    def __init__(self, folder):
        self.folder = folder
        self.user = pwd.getpwuid(os.getuid()).pw_name
        # It refuses to run as root.
        self.as_owner = []
        if os.getuid() == 0:
            self.user = "postgres"
            self.as_owner = ["setpriv", "--reuid=postgres", "--regid=postgres", "--clear-groups"]
            os.chmod(folder, 0o755)
        self.cluster = folder / "cluster"
        self.cluster.mkdir()
        if os.getuid() == 0:
            run("chown", "postgres:postgres", self.cluster)
        run(*self.as_owner, POSTGRES[-1] + "/initdb", "-D", self.cluster, "-A", "trust", "-E", "UTF8", "--no-sync", cwd="/")
        self.start()
        self.url = f"postgresql://{self.user}@/postgres?host={self.cluster}"

    def start(self):
        run(*self.as_owner, POSTGRES[-1] + "/pg_ctl", "-D", self.cluster, "-w", "-l", self.cluster / "log",
            "-o", f"-c listen_addresses='' -c unix_socket_directories='{self.cluster}' -c fsync=off", "start", cwd="/")

    def stop(self):
        """At once, as a crash does."""
        run(*self.as_owner, POSTGRES[-1] + "/pg_ctl", "-D", self.cluster, "-m", "immediate", "stop", cwd="/")

    def rows(self, query):
        return [line.split("|") for line in run(POSTGRES[-1] + "/psql", "-At", "-c", query, self.url).splitlines()]


class Fleet(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory(dir="/tmp")  # which every user may enter
        cls.folder = pathlib.Path(cls.scratch.name)
        cls.database = Database(cls.folder)
        for station in ("a", "b"):
            (cls.folder / station).mkdir()
            for number in range(2):
                run(SERVER, "--scene", "cube", "--clock", "virtual", "--duration-s", f"{1 + number}",
                    "--trainee", f"Zoë {station}", "--record", cls.folder / station / f"{number}.pcap")

    @classmethod
    def tearDownClass(cls):
        cls.database.stop()
        cls.scratch.cleanup()

    def study(self, station):
        return subprocess.Popen([STUDY, "sessions", self.folder / station, "--out", self.folder / f"out_{station}",
                                 "--database", self.database.url], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)

    def test_two_stations_that_finish_at_once_lose_nothing(self):
        for _ in range(3):  # sessions that are there already are the same afterwards
            for station in [self.study(name) for name in ("a", "b")]:
                error = station.communicate(timeout=120)[1]
                self.assertEqual(station.returncode, 0, error)
        sessions = self.database.rows("SELECT trainee, count(*) FROM session GROUP BY trainee ORDER BY trainee")
        self.assertEqual(sessions, [["Zoë a", "2"], ["Zoë b", "2"]])
        # The database agrees with each station's table.
        said = {}
        for station in ("a", "b"):
            with open(self.folder / f"out_{station}" / "sessions.csv", newline="", encoding="utf-8-sig") as file:
                for row in csv.DictReader(file):
                    if row["metric"] == "removed_mm3" and not row.get("of"):
                        said[pathlib.Path(row["session"]).name + station] = float(row["value"])
        kept = {pathlib.Path(file).name + pathlib.Path(file).parent.name: float(value) for file, value in self.database.rows(
            "SELECT file, value FROM session JOIN metric USING (digest) WHERE key = 'removed_mm3' AND of = ''")}
        self.assertEqual(kept.keys(), said.keys())
        for name, value in kept.items():
            self.assertAlmostEqual(value, said[name], delta=1e-5 * abs(said[name]), msg=name)

    def test_says_in_one_line_what_is_wrong(self):
        for url, code, reason in (("postgresql://me:secret@localhost/x", 2, "holds a password"),
                                  (f"postgresql://nobody@/x?host={self.folder}", 1, "failed: No such file or directory")):
            outcome = subprocess.run([STUDY, "sessions", self.folder / "a", "--out", self.folder / "refused", "--database", url],
                                     capture_output=True, text=True)
            self.assertEqual(outcome.returncode, code)
            last = outcome.stderr.splitlines()[-1]
            self.assertIn(reason, last)
            self.assertNotIn("secret", outcome.stderr)

    def failure(self, url):
        """The one line with which adding to a database fails."""
        out = tempfile.mkdtemp(dir=self.folder)
        outcome = subprocess.run([STUDY, "sessions", self.folder / "a", "--out", out, "--database", url],
                                 capture_output=True, text=True, timeout=120)
        self.assertEqual(outcome.returncode, 1, outcome.stderr)
        return outcome.stderr.splitlines()[-1]

    def test_a_database_that_says_nothing_is_given_up(self):
        with socket.create_server(("127.0.0.1", 0)) as silent:
            url = f"postgresql://nobody@127.0.0.1:{silent.getsockname()[1]}/x"
            self.assertIn("timeout expired", self.failure(url))

    def test_a_station_that_was_left_in_the_middle_holds_nobody_up(self):
        holder = subprocess.Popen([POSTGRES[-1] + "/psql", "-At", self.database.url], text=True,
                                  stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        with holder:
            holder.stdin.write("BEGIN; SELECT 'held', pg_advisory_xact_lock(1869836397);\n")
            holder.stdin.flush()
            while "held" not in holder.stdout.readline():
                pass
            line = self.failure(self.database.url + "&options=-c%20lock_timeout%3D500ms")
            self.assertIn("another station is adding its sessions", line)
            holder.stdin.close()

    def test_a_server_that_dies_in_the_middle_keeps_all_or_nothing(self):
        out = tempfile.mkdtemp(dir=self.folder)
        run(POSTGRES[-1] + "/psql", "-At", "-c", "DROP TABLE IF EXISTS metric, session", self.database.url)
        holder = subprocess.Popen([POSTGRES[-1] + "/psql", "-At", self.database.url], text=True, stdin=subprocess.PIPE,
                                  stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        with holder:
            # Rows that others add wait for this transaction.
            holder.stdin.write("CREATE TABLE session (digest text PRIMARY KEY, file text NOT NULL, trainee text NOT NULL,"
                               " case_name text NOT NULL, began_unix_ns bigint NOT NULL);\n"
                               "BEGIN; INSERT INTO session SELECT 'x', '', '', '', 0; SELECT 'held';"
                               " LOCK TABLE session IN ACCESS EXCLUSIVE MODE;\n")
            holder.stdin.flush()
            while "held" not in holder.stdout.readline():
                pass
            station = subprocess.Popen([STUDY, "sessions", self.folder / "a", "--out", out, "--database", self.database.url],
                                       stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
            while self.database.rows("SELECT count(*) FROM pg_stat_activity WHERE wait_event_type = 'Lock'") == [["0"]]:
                self.assertIsNone(station.poll())
            self.database.stop()
            error = station.communicate(timeout=120)[1]
            holder.stdin.close()
        self.assertEqual(station.returncode, 1, error)
        self.assertRegex(error.splitlines()[-1], "^osteomill_study: .*(terminat|clos)")
        self.database.start()
        self.assertEqual(self.database.rows("SELECT * FROM session"), [])
        with self.study("a") as again:
            error = again.communicate(timeout=120)[1]
        self.assertEqual(again.returncode, 0, error)
        self.assertEqual(self.database.rows("SELECT trainee, count(*) FROM session GROUP BY trainee"), [["Zoë a", "2"]])

    def test_a_database_in_another_encoding_holds_the_same_letters(self):
        run(POSTGRES[-1] + "/createdb", "-E", "LATIN1", "-T", "template0", "--locale=C", "latin1",
            "--maintenance-db", self.database.url)
        url = self.database.url.replace("/postgres?", "/latin1?")
        run(STUDY, "sessions", self.folder / "a", "--out", self.folder / "out_latin1", "--database", url)
        name = run(POSTGRES[-1] + "/psql", "-At", "-c", "SELECT DISTINCT trainee FROM session", url,
                   env={**os.environ, "PGCLIENTENCODING": "UTF8"})
        self.assertEqual(name, "Zoë a\n")
        recording = self.folder / "far" / "0.pcap"
        recording.parent.mkdir()
        run(SERVER, "--scene", "cube", "--clock", "virtual", "--duration-s", "1", "--trainee", "Łukasz", "--record", recording)
        outcome = subprocess.run([STUDY, "sessions", recording, "--out", self.folder / "out_far", "--database", url],
                                 capture_output=True, text=True)
        self.assertEqual(outcome.returncode, 1)
        self.assertIn("the database should be one of UTF8", outcome.stderr.splitlines()[-1])


if not POSTGRES:
    print("skipped: PostgreSQL is not installed (package postgresql)")
    sys.exit(77)
unittest.main(argv=sys.argv[:1])
