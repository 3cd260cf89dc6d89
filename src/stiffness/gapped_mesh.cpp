#include "stiffness/gapped_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "stiffness/loaded_mesh.hpp"
#include "stiffness/teeth/position_range.hpp"
#include "stiffness/teeth/stretch.hpp"

namespace gearpod::stiffness {

namespace {

constexpr double kCurveTolerance = 4e-10;  // relative to the mean mesh stiffness

class HealthyPairs final : public NominalPairs {
  public:
    explicit HealthyPairs(const MeshStiffness& spur) : spur_(spur) {}
    void total(std::span<const double> tau, double inside,
               std::span<double> stiffness) const override {
        spur_.total(tau, inside, stiffness);
    }
    void pair(int tooth, std::span<const double> tau, double inside,
              std::span<double> stiffness) const override {
        std::vector<double> own(tau.begin(), tau.end());
        for (double& at : own)
            at -= tooth;
        spur_.slice_stiffness(0, own, inside - tooth, stiffness);
    }

  private:
    const MeshStiffness& spur_;
};

class FaultyPairs final : public NominalPairs {
  public:
    FaultyPairs(const MeshStiffness& spur, const FaultyMesh& faulty)
        : healthy_(spur), faulty_(faulty) {}
    void total(std::span<const double> tau, double inside,
               std::span<double> stiffness) const override {
        if (passes(inside))
            faulty_.total(tau, inside, stiffness);
        else
            healthy_.total(tau, inside, stiffness);
    }
    void pair(int tooth, std::span<const double> tau, double inside,
              std::span<double> stiffness) const override {
        if (passes(inside))
            faulty_.tooth_pair(tooth, tau, inside, stiffness);
        else
            healthy_.pair(tooth, tau, inside, stiffness);
    }

  private:
    bool passes(double inside) const { return inside > 0 && inside < faulty_.duration(); }

