#!/bin/sh
# Writes dlib_surf.txt and colour_motion.txt anew from the recordings.
set -eu
oracle=$(cd "$(dirname "$0")" && pwd)
images=$(mktemp -d)
trap 'rm -r "$images"' EXIT

count=600
# Far below the weakest of the 600 in any frame: the count decides, not the threshold.
threshold=1

make -C "$oracle" >&2
dlib=$oracle/dlib_surf
(cd "$oracle/.." && cargo run --release --quiet --example luma_pgm -- "$images")

cd "$images"
{
    echo "# $($dlib version): the $count strongest points above $threshold (x_px y_px scale_px), and matches (indices)."
    for image in *.pgm; do
        echo "points ${image%.pgm}"
        $dlib points "$image" $count $threshold | cut -d ' ' -f 1-3
    done
    while read -r from to; do
        echo "matches $from $to"
        $dlib match "$from.pgm" "$to.pgm" $count $threshold | cut -d ' ' -f 1-2
    done <pairs.txt
} >"$oracle/dlib_surf.txt"

"${PYTHON:-python3}" "$oracle/colour_motion.py" "${SUNBLIND_DATA:-$oracle/../../../shared/data}" pairs.txt \
    >"$oracle/colour_motion.txt"
