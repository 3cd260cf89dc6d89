// Looks up a kind of fault by its name, for tests.
#pragma once

#include "mc/study/faults/fault_kind.hpp"
#include "tests/test.hpp"

namespace gearpod::tests {

// Kind with this name, or nullptr.
inline const mc::FaultKind* find_fault(std::string_view name) {
    for (const mc::FaultKind* kind : mc::all_faults()) {
        if (kind->name() == name) {
            return kind;
        }
    }
    return nullptr;
}

}  // namespace gearpod::tests
