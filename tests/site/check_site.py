#!/usr/bin/env python3
"""usage: tests/site/check_site.py SOURCE   Makes the site (docs/site/make.sh) in an empty folder: every link between
its pages leads to a page and a place that exist, no page loads anything from elsewhere, every Markdown page of the
checkout is there, and the search knows their words. Exit code 77 where Debian's packages for it are missing."""

import html.parser
import subprocess
import sys
import tempfile
import urllib.parse
from pathlib import Path

SOURCE = Path(sys.argv[1]).resolve()


class Page(html.parser.HTMLParser):
    def __init__(self, file):
        super().__init__()
        self.links, self.loads, self.places = [], [], {""}
        self.feed(file.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self.places.add(given.get("id") or "")
        if tag == "a" and given.get("href"):
            self.links.append(given["href"])
        if tag in {"script", "img", "source", "video", "iframe"} and given.get("src"):
            self.loads.append(given["src"])
        if tag == "link" and given.get("rel") in {"stylesheet", "icon", "shortcut icon"}:
            self.loads.append(given["href"])


def faults_of(site):
    pages = {file: Page(file) for file in site.rglob("*.html") if "api" not in file.relative_to(site).parts}
    seen = 0
    for file, page in pages.items():
        name = file.relative_to(site)
        for address in page.loads:
            parts = urllib.parse.urlsplit(address)
            if parts.scheme == "data":
                continue
            if parts.scheme or parts.netloc:
                yield f"{name} loads {address}"
            elif not (file.parent / urllib.parse.unquote(parts.path)).is_file():
                yield f"{name} loads {address}, which is not there"
        for address in page.links:
            parts = urllib.parse.urlsplit(address)
            if parts.scheme or parts.netloc:
                continue
            target = (file.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else file
            seen += 1
            if not target.is_file():
                yield f"{name} links to {address}: no such file"
            elif target in pages and urllib.parse.unquote(parts.fragment) not in pages[target].places:
                yield f"{name} links to {address}: no such place"
    if seen < 1000:
        yield f"only {seen} links were found"
    told = (site / "searchindex.js").read_text(encoding="utf-8")
    for page in [*SOURCE.glob("docs/**/*.md"), *SOURCE.glob("*.md"), *SOURCE.glob("examples/**/README.md")]:
        name = page.relative_to(SOURCE).with_suffix("").as_posix()
        if not (site / f"{name}.html").is_file() or f'"{name}"' not in told:
            yield f"{name} is not in the site or its search"


with tempfile.TemporaryDirectory() as folder:
    site = Path(folder).resolve() / "site"
    done = subprocess.run([SOURCE / "docs/site/make.sh", site], capture_output=True, text=True, check=False)
    if done.returncode == 3:
        print(f"skipped: {done.stderr}")
        sys.exit(77)
    if done.returncode != 0:
        sys.exit(done.stdout + done.stderr)
    faults = list(faults_of(site))
print("\n".join(faults) or "every link of the site leads to its place")
sys.exit(1 if faults else 0)
