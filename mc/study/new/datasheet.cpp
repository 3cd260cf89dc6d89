#include "mc/study/new/datasheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "mc/study/new/rules.hpp"

namespace gearpod::mc {
namespace {

Problem as_named_by(const DatasheetSource& source, Problem problem) {
    problem.file = source.file;
    problem.line = 0;
    if (problem.kind == ProblemKind::tooth_pairs) {
        problem.key = source.keys.at("gearbox.helix_angle_deg") + ", " +
                      source.keys.at("gearbox.face_width_mm");
        problem.remedy = "give narrower teeth or a smaller helix angle";
        return problem;
    }
    if (problem.kind == ProblemKind::meshing) {
        problem.remedy = source.meshing_remedy;
    }
    const auto at = source.keys.find(problem.key);
    if (at != source.keys.end()) {
        problem.key = at->second;
    } else {
        problem.remedy = "the value is derived; check --module, --torque and --speed";
    }
    return problem;
}

}  // namespace

DatasheetSource planetary_options() {
    return {
        "new planetary",
        {{"gearbox.sun.teeth", "--sun"},
         {"gearbox.planet.teeth", "--planet"},
         {"gearbox.ring.teeth", "--ring"},
         {"gearbox.planets", "--planets"},
         {"gearbox.normal_module_mm", "--module"},
         {"gearbox.module_mm", "--module"},
         {"gearbox.helix_angle_deg", "--helix"},
         {"gearbox.pressure_angle_deg", "--pressure-angle"},
         {"gearbox.face_width_mm", "--face-width"},
         {"gearbox.sun.shift", "--sun-shift"},
         {"gearbox.planet.shift", "--planet-shift"},
         {"gearbox.ring.shift", "--ring-shift"},
         {"gearbox.addendum_coefficient", "--addendum"},
         {"gearbox.sun.tip_mm", "--sun-tip"},
         {"gearbox.planet.tip_mm", "--planet-tip"},
         {"gearbox.ring.tip_mm", "--ring-tip"},
         {"gearbox.centre_distance_mm", "--centre-distance"},
         {"gearbox.tooth_quality", "--quality"},
         {"operation.input", "--input"},
         {"operation.torque_N_m", "--torque"}},
        "the options are --addendum, --centre-distance, --sun-tip, --planet-tip and --ring-tip"};
}

Problems as_named_by(const DatasheetSource& source, Problems problems) {
    std::ranges::transform(problems, problems.begin(),
                           [&](const Problem& problem) { return as_named_by(source, problem); });
    return problems;
}

Problems load_problems(const StageDatasheet& data, const DatasheetSource& source,
                       const std::string& input) {
    Problems problems;
    const int given = int{data.torque_N_m.has_value()} + int{data.speed_rpm.has_value()} +
                      int{data.power_kW.has_value()};
    if (given != 2) {
        problems.push_back({source.file, 0, "--torque, --speed, --power",
                            fmt::format("{} of the three are given", given),
                            "give exactly two of them, for the " + input});
    }
    for (const auto& [option, value] :
         {std::pair{"--torque", data.torque_N_m}, std::pair{"--speed", data.speed_rpm},
          std::pair{"--power", data.power_kW}}) {
        if (value && !(*value > 0.0 && std::isfinite(*value))) {
            problems.push_back(
                {source.file, 0, option, fmt::format("must be > 0, but is {:g}", *value), ""});
        }
    }
    return problems;
}

InputLoad load_of(const StageDatasheet& data) {
    constexpr double kRadPerS = std::numbers::pi / 30.0;
    const double power_W = 1e3 * data.power_kW.value_or(0.0);
    return {data.torque_N_m.value_or(power_W / (kRadPerS * data.speed_rpm.value_or(1.0))),
            data.speed_rpm.value_or(power_W / (kRadPerS * data.torque_N_m.value_or(1.0)))};
}

double face_width_mm(const StageDatasheet& data) {
    if (data.face_width_mm) {
        return *data.face_width_mm;
    }
    const double width = 1e3 * default_face_width_m(1e-3 * data.module_mm);
    return !(width > 0.0) || !std::isfinite(width) ? 1.0 : width < 10.0 ? width : std::round(width);
}

}  // namespace gearpod::mc
