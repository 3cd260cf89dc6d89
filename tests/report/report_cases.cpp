#include "tests/report/report_cases.hpp"

#include <functional>
#include <limits>
#include <random>

#include "mc/results/result_rows.hpp"
#include "mc/study/random/philox.hpp"

namespace gearpod::tests {
namespace {

using namespace gearpod::mc;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// A random gearbox: its fault's size in m, its bearing stiffness, a standard normal number.
struct Drawn {
    double size, stiffness, normal;
};
using Law = std::function<double(const Drawn&, double noise)>;

struct Plan {
    int healthy = 400, test = 600;
    std::vector<double> sizes{0.0, 0.5e-3, 1e-3, 2e-3};
    std::vector<double> noise_levels{0.0, 1.0, 3.0};
    std::vector<std::pair<std::string, Law>> features;
    bool continuous = false;
    std::string size_name = "fault_depth_m", size_unit = "m";
};

// A sensitive feature: grows with the fault and the stiffness; its scatter grows with the noise.
double telling(const Drawn& gearbox, double noise) {
    return 4e3 * gearbox.size + (0.05 + noise) * gearbox.normal + 2e-9 * gearbox.stiffness;
}

Plan usual_plan() {
    Plan plan;
    plan.features = {{"window_ratio", telling},
                     {"te_rms", [](const Drawn& g, double) { return g.normal; }}};
    return plan;
}

Results drawn(const Plan& plan) {
    Results r;
    r.provenance = {{"code_version", "0"}, {"seed", "1"}, {"state", "complete"}};
    r.noise_levels = r.request.noise_levels = plan.noise_levels;
    r.request.size = {plan.size_name, plan.size_unit};
    if (plan.continuous) {
        const double largest = plan.sizes.back();
        r.request.groups = {{0.0, 0.5 * largest}, {0.5 * largest, largest}};
    } else {
        for (const double size : plan.sizes) {
            r.request.groups.push_back({size, size});
        }
    }
    r.parameters = {{"ring_bearing_stiffness_N_m", "N/m", {}},
                    {plan.size_name, plan.size_unit, {}}};
    for (const auto& [name, law] : plan.features) {
        r.features.push_back({name, "1", analysis::Alarm::high, {}});
    }
    std::mt19937_64 engine(7);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform;
    for (int row = 0; row < plan.healthy + plan.test; ++row) {
        const bool sets_threshold = row < plan.healthy;
        const double level = plan.sizes[static_cast<std::size_t>(row) % plan.sizes.size()];
        const double size = sets_threshold    ? 0.0
                            : plan.continuous ? plan.sizes.back() * uniform(engine)
                                              : level;
        const Drawn gearbox{size, 1e8 * (1.0 + 0.2 * normal(engine)), normal(engine)};
        r.group.push_back(static_cast<int>(sets_threshold ? Group::threshold : Group::test));
        r.status.push_back(0);
        r.parameters[0].values.push_back(gearbox.stiffness);
        r.parameters[1].values.push_back(gearbox.size);
        for (std::size_t f = 0; f < plan.features.size(); ++f) {
            for (const double noise : plan.noise_levels) {
                r.features[f].values.push_back(plan.features[f].second(gearbox, noise));
            }
        }
    }
    return r;
}

void fail_all(Results& r) {
    for (std::size_t row = 0; row < r.status.size(); ++row) {
        r.status[row] = static_cast<int>(row % 2 == 0 ? Status::diverged : Status::not_converged);
    }
    for (FeatureResult& feature : r.features) {
        feature.values.assign(feature.values.size(), kNan);
    }
}

Plan with_feature(const std::string& name, const Law& law) {
    Plan plan = usual_plan();
    plan.features.insert(plan.features.begin(), {name, law});
    return plan;
}

Plan with_sizes(std::vector<double> sizes) {
    Plan plan = usual_plan();
    plan.sizes = std::move(sizes);
    return plan;
}

Plan many_plan() {
    Plan plan;
    plan.noise_levels = {0, 0.1, 0.2, 0.5, 1, 2, 3, 5, 10};
    for (int f = 0; f < 12; ++f) {
        plan.features.push_back(
            {"feature_with_a_long_name_" + std::to_string(f),
             [f](const Drawn& g, double noise) { return telling(g, 0.3 * f + noise); }});
    }
    return plan;
}

}  // namespace

std::vector<ReportCase> report_cases() {
    std::vector<ReportCase> cases;
    const auto add = [&](const std::string& name, const Plan& plan) {
        cases.push_back({name, drawn(plan)});
    };
    const auto with_counts = [](int healthy, int test) {
        Plan plan = usual_plan();
        plan.healthy = healthy;
        plan.test = test;
        return plan;
    };
    add("usual", usual_plan());
    add("no_rows", with_counts(0, 0));
    add("no_graded", with_counts(400, 0));
    add("few", with_counts(5, 8));
    Plan no_features = usual_plan();
    no_features.features.clear();
    add("no_features", no_features);
    add("no_fault", with_sizes({0.0}));
    Plan only_faulty = with_sizes({1e-3, 2e-3});
    only_faulty.healthy = 0;
    add("only_faulty", only_faulty);
    add("constant_feature", with_feature("te_fm0", [](const Drawn&, double) { return 2.0; }));
    add("nan_feature", with_feature("te_fm0", [](const Drawn&, double) { return kNan; }));
    add("nan_now_and_then", with_feature("te_fm0", [](const Drawn& g, double noise) {
            return g.normal > 0.8 ? kNan : telling(g, noise);
        }));
    add("all_detected", with_feature("te_fm0", [](const Drawn& g, double) {
            return g.size > 0.0 ? 1e3 + g.normal : g.normal;
        }));
    Plan none = usual_plan();
    none.features = {{"te_rms", [](const Drawn& g, double) {
                          return g.size > 0.0 ? -1e3 + g.normal : g.normal;
                      }}};
    add("none_detected", none);
    Plan no_noise = usual_plan();
    no_noise.noise_levels = {0.0};
    add("no_noise", no_noise);
    add("single_size", with_sizes({0.0, 1e-3}));
    Plan continuous = usual_plan();
    continuous.continuous = true;
    add("continuous_size", continuous);
    Plan pure = with_sizes({0.0, 1e-3, 2e-3});
    pure.size_name = "fault_broken";
    pure.size_unit = "1";
    add("pure_number", pure);
    add("many", many_plan());
    add("all_failed", usual_plan());
    fail_all(cases.back().results);
    add("interrupted", usual_plan());
    cases.back().results.provenance = {{"state", "interrupted by SIGTERM"},
                                       {"gearboxes_asked_for", "2000"}};
    add("study_of_another_version", usual_plan());
    cases.back().results.provenance.push_back({"study", "[gearbox]\ncolour = \"blue\"\n"});
    for (ReportCase& each : cases) {
        each.results.detection = detect_all(each.results, ColumnRows(each.results));
    }
    return cases;
}

}  // namespace gearpod::tests
