#include "stiffness/faults/spatial_crack.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "stiffness/piecewise_curves.hpp"
#include "stiffness/teeth/tooth_compliance.hpp"

namespace gearpod::stiffness {

using std::numbers::pi;

bool CrackSurface::uniform() const {
    return depth_m == end_depth_m && height_m == end_height_m && angle_rad == end_angle_rad;
}

// q = q1 + (q2 - q1) t. q^2 is linear in z, so z / L_c = (q^2 - q1^2) / (q2^2 - q1^2).
double CrackSurface::z_at(double t) const {
    return length_m * t * (2 * depth_m + (end_depth_m - depth_m) * t) / (depth_m + end_depth_m);
}

double CrackSurface::stretching(double t) const {
    return length_m * 2 * (depth_m + (end_depth_m - depth_m) * t) / (depth_m + end_depth_m);
}

double CrackSurface::height(double z) const {
    const double x = z / face_width_m, rise = end_height_m - height_m;
    return std::max(0.0, height_m + rise * x * x);
}

Crack CrackSurface::crack(double t) const {
    const double z = z_at(t);
    return {depth_m + (end_depth_m - depth_m) * t,
            angle_rad + (end_angle_rad - angle_rad) * z / face_width_m, height(z)};
}

CrackSurface CrackGrowth::at(double stage, double face_width_m) const {
    const double position = std::clamp(stage, 0.0, static_cast<double>(stages()));
    const int to = std::max(1, static_cast<int>(std::ceil(position)));  // stage, entry to - 1
    const double share = position - (to - 1);
    const auto between = [&](const std::vector<double>& list, bool from_nothing) {
        const double target = list[to - 1];
        const double source = to > 1 ? list[to - 2] : from_nothing ? 0 : target;
        return share == 1 ? target : source + share * (target - source);
    };
    return {between(depth_m, true),
            between(end_depth_m, true),
            between(length_m, false),
            between(height_m, false),
            between(end_height_m, false),
            angle_rad,
            end_angle_rad,
            face_width_m};
}

std::vector<std::string> growth_problems(const CrackGrowth& growth, double face_width_m) {
    constexpr double kRounding = 1e-12;  // for lengths that were given in other units
    std::vector<std::string> problems;
    const std::size_t stages = growth.depth_m.size();
    const auto check = [&](const char* what, const std::vector<double>& list, double most) {
        if (list.size() != stages)
            problems.push_back(
                fmt::format("the crack's growth has {} depths and {} values of its {}", stages,
                            list.size(), what));
        for (const double value : list)
            if (!(value >= 0 && value <= most * (1 + kRounding)))
                problems.push_back(fmt::format(
                    "a stage of the crack's growth has the {} {:.4g} mm (must lie between 0 and "
                    "{:.4g})",
                    what, value * 1e3, most * 1e3));
    };
    constexpr double kAny = 1e3;
    if (stages == 0)
        problems.emplace_back("the crack's growth has no stage");
    check("depth", growth.depth_m, kAny);
    check("end depth", growth.end_depth_m, kAny);
    check("length", growth.length_m, face_width_m);
    check("height", growth.height_m, kAny);
    check("end height", growth.end_height_m, kAny);
    for (const double angle : {growth.angle_rad, growth.end_angle_rad})
        if (!(angle > 0 && angle <= pi / 2))
            problems.push_back(
                fmt::format("the crack's angle to the tooth's centre line is {:.4g} "
                            "degrees (must lie between 0 and 90)",
                            angle * 180 / pi));
    if (growth.slices < 1)
        problems.emplace_back("the crack has no slice");
    return problems;
}

namespace {

constexpr int kSlicePoints = 8;
using Rule = boost::math::quadrature::gauss<double, kSlicePoints>;

// Gauss abscissas on [-1, 1], ascending, and weights.
struct GaussPoints {
    std::array<double, kSlicePoints> node, weight;
    GaussPoints() {
        for (int i = 0; i < kSlicePoints / 2; ++i) {
            node[kSlicePoints / 2 + i] = Rule::abscissa()[i];
            node[kSlicePoints / 2 - 1 - i] = -Rule::abscissa()[i];
            weight[kSlicePoints / 2 + i] = weight[kSlicePoints / 2 - 1 - i] = Rule::weights()[i];
        }
    }
};
const GaussPoints kGauss;

// Legendre polynomials P_0 .. P_n at x.
std::array<double, kSlicePoints + 1> legendre(double x) {
    std::array<double, kSlicePoints + 1> p{1, x};
    for (int k = 1; k < kSlicePoints; ++k)
        p[k + 1] = ((2 * k + 1) * x * p[k] - k * p[k - 1]) / (k + 1);
    return p;
}

double zero_between(const std::function<double(double)>& f, double low, double high) {
    const bool rises = f(high) > 0;
    for (int halving = 0; halving < 50; ++halving) {
        const double middle = 0.5 * (low + high);
        ((f(middle) > 0) == rises ? high : low) = middle;
    }
    return 0.5 * (low + high);
}

// Tolerances relative to the healthy tooth's stiffness. Slices that differ cause small kinks.
constexpr double kUniformTolerance = 1e-11, kTolerance = 1e-5;

// Stiffnesses of a slice per unit of the healthy face width; zero where the compliance is infinite.
struct SliceStiffness {
    double bending = 0, shear = 0, foundation = 0;
};

// Contact position with the quantities that all slices share.
struct ContactPoint {
    double u = 0, cosine = 0, sine = 0;
    FoundationCompliance foundation;  // zero without one
};

double inverse_or_zero(double x) {
    return x > 0 ? 1 / x : 0;
}

}  // namespace

SliceRule::SliceRule(int slices) : panels_((slices + kSlicePoints - 1) / kSlicePoints) {
    for (std::size_t panel = 0; panel < panels_; ++panel)
        for (const double x : kGauss.node)
            points_.push_back((static_cast<double>(panel) + 0.5 * (1 + x)) /
                              static_cast<double>(panels_));
}

void SliceRule::whole(std::span<double> weights) const {
    for (std::size_t i = 0; i < points_.size(); ++i)
        weights[i] = 0.5 * kGauss.weight[i % kSlicePoints] / static_cast<double>(panels_);
}

void SliceRule::where(const std::function<double(double)>& seen, int samples,
                      std::span<double> weights) const {
    std::fill(weights.begin(), weights.end(), 0.0);
    const int per_panel = std::max(1, samples / static_cast<int>(panels_));
    for (std::size_t panel = 0; panel < panels_; ++panel) {
        double here = static_cast<double>(panel) / static_cast<double>(panels_);
        double value = seen(here);
        for (int sample = 1; sample <= per_panel; ++sample) {
            const double next =
                (static_cast<double>(panel) + static_cast<double>(sample) / per_panel) /
                static_cast<double>(panels_);
            const double following = seen(next);
            const double cut =
                (value > 0) != (following > 0) ? zero_between(seen, here, next) : next;
            if (value > 0)
                add_part(panel, here, cut, weights);
            else if (following > 0)
                add_part(panel, cut, next, weights);
            here = next;
            value = following;
        }
    }
}

void SliceRule::add_part(std::size_t panel, double from, double to,
                         std::span<double> weights) const {
    const double scale = static_cast<double>(panels_), first = static_cast<double>(panel);
    const auto low = legendre(2 * (from * scale - first) - 1);
    const auto high = legendre(2 * (to * scale - first) - 1);
    for (int i = 0; i < kSlicePoints; ++i) {
        // Coefficient k of the interpolant is (2 k + 1) / 2 sum_i weight P_k f. The integral of P_k
        // is (P_(k+1) - P_(k-1)) / (2 k + 1).
        const auto polynomial = legendre(kGauss.node[i]);
        double sum = high[1] - low[1];
        for (int k = 1; k < kSlicePoints; ++k)
            sum += polynomial[k] * ((high[k + 1] - high[k - 1]) - (low[k + 1] - low[k - 1]));
        weights[panel * kSlicePoints + i] += 0.5 * kGauss.weight[i] * sum / (2 * scale);
    }
}

class SpatialCrackFault : public ToothFault {
  public:
    SpatialCrackFault(const SpatialCrack& family, const CrackSurface& surface)
        : family_(family),
          surface_(surface),
          rule_(surface.uniform() ? 1 : family.growth_.slices),
          healthy_(family.profile_, {}) {
        if (!surface.cracked())
            return;
        for (const double t : rule_.points())
            add_slice(surface.crack(t));
        find_heights();
        find_breaks();
        const SectionSweep whole = swept_to(healthy_, family.angle_at(family.contact_ratio_ / 2));
        const double healthy_compliance =
            compliance(whole.moments(), family.profile_, family.material_,
                       family.profile_.involute_angle(family.angle_at(family.contact_ratio_ / 2)));
        const ToothPairFit fit((surface.uniform() ? kUniformTolerance : kTolerance) /
                               healthy_compliance);
        curve_ = fit([this](std::span<const double> tau,
                            std::span<double> stiffness) { sum_slices(tau, stiffness); },
                     breaks_, family.contact_ratio_);
        breaks_.clear();
        for (const auto& piece : curve_.pieces()) {
            breaks_.push_back(piece.begin);
            breaks_.push_back(piece.end);
        }
    }