    const HealthyPairs healthy_;
    const FaultyMesh& faulty_;
};

PathExtension make_extension(const FlankGaps& gaps, double force, double stiffness) {
    return gaps.reach_m > 0 ? PathExtension(gaps.geometry, gaps.reach_m, force / stiffness)
                            : PathExtension(gaps.geometry);
}

const FlankGaps& checked(const FlankGaps& gaps, double overlap, double force, int slices) {
    if (!(overlap >= 0) || !(force >= 0) || slices < 1)
        throw std::invalid_argument(
            fmt::format("a mesh of {} slices with an overlap ratio of {} under {} N (at least 1 "
                        "slice, neither ratio nor force negative)",
                        slices, overlap, force));
    return gaps;
}

void add_phase(double at, std::vector<double>& phases) {
    const double phase = at - std::floor(at);
    phases.push_back(phase > 1 - kPositionTolerance ? 0 : phase);
}

}  // namespace

GappedMesh::GappedMesh(std::unique_ptr<const MeshStiffness> spur, double overlap_ratio,
                       const FlankGaps& gaps, double force_N, int slices)
    : spur_(std::move(spur)),
      overlap_(overlap_ratio),
      gaps_(checked(gaps, overlap_ratio, force_N, slices)),
      force_(force_N),
      slices_(slices),
      extension_(make_extension(gaps, force_N, mean_total(*spur_))),
      spur_ratio_(extension_.reach().before + spur_->contact_ratio() + extension_.reach().after) {
    const HealthyPairs healthy(*spur_);
    ExtendedPairs pairs(healthy, extension_);
    joins_ = pairs.change(0, true);
    leaves_ = pairs.change(0, false);
    curve_ = fit(pairs, 0, breaks());
    transitions_ = make_transitions();
}

ToothPairCurve GappedMesh::fit(ExtendedPairs& pairs, int tooth,
                               const std::vector<double>& breaks) const {
    const ToothPairFit make(kCurveTolerance * mean_total(*spur_));
    const double from = tooth - path_begin();
    return make(
        [&](std::span<const double> tau, std::span<double> values) {
            std::vector<double> nominal(tau.begin(), tau.end());
            for (double& at : nominal)
                at += from;
            pairs.stiffness(tooth, nominal, values);
        },
        breaks, spur_ratio_);
}

std::vector<double> GappedMesh::breaks() const {
    const double ratio = spur_->contact_ratio();
    const auto& fade = extension_.fade();
    std::vector<double> all;
    const int reach = static_cast<int>(std::ceil(ratio)) + 1;
    for (int other = -reach; other <= reach; ++other)
        for (const double at :
             {other - fade.before, other + 0.0, other + ratio, other + ratio + fade.after})
            if (const double own = path_begin() + at; own > 0 && own < spur_ratio_)
                all.push_back(own);
    for (const double phase : spur_->transitions())
        for (double at = path_begin() + phase; at < spur_ratio_; ++at)
            all.push_back(at);
    sort_positions(all);
    return all;
}

// Positions at which time steps must end: where slices engage or disengage abruptly, and where the
// stiffness or the gap of spur teeth has a kink.
std::vector<double> GappedMesh::make_transitions() const {
    std::vector<double> phases;
    add_phase(0, phases);
    add_phase(contact_ratio(), phases);
    const bool spur = overlap_ == 0;
    for (int slice = 0; slice < slices_; ++slice) {
        if (!spur && gaps_.reach_m > 0)
            break;
        add_phase(delay(slice), phases);
        add_phase(delay(slice) + spur_ratio_, phases);
    }
    if (spur) {
        for (const double phase : spur_->transitions())
            add_phase(path_begin() + phase, phases);
        for (const double kink :
             gears::relief_kinks(gaps_.geometry, gaps_.relief_1, gaps_.relief_2))
            add_phase(path_begin() + kink, phases);
    }
    sort_positions(phases);
    return phases;
}

double GappedMesh::flank_position(double tau) const {
    const double ratio = spur_->contact_ratio(), at = tau - path_begin();
    const double oldest = std::clamp(at, 0.0, ratio);
    const double youngest = std::clamp(at - overlap_, 0.0, ratio);
    return 0.5 * (oldest + youngest) / ratio - 0.5;
}

void GappedMesh::slice_stiffness(int slice, std::span<const double> tau, double inside,
                                 std::span<double> stiffness) const {
    if (slices_ == 1) {
        std::fill(stiffness.begin(), stiffness.end(), 0.0);
        if (inside > 0 && inside < contact_ratio())
            curve_(tau, stretch_around(transitions_, {}, inside), stiffness);
        return;
    }
    std::vector<double> own(tau.begin(), tau.end());
    for (double& at : own)
        at -= delay(slice);
    curve_(own, stiffness);
    for (double& k : stiffness)
        k /= slices_;
}

// Gap of a slice. Outside the path of contact, the stiffness k of the curve differs from `own`, the
// stiffness of the pair among all engaged pairs. The gap is scaled by own / k there, so that the
// product of stiffness and gap is correct.
double GappedMesh::slice_gap(int slice, double tau) const {
    const double ratio = spur_->contact_ratio();
    const double at = tau - delay(slice) - path_begin();
    const double ground = gears::relief_gap(gaps_.geometry, gaps_.relief_1, gaps_.relief_2,
                                            std::clamp(at, 0.0, ratio));
    const double crown =
        (gaps_.relief_1.crowning_m + gaps_.relief_2.crowning_m) * across(slice) * across(slice);
    const double flank = ground + crown;
    if (at >= 0 && at <= ratio)
        return flank;
    const ExtendedPairs::Change& end = at < 0 ? joins_ : leaves_;
    const double k = end.stiffness(extension_.weight(at));
    return (flank + gears::corner_gap(gaps_.geometry, at)) * (k > 0 ? end.own / k : 1);
}

double GappedMesh::slice_flank_position(int slice, double tau) const {
    const double ratio = spur_->contact_ratio();
    return std::clamp((tau - delay(slice) - path_begin()) / ratio, 0.0, 1.0) - 0.5;
}

void GappedMesh::total(std::span<const double> tau, double inside,
                       std::span<double> stiffness) const {
    std::vector<ContactSpring> springs;
    for (std::size_t i = 0; i < tau.size(); ++i) {
        springs.clear();
        add_springs(*this, tau[i], inside, springs);
        stiffness[i] = secant_stiffness(springs, force_);
    }
}

template <class Weight>
void GappedMesh::add_path_total(const NominalPairs& pairs, const Weight& weight,
                                std::span<const double> tau, double inside,
                                std::span<double> stiffness) const {
    std::vector<double> own(tau.size()), one(tau.size());
    for (int slice = 0; slice < slices_; ++slice) {
        const double late = path_begin() + (slices_ == 1 ? 0 : delay(slice));
        std::transform(tau.begin(), tau.end(), own.begin(), [&](double at) { return at - late; });
        if (slices_ == 1) {
            pairs.total(own, inside - late, one);
        } else {  // slices change their pairs at different positions
            for (std::size_t i = 0; i < own.size(); ++i)
                pairs.total({&own[i], 1}, own[i], {&one[i], 1});
        }
        for (std::size_t i = 0; i < own.size(); ++i)
            stiffness[i] += weight(slice) * one[i];
    }
}

void GappedMesh::path_total(std::span<const double> tau, double inside,
                            std::span<double> stiffness) const {
    std::fill(stiffness.begin(), stiffness.end(), 0.0);
    add_path_total(
        HealthyPairs(*spur_), [this](int) { return 1.0 / slices_; }, tau, inside, stiffness);
}

void GappedMesh::share(std::span<const double> tau, double inside, std::span<double> share) const {
    std::fill(share.begin(), share.end(), 0.0);
    if (inside < 0 || inside > contact_ratio() || force_ == 0)
        return;
    const LoadedMesh loaded(*this, force_);
    std::vector<double> k(tau.size());
    for (int slice = 0; slice < slices_; ++slice) {
        slice_stiffness(slice, tau, inside, k);
        for (std::size_t i = 0; i < tau.size(); ++i) {
            const double d = loaded.approach(tau[i], inside);
            share[i] += k[i] * std::max(0.0, d - slice_gap(slice, tau[i])) / force_;
        }
    }
}

// Gapped mesh with a fault. The faulty tooth changes the slices in its part of the face
// (helical_mesh.hpp). The stiffness lost by the spur pair is distributed over them.
class FaultyGappedMesh : public FaultyMesh {
  public:
    FaultyGappedMesh(const GappedMesh& healthy, const ToothFault& fault)
        : healthy_(healthy), spur_(healthy.spur_->with_fault(fault)), face_(fault.face()) {
        const double begin = healthy_.path_begin();
        std::vector<double> laws;
        for (int tooth = 0; tooth < fault.teeth(); ++tooth) {
            for (const double at : fault.breaks())
                laws.push_back(begin + tooth + at);
            for (const double at : fault.jumps())
                laws.push_back(begin + tooth + at);
        }
        if (healthy_.slices_ == 1)
            for (const double jump : spur_->jumps())
                jumps_.push_back(begin + jump);
        const FaultyPairs faulty(*healthy_.spur_, *spur_);
        ExtendedPairs pairs(faulty, healthy_.extension_);
        for (int tooth = first_tooth(); tooth < duration(); ++tooth) {
            std::vector<double> breaks = healthy_.breaks();
            for (const double at : laws)
                if (const double own = at - tooth; own > 0 && own < healthy_.spur_ratio_)
                    breaks.push_back(own);
            sort_positions(breaks);
            curves_.push_back(healthy_.fit(pairs, tooth, breaks));
        }
    }

