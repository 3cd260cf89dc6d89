#include "peer_operations.hpp"

#include <array>

#include "gearbox.hpp"
#include "tests/bench/counted.hpp"

namespace gearpod::peers {
namespace {

using bench::Counted;
using bench::Operations;

template <int Size>
double flop() {
    const Gearbox<Counted> gearbox{};
    const Meshes<Counted> meshes{};
    const std::array<Counted, Size> y{};
    std::array<Counted, Size> dy;
    Operations::done() = {};
    rates<Size>(gearbox, meshes, y.data(), dy.data());
    constexpr double kSums = 1 + 2 + 3 + 4;
    return 4.0 * static_cast<double>(Operations::done().flop()) + 2.0 * kSums * Size;
}

}  // namespace

double rk4_flop(bool motion_only) {
    return motion_only ? flop<kMotionStates>() : flop<kSensing>();
}

}  // namespace gearpod::peers
