// Compares time and error of gearpod and other solvers on the same gearbox (README.md).
// Usage: peer_solvers [STUDY] [--rounds N] [--error E] [--try-s S] [--csv FILE] [--json FILE]
// [--steps-only]
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>

#include "span_table.hpp"
#include "step_table.hpp"

namespace gearpod::peers {
namespace {

// Ratios are printed as "median (low..high)".
std::string text_of(const nlohmann::ordered_json& cell) {
    if (cell.is_object()) {
        return fmt::format("{:.3g} ({:.3g}..{:.3g})", cell["median"].get<double>(),
                           cell["low"].get<double>(), cell["high"].get<double>());
    }
    return cell.is_string() ? cell.get<std::string>() : fmt::format("{:.3g}", cell.get<double>());
}

void print(const nlohmann::ordered_json& table) {
    fmt::print("\n{}\n", table["title"].get<std::string>());
    const auto print_row = [](const nlohmann::ordered_json& row) {
        for (const auto& cell : row) {
            fmt::print("| {:<26} ", text_of(cell));
        }
        fmt::print("|\n");
    };
    print_row(table["columns"]);
    std::ranges::for_each(table["rows"], print_row);
}

void compare(const Options& options) {
    GearpodSolver own(options);
    const mc::Pilot pilot{mc::Planner(own.study())};
    fmt::print(stderr, "reference: two methods until they agree\n");
    const mc::Reference reference = mc::converged_reference(pilot, own.study().numerics, {});
    StepTable steps(own, reference);
    steps.measure_errors();
    SpanTable span(options, own, pilot, reference);
    if (!options.steps_only) {
        span.add_all();
    }
    for (int round = 0; round < options.rounds; ++round) {
        fmt::print(stderr, "round {} of {}\n", round + 1, options.rounds);
        steps.round();
        if (!options.steps_only) {
            span.round();
        }
    }
    nlohmann::ordered_json part;
    steps.add_to(part);
    if (!options.steps_only) {
        span.add_to(part);
    }
    for (const auto& table : part["tables"]) {
        print(table);
    }
    steps.print_limit();
    if (!options.csv.empty()) {
        span.write(options.csv);
    }
    if (!options.json.empty()) {
        if (!(std::ofstream(options.json) << part.dump() << '\n').flush()) {
            throw std::runtime_error(options.json + ": cannot be written");
        }
    }
}

}  // namespace
}  // namespace gearpod::peers

int main(int argc, char** argv) {
    gearpod::peers::Options options;
    CLI::App app("The same gearbox by gearpod and by other solvers: time and error side by side");
    app.add_option("study", options.study, "a planetary study with four planets and no scatter");
    app.add_option("--rounds", options.rounds, "interleaved rounds of timing")
        ->check(CLI::PositiveNumber);
    app.add_option("--error", options.error, "of the worst feature, relative")
        ->check(CLI::PositiveNumber);
    app.add_option("--try-s", options.try_s, "processor time to give up a tolerance after, s")
        ->check(CLI::PositiveNumber);
    CLI::Option* csv = app.add_option("--csv", options.csv, "table for `gearpod accuracy --peers`");
    app.add_option("--json", options.json, "tables and ratios for tests/bench/performance.py");
    app.add_flag("--steps-only", options.steps_only, "only the steps of Runge-Kutta's method")
        ->excludes(csv);
    CLI11_PARSE(app, argc, argv);
    try {
        gearpod::peers::compare(options);
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 2;
    }
    return 0;
}