    int gear() const override { return family_.which_; }
    bool changes_sections() const override { return surface_.cracked(); }
    std::vector<double> breaks() const override { return breaks_; }
    void beam_compliance(std::span<const double> tau, std::span<double> compliance) const override {
        curve_(tau, compliance);
        for (double& c : compliance)
            c = c > 0 ? 1 / c : std::numeric_limits<double>::infinity();
    }

  private:
    SectionSweep swept_to(const CrackedSections& sections, double u) const {
        SectionSweep sweep(family_.profile_, sections);
        sweep.advance(u);
        return sweep;
    }

    bool by_sections() const { return family_.law_ == CrackLaw::sections; }

    void add_slice(const Crack& crack) {
        if (!by_sections()) {
            slices_.push_back(healthy_);
            added_.emplace_back(CrackPath(family_.profile_, crack.angle_rad, crack.height_m),
                                family_.material_, crack.depth_m);
            lever_factor_.push_back(1);
            return;
        }
        slices_.emplace_back(family_.profile_, crack);
        const double below = std::cos(crack.angle_rad) * crack.depth_m - crack.height_m;
        const double cut =
            below > 0 ? below * std::tan(crack.angle_rad) : 0;  // of the root's width
        const double root_width = 2 * family_.profile_.root_half_thickness();
        lever_factor_.push_back(inverse_or_zero(std::max(0.0, 1 - cut / root_width)));
    }

