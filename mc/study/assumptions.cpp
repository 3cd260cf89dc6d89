#include "mc/study/assumptions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "mc/study/fluctuations.hpp"
#include "mc/study/gears.hpp"

namespace gearpod::mc {
namespace {

std::string teeth(const Study& study) {
    if (!has_tooth_errors(study)) {
        return "identical teeth";
    }
    if (study.find_random("gearbox.tooth_quality") != nullptr) {
        return "teeth of ISO 1328 grades that vary";
    }
    return study.errors.tooth_quality
               ? fmt::format("teeth of ISO 1328 grade {:g}", *study.errors.tooth_quality)
               : "teeth that differ";
}

}  // namespace

std::string assumptions(const Study& study, bool lives) {
    if (!has_gears(study)) {
        return "";
    }
    std::vector<std::string> all{teeth(study)};
    if (study.gearbox.kind == GearboxKind::planetary && !has_unlike_planets(study)) {
        all.push_back("planets and pins alike");
    }
    if (study.effects.foundation == Foundation::none && !stiffness_given(study)) {
        all.push_back("rigid gear bodies");
    }
    if (!torque_fluctuates(study) && !speed_fluctuates(study)) {
        all.push_back(lives ? "torque and speed steady in a record" : "steady torque and speed");
    }
    if (lives) {
        all.push_back(study.life.curve_h.empty() ? "cracks that grow by Paris' law"
                                                 : "cracks that grow along the given curve");
    }
    std::string text = fmt::format("Holds for {}, and thresholds from {} gearboxes.",
                                   fmt::join(all, ", "), lives ? "the lives of other" : "other");
    if (compares_records(study) && !lives) {
        text += fmt::format(
            " own_ and change_ features also take a healthy record of the same gearbox, at a "
            "torque "
            "{:g} % (rms) off.",
            100.0 * study.features.baseline_torque_scatter);
    }
    const bool alike =
        std::all_of(study.random.begin(), study.random.end(),
                    [](const RandomInput& input) { return input.key.starts_with("fault."); });
    if (alike) {
        text += " Only the fault and the noise vary.";
    }
    if (study.ensemble.sampling == SamplingKind::sobol) {
        text +=
            " Gearboxes fill the ranges of their inputs evenly (ensemble.sampling): intervals take "
            "them for independent, and are wider than they need be.";
    }
    if (!has_tooth_errors(study)) {
        text +=
            " Errors of real teeth hide faults that identical teeth show: gearbox.tooth_quality "
            "draws them.";
    }
    return text;
}

}  // namespace gearpod::mc
