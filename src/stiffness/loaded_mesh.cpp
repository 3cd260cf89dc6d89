#include "stiffness/loaded_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gearpod::stiffness {

// Springs come into contact in the order of their gaps. The first set that carries the force
// without closing the next gap is the solution.
double approach_of(std::vector<ContactSpring>& springs, double force_N) {
    std::ranges::sort(springs, [](const auto& a, const auto& b) { return a.gap < b.gap; });
    double stiffness = 0, preload = 0;
    for (std::size_t n = 0; n < springs.size(); ++n) {
        stiffness += springs[n].stiffness;
        preload += springs[n].stiffness * springs[n].gap;
        const double d = (force_N + preload) / stiffness;
        if (n + 1 == springs.size() || d <= springs[n + 1].gap) {
            return d;
        }
    }
    return std::numeric_limits<double>::infinity();
}

double secant_stiffness(std::vector<ContactSpring>& springs, double force_N) {
    if (force_N > 0) {
        return force_N / approach_of(springs, force_N);
    }
    double sum = 0;
    for (const ContactSpring& spring : springs) {
        sum += spring.stiffness;
    }
    return sum;
}

void add_springs(const MeshStiffness& mesh, double tau, double inside,
                 std::vector<ContactSpring>& springs) {
    // Tooth pairs stand at tau + age, youngest first.
    for (int age = -static_cast<int>(std::floor(inside)); inside + age < mesh.contact_ratio();
         ++age) {
        const double position = tau + age;
        for (int slice = 0; slice < mesh.slices(); ++slice) {
            double stiffness = 0;
            mesh.slice_stiffness(slice, {&position, 1}, inside + age, {&stiffness, 1});
            if (stiffness > 0) {
                springs.push_back({stiffness, mesh.slice_gap(slice, position)});
            }
        }
    }
}

double LoadedMesh::approach(double tau, double inside) const {
    if (!mesh_.has_gaps()) {
        double total = 0;
        mesh_.total({&tau, 1}, inside, {&total, 1});
        return force_ / total;
    }
    std::vector<ContactSpring> springs;
    add_springs(mesh_, tau, inside, springs);
    return approach_of(springs, force_);
}

LoadedMesh::Range LoadedMesh::range() const {
    constexpr int kPoints = 64;  // per stretch
    const std::vector<double> phases = mesh_.transitions();
    Range range{std::numeric_limits<double>::infinity(), 0, 0};
    for (std::size_t i = 0; i < phases.size(); ++i) {
        const double begin = phases[i], end = i + 1 < phases.size() ? phases[i + 1] : 1;
        const double inside = 0.5 * (begin + end);
        for (int p = 0; p <= kPoints; ++p) {
            const double d = approach(begin + (end - begin) * p / kPoints, inside);
            range.least = std::min(range.least, d);
            range.largest = std::max(range.largest, d);
            const double weight = p == 0 || p == kPoints ? 0.5 : 1.0;
            range.mean += weight * d * (end - begin) / kPoints;
        }
    }
    return range;
}

}  // namespace gearpod::stiffness
