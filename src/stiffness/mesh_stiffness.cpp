#include "stiffness/mesh_stiffness.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <functional>

#include "stiffness/teeth/positions.hpp"

namespace gearpod::stiffness {

namespace {

struct FaultAndMesh {
    std::unique_ptr<const ToothFault> fault;
    std::unique_ptr<const FaultyMesh> mesh;
};

// Offset from a position into the stretch above or below it. Positions this close to the end of a
// stretch count as the end.
constexpr double kEndOffset = 2 * kPositionTolerance;

template <class Mesh>
double limit_at(const Mesh& mesh, std::span<const double> transitions,
                std::span<const double> jumps, double tau, Limit limit) {
    const double offset = limit == Limit::from_above ? kEndOffset : -kEndOffset;
    const Stretch stretch = stretch_around(transitions, jumps, tau + offset);
    const double position = std::clamp(tau, stretch.begin, stretch.end);
    double stiffness = 0;
    mesh.total({&position, 1}, 0.5 * (stretch.begin + stretch.end), {&stiffness, 1});
    return stiffness;
}

}  // namespace

void MeshStiffness::slice_stiffness(int /*slice*/, std::span<const double> tau, double inside,
                                    std::span<double> stiffness) const {
    std::vector<double> shares(tau.size());
    total(tau, inside, stiffness);
    share(tau, inside, shares);
    std::transform(stiffness.begin(), stiffness.end(), shares.begin(), stiffness.begin(),
                   std::multiplies<>());
}

std::shared_ptr<const FaultyMesh> faulty_mesh(const MeshStiffness& mesh,
                                              std::unique_ptr<const ToothFault> fault) {
    auto owned = std::make_shared<FaultAndMesh>();
    owned->fault = std::move(fault);
    owned->mesh = mesh.with_fault(*owned->fault);
    return {owned, owned->mesh.get()};
}

std::vector<double> contact_transitions(double contact_ratio) {
    const double leaving = contact_ratio - std::floor(contact_ratio);
    if (leaving < kPositionTolerance || leaving > 1 - kPositionTolerance)
        return {0};
    return {0, leaving};
}

double total_at(const MeshStiffness& mesh, double tau, Limit limit) {
    return limit_at(mesh, mesh.transitions(), {}, tau - std::floor(tau + kPositionTolerance),
                    limit);
}

double total_at(const FaultyMesh& mesh, std::span<const double> transitions, double tau,
                Limit limit) {
    return limit_at(mesh, transitions, mesh.jumps(), tau, limit);
}

double mean_total(const MeshStiffness& mesh) {
    using Rule = boost::math::quadrature::gauss<double, 30>;
    std::vector<double> ends = mesh.transitions();
    ends.push_back(ends.front() + 1);
    double sum = 0;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        const double middle = 0.5 * (ends[i] + ends[i + 1]), half = 0.5 * (ends[i + 1] - ends[i]);
        const auto at = [&](double tau) {
            double stiffness = 0;
            mesh.total({&tau, 1}, middle, {&stiffness, 1});
            return stiffness;
        };
        sum += half * Rule::integrate([&](double x) { return at(middle + half * x); });
    }
    return sum;
}

}  // namespace gearpod::stiffness
