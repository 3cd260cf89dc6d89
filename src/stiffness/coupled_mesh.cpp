#include "stiffness/coupled_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <stdexcept>

#include "stiffness/foundation/foundation_models.hpp"
#include "stiffness/piecewise_curves.hpp"
#include "stiffness/teeth/positions.hpp"
#include "stiffness/teeth/tooth_compliance.hpp"

namespace gearpod::stiffness {

namespace {

constexpr double kFaultyCurveTolerance = 4e-10;  // fraction of the healthy total

// Number of pairs in contact at a phase strictly between transitions.
int pairs_at(double phase, double contact_ratio) {
    return static_cast<int>(std::ceil(contact_ratio - phase));
}

}  // namespace

// Coupled mesh with a fault. Solves the load sharing at every node of a smooth piece, so that the
// time integration only evaluates the pieces.
class FaultyCoupledMesh : public FaultyMesh {
  public:
    FaultyCoupledMesh(const CoupledMesh& healthy, const ToothFault& fault)
        : healthy_(healthy),
          fault_(fault),
          transitions_(healthy.transitions_),
          duration_(healthy.contact_ratio() + fault.teeth() - 1) {
        for (int period = 0; period <= duration_; ++period)
            for (const double transition : transitions_)
                breaks_.push_back(period + transition);
        for (int tooth = 0; tooth < fault.teeth(); ++tooth) {
            for (const double position : fault.breaks())
                breaks_.push_back(tooth + position);
            for (const double jump : fault.jumps())
                jumps_.push_back(tooth + jump);
        }
        std::sort(breaks_.begin(), breaks_.end());
        std::sort(jumps_.begin(), jumps_.end());
        curve_ = fit([](const SharedLoad& load, int /*period*/) { return load.stiffness; });
    }

    double duration() const override { return duration_; }
    std::vector<double> jumps() const override { return jumps_; }
    void total(std::span<const double> tau, double inside,
               std::span<double> stiffness) const override {
        curve_(tau, stretch_around(transitions_, jumps_, inside), stiffness);
    }
    void tooth_pair(int tooth, std::span<const double> tau, double inside,
                    std::span<double> stiffness) const override {
        std::fill(stiffness.begin(), stiffness.end(), 0.0);
        if (inside <= tooth || inside >= tooth + healthy_.contact_ratio())
            return;
        std::call_once(tooth_pairs_fitted_, [&] { fit_tooth_pairs(); });
        tooth_pairs_[static_cast<std::size_t>(tooth - first_tooth())](
            tau, stretch_around(transitions_, jumps_, inside), stiffness);
    }

  private:
    // First of the tooth pairs that touch during the passage.
    int first_tooth() const { return 1 - static_cast<int>(std::ceil(healthy_.contact_ratio())); }

    void fit_tooth_pairs() const {
        for (int tooth = first_tooth(); tooth < duration_; ++tooth)
            tooth_pairs_.push_back(fit([tooth](const SharedLoad& load, int period) {
                const int pair = period - tooth;  // number of periods since its engagement
                return pair < 0 || pair >= TouchingPairs::kMost
                           ? 0.0
                           : load.stiffness * load.share[static_cast<std::size_t>(pair)];
            }));
    }

    // Fits value(load, period), where load is the load sharing in that period.
    template <class Value>
    ToothPairCurve fit(const Value& value) const {
        const double scale = healthy_.stretches_.front().total(0.0);
        const ToothPairFit fit(std::max(healthy_.tolerance_, kFaultyCurveTolerance) * scale);
        return fit([&](std::span<const double> tau,
                       std::span<double> values) { solve(value, tau, values); },
                   breaks_, duration_);
    }

    template <class Value>
    void solve(const Value& value, std::span<const double> tau, std::span<double> values) const {
        const std::size_t n = tau.size();
        const int period = static_cast<int>(std::floor(tau[n / 2]));
        const int pairs = pairs_at(tau[n / 2] - period, healthy_.contact_ratio());
        std::vector<TouchingPairs> at(n);
        for (std::size_t i = 0; i < n; ++i)
            at[i] = healthy_.touching(tau[i] - period, pairs);
        for (int tooth = 0; tooth < fault_.teeth(); ++tooth) {
            const int pair = period - tooth;  // number of periods since its engagement
            if (pair >= 0 && pair < pairs)
                apply_fault(healthy_, fault_, tau, tooth, pair, at);
        }
        for (std::size_t i = 0; i < n; ++i)
            values[i] = fault_.mesh_factor() *
                        value(share_load(at[i], healthy_.contact_, healthy_.force_N_), period);
    }

    static void apply_fault(const CoupledMesh& healthy, const ToothFault& fault,
                            std::span<const double> tau, int tooth, int pair,
                            std::vector<TouchingPairs>& touching) {
        const std::size_t n = tau.size();
        std::vector<double> position(n), faulty(n), whole(n);
        std::transform(tau.begin(), tau.end(), position.begin(),
                       [&](double t) { return t - tooth; });
        if (fault.changes_sections()) {
            fault.beam_compliance(position, faulty);
            healthy.beams_[fault.gear() - 1](position, whole);
        }
        for (std::size_t i = 0; i < n; ++i) {
            double& compliance = touching[i].compliance[pair][pair];
            compliance = (compliance + (faulty[i] - whole[i])) / fault.pair_factor();
            touching[i].contact_factor[pair] = 1 / fault.pair_factor();
            if (fault.changes_contact())
                touching[i].width[pair] = fault.contact_width(position[i]);
        }
    }

