#include "mc/study/faults/all_faults.hpp"

namespace gearpod::mc {

// Each is defined in the file of its name, the last two in fraction.cpp.
const FaultKind &crack(), &spatial_crack(), &chip(), &pitting(), &wear(), &broken(), &reduction();

std::span<const FaultKind* const> all_faults() {
    static const FaultKind* const kinds[] = {
        &crack(), &spatial_crack(), &chip(), &pitting(), &wear(), &broken(), &reduction(),
    };
    return kinds;
}

const FaultKind& size_defining_kind(const Study& study) {
    return study.fault.kind != nullptr ? *study.fault.kind : crack();
}

}  // namespace gearpod::mc
