// Measures the coverage of the bounds that `pod` prints by default, over tables of known truth. The
// tag is [.pod-coverage]; ctest runs it as pod-coverage of -C long. GEARPOD_COVERAGE_TABLES sets
// the number of tables of each case (500), GEARPOD_COVERAGE_CASE measures the cases whose
// names have this text at their end or before a comma.
#include <fmt/core.h>

#include "analysis/inspection.hpp"
#include "tests/test.hpp"

namespace gearpod::analysis::test_pod_coverage {

using Where = SizeEstimate::Where;

int tables() {
    const char* text = std::getenv("GEARPOD_COVERAGE_TABLES");
    return text == nullptr ? 500 : std::atoi(text);
}

bool is_measured(const std::string& name) {
    const char* text = std::getenv("GEARPOD_COVERAGE_CASE");
    return text == nullptr || (name + ",").find(text + std::string(",")) != std::string::npos;
}

bool upper_holds(const SizeEstimate& bound, double truth) {
    return bound.where == Where::not_reached ||
           (bound.where == Where::reached && truth <= bound.size);
}
bool lower_holds(const SizeEstimate& bound, double truth) {
    return bound.where == Where::below_tested || std::isinf(truth) ||
           (bound.where == Where::reached && truth >= bound.size);
}

struct Coverage {
    int answered = 0, upper = 0, lower = 0, upper_a50 = 0, reached = 0;

    double of(int count) const { return static_cast<double>(count) / answered; }
};

// Least coverage of a bound of 95 % that passes: 93 % less two standard errors of 500 tables.
constexpr double kLeast = 0.91;

// Counts in how many tables the bounds hold the true sizes. Prints one line.
Coverage measure(const std::string& name, const std::function<Inspections(std::mt19937_64&)>& draw,
                 InspectionRequest request, double a50, double a90) {
    request.simulated_tables = 0;
    std::mt19937_64 engine(4711);
    Coverage coverage;
    if (!is_measured(name)) {
        return coverage;
    }
    for (int table = 0; table < tables(); ++table) {
        const InspectionResult result = inspect(draw(engine), request);
        const std::string& refusal =
            request.responses ? result.signal_response.refusal : result.hit_miss.refusal;
        if (!result.refusal.empty() || !refusal.empty()) {
            continue;
        }
        const SizeBounds& found =
            request.responses ? result.signal_response.a90 : result.hit_miss.a90;
        const SizeBounds& middle =
            request.responses ? result.signal_response.a50 : result.hit_miss.a50;
        ++coverage.answered;
        coverage.upper += upper_holds(found.upper, a90);
        coverage.lower += lower_holds(found.lower, a90);
        coverage.upper_a50 += upper_holds(middle.upper, a50);
        coverage.reached += found.upper.where == Where::reached;
    }
    fmt::print("| {} | {} | {:.1f} | {:.1f} | {:.1f} | {:.0f} |\n", name, coverage.answered,
               100.0 * coverage.of(coverage.upper), 100.0 * coverage.of(coverage.lower),
               100.0 * coverage.of(coverage.upper_a50), 100.0 * coverage.of(coverage.reached));
    std::fflush(stdout);
    return coverage;
}

void check(const Coverage& coverage) {
    if (coverage.answered == 0) {
        return;
    }
    CHECK(coverage.of(coverage.upper) > kLeast);
    CHECK(coverage.of(coverage.lower) > kLeast);
    CHECK(coverage.of(coverage.upper_a50) > kLeast);
}

void header(const char* title) {
    fmt::print("\n{}\n| case | answered | a90 upper | a90 lower | a50 upper | reached |\n", title);
}

// Responses 10 a + 2 e, threshold 15, sizes 0.3 to 4.
struct Responses {
    int specimens = 40, repeats = 1;
    double between = 0.0, scatter = 2.0, growth = 0.0;  // growth: scatter per size
    double left = -INFINITY, right = INFINITY;
    bool log = false;    // log response of log size
    double power = 1.0;  // 0.5: root of the response over size

