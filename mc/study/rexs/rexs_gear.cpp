#include "mc/study/rexs/rexs_gear.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "gears/mesh_geometry.hpp"

namespace gearpod::mc {
namespace {

using Components = std::vector<const RexsComponent*>;
using Q = RexsQuantity;

// The gears and their flanks, because versions differ in where they state angles and shifts.
Components with_flanks(RexsValues& values, const Components& gears) {
    Components all = gears;
    for (const RexsComponent* gear : gears) {
        for (const char* side : {"left", "right"}) {
            for (const RexsComponent* flank :
                 values.model().related("flank", "gear", gear->id, side)) {
                all.push_back(flank);
            }
        }
    }
    for (const RexsComponent* component : all) {
        values.consider(*component);
    }
    return all;
}

Components materials(RexsValues& values, const Components& gears) {
    Components all;
    for (const RexsComponent* gear : gears) {
        for (const RexsComponent* material :
             values.model().related("reference", "origin", gear->id, "referenced")) {
            if (material->type == "material") {
                values.consider(*material);
                all.push_back(material);
            }
        }
    }
    return all;
}

std::optional<double> magnitude(const std::optional<double>& value) {
    return value ? std::optional(std::abs(*value)) : std::nullopt;
}

// Profile shift coefficient, from the coefficient or the shift in mm.
std::optional<double> profile_shift(RexsValues& values, const Components& parts,
                                    const std::optional<double>& module_mm) {
    const auto coefficient = values.common(
        parts, {"addendum_modification_coefficient", "profile_shift_coefficient"}, Q::number);
    const auto shift_mm =
        values.common(parts, {"addendum_modification", "profile_shift"}, Q::length);
    if (!shift_mm || !module_mm) {
        return coefficient;
    }
    const double from_mm = *shift_mm / *module_mm;
    constexpr double kRounded = 1e-3;
    if (coefficient && std::abs(*coefficient - from_mm) > kRounded) {
        values.reject(*parts.front(), "addendum_modification",
                      fmt::format("{:.6g} mm are {:.6g} modules, but the coefficient is {:.6g}",
                                  *shift_mm, from_mm, *coefficient),
                      "correct one of them");
    }
    return coefficient ? coefficient : from_mm;
}

// Value of a property that all gears of a stage should share. A gear that differs is a problem.
std::optional<double> shared(RexsValues& values, const std::vector<RexsGear>& gears,
                             std::optional<double> RexsGear::*property, const char* attribute) {
    constexpr double kRounded = 1e-6;
    const RexsGear* first = nullptr;
    for (const RexsGear& gear : gears) {
        const std::optional<double>& value = gear.*property;
        if (!value) {
            continue;
        }
        if (first == nullptr) {
            first = &gear;
        } else if (std::abs(*value - *(first->*property)) > kRounded * std::max(1.0, *value)) {
            values.reject(*gear.component, attribute,
                          fmt::format("is {:.9g}, but that of {} is {:.9g}; meshing gears have the "
                                      "same",
                                      *value, first->component->label(), *(first->*property)));
        }
    }
    return first == nullptr ? std::nullopt : first->*property;
}

// Mean of a property: the harmonic mean for stiffnesses in series. Notes values that differ.
std::optional<double> combined(const std::vector<RexsGear>& gears,
                               std::optional<double> RexsGear::*property, const char* name,
                               std::vector<std::string>& notes) {
    double inverse = 0;
    int number = 0;
    std::string list;
    std::set<double> different;
    for (const RexsGear& gear : gears) {
        if (const std::optional<double>& value = gear.*property; value && *value > 0.0) {
            inverse += 1.0 / *value;
            ++number;
            different.insert(*value);
            list += (list.empty() ? "" : ", ") +
                    fmt::format("{:.6g} of {}", *value, gear.component->label());
        }
    }
    if (number == 0) {
        return {};
    }
    const double mean = different.size() == 1 ? *different.begin() : number / inverse;
    if (different.size() > 1) {
        notes.push_back(fmt::format("{}: {}; a study has one value, their harmonic mean {:.6g}",
                                    name, list, mean));
    }
    return mean;
}

std::optional<double> common_width(RexsValues& values, const RexsStage& stage,
                                   const std::vector<RexsGear>& gears,
                                   std::vector<std::string>& notes) {
    Components pairs = stage.first_pairs;
    pairs.insert(pairs.end(), stage.second_pairs.begin(), stage.second_pairs.end());
    std::optional<double> width = values.common(pairs, {"common_face_width"}, Q::length);
    std::string list;
    std::set<double> different;
    for (const RexsGear& gear : gears) {
        if (gear.face_width_mm) {
            different.insert(*gear.face_width_mm);
            list += (list.empty() ? "" : ", ") +
                    fmt::format("{:g} mm of {}", *gear.face_width_mm, gear.component->label());
        }
    }
    if (!width && !different.empty()) {
        width = *different.begin();
    }
    if (width && (different.size() > 1 || different.count(*width) == 0) && !different.empty()) {
        notes.push_back(
            fmt::format("face widths {}; a study has one, the common {:g} mm", list, *width));
    }
    return width;
}

// Rejects helical gears of the same hand on parallel shafts.
void check_hands(RexsValues& values, const RexsStage& stage) {
    if (stage.kind != RexsStageKind::cylindrical) {
        return;
    }
    const auto helix = [&](const RexsComponent* gear) {
        return values.number(*gear, {"helix_angle_reference_diameter", "helix_angle"}, Q::angle)
            .value_or(0.0);
    };
    if (helix(stage.first) * helix(stage.second) > 0.0) {
        values.reject(*stage.second, "helix_angle_reference_diameter",
                      fmt::format("{:g} and {:g} deg of {} have the same sign; external gears on "
                                  "parallel shafts have opposite hands",
                                  helix(stage.second), helix(stage.first), stage.first->label()));
    }
}

gears::Gear transverse_gear(const RexsTeeth& teeth, const RexsGear& gear, bool internal) {
    const double degree = std::numbers::pi / 180.0;
    const double helix = teeth.helix_deg.value_or(0.0) * degree;
    gears::Gear result;
    result.teeth = gear.teeth;
    result.internal = internal;
    result.module_m = 1e-3 * teeth.module_mm.value() / std::cos(helix);
    result.pressure_angle_rad =
        std::atan(std::tan(teeth.pressure_angle_deg.value_or(20.0) * degree) / std::cos(helix));
    result.profile_shift = gear.shift.value() * std::cos(helix);
    return result;
}

}  // namespace

RexsGear rexs_gear(RexsValues& values, const Components& gears) {
    RexsGear result;
    result.component = gears.front();
    const Components parts = with_flanks(values, gears);
    const std::optional<double> teeth = values.common(gears, {"number_of_teeth"}, Q::number);
    for (const RexsComponent* gear : gears) {
        values.count(*gear, "number_of_teeth");
    }
    if (!teeth) {
        values.reject(*result.component, "number_of_teeth", "is missing");
    }
    constexpr double kMostTeeth = 10000;
    result.teeth = static_cast<int>(std::min(std::abs(teeth.value_or(0.0)), kMostTeeth + 1));
    result.module_mm = values.common(gears, {"normal_module"}, Q::length);
    if (!result.module_mm && result.component->find("normal_module") == nullptr) {
        values.reject(*result.component, "normal_module", "is missing");
    }
    result.pressure_angle_deg = values.common(parts, {"normal_pressure_angle"}, Q::angle);
    result.helix_deg = magnitude(
        values.common(gears, {"helix_angle_reference_diameter", "helix_angle"}, Q::angle));
    result.shift = profile_shift(values, parts, result.module_mm);
    result.face_width_mm = values.common(gears, {"face_width"}, Q::length);
    result.tip_mm = magnitude(values.common(parts, {"tip_diameter"}, Q::length));
    const Components made_of = materials(values, gears);
    result.young_modulus_Pa = values.common(made_of, {"elastic_modulus"}, Q::modulus);
    result.poisson_ratio = values.common(made_of, {"poisson_ratio"}, Q::number);
    return result;
}

RexsTeeth rexs_teeth(RexsValues& values, const RexsStage& stage,
                     const std::vector<RexsGear>& gears) {
    RexsTeeth teeth;
    teeth.module_mm = shared(values, gears, &RexsGear::module_mm, "normal_module");
    teeth.pressure_angle_deg =
        shared(values, gears, &RexsGear::pressure_angle_deg, "normal_pressure_angle");
    teeth.helix_deg = shared(values, gears, &RexsGear::helix_deg, "helix_angle_reference_diameter");
    teeth.face_width_mm = common_width(values, stage, gears, teeth.notes);
    Components pairs = stage.first_pairs;
    pairs.insert(pairs.end(), stage.second_pairs.begin(), stage.second_pairs.end());
    for (const RexsComponent* pair : pairs) {
        values.consider(*pair);
        for (const RexsComponent* data :
             values.model().related("stage_gear_data", "stage", pair->id, "stage_gear_data")) {
            values.consider(*data);
            values.flag(*data, "is_driving_gear");
        }
    }
    values.consider(*stage.component);
    teeth.centre_distance_mm =
        magnitude(values.common(pairs, {"center_distance", "centre_distance"}, Q::length));
    teeth.young_modulus_Pa =
        combined(gears, &RexsGear::young_modulus_Pa, "Young's modulus, Pa", teeth.notes);
    teeth.poisson_ratio = combined(gears, &RexsGear::poisson_ratio, "Poisson's ratio", teeth.notes);
    check_hands(values, stage);
    return teeth;
}

void check_centre_distance(RexsValues& values, const RexsComponent& pair, const RexsTeeth& teeth,
                           const RexsGear& gear_1, const RexsGear& gear_2, bool internal,
                           std::vector<std::string>& notes) {
    // Backlash in modules: rounding of shifts to two decimals; more than any allowance of tooth
    // thickness.
    constexpr double kRounded = 0.01, kContradiction = 0.1;
    if (!teeth.centre_distance_mm || !gear_1.shift || !gear_2.shift || !teeth.module_mm ||
        !(*teeth.module_mm > 0.0) || gear_1.teeth < 1 || gear_2.teeth < 1 ||
        gear_1.teeth == gear_2.teeth * (internal ? 1 : 0)) {
        return;
    }
    const gears::Gear one = transverse_gear(teeth, gear_1, false),
                      two = transverse_gear(teeth, gear_2, internal);
    const double fits_mm = 1e3 * gears::tight_centre_distance(one, two);
    // Larger distances open external meshes and close internal ones.
    const double gap = (internal ? -1.0 : 1.0) * (*teeth.centre_distance_mm - fits_mm) * 2.0 *
                       std::tan(one.pressure_angle_rad) / *teeth.module_mm;
    if (!(gap > kContradiction || gap < -kRounded)) {
        if (gap > kRounded) {
            notes.push_back(fmt::format("{} and {} have a backlash of about {:.3g} mm at {:.6g} mm",
                                        gear_1.component->label(), gear_2.component->label(),
                                        gap * *teeth.module_mm, *teeth.centre_distance_mm));
        }
        return;
    }
    values.reject(pair, "center_distance",
                  fmt::format("is {:.6g} mm, but {} and {} teeth with shifts of {:g} and {:g} fit "
                              "at {:.6g} mm",
                              *teeth.centre_distance_mm, gear_1.teeth, gear_2.teeth, *gear_1.shift,
                              *gear_2.shift, fits_mm),
                  "correct the distance, the teeth or the shifts (a positive shift makes teeth "
                  "thicker, also those of a ring: ISO 21771)");
}

std::optional<double> rexs_bearings(RexsValues& values, const Components& shafts,
                                    const std::string& member, std::vector<std::string>& notes) {
    constexpr double kRigid_N_m = 1e13;
    double sum = 0;
    std::string unusable;
    for (const RexsRelation& relation : values.model().relations) {
        const RexsComponent* bearing =
            relation.type == "side" ? values.model().component(relation.part("assembly")) : nullptr;
        if (bearing == nullptr || bearing->type.find("bearing") == std::string::npos) {
            continue;
        }
        const bool here = std::ranges::any_of(shafts, [&](const RexsComponent* shaft) {
            return shaft != nullptr && (relation.part("inner_part") == shaft->id ||
                                        relation.part("outer_part") == shaft->id);
        });
        if (!here) {
            continue;
        }
        values.consider(*bearing);
        const auto stiffness = values.number(*bearing, "radial_stiffness", Q::stiffness);
        if (!stiffness || !(*stiffness > 0.0) || *stiffness >= kRigid_N_m) {
            unusable += (unusable.empty() ? "" : ", ") + bearing->label() +
                        (stiffness ? fmt::format(" ({:g} N/m)", *stiffness) : "");
        } else {
            sum += *stiffness;
        }
    }
    if (!unusable.empty()) {
        notes.push_back(
            fmt::format("bearings of the {} that are rigid or state no radial "
                        "stiffness, replaced by the rule: {}",
                        member, unusable));
        return {};
    }
    return sum > 0.0 ? std::optional(sum) : std::nullopt;
}

}  // namespace gearpod::mc
