#!/bin/sh
# forces.sh NODES FORCES [OPTION...]: run lmp on displaced nodes; options go to lmp.
set -e
nodes=$1 forces=$2 folder=$(dirname "$2")
shift 2
awk -F, 'NR == 1 { z = /uz/ }
         NR > 1 && z  { printf "set atom %s x %.17g y %.17g z %.17g\n", $1, $2 + $5, $3 + $6, $4 + $7 }
         NR > 1 && !z { printf "set atom %s x %.17g y %.17g\n", $1, $2 + $4, $3 + $5 }' \
  "$nodes" >"$folder/moved.lmp"
OMP_NUM_THREADS=1 lmp -in "$(dirname "$0")/forces.lmp" -log none -nocite -var folder "$folder" "$@"
sed -n '9,$ s/ITEM: ATOMS //; 9,$ p' "$folder/forces.dump" >"$forces"
