#include "mc/recordings/calibration/calibrate.hpp"

#include <algorithm>
#include <span>
#include <stdexcept>

#include "machine/no_value.hpp"
#include "mc/files/child_process.hpp"
#include "mc/files/json_text.hpp"
#include "python_sources.hpp"

namespace gearpod::mc {
namespace {

// Reply of Python to a request. Each of the `sets` is a row of doubles after it.
nlohmann::ordered_json python_reply(const nlohmann::json& request,
                                    std::span<const SimulatedSet> sets, std::size_t values) {
    std::vector<double> rows;
    for (const SimulatedSet& set : sets) {
        rows.insert(rows.end(), set.unit.begin(), set.unit.end());
        rows.push_back(static_cast<double>(set.integration));
        rows.insert(rows.end(), set.values.begin(), set.values.end());
        rows.resize(rows.size() + values - set.values.size(), kNan);
    }
    const std::span<const char> bytes{reinterpret_cast<const char*>(rows.data()),
                                      rows.size() * sizeof(double)};
    std::string input = json_text(request) + "\n";
    input.append(bytes.begin(), bytes.end());
    // -I: ignore the modules of the user and of the working directory; -B: write no files.
    const PythonOutput output = run_python({"-IB", "-c", kCalibrationSource}, input);
    if (output.status != 0) {
        throw std::runtime_error("calibrate: " + python_interpreter() + " " +
                                 ended_text(output.status));
    }
    auto reply = nlohmann::ordered_json::parse(output.text);
    if (reply.contains("problem")) {
        throw std::runtime_error(reply["problem"].get<std::string>());
    }
    return reply;
}

nlohmann::json request_of(const CalibrationTask& task) {
    const HealthySet& measured = task.measured;
    nlohmann::json inputs, features, gearboxes, observed;
    for (const CalibratedInput& input : task.inputs) {
        inputs.push_back({{"key", input.key},
                          {"low", input.low},
                          {"high", input.high},
                          {"logarithmic", input.logarithmic}});
    }
    for (const features::Feature* feature : measured.features) {
        features.push_back(std::string(feature->name));
    }
    for (std::size_t g = 0; g < measured.values.size(); ++g) {
        for (const std::vector<double>& record : measured.values[g]) {
            gearboxes.push_back(g);
            observed.push_back(record);
        }
    }
    return {{"step", "region"},
            {"inputs", inputs},
            {"features", features},
            {"gearboxes", gearboxes},
            {"observed", observed},
            {"counts",
             {{"records", measured.records},
              {"gearboxes", measured.lengths.size()},
              {"left_out", measured.left_out},
              {"integrated_draws", kCalibrationRounds * task.integrated}}},
            {"study", task.study},
            {"seed", task.seed}};
}

}  // namespace

void check_calibration_python() {
    python_reply({{"step", "check"}}, {}, 0);
}

CalibrationResult calibrate(const CalibrationTask& task, std::vector<SimulatedSet>& first,
                            const SimulateRound& simulate) {
    const std::size_t inputs = task.inputs.size();
    nlohmann::json request = request_of(task);
    const std::size_t values = request["observed"].size() * task.measured.features.size();
    if (first.empty()) {
        first = simulate({std::vector<double>(inputs, 0.0), std::vector<double>(inputs, 1.0)},
                         {task.integrated, task.backgrounds, 0});
    }
    request["region"] = python_reply(request, first, values);
    std::vector<SimulatedSet> sets = simulate({request["region"]["low"], request["region"]["high"]},
                                              {task.integrated, task.backgrounds, task.integrated});
    sets.insert(sets.end(), first.begin(), first.end());
    request["step"] = "posterior";
    auto reply = python_reply(request, sets, values);
    return {reply["json"], reply["text"], reply["study"]};
}

}  // namespace gearpod::mc
