#!/bin/sh
# Gate for continuous integration: 'plumbline check' with its result as a JUnit file.
#   gate.sh JUNIT.xml NODES.csv BONDS.csv --scene SCENE.prm [options of plumbline check]
# The exit code is that of plumbline check: 0 as required, 1 not as required, 2 wrong input,
# 3 numerical failure. PLUMBLINE names the executable (default: plumbline).
set -u
if [ $# -lt 3 ]; then
  echo "gate.sh: needs JUNIT.xml NODES.csv BONDS.csv [options of plumbline check]" >&2
  exit 2
fi
junit=$1
shift
output=$(mktemp) || exit 2
trap 'rm -f "$output"' EXIT

"${PLUMBLINE:-plumbline}" check "$@" >"$output" 2>&1
code=$?
cat "$output"

# XML allows neither control characters nor bare &, <, > in text.
as_xml() { tr -d '\000-\010\013\014\016-\037' <"$output" | sed 's/&/\&amp;/g; s/</\&lt;/g; s/>/\&gt;/g'; }

# A property that does not hold is a failure; anything else that is not 0 is an error.
case $code in
  0) failures=0 errors=0 element=system-out attributes= ;;
  1) failures=1 errors=0 element=failure attributes=' message="the weights are not as required"' ;;
  *) failures=0 errors=1 element=error attributes=" message=\"plumbline check ended with exit code $code\"" ;;
esac
{
  echo '<?xml version="1.0" encoding="UTF-8"?>'
  echo "<testsuite name=\"plumbline check\" tests=\"1\" failures=\"$failures\" errors=\"$errors\">"
  echo '<testcase classname="plumbline" name="check">'
  echo "<$element$attributes>"
  as_xml
  echo "</$element>"
  echo '</testcase>'
  echo '</testsuite>'
} >"$junit" || { echo "gate.sh: cannot write $junit" >&2; exit 2; }
exit $code
