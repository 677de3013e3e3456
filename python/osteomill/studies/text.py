"""Checks and display of texts from elsewhere, as in all programs (common/text)."""

from osteomill import _studies


def _bytes_of(text: str) -> bytes:
    """Bytes as they came from the system; a lone surrogate that stands for no byte becomes a byte that is no
    UTF-8, too."""
    try:
        return text.encode("utf-8", "surrogateescape")
    except UnicodeEncodeError:
        return text.encode("utf-8", "surrogatepass")


def why_not_plain(text: str) -> str | None:
    """Reason why a text is no UTF-8 without control characters; None if it is."""
    return _studies.why_not_plain(_bytes_of(text))


def printable(text: str) -> str:
    """The text, each byte of a control character and each that is no UTF-8 as \\xNN."""
    return _studies.printable(_bytes_of(text))


def one_line(text: str) -> str:
    """The text's first 200 bytes, printable."""
    return _studies.one_line(_bytes_of(text))


def csv_cell(text: str) -> str:
    """A text as a cell of CSV (RFC 4180), which a spreadsheet does not compute."""
    return _studies.csv_cell(_bytes_of(text))


def without_passwords(text: str) -> str:
    """The text, printable, with *** for each password of an address."""
    return _studies.without_passwords(_bytes_of(text))


def holds_password(address: str) -> bool:
    """Whether an address of libpq has a password."""
    return _studies.holds_password(_bytes_of(address))


def line_of(error: BaseException) -> str:
    """One line for an exception: what is wrong, and where."""
    if isinstance(error, OSError) and error.strerror:
        text = f"{error.filename}: {error.strerror}" if error.filename else error.strerror
    else:
        text = str(error) or type(error).__name__
    return without_passwords(" ".join(text.split("\n")))
