#!/usr/bin/env bash
# The site is built without a warning, its links lead somewhere, and it loads nothing from the network.
# Usage: site_test.sh PROJECT FOLDER. Ends with 77 (skipped) where mkdocs is not installed.
set -euo pipefail
/usr/bin/python3 -c 'import mkdocs, material' 2>/dev/null || exit 77
"$1/scripts/build_site.sh" "$2"
/usr/bin/python3 "$1/tests/site/check_links.py" site "$2/html"
