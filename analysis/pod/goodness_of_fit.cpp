#include "analysis/pod/goodness_of_fit.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "analysis/statistics/upper_tail.hpp"

namespace gearpod::analysis {
namespace {

constexpr double kReplicates = 5.0;  // mean number of gearboxes per size to count as replicated
constexpr int kGroups = 10;

double excess(double count, double expected) {
    return count > 0.0 ? count * std::log(count / expected) : 0.0;
}

double saturated_statistic(const HitMissTable& table, const PodCurve& curve) {
    double sum = 0.0;
    for (const HitMissRow& row : table) {
        const double pod = curve.pod(row.size);
        sum += excess(row.hits, row.tests * pod) +
               excess(row.tests - row.hits, row.tests * (1.0 - pod));
    }
    return 2.0 * sum;
}

// Hosmer-Lemeshow statistic. A size is never split, so that the groups do not depend on the order
// of its gearboxes.
double grouped_statistic(const HitMissTable& table, const PodCurve& curve, int& groups) {
    const double tests = total_tests(table);
    double statistic = 0.0;
    double seen = 0.0, hits = 0.0, expected = 0.0, count = 0.0;
    groups = 0;
    for (std::size_t i = 0; i < table.size(); ++i) {
        hits += table[i].hits;
        expected += table[i].tests * curve.pod(table[i].size);
        count += table[i].tests;
        seen += table[i].tests;
        if (seen >= (groups + 1) * tests / kGroups || i + 1 == table.size()) {
            const double variance = expected * (1.0 - expected / count);
            if (variance > 0.0) {
                statistic += (hits - expected) * (hits - expected) / variance;
            }
            ++groups;
            hits = expected = count = 0.0;
        }
    }
    return statistic;
}

}  // namespace

GoodnessOfFit goodness_of_fit(const HitMissTable& table, const PodCurve& curve) {
    GoodnessOfFit fit;
    const auto sizes = static_cast<int>(table.size());
    const double tests = total_tests(table);
    fit.statistic = fit.p_value = std::numeric_limits<double>::quiet_NaN();
    double statistic = 0.0;
    if (tests >= kReplicates * sizes) {
        statistic = saturated_statistic(table, curve);
        fit.degrees = sizes - curve.form.parameters();
        fit.test = GoodnessOfFit::Test::saturated;
    } else {
        int groups = 0;
        statistic = grouped_statistic(table, curve, groups);
        fit.degrees = groups - curve.form.parameters();
        fit.test = GoodnessOfFit::Test::hosmer_lemeshow;
    }
    if (fit.degrees <= 0) {
        fit.test = GoodnessOfFit::Test::none;
        fit.degrees = 0;
        return fit;
    }
    fit.statistic = statistic;
    fit.p_value = chi_squared_upper_tail(statistic, fit.degrees);
    return fit;
}

std::string fit_text(const GoodnessOfFit& fit) {
    switch (fit.test) {
        case GoodnessOfFit::Test::saturated:
            return fmt::format("likelihood ratio against separate rates of all sizes: p = {:.2g}",
                               fit.p_value);
        case GoodnessOfFit::Test::hosmer_lemeshow:
            return fmt::format("Hosmer-Lemeshow: p = {:.2g}", fit.p_value);
        case GoodnessOfFit::Test::none:
            break;
    }
    return "fit not testable: too few sizes";
}

}  // namespace gearpod::analysis
