"""Sphinx: the checkout's own Markdown as a site. make.sh lays the pages out and calls it."""

import re
import shutil
from pathlib import Path

project = "Myoid"
author = "the Myoid contributors"
extensions = ["myst_parser"]
source_suffix = {".md": "markdown"}
root_doc = "index"
html_theme = "sphinx_rtd_theme"
html_theme_options = {"navigation_depth": 3, "collapse_navigation": False}
html_show_sphinx = False
html_copy_source = False
html_show_copyright = False
html_title = "Myoid"
myst_heading_anchors = 4
myst_enable_extensions = ["dollarmath"]
# Formulas by KaTeX beside the pages: the site loads nothing from elsewhere.
KATEX = Path("/usr/share/javascript/katex")
extensions.append("sphinx.ext.mathjax")
mathjax_path = "formulas.js"
html_static_path = ["static"]
html_css_files = ["katex/katex.min.css"]
html_js_files = ["katex/katex.min.js", "katex/auto-render.js"]
suppress_warnings = ["myst.header", "misc.highlighting_failure"]
exclude_patterns = [".doctrees"]

# The site's parts by what a reader asks for; a page belongs to the first part that names it.
PARTS = [
    ("First minutes", ["What it is <README>", "docs/quickstart", "docs/tutorial", "docs/gallery", "examples/README"]),
    ("How to", ["docs/guide/how-to", "docs/guide/troubleshooting", "docs/guide/recording-well", "docs/guide/study", "docs/guide/report",
                "docs/guide/verdicts", "docs/guide/packages", "docs/guide/commands", "docs/guide/*"]),
    ("Is it right?", ["docs/validation", "docs/scoreboard", "docs/theory/evidence", "docs/opensim-tools", "docs/performance",
                      "docs/remarks", "docs/damaged-files", "examples/*"]),
    ("Theory", ["docs/theory/identification", "docs/theory/*"]),
    ("Working on Myoid", ["docs/architecture", "CONTRIBUTING", "SECURITY", "docs/notation", "docs/index",
                          "docs/decisions/*", "CHANGELOG"]),
]  # fmt: skip


def pages_of(root: Path) -> dict[str, list[str]]:
    names = sorted(p.relative_to(root).with_suffix("").as_posix() for p in root.rglob("*.md"))
    left = [n for n in names if n != "index"]
    parts = {}
    for title, patterns in PARTS:
        parts[title] = []
        for pattern in patterns:
            label, _, name = pattern.rpartition(" <")
            found = [n for n in left if re.fullmatch(name.rstrip(">").replace("*", ".*"), n)]
            parts[title] += [pattern] if label and found else found
            left = [n for n in left if n not in found]
    if left:
        raise ValueError(f"docs/site/conf.py has no part for {left}")
    return parts


def write_index(app):
    """The first page: one table of contents a part."""
    root = Path(app.srcdir)
    text = ["# Myoid", "", "How strong is each muscle of this person, and which of these numbers may be believed?", ""]
    for title, pages in pages_of(root).items():
        text += ["```{toctree}", f":caption: {title}", ":maxdepth: 1", "", *pages, "```", ""]
    (root / "index.md").write_text("\n".join(text), encoding="utf-8")


def copy_katex(app, error):
    if error:
        return
    target = Path(app.outdir) / "_static" / "katex"
    target.mkdir(exist_ok=True)
    for name in ("katex.min.css", "katex.min.js", "contrib/auto-render.js"):
        shutil.copy(KATEX / name, target)
    (target / "fonts").mkdir(exist_ok=True)
    for font in (KATEX / "fonts").glob("*.woff2"):
        shutil.copy(font, target / "fonts")


def named_places(page: Path) -> set[str]:
    return set(re.findall(r'<a id="([^"]+)">', page.read_text(encoding="utf-8"))) if page.is_file() else set()


def link_files(app, docname, source):
    """Links to places that <a id> names, which MyST does not know, become HTML; links to files of the checkout that are
    no pages become their names."""
    page = (Path(app.srcdir) / docname).with_suffix(".md")

    def changed(match):
        label, (target, _, place) = match[1], match[2].partition("#")
        if "://" in target:
            return match[0]
        file = page.parent / target if target else page
        if place and place in named_places(file):
            address = re.sub(r"\.md$", ".html", target)
            return f'<a href="{address}#{place}">{label}</a>'
        if not target or target.endswith(".md"):
            return match[0]
        if file.is_dir() and (file / "README.md").is_file():
            return f"[{label}]({target.rstrip('/')}/README.md)"
        return match[0] if file.suffix in {".webp", ".svg"} and file.is_file() else label

    source[0] = re.sub(r"(?<!!)\[([^\]]+)\]\(([^)\s]+)\)", changed, source[0])


def setup(app):
    app.connect("builder-inited", write_index)
    app.connect("source-read", link_files)
    app.connect("build-finished", copy_katex)
