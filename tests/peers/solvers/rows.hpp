// Shared by the tables: a solver with its settings, its times by round, and ratios of times.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "mc/numerics/numerics_choice.hpp"
#include "mc/numerics/pilot.hpp"
#include "peer_runs.hpp"
#include "tests/bench/median.hpp"

namespace gearpod::peers {

using bench::median;

struct Options {
    std::string study = GEARPOD_SOURCE_DIR "/studies/published/liang-fig-5-8.toml";
    std::string csv, json;
    int rounds = 5;
    double error = 1e-3;  // of the worst feature
    double try_s = 120.0;
    bool steps_only = false;
};

// The study with the compared features and resolved numerics. Throws std::runtime_error with its
// problems.
struct ResolvedStudy {
    mc::Study study;
    std::optional<mc::NumericsChoice> choice;
};
ResolvedStudy study_of(const Options& options, std::vector<std::string> overrides);

// A solver with its settings. `times`: seconds per realization, over the span or a step, by round.
struct Row {
    std::string name;
    std::vector<double> times;
    double meshes = 0.0;  // mesh periods of these times; 0: one step
    std::optional<mc::PilotError> error;
    double tolerance = 0.0, steps = 0.0;
    bool within = true;  // meets the requested error
};

// Error of the features of gearboxes first to last - 1 from the records, against those of
// `reference`. The records contain the fault's whole pattern.
mc::PilotError error_of(const mc::Study& study, const std::vector<lockstep::MeshRecord>& records,
                        int first, int last, const mc::PilotRecord& reference);

// Median and range of a row's times over another's, round by round.
nlohmann::ordered_json ratio_json(const Row& row, const Row& to, double scale = 1.0);

// Ratio of a row to itself in a table.
inline nlohmann::ordered_json one() {
    return "1";
}

}  // namespace gearpod::peers
