"""Tables of sessions and their metrics: a file that saves time, and a department's database.

    session(digest, file, trainee, case_name, began_unix_ns)
    metric(digest, place, key, of, value, unit, text)
    start(digest, bone, settings)
"""

import contextlib
import json
import os
import pathlib
from collections.abc import Iterable, Iterator
from typing import Any

import sqlalchemy as sa
from sqlalchemy.pool import NullPool

from osteomill import _studies
from osteomill.studies.sessions.records import Metric, SessionRecord

_TABLES = sa.MetaData()
_SESSION = sa.Table(
    "session", _TABLES,
    sa.Column("digest", sa.Text, primary_key=True),
    sa.Column("file", sa.Text, nullable=False),
    sa.Column("trainee", sa.Text, nullable=False),
    sa.Column("case_name", sa.Text, nullable=False),
    sa.Column("began_unix_ns", sa.BigInteger, nullable=False),
)
_METRIC = sa.Table(
    "metric", _TABLES,
    sa.Column("digest", sa.Text, sa.ForeignKey("session.digest", ondelete="CASCADE"), primary_key=True),
    sa.Column("place", sa.Integer, primary_key=True, autoincrement=False),
    sa.Column("key", sa.Text, nullable=False),
    sa.Column("of", sa.Text, nullable=False),
    sa.Column("value", sa.Float(53)),
    sa.Column("unit", sa.Text, nullable=False),
    sa.Column("text", sa.Text, nullable=False),
)
_START = sa.Table(  # apart from the session: databases of earlier versions have that table already
    "start", _TABLES,
    sa.Column("digest", sa.Text, sa.ForeignKey("session.digest", ondelete="CASCADE"), primary_key=True),
    sa.Column("bone", sa.Text, nullable=False),
    sa.Column("settings", sa.Text, nullable=False),  # JSON
)
_MADE_BY = sa.Table("made_by", sa.MetaData(), sa.Column("version", sa.Text, primary_key=True))

BUSY_S = 30.0  # another study may be writing the file

# Time to wait for a silent database: to connect, and for the network to carry sent data.
LIMITS = {
    "connect_timeout": 10,
    "keepalives_idle": 10,
    "keepalives_interval": 5,
    "keepalives_count": 3,
    "tcp_user_timeout": 30_000,
}
# Unless the address has a limit of its own.
_LIMIT_OF_LOCKS = "SELECT set_config('lock_timeout', '30s', true) WHERE current_setting('lock_timeout') = '0'"
# A station that adds sessions holds this lock until its transaction ends; any constant number.
_ONE_AT_A_TIME = "SELECT pg_advisory_xact_lock(1869836397)"
_ADVICE = {
    "55P03": "; another station is adding its sessions, or was left in the middle of it: try again",
    "22P05": "; the database should be one of UTF8 (createdb -E UTF8 -T template0)",
}


