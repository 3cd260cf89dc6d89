#include "stiffness/helical_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <stdexcept>

#include "stiffness/teeth/positions.hpp"

namespace gearpod::stiffness {

namespace {

constexpr double kIntegralTolerance = 1e-10;  // fraction of the spur pair's mean stiffness

// Transitions within [begin, end], and both ends.
std::vector<double> points_within(std::span<const double> transitions, double begin, double end) {
    std::vector<double> points{begin, end};
    for (double period = std::floor(begin); period <= end; ++period)
        for (const double phase : transitions)
            if (const double position = period + phase;
                position > begin + kPositionTolerance && position < end - kPositionTolerance)
                points.push_back(position);
    sort_positions(points);
    return points;
}

std::vector<double> helical_transitions(const MeshStiffness& spur, double overlap) {
    std::vector<double> phases;
    for (const double phase : spur.transitions())
        for (const double later : {0.0, overlap}) {
            const double position = phase + later - std::floor(phase + later);
            phases.push_back(position > 1 - kPositionTolerance ? 0 : position);
        }
    sort_positions(phases);
    return phases;
}

// Adds integral / width over the window of that width that ends `late` before tau, for ascending
// tau. If the curve repeats every mesh period, `inside` is a position within the stretch of tau,
// else null.
void add_mean(const RunningIntegral& integral, double width, std::span<const double> tau,
              std::span<double> mean, const double* inside = nullptr, double late = 0) {
    std::vector<double> t(tau.size()), value(tau.size());
    for (const bool end : {true, false}) {
        const double back = end ? late : late + width;
        const double period = inside ? std::floor(*inside - back) : 0;
        std::transform(tau.begin(), tau.end(), t.begin(), [&](double position) {
            return inside ? std::clamp(position - back - period, 0.0, 1.0) : position - back;
        });
        integral(t, value);
        for (std::size_t i = 0; i < t.size(); ++i)
            mean[i] += (end ? 1 : -1) * (value[i] + period * integral.whole()) / width;
    }
}

RunningIntegral integral_of_period(const MeshStiffness& spur, double tolerance) {
    return {[&](auto t, double inside, auto values) { spur.total(t, inside, values); },
            points_within(spur.transitions(), 0, 1), tolerance};
}

// Stiffness of a healthy tooth pair of the spur pair, N/m.
void spur_pair(const MeshStiffness& spur, std::span<const double> t, double inside,
               std::span<double> values) {
    std::vector<double> all(t.size());
    spur.share(t, inside, values);
    spur.total(t, inside, all);
    std::transform(values.begin(), values.end(), all.begin(), values.begin(), std::multiplies<>());
}

RunningIntegral integral_of_pair(const MeshStiffness& spur, double tolerance) {
    return {[&](auto t, double inside, auto values) { spur_pair(spur, t, inside, values); },
            points_within(spur.transitions(), 0, spur.contact_ratio()), tolerance};
}

double checked(double overlap_ratio) {
    if (!(overlap_ratio > 0))
        throw std::invalid_argument(
            fmt::format("an overlap ratio of {} (must be positive)", overlap_ratio));
    return overlap_ratio;
}

}  // namespace

// Helical mesh with a fault. Integrates the stiffness lost by the spur pair, which is 0 outside the
// fault's passage.
class FaultyHelicalMesh : public FaultyMesh {
  public:
    FaultyHelicalMesh(const HelicalMesh& healthy, const ToothFault& fault)
        : healthy_(healthy),
          spur_(healthy.slice().with_fault(fault)),
          late_(healthy.overlap_ * fault.face().begin),
          width_(healthy.overlap_ * (fault.face().end - fault.face().begin)),
          lost_(integral([&](auto t, double inside, auto values) {
              std::vector<double> whole(t.size());
              spur_->total(t, inside, values);
              healthy_.slice().total(t, inside, whole);
              subtract(whole, values);
          })) {}

    double duration() const override { return spur_->duration() + healthy_.overlap_; }
    const FaultyMesh& slice() const override { return *spur_; }

    void total(std::span<const double> tau, double inside,
               std::span<double> stiffness) const override {
        healthy_.total(tau, inside, stiffness);
        add_mean(lost_, width_, tau, stiffness, nullptr, late_);
    }

