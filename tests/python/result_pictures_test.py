"""Every picture of docs/results stands in a page beside the command that draws it, and the command is one of today's."""

import functools
import json
import pathlib
import re
import shlex
import subprocess
import unittest

from support import program

TREE = pathlib.Path(__file__).parents[2]
RESULTS = TREE / "docs" / "results"
PICTURES = sorted(file for kind in ("svg", "png") for file in RESULTS.rglob(f"*.{kind}"))
PAGES = [*sorted((TREE / "docs").rglob("*.md")), TREE / "README.md"]
PROGRAMS = "build/release/bin/"
# A chart may be of a shorter run than the page shows.
LENGTHS = {"--duration-s"}


def sections(page):
    """From heading to heading."""
    return re.split(r"(?m)^(?=#+ )", re.sub(r"(?ms)^```bash\n.*?^```", lambda block: block[0].replace("\n#", "\n "), page.read_text()))


def commands(section):
    """Calls of our programs and scripts in the blocks of bash, as words without comments."""
    found = []
    for block in re.findall(r"(?ms)^```bash\n(.*?)^```", section):
        for line in block.replace("\\\n", " ").splitlines():
            words = shlex.split(line, comments=True)
            called = [i for i, word in enumerate(words) if PROGRAMS in word or word == "./demo.sh"]
            found += [words[called[0] :]] if called else []
    return found


def sections_that_show(picture):
    shown = []
    for page in PAGES:
        for section in sections(page):
            links = re.findall(r"!\[[^]]*\]\(([^)#]+)\)", section)
            if any((page.parent / link).resolve() == picture for link in links):
                shown.append(section)
    return shown


@functools.cache
def help_of(*words):
    """A program's help; for a benchmark, which is not built for this, its source."""
    if words[0].endswith("_benchmark"):
        source = TREE / "tests" / "benchmarks" / f"{words[0]}.cpp"
        return source.read_text() + "--benchmark_filter" if source.exists() else ""
    if not pathlib.Path(program(words[0])).exists():
        return ""
    done = subprocess.run([program(words[0]), *words[1:], "--help"], capture_output=True, text=True)
    return done.stdout if done.returncode == 0 else ""


def why_not_today(command):
    """The part of a command that today's tree lacks; empty: it has all of it."""
    if command[0] == "./demo.sh":
        return "" if (TREE / "demo.sh").exists() else "there is no demo.sh"
    name = command[0].rpartition("/")[2]
    is_study = name == "osteomill_study"
    known = help_of(name, command[1]) if is_study else help_of(name)
    if not known:
        return f"there is no {' '.join([name, *command[1:2]])}"
    options = {word.partition("=")[0] for word in command[1:] if word.startswith("--")}
    unknown = sorted(option for option in options if not re.search(re.escape(option) + r"(?![\w-])", known))
    return f"{name} knows no {unknown[0]}" if unknown else ""


class ResultPicturesTest(unittest.TestCase):
    def test_each_is_shown_beside_a_command_of_today(self):
        self.assertTrue(PICTURES)
        for picture in PICTURES:
            with self.subTest(str(picture.relative_to(TREE))):
                shown = sections_that_show(picture)
                self.assertTrue(shown, "no page shows it")
                beside = [command for section in shown for command in commands(section)]
                self.assertTrue(beside, "no command stands beside it")
                for command in beside:
                    self.assertEqual(why_not_today(command), "", command)

    def test_the_command_is_that_of_the_manifest(self):
        for picture in PICTURES:
            manifest = picture.parent / "manifest.json"
            if not manifest.exists() or (made := json.loads(manifest.read_text()))["program"] != "osteomill_study":
                continue
            with self.subTest(str(picture.relative_to(TREE))):
                beside = [command[1:] for section in sections_that_show(picture) for command in commands(section)
                          if command[0].endswith("osteomill_study")]
                self.assertIn(made["command"], [_as_in_manifest(words, made["command"]) for words in beside])

    def test_charts_are_drawn_by_studies_alone(self):
        """A chart without a manifest nobody draws again."""
        for picture in PICTURES:
            if picture.suffix == ".svg":
                self.assertTrue((picture.parent / "manifest.json").exists(), picture)

    def test_no_chart_shows_the_source_of_a_formula(self):
        """The usual numbers of a logarithmic axis are TeX, which charts do not set: text stays text in them."""
        for picture in PICTURES:
            if picture.suffix == ".svg":
                self.assertNotIn("mathdefault", picture.read_text(), picture)

    def test_finds_what_is_amiss(self):
        section = "# A\n```bash\nbuild/release/bin/osteomill_study tradeoff --glue 3 --out x  # --paste\n```\n![a](a.svg)\n"
        self.assertEqual(why_not_today(commands(section)[0]), "osteomill_study knows no --glue")
        self.assertEqual(why_not_today(["build/release/bin/osteomill_study", "farce"]), "there is no osteomill_study farce")
        self.assertEqual(why_not_today(["build/release/bin/render_benchmark", "--benchmark_filter=Refine"]), "")
        self.assertEqual(why_not_today(["build/release/bin/glue_benchmark"]), "there is no glue_benchmark")
        self.assertEqual(commands("```bash\nls out\n```\n"), [])


def _as_in_manifest(words, command):
    """Without --out, and with the lengths that the manifest has beside."""
    kept = []
    for i, word in enumerate(words):
        if word not in ("--out", *LENGTHS) and (i == 0 or words[i - 1] not in ("--out", *LENGTHS)):
            kept.append(word)
    for i, word in enumerate(command):
        if word in LENGTHS:
            kept += command[i : i + 2]
    return kept


if __name__ == "__main__":
    unittest.main()