    // Height of the section at u above the section from which the cracks' heights are measured.
    double height_at(double u) const {
        const double from = by_sections()
                                ? family_.profile_.root_axial()
                                : family_.profile_.section(family_.profile_.critical()).axial;
        return std::abs(family_.profile_.section(u).axial - from);
    }

    static constexpr int kSamples = 64;

    void find_heights() {
        lowest_ = std::numeric_limits<double>::infinity();
        for (int i = 0; i <= kSamples; ++i) {
            const double l = surface_.height(surface_.length_m * i / kSamples);
            lowest_ = std::min(lowest_, l);
            highest_ = std::max(highest_, l);
        }
    }

    // Adds the positions where the contact passes the crack's lowest and highest start, and where
    // it leaves the cracked sections at either end. Between these positions the slices change one
    // after the other.
    void find_breaks() {
        for (const double height : {lowest_, highest_})
            add_break(by_sections() ? CrackedSections(family_.profile_, {1e-9, 1, height}).start()
                                    : CrackPath(family_.profile_, 1, height).start());
        if (by_sections())
            for (const double t : {0.0, 1.0})
                add_break(CrackedSections(family_.profile_, surface_.crack(t)).boundary());
        std::sort(breaks_.begin(), breaks_.end());
    }
    void add_break(double u) {
        const double tau = family_.position_of(u);
        if (tau > 0 && tau < family_.contact_ratio_)
            breaks_.push_back(tau);
    }

