#include "mc/plan/fault_plan.hpp"

#include <fmt/format.h>

#include "mc/files/input/problems.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/schema/sizes.hpp"

namespace gearpod::mc {
namespace {

std::string location_of(const Study& study) {
    const Fault& fault = study.fault;
    return !fault.side ? fmt::format("the {}", member_name(*fault.member))
                       : fmt::format("planet {}, {} side{}", fault.planet,
                                     choice_text(study, "fault", "side"),
                                     *fault.side == FaultSide::both ? "s" : "");
}

}  // namespace

FaultPlan make_fault_plan(const Study& study) {
    FaultPlan plan;
    plan.size_key = &fault_size_key(study);
    if (study.fault.kind == nullptr) {
        return plan;
    }
    const FaultKind& kind = *study.fault.kind;
    plan.kind = kind.name();
    plan.words = kind.words();
    plan.title = kind.title();
    plan.location = location_of(study);
    plan.sizes = fault_sizes(study);
    if (has_gears(study)) {
        plan.origin = kind.origin(study, plan.sizes);
        plan.share = kind.share(study);
    }
    plan.groups = !size_edges(study).empty();
    return plan;
}

std::string FaultPlan::name_at(double size) const {
    return fmt::format("{}_{:g}{}", kind, size / unit().to_si, unit().suffix);
}

}  // namespace gearpod::mc
