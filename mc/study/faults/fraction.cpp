// Faults given by a lost fraction alone: a broken tooth, and a loss of mesh stiffness
// (stiffness/faults/losses.hpp).
#include "mc/study/faults/fault_kind.hpp"
#include "mc/study/keys/schema_line.hpp"
#include "stiffness/faults/losses.hpp"

namespace gearpod::mc {
namespace {

// Parameter of the kind whose faults are of this family.
template <class Family>
struct Lost : FaultShape {
    std::optional<double> fraction;  // 0..1

    bool operator==(const Lost&) const = default;
};

// clang-format off
constexpr FaultSize kBrokenSize{"broken", number<&Lost<stiffness::BrokenTooth>::fraction>, kNone, closed_range(0, 1), "fraction of the tooth that has broken off; with 1 it transmits no load"};
constexpr FaultSize kReductionSize{"reduction", number<&Lost<stiffness::Reduction>::fraction>, kNone, closed_range(0, 1), "fraction of the mesh stiffness that is lost while the faulty tooth is in contact"};
// clang-format on

// Every tooth can lose any fraction. The key of the fraction has the kind's name.
template <class Family>
class FractionKind final : public FaultKind {
  public:
    FractionKind(const FaultSize& size, std::string_view words, std::string_view origin)
        : size_(size), words_(words), origin_(origin) {}

    std::string_view name() const override { return size_.name; }
    std::string_view words() const override { return words_; }
    const FaultSize& size() const override { return size_; }
    bool shapes_tooth() const override { return false; }

    std::string origin(const Study&, std::span<const double>) const override {
        return std::string(origin_);
    }

    std::unique_ptr<const stiffness::ToothFaultFamily> family(const Study&,
                                                              const FaultyTooth&) const override {
        return std::make_unique<const Family>();
    }

  private:
    const FaultSize& size_;
    std::string_view words_, origin_;
};

}  // namespace

const FaultKind& broken() {
    static const FractionKind<stiffness::BrokenTooth> kind{
        kBrokenSize, "a broken tooth",
        "the tooth pair loses this fraction of its stiffness, for any profile"};
    return kind;
}

const FaultKind& reduction() {
    static const FractionKind<stiffness::Reduction> kind{
        kReductionSize, "a stiffness reduction",
        "the whole mesh loses this fraction of its stiffness while the tooth is in contact"};
    return kind;
}

}  // namespace gearpod::mc
