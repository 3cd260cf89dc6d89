#include "mc/study/faults/fault_kind.hpp"

namespace gearpod::mc {

std::string FaultKind::share_text(const Study& /*study*/, double /*size*/) const {
    return "";
}

std::vector<FaultKey> FaultKind::keys() const {
    const FaultSize& s = size();
    std::vector<FaultKey> all{{s.name, s.access, s.unit, s.range, Need::required, "", s.doc}};
    const auto others = other_keys();
    all.insert(all.end(), others.begin(), others.end());
    return all;
}

}  // namespace gearpod::mc
