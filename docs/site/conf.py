# Sphinx's settings for the documents as a site: scripts/site.sh. The pages are the Markdown files of the tree, as they are.
import pathlib
import re

root = pathlib.Path(__file__).resolve().parents[2]
project = "Osteomill"
author = "the authors of Osteomill"
copyright = author
release = version = re.search(r"project\(\w+\s+VERSION ([0-9.]+)", (root / "CMakeLists.txt").read_text()).group(1)

extensions = ["myst_parser", "breathe"]
myst_heading_anchors = 4
root_doc = "docs/site/index"
include_patterns = ["*.md", "docs/**"]
exclude_patterns = ["build*", "out", ".git", "tests", "python", "slicer", "[!d]*/**/*.md", "docs/results/*.svg"]
breathe_projects = {"bridge": str(root / "out" / "site-xml" / "xml")}
breathe_default_project = "bridge"
breathe_domain_by_extension = {"h": "c"}

html_theme = "furo"
html_title = f"Osteomill {release}"
html_copy_source = html_show_sphinx = False
html_last_updated_fmt = None
# Whatever lies beside the pages by hand: Doxygen's reference of the C++ code.
html_extra_path = [str(root / "out" / "site-cpp")]
