#include "tolerance_search.hpp"

#include <cmath>

namespace gearpod::peers {
namespace {

// Limits in half decades: 10^(-n / 2).
constexpr int kLoosest = 2, kFirst = 6, kTightest = 18;

}  // namespace

std::optional<Attempt> loosest_tolerance(const Trial& trial) {
    const auto at = [&](int n) { return trial(std::pow(10.0, -0.5 * n)); };
    const auto good = [](const std::optional<Attempt>& a) { return a && a->within; };
    int n = kFirst;
    std::optional<Attempt> best = at(n);
    if (good(best)) {
        for (std::optional<Attempt> looser; n - 2 >= kLoosest; n -= 2, best = looser) {
            if (looser = at(n - 2); !good(looser)) {
                break;
            }
        }
    } else {
        while (best && !good(best) && n + 2 <= kTightest) {
            const std::optional<Attempt> tighter = at(n + 2);
            if (!tighter) {  // a tighter one would take longer
                break;
            }
            n += 2;
            best = tighter;
        }
    }
    if (good(best) && n - 1 >= kLoosest) {
        if (const std::optional<Attempt> half = at(n - 1); good(half)) {
            best = half;
        }
    }
    return best;
}

}  // namespace gearpod::peers
