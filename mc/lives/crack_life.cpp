#include "mc/lives/crack_life.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/random/normal_distribution.hpp>
#include <cmath>
#include <numbers>

#include "mc/study/random/philox.hpp"

namespace gearpod::mc {
namespace {

// Piecewise linear interpolation; the end segments are extrapolated.
double interpolated(const std::vector<double>& xs, const std::vector<double>& values, double x) {
    const auto above = std::upper_bound(xs.begin() + 1, xs.end() - 1, x);
    const auto i = static_cast<std::size_t>(above - xs.begin());
    const double share = (x - xs[i - 1]) / (xs[i] - xs[i - 1]);
    return values[i - 1] + share * (values[i] - values[i - 1]);
}

}  // namespace

CrackLife::CrackLife(const LifePlan& plan)
    : plan_(plan),
      crack_(plan.tooth.geometry, plan.tooth.profile, plan.tooth.gear, plan.tooth.angle_rad,
             plan.tooth.face_width_m, plan.tooth.law) {}

double CrackLife::cycles_per_hour(const InstanceInputs& inputs) const {
    const double meshes_a_second =
        std::abs(plan_.drivetrain->mesh_frequency_rad_s(inputs.speed_rad_s)) /
        (2.0 * std::numbers::pi);
    return 3600.0 * meshes_a_second * plan_.tooth.meetings / plan_.tooth.teeth;
}

double CrackLife::range_per_force(double depth_m) const {
    return crack_.largest_intensity(depth_m, 1.0);
}

LifeHistory CrackLife::history(const Realization& gearbox, bool cracked) const {
    const GearboxId& id = gearbox.id;
    const InstanceInputs& inputs = gearbox.inputs;
    const CampaignPlan& campaign = plan_.campaign;
    LifeHistory history;
    Philox engine = gearbox_stream(plan_.seed, id, StreamPurpose::life_records);
    boost::random::normal_distribution<double> unit;
    for (int i = 0; i < campaign.records; ++i) {
        LifeRecord record;
        record.hours = i * campaign.interval_h;
        record.torque = plan_.distributions.torque.factor(unit(engine));
        record.gain = plan_.distributions.gain.factor(unit(engine));
        record.noise = plan_.distributions.noise.factor(unit(engine));
        history.records.push_back(record);
    }
    if (plan_.distributions.speed.varies()) {
        Philox speeds = gearbox_stream(plan_.seed, id, StreamPurpose::life_speeds);
        boost::random::normal_distribution<double> of_speed;
        for (LifeRecord& record : history.records) {
            record.speed = plan_.distributions.speed.factor(of_speed(speeds));
        }
    }
    history.first_cracked = history.records.size();
    if (cracked) {
        history.first_cracked = static_cast<std::size_t>(campaign.baseline_records);
        std::visit([&](const auto& growth) { grow(growth, inputs, history); }, plan_.growth);
    }
    return history;
}

double CrackLife::force_N(const InstanceInputs& inputs, const LifeRecord& record) const {
    InstanceInputs loaded = inputs;
    loaded.torque_N_m *= record.torque;
    return plan_.drivetrain->mesh_force_N(loaded);
}

void CrackLife::grow(const ParisStart& paris, const InstanceInputs& inputs,
                     LifeHistory& history) const {
    const double interval_h = plan_.campaign.interval_h, last_m = plan_.campaign.last_m;
    const stiffness::ParisGrowth growth(
        stiffness::paris_law_mm_MPa(inputs.paris_factor, inputs.paris_exponent),
        [&](double depth) { return range_per_force(depth); }, paris.first_m, last_m);
    const double whole = growth.damage_to(last_m);
    const double cycles = cycles_per_hour(inputs) * interval_h;
    double damage = 0.0;
    for (std::size_t i = history.first_cracked; i < history.records.size(); ++i) {
        LifeRecord& record = history.records[i];
        record.depth_m = growth.depth_after(damage);
        const double more = growth.damage_of(force_N(inputs, record), cycles * record.speed);
        if (damage + more >= whole) {
            history.end_hours = record.hours + interval_h * (whole - damage) / more;
            history.records.resize(i + 1);
            return;
        }
        damage += more;
    }
}

void CrackLife::grow(const DepthCurve& curve, const InstanceInputs& inputs,
                     LifeHistory& history) const {
    const double last_m = plan_.campaign.last_m;
    if (history.first_cracked >= history.records.size()) {
        return;
    }
    const double begin_h = history.records[history.first_cracked].hours;
    const double end_h =
        begin_h + interpolated(curve.depth_m, curve.hours, last_m) / inputs.curve_pace;
    for (std::size_t i = history.first_cracked; i < history.records.size(); ++i) {
        LifeRecord& record = history.records[i];
        if (record.hours >= end_h) {
            history.end_hours = end_h;
            history.records.resize(i);
            return;
        }
        record.depth_m = std::min(
            last_m,
            interpolated(curve.hours, curve.depth_m, (record.hours - begin_h) * inputs.curve_pace));
    }
    if (history.records.back().hours + plan_.campaign.interval_h >= end_h) {
        history.end_hours = end_h;
    }
}

std::string crack_records_text(std::span<const LifeHistory* const> histories) {
    std::vector<std::size_t> counts;
    for (const LifeHistory* history : histories) {
        if (history->end_hours) {
            counts.push_back(history->records.size() -
                             std::min(history->records.size(), history->first_cracked));
        }
    }
    if (counts.empty()) {
        return "none fails";
    }
    std::ranges::sort(counts);
    const std::size_t median = counts[counts.size() / 2];
    return counts.front() == counts.back()
               ? fmt::format("{}", median)
               : fmt::format("{} ({} to {})", median, counts.front(), counts.back());
}

}  // namespace gearpod::mc
