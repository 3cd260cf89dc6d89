#include "analysis/report/detection_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "analysis/detection/reliable_size.hpp"
#include "analysis/report/text_lines.hpp"

namespace gearpod::analysis {
namespace {

using Features = std::span<const FeatureDetection>;

constexpr std::size_t kSizeWidth = 13;  // width of "12.00-14.00" and a gap
constexpr std::size_t kCountWidth = 9;  // number of gearboxes or recordings, and number failed
constexpr std::size_t kLabelWidth = kSizeWidth + 2 * kCountWidth;
constexpr std::size_t kCellWidth = 20;  // width of "0.98 [0.96, 0.99]" and a gap
constexpr double kSmallRate = 0.01;     // below it three decimals are too few

std::string size_text(const SizeGroup& size, const SizeUnit& unit) {
    const double low = size.low / unit.per_unit(), high = size.high / unit.per_unit();
    return low == high ? fmt::format("{:.4g}", high) : fmt::format("{:.4g}-{:.4g}", low, high);
}

std::string rate_text(const DetectionCell& cell) {
    return std::isnan(cell.pd)
               ? std::string("-")
               : fmt::format("{:.2f} [{:.2f}, {:.2f}]", cell.pd, cell.lower, cell.upper);
}

std::string threshold_text(const FeatureDetection& feature, const LevelDetection& level) {
    return std::isnan(level.threshold)
               ? std::string("none")
               : fmt::format("{} {:.5g}", alarm_symbol(feature.alarm), level.threshold);
}

std::size_t column_width(Features features) {
    std::size_t width = kCellWidth;
    for (const FeatureDetection& feature : features) {
        width = std::max(width, feature.feature.size() + 2);
    }
    return width;
}

// Adds a label and one right-aligned cell per feature.
template <typename CellText>
void add_row(std::string& out, const std::string& label, Features features, CellText text) {
    const std::size_t width = column_width(features);
    std::string line = fmt::format("{:<{}}", label, kLabelWidth);
    for (const FeatureDetection& feature : features) {
        line += fmt::format("{:>{}}", text(feature), width);
    }
    out += line + '\n';
}

// Failures may differ between features: the row shows the largest number, the JSON all.
long most_failed(Features features, std::size_t level, std::size_t cell) {
    long failed = 0;
    for (const FeatureDetection& feature : features) {
        failed = std::max(failed, feature.levels[level].cells[cell].failed);
    }
    return failed;
}

void add_level(std::string& out, Features features, std::size_t n, const DetectionRequest& request,
               Subject subject) {
    const SizeUnit& unit = request.size;
    const bool per_gearbox = subject == Subject::gearboxes;
    add_row(out,
            fmt::format("{:<{}}{:>{}}{:>{}}",
                        has_sizes(request) ? "size " + unit.shown_unit() : kNoSize, kSizeWidth,
                        per_gearbox ? "gearboxes" : "records", kCountWidth, "failed", kCountWidth),
            features, [](const FeatureDetection& f) { return f.feature; });
    add_row(out, "alarm if", features,
            [n](const FeatureDetection& f) { return threshold_text(f, f.levels[n]); });
    const char* healthy = !per_gearbox                    ? "healthy: alarms/recordings"
                          : request.threshold_records > 1 ? "healthy: alarms/records"
                                                          : "healthy: alarms/gearboxes";
    add_row(out, healthy, features, [n](const FeatureDetection& f) {
        return fmt::format("{}/{}", f.levels[n].threshold_alarms, f.levels[n].threshold_sample);
    });
    add_row(out, "false-alarm rate, interval", features, [n](const FeatureDetection& f) {
        const Interval& rate = f.levels[n].threshold_rate;
        return std::isnan(rate.lower)    ? std::string("-")
               : rate.upper < kSmallRate ? fmt::format("[{:.1e}, {:.1e}]", rate.lower, rate.upper)
                                         : fmt::format("[{:.3f}, {:.3f}]", rate.lower, rate.upper);
    });
    const auto beyond = [n](const FeatureDetection& f) { return f.levels[n].tail.has_value(); };
    if (std::any_of(features.begin(), features.end(), beyond)) {
        add_row(out, "extrapolated, values fitted", features, [&](const FeatureDetection& f) {
            return beyond(f) ? fmt::format("{:.2g} times, {}", f.levels[n].tail->extrapolation,
                                           f.levels[n].tail->choices.front().exceedances)
                             : std::string("no");
        });
    }
    if (std::any_of(features.begin(), features.end(), [n](const FeatureDetection& f) {
            return f.levels[n].importance_sampled.has_value();
        })) {
        add_row(out, "importance sampling, gearboxes", features, [n](const FeatureDetection& f) {
            const auto& importance_sampled = f.levels[n].importance_sampled;
            return importance_sampled
                       ? fmt::format("{:.0f} of {}", importance_sampled->contributing,
                                     importance_sampled->gearboxes)
                       : std::string("no");
        });
    }
    const std::vector<DetectionCell>& cells = features.front().levels[n].cells;
    for (std::size_t c = 0; c < cells.size(); ++c) {
        const std::string label = fmt::format(
            "{:<{}}{:>{}}{:>{}}", has_sizes(request) ? size_text(cells[c].size, unit) : "faulty",
            kSizeWidth, cells[c].tested + cells[c].failed, kCountWidth, most_failed(features, n, c),
            kCountWidth);
        add_row(out, label, features,
                [n, c](const FeatureDetection& f) { return rate_text(f.levels[n].cells[c]); });
    }
}

void add_reliable_sizes(std::string& out, Features features, const SizeUnit& unit,
                        Subject subject) {
    const bool noise = subject == Subject::gearboxes;
    add_row(out, noise ? "noise" : "", features,
            [](const FeatureDetection& f) { return f.feature; });
    for (std::size_t n = 0; n < features.front().levels.size(); ++n) {
        add_row(out, noise ? fmt::format("x {:g}", features.front().levels[n].noise_level) : "size",
                features, [n, &unit](const FeatureDetection& f) {
                    if (std::isnan(f.levels[n].threshold)) {
                        return std::string("no threshold");
                    }
                    const auto size = reliable_size(f.levels[n], kReliablePd);
                    if (!size) {
                        return std::string("not reached");
                    }
                    const std::string shown = unit.shown_unit();
                    return size_text(*size, unit) + (shown.empty() ? "" : " " + shown);
                });
    }
}

// Prints a warning shared by several features once.
void add_warnings(std::string& out, Features features) {
    std::vector<std::string> order;
    std::map<std::string, std::string> names;
    for (const FeatureDetection& feature : features) {
        for (const std::string& warning : feature.warnings) {
            std::string& list = names[warning];
            if (list.empty()) {
                order.push_back(warning);
            }
            list += (list.empty() ? "" : ", ") + feature.feature;
        }
    }
    for (const std::string& warning : order) {
        add_wrapped(out, fmt::format("warning: {} ({})", warning, names[warning]), 4);
    }
}

// Prints as many features side by side as fit the width, in blocks separated by an empty line.
template <typename Block>
void in_blocks(std::string& out, Features features, Block block) {
    const std::size_t fit =
        std::max<std::size_t>(1, (text_width() - kLabelWidth) / column_width(features));
    for (std::size_t first = 0; first < features.size(); first += fit) {
        out += '\n';
        block(features.subspan(first, std::min(fit, features.size() - first)));
    }
}

}  // namespace

std::string detection_text(Features features, const DetectionRequest& request, Subject subject) {
    std::string out;
    if (features.empty() || features.front().levels.empty()) {
        return "no detection rates: no features or no noise levels\n";
    }
    out += fmt::format(
        "Detection rates Pd [lower, upper] at {:g} % confidence (Wilson);\n"
        "thresholds for at most {:g} % expected false alarms\n",
        100.0 * request.confidence, 100.0 * request.false_alarm_rate);
    for (std::size_t n = 0; n < features.front().levels.size(); ++n) {
        if (subject == Subject::gearboxes) {
            out += fmt::format("\nNoise x {:g}\n", features.front().levels[n].noise_level);
        }
        in_blocks(out, features,
                  [&](Features block) { add_level(out, block, n, request, subject); });
    }
    if (has_sizes(request)) {
        out += fmt::format(
            "\nSmallest tested size at and above which the lower bound of Pd is at least {:g}\n",
            kReliablePd);
        in_blocks(out, features,
                  [&](Features block) { add_reliable_sizes(out, block, request.size, subject); });
    }
    add_warnings(out, features);
    return out;
}

}  // namespace gearpod::analysis