class SessionStore:
    """A small SQLite file. It only saves time: it is made again if it is missing, damaged or of another version.

    version: of the programs that filled it; others may measure differently. RuntimeError naming the file if it can be
    neither read nor made.
    """

    def __init__(self, file: pathlib.Path, version: str = _studies.VERSION) -> None:
        self.file = file
        if file.is_symlink():  # its name is ours, but the target of a link of that name is not
            file.unlink()
        address = sa.engine.URL.create("sqlite", database=str(file))
        self._engine = sa.create_engine(address, poolclass=NullPool, connect_args={"timeout": BUSY_S})
        if self._is_of(version):
            return
        with contextlib.suppress(OSError):
            os.remove(file)
        if not self._is_of(version):
            raise RuntimeError(f"{file}: cannot be made: it is no file that can be written")

    def find(self, digest: str) -> SessionRecord | None:
        """The kept record of the recording with this digest."""
        with self._errors_named(), self._engine.connect() as connection:
            session = connection.execute(_SESSION.select().where(_SESSION.c.digest == digest)).first()
            start = connection.execute(_START.select().where(_START.c.digest == digest)).first()
            if session is None or start is None:
                return None
            rows = connection.execute(_METRIC.select().where(_METRIC.c.digest == digest).order_by(_METRIC.c.place))
            metrics = [Metric(row["key"], row["of"], row["value"], row["unit"], row["text"]) for row in rows.mappings()]
            return SessionRecord(digest, session.file, session.trainee, session.case_name, session.began_unix_ns, metrics,
                                 bone_at_start=start.bone, settings=json.loads(start.settings))

    def keep(self, record: SessionRecord) -> None:
        """Replaces the kept record."""
        with self._errors_named(), self._engine.begin() as connection:
            for table in (_METRIC, _START):  # SQLite does not cascade by itself
                connection.execute(table.delete().where(table.c.digest == record.digest))
            _replace(connection, record)

    def _is_of(self, version: str) -> bool:
        try:
            with self._engine.begin() as connection:
                _TABLES.create_all(connection)
                _MADE_BY.metadata.create_all(connection)
                made_by = connection.execute(_MADE_BY.select()).scalar()
                if made_by is None:
                    connection.execute(_MADE_BY.insert().values(version=version))
                # A file of that name may have tables of these names and other columns.
                connection.execute(_SESSION.select().limit(1)).all()
                connection.execute(_METRIC.select().limit(1)).all()
                connection.execute(_START.select().limit(1)).all()
                return made_by in (None, version)
        except sa.exc.SQLAlchemyError:
            return False

    @contextlib.contextmanager
    def _errors_named(self) -> Iterator[None]:
        try:
            yield
        except sa.exc.SQLAlchemyError as error:
            raise RuntimeError(f"{self.file}: {_reason_of(error)}") from None


def add_to_database(address: str, sessions: Iterable[SessionRecord]) -> None:
    """Adds sessions to a department's PostgreSQL database; one that is there already, by its digest, is replaced.

    All of them or none: several stations may do so at once, and lose nothing. `address` is libpq's, and may set limits of
    its own. RuntimeError in one line if the database cannot be reached or written, is silent, or is held by another
    station for more than half a minute.
    """
    import psycopg2

    engine = sa.create_engine("postgresql+psycopg2://", poolclass=NullPool, creator=lambda: _connect(address))
    try:
        with engine.begin() as connection:
            connection.exec_driver_sql(_LIMIT_OF_LOCKS)
            connection.exec_driver_sql(_ONE_AT_A_TIME)
            _TABLES.create_all(connection)
            for session in sessions:
                _replace(connection, session)
    except (sa.exc.SQLAlchemyError, psycopg2.Error) as error:
        raise RuntimeError(f"{address}: {_reason_of(error)}") from None


def _connect(address: str) -> Any:
    import psycopg2.extensions

    own = psycopg2.extensions.parse_dsn(address)
    limits = {name: limit for name, limit in LIMITS.items() if name not in own}
    # The texts of sessions are in UTF-8, whatever encoding the database keeps.
    return psycopg2.connect(address, client_encoding="UTF8", **limits)


def _replace(connection: Any, session: SessionRecord) -> None:
    connection.execute(_SESSION.delete().where(_SESSION.c.digest == session.digest))
    connection.execute(_SESSION.insert().values(
        digest=session.digest, file=session.file, trainee=session.trainee, case_name=session.case_name,
        began_unix_ns=session.began_unix_ns))
    connection.execute(_START.insert().values(
        digest=session.digest, bone=session.bone_at_start, settings=json.dumps(session.settings, sort_keys=True)))
    rows = [
        {"digest": session.digest, "place": place, "key": metric.key, "of": metric.of, "value": metric.value,
         "unit": metric.unit, "text": metric.text}
        for place, metric in enumerate(session.metrics)
    ]
    if rows:
        connection.execute(_METRIC.insert(), rows)


def _reason_of(error: Exception) -> str:
    """The first line of the database's error, and a remedy."""
    original = getattr(error, "orig", None) or error
    lines = str(original).strip().splitlines() or [type(original).__name__]
    return lines[0] + _ADVICE.get(getattr(original, "pgcode", None) or "", "")
