"""Words of the page in a person's language, found by the English ones: those that window and report have too (common/words), and
those of the page alone, LANGUAGE.toml beside this file."""

import pathlib
import tomllib

from osteomill import _studies


class Words:
    """tr("{} of {}", 2, 3): the text in the language, with its values; in English where the language has no such text."""

    def __init__(self, language: str = "en") -> None:
        """ValueError for one that is none of _studies.languages()."""
        if language not in _studies.languages():
            raise ValueError(f"language: '{language}' is not one of {', '.join(_studies.languages())}")
        self.language = language
        self._texts = dict(_studies.words_in(language))
        if language != "en":
            self._texts |= tomllib.loads(pathlib.Path(__file__).with_name(f"{language}.toml").read_text(encoding="utf-8"))

    def __call__(self, english: str, *values: object) -> str:
        """Line ends of a long text are spaces."""
        english = " ".join(english.split())
        text = self._texts.get(english, english)
        return text.format(*values) if values else text

    def numbers(self, text: str) -> str:
        """The text with the language's decimal sign in its numbers."""
        return _studies.with_decimal_sign(text, self.language)

    def time(self, unix_ns: int) -> str:
        """By the clock of this machine; empty where a recording holds no time."""
        return _studies.local_time_text(unix_ns, self.language)

    def name(self, written: str) -> str:
        """The name of a tissue, a case or a structure as people write it: files write "Facial_Nerve"."""
        return self(written.replace("_", " "))


ENGLISH = Words()
