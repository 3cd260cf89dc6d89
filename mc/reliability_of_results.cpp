#include "mc/reliability_of_results.hpp"

#include <algorithm>
#include <stdexcept>

#include "mc/philox.hpp"  // Group

namespace gearpod::mc {
namespace {

constexpr const char* kFaultSize = "fault_depth_m";

// Rows of one group, `width` values each.
std::vector<double> rows_of(const std::vector<double>& values, const std::vector<int>& group,
                            Group which, std::size_t width) {
    std::vector<double> out;
    for (std::size_t row = 0; row < group.size(); ++row) {
        if (group[row] == static_cast<int>(which)) {
            const auto first = values.begin() + static_cast<std::ptrdiff_t>(row * width);
            out.insert(out.end(), first, first + static_cast<std::ptrdiff_t>(width));
        }
    }
    return out;
}

}  // namespace

analysis::Reliability reliability_of(const Results& results, const std::string& condition) {
    struct Split {
        std::vector<double> healthy, graded;
    };
    const auto split = [&](const std::vector<double>& values, std::size_t width) {
        return Split{rows_of(values, results.group, Group::threshold, width),
                     rows_of(values, results.group, Group::graded, width)};
    };
    Split size = split(std::vector<double>(results.group.size(), 0.0), 1);
    std::vector<Split> parameters, features;
    for (const ParameterResult& parameter : results.parameters) {
        parameters.push_back(split(parameter.values, 1));
    }
    for (const FeatureResult& feature : results.features) {
        features.push_back(split(feature.values, results.noise_levels.size()));
    }
    analysis::ReliabilityData data;
    std::string names;
    for (std::size_t p = 0; p < parameters.size(); ++p) {
        const ParameterResult& parameter = results.parameters[p];
        if (parameter.name == kFaultSize) {
            size = parameters[p];
            continue;
        }
        names += (names.empty() ? "" : ", ") + parameter.name;
        data.inputs.push_back({parameter.name, parameter.unit, parameters[p].graded});
        if (parameter.name == condition) {
            data.condition.push_back(
                {parameter.name, parameter.unit, parameters[p].healthy, parameters[p].graded});
        }
    }
    if (!condition.empty() && data.condition.empty()) {
        throw std::runtime_error("\"" + condition + "\" is no random input of this file; it has " +
                                 (names.empty() ? "none" : names));
    }
    data.healthy_size = size.healthy;
    data.graded_size = size.graded;
    for (std::size_t f = 0; f < features.size(); ++f) {
        data.features.push_back({results.features[f].name, results.features[f].alarm,
                                 features[f].healthy, features[f].graded});
    }
    return analysis::assess_reliability(data, results.detection, results.request);
}

}  // namespace gearpod::mc