    void tooth_pair(int tooth, std::span<const double> tau, double inside,
                    std::span<double> stiffness) const override {
        std::fill(stiffness.begin(), stiffness.end(), 0.0);
        if (inside <= tooth || inside >= tooth + healthy_.contact_ratio())
            return;
        std::vector<double> shifted(tau.size());
        std::transform(tau.begin(), tau.end(), shifted.begin(),
                       [&](double t) { return t - tooth; });
        healthy_.one_pair(shifted, stiffness);
        std::call_once(tooth_pairs_fitted_, [&] { integrate_tooth_pairs(); });
        const std::size_t i = static_cast<std::size_t>(tooth - first_tooth());
        if (tooth >= first_tooth() && i < lost_by_tooth_.size())
            add_mean(lost_by_tooth_[i], width_, tau, stiffness, nullptr, late_);
    }

  private:
    static void subtract(std::span<const double> from, std::span<double> values) {
        std::transform(values.begin(), values.end(), from.begin(), values.begin(), std::minus<>());
    }

    // First of the tooth pairs of the spur pair that touch during its passage.
    int first_tooth() const {
        return 1 - static_cast<int>(std::ceil(healthy_.slice().contact_ratio()));
    }

    RunningIntegral integral(const RunningIntegral::Curve& curve) const {
        std::vector<double> points =
            points_within(healthy_.slice().transitions(), 0, spur_->duration());
        for (const double jump : spur_->jumps())
            points.push_back(jump);
        sort_positions(points);
        return {curve, points, healthy_.tolerance_};
    }

    void integrate_tooth_pairs() const {
        for (int tooth = first_tooth(); tooth < spur_->duration(); ++tooth)
            lost_by_tooth_.push_back(integral([&](auto t, double inside, auto values) {
                std::vector<double> shifted(t.size()), whole(t.size());
                std::transform(t.begin(), t.end(), shifted.begin(),
                               [&](double position) { return position - tooth; });
                spur_->tooth_pair(tooth, t, inside, values);
                spur_pair(healthy_.slice(), shifted, inside - tooth, whole);
                subtract(whole, values);
            }));
    }

    const HelicalMesh& healthy_;
    std::unique_ptr<const FaultyMesh> spur_;
    // mesh periods: delay of the fault's first slice, and from first to last slice
    double late_, width_;
    RunningIntegral lost_;
    mutable std::once_flag tooth_pairs_fitted_;
    mutable std::vector<RunningIntegral> lost_by_tooth_;
};

HelicalMesh::HelicalMesh(std::unique_ptr<const MeshStiffness> spur, double overlap_ratio)
    : spur_(std::move(spur)),
      overlap_(checked(overlap_ratio)),
      tolerance_(kIntegralTolerance * mean_total(*spur_)),
      transitions_(helical_transitions(*spur_, overlap_)),
      period_(integral_of_period(*spur_, tolerance_)),
      pair_(integral_of_pair(*spur_, tolerance_)) {}

double HelicalMesh::flank_position(double tau) const {
    const double ratio = spur_->contact_ratio();
    const double oldest = std::clamp(tau, 0.0, ratio);
    const double youngest = std::clamp(tau - overlap_, 0.0, ratio);
    return 0.5 * (oldest + youngest) / ratio - 0.5;
}

void HelicalMesh::one_pair(std::span<const double> tau, std::span<double> stiffness) const {
    add_mean(pair_, overlap_, tau, stiffness);
}

void HelicalMesh::total(std::span<const double> tau, double inside,
                        std::span<double> stiffness) const {
    std::fill(stiffness.begin(), stiffness.end(), 0.0);
    add_mean(period_, overlap_, tau, stiffness, &inside);
}

void HelicalMesh::share(std::span<const double> tau, double inside, std::span<double> share) const {
    std::fill(share.begin(), share.end(), 0.0);
    if (inside < 0 || inside > contact_ratio())
        return;
    one_pair(tau, share);
    std::vector<double> all(tau.size());
    total(tau, inside, all);
    std::transform(share.begin(), share.end(), all.begin(), share.begin(), std::divides<>());
}

std::unique_ptr<const FaultyMesh> HelicalMesh::with_fault(const ToothFault& fault) const {
    return std::make_unique<FaultyHelicalMesh>(*this, fault);
}

}  // namespace gearpod::stiffness
