#!/bin/sh
# sh examples/paper.sh [PAGE]: every name of paper.md with the file and line of its definition: of a type, else of a function, else its first
# use outside comments.
# A name that is gone is told, and the exit code is 1.
cd "$(dirname "$0")"
status=0
grep -E -o '^## .*|\[`[A-Za-z_0-9]+`\]\([^)]*\)' "${1:-paper.md}" | tr -d '[]`()' | {
  while IFS= read -r row; do
    case $row in
    '## '*) echo "$row" ;;
    *)
      name=${row%%../*} file=../${row#*../}
      end='([^A-Za-z_0-9]|$)'
      for pattern in "(struct|class|concept|using) $name$end" "[]A-Za-z_0-9>&*] $name[(]" "(^|[^A-Za-z_0-9])$name$end"; do
        line=$(sed 's|//.*||; s|^#.*||' "$file" 2>/dev/null | grep -n -E -- "$pattern" | head -n 1)
        [ -z "$line" ] || break
      done
      if [ -n "$line" ]; then
        echo "${file#../}:${line%%:*}: $name"
      else
        echo "$name is not in ${file#../}" >&2
        status=1
      fi
      ;;
    esac
  done
  exit $status
}
