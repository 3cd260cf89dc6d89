#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "analysis/statistics/outcome_terms.hpp"
#include "machine/elementary_functions.hpp"
#include "machine/instruction_sets.hpp"

namespace gearpod::analysis {
namespace {

constexpr int kLanes = 8;
constexpr int kSums = 10;
constexpr double kLeastProduct = 1e-290;

// Values of 1 - exp(-exp(eta)).
GEARPOD_INLINE LinkValues lane_cloglog(double eta) {
    constexpr double kDecayed = 700.0;  // where exp(-rate) ends
    const double rate = machine::lane_exp(eta);
    const double decay = machine::lane_exp(-rate);
    const double down = rate < kDecayed ? decay : 0.0;
    return {machine::lane_one_minus_exp(rate), down, rate * down};
}

template <Link kLink>
GEARPOD_INLINE LinkValues lane_link(double eta) {
    if constexpr (kLink == Link::cloglog) {
        return lane_cloglog(eta);
    } else if constexpr (kLink == Link::loglog) {
        const LinkValues mirrored = lane_cloglog(-eta);
        return {mirrored.down, mirrored.up, mirrored.density};
    } else {
        const double away = std::fabs(eta);
        double small = 0.0, density = 0.0;
        if constexpr (kLink == Link::logit) {
            const double e = machine::lane_exp(-away);
            small = e / (1.0 + e);
            density = small / (1.0 + e);
        } else {
            small = 0.5 * machine::lane_erfc(away * (1.0 / std::numbers::sqrt2));
            density = machine::lane_exp(-0.5 * eta * eta) *
                      (std::numbers::inv_sqrtpi / std::numbers::sqrt2);
        }
        const double large = 1.0 - small;
        return {eta > 0.0 ? large : small, eta > 0.0 ? small : large, density};
    }
}

struct LaneTerms {
    double log_probability;
    double weight;  // 1 / (p (1 - p)), or 0
    double left;    // yes - p
    double rise;    // dp / d eta
    double up;      // dp / d ceiling
};

template <Link kLink>
GEARPOD_INLINE LaneTerms lane_terms(double floor, double ceiling, double eta, bool yes) {
    constexpr double kLeast = std::numeric_limits<double>::min();
    const double rise = ceiling - floor;
    const LinkValues link = lane_link<kLink>(eta);
    const double hit = std::fma(rise, link.up, floor);
    const double miss = std::fma(rise, link.down, 1.0 - ceiling);
    const double probability = yes ? hit : miss;
    const double both = hit * miss;
    const double inverse = 1.0 / (both < kLeastProduct ? 1.0 : both);
    return {machine::lane_log(probability < kLeast ? kLeast : probability),
            both < kLeastProduct ? 0.0 : inverse, yes ? miss : -hit, rise * link.density, link.up};
}

template <Link kLink>
GEARPOD_INLINE void all_terms(const OutcomeCurve* curve, long count, const double* __restrict eta,
                              const char* __restrict yes, double* __restrict log_probability,
                              double* __restrict slope, double* __restrict information) {
    const double floor = curve->floor, ceiling = curve->ceiling;
#pragma omp simd
    for (long i = 0; i < count; ++i) {
        const LaneTerms terms = lane_terms<kLink>(floor, ceiling, eta[i], yes[i] != 0);
        log_probability[i] = terms.log_probability;
        slope[i] = terms.weight * terms.left * terms.rise;
        information[i] = terms.weight * terms.rise * terms.rise;
    }
}

// Adds eight outcomes to the sums [sum, lane].
template <Link kLink, bool kYes>
GEARPOD_INLINE void add_lanes(const OutcomeLine& line, const double* __restrict u,
                              const double* __restrict weight, double* __restrict sums) {
    const double floor = line.curve.floor, ceiling = line.curve.ceiling;
    const double intercept = line.intercept, slope = line.slope, origin = line.origin;
    const double ceiling_by_first = line.ceiling_by_first;
#pragma omp simd
    for (int l = 0; l < kLanes; ++l) {
        const double eta = std::fma(slope, u[l], intercept);
        const LaneTerms terms = lane_terms<kLink>(floor, ceiling, eta, kYes);
        const double information = weight[l] * terms.weight;
        const double score = information * terms.left;
        const double by_first = std::fma(ceiling_by_first, terms.up, terms.rise);
        const double by_slope = terms.rise * (u[l] - origin);
        const double first = information * by_first, turned = information * by_slope;
        sums[l] = std::fma(weight[l], terms.log_probability, sums[l]);
        sums[1 * kLanes + l] = std::fma(score, by_first, sums[1 * kLanes + l]);
        sums[2 * kLanes + l] = std::fma(score, by_slope, sums[2 * kLanes + l]);
        sums[3 * kLanes + l] = std::fma(score, terms.up, sums[3 * kLanes + l]);
        sums[4 * kLanes + l] = std::fma(first, by_first, sums[4 * kLanes + l]);
        sums[5 * kLanes + l] = std::fma(first, by_slope, sums[5 * kLanes + l]);
        sums[6 * kLanes + l] = std::fma(turned, by_slope, sums[6 * kLanes + l]);
        sums[7 * kLanes + l] = std::fma(first, terms.up, sums[7 * kLanes + l]);
        sums[8 * kLanes + l] = std::fma(turned, terms.up, sums[8 * kLanes + l]);
        sums[9 * kLanes + l] = std::fma(information * terms.up, terms.up, sums[9 * kLanes + l]);
    }
}

template <Link kLink, bool kYes>
GEARPOD_INLINE void all_outcomes(const OutcomeLine* line, long count, const double* u,
                                 const double* weight, double* __restrict total) {
    double sums[kSums * kLanes] = {};
    long first = 0;
    for (; first + kLanes <= count; first += kLanes) {
        add_lanes<kLink, kYes>(*line, u + first, weight + first, sums);
    }
    if (first < count) {  // lanes without an outcome have the weight 0
        double rest[kLanes], rest_weight[kLanes];
        for (int l = 0; l < kLanes; ++l) {
            const bool given = first + l < count;
            rest[l] = u[given ? first + l : first];
            rest_weight[l] = given ? weight[first + l] : 0.0;
        }
        add_lanes<kLink, kYes>(*line, rest, rest_weight, sums);
    }
    for (int k = 0; k < kSums; ++k) {
        for (int l = 0; l < kLanes; ++l) {
            total[k] += sums[k * kLanes + l];
        }
    }
}

// Calls task.operator()<kLink>() for this link.
template <class Task>
void with_link(Link link, Task task) {
    switch (link) {
        case Link::logit:
            return task.template operator()<Link::logit>();
        case Link::probit:
            return task.template operator()<Link::probit>();
        case Link::cloglog:
            return task.template operator()<Link::cloglog>();
        case Link::loglog:
            return task.template operator()<Link::loglog>();
    }
}

}  // namespace

void outcome_terms(const OutcomeCurve& curve, long count, const double* eta, const char* yes,
                   double* log_probability, double* slope, double* information) {
    with_link(curve.link, [&]<Link kLink>() {
        machine::run_kernel<all_terms<kLink>>(&curve, count, eta, yes, log_probability, slope,
                                              information);
    });
}

void add_outcomes(const OutcomeLine& line, bool yes, long count, const double* u,
                  const double* weight, LikelihoodSums& sums) {
    std::array<double, kSums> total{};
    with_link(line.curve.link, [&]<Link kLink>() {
        if (yes) {
            machine::run_kernel<all_outcomes<kLink, true>>(&line, count, u, weight, total.data());
        } else {
            machine::run_kernel<all_outcomes<kLink, false>>(&line, count, u, weight, total.data());
        }
    });
    sums.value += total[0];
    sums.by_first += total[1];
    sums.by_slope += total[2];
    sums.by_ceiling += total[3];
    sums.first_first += total[4];
    sums.first_slope += total[5];
    sums.slope_slope += total[6];
    sums.first_ceiling += total[7];
    sums.slope_ceiling += total[8];
    sums.ceiling_ceiling += total[9];
}

}  // namespace gearpod::analysis