    const CoupledMesh& healthy_;
    const ToothFault& fault_;
    std::vector<double> transitions_, breaks_, jumps_;
    double duration_;
    ToothPairCurve curve_;
    mutable std::once_flag tooth_pairs_fitted_;
    mutable std::vector<ToothPairCurve> tooth_pairs_;
};

CoupledMesh::CoupledMesh(const gears::MeshGeometry& geometry, const Material& material,
                         Profile profile, const CoupledMeshOptions& options)
    : tolerance_(options.tolerance),
      geometry_(geometry),
      contact_(material, options.contact),
      force_N_(options.force_N),
      bodies_{make_foundation(geometry.gear(1), material, profile, options.foundation,
                              options.body_radius_1_m),
              make_foundation(geometry.gear(2), material, profile, options.foundation,
                              options.body_radius_2_m)},
      transitions_(contact_transitions(geometry.contact_ratio())) {
    if (contact_.load_dependent() && !(force_N_ > 0))
        throw std::invalid_argument(
            fmt::format("contacts that stiffen with the load carry a mesh force of {} N (must be "
                        "positive)",
                        force_N_));
    if (contact_ratio() > TouchingPairs::kMost)
        throw std::invalid_argument(fmt::format("a contact ratio of {:.2f} (at most {})",
                                                contact_ratio(), TouchingPairs::kMost));
    const double tolerance = std::max(tolerance_, kSeriesTolerance);
    for (const int which : {1, 2}) {
        beams_[which - 1] =
            healthy_beam(geometry, material, {geometry.gear(which), profile}, tolerance, which);
    }
    foundation_ =
        ChebyshevSeries([&](double tau) { return foundation(1, tau) + foundation(2, tau); }, 0,
                        contact_ratio(), kSeriesNodes, tolerance);
    for (std::size_t i = 0; i < transitions_.size(); ++i) {
        const double begin = transitions_[i];
        const double end = i + 1 < transitions_.size() ? transitions_[i + 1] : 1;
        const int pairs = pairs_at(0.5 * (begin + end), contact_ratio());
        const auto series = [&](auto&& value) {
            return ChebyshevSeries([&](double phase) { return value(healthy_load(phase, pairs)); },
                                   begin, end, kSeriesNodes, tolerance);
        };
        HealthyStretch stretch{
            begin, end, series([](const SharedLoad& load) { return load.stiffness; }), {}};
        for (int pair = 0; pair < pairs; ++pair)
            stretch.shares.push_back(
                series([&](const SharedLoad& load) { return load.share[pair]; }));
        stretches_.push_back(std::move(stretch));
    }
}

double CoupledMesh::foundation(int which, double tau) const {
    const FilletFoundation* body = bodies_[which - 1].get();
    return body ? body->self(geometry_.contact_angle(which, tau)).total() : 0;
}

double CoupledMesh::coupling(double tau_i, double tau_j) const {
    // Gear 1's teeth are pushed against its rotation, gear 2's along it. The pair with the larger
    // tau is ahead on both gears.
    const int ahead = static_cast<int>(std::lround(tau_j - tau_i));
    double sum = 0;
    for (const int which : {1, 2})
        if (const FilletFoundation* body = bodies_[which - 1].get())
            sum +=
                body->coupling(geometry_.contact_angle(which, tau_i),
                               geometry_.contact_angle(which, tau_j), which == 1 ? -ahead : ahead);
    return sum;
}

TouchingPairs CoupledMesh::touching(double phase, int pairs) const {
    TouchingPairs touching;
    touching.count = pairs;
    for (int i = 0; i < pairs; ++i) {
        const double tau = std::min(phase + i, contact_ratio());
        touching.width[i] = touching.contact_factor[i] = 1;
        touching.compliance[i][i] = beams_[0](tau) + beams_[1](tau) + foundation_(tau);
        for (int j = 0; j < i; ++j)
            touching.compliance[i][j] = touching.compliance[j][i] = coupling(phase + i, phase + j);
    }
    return touching;
}

SharedLoad CoupledMesh::healthy_load(double phase, int pairs) const {
    return share_load(touching(phase, pairs), contact_, force_N_);
}

const CoupledMesh::HealthyStretch& CoupledMesh::stretch_at(double phase) const {
    const auto next = std::upper_bound(transitions_.begin(), transitions_.end(), phase);
    return stretches_[static_cast<std::size_t>(next - transitions_.begin()) - 1];
}

std::vector<double> CoupledMesh::phases(std::span<const double> tau, double period,
                                        const HealthyStretch& stretch) {
    std::vector<double> phase(tau.size());
    std::transform(tau.begin(), tau.end(), phase.begin(),
                   [&](double t) { return std::clamp(t - period, stretch.begin, stretch.end); });
    return phase;
}

void CoupledMesh::total(std::span<const double> tau, double inside,
                        std::span<double> stiffness) const {
    const HealthyStretch& stretch = stretch_at(inside - std::floor(inside));
    stretch.total(phases(tau, std::floor(inside), stretch), stiffness);
}

void CoupledMesh::share(std::span<const double> tau, double inside, std::span<double> share) const {
    std::fill(share.begin(), share.end(), 0.0);
    if (inside < 0 || inside > contact_ratio())
        return;
    const double period = std::floor(inside);
    const HealthyStretch& stretch = stretch_at(inside - period);
    stretch.shares[static_cast<std::size_t>(period)](phases(tau, period, stretch), share);
}

std::unique_ptr<const FaultyMesh> CoupledMesh::with_fault(const ToothFault& fault) const {
    return std::make_unique<FaultyCoupledMesh>(*this, fault);
}

}  // namespace gearpod::stiffness
