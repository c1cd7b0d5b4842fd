#!/bin/sh
# Instructions per particle-step, which do not depend on what else the machine does, against those of benches/instructions.json.
# usage: benches/instructions.sh [--write] [case...]; all cases of the file without any. Fails where a count is more than 5 % off: above, the step has
# become slower; below, the file is out of date. --write puts the counts into the file. Without valgrind nothing is counted.
#
# Cases are transfers of an elastic block (src/bin/time_mechanics.rs), bases of a gas (src/bin/step_gas.rs) or meshes of triangles and tetrahedra with 1.3 particles per
# cell that has any (src/bin/time_mesh.rs, APIC; exact2 and exact3 with exact gradients). Callgrind knows no AVX-512: the programs are
# built for x86-64-v3 as .cargo/config.toml says, and counts of other targets or compilers do not compare.
set -eu
cd "$(dirname "$0")/.."
list=benches/instructions.json
command -v valgrind > /dev/null || { echo "skipped: valgrind is not installed, no instructions counted"; exit 0; }
[ "$(uname -m)" = x86_64 ] || { echo "skipped: $list is of x86-64"; exit 0; }
write=
if [ "${1:-}" = --write ]; then
    write=yes
    shift
fi
known=$(sed -n 's/^ *"\([a-z0-9]*\)": *\([0-9]*\),*$/\1=\2/p' "$list")
[ $# -gt 0 ] || set -- $(echo "$known" | cut -d= -f1)
cargo build --release --quiet -p parvi-benches --bin time_mechanics --bin step_gas --bin time_mesh
programs=${CARGO_TARGET_DIR:-target}/release
cells=12
particles=$((8 * cells * cells * cells))
few=2
many=8

# Instructions of a run of so many steps.
count() {
    case $1 in
        mesh2) set -- "$programs/time_mesh" 2 0.02 1 "$2" ;;
        mesh3) set -- "$programs/time_mesh" 3 0.12 1 "$2" ;;
        exact2) set -- "$programs/time_mesh" 2 0.02 1 "$2" exact ;;
        exact3) set -- "$programs/time_mesh" 3 0.12 1 "$2" exact ;;
        grid* | lattice*) set -- "$programs/step_gas" "$1" "$particles" "$2" ;;
        *) set -- "$programs/time_mechanics" "$1" sorted "$cells" 0 "$2" ;;
    esac
    RAYON_NUM_THREADS=1 valgrind --tool=callgrind --callgrind-out-file=/dev/null "$@" 2>&1 | sed -n 's/.*Collected : //p'
}

# Particles of a run.
size() {
    case $1 in
        mesh2 | exact2) echo 2330 ;;
        mesh3 | exact3) echo 1800 ;;
        *) echo "$particles" ;;
    esac
}

failed=0
for case in "$@"; do
    each=$((($(count "$case" $many) - $(count "$case" $few)) / ((many - few) * $(size "$case"))))
    expected=$(echo "$known" | sed -n "s/^$case=//p")
    verdict="was ${expected:-not in the file}"
    if [ -n "$write" ]; then
        sed -i "s/\"$case\": *[0-9]*/\"$case\": $each/" "$list"
    elif [ -z "$expected" ] || [ $((100 * each)) -gt $((105 * expected)) ] || [ $((100 * each)) -lt $((95 * expected)) ]; then
        verdict="$verdict, more than 5 % off"
        failed=1
    fi
    echo "$case: $each instructions per particle-step ($verdict)"
done
exit $failed
