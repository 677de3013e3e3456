"""Tables of a repeated study: values that differ from the kept ones by more than noise."""

import json
import pathlib
import subprocess
import tempfile
import unittest

from support import NO_STUDY, FolderTest, program

from osteomill.studies.repeated_tables import compare_tables


class RepeatedTablesTest(FolderTest):
    def setUp(self):
        super().setUp()
        self.folders = [self.folder / name for name in ("kept", "once", "again")]
        for one in self.folders:
            one.mkdir()

    def write(self, name, *texts):
        for folder, text in zip(self.folders, texts):
            (folder / name).write_text(text)

    def compared(self):
        return compare_tables(*self.folders)

    def test_noise_is_that_of_two_runs_and_the_rest_is_exact(self):
        self.write("a.csv", "name,n,us\nx,1,10\ny,2,20\n", "name,n,us\nx,1,11\ny,2,22\n", "name,n,us\nx,1,12\ny,2,19\n")
        found = self.compared()
        self.assertEqual((found.columns, found.different, found.other), (3, [], []))
        self.write("a.csv", "name,n,us\nz,1,10\ny,3,40\n")
        different = {one.name: one for one in self.compared().different}
        self.assertEqual(sorted(different), ["a.csv: n", "a.csv: name", "a.csv: us"])
        self.assertEqual((different["a.csv: us"].differ, different["a.csv: us"].difference, different["a.csv: us"].noise), (1, 18.0, 3.0))

    def test_places_of_json_are_columns(self):
        same = json.dumps({"cases": [{"n": 1, "us": 5.0, "none": None}, {"n": 2, "us": 6.0, "none": []}]})
        self.write("b.json", same.replace('"n": 2', '"n": 7'), same, same)
        self.write("manifest.json", "{}", "[]", "1")
        found = self.compared()
        self.assertEqual([(one.name, one.differ, one.difference) for one in found.different], [("b.json: /cases/*/n", 1, 5.0)])
        self.assertEqual(found.columns, 3)

    def test_says_what_cannot_be_compared(self):
        self.write("a.csv", "n\n1\n", "n\n1\n2\n", "n\n1\n2\n")
        self.write("b.csv", "n\n1\n")
        self.assertEqual(self.compared().other, ["a.csv: has other rows or columns", "b.csv: is not written any more"])
        for name, text, why in (("c.json", "[" * 100_000 + "]" * 100_000, "lie more than 100 deep"), ("c.json", "{", "is no JSON"),
                                ("d.csv", '"' + "x" * 200_000 + '"\n1\n', "is no table in CSV")):
            self.write(name, text, text, text)
            with self.assertRaisesRegex(RuntimeError, f"{name}: .*{why}"):
                self.compared()
            self.write(name, "[]", "[]", "[]")


class RepeatTest(unittest.TestCase):
    def test_takes_no_manifest_that_names_no_study(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "manifest.json")
            right = {"version": "0", "commit": "0"}
            for kept, why in (([1], "is no manifest"), (right, "is no manifest"), (right | {"command": []}, "is no manifest"),
                              (right | {"command": ["sessions", "/"]}, NO_STUDY),
                              (right | {"command": ["repeat", "/"]}, NO_STUDY),
                              (right | {"command": ["\x1b[2J"]}, NO_STUDY)):
                file.write_text(json.dumps(kept))
                done = subprocess.run([program("osteomill_study"), "repeat", folder], capture_output=True, text=True)
                self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), done.stderr)
                self.assertIn(f"manifest.json: {'it ' if 'names' in why else ''}{why}", done.stderr)
                self.assertNotIn("\x1b", done.stderr)


if __name__ == "__main__":
    unittest.main()
