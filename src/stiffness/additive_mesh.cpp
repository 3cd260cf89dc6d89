#include "stiffness/additive_mesh.hpp"

#include <algorithm>
#include <cmath>

#include "stiffness/teeth/positions.hpp"
#include "stiffness/teeth/tooth_compliance.hpp"

namespace gearpod::stiffness {

namespace {

// fraction of the stiffness of contact and mating tooth
constexpr double kFaultyPairTolerance = 4e-10;

// Ages of the tooth pairs in contact inside a stretch. They stand at tau + age, youngest first.
struct Ages {
    int first, last;  // one past the last
};

Ages touching(double inside, double contact_ratio) {
    return {-static_cast<int>(std::floor(inside)),
            static_cast<int>(std::ceil(contact_ratio - inside))};
}

void shift(std::span<const double> tau, int age, std::span<double> position) {
    const std::size_t count = tau.size();
#pragma omp simd
    for (std::size_t i = 0; i < count; ++i)
        position[i] = tau[i] + age;
}

void add(std::span<const double> more, std::span<double> sum) {
    const std::size_t count = sum.size();
#pragma omp simd
    for (std::size_t i = 0; i < count; ++i)
        sum[i] += more[i];
}

}  // namespace

class FaultyAdditiveMesh : public FaultyMesh {
  public:
    FaultyAdditiveMesh(const AdditiveMesh& healthy, const ToothFault& fault)
        : healthy_(healthy),
          teeth_(fault.teeth()),
          factor_(fault.mesh_factor()),
          curve_(healthy.faulty_pair(fault)) {
        for (int tooth = 0; tooth < teeth_; ++tooth)
            for (const double jump : fault.jumps())
                jumps_.push_back(tooth + jump);
        std::sort(jumps_.begin(), jumps_.end());
    }

    double duration() const override { return teeth_ - 1 + healthy_.contact_ratio(); }
    std::vector<double> jumps() const override { return jumps_; }

    void total(std::span<const double> tau, double inside,
               std::span<double> stiffness) const override {
        const Stretch stretch = stretch_around(healthy_.transitions_, jumps_, inside);
        std::vector<double> position(tau.size()), pair_stiffness(tau.size());
        std::fill(stiffness.begin(), stiffness.end(), 0.0);
        const Ages ages = touching(inside, healthy_.contact_ratio());
        for (int age = ages.first; age < ages.last; ++age) {
            shift(tau, age, position);
            one_pair(age, stretch, position, pair_stiffness);
            add(pair_stiffness, stiffness);
        }
        for (double& k : stiffness)
            k *= factor_;
    }

    void tooth_pair(int tooth, std::span<const double> tau, double inside,
                    std::span<double> stiffness) const override {
        std::fill(stiffness.begin(), stiffness.end(), 0.0);
        if (inside <= tooth || inside >= tooth + healthy_.contact_ratio())
            return;
        std::vector<double> position(tau.size());
        shift(tau, -tooth, position);
        one_pair(-tooth, stretch_around(healthy_.transitions_, jumps_, inside), position,
                 stiffness);
        for (double& k : stiffness)
            k *= factor_;
    }

  private:
    void one_pair(int age, const Stretch& stretch, std::span<const double> position,
                  std::span<double> stiffness) const {
        if (age > 0 || age <= -teeth_)
            healthy_.pair_(position, stiffness);
        else
            curve_(position, {stretch.begin + age, stretch.end + age}, stiffness);
    }

    const AdditiveMesh& healthy_;
    int teeth_;
    double factor_;
    ToothPairCurve curve_;
    std::vector<double> jumps_;
};

AdditiveMesh::AdditiveMesh(const gears::MeshGeometry& geometry, const Material& material,
                           Profile profile, double tolerance)
    : contact_ratio_(geometry.contact_ratio()),
      pitch_position_(geometry.pitch_position()),
      contact_(1 / hertz_stiffness(material)),
      beams_{healthy_beam(geometry, material, {geometry.gear(1), profile}, tolerance, 1),
             healthy_beam(geometry, material, {geometry.gear(2), profile}, tolerance, 2)},
      pair_([&](double tau) { return 1 / (contact_ + beams_[0](tau) + beams_[1](tau)); }, 0,
            contact_ratio_, kSeriesNodes, std::max(tolerance, kSeriesTolerance)),
      fit_(std::max(tolerance, kFaultyPairTolerance) / (contact_ + beams_[1](contact_ratio_ / 2))),
      transitions_(contact_transitions(contact_ratio_)) {}

double AdditiveMesh::tooth_pair(double tau) const {
    double stiffness = 0;
    tooth_pair({&tau, 1}, {&stiffness, 1});
    return stiffness;
}

void AdditiveMesh::tooth_pair(std::span<const double> tau, std::span<double> stiffness) const {
    EXPECTS(ascend(tau));
    std::fill(stiffness.begin(), stiffness.end(), 0.0);
    const auto [first, count] = positions_within(tau, 0, contact_ratio_);
    pair_(tau.subspan(first, count), stiffness.subspan(first, count));
}

void AdditiveMesh::total(std::span<const double> tau, double inside,
                         std::span<double> stiffness) const {
    std::vector<double> position(tau.size()), pair_stiffness(tau.size());
    std::fill(stiffness.begin(), stiffness.end(), 0.0);
    const Ages ages = touching(inside, contact_ratio_);
    for (int age = ages.first; age < ages.last; ++age) {
        shift(tau, age, position);
        pair_(position, pair_stiffness);
        add(pair_stiffness, stiffness);
    }
}

void AdditiveMesh::share(std::span<const double> tau, double inside,
                         std::span<double> share) const {
    std::fill(share.begin(), share.end(), 0.0);
    if (inside < 0 || inside > contact_ratio_)
        return;
    pair_(tau, share);
    std::vector<double> all(tau.size());
    total(tau, inside, all);
    std::transform(share.begin(), share.end(), all.begin(), share.begin(), std::divides<>());
}

ToothPairCurve AdditiveMesh::faulty_pair(const ToothFault& fault) const {
    const int faulty = fault.gear() - 1;
    const auto stiffness = [&](std::span<const double> tau, std::span<double> values) {
        std::array<double, ToothPairCurve::kMaxTerms> mate;
        beams_[1 - faulty](tau, mate);
        if (fault.changes_sections())
            fault.beam_compliance(tau, values);
        else
            beams_[faulty](tau, values);
        for (std::size_t i = 0; i < tau.size(); ++i) {
            const double width = fault.changes_contact() ? fault.contact_width(tau[i]) : 1.0;
            values[i] =
                width > 0 ? fault.pair_factor() / (contact_ / width + mate[i] + values[i]) : 0.0;
        }
    };
    return fit_(stiffness, fault.breaks(), contact_ratio_);
}

std::unique_ptr<const FaultyMesh> AdditiveMesh::with_fault(const ToothFault& fault) const {
    return std::make_unique<FaultyAdditiveMesh>(*this, fault);
}

}  // namespace gearpod::stiffness
