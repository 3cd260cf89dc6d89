#include <fmt/format.h>

#include <optional>
#include <variant>

#include "lockstep/integrators/facts.hpp"
#include "machine/lanes.hpp"
#include "mc/study/fluctuations.hpp"
#include "mc/study/reading/parts.hpp"
#include "mc/study/schema/schema.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {
namespace {

void check_lanes(StudyDraft& draft) {
    const Numerics& n = draft.study.numerics;
    const bool single = n.precision == Precision::single_precision;
    if (!machine::is_lane_count(n.lanes) || (n.lanes == 16 && !single)) {
        draft.reject("numerics.lanes",
                     fmt::format("must be {}8, 4 or 1, but is {}", single ? "16, " : "", n.lanes),
                     single ? "16 fills AVX-512 registers, 8 those of AVX2; 1 is for comparison"
                            : "8 fills AVX-512 registers, 4 those of AVX2; 1 is for comparison");
    }
}

void check_precision(StudyDraft& draft) {
    const Numerics& n = draft.study.numerics;
    const bool doubles_only = n.integrator && !lockstep::has_single_precision(*n.integrator);
    if (n.precision == Precision::single_precision && doubles_only &&
        draft.all_usable({"numerics.precision", "numerics.integrator"})) {
        draft.reject(
            "numerics.precision",
            fmt::format("\"single\" is for the integrators {}, but numerics.integrator is \"{}\"",
                        lockstep::names_of(&lockstep::IntegratorFacts::has_single_precision),
                        lockstep::name(*n.integrator)),
            fmt::format("use precision = \"double\", or integrator = \"{}\"",
                        lockstep::name(lockstep::kUsualExplicit)));
    }
}

// Only the methods named in the message can be given inertia, and none is chosen by itself.
void check_mass_scaling(StudyDraft& draft) {
    const Numerics& n = draft.study.numerics;
    if (n.mass_scaling_Hz > 0.0 &&
        draft.all_usable({"numerics.mass_scaling_Hz", "numerics.integrator"}) &&
        !(n.integrator && lockstep::facts(*n.integrator).scales_mass)) {
        const std::string able = lockstep::names_of(&lockstep::IntegratorFacts::scales_mass);
        draft.reject("numerics.mass_scaling_Hz",
                     fmt::format("is for the integrator {}, but numerics.integrator is \"{}\"",
                                 able, n.integrator ? lockstep::name(*n.integrator) : "auto"),
                     fmt::format("use integrator = \"{}\", or remove it", able));
    }
}

// Modes in the band would no longer be measured where they are.
void check_scaled_band(StudyDraft& draft) {
    const double limit_Hz = draft.study.numerics.mass_scaling_Hz,
                 low_pass_Hz = draft.study.sensor.low_pass_Hz;
    if (limit_Hz > 0.0 && limit_Hz < low_pass_Hz &&
        draft.all_usable({"numerics.mass_scaling_Hz", "sensor.low_pass_Hz"})) {
        draft.reject(
            "numerics.mass_scaling_Hz",
            fmt::format("{:g} Hz lie in the sensor's band of {:g} Hz, whose vibration would "
                        "change",
                        limit_Hz, low_pass_Hz),
            "use a limit above sensor.low_pass_Hz");
    }
}

void check_pairs(StudyDraft& draft) {
    const int pairs = draft.study.numerics.paired_gearboxes;
    if (pairs > 0 && pairs < kFewestPairs && draft.all_usable({"numerics.paired_gearboxes"})) {
        draft.reject("numerics.paired_gearboxes",
                     fmt::format("{} are too few for a correction", pairs),
                     fmt::format("use at least {}", kFewestPairs));
    }
}

// The candidates of a tolerance are compared with steps that have the same inertia.
void check_tolerances(StudyDraft& draft) {
    const Numerics& n = draft.study.numerics;
    if (n.tolerance > 0.0 && n.mass_scaling_Hz > 0.0 &&
        draft.all_usable({"numerics.tolerance", "numerics.mass_scaling_Hz"})) {
        draft.reject("numerics.tolerance", "does not see the error of numerics.mass_scaling_Hz",
                     "use numerics.scatter_tolerance");
    }
}

void check_superposition(StudyDraft& draft) {
    const std::string why = reason_not_superposed(draft.study);
    if (draft.study.numerics.horizon == Horizon::superposed && !why.empty() &&
        draft.all_usable({"numerics.horizon", "effects.gravity", "effects.motion"})) {
        draft.reject("numerics.horizon", fmt::format("is \"superposed\", but {}", why),
                     "leave the key out");
    }
}

void check_horizon(StudyDraft& draft) {
    check_superposition(draft);
    const std::string why = reason_not_periodic(draft.study);
    if (draft.study.numerics.horizon == Horizon::periodic && !why.empty() &&
        draft.all_usable({"numerics.horizon", "effects.gravity", "operation.fixed"})) {
        draft.reject("numerics.horizon", fmt::format("is \"periodic\", but {}", why),
                     "use horizon = \"full\", or leave the key out");
    }
}

// Value of a key in the file's unit; empty if it is not a number.
std::optional<double> number_of(const Study& study, const Key& key) {
    if (const auto* const number = std::get_if<NumberAccess>(&key.access)) {
        const std::optional<double> si = number->get(study);
        return si ? std::optional(*si / key.unit.to_si) : std::nullopt;
    }
    if (const auto* const integer = std::get_if<IntegerAccess>(&key.access)) {
        const std::optional<std::int64_t> value = integer->get(study);
        return value ? std::optional(static_cast<double>(*value)) : std::nullopt;
    }
    return std::nullopt;
}

}  // namespace

void check_numerics(StudyDraft& draft) {
    check_lanes(draft);
    check_precision(draft);
    check_mass_scaling(draft);
    check_scaled_band(draft);
    check_pairs(draft);
    check_tolerances(draft);
    check_horizon(draft);
}

std::string numerics_text(const Numerics& numerics, std::string_view key) {
    Study study;
    study.numerics = numerics;
    const auto* const number = std::get_if<NumberAccess>(&find_key("numerics", key)->access);
    return number != nullptr ? fmt::format("{}={:g}", key, number->get(study).value())
                             : fmt::format("{}={}", key, choice_text(study, "numerics", key));
}

Problems numerics_problems(const Study& study, std::span<const std::string_view> keys) {
    StudyDraft draft;
    draft.study = study;
    draft.sections[""] = {};
    for (const std::string_view name : keys) {
        const Key& key = *find_key("numerics", name);
        draft.given[key.path()] = {};
        check_presence(draft, key);
        if (const std::optional<double> number = number_of(study, key)) {
            check_range(draft, {}, key, *number);
        }
    }
    check_numerics(draft);
    return draft.problems;
}

}  // namespace gearpod::mc