    double duration() const override {
        const auto& reach = healthy_.extension_.reach();
        return reach.before + spur_->duration() + reach.after + healthy_.overlap_;
    }
    std::vector<double> jumps() const override { return jumps_; }

    void total(std::span<const double> tau, double inside,
               std::span<double> stiffness) const override {
        std::vector<std::vector<ContactSpring>> springs(tau.size());
        std::vector<double> k(tau.size());
        for (int tooth = first_tooth(); tooth < inside; ++tooth) {
            if (inside >= tooth + healthy_.contact_ratio())
                continue;
            for (int slice = 0; slice < healthy_.slices_; ++slice) {
                slice_stiffness(tooth, slice, tau, inside, k);
                for (std::size_t i = 0; i < tau.size(); ++i)
                    if (k[i] > 0)
                        springs[i].push_back({k[i], healthy_.slice_gap(slice, tau[i] - tooth)});
            }
        }
        for (std::size_t i = 0; i < tau.size(); ++i)
            stiffness[i] = secant_stiffness(springs[i], healthy_.force_);
    }

    void path_total(std::span<const double> tau, double inside,
                    std::span<double> stiffness) const override {
        healthy_.path_total(tau, inside, stiffness);
        const auto lost = [this](int slice) { return -weight(slice); };
        const auto kept = [this](int slice) { return weight(slice); };
        healthy_.add_path_total(HealthyPairs(*healthy_.spur_), lost, tau, inside, stiffness);
        healthy_.add_path_total(FaultyPairs(*healthy_.spur_, *spur_), kept, tau, inside, stiffness);
    }

