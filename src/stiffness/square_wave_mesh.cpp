#include "stiffness/square_wave_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gearpod::stiffness {

namespace {

// True if the tooth pair at that position is in contact.
bool touches(double position, double contact_ratio) {
    return position > 0 && position < contact_ratio;
}

int touching_pairs(double inside, double contact_ratio) {
    const double youngest = inside - std::floor(inside);
    return 1 + touches(youngest + 1, contact_ratio);
}

class FaultySquareWave : public FaultyMesh {
  public:
    FaultySquareWave(const SquareWaveMesh& healthy, const ToothFault& fault)
        : healthy_(healthy),
          teeth_(fault.teeth()),
          pair_factor_(fault.pair_factor()),
          mesh_factor_(fault.mesh_factor()) {}

    double duration() const override { return teeth_ - 1 + healthy_.contact_ratio(); }

    void total(std::span<const double> /*tau*/, double inside,
               std::span<double> stiffness) const override {
        std::fill(stiffness.begin(), stiffness.end(), mesh_factor_ * pairs_at(inside).total);
    }

    // Stiffness of a tooth pair. A faulty pair has its factor times its share among healthy pairs;
    // the healthy pairs share the rest.
    void tooth_pair(int tooth, std::span<const double> /*tau*/, double inside,
                    std::span<double> stiffness) const override {
        double level = 0;
        if (touches(inside - tooth, healthy_.contact_ratio())) {
            const Pairs pairs = pairs_at(inside);
            level = pair_factor_ * healthy_.level(pairs.all) / pairs.all;
            if (tooth < 0 || tooth >= teeth_)
                level = (pairs.total - pairs.faulty * level) / (pairs.all - pairs.faulty);
        }
        std::fill(stiffness.begin(), stiffness.end(), mesh_factor_ * level);
    }

  private:
    struct Pairs {
        int all = 0, faulty = 0;
        double total = 0;  // without the factor on the mesh
    };
    Pairs pairs_at(double inside) const {
        const double ratio = healthy_.contact_ratio();
        Pairs pairs{touching_pairs(inside, ratio), 0, 0};
        for (int tooth = 0; tooth < teeth_; ++tooth)
            pairs.faulty += touches(inside - tooth, ratio);
        const double sound = healthy_.level(pairs.all - pairs.faulty);
        pairs.total = sound + pair_factor_ * (healthy_.level(pairs.all) - sound);
        return pairs;
    }

    const SquareWaveMesh& healthy_;
    int teeth_;
    double pair_factor_, mesh_factor_;
};

}  // namespace

SquareWaveMesh::SquareWaveMesh(double low_N_m, double high_N_m, double contact_ratio,
                               std::optional<double> pitch_position)
    : levels_{0, low_N_m, high_N_m},
      contact_ratio_(contact_ratio),
      pitch_position_(pitch_position.value_or(contact_ratio / 2)) {
    if (!(low_N_m > 0 && low_N_m <= high_N_m))
        throw std::invalid_argument(
            "a square wave's low level must be positive and not above its high level");
    if (!(contact_ratio >= 1 && contact_ratio <= 2))
        throw std::invalid_argument("a square wave needs a contact ratio between 1 and 2");
}

void SquareWaveMesh::total(std::span<const double> /*tau*/, double inside,
                           std::span<double> stiffness) const {
    std::fill(stiffness.begin(), stiffness.end(), levels_[touching_pairs(inside, contact_ratio_)]);
}

void SquareWaveMesh::share(std::span<const double> /*tau*/, double inside,
                           std::span<double> share) const {
    std::fill(share.begin(), share.end(),
              touches(inside, contact_ratio_) ? 1.0 / touching_pairs(inside, contact_ratio_) : 0.0);
}

std::vector<double> SquareWaveMesh::transitions() const {
    return contact_transitions(contact_ratio_);
}

std::unique_ptr<const FaultyMesh> SquareWaveMesh::with_fault(const ToothFault& fault) const {
    if (fault.changes_sections() || fault.changes_contact())
        throw std::invalid_argument(
            "a mesh given by its stiffness levels has no tooth sections and no contact; only a "
            "broken tooth or a reduction can be its fault");
    return std::make_unique<FaultySquareWave>(*this, fault);
}

}  // namespace gearpod::stiffness
