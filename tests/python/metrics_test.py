"""--metrics and --log-json of the real server: a session on the real clock is asked over a socket while it runs."""

import collections
import http.client
import json
import socket
import unittest

from running import Running
from support import FolderTest, eventually, run


def scraped(port):
    """The values of a server's page on this port of loopback, as Prometheus asks for it, by name with labels."""
    connection = http.client.HTTPConnection("127.0.0.1", port)
    connection.request("GET", "/metrics")
    lines = connection.getresponse().read().decode().splitlines()
    connection.close()
    values = (line.rpartition(" ") for line in lines if not line.startswith("#"))
    return {name: float(value) for name, _, value in values}


class MetricsTest(unittest.TestCase):
    def test_are_of_the_session_that_runs(self):
        with Running("haptic_server", "--case", "cube", "--listen", "127.0.0.1:0", "--metrics", "127.0.0.1:0") as server:
            metrics = server.line_after("metrics on 127.0.0.1:")
            address = server.address()
            self.assertTrue(metrics and address, server.err)
            self.assertTrue(eventually(lambda: scraped(metrics)["osteomill_ticks_total"] > 100.0))
            values = scraped(metrics)
            self.assertEqual(values["osteomill_clients"], 0.0)
            self.assertEqual(values["osteomill_sent_bytes_total"], 0.0)
            self.assertIn('osteomill_faults_total{fault="overrun"}', values)
            self.assertEqual(values['osteomill_tick_latency_seconds_bucket{le="+Inf"}'], values["osteomill_tick_latency_seconds_count"])
            self.assertGreater(values["osteomill_tick_latency_seconds_count"], 0.0)

            def has_client():
                values = scraped(metrics)
                return values["osteomill_clients"] == 1.0 and values["osteomill_sent_bytes_total"] > 0.0
            with socket.create_connection(address.split(":")):
                self.assertTrue(eventually(has_client), "the hello was sent to it")
            self.assertTrue(eventually(lambda: scraped(metrics)["osteomill_clients"] == 0.0))
            self.assertEqual(server.end(), 0, server.err)

    def test_are_refused_where_others_could_ask(self):
        for address in ("0.0.0.0:9464", "[::]:9464", "192.0.2.1:0"):
            refused = run("haptic_server", "--metrics", address)
            self.assertEqual(refused.returncode, 2)
            self.assertIn(f"--metrics: '{address}' can be reached from elsewhere", refused.stderr)


class LogJsonTest(FolderTest):
    def test_is_an_object_a_line_also_for_the_status_and_the_error(self):
        full = self.folder / 'a "b".nrrd'
        full.symlink_to("/dev/full")
        said = self.run_to(1, "haptic_server", "--case", "cube", "--clock", "virtual", "--duration-s", "0.2", "--listen", "127.0.0.1:0",
                           "--log-json", "--save-bone", full).stderr
        levels, messages = collections.Counter(), ""
        for line in said.splitlines():
            entry = json.loads(line)
            self.assertEqual(entry.keys(), {"time", "level", "message"}, line)
            self.assertRegex(entry["time"], r"\A20..-..-..T..:..:..\....Z\Z")
            levels[entry["level"]] += 1
            messages += entry["message"] + "\n"
        self.assertIn("spindle", messages)
        self.assertIn("listening on 127.0.0.1:", messages)
        self.assertIn(str(full), messages)
        self.assertEqual(levels["error"], 1, said)
        self.assertGreater(levels["info"], 1)


if __name__ == "__main__":
    unittest.main()
