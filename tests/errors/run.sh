#!/bin/sh
# Checks that the program answers each broken case of this folder with exactly the expected text.
#
#   tests/errors/run.sh GANNET             compare; prints "N passed, M failed"
#   tests/errors/run.sh GANNET --update    write the answers as the expected texts (then read them!)
#
# NN_what.yaml is the broken case, NN_what.txt what `gannet check NN_what.yaml` must print (standard
# output and errors, files named from the root of the repository), and NN_what.args, where there is one, one more option and its value. The exit
# code must be 2 (wrong input), and no file may appear.
set -u
if [ $# -lt 1 ]; then
  echo "usage: $0 GANNET [--update]" >&2
  exit 64
fi
gannet=$(command -v "$1") || { echo "$0: there is no program '$1'" >&2; exit 64; }
gannet=$(realpath "$gannet")
mode=${2:-}
cd "$(dirname "$0")/../.." || exit 64
folder=tests/errors
actual=$(mktemp) || exit 64
printed=$(mktemp) || exit 64
trap 'rm -f "$actual" "$printed"' EXIT

files() { find "$folder" . -maxdepth 1 | sort; }

# Puts what the program prints for a case into $actual, and its exit code into $code.
answer() {
  options="${1%.yaml}.args"
  if [ -f "$options" ]; then
    # "--set key=value with spaces": the option up to the first space, then its value.
    read -r option value < "$options"
    "$gannet" check "$1" "$option" "$value" > "$printed" 2>&1
  else
    "$gannet" check "$1" > "$printed" 2>&1
  fi
  code=$?
  sed "s|$PWD/||g" "$printed" > "$actual"
}

passed=0
failed=0
fail() {
  failed=$((failed + 1))
  echo "FAILED $1: $2"
}

before=$(files)
for case in "$folder"/*.yaml; do
  expected="${case%.yaml}.txt"
  answer "$case"
  if [ "$code" -ne 2 ]; then
    fail "$case" "exit code $code in place of 2"
    cat "$actual"
  elif [ "$mode" = --update ]; then
    cp "$actual" "$expected"
    passed=$((passed + 1))
  elif ! difference=$(diff "$expected" "$actual" 2>&1); then
    fail "$case" "another answer than expected (<) came (>)"
    echo "$difference"
  else
    passed=$((passed + 1))
  fi
done
if [ "$mode" != --update ] && [ "$before" != "$(files)" ]; then
  fail "$folder" "a file was written"
fi
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
