#!/usr/bin/env bash
# Builds the documentation as a site that needs no network. Usage: scripts/build_site.sh [FOLDER]
#   FOLDER: build/site by default; the site is FOLDER/html/index.html.
# Needs Debian's mkdocs-material. Pages stand in the site as in the project, so that their links are the same in both.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
case ${1:-} in
  -h | --help) sed -n '2,4s/^# *//p' "$0"; exit 0 ;;
  -*) echo "build_site.sh: unknown option '$1'; usage: scripts/build_site.sh [FOLDER]" >&2; exit 2 ;;
esac
folder=$(realpath -m "${1:-$root/build/site}")

if ! /usr/bin/python3 -c 'import mkdocs, material' 2>/dev/null; then
  echo "build_site.sh: mkdocs-material is missing: apt-get install --no-install-recommends mkdocs-material" >&2
  exit 2
fi

pages=$folder/pages
rm -rf "$pages"
mkdir -p "$pages/materials"
for part in README.md CONTRIBUTING.md CHANGELOG.md LICENSE docs cases materials/data; do
  if [[ -e $root/$part ]]; then ln -s "$root/$part" "$pages/$part"; fi
done
cd "$root"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
if ! UNDEX_SITE_PAGES=$pages UNDEX_SITE_HTML=$folder/html /usr/bin/python3 -W ignore -m mkdocs build --clean --strict >"$log" 2>&1; then
  grep -v '^INFO' "$log" >&2
  exit 1
fi
echo "Site: $folder/html/index.html"