    void tooth_pair(int tooth, std::span<const double> tau, double inside,
                    std::span<double> stiffness) const override {
        std::fill(stiffness.begin(), stiffness.end(), 0.0);
        std::vector<double> one(tau.size());
        for (int slice = 0; slice < healthy_.slices_; ++slice) {
            slice_stiffness(tooth, slice, tau, inside, one);
            std::transform(one.begin(), one.end(), stiffness.begin(), stiffness.begin(),
                           std::plus<>());
        }
    }

    void slice_stiffness(int tooth, int slice, std::span<const double> tau, double inside,
                         std::span<double> stiffness) const override {
        std::fill(stiffness.begin(), stiffness.end(), 0.0);
        if (inside <= tooth || inside >= tooth + healthy_.contact_ratio())
            return;
        std::vector<double> own(tau.begin(), tau.end());
        for (double& at : own)
            at -= tooth + (healthy_.slices_ == 1 ? 0 : healthy_.delay(slice));
        const ToothPairCurve& faulty = curves_[static_cast<std::size_t>(tooth - first_tooth())];
        if (healthy_.slices_ == 1) {
            const Stretch whole = stretch_around(healthy_.transitions_, jumps_, inside);
            faulty(own, {whole.begin - tooth, whole.end - tooth}, stiffness);
            return;
        }
        faulty(own, stiffness);
        std::vector<double> whole(tau.size());
        healthy_.curve_(own, whole);
        const double part = weight(slice);
        for (std::size_t i = 0; i < tau.size(); ++i) {
            const double lost = part * (whole[i] - stiffness[i]);
            stiffness[i] = std::max(0.0, whole[i] / healthy_.slices_ - lost);
        }
    }

  private:
    // Index of the first tooth pair whose engagement overlaps that of the faulty pair.
    int first_tooth() const { return 1 - static_cast<int>(std::ceil(healthy_.contact_ratio())); }

    // Fraction of the total stiffness loss that is assigned to a slice.
    double weight(int slice) const {
        const double low = static_cast<double>(slice) / healthy_.slices_;
        const double high = (slice + 1.0) / healthy_.slices_;
        const double common = std::min(high, face_.end) - std::max(low, face_.begin);
        return std::max(0.0, common) / (face_.end - face_.begin);
    }

    const GappedMesh& healthy_;
    std::unique_ptr<const FaultyMesh> spur_;
    FaceRange face_;
    std::vector<double> jumps_;
    std::vector<ToothPairCurve> curves_;  // for tooth pairs from first_tooth() on
};

std::unique_ptr<const FaultyMesh> GappedMesh::with_fault(const ToothFault& fault) const {
    return std::make_unique<FaultyGappedMesh>(*this, fault);
}

}  // namespace gearpod::stiffness
