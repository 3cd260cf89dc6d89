#!/bin/sh
# Checks that an effect which a scene lacks leaves no instructions in its kernel. The plainest
# kernel is compiled from the sources, and from a copy without the compile-time branches of the
# missing effects. Both must have the same code.
#   check_absent_effects.sh COMPILER TOP-FOLDER EIGEN-INCLUDES
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp -r "$2/src" "$work/src"

cat > "$work/plain.cpp" <<'END'
#include "dynamics/planetary_motion.hpp"
#include "lockstep/integrators/runge_kutta.hpp"
#include "lockstep/integrators/sdirk3.hpp"
namespace gearpod::lockstep {
__attribute__((target("arch=x86-64-v3"))) void explicit_4(
    const IntegrationPlan& plan, const dynamics::PlanetaryLanes<4>& lanes,
    const machine::AlignedVector& filter, const MeshOverrides& overrides,
    TileState& state, MeshRecord& record) {
    integrate_mesh<RungeKutta4, dynamics::TorsionalMotion<dynamics::LinearMesh, 4>>(
        plan, lanes, filter, overrides, state, record);
}
__attribute__((target("arch=x86-64-v3"))) void implicit_4(
    const IntegrationPlan& plan, const ImplicitLanes<4>& lanes, const machine::AlignedVector& filter,
    const MeshOverrides& overrides, TileState& state, MeshRecord& record) {
    integrate_mesh<Sdirk3, MatrixMotion<dynamics::LinearMesh, 4>>(plan, lanes, filter, overrides,
                                                                  state, record);
}
}  // namespace gearpod::lockstep
END

code() {
    "$1" -std=c++20 -O3 -ffp-contract=off -fopenmp-simd -fno-trapping-math -fno-math-errno \
        -isystem "$2" -I"$work/src" -c "$work/plain.cpp" -o "$work/plain.o"
    objdump -d --no-show-raw-insn "$work/plain.o" | tail -n +4
}
code "$1" "$3" > "$work/as-they-are"

# Branches "if constexpr (...) {" of transmission errors, separation and varying forces, up to the
# closing brace at the same depth.
cut=$(awk '
    /if constexpr \((Model::Mesh::k|requires \{ (m[.]row|Model::add_forces))/ {
        match($0, /^ */); depth = RLENGTH; inside = 1; ++blocks; next
    }
    inside { match($0, /^ */)
        if (RLENGTH == depth && $0 ~ /^ *} else {/) { inside = 0; rest = 1 }
        else if (RLENGTH == depth && $0 ~ /^ *}/) inside = 0
        next }
    rest && /^ *}/ { match($0, /^ */); if (RLENGTH == depth) { rest = 0; next } }
    { print > FILENAME ".cut" }
    END { print blocks }' "$work/src/lockstep/integrators/integration_steps.hpp" "$work/src/lockstep/integrators/implicit_stage.hpp")
for header in integration_steps implicit_stage; do
    mv "$work/src/lockstep/integrators/$header.hpp.cut" "$work/src/lockstep/integrators/$header.hpp"
done
if [ "$cut" -lt 11 ]; then
    echo "only $cut branches of effects found; eleven are known"
    exit 1
fi
code "$1" "$3" > "$work/cut"
wc -l < "$work/cut"
if ! cmp -s "$work/as-they-are" "$work/cut"; then
    diff "$work/as-they-are" "$work/cut" | head -40
    echo "effects that are absent leave instructions"
    exit 1
fi
