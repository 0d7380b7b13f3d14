#!/usr/bin/env bash
# Formats all headers and sources as .clang-format says.
#
# Usage: scripts/format.sh            changes the files
#        scripts/format.sh --check    names the files that would change; exit status 1 if there are any
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

mapfile -t files < <(find core hal drivers board tests \( -name '*.h' -o -name '*.cpp' \) | sort)
if [ "${1:-}" != --check ]; then
  clang-format -i "${files[@]}"
  exit 0
fi

if messages=$(clang-format --dry-run --Werror "${files[@]}" 2>&1); then
  exit 0
fi
wrong=$(sed -n 's/^\([^: ]*\):[0-9]*:[0-9]*: error: .*/\1/p' <<< "$messages" | sort -u)
if [ -z "$wrong" ]; then
  echo "clang-format failed: $messages" >&2
else
  echo "not formatted:" $wrong
fi
exit 1
