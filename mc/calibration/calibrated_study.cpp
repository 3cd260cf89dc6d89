// Implements calibrated_study().
#include <fmt/format.h>

#include <algorithm>

#include "mc/calibration/calibrate.hpp"

namespace gearpod::mc {
namespace {

// TOML text of an empirical distribution whose inputs are drawn jointly, row by row. This keeps the
// correlations between inputs that the calibration found.
std::string distribution_of(const std::vector<double>& samples) {
    std::string values;
    for (const double value : samples) {
        values += fmt::format("{}{:.5g}", values.empty() ? "" : ", ", value);
    }
    return fmt::format("{{ distribution = \"empirical\", rows = 1, values = [{}] }}", values);
}

std::string comment_of(const CalibrationResult& result, std::size_t p) {
    const InputPosterior& found = result.found[p];
    std::string text =
        fmt::format("# median {:.4g}, 90 % interval {:.4g} to {:.4g} (prior {:g} to {:g}{})",
                    found.median, found.low, found.high, found.input.low, found.input.high,
                    found.input.logarithmic ? ", log" : "");
    text += found.is_informed ? "\n" : ": THE RECORDINGS DO NOT DETERMINE IT, this is the prior\n";
    if (found.is_informed && !found.strongest_summaries.empty()) {
        text +=
            fmt::format("# most correlated with {}\n", fmt::join(found.strongest_summaries, ", "));
    }
    for (const CorrelatedPair& pair : result.pairs) {
        if (pair.first == p || pair.second == p) {
            const std::size_t other = pair.first == p ? pair.second : pair.first;
            text += fmt::format(
                "# determined only together with {}, rank correlation {:+.2f}: sampled in rows\n",
                result.found[other].input.key, pair.correlation);
        }
    }
    return text;
}

}  // namespace

std::string calibrated_study(const Study& study, const CalibrationResult& result,
                             const std::vector<std::string>& intro) {
    std::string out;
    for (const std::string& line : intro) {
        out += "# " + line + "\n";
    }
    std::string found;
    for (std::size_t p = 0; p < result.found.size(); ++p) {
        found += comment_of(result, p);
        found +=
            fmt::format("{} = {}\n", result.found[p].input.key, distribution_of(result.samples[p]));
    }
    // The sample replaces the study's own distributions of these inputs.
    Study kept = study;
    kept.detection.uncertain_inputs.clear();
    for (const InputPosterior& one : result.found) {
        kept.detection.uncertain_inputs.push_back(one.input.key);
    }
    std::erase_if(kept.random, [&](const RandomInput& one) {
        return std::ranges::any_of(result.found,
                                   [&](const InputPosterior& f) { return f.input.key == one.key; });
    });
    std::string text = resolved_text(kept);
    const std::string section = "[random]\n";
    const std::size_t at = text.find("\n" + section);
    if (at == std::string::npos) {
        const std::size_t features = text.find("\n[features]");
        text.insert(features == std::string::npos ? text.size() : features, "\n" + section + found);
    } else {
        text.insert(at + 1 + section.size(), found);
    }
    return out + text;
}

}  // namespace gearpod::mc
