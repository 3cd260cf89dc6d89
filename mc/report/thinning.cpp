#include "mc/report/thinning.hpp"

#include <algorithm>
#include <numeric>

namespace gearpod::mc {
namespace {

std::vector<std::size_t> all_of(std::size_t count) {
    std::vector<std::size_t> indices(count);
    std::iota(indices.begin(), indices.end(), std::size_t{0});
    return indices;
}

// Calls use(first, last) for `count` intervals of about equal length.
template <typename Use>
void for_each_stretch(std::span<const double> values, std::size_t count, Use use) {
    for (std::size_t s = 0; s < count; ++s) {
        use(values.begin() + static_cast<std::ptrdiff_t>(s * values.size() / count),
            values.begin() + static_cast<std::ptrdiff_t>((s + 1) * values.size() / count));
    }
}

}  // namespace

std::vector<std::size_t> extremes(std::span<const double> values, std::size_t most) {
    if (values.size() <= most) {
        return all_of(values.size());
    }
    std::vector<std::size_t> kept;
    for_each_stretch(values, most / 2, [&](auto first, auto last) {
        const auto [low, high] = std::minmax_element(first, last);
        kept.push_back(static_cast<std::size_t>(std::min(low, high) - values.begin()));
        if (low != high) {
            kept.push_back(static_cast<std::size_t>(std::max(low, high) - values.begin()));
        }
    });
    return kept;
}

std::vector<std::size_t> maxima(std::span<const double> values, std::size_t most) {
    if (values.size() <= most) {
        return all_of(values.size());
    }
    std::vector<std::size_t> kept;
    for_each_stretch(values, most, [&](auto first, auto last) {
        kept.push_back(static_cast<std::size_t>(std::max_element(first, last) - values.begin()));
    });
    return kept;
}

}  // namespace gearpod::mc
