#include "mc/study/faults/crack_angle.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <string_view>

#include "mc/study/faults/limits.hpp"
#include "mc/study/gears.hpp"
#include "stiffness/teeth/crack_path.hpp"
#include "stiffness/teeth/tooth_profile.hpp"

namespace gearpod::mc {

namespace {

stiffness::ToothProfile faulty_tooth(const Study& study) {
    return {gear_of(study, study.fault.member.value()), profile_of(study)};
}

std::string_view start_name(const Study& study) {
    using stiffness::Profile;
    if (gear_of(study, study.fault.member.value()).internal) {
        return "the flank's end on the root circle";
    }
    switch (profile_of(study)) {
        case Profile::base_circle:
            return "the flank's end on the base circle";
        case Profile::root_circle:
            return "the flank's end on the root circle";
        case Profile::fillet:
            break;
    }
    return crack_law(study) == stiffness::CrackLaw::sections
               ? "the fillet's end on the root circle"
               : "the fillet's surface at its 30 deg tangent (the critical section)";
}

double section_share(const Study& study, double depth_m) {
    return depth_m * std::sin(crack_angle_rad(study)) / critical_section_m(study);
}

}  // namespace

double crack_angle_rad(const Study& study) {
    return study.fault.shapes.get<CrackShape>().angle_rad;
}

stiffness::CrackLaw crack_law(const Study& study) {
    const bool fillet = profile_of(study) == stiffness::Profile::fillet;
    return study.fault.shapes.get<CrackShape>().law.value_or(
        fillet ? stiffness::CrackLaw::fracture_mechanics : stiffness::CrackLaw::sections);
}

double max_crack_depth_m(const Study& study) {
    return stiffness::max_crack_depth(faulty_tooth(study), crack_law(study),
                                      crack_angle_rad(study));
}

double critical_section_m(const Study& study) {
    const stiffness::ToothProfile tooth = faulty_tooth(study);
    return crack_law(study) == stiffness::CrackLaw::sections
               ? 2.0 * tooth.root_half_thickness()
               : stiffness::CrackPath(tooth, crack_angle_rad(study)).thickness();
}

std::string crack_share_text(const Study& study, double depth_m) {
    return part_text(section_share(study, depth_m)) + " of the tooth section";
}

std::string crack_origin(const Study& study, std::span<const double> depths_m) {
    std::vector<std::string> depths, shares;
    for (const double depth_m : depths_m) {
        depths.push_back(fmt::format("{:.4g}", depth_m * kMmPerM));
        shares.push_back(fmt::format("{:.3g}", 100.0 * section_share(study, depth_m)));
    }
    return fmt::format(
        "depth along the crack from {}, where the tooth is {:.4g} mm thick; {} mm is {} % of that "
        "section",
        start_name(study), critical_section_m(study) * kMmPerM, fmt::join(depths, ", "),
        fmt::join(shares, ", "));
}

std::string deeper_than_tooth_text(const Study& study) {
    return fmt::format("than the tooth (a crack at {:.4g} deg cuts through it after {} mm)",
                       crack_angle_rad(study) * 180.0 / kPi,
                       rounded_down(max_crack_depth_m(study) * kMmPerM));
}

}  // namespace gearpod::mc
