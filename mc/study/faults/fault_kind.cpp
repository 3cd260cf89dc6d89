#include "mc/study/faults/fault_kind.hpp"

#include <fmt/format.h>

#include <cmath>

namespace gearpod::mc {

std::string SizeShare::text(double size) const {
    if (of.empty()) {
        return "";
    }
    const double percent = 100.0 * (size * factor / whole);
    return fmt::format(fmt::runtime(percent < 10.0 ? "{:.2g} % of {}" : "{:.0f} % of {}"), percent,
                       of);
}

std::vector<FaultKey> FaultKind::keys() const {
    const FaultSize& s = size();
    std::vector<FaultKey> all{{s.name, s.access, s.unit, s.range, Need::required, "", s.doc}};
    const auto others = other_keys();
    all.insert(all.end(), others.begin(), others.end());
    return all;
}

// Each is defined in the file of its name, the last two in fraction.cpp.
const FaultKind &crack(), &spatial_crack(), &chip(), &breakage(), &pitting(), &wear(), &broken(),
    &reduction();

std::span<const FaultKind* const> all_faults() {
    static const FaultKind* const kinds[] = {
        &crack(),   &spatial_crack(), &chip(),   &breakage(),
        &pitting(), &wear(),          &broken(), &reduction(),
    };
    return kinds;
}

const FaultKind& size_defining_kind(const Study& study) {
    return study.fault.kind != nullptr ? *study.fault.kind : crack();
}

double rounded_down(double limit) {
    return std::floor(limit * 1e4) / 1e4;
}

void check_size(StudyDraft& draft, const SizeLimit& limit) {
    const FaultSize& key = draft.study.fault.kind->size();
    const std::string path = "fault." + std::string(key.name);
    const std::string unit = key.unit.suffix.empty() ? "" : " " + std::string(key.unit.name);
    const std::string remedy =
        fmt::format("stay at or below {}{}", rounded_down(limit.largest), unit);
    const auto what = [&](double size) { return fmt::format("{}{} is {}", size, unit, limit.why); };
    const double nominal = key.access.get(draft.study).value_or(0.0) / key.unit.to_si;
    if (draft.given.contains(path) && nominal > limit.largest * kMargin) {
        draft.reject(draft.given.at(path), path, what(nominal), remedy);
    }
    const RandomInput* random = draft.study.find_random(path);
    if (random == nullptr) {
        return;
    }
    const double largest = random->distribution.in_unit_of_file().support().high;
    if (largest > limit.largest * kMargin) {
        draft.reject(draft.given_random.at(path), "random." + path, what(largest), remedy);
    }
}

void check_on_face(StudyDraft& draft) {
    const double face_mm = *draft.study.gearbox.face_width_m * kMmPerM;
    check_size(draft, {face_mm, fmt::format("wider than the face, {:.6g} mm", face_mm)});
}

SizeShare share_of_face(const Study& study) {
    return {1.0, *study.gearbox.face_width_m, "the face width"};
}

double tooth_height_m(const Study& study) {
    const gears::Gear gear = gear_of(study, *study.fault.member);
    return std::abs(gear.tip_radius() - gear.root_radius());
}

}  // namespace gearpod::mc