    ContactPoint contact_at(double tau) const {
        const double u = family_.angle_at(tau), angle = family_.profile_.involute_angle(u);
        return {u, std::cos(angle), std::sin(angle),
                family_.foundation_ ? family_.foundation_->self(angle) : FoundationCompliance{}};
    }

    // Stiffness of the tooth, N/m, at ascending positions.
    void sum_slices(std::span<const double> tau, std::span<double> stiffness) const {
        const std::size_t n = tau.size(), count = slices_.size();
        const bool root_to_tip = family_.contact_rate_ < 0;
        std::vector<ContactPoint> touches(n);  // from the root
        for (std::size_t i = 0; i < n; ++i)
            touches[i] = contact_at(tau[root_to_tip ? i : n - 1 - i]);
        std::vector<SliceStiffness> at(n * count);
        for (std::size_t slice = 0; slice < count; ++slice) {
            SectionSweep sweep(family_.profile_, slices_[slice]);
            for (std::size_t i = 0; i < n; ++i)
                at[i * count + slice] = slice_stiffness(slice, touches[i], sweep);
        }
        SectionSweep sweep(family_.profile_, healthy_);
        for (std::size_t i = 0; i < n; ++i) {
            const std::span<const SliceStiffness> slices(at.data() + i * count, count);
            stiffness[root_to_tip ? i : n - 1 - i] =
                by_sections() ? tooth_stiffness(touches[i], sweep, slices)
                              : stiffness_in_series(touches[i], sweep, slices);
        }
    }

    // Stiffness of a slice for a contact above the crack's start. Contacts below it give the slice
    // no weight in the sum.
    SliceStiffness slice_stiffness(std::size_t slice, const ContactPoint& touch,
                                   SectionSweep& sweep) const {
        const CrackedSections& sections = slices_[slice];
        if (sections.broken() || (sections.past_centre() && touch.u <= sections.boundary()) ||
            (!by_sections() && added_[slice].broken()))
            return {};
        sweep.advance(touch.u);
        const double added =
            by_sections() ? 0 : added_[slice].added(family_.profile_.involute_angle(touch.u));
        return stiffness_of(sweep.moments(), touch, lever_factor_[slice], added);
    }

    SliceStiffness stiffness_of(const SectionMoments& moments, const ContactPoint& touch,
                                double lever, double added = 0) const {
        return {inverse_or_zero(
                    bending_compliance(moments, family_.profile_, family_.material_, touch.cosine) +
                    added),
                inverse_or_zero(shear_compliance(moments, family_.material_, touch.cosine)),
                lever > 0 ? inverse_or_zero(touch.foundation.total(lever)) : 0};
    }

    // Stiffness of the tooth by fracture mechanics. Each slice is in series with a slice of the
    // healthy tooth's other compliance, of the contact and of the mate, which is taken as an equal
    // healthy tooth. So a slice without a crack takes over load only as far as these give way.
    double stiffness_in_series(const ContactPoint& touch, SectionSweep& sweep,
                               std::span<const SliceStiffness> slices) const {
        sweep.advance(touch.u);
        const SliceStiffness whole = stiffness_of(sweep.moments(), touch, 1);
        const double other = axial_compliance(sweep.moments(), family_.material_, touch.sine) +
                             (whole.shear > 0 ? 1 / whole.shear : 0);
        const double healthy = 1 / whole.bending + other;
        const double mate = healthy + 1 / hertz_stiffness(family_.material_);
        const std::vector<double> weights = affected_weights(height_at(touch.u));
        double sum = 0, cracked = 0;
        for (std::size_t i = 0; i < slices.size(); ++i) {
            const double share = share_of_face(i, weights[i]);
            cracked += share;
            if (slices[i].bending > 0)
                sum += share / (1 / slices[i].bending + other + mate);
        }
        sum += (1 - cracked) / (healthy + mate);
        return sum > 0 ? 1 / (1 / sum - mate) : 0;
    }

