"""Studies run in this process, and their files compared with kept ones."""

import contextlib
import io
import json
import math
import pathlib
import tempfile

from osteomill.studies.program import parser_of
from osteomill.studies.study_run import StudyRun

DATA = pathlib.Path(__file__).parents[1] / "data"


@contextlib.contextmanager
def run_of(name, module, *words, jobs=2):
    """The folder that the study fills, and its output."""
    options = parser_of(name, module).parse(list(words))
    said = io.StringIO()
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder)
        module.run(options, StudyRun(out, [name, *words], "a test", jobs=jobs, said=said, aside=io.StringIO()))
        yield out, said.getvalue()


def expect_kept(test, out, kept):
    """Every file of `kept` as it was: tables to the digit, numbers of JSON to a part in 1e9."""
    for file in sorted(kept.iterdir()):
        if file.suffix == ".json":
            expect_alike(test, json.loads((out / file.name).read_text()), json.loads(file.read_text()), file.name)
        elif file.is_file():
            test.assertEqual((out / file.name).read_text(), file.read_text(), file.name)


def expect_alike(test, found, kept, where):
    if isinstance(kept, dict):
        test.assertEqual(list(found), list(kept), where)
        for key, value in kept.items():
            expect_alike(test, found[key], value, f"{where}: {key}")
    elif isinstance(kept, list):
        test.assertEqual(len(found), len(kept), where)
        for place, value in enumerate(kept):
            expect_alike(test, found[place], value, f"{where}: {place}")
    elif isinstance(kept, float) and not isinstance(found, bool):
        test.assertTrue(found is not None and math.isclose(found, kept, rel_tol=1e-9, abs_tol=1e-12), f"{where}: {found}, not {kept}")
    else:
        test.assertEqual(found, kept, where)
