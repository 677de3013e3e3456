"""The sources: every include points downward; files are opened to write only in the places that are listed; and every program checks, before
it accepts its command line, that no output would overwrite an input."""

import pathlib
import re
import unittest

REPOSITORY = pathlib.Path(__file__).parents[2]

#: The product's modules, and what each may include beside itself and the generated messages of proto/. A file belongs to the first module
#: whose folder holds it.
MODULES = {
    "common/scene/": ("common/bone/", "common/files/", "common/text/"),
    "common/": (),
    "bridge/": (),
    "simulation/": ("common/bone/", "common/scene/", "common/session/", "common/text/append.h"),
    "devices/": ("common/", "bridge/", "simulation/device/", "simulation/exchange/"),
    "imaging/case/": ("common/", "imaging/", "simulation/force_models/"),
    "imaging/": ("common/",),
    "analysis/": ("common/", "simulation/", "imaging/"),
    "haptic_server/": ("common/", "bridge/", "simulation/", "devices/", "imaging/", "analysis/"),
    "render_client/": ("common/",),
    "slicer/": ("common/", "render_client/link/"),
    # The pictures of the module of Python are a library of their own: its core knows no OpenGL. They include its sessions, and describe
    # them as a server would to a client.
    "python/render/": ("common/", "haptic_server/streaming/live_session.h", "imaging/case/structures.h", "python/module/arrays.h",
                       "python/module/exceptions.h", "python/module/released_lock.h", "python/module/stepped_session.h",
                       "render_client/dataset/", "render_client/volume/"),
    # Kernels of the package's studies.
    "python/studies_module/": ("common/", "python/module/arrays.h", "python/module/loaded_case.h", "bridge/", "simulation/", "devices/", "imaging/",
                        "analysis/", "haptic_server/", "render_client/", "studies/"),
    "python/": ("common/", "simulation/", "devices/simulated/", "imaging/", "analysis/", "haptic_server/"),
    "studies/": ("common/", "bridge/", "simulation/", "devices/", "imaging/", "analysis/", "haptic_server/", "render_client/"),
}

#: The sources that open a file to write, replace or make one, each with the reason why that does not bypass atomic_file.h.
OPENINGS = {
    "common/files/atomic_file.cpp": "the place: refuses a link that leads to nothing",
    "common/files/session_file.cpp": "moves the part of a killed session aside",
    "common/files/output_place.cpp": "a lock of its own name",
    "common/recording/pcap_file.cpp": "the part of a SessionFile",
    "analysis/logs/csv_log.cpp": "the part of a SessionFile",
    "analysis/hdf5/hdf5_file.cpp": "the part of an AtomicFile",
    "analysis/replay/recording_sound.cpp": "the part of an AtomicFile",
    "imaging/case/bone_import_main.cpp": "a new folder of a random name",
    "imaging/resampling/scratch_values.cpp": "a file without a name",
    "imaging/dicom/quiet_libraries.cpp": "/dev/null",
    "render_client/ui/view/picture_export.cpp": "a list in a new folder of a free name",
    "render_client/ui/start/start_page.cpp": "a new folder of a random name",
    "python/osteomill/part_files.py": "its own cases, through no link, appended and locked",
    "python/osteomill/studies/program.py": "/dev/null",
}
OPENING = re.compile(r'std::ofstream[ (]|std::fstream|fopen\([^)]*"[wa]|O_WRONLY|O_RDWR|O_CREAT|H5Fcreate|sf_open|SFM_WRITE|pcap_dump_fopen|'
                     r'sqlite3_open|fs::rename|filesystem::rename|renameat|copy_file|mkdtemp|mkstemp|resize_file|freopen|open\([a-z_]*, "[aw]')


def sources():
    """Each source of the product, named from the root on, with its text."""
    for folder in sorted({module.partition("/")[0] for module in MODULES}):
        for file in sorted((REPOSITORY / folder).rglob("*")):
            if file.suffix in (".cpp", ".h", ".py"):
                yield str(file.relative_to(REPOSITORY)), file.read_text(errors="surrogateescape")


class IncludeArrows(unittest.TestCase):
    def test_point_downward(self):
        wrong, includes = [], 0
        for file, text in sources():
            module, uses = next((folder, uses) for folder, uses in MODULES.items() if file.startswith(folder))
            for included in re.findall(r'^#include "([^"]+)', text, re.M):
                if "/" not in included or included.startswith(".."):
                    continue
                includes += 1
                if not included.startswith((module, "osteomill/", *uses)):
                    wrong.append(f"{file} includes {included}")
        self.assertEqual(wrong, [])
        self.assertGreater(includes, 1000, "the modules were not found")


CONSTANT = re.compile(r"^(?:inline |static )*(?:constexpr|const) [\w:<>, ]+?[ &*](\w+)(?: = |\{|\[)")


def constants(text, is_anonymous):
    """Each constant of a source's anonymous namespaces, or of its others, with the namespace around."""
    namespace, inside = "", False
    for line in text.splitlines():
        if opened := re.match(r"namespace ([\w:]+) \{", line):
            namespace = opened[1]
        elif line == "namespace {":
            inside = True
        elif line == "}  // namespace":
            inside = False
        elif inside == is_anonymous and (found := CONSTANT.match(line)):
            yield found[1], namespace


class JoinedSources(unittest.TestCase):
    """A library's sources are compiled as one (CMAKE_UNITY_BUILD). There a constant of one source's anonymous namespace hides a header's of the
    same name from all sources behind it, without a word of the compiler."""

    def test_have_no_constant_of_the_name_of_a_headers(self):
        of_headers = {}
        for file, text in sources():
            if file.endswith(".h"):
                for name, namespace in constants(text, False):
                    of_headers.setdefault(name, []).append((file, namespace))
        hidden = [f"{file} hides {name} of {header}" for file, text in sources() if file.endswith(".cpp")
                  for name, namespace in constants(text, True)
                  for header, outer in of_headers.get(name, ()) if namespace == outer or namespace.startswith(outer + "::")]
        self.assertEqual(hidden, [])
        self.assertGreater(len(of_headers), 200, "the constants were not found")


class WrittenFiles(unittest.TestCase):
    def test_are_opened_in_the_places_that_are_listed(self):
        found = {file for file, text in sources() if OPENING.search(text)} - {"render_client/ui/view/picture_export.h"}
        others = {file for file in found - OPENINGS.keys() if not file.startswith("python/examples/")}
        self.assertEqual(others, set(), "write through AtomicFile, or say here why not")
        self.assertEqual(OPENINGS.keys() - found, set(), "they open nothing")

    def test_are_held_against_what_is_read_by_every_command_line(self):
        writes_nothing = {"slicer/osteomill_slicer_main.cpp"}
        command_lines = {file: text for file, text in sources()
                         if not file.endswith(".py") and "app.parse_or_text(" in text}
        others = {file for file, text in command_lines.items() if "require_distinct" not in text} - writes_nothing
        self.assertEqual(others, set(), "call require_distinct (common/files/distinct_files.h)")
        self.assertGreaterEqual(len(command_lines), 6)

    def test_are_held_against_what_is_read_by_the_module_of_python(self):
        # A binding that is given a path to write hands it to one of these.
        for file, call in (("analysis/hdf5/recording_hdf5.cpp", "Recording.to_hdf5"),
                           ("haptic_server/session/session_assembly.cpp", "Session(record=)")):
            self.assertIn("require_distinct(files)", (REPOSITORY / file).read_text(), f"{call}: call it (common/files/distinct_files.h)")


if __name__ == "__main__":
    unittest.main()
