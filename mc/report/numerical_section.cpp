#include "mc/report/numerical_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/report/wording.hpp"
#include "mc/numerics/step_error.hpp"

namespace gearpod::mc {
namespace {

using analysis::number_text;

std::string error_size(double size, const analysis::SizeUnit& unit) {
    return std::isfinite(size) ? analysis::with_unit(size, unit, 2) : "-";
}

analysis::Table error_table(const Results& frame,
                            const std::vector<NumericalContribution>& contributions) {
    analysis::Table table{"numerical",
                          "Numerical error (rms, of Pd, of a90) and statistical error (half width "
                          "of the interval of Pd, distance of a90 from its upper bound)",
                          {"feature", "noise", "rms", "spread of healthy gearboxes", "of Pd",
                           "half width of Pd", "of a90", "a90 to its bound", "larger"},
                          {}};
    table.labels = 2;
    for (const NumericalContribution& one : contributions) {
        table.rows.push_back({one.feature, "x " + number_text(one.noise_level),
                              number_text(one.rms, 2), number_text(one.spread, 2),
                              number_text(one.pd, 2), number_text(one.pd_half_width, 2),
                              error_size(one.a90, frame.request.size),
                              error_size(one.a90_interval, frame.request.size),
                              one.numerical_dominates ? "numerical" : "statistical"});
    }
    return table;
}

// Share of the scatter of healthy gearboxes, with its standard error.
std::string share_text(double value, double error, double scatter) {
    return scatter > 0.0 && std::isfinite(value)
               ? fmt::format("{:+.3f} +-{:.3f}", value / scatter, error / scatter)
               : "-";
}

analysis::Table correction_table(const Results& frame,
                                 const std::vector<NumericalContribution>& contributions) {
    analysis::Table table{
        "correction",
        "Error of the run's steps over the scatter of healthy gearboxes (mean, standard error) and "
        "detection without it",
        {"feature", "noise", "of healthy", "of faulty", "scatter x", "change of Pd",
         "a90 corrected", "its 95 % interval"},
        {}};
    table.labels = 2;
    for (const NumericalContribution& one : contributions) {
        if (!one.correction) {
            continue;
        }
        const PairedCorrection& c = *one.correction;
        table.rows.push_back(
            {one.feature, "x " + number_text(one.noise_level),
             share_text(c.healthy_bias, c.healthy_error, one.spread),
             share_text(c.faulty_bias, c.faulty_error, one.spread), number_text(c.scatter_ratio, 3),
             number_text(one.corrected->pd_change, 2),
             error_size(one.corrected->a90, frame.request.size),
             std::isfinite(one.corrected->a90_lower)
                 ? error_size(one.corrected->a90_lower, frame.request.size) + " to " +
                       error_size(one.corrected->a90_upper, frame.request.size)
                 : "-"});
    }
    return table;
}

}  // namespace

analysis::Section numerical_section(const Results& frame,
                                    const std::vector<NumericalContribution>& contributions) {
    analysis::Section section{"numerical", "Numerical and statistical error", {}};
    if (frame.step_error) {
        section.state("step_error",
                      "Error of the time steps: " + step_error_text(*frame.step_error) + ".");
    }
    if (!frame.numerical) {
        section.state("numerical.none",
                      "The study requested no check of its numerical error (numerics.verify or "
                      "numerics.tolerance), so it cannot be compared with the statistical error.",
                      true);
        return section;
    }
    std::vector<std::string> dominated;
    for (const NumericalContribution& one : contributions) {
        if (one.numerical_dominates) {
            dominated.push_back(
                fmt::format("{} at noise x {}", one.feature, number_text(one.noise_level)));
        }
    }
    section.state(
        "numerical.text",
        fmt::format(
            "The run used {}; {} of its gearboxes were computed again with {}. {}",
            frame.numerical->setting, frame.numerical->gearboxes, frame.numerical->finer,
            dominated.empty()
                ? std::string("For every feature and noise level the statistical error is larger "
                              "than the numerical error: finer time steps would not help.")
                : fmt::format("The numerical error is larger than the statistical error for {}.",
                              analysis::joined(dominated))));
    section.add(error_table(frame, contributions));
    const NumericalError& error = *frame.numerical;
    if (error.corrections.empty()) {
        return section;
    }
    const std::string pairs =
        fmt::format("{} healthy and {} faulty gearboxes", error.healthy_pairs, error.faulty_pairs);
    if (std::min(error.healthy_pairs, error.faulty_pairs) < kFewestPairs) {
        section.state("numerical.correction",
                      fmt::format("{} were computed with and without these finer steps, too few to "
                                  "correct the others: at least {} of each are needed.",
                                  pairs, kFewestPairs));
        return section;
    }
    section.state("numerical.correction",
                  pairs +
                      " with and without these finer steps give the error of all: its mean in "
                      "healthy and in faulty gearboxes, and detection after the fitted "
                      "difference is added to every gearbox. The interval is that of the "
                      "correction alone.");
    section.add(correction_table(frame, contributions));
    return section;
}

std::string numerical_limit(const std::vector<NumericalContribution>& contributions,
                            const std::string& feature, double noise_level,
                            const analysis::SizeUnit& unit) {
    for (const NumericalContribution& one : contributions) {
        if (one.feature == feature && one.noise_level == noise_level && std::isfinite(one.pd) &&
            std::isfinite(one.pd_half_width)) {
            const std::string text = fmt::format(
                "Error of the detection rate: at most {} numerical and +-{} statistical.",
                number_text(one.pd, 2), number_text(one.pd_half_width, 2));
            return one.corrected && std::isfinite(one.corrected->a90)
                       ? text + fmt::format(
                                    " Without the error of the steps a90 would be {} ({} to "
                                    "{}).",
                                    error_size(one.corrected->a90, unit),
                                    error_size(one.corrected->a90_lower, unit),
                                    error_size(one.corrected->a90_upper, unit))
                       : text;
        }
    }
    return "";
}

}  // namespace gearpod::mc