    double share_of_face(std::size_t slice, double weight) const {
        return weight * surface_.stretching(rule_.points()[slice]) / surface_.face_width_m;
    }

    // The same by sections, where the slices' stiffnesses add kind by kind.
    double tooth_stiffness(const ContactPoint& touch, SectionSweep& sweep,
                           std::span<const SliceStiffness> slices) const {
        sweep.advance(touch.u);
        const SliceStiffness whole = stiffness_of(sweep.moments(), touch, 1);
        const std::vector<double> weights = affected_weights(height_at(touch.u));
        SliceStiffness sum;
        double cracked = 0;  // fraction of the face width
        for (std::size_t i = 0; i < slices.size(); ++i) {
            const double share = share_of_face(i, weights[i]);
            cracked += share;
            sum.bending += share * slices[i].bending;
            sum.shear += share * slices[i].shear;
            sum.foundation += share * slices[i].foundation;
        }
        sum.bending += (1 - cracked) * whole.bending;
        sum.shear += (1 - cracked) * whole.shear;
        sum.foundation += (1 - cracked) * whole.foundation;
        double total_compliance =
            1 / sum.bending + axial_compliance(sweep.moments(), family_.material_, touch.sine);
        if (whole.shear > 0)
            total_compliance += 1 / sum.shear;
        if (whole.foundation > 0)
            total_compliance += 1 / sum.foundation - 1 / whole.foundation;
        return sum.bending > 0 ? 1 / total_compliance : 0;
    }

    // Weights of the slices whose crack affects a contact at that height.
    std::vector<double> affected_weights(double height) const {
        std::vector<double> weights(slices_.size());
        if (height >= highest_)
            rule_.whole(weights);
        else if (height > lowest_)
            rule_.where([&](double t) { return height - surface_.height(surface_.z_at(t)); },
                        kSamples, weights);
        return weights;
    }

    const SpatialCrack& family_;
    CrackSurface surface_;
    SliceRule rule_;
    CrackedSections healthy_;
    std::vector<CrackedSections> slices_;
    std::vector<CrackCompliance> added_;  // added compliance of each slice, by fracture mechanics
    std::vector<double> lever_factor_;    // S / S'; 0 where the root is cut through
    double lowest_ = 0, highest_ = 0;     // heights of the crack's start, as in CrackSurface
    std::vector<double> breaks_;
    ToothPairCurve curve_;
};

SpatialCrack::SpatialCrack(const gears::MeshGeometry& geometry, const Material& material,
                           Profile profile, int which, CrackGrowth growth,
                           const FilletFoundation* foundation, CrackLaw law)
    : profile_(geometry.gear(which == 2 ? 2 : 1), profile),
      material_(material),
      which_(which),
      growth_(std::move(growth)),
      foundation_(foundation),
      law_(law),
      contact_ratio_(geometry.contact_ratio()),
      contact_start_(profile_.involute_angle(geometry.contact_angle_at_start(which == 2 ? 2 : 1))),
      contact_rate_(profile_.involute_angle(geometry.contact_angle_rate(which == 2 ? 2 : 1))) {
    if (which != 1 && which != 2)
        throw std::invalid_argument("the cracked gear of a pair is gear 1 or gear 2");
    const auto problems = growth_problems(growth_, material.face_width_m);
    if (!problems.empty())
        throw std::invalid_argument(fmt::format("{}", fmt::join(problems, "; ")));
}

std::unique_ptr<const ToothFault> SpatialCrack::at(double stage) const {
    return std::make_unique<SpatialCrackFault>(*this, growth_.at(stage, material_.face_width_m));
}

}  // namespace gearpod::stiffness
