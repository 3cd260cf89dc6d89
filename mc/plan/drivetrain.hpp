// Operating state of a study's gears, one class for each kind of gearbox: speeds, mesh phases,
// torques, transmission error, and the number of mesh periods after which all this repeats.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "dynamics/gearbox.hpp"
#include "gears/planetary.hpp"
#include "machine/ids.hpp"
#include "mc/plan/instance_inputs.hpp"
#include "mc/study/study.hpp"
#include "signals/tile_signals.hpp"

namespace gearpod::mc {

// Degree of freedom that turns with a shaft, and its motion per rotation, m/rad.
struct ShaftDegree {
    int degree = 0;
    double radius_m = 0.0;
};

class Drivetrain {
  public:
    virtual ~Drivetrain() = default;

    // Mesh frequency, rad of mesh phase per second, for a speed of speed_member().
    virtual double mesh_frequency_rad_s(double speed_rad_s) const = 0;
    // Mesh period, s, likewise.
    double mesh_period_s(double speed_rad_s) const;
    // Turns per mesh period of the input member, and of the frame in which x and y are defined; the
    // latter may be negative.
    virtual double input_turns_per_mesh() const = 0;
    virtual double frame_turns_per_mesh() const = 0;
    // Turns of a member in the housing per mesh period, without sign; 0 if it stands still.
    virtual double shaft_turns_per_mesh(Member member) const = 0;
    // Rigid rotation of the train: index of the input's degree of freedom, and speed along
    // dynamics::rigid_rotation, m/s.
    virtual int input_degree_of_freedom(const dynamics::GearboxLayout& layout) const = 0;
    virtual double rotation_m_s(const InstanceInputs& instance) const = 0;
    // End of a shaft that connects one of kShafts with another gearbox. At a fixed-shaft gearbox
    // this is the outer end of the coupling, with the motor's or the load's inertia.
    virtual ShaftDegree shaft_degree(const dynamics::GearboxLayout& layout,
                                     Member member) const = 0;
    // Sets speed, mesh period and load of one gearbox.
    virtual void set(const InstanceInputs& instance, dynamics::GearboxInputs& inputs) const = 0;
    // Mean force along the line of action of one gear pair of mesh number `mesh` of
    // meshes_of(kind), N.
    virtual double mesh_force_N(const InstanceInputs& instance) const = 0;

    // Number of gear pairs of each mesh of meshes_of(kind), in the order of the dynamic model.
    virtual int pairs_per_mesh() const = 0;
    // Name in results, "rp1", and members, "ring and planet 1".
    virtual std::string pair_name(PairId pair) const = 0;
    virtual std::string pair_members(PairId pair) const = 0;
    // Mesh phase at which a gear pair's contact is at the pitch point.
    virtual double pitch_phase(PairId pair) const = 0;
    // True if contact moves along the line of action from its end to its start.
    virtual bool reversed() const = 0;

    // Weights of the model's displacements, rad/m, that give the transmission error: output
    // rotation minus input rotation times their ratio. Park et al. (2016), Eq. 8.
    virtual std::vector<double> te_weight(const dynamics::GearboxLayout& layout) const = 0;
    // Layout of the signal span: teeth of the monitored gear, its turns in the span, and mesh
    // periods of a carrier turn.
    virtual signals::SpanLayout span() const = 0;
};

// Drivetrain of a study with gears.
std::unique_ptr<const Drivetrain> make_drivetrain(const Study& study);
// Mesh frequency at the nominal speed of its study, with the sign of mesh_frequency_rad_s().
double nominal_mesh_frequency_Hz(const Study& study, const Drivetrain& drivetrain);

gears::PlanetaryTrain planetary_train(const Study& study);

class PlanetaryDrivetrain : public Drivetrain {
  public:
    explicit PlanetaryDrivetrain(const Study& study);

    double mesh_frequency_rad_s(double speed_rad_s) const override;
    double input_turns_per_mesh() const override;
    double frame_turns_per_mesh() const override;
    double shaft_turns_per_mesh(Member member) const override;
    int input_degree_of_freedom(const dynamics::GearboxLayout& layout) const override;
    double rotation_m_s(const InstanceInputs& instance) const override;
    ShaftDegree shaft_degree(const dynamics::GearboxLayout& layout, Member member) const override;
    void set(const InstanceInputs& instance, dynamics::GearboxInputs& inputs) const override;
    double mesh_force_N(const InstanceInputs& instance) const override;
    int pairs_per_mesh() const override { return train_.planets; }
    std::string pair_name(PairId pair) const override;
    std::string pair_members(PairId pair) const override;
    double pitch_phase(PairId pair) const override;
    bool reversed() const override { return sense_ == gears::PlanetSense::counter_clockwise; }
    std::vector<double> te_weight(const dynamics::GearboxLayout& layout) const override;
    signals::SpanLayout span() const override;

    const gears::PlanetaryTrain& train() const { return train_; }
    gears::PlanetSense sense() const { return sense_; }
    // Mesh phase by which a planet's ring mesh reaches its pitch point later than its sun mesh.
    double ring_to_sun_phase() const { return ring_to_sun_phase_; }
    bool carrier_turns_backwards() const;

  private:
    gears::Speeds speeds(double given) const {
        return gears::signed_speeds(train_, flow_, speed_of_, given);
    }

    double turns_per_mesh(Member member) const;

    gears::PlanetaryTrain train_;
    gears::PowerFlow flow_;
    Member speed_of_, torque_on_;
    gears::PlanetSense sense_;
    double ring_to_sun_phase_;
    gears::CentralMembers radius_m_;  // base circle radii; for the carrier the centre distance
};

}  // namespace gearpod::mc