    Inspections operator()(std::mt19937_64& engine) const {
        std::uniform_real_distribution<double> sizes(0.3, 4.0);
        std::normal_distribution<double> normal;
        Inspections data;
        for (int s = 0; s < specimens; ++s) {
            const double size = sizes(engine), shared = between * normal(engine);
            for (int r = 0; r < repeats; ++r) {
                const double e = shared + (growth > 0.0 ? growth * size : scatter) * normal(engine);
                const double value = log            ? 10.0 * size * std::exp(e)
                                     : power == 0.5 ? std::pow(1.2 + 1.3 * size + e, 2)
                                                    : 10.0 * size + e;
                data.size.push_back(size);
                data.value.push_back(std::clamp(value, left, right));
                data.specimen.push_back(s);
            }
        }
        return data;
    }
    double reached(double z) const {
        const double all = std::hypot(between, scatter);
        return growth > 0.0   ? 15.0 / (10.0 - z * growth)
               : log          ? std::exp((std::log(15.0) - std::log(10.0) + scatter * z))
               : power == 0.5 ? (std::sqrt(15.0) + scatter * z - 1.2) / 1.3
                              : (15.0 + all * z) / 10.0;
    }
};

InspectionRequest of_threshold() {
    InspectionRequest request;
    request.responses = true;
    request.threshold = 15.0;
    return request;
}

Coverage measure_responses(const std::string& name, const Responses& responses,
                           InspectionRequest request = of_threshold()) {
    if (std::isfinite(responses.left)) {
        request.limits.left = responses.left;
    }
    if (std::isfinite(responses.right)) {
        request.limits.right = responses.right;
    }
    return measure(name, responses, request, responses.reached(0.0),
                   responses.reached(link_quantile(Link::probit, 0.9)));
}

TEST_CASE("Default bounds of responses cover the truth over n", "[.pod-coverage][n]") {
    header("responses");
    for (const int n : {10, 20, 40, 100, 200}) {
        InspectionRequest single = of_threshold();
        single.log_sizes = {false};
        single.powers = {1.0};
        single.accept_failed_checks = true;
        check(measure_responses(fmt::format("line, scales given, n = {}", n), {.specimens = n},
                                single));
        check(measure_responses(fmt::format("line, n = {}", n), {.specimens = n}));
        check(measure_responses(fmt::format("log-log, n = {}", n),
                                {.specimens = n, .scatter = 0.3, .log = true}));
    }
}

TEST_CASE("Default bounds of censored responses cover the truth", "[.pod-coverage][censored]") {
    header("censored responses");
    for (const int n : {20, 40, 100, 200}) {
        check(measure_responses(fmt::format("left, n = {}", n), {.specimens = n, .left = 12.0}));
        check(measure_responses(fmt::format("left and right, n = {}", n),
                                {.specimens = n, .left = 12.0, .right = 20.0}));
        check(measure_responses(fmt::format("left and right, wide, n = {}", n),
                                {.specimens = n, .left = 8.0, .right = 30.0}));
    }
}

TEST_CASE("Default bounds with Box and Cox's power cover the truth", "[.pod-coverage][box-cox]") {
    header("Box-Cox");
    for (const int n : {20, 40, 100, 200}) {
        InspectionRequest request = of_threshold();
        request.powers = {kNan};
        check(measure_responses(fmt::format("root, n = {}", n),
                                {.specimens = n, .scatter = 0.25, .power = 0.5}, request));
    }
}

TEST_CASE("Default bounds of repeated responses cover the truth", "[.pod-coverage][repeated]") {
    header("repeated responses");
    for (const int n : {10, 13, 30, 40}) {
        check(measure_responses(fmt::format("{} specimens x 3", n),
                                {.specimens = n, .repeats = 3, .between = 2.5, .scatter = 1.0}));
    }
}

TEST_CASE("Default bounds of responses whose scatter grows", "[.pod-coverage][growing]") {
    header("scatter grows with size");
    for (const int n : {10, 20, 40, 100, 200}) {
        measure_responses(fmt::format("proportional, n = {}", n), {.specimens = n, .growth = 2.5});
    }
}

TEST_CASE("Bounds of a curve whose scatter grows cover the truth", "[.pod-coverage][curve]") {
    header("curve");
    // Responses 40 a / (a + 1.5) with scatter 1.2 sqrt(a): a50 is 0.9, a90 1.06248.
    for (const auto& [specimens, repeats] : {std::pair{40, 1}, {100, 1}, {35, 8}}) {
        const std::string name = fmt::format("{} specimens x {}", specimens, repeats);
        if (!is_measured(name)) {
            continue;
        }
        std::mt19937_64 engine(4711);
        std::uniform_real_distribution<double> sizes(0.3, 4.0);
        std::normal_distribution<double> normal;
        Coverage coverage;
        for (int table = 0; table < tables(); ++table) {
            ResponseRows rows;
            for (int s = 0; s < specimens; ++s) {
                const double size = sizes(engine), shared = normal(engine);
                for (int r = 0; r < repeats; ++r) {
                    const double e =
                        repeats == 1 ? shared
                                     : std::sqrt(0.8) * shared + std::sqrt(0.2) * normal(engine);
                    rows.size.push_back(size);
                    rows.value.push_back(40.0 * size / (size + 1.5) + 1.2 * std::sqrt(size) * e);
                    rows.specimen.push_back(s);
                }
            }
            const SmoothResponse curve(rows, 15.0, Alarm::high, 0.95);
            if (curve.refusal().empty()) {
                ++coverage.answered;
                coverage.upper += upper_holds(curve.a90().upper, 1.0624792513);
                coverage.lower += lower_holds(curve.a90().lower, 1.0624792513);
                coverage.upper_a50 += upper_holds(curve.a50().upper, 0.9);
            }
        }
        fmt::print("| {} | {} | {:.1f} | {:.1f} | {:.1f} |\n", name, coverage.answered,
                   100.0 * coverage.of(coverage.upper), 100.0 * coverage.of(coverage.lower),
                   100.0 * coverage.of(coverage.upper_a50));
        check(coverage);
    }
}

// Hits and misses of a curve ceiling / (1 + exp(-slope (size - middle))), sizes 0.2 to 5. Clusters
// share a deviation of the size at which their flaws are found.
struct Hits {
    int specimens = 60, repeats = 1;
    double slope = 2.5, middle = 2.0, ceiling = 1.0, between = 0.0;
    bool log = false;    // probit of log size
    bool sizes = false;  // repeats of a specimen have sizes of their own

