#!/usr/bin/env python3
"""Checks a site of HTML files: every link within it leads to a file and a place in it, and no script, style, font or picture comes from
elsewhere. Says each fault in a line; exits 1 where there is one.

    scripts/check_site.py FOLDER"""

import pathlib
import sys
import urllib.parse
from html.parser import HTMLParser


class Page(HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.links, self.parts, self.places = [], [], set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.places.update(values[name] for name in ("id", "name") if values.get(name))
        if tag == "a" and values.get("href"):
            self.links.append(values["href"])
        elif tag == "link" and "canonical" not in values.get("rel", "") and values.get("href"):
            self.parts.append(values["href"])
        elif tag in ("script", "img", "source", "iframe") and values.get("src"):
            self.parts.append(values["src"])


def faults(folder):
    pages = {}
    for file in sorted(folder.rglob("*.html")):
        if "cpp" not in file.relative_to(folder).parts:  # Doxygen's own
            pages[file] = Page(file.read_text(encoding="utf-8"))
    for file, page in pages.items():
        name = file.relative_to(folder)
        for part in page.parts:
            if urllib.parse.urlsplit(part).netloc:
                yield f"{name}: takes {part} from elsewhere"
        for link in page.links + page.parts:
            url = urllib.parse.urlsplit(link)
            if url.scheme or url.netloc:
                continue
            to = (file.parent / urllib.parse.unquote(url.path)).resolve() if url.path else file
            if not to.exists():
                yield f"{name}: {link} leads nowhere"
            elif url.fragment and to in pages and urllib.parse.unquote(url.fragment) not in pages[to].places:
                yield f"{name}: {link} names no place of that page"


def main():
    found = list(faults(pathlib.Path(sys.argv[1]).resolve()))
    print("\n".join(found), end="\n" if found else "")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
