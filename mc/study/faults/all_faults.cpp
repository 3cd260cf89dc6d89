#include "mc/study/faults/all_faults.hpp"

namespace gearpod::mc {

// Each is defined in the file of its name.
const FaultKind &crack(), &spatial_crack(), &chip(), &pitting(), &wear(), &broken(), &reduction();

std::span<const FaultKind* const> all_faults() {
    static const FaultKind* const kinds[] = {
        &crack(), &spatial_crack(), &chip(), &pitting(), &wear(), &broken(), &reduction(),
    };
    return kinds;
}

const FaultKind* find_fault(std::string_view name) {
    for (const FaultKind* kind : all_faults()) {
        if (kind->name() == name) {
            return kind;
        }
    }
    return nullptr;
}

const FaultKind& size_defining_kind(const Study& study) {
    return study.fault.kind != nullptr ? *study.fault.kind : crack();
}

}  // namespace gearpod::mc
