"""Recorded sessions of several trainees side by side: a table, learning curves, an overview.

Writes OUT/sessions.sqlite, sessions.csv, sessions.html and a learning curve OUT/KEY.svg for each metric that is drawn
(KEY_2.svg for the second case, ...). A recording that cannot be read to its end, as of a session that was
broken off, is named with how far it goes, and left out. With a database,
the sessions are added to that, too.
"""

import argparse
import dataclasses
import functools
import os
import pathlib
import urllib.parse
from typing import Any

from osteomill import _studies
from osteomill.studies.options import existing_file, one_of
from osteomill.studies.sessions import records
from osteomill.studies.sessions.groups import Groups, groups_text
from osteomill.studies.sessions.records import SessionRecord
from osteomill.studies.sessions.words import Words
from osteomill.studies.study_run import StudyRun
from osteomill.studies.tables import csv_of
from osteomill.studies.text import holds_password, printable

WRITES = ("sessions.*", "*.svg")
IS_REPEATED = False  # it may write into a database
CSV_DIGITS = 9
UTF8_MARK = "\ufeff"  # without it, Excel takes each letter beyond ASCII for two


def add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("places", nargs="+", type=pathlib.Path, metavar="DIR",
                        help="recordings, folders of recordings, or folders of folders of haptic_server --report")
    parser.add_argument("--groups", type=existing_file, metavar="FILE",
                        help="which group each trainee is in: a CSV of lines TRAINEE,GROUP (default: groups.csv in DIR); "
                        "\"expert\" is the group that others are shown against")
    parser.add_argument("--compare", nargs=2, default=[], metavar=("A", "B"), help="two groups to compare, if there are more")
    parser.add_argument("--language", type=one_of(*_studies.languages()), default="en",
                        help=f"of the page and its charts: {', '.join(_studies.languages())} (%(default)s)")
    parser.add_argument("--database", type=_address, metavar="ADDRESS",
                        help="add the sessions to this PostgreSQL database, too: postgresql://USER@HOST/NAME")


def run(options: argparse.Namespace, study: StudyRun) -> None:
    files = records.recordings_in(options.places)
    groups = Groups.of(options.groups or records.groups_file(options.places))
    tr = Words(options.language)
    sessions, skipped = _read(files, tr, study)
    nobodies = groups.assign(sessions, tr)
    for line in nobodies:
        study.warn(line)
    if options.database:
        from osteomill.studies.sessions.database import add_to_database

        add_to_database(options.database, sessions)
    _write(sessions, options.compare, skipped, nobodies, tr, study)


def _read(files: list[pathlib.Path], tr: Words, study: StudyRun) -> tuple[list[SessionRecord], list[str]]:
    """Sessions in the order of their start, each once, and a line for each recording that was left out."""
    from osteomill.studies.sessions.database import SessionStore

    skipped: list[str] = []

    def skip(why: str) -> None:
        skipped.append(printable(why))
        study.warn(f"left out: {why}")

    store = SessionStore(study.file("sessions.sqlite"))
    recordings: dict[str, pathlib.Path] = {}
    for file in files:
        try:
            recordings.setdefault(records.digest_of(file), file)  # else a copy
        except RuntimeError as error:
            skip(str(error))
    cases = [{"digest": digest, "file": str(file)} for digest, file in recordings.items()]
    found = study.sweep(functools.partial(_read_one, str(store.file)), cases, lambda case: str(case["file"]))
    sessions = []
    for (digest, file), one in zip(recordings.items(), found):
        if "goes_to_s" in one:
            study.warn("left out: " + records.broken_off_text(printable(str(file)), one))
            skipped.append(records.broken_off_text(printable(str(file)), one, tr))
            continue
        if "why_not" in one:
            skip(one["why_not"])
            continue
        record = records.record_of(digest, printable(str(file)), one)
        if not store.find(digest):
            store.keep(record)
        record.report = _report_address(file, study.out)
        sessions.append(record)
    if not sessions:
        study.forget_outcomes()
        raise RuntimeError("no recording can be read to its end")
    return sorted(sessions, key=lambda session: session.began_unix_ns), skipped


def _read_one(store: str, case: dict[str, str]) -> dict[str, Any]:
    """The record that an earlier study has kept of a recording, or else its contents."""
    from osteomill.studies.sessions.database import SessionStore

    kept = SessionStore(pathlib.Path(store)).find(case["digest"])
    return dataclasses.asdict(kept) if kept else records.read(case["file"])


def _write(
    sessions: list[SessionRecord], compare: list[str], skipped: list[str], nobodies: list[str], tr: Words, study: StudyRun
) -> None:
    from osteomill.studies.sessions import page

    table = csv_of(page.sessions_table(sessions), CSV_DIGITS)
    study.text("sessions.csv", table if table.isascii() else UTF8_MARK + table)
    found = page.overview(sessions, page.compared_groups(sessions, compare), skipped, nobodies, tr)
    for name, svg in found.charts.items():
        study.text(name + ".svg", svg)
    study.text("sessions.html", found.html)
    left_out = f", {len(skipped)} left out," if skipped else ""
    study.say(f"{len(sessions)} sessions{left_out} in {study.out / 'sessions.html'}{groups_text(sessions)}")


def _report_address(recording: pathlib.Path, out: pathlib.Path) -> str:
    """Address of the report in a page that lies in `out`; empty if there is no report beside the recording."""
    report = recording.parent / "report.html"
    if not os.path.isfile(report):
        return ""
    return urllib.parse.quote(os.fsencode(os.path.relpath(os.path.realpath(report), os.path.realpath(out))))


def _address(text: str) -> str:
    if holds_password(text):
        raise argparse.ArgumentTypeError(
            "holds a password, which everybody on this machine could read; write it into ~/.pgpass, the file of "
            "PGPASSFILE, or a service (service=NAME)")
    return text
