"""The manifest of a folder of results: the command, the program and the machine."""

import argparse
import os
import pathlib
import platform
from typing import Any

from osteomill import _studies
from osteomill.studies.options import Parser, name_of
from osteomill.studies.text import without_passwords

NAME = "manifest.json"


def manifest_of(command: list[str], parser: Parser, options: argparse.Namespace) -> dict[str, Any]:
    """The command, every setting, defaults included, and this machine."""
    system = platform.uname()
    return {
        "program": "osteomill_study",
        "version": _studies.VERSION,
        "commit": _studies.COMMIT,
        "command": command,
        "settings": {
            name_of(action): setting_text(getattr(options, action.dest))
            for action in parser.described
            if name_of(action) not in ("--out", "--merge", "--shard")
        },
        "machine": {
            "system": f"{system.system} {system.release} {system.machine}",
            "processor": _processor(),
            "processors": os.cpu_count() or 1,
            "compiler": _studies.COMPILER,
        },
    }


def setting_text(value: Any) -> str:
    if value is None or value is False:
        return ""
    if value is True:
        return "true"
    if isinstance(value, (list, tuple)):
        return ",".join(setting_text(one) for one in value)
    return without_passwords(f"{value:g}" if isinstance(value, float) else str(value))


def _processor() -> str:
    """The processor's name in Linux."""
    for line in pathlib.Path("/proc/cpuinfo").read_text(errors="replace").splitlines():
        if line.startswith("model name"):
            return line.partition(": ")[2]
    return "unknown"