    double rate(double size, double shift) const {
        return log ? link_probability(Link::probit, std::log(size / middle) / 0.4 + shift)
                   : ceiling * link_probability(Link::logit, slope * (size - middle) + shift);
    }
    Inspections operator()(std::mt19937_64& engine) const {
        std::uniform_real_distribution<double> uniform;
        std::normal_distribution<double> normal;
        Inspections data;
        for (int s = 0; s < specimens; ++s) {
            const double shift = between * normal(engine);
            double size = 0.0;
            for (int r = 0; r < repeats; ++r) {
                size = r == 0 || sizes ? 0.2 + 4.8 * uniform(engine) : size;
                data.size.push_back(size);
                data.value.push_back(uniform(engine) < rate(size, shift));
                data.specimen.push_back(s);
            }
        }
        return data;
    }
    // Size with this POD over all clusters.
    double reached(double pod) const {
        double low = 0.01, high = 50.0;
        for (int step = 0; step < 60; ++step) {
            const double middle_size = 0.5 * (low + high);
            double sum = 0.0;
            for (int i = 0; i < 200; ++i) {
                sum += rate(middle_size, between * link_quantile(Link::probit, (i + 0.5) / 200.0)) /
                       200.0;
            }
            (sum < pod ? low : high) = middle_size;
        }
        return high > 49.0 ? INFINITY : high;
    }
};

Coverage measure_hits(const std::string& name, const Hits& hits) {
    InspectionRequest request;
    return measure(name, hits, request, hits.reached(0.5), hits.reached(0.9));
}

TEST_CASE("Default bounds of hits and misses cover the truth", "[.pod-coverage][hits]") {
    header("hits and misses");
    for (const int n : {30, 60, 100, 200}) {
        check(measure_hits(fmt::format("logit, n = {}", n), {.specimens = n}));
        check(measure_hits(fmt::format("probit of log size, n = {}", n),
                           {.specimens = n, .log = true}));
        for (const double ceiling : {0.95, 0.85}) {
            measure_hits(fmt::format("ceiling {}, n = {}", ceiling, n),
                         {.specimens = n, .slope = 3.0, .middle = 1.5, .ceiling = ceiling});
        }
    }
}

TEST_CASE("Default bounds of clustered hits cover the truth", "[.pod-coverage][clusters]") {
    header("clustered hits and misses");
    for (const int n : {10, 30}) {
        check(measure_hits(fmt::format("{} specimens x 3", n),
                           {.specimens = n, .repeats = 3, .between = 1.5}));
    }
    for (const int n : {3, 10, 30}) {
        check(measure_hits(
            fmt::format("{} inspectors x {} flaws", n, n < 10 ? 30 : 10),
            {.specimens = n, .repeats = n < 10 ? 30 : 10, .between = 1.0, .sizes = true}));
    }
}

}  // namespace gearpod::analysis::test_pod_coverage
