#include "mc/study/faults/fault_kind.hpp"

#include <fmt/format.h>

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

}  // namespace gearpod::mc
