#include "stiffness/contact/load_sharing.hpp"

#include <algorithm>
#include <cmath>

namespace gearpod::stiffness {

HertzContact::HertzContact(const Material& material, Contact contact)
    : contact_(contact),
      unit_(load_dependent() ? 1.37 / (std::pow(material.youngs_modulus_Pa, 0.9) *
                                       std::pow(material.face_width_m, 0.8) *
                                       std::pow(material.contact_factor, 1.1))
                             : 1 / hertz_stiffness(material)) {}

double HertzContact::compliance(double force_N, double width) const {
    if (!load_dependent())
        return unit_ / width;
    const double by_width = width == 1 ? 1 : std::pow(width, 0.8);
    return unit_ / (by_width * std::pow(force_N, 0.1));
}

namespace {

using Pairs = std::array<double, TouchingPairs::kMost>;
using Matrix = std::array<Pairs, TouchingPairs::kMost>;

// Solves c x = 1 for the first n pairs by Cholesky decomposition. c is positive definite.
Pairs solve_for_ones(Matrix c, int n) {
    Pairs x{};
    for (int i = 0; i < n; ++i) {
        double right = 1;
        for (int j = 0; j < i; ++j) {
            double sum = c[i][j];
            for (int k = 0; k < j; ++k)
                sum -= c[i][k] * c[j][k];
            c[i][j] = sum / c[j][j];
            right -= c[i][j] * x[j];
        }
        double pivot = c[i][i];
        for (int k = 0; k < i; ++k)
            pivot -= c[i][k] * c[i][k];
        c[i][i] = std::sqrt(pivot);
        x[i] = right / c[i][i];
    }
    for (int i = n - 1; i >= 0; --i) {
        for (int k = i + 1; k < n; ++k)
            x[i] -= c[k][i] * x[k];
        x[i] /= c[i][i];
    }
    return x;
}

// Pairs in contact that may carry load, in order.
struct LoadedPairs {
    int count = 0;
    std::array<int, TouchingPairs::kMost> pair{};
    void remove(int index) {
        std::copy(pair.begin() + index + 1, pair.begin() + count, pair.begin() + index);
        --count;
    }
};

SharedLoad share_among(const LoadedPairs& carrying, const TouchingPairs& pairs,
                       const HertzContact& contact, double force_N, const SharedLoad& guess) {
    Matrix c;
    for (int i = 0; i < carrying.count; ++i) {
        const int p = carrying.pair[i];
        for (int j = 0; j < carrying.count; ++j)
            c[i][j] = pairs.compliance[p][carrying.pair[j]];
        const double force = guess.share[p] * force_N;
        c[i][i] += pairs.contact_factor[p] * contact.compliance(force, pairs.width[p]);
    }
    const Pairs x = solve_for_ones(c, carrying.count);
    SharedLoad load;
    for (int i = 0; i < carrying.count; ++i)
        load.stiffness += x[i];
    for (int i = 0; i < carrying.count; ++i)
        load.share[carrying.pair[i]] = x[i] / load.stiffness;
    return load;
}

}  // namespace

SharedLoad share_load(const TouchingPairs& pairs, const HertzContact& contact, double force_N) {
    // The contact compliance is proportional to the force to the power -0.1, so errors shrink
    // tenfold per iteration.
    constexpr int kMostRounds = 40;
    constexpr double kConvergedChange = 1e-15;
    LoadedPairs carrying;
    for (int i = 0; i < pairs.count; ++i)
        if (std::isfinite(pairs.compliance[i][i]) && pairs.width[i] > 0)
            carrying.pair[carrying.count++] = i;
    SharedLoad load;
    load.share.fill(1.0 / std::max(1, carrying.count));
    for (int round = 0; round < kMostRounds && carrying.count > 0; ++round) {
        const SharedLoad next = share_among(carrying, pairs, contact, force_N, load);
        const auto share = [&](int i) { return next.share[carrying.pair[i]]; };
        int least = 0;
        double change = 0;
        for (int i = 0; i < carrying.count; ++i) {
            least = share(i) < share(least) ? i : least;
            change = std::max(change, std::abs(share(i) - load.share[carrying.pair[i]]));
        }
        if (share(least) <= 0) {
            carrying.remove(least);
            load.share.fill(1.0 / std::max(1, carrying.count));
            continue;
        }
        load = next;
        if (!contact.load_dependent() || change < kConvergedChange)
            break;
    }
    if (carrying.count == 0)
        return {};
    return load;
}

}  // namespace gearpod::stiffness
