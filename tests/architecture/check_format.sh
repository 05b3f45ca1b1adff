#!/usr/bin/env bash
# Fails where clang-format 14 would lay out a C++ file of the project at ROOT in another way (.clang-format), and says how.
# Exit code 77: skipped, for want of that version: others lay out a few lines differently.   check_format.sh ROOT
set -euo pipefail
cd "$1"
tool=$(command -v clang-format-14 || command -v clang-format || true)
if [[ -z $tool ]] || ! "$tool" --version | grep -q 'version 14\.'; then
  echo "skipped: no clang-format 14 (scripts/install_packages.sh)"
  exit 77
fi
mapfile -t files < <(find . -path ./build -prune -o -path ./out -prune -o \( -name '*.cpp' -o -name '*.hpp' \) -print | sort)
((${#files[@]} > 100)) || { echo "only ${#files[@]} C++ files below $PWD: not the project"; exit 1; }
if ! "$tool" --dry-run -Werror "${files[@]}"; then
  echo "mend it: clang-format -i \$(git ls-files '*.cpp' '*.hpp')"
  exit 1
fi
if grep -Hn '.\{131,\}' "${files[@]}" | grep '//'; then
  echo "comments beyond column 130: lay them out by hand"
  exit 1
fi
echo "${#files[@]} files are laid out as .clang-format says"
