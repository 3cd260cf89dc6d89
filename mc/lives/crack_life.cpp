#include "mc/lives/crack_life.hpp"

#include <algorithm>
#include <boost/random/normal_distribution.hpp>
#include <cmath>
#include <numbers>

#include "mc/study/faults/crack.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/random/philox.hpp"
#include "stiffness/growth/crack_growth.hpp"

namespace gearpod::mc {
namespace {

stiffness::RootCrack root_crack(const Scene& scene) {
    const Study& study = scene.study();
    const FaultPlace place = fault_places(study.fault).front();
    return {scene.meshes()[place.mesh].geometry.value(),
            profile_of(study),
            place.gear,
            crack_angle_rad(study),
            study.gearbox.face_width_m.value(),
            crack_law(study)};
}

// Piecewise linear interpolation; the end segments are extrapolated.
double interpolated(const std::vector<double>& at, const std::vector<double>& values, double x) {
    const auto above = std::upper_bound(at.begin() + 1, at.end() - 1, x);
    const auto i = static_cast<std::size_t>(above - at.begin());
    const double share = (x - at[i - 1]) / (at[i] - at[i - 1]);
    return values[i - 1] + share * (values[i] - values[i - 1]);
}

}  // namespace

CrackLife::CrackLife(const Scene& scene)
    : scene_(scene), distributions_(scene.study()), crack_(root_crack(scene)) {}

double CrackLife::cycles_per_hour(const InstanceInputs& inputs) const {
    const Study& study = scene_.study();
    const Member member = *study.fault.member;
    // A tooth of a central gear meets every planet in turn.
    const int meetings = member == Member::sun ? study.gearbox.planets : 1;
    const double meshes_a_second =
        std::abs(scene_.drivetrain().mesh_frequency_rad_s(inputs.speed_rad_s)) /
        (2.0 * std::numbers::pi);
    return 3600.0 * meshes_a_second * meetings / teeth_of(study, member).value();
}

double CrackLife::range_per_force(double depth_m) const {
    return crack_.largest_intensity(depth_m, 1.0);
}

LifeHistory CrackLife::history(const Realization& gearbox, bool cracked) const {
    const GearboxId& id = gearbox.id;
    const InstanceInputs& inputs = gearbox.inputs;
    const Study& study = scene_.study();
    const Life& life = study.life;
    LifeHistory history;
    Philox engine = gearbox_stream(scene_.draw().seed, id, StreamPurpose::life_records);
    boost::random::normal_distribution<double> unit;
    for (int i = 0; i < life.records; ++i) {
        LifeRecord record;
        record.hours = i * *life.interval_h;
        record.torque = distributions_.torque.factor(unit(engine));
        record.gain = distributions_.gain.factor(unit(engine));
        record.noise = distributions_.noise.factor(unit(engine));
        history.records.push_back(record);
    }
    if (distributions_.speed.varies()) {
        Philox speeds = gearbox_stream(scene_.draw().seed, id, StreamPurpose::life_speeds);
        boost::random::normal_distribution<double> of_speed;
        for (LifeRecord& record : history.records) {
            record.speed = distributions_.speed.factor(of_speed(speeds));
        }
    }
    history.first_cracked = history.records.size();
    if (cracked) {
        history.first_cracked = static_cast<std::size_t>(study.monitoring.baseline_records);
        life.curve_h.empty() ? grow(inputs, history) : follow_curve(inputs, history);
    }
    return history;
}

double CrackLife::force_N(const InstanceInputs& inputs, const LifeRecord& record) const {
    InstanceInputs loaded = inputs;
    loaded.torque_N_m *= record.torque;
    return scene_.drivetrain().mesh_force_N(loaded);
}

bool CrackLife::breaks(const InstanceInputs& inputs, const LifeRecord& record) const {
    const auto& toughness = scene_.study().life.fracture_toughness_Pa_m05;
    return toughness && force_N(inputs, record) * range_per_force(record.depth_m) >= *toughness;
}

void CrackLife::grow(const InstanceInputs& inputs, LifeHistory& history) const {
    const Life& life = scene_.study().life;
    const stiffness::ParisGrowth growth(
        stiffness::paris_law_mm_MPa(inputs.paris_factor, inputs.paris_exponent),
        [&](double depth) { return range_per_force(depth); }, *life.first_depth_m,
        *life.last_depth_m);
    const double whole = growth.damage_to(*life.last_depth_m);
    const double cycles = cycles_per_hour(inputs) * *life.interval_h;
    double damage = 0.0;
    for (std::size_t i = history.first_cracked; i < history.records.size(); ++i) {
        LifeRecord& record = history.records[i];
        record.depth_m = growth.depth_after(damage);
        if (breaks(inputs, record)) {
            history.end_hours = record.hours;
            history.records.resize(i);
            return;
        }
        const double more = growth.damage_of(force_N(inputs, record), cycles * record.speed);
        if (damage + more >= whole) {
            history.end_hours = record.hours + *life.interval_h * (whole - damage) / more;
            history.records.resize(i + 1);
            return;
        }
        damage += more;
    }
}

void CrackLife::follow_curve(const InstanceInputs& inputs, LifeHistory& history) const {
    const Life& life = scene_.study().life;
    if (history.first_cracked >= history.records.size()) {
        return;
    }
    const double begin_h = history.records[history.first_cracked].hours;
    const double end_h =
        begin_h +
        interpolated(life.curve_depth_m, life.curve_h, *life.last_depth_m) / inputs.curve_pace;
    for (std::size_t i = history.first_cracked; i < history.records.size(); ++i) {
        LifeRecord& record = history.records[i];
        if (record.hours >= end_h) {
            history.end_hours = end_h;
            history.records.resize(i);
            return;
        }
        record.depth_m = std::min(*life.last_depth_m,
                                  interpolated(life.curve_h, life.curve_depth_m,
                                               (record.hours - begin_h) * inputs.curve_pace));
        if (breaks(inputs, record)) {
            history.end_hours = record.hours;
            history.records.resize(i);
            return;
        }
    }
    if (history.records.back().hours + *life.interval_h >= end_h) {
        history.end_hours = end_h;
    }
}

}  // namespace gearpod::mc
