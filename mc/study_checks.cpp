#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "features/feature.hpp"
#include "gears/mesh_geometry.hpp"
#include "gears/planetary.hpp"
#include "mc/study_draft.hpp"
#include "mc/study_gears.hpp"
#include "mc/study_spelling.hpp"

namespace gearpod::mc {
namespace {

constexpr std::string_view kMemberNames[] = {"sun", "planet", "ring", "carrier"};

std::string_view member_name(Member member) {
    return kMemberNames[static_cast<int>(member)];
}

bool all_usable(const StudyDraft& draft, const std::vector<std::string>& paths) {
    return std::all_of(paths.begin(), paths.end(), [&](const std::string& path) {
        return draft.usable(path) && draft.usable(path.substr(0, path.find('.')));
    });
}

void reject(StudyDraft& draft, const std::string& path, std::string what, std::string remedy) {
    draft.reject(draft.position(path), path, std::move(what), std::move(remedy));
}

void check_teeth(StudyDraft& draft) {
    const Gearbox& g = draft.study.gearbox;
    if (!all_usable(draft, {"gearbox.sun_teeth", "gearbox.planet_teeth", "gearbox.ring_teeth"})) {
        return;
    }
    const int given = int{g.sun_teeth.has_value()} + int{g.planet_teeth.has_value()} +
                      int{g.ring_teeth.has_value()};
    if (given == 1 || given == 2) {
        reject(draft, "gearbox", "some tooth numbers are missing",
               "give sun_teeth, planet_teeth and ring_teeth, or none of them");
    }
    if (given != 3 || !all_usable(draft, {"gearbox.planets", "gearbox.addendum_coefficient"}) ||
        g.planets < 1) {
        return;
    }
    const gears::PlanetaryTrain train{*g.sun_teeth, *g.planet_teeth, *g.ring_teeth, g.planets};
    for (const std::string& what : gears::assembly_problems(train, g.addendum_coefficient)) {
        reject(draft, "gearbox.ring_teeth", "the gears cannot be assembled (" + what + ")", "");
    }
}

// Two gears, each of them possible, that do not mesh. Below the standard pressure angle it is
// named, else the smaller gear's teeth.
void check_mesh(StudyDraft& draft, Member driver, Member driven) {
    const gears::Gear gear_1 = gear_of(draft.study.gearbox, driver);
    const gears::Gear gear_2 = gear_of(draft.study.gearbox, driven);
    if (!gears::gear_problems(gear_1).empty() || !gears::gear_problems(gear_2).empty()) {
        return;
    }
    constexpr double kStandardAngle = 20.0 * std::numbers::pi / 180.0;
    const Member smaller = gear_2.teeth < gear_1.teeth ? driven : driver;
    const std::string key = gear_1.pressure_angle_rad < kStandardAngle * (1.0 - 1e-12)
                                ? "gearbox.pressure_angle_deg"
                                : fmt::format("gearbox.{}_teeth", member_name(smaller));
    for (const std::string& what : gears::mesh_problems(gear_1, gear_2)) {
        reject(draft, key,
               fmt::format("{} and {} do not mesh ({})", member_name(driver), member_name(driven),
                           what),
               "");
    }
}

void check_gear_shapes(StudyDraft& draft) {
    const Gearbox& g = draft.study.gearbox;
    const std::string module = "gearbox.module_mm";
    const bool usable =
        all_usable(draft, {"gearbox.sun_teeth", "gearbox.planet_teeth", "gearbox.ring_teeth",
                           module, "gearbox.pressure_angle_deg", "gearbox.addendum_coefficient",
                           "gearbox.dedendum_coefficient", "gearbox.tooth_profile"});
    if (!usable || !g.has_teeth() || !g.module_m || g.tooth_profile == ToothProfile::constant) {
        return;
    }
    for (const Member member : {Member::sun, Member::planet, Member::ring}) {
        for (const std::string& what : gears::gear_problems(gear_of(g, member))) {
            reject(draft, fmt::format("gearbox.{}_teeth", member_name(member)),
                   "the gear is not possible (" + what + ")", "");
        }
    }
    check_mesh(draft, Member::sun, Member::planet);
    check_mesh(draft, Member::planet, Member::ring);
}

void check_operation(StudyDraft& draft) {
    const Operation& o = draft.study.operation;
    if (!all_usable(draft, {"operation.fixed", "operation.input"})) {
        return;
    }
    const std::string_view fixed = member_name(o.fixed);
    const std::string_view remedy = o.fixed == Member::ring  ? "use \"sun\""
                                    : o.fixed == Member::sun ? "use \"ring\""
                                                             : "use \"sun\" or \"ring\"";
    if (o.input == o.fixed) {
        reject(draft, "operation.input",
               fmt::format("is \"{}\", which stands still (operation.fixed)", fixed),
               std::string(remedy));
    } else if (o.input == Member::carrier) {
        reject(
            draft, "operation.input",
            "is \"carrier\" (driving the carrier loads the other flanks of the teeth, which this "
            "model does not have)",
            std::string(remedy));
    }
    const std::string speed = fmt::format("operation.{}_speed_rpm", fixed);
    if (draft.is_given(speed)) {
        reject(draft, speed, fmt::format("the {} stands still (operation.fixed)", fixed),
               "give the speed of another member");
    }
}

void check_sampling(StudyDraft& draft) {
    const Sensor& s = draft.study.sensor;
    if (!all_usable(draft, {"sensor.sampling_Hz"}) || s.sampling_Hz <= 0.0) {
        return;
    }
    if (all_usable(draft, {"sensor.low_pass_Hz"}) && s.low_pass_Hz >= 0.5 * s.sampling_Hz) {
        reject(
            draft, "sensor.low_pass_Hz",
            fmt::format("{} Hz is not below half of sampling_Hz, {} Hz (frequencies above it fold "
                        "back)",
                        s.low_pass_Hz, 0.5 * s.sampling_Hz),
            "lower low_pass_Hz or raise sampling_Hz");
    }
    if (all_usable(draft, {"sensor.encoder_sampling_Hz"}) &&
        s.encoder_sampling_Hz > s.sampling_Hz) {
        reject(draft, "sensor.encoder_sampling_Hz",
               fmt::format("{} Hz is above sampling_Hz, {} Hz (the encoders use a part of the "
                           "sensor's samples)",
                           s.encoder_sampling_Hz, s.sampling_Hz),
               "lower encoder_sampling_Hz or raise sampling_Hz");
    }
}

void check_features(StudyDraft& draft) {
    const auto all = features::all_features();
    std::vector<std::string_view> known;
    for (const features::Feature& feature : all) {
        known.push_back(feature.name);
    }
    const std::vector<std::string>& use = draft.study.features.use;
    for (auto name = use.begin(); name != use.end(); ++name) {
        if (std::find(known.begin(), known.end(), *name) == known.end()) {
            reject(draft, "features.use", fmt::format("unknown feature \"{}\"", *name),
                   suggest(*name, known));
        } else if (std::find(use.begin(), name, *name) != name) {
            reject(draft, "features.use", fmt::format("names \"{}\" twice", *name),
                   "remove one of them");
        }
    }
}

void check_lanes(StudyDraft& draft) {
    const int lanes = draft.study.numerics.lanes;
    if (lanes != 1 && lanes != 8) {
        reject(draft, "numerics.lanes", fmt::format("must be 8 or 1, but is {}", lanes),
               "8 is fast, 1 is for comparison");
    }
}

}  // namespace

void check_consistency(StudyDraft& draft) {
    check_teeth(draft);
    check_gear_shapes(draft);
    check_operation(draft);
    check_sampling(draft);
    check_features(draft);
    check_lanes(draft);
}

}  // namespace gearpod::mc
