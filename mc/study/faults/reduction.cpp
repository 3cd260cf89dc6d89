// Tooth fault given only by the loss of mesh stiffness: stiffness/faults/losses.hpp.
#include "mc/study/faults/fault_kind.hpp"
#include "mc/study/keys/access.hpp"
#include "mc/study/keys/units.hpp"
#include "stiffness/faults/losses.hpp"

namespace gearpod::mc {
namespace {

struct LostStiffness : FaultShape {
    std::optional<double> lost;  // fraction, 0..1

    bool operator==(const LostStiffness&) const = default;
};

// clang-format off
constexpr FaultSize kReductionSize{"reduction", number<&LostStiffness::lost>, kNone, from_to(0, 1), "fraction of the mesh stiffness that is lost while the faulty tooth is in contact"};
// clang-format on

class ReductionKind final : public FaultKind {
  public:
    std::string_view name() const override { return "reduction"; }
    std::string_view words() const override { return "a reduction"; }
    const FaultSize& size() const override { return kReductionSize; }
    std::span<const FaultKey> other_keys() const override { return {}; }
    bool shapes_tooth() const override { return false; }
    // Every tooth can lose any fraction.
    void check(StudyDraft&) const override {}

    std::string origin(const Study&, std::span<const double>) const override {
        return "the whole mesh loses this fraction of its stiffness while the tooth is in contact";
    }

    std::unique_ptr<const stiffness::ToothFaultFamily> family(const Study&,
                                                              const FaultyTooth&) const override {
        return std::make_unique<const stiffness::Reduction>();
    }
};

}  // namespace

const FaultKind& reduction() {
    static const ReductionKind kind{};
    return kind;
}

}  // namespace gearpod::mc
