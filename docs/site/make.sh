#!/usr/bin/env bash
# usage: docs/site/make.sh FOLDER
# Makes the pages of docs/, README.md, CHANGELOG.md, CONTRIBUTING.md, SECURITY.md and the examples' READMEs into a site
# in FOLDER, whose search works without a server, with Debian's packages python3-sphinx, python3-myst-parser,
# python3-sphinx-rtd-theme and libjs-katex. A link that leads nowhere fails it. With doxygen the reference of C and C++ is in FOLDER/api.
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
[ "$#" -eq 1 ] || { sed -n '2s/^# //p' "$0" >&2; exit 2; }
mkdir -p "$1"
out=$(realpath "$1")
python=/usr/bin/python3
"$python" -c 'import myst_parser, sphinx, sphinx_rtd_theme' 2>/dev/null && [ -d /usr/share/javascript/katex ] ||
  { echo "Please install: apt-get install python3-sphinx python3-myst-parser python3-sphinx-rtd-theme libjs-katex" >&2; exit 3; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# The same places as in the checkout, so that the pages' links hold.
(cd "$root" && git ls-files -z --cached --others --exclude-standard -- ':(glob)*.md' docs examples CITATION.cff LICENSE NOTICE \
  licenses.txt | xargs -0 cp --parents -t "$work" 2>/dev/null) || true
rm -rf "$work/.github"
"$python" -m sphinx -q -W --keep-going -b html -c "$root/docs/site" -d "$work/.doctrees" "$work" "$out"
rm -rf "$out/_sources"
# The licences of the works in it: the theme with its fonts, the search, KaTeX.
mkdir -p "$out/licences"
for package in sphinx-common python3-sphinx sphinx-rtd-theme-common python3-sphinx-rtd-theme libjs-katex fonts-katex \
  fonts-lato fonts-roboto-slab fonts-inconsolata fonts-font-awesome libjs-jquery libjs-underscore libjs-sphinxdoc; do
  [ ! -f "/usr/share/doc/$package/copyright" ] || cp -L "/usr/share/doc/$package/copyright" "$out/licences/$package"
done
if command -v doxygen >/dev/null; then
  "$root/docs/api/make.sh" >/dev/null && rm -rf "$out/api" && cp -r "$root/build/api" "$out/api"
fi
[ -s "$out/index.html" ] && [ -s "$out/searchindex.js" ]
echo "$out/index.html: $(find "$out" -name '*.html' | wc -l) pages"
