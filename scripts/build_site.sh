#!/usr/bin/env bash
# Builds the documentation as a site that needs no network: build/site/html/index.html. Usage: scripts/build_site.sh
# Needs Debian's mkdocs-material. Pages stand in the site as in the repository, so that their links are the same in both.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

if ! /usr/bin/python3 -c 'import mkdocs, material' 2>/dev/null; then
  echo "build_site.sh: mkdocs-material is missing: apt-get install --no-install-recommends mkdocs-material" >&2
  exit 2
fi

pages=build/site/pages
rm -rf "$pages"
mkdir -p "$pages/materials"
for part in README.md CONTRIBUTING.md CHANGELOG.md LICENSE docs cases materials/data; do
  if [[ -e $part ]]; then ln -s "$PWD/$part" "$pages/$part"; fi
done
/usr/bin/python3 -W ignore::DeprecationWarning -m mkdocs build --quiet --clean --strict
echo "Site: $PWD/build/site/html/index.html"
