#!/usr/bin/env python3
"""The reference of the module osteomill as Markdown, from its stubs (signatures) and its docstrings.

    PYTHONPATH=build/release/python /usr/bin/python3 scripts/python_reference.py > docs/python_reference.md"""

import ast
import inspect
import pathlib
import re

import osteomill as om

PACKAGE = pathlib.Path(om.__file__).parent


ALIASES = {"_Floats": "NDArray[np.float64]", "_Box": "Sequence[Sequence[int]]", "_Path": "str | os.PathLike[str]"}


def written(types):
    for alias, meant in ALIASES.items():
        types = types.replace(alias, meant)
    return types


def declarations():
    """Classes and functions of the package, by name."""
    trees = [ast.parse((PACKAGE / file).read_text()) for file in ("_core.pyi", "env.py", "render.py", "repeat_recording.py", "fallback_spaces.py", "sweep.py", "vector_env.py")]
    return {node.name: node for tree in trees for node in tree.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}


def signature(name, function):
    arguments = ast.unparse(function.args)
    arguments = re.sub(r"^self(, |$)", "", arguments)
    returned = f" -> {ast.unparse(function.returns)}" if function.returns and name == function.name else ""
    return written(f"`{name}({arguments}){returned}`")


def text(thing):
    """The docstring without the signature that pybind11 puts before it."""
    return re.sub(r"\A\w+\(.*?\) -> [^\n]*\n\n?", "", inspect.getdoc(thing) or "").strip()


def is_property(node):
    return any(ast.unparse(one) == "property" for one in node.decorator_list)


def members(name, node):
    for one in node.body:
        if not isinstance(one, ast.FunctionDef) or (one.name.startswith("_") and one.name != "__init__"):
            continue
        member = getattr(getattr(om, name), one.name)
        if is_property(one):
            said = text(member)
            yield f"- `{one.name}`: {written(ast.unparse(one.returns))}" + (f". {said}" if said else "")
        elif text(member) and not text(member).startswith("Initialize self"):
            yield f"\n**{signature(name if one.name == '__init__' else one.name, one)}**\n\n{text(member)}\n"


def main():
    nodes = declarations()
    print("# Reference of the module `osteomill`\n\nMade of its docstrings by `scripts/python_reference.py`. The tutorial is [python.md](python.md).\n")
    print(inspect.getdoc(om) + "\n")
    for name in om.__all__:
        thing = getattr(om, name)
        if name.startswith("__") or name == "FAULTS":
            continue
        if isinstance(thing, type):
            print(f"## {name}\n\n{text(thing)}\n")
            for line in members(name, nodes[name]):
                print(line)
            print()
        else:
            print(f"## {name}\n\n**{signature(name, nodes[name])}**\n\n{text(thing)}\n")
    print("## FAULTS\n\nWhat the numbers of `rollout(...)[\"fault\"]` mean:\n")
    for number, line in enumerate(om.FAULTS):
        print(f"- {number}: {line or 'none, all is well'}")


if __name__ == "__main__":
    main()
