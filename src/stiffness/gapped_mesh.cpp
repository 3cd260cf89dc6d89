#include "stiffness/gapped_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "stiffness/helical_mesh.hpp"
#include "stiffness/loaded_mesh.hpp"
#include "stiffness/teeth/positions.hpp"

namespace gearpod::stiffness {

namespace {

constexpr double kCurveTolerance = 4e-10;  // relative to the mean mesh stiffness

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

void add_phase(double position, std::vector<double>& phases) {
    const double phase = position - std::floor(position);
    phases.push_back(phase > 1 - kPositionTolerance ? 0 : phase);
}

// Writes the total of a gear pair without gaps, whose paths start `late` mesh periods after the
// engagements. Within a stretch, helical pairs may change their teeth.
template <class Total>
void total_at_paths(std::span<const double> tau, double inside, double late, bool helical,
                    const Total& total, std::span<double> stiffness) {
    std::vector<double> shifted(tau.begin(), tau.end());
    for (double& position : shifted)
        position -= late;
    if (!helical) {
        total(std::span<const double>(shifted), inside - late, stiffness);
        return;
    }
    for (std::size_t i = 0; i < shifted.size(); ++i)
        total(std::span<const double>(&shifted[i], 1), shifted[i], stiffness.subspan(i, 1));
}

std::unique_ptr<const MeshStiffness> make_nominal(std::unique_ptr<const MeshStiffness> spur,
                                                  double overlap_ratio) {
    if (overlap_ratio > 0)
        return std::make_unique<HelicalMesh>(std::move(spur), overlap_ratio);
    return spur;
}

}  // namespace

GappedMesh::GappedMesh(std::unique_ptr<const MeshStiffness> spur, double overlap_ratio,
                       const FlankGaps& gaps, double force_N, int slices)
    : nominal_(make_nominal(std::move(spur), overlap_ratio)),
      spur_(nominal_->slice()),
      overlap_(overlap_ratio),
      force_(force_N),
      slices_(slices),
      gap_{checked(gaps, overlap_ratio, force_N, slices),
           make_extension(gaps, force_N, mean_total(spur_))},
      spur_ratio_(gap_.extension.reach().before + spur_.contact_ratio() +
                  gap_.extension.reach().after) {
    ExtendedPairs pairs(NominalPairs(spur_), gap_.extension);
    gap_.joins = pairs.change(0, true);
    gap_.leaves = pairs.change(0, false);
    curve_ = fit(pairs, 0, breaks());
    if (overlap_ > 0) {
        std::vector<double> points = breaks();
        points.insert(points.end(), {0, spur_ratio_});
        for (const double kink : gap_kinks())
            points.push_back(path_begin() + kink);
        sort_positions(points);
        helical_slices_.emplace(curve_, points, gap_, overlap_, slices_, force_);
    }
    transitions_ = make_transitions();
}

ToothPairCurve GappedMesh::fit(ExtendedPairs& pairs, int tooth,
                               const std::vector<double>& breaks) const {
    const ToothPairFit make(kCurveTolerance * mean_total(spur_));
    const double from = tooth - path_begin();
    return make(
        [&](std::span<const double> tau, std::span<double> values) {
            std::vector<double> nominal(tau.begin(), tau.end());
            for (double& position : nominal)
                position += from;
            pairs.stiffness(tooth, nominal, values);
        },
        breaks, spur_ratio_);
}

std::vector<double> GappedMesh::breaks() const {
    const double ratio = spur_.contact_ratio();
    const auto& fade = gap_.extension.fade();
    std::vector<double> all;
    const int reach = static_cast<int>(std::ceil(ratio)) + 1;
    for (int other = -reach; other <= reach; ++other)
        for (const double edge :
             {other - fade.before, other + 0.0, other + ratio, other + ratio + fade.after})
            if (const double position = path_begin() + edge; position > 0 && position < spur_ratio_)
                all.push_back(position);
    for (const double phase : spur_.transitions())
        for (double position = path_begin() + phase; position < spur_ratio_; ++position)
            all.push_back(position);
    sort_positions(all);
    return all;
}

// Relief starts or ends at a kink; wear has one at the pitch point, where it is zero.
std::vector<double> GappedMesh::gap_kinks() const {
    std::vector<double> kinks =
        gears::relief_kinks(gap_.flanks.geometry, gap_.flanks.relief_1, gap_.flanks.relief_2);
    const double pitch = gap_.flanks.geometry.pitch_position();
    if (gap_.flanks.wear && pitch > 0 && pitch < gap_.flanks.geometry.contact_ratio())
        kinks.push_back(pitch);
    return kinks;
}

// Positions at which time steps must end: starts and ends of engagements, abrupt changes of helical
// teeth, and kinks of the stiffness or the gap of spur teeth.
std::vector<double> GappedMesh::make_transitions() const {
    std::vector<double> phases;
    add_phase(0, phases);
    add_phase(contact_ratio(), phases);
    if (helical()) {
        if (gap_.flanks.reach_m == 0)
            for (const double position : helical_slices_->changes())
                add_phase(position, phases);
    } else {
        for (const double phase : spur_.transitions())
            add_phase(path_begin() + phase, phases);
        for (const double kink : gap_kinks())
            add_phase(path_begin() + kink, phases);
    }
    sort_positions(phases);
    return phases;
}

double GappedMesh::flank_position(double tau) const {
    const double ratio = spur_.contact_ratio(), nominal = tau - path_begin();
    const double oldest = std::clamp(nominal, 0.0, ratio);
    const double youngest = std::clamp(nominal - overlap_, 0.0, ratio);
    return 0.5 * (oldest + youngest) / ratio - 0.5;
}

void GappedMesh::slice_stiffness(int slice, std::span<const double> tau, double inside,
                                 std::span<double> stiffness) const {
    if (helical()) {
        for (std::size_t i = 0; i < tau.size(); ++i)
            stiffness[i] = helical_slices_->stiffness(slice, tau[i]);
        return;
    }
    if (slices_ == 1) {
        std::fill(stiffness.begin(), stiffness.end(), 0.0);
        if (inside > 0 && inside < contact_ratio())
            curve_(tau, stretch_around(transitions_, {}, inside), stiffness);
        return;
    }
    curve_(tau, stiffness);
    for (double& k : stiffness)
        k /= slices_;
}

double GappedMesh::slice_gap(int slice, double tau) const {
    return helical() ? helical_slices_->gap(slice, tau)
                     : gap_(tau - path_begin(), gap_.flanks.crown_m(slice, slices_));
}

double GappedMesh::slice_wear(int slice, double tau) const {
    return helical() ? helical_slices_->wear(slice, tau) : gap_.wear(tau - path_begin());
}

double GappedMesh::slice_flank_position(int slice, double tau) const {
    return helical() ? helical_slices_->flank_position(slice, tau)
                     : gap_.flank_position(tau - path_begin());
}

double GappedMesh::slice_on_path(int slice, double tau) const {
    if (helical())
        return helical_slices_->on_path(slice, tau);
    return std::abs(slice_flank_position(slice, tau)) < 0.5 ? 1 : 0;
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

void GappedMesh::path_total(std::span<const double> tau, double inside,
                            std::span<double> stiffness) const {
    total_at_paths(
        tau, inside, path_begin(), helical(),
        [this](auto position, double within, auto k) { nominal_->total(position, within, k); },
        stiffness);
}

void GappedMesh::share(std::span<const double> tau, double inside, std::span<double> share) const {
    std::fill(share.begin(), share.end(), 0.0);
    if (inside < 0 || inside > contact_ratio() || force_ == 0)
        return;
    const LoadedMesh loaded(*this, force_);
    std::vector<double> k(tau.size());
    for (int slice = 0; slice < slices(); ++slice) {
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
        : healthy_(healthy),
          nominal_(healthy.nominal_->with_fault(fault)),
          spur_(nominal_->slice()),
          face_(fault.face()) {
        const double begin = healthy_.path_begin();
        std::vector<double> fault_positions;
        for (int tooth = 0; tooth < fault.teeth(); ++tooth) {
            for (const double position : fault.breaks())
                fault_positions.push_back(begin + tooth + position);
            for (const double position : fault.jumps())
                fault_positions.push_back(begin + tooth + position);
        }
        if (healthy_.slices_ == 1 && !healthy_.helical())
            for (const double jump : spur_.jumps())
                jumps_.push_back(begin + jump);
        ExtendedPairs pairs(NominalPairs(healthy_.spur_, &spur_), healthy_.gap_.extension);
        for (int tooth = first_tooth(); tooth < duration(); ++tooth) {
            std::vector<double> breaks = healthy_.breaks();
            for (const double fault_position : fault_positions)
                if (const double position = fault_position - tooth;
                    position > 0 && position < healthy_.spur_ratio_)
                    breaks.push_back(position);
            sort_positions(breaks);
            curves_.push_back(healthy_.fit(pairs, tooth, breaks));
            if (healthy_.helical())
                lost_.push_back(integral_of_loss(curves_.back(), breaks));
        }
    }

    double duration() const override {
        const auto& reach = healthy_.gap_.extension.reach();
        return reach.before + nominal_->duration() + reach.after;
    }
    std::vector<double> jumps() const override { return jumps_; }

    void total(std::span<const double> tau, double inside,
               std::span<double> stiffness) const override {
        std::vector<std::vector<ContactSpring>> springs(tau.size());
        std::vector<double> k(tau.size());
        for (int tooth = first_tooth(); tooth < inside; ++tooth) {
            if (inside >= tooth + healthy_.contact_ratio())
                continue;
            for (int slice = 0; slice < healthy_.slices(); ++slice) {
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
        const auto total = [this](auto position, double within, auto k) {
            if (within > 0 && within < nominal_->duration())
                nominal_->total(position, within, k);
            else
                healthy_.nominal_->total(position, within, k);
        };
        total_at_paths(tau, inside, healthy_.path_begin(), healthy_.helical(), total, stiffness);
    }

    void tooth_pair(int tooth, std::span<const double> tau, double inside,
                    std::span<double> stiffness) const override {
        std::fill(stiffness.begin(), stiffness.end(), 0.0);
        std::vector<double> slice_values(tau.size());
        for (int slice = 0; slice < healthy_.slices(); ++slice) {
            slice_stiffness(tooth, slice, tau, inside, slice_values);
            std::transform(slice_values.begin(), slice_values.end(), stiffness.begin(),
                           stiffness.begin(), std::plus<>());
        }
    }

    void slice_stiffness(int tooth, int slice, std::span<const double> tau, double inside,
                         std::span<double> stiffness) const override {
        std::fill(stiffness.begin(), stiffness.end(), 0.0);
        if (inside <= tooth || inside >= tooth + healthy_.contact_ratio())
            return;
        std::vector<double> shifted(tau.begin(), tau.end());
        for (double& position : shifted)
            position -= tooth;
        const auto pair = static_cast<std::size_t>(tooth - first_tooth());
        if (healthy_.helical()) {
            healthy_.slice_stiffness(slice, shifted, inside - tooth, stiffness);
            for (std::size_t i = 0; i < tau.size(); ++i) {
                const double lost =
                    healthy_.helical_slices_->mean(lost_[pair], slice, shifted[i], face_);
                stiffness[i] = std::max(0.0, stiffness[i] - lost);
            }
            return;
        }
        if (healthy_.slices_ == 1) {
            const Stretch whole = stretch_around(healthy_.transitions_, jumps_, inside);
            curves_[pair](shifted, {whole.begin - tooth, whole.end - tooth}, stiffness);
            return;
        }
        curves_[pair](shifted, stiffness);
        std::vector<double> whole(tau.size());
        healthy_.curve_(shifted, whole);
        const double part = weight(slice);
        for (std::size_t i = 0; i < tau.size(); ++i) {
            const double lost = part * (whole[i] - stiffness[i]);
            stiffness[i] = std::max(0.0, whole[i] / healthy_.slices_ - lost);
        }
    }

  private:
    // Index of the first tooth pair whose engagement overlaps that of the faulty pair.
    int first_tooth() const { return 1 - static_cast<int>(std::ceil(healthy_.contact_ratio())); }

    RunningIntegral integral_of_loss(const ToothPairCurve& curve,
                                     std::vector<double> points) const {
        points.insert(points.end(), {0, healthy_.spur_ratio_});
        sort_positions(points);
        return {[&](std::span<const double> tau, double, std::span<double> lost) {
                    std::vector<double> kept(tau.size());
                    healthy_.curve_(tau, lost);
                    curve(tau, kept);
                    std::transform(lost.begin(), lost.end(), kept.begin(), lost.begin(),
                                   std::minus<>());
                },
                points, kCurveTolerance * mean_total(healthy_.spur_)};
    }

    // Fraction of the total stiffness loss that is assigned to a slice.
    double weight(int slice) const {
        const double low = static_cast<double>(slice) / healthy_.slices_;
        const double high = (slice + 1.0) / healthy_.slices_;
        const double common = std::min(high, face_.end) - std::max(low, face_.begin);
        return std::max(0.0, common) / (face_.end - face_.begin);
    }

    const GappedMesh& healthy_;
    std::unique_ptr<const FaultyMesh> nominal_;  // without gaps
    const FaultyMesh& spur_;
    FaceRange face_;
    std::vector<double> jumps_;
    std::vector<ToothPairCurve> curves_;  // for tooth pairs from first_tooth() on
    std::vector<RunningIntegral> lost_;   // integrals of what these lose, helical teeth only
};

std::unique_ptr<const FaultyMesh> GappedMesh::with_fault(const ToothFault& fault) const {
    return std::make_unique<FaultyGappedMesh>(*this, fault);
}

}  // namespace gearpod::stiffness
