"""Names of types: two of one name in one namespace are one for the linker, which keeps whichever constructor and destructor it meets first."""

import collections
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).parents[2]
FOLDERS = ("analysis", "bridge", "common", "devices", "haptic_server", "imaging", "python", "render_client", "simulation", "slicer",
           "studies", "tests")
NO_CODE = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|(?<![0-9a-fA-F])\'(?:\\.|[^\'\\\n])+\'', re.DOTALL)
OPENING = re.compile(r"namespace\s*(?P<namespace>[\w:]*)\s*\{"
                     r"|\b(?:enum\s+class|enum|class|struct|union)\s+(?P<type>\w+)\s*(?:final)?\s*(?::(?!:)[^;{]*)?\{"
                     r"|\{|\}")


def types_of(text: str) -> set[str]:
    """The types that a source defines in named namespaces, with these."""
    found, inside = set(), []
    for match in OPENING.finditer(NO_CODE.sub('""', text)):
        if match[0] == "}":
            if inside:
                inside.pop()
        elif match["namespace"] is not None:
            inside.append(match["namespace"])
        else:
            if match["type"] and all(inside):
                found.add("::".join([*inside, match["type"]]))
            inside.append("")  # names within a type or a function do not count
    return found


class TypeNamesTest(unittest.TestCase):
    def test_reader_sees_what_the_linker_does(self):
        source = """
            namespace a { namespace b::c { struct One { struct In {}; }; /* struct Not {}; */ enum class Two : int { x }; class Later; }
            namespace { struct Hidden {}; } const char* text = "struct Text {"; class Three final : public One { int f() { return '{'; } }; }
        """
        self.assertEqual(types_of(source), {"a::b::c::One", "a::b::c::Two", "a::Three"})

    def test_no_two_types_of_one_name(self):
        places = collections.defaultdict(list)
        for folder in FOLDERS:
            for path in sorted((ROOT / folder).rglob("*")):
                if path.suffix in (".h", ".cpp"):
                    for name in types_of(path.read_text(encoding="utf-8")):
                        places[name].append(str(path.relative_to(ROOT)))
        self.assertGreater(len(places), 500)
        self.assertEqual({name: files for name, files in places.items() if len(files) > 1}, {})


if __name__ == "__main__":
    unittest.main()
