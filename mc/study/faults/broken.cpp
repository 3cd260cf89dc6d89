// Broken tooth, of which a fraction has broken off: stiffness/faults/losses.hpp.
#include "mc/study/faults/fault_kind.hpp"
#include "mc/study/keys/access.hpp"
#include "mc/study/keys/units.hpp"
#include "stiffness/faults/losses.hpp"

namespace gearpod::mc {
namespace {

struct LostTooth : FaultShape {
    std::optional<double> lost;  // fraction, 0..1

    bool operator==(const LostTooth&) const = default;
};

// clang-format off
constexpr FaultSize kBrokenSize{"broken", number<&LostTooth::lost>, kNone, from_to(0, 1), "fraction of the tooth that has broken off; with 1 it transmits no load"};
// clang-format on

class BrokenKind final : public FaultKind {
  public:
    std::string_view name() const override { return "broken"; }
    std::string_view words() const override { return "a broken tooth"; }
    const FaultSize& size() const override { return kBrokenSize; }
    std::span<const FaultKey> other_keys() const override { return {}; }
    bool shapes_tooth() const override { return false; }
    // Every tooth can lose any fraction.
    void check(StudyDraft&) const override {}

    std::string origin(const Study&, std::span<const double>) const override {
        return "the tooth pair loses this fraction of its stiffness, for any profile";
    }

    std::unique_ptr<const stiffness::ToothFaultFamily> family(const Study&,
                                                              const FaultyTooth&) const override {
        return std::make_unique<const stiffness::BrokenTooth>();
    }
};

}  // namespace

const FaultKind& broken() {
    static const BrokenKind kind{};
    return kind;
}

}  // namespace gearpod::mc
