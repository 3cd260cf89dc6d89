#include "rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace gearpod::peers {

std::unique_ptr<mc::Scene> scene_of(const Options& options,
                                    const std::vector<std::string>& overrides) {
    const mc::StudyReading reading = mc::read_study(options.study, overrides);
    if (!reading.study) {
        throw std::runtime_error(mc::format(reading.problems));
    }
    return std::make_unique<mc::Scene>(*reading.study);
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

std::string ratio_text(const Row& row, const Row& to, double scale) {
    std::vector<double> all;
    for (std::size_t i = 0; i < row.times.size(); ++i) {
        all.push_back(scale * row.times[i] / to.times[i]);
    }
    std::sort(all.begin(), all.end());
    return fmt::format("{:>9.3g} ({:.3g}..{:.3g})", median(all), all.front(), all.back());
}

}  // namespace gearpod::peers
