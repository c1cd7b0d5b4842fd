#!/bin/sh
# Instructions per particle-step of an elastic block (see src/elastic_block.rs), which do not depend on what else the machine does.
# usage: benches/instructions.sh [transfer [limit]]; fails where there are more than `limit`. Without valgrind there is nothing to do.
set -eu
transfer=${1:-apic}
limit=${2:-}
command -v valgrind > /dev/null || { echo "valgrind is not installed: nothing counted"; exit 0; }
cd "$(dirname "$0")/.."
cargo build --release --quiet -p parvi-benches --bin time_mechanics
program=${CARGO_TARGET_DIR:-target}/release/time_mechanics
cells=12
few=2
many=8

count() {
    RAYON_NUM_THREADS=1 valgrind --tool=callgrind --callgrind-out-file=/dev/null \
        "$program" "$transfer" sorted "$cells" 0 "$1" 2>&1 | sed -n 's/.*Collected : //p'
}

particles=$((8 * cells * cells * cells))
each=$((($(count $many) - $(count $few)) / ((many - few) * particles)))
echo "transfer=$transfer particles=$particles instructions_per_particle_step=$each"
if [ -n "$limit" ] && [ "$each" -gt "$limit" ]; then
    echo "more than $limit" >&2
    exit 1
fi
