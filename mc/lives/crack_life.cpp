#include "mc/lives/crack_life.hpp"

#include <boost/random/normal_distribution.hpp>
#include <cmath>
#include <numbers>

#include "mc/random/philox.hpp"
#include "mc/study/faults/crack_angle.hpp"
#include "mc/study/gears.hpp"
#include "stiffness/growth/paris_growth.hpp"

namespace gearpod::mc {
namespace {

stiffness::RootCrack root_crack(const Scene& scene) {
    const Study& study = scene.study();
    const FaultPlace place = fault_places(study.fault).front();
    return {scene.meshes()[place.mesh].geometry.value(), profile_of(study), place.gear,
            crack_angle_rad(study), study.gearbox.face_width_m.value()};
}

}  // namespace

CrackLife::CrackLife(const Scene& scene) : scene_(scene), crack_(root_crack(scene)) {}

double CrackLife::cycles_per_hour(const InstanceInputs& inputs) const {
    const Study& study = scene_.study();
    const Member member = *study.fault.member;
    // A central gear's tooth meets every planet in turn.
    const int meetings = member == Member::sun ? study.gearbox.planets : 1;
    const double meshes_a_second =
        std::abs(scene_.drive().mesh_frequency_rad_s(inputs.speed_rad_s)) /
        (2.0 * std::numbers::pi);
    return 3600.0 * meshes_a_second * meetings / teeth_of(study, member).value();
}

double CrackLife::range_per_force(double depth_m) const {
    return crack_.largest_intensity(depth_m, 1.0);
}

LifeHistory CrackLife::history(const GearboxId& id, const InstanceInputs& inputs,
                               bool cracked) const {
    const Study& study = scene_.study();
    const Life& life = study.life;
    LifeHistory history;
    Philox engine = gearbox_stream(study, id, "life.records");
    boost::random::normal_distribution<double> unit;
    for (int i = 0; i < life.records; ++i) {
        LifeRecord record;
        record.hours = i * *life.interval_h;
        record.torque = std::exp(life.torque_scatter * unit(engine));
        record.gain = std::exp(life.gain_scatter * unit(engine));
        record.noise = std::exp(life.noise_scatter * unit(engine));
        history.records.push_back(record);
    }
    history.first_cracked = history.records.size();
    if (cracked) {
        history.first_cracked = static_cast<std::size_t>(study.monitoring.baseline_records);
        grow(inputs, history);
    }
    return history;
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
        InstanceInputs loaded = inputs;
        loaded.torque_N_m *= record.torque;
        const double force = scene_.drive().mesh_force_N(loaded);
        const bool breaks =
            life.fracture_toughness_Pa_m05 &&
            force * range_per_force(record.depth_m) >= *life.fracture_toughness_Pa_m05;
        if (breaks) {
            history.end_hours = record.hours;
            history.records.resize(i);
            return;
        }
        const double more = growth.damage_of(force, cycles);
        if (damage + more >= whole) {
            history.end_hours = record.hours + *life.interval_h * (whole - damage) / more;
            history.records.resize(i + 1);
            return;
        }
        damage += more;
    }
}

}  // namespace gearpod::mc
