// calibrated_study(): what was found, as a study file.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "mc/calibration/calibrate.hpp"
#include "mc/study/schema/schema.hpp"

namespace gearpod::mc {
namespace {

constexpr double kDeviations = 2.0 * 1.6448536269514722;  // that a normal 90 % interval spans

// The distribution with that median and 90 % interval: lognormal where the prior was even in the
// logarithm and the key takes all of one, else normal between the prior's ends.
std::string distribution_of(const FoundInput& found) {
    const CalibratedInput& input = found.input;
    const std::size_t dot = input.key.find('.');
    const Key& key = *find_key(input.key.substr(0, dot), input.key.substr(dot + 1));
    if (input.logarithmic &&
        key.range.contains(Support{0.0, std::numeric_limits<double>::infinity(), true, true})) {
        const double sigma = std::log(found.high / found.low) / kDeviations;
        return fmt::format("{{ distribution = \"lognormal\", median = {:.6g}, cv = {:.4g} }}",
                           found.median, std::max(1e-6, std::sqrt(std::expm1(sigma * sigma))));
    }
    const double sd =
        std::max(1e-9 * std::abs(input.high - input.low), (found.high - found.low) / kDeviations);
    return fmt::format(
        "{{ distribution = \"truncated-normal\", mean = {:.6g}, sd = {:.4g}, low = {:g}, high = "
        "{:g} }}",
        found.median, sd, input.low, input.high);
}

std::string comment_of(const CalibrationResult& result, std::size_t p) {
    const FoundInput& found = result.found[p];
    std::string text =
        fmt::format("# found: {:.4g}, 90 % from {:.4g} to {:.4g} (prior {:g} to {:g}{})",
                    found.median, found.low, found.high, found.input.low, found.input.high,
                    found.input.logarithmic ? ", log" : "");
    text += found.told ? "\n" : ": THE RECORDINGS DO NOT TELL IT, this is the prior\n";
    if (found.told && !found.deciding.empty()) {
        text += fmt::format("# by {}\n", fmt::join(found.deciding, ", "));
    }
    for (const BoundPair& pair : result.pairs) {
        if (pair.first == p || pair.second == p) {
            const std::size_t other = pair.first == p ? pair.second : pair.first;
            text += fmt::format("# known together with {} alone, rank correlation {:+.2f}\n",
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
            fmt::format("{} = {}\n", result.found[p].input.key, distribution_of(result.found[p]));
    }
    // The study's own distributions of these inputs give way.
    Study kept = study;
    std::erase_if(kept.random, [&](const RandomInput& one) {
        return std::ranges::any_of(result.found,
                                   [&](const FoundInput& f) { return f.input.key == one.key; });
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
