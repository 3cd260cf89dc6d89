// What turns and loads the gears of a study, one class for each kind of gearbox: speeds, mesh
// phases, torques, transmission error, and the meshes after which all this repeats.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "dynamics/gearbox.hpp"
#include "gears/planetary.hpp"
#include "gears/power_flow.hpp"
#include "mc/scene/sampling.hpp"
#include "mc/study/study.hpp"
#include "signals/tile_signals.hpp"

namespace gearpod::mc {

class Drive {
  public:
    virtual ~Drive() = default;

    // Radians of mesh phase a second, at the speed of Sampler::speed_member().
    virtual double mesh_frequency_rad_s(double speed_rad_s) const = 0;
    // Turns in a mesh period: of the driven member, and of the frame that x and y turn with, which
    // may be backwards.
    virtual double input_turns_per_mesh() const = 0;
    virtual double frame_turns_per_mesh() const = 0;
    // The train's turning: the degree of freedom that drives it, and its speed along
    // dynamics::rigid_rotation.
    virtual int driving_degree(const dynamics::GearboxLayout& layout) const = 0;
    virtual double turning_m_s(const InstanceInputs& instance) const = 0;
    // Sets the speed, mesh period and load of one gearbox.
    virtual void set(const InstanceInputs& instance, dynamics::GearboxInputs& inputs) const = 0;
    // Mean force along the line of action of one pair of mesh `mesh` of meshes_of(kind), N.
    virtual double mesh_force_N(const InstanceInputs& instance) const = 0;

    // Pairs in the dynamic model's order: each mesh of meshes_of(kind) so often.
    virtual int pairs_per_mesh() const = 0;
    virtual std::string pair_name(int pair) const = 0;
    // Mesh phase at which a pair's contact is at the pitch point.
    virtual double pitch_phase(int pair) const = 0;
    // Contact runs the line of action from its end to its start.
    virtual bool reversed() const = 0;

    // Park et al. (2016), Eq. 8: output rotation less input rotation times their ratio, as weights
    // of the model's motions, rad/m.
    virtual std::vector<double> te_weight(const dynamics::GearboxLayout& layout) const = 0;
    // The monitored gear's teeth, its turns in the span, and the meshes of a carrier turn.
    virtual signals::SpanLayout span() const = 0;
};

// The study must have gears.
std::unique_ptr<const Drive> make_drive(const Study& study);

// A planetary train as the study gives it, and what drives it.
gears::PlanetaryTrain planetary_train(const Study& study);
gears::FixedMember fixed_member(Member member);
gears::Member central_member(Member member);

class PlanetaryDrive : public Drive {
  public:
    explicit PlanetaryDrive(const Study& study);

    double mesh_frequency_rad_s(double speed_rad_s) const override;
    double input_turns_per_mesh() const override;
    double frame_turns_per_mesh() const override;
    int driving_degree(const dynamics::GearboxLayout& layout) const override;
    double turning_m_s(const InstanceInputs& instance) const override;
    void set(const InstanceInputs& instance, dynamics::GearboxInputs& inputs) const override;
    double mesh_force_N(const InstanceInputs& instance) const override;
    int pairs_per_mesh() const override { return train_.planets; }
    std::string pair_name(int pair) const override;
    double pitch_phase(int pair) const override;
    bool reversed() const override { return sense_ == gears::PlanetSense::counter_clockwise; }
    std::vector<double> te_weight(const dynamics::GearboxLayout& layout) const override;
    signals::SpanLayout span() const override;

    const gears::PlanetaryTrain& train() const { return train_; }
    gears::PlanetSense sense() const { return sense_; }
    // How much later than its sun mesh a planet's ring mesh is at its pitch point.
    double ring_to_sun_phase() const { return ring_to_sun_phase_; }
    bool carrier_turns_backwards() const;

  private:
    gears::Speeds speeds(double given) const {
        return gears::driven_speeds(train_, flow_, speed_of_, given);
    }

    gears::PlanetaryTrain train_;
    gears::PowerFlow flow_;
    gears::Member speed_of_, torque_on_;
    gears::PlanetSense sense_;
    double ring_to_sun_phase_;
    gears::Members radius_m_;  // of the base circles; of the carrier the centre distance
};

class FixedShaftDrive : public Drive {
  public:
    explicit FixedShaftDrive(const Study& study);

    double mesh_frequency_rad_s(double speed_rad_s) const override;
    double input_turns_per_mesh() const override { return 1.0 / pinion_teeth_; }
    double frame_turns_per_mesh() const override { return 0.0; }
    int driving_degree(const dynamics::GearboxLayout&) const override { return dynamics::u_m; }
    double turning_m_s(const InstanceInputs& instance) const override;
    void set(const InstanceInputs& instance, dynamics::GearboxInputs& inputs) const override;
    double mesh_force_N(const InstanceInputs& instance) const override;
    int pairs_per_mesh() const override { return 1; }
    std::string pair_name(int) const override { return "m1"; }
    double pitch_phase(int) const override { return 0.0; }
    bool reversed() const override { return false; }
    std::vector<double> te_weight(const dynamics::GearboxLayout& layout) const override;
    signals::SpanLayout span() const override;

  private:
    int pinion_teeth_, gear_teeth_;
    double pinion_radius_m_, gear_radius_m_;  // of the base circles
    bool gear_monitored_;
};

}  // namespace gearpod::mc
