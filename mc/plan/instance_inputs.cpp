#include "mc/plan/instance_inputs.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "mc/study/faults/fault_kind.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/schema/schema.hpp"

namespace gearpod::mc {
namespace {

std::optional<InputId> find_input_id(std::string_view key) {
    static const std::map<std::string, InputId, std::less<>> ids = [] {
        std::map<std::string, InputId, std::less<>> all;
        for (const Key& known : schema()) {
            if (known.may_be_random()) {
                all.emplace(known.path(), InputId{all.size()});
            }
        }
        return all;
    }();
    const auto found = ids.find(key);
    return found == ids.end() ? std::nullopt : std::optional(found->second);
}

double angle_of(const Gearbox& gearbox, std::size_t planet) {
    return gearbox.planet_positions_rad.empty()
               ? 2.0 * std::numbers::pi * static_cast<double>(planet) / gearbox.planets
               : gearbox.planet_positions_rad[planet];
}

void move_pin(double angle, double tangential_m, double radial_m,
              dynamics::PlanetDeviations& planet) {
    const double c = std::cos(angle), s = std::sin(angle);
    planet.pin_x_m += radial_m * c - tangential_m * s;
    planet.pin_y_m += radial_m * s + tangential_m * c;
}

double of_planet(const std::vector<double>& list, std::size_t planet, double otherwise) {
    return planet < list.size() ? list[planet] : otherwise;
}

// Planets as given in the study; identical if nothing is given.
Planets given_planets(const Study& study) {
    const PlanetDifferences& given = study.planets;
    Planets planets;
    for (std::size_t n = 0; n < planets.size(); ++n) {
        if (!given.pin_tangential_m.empty() || !given.pin_radial_m.empty()) {
            move_pin(angle_of(study.gearbox, n), of_planet(given.pin_tangential_m, n, 0.0),
                     of_planet(given.pin_radial_m, n, 0.0), planets[n]);
        }
    }
    return planets;
}

InputsRecipe::Body body_recipe(const Study& study, Member member) {
    const auto id = [&](const char* label) { return find_input_id(member_key(member, label)); };
    InputsRecipe::Body body{id("mass_kg"),
                            id("inertia_kg_m2"),
                            id("inertia_over_r2_kg"),
                            id("bearing_stiffness_N_m"),
                            id("bearing_damping_N_s_m"),
                            id("quality")};
    if (study.gearbox.kind == GearboxKind::fixed_shaft) {
        body.radius_m = has_toothed_member(study.gearbox.kind, member)
                            ? gear_of(study, member).pitch_radius()
                            : 0.0;
        return body;
    }
    // For a disc with the pitch radius r_p, J = m r_p^2 / 2, and r_p = r_b / cos a.
    const double cosine = std::cos(transverse_pressure_angle_rad(study.gearbox));
    body.disc_over_r2 = member == Member::carrier ? 0.5 : 0.5 / (cosine * cosine);
    if (has_gears(study)) {
        body.radius_m = member == Member::carrier ? centre_distance_m(study)
                        : has_toothed_member(study.gearbox.kind, member)
                            ? gear_of(study, member).base_radius()
                            : 0.0;
    }
    return body;
}

class Computation {
  public:
    Computation(const InputsRecipe& recipe, const InputValues& values)
        : recipe_(recipe), values_(values) {}

    InstanceInputs inputs() const {
        InstanceInputs inputs{};
        for (const Member member : kAllMembers) {
            inputs.bodies[member] = body(recipe_.bodies[member]);
        }
        if (recipe_.gear_ratio) {
            inputs.fixed_shaft = fixed_shaft(*recipe_.gear_ratio);
        }
        inputs.backlash_m = values_.or_0<"gearbox.backlash_mm">();
        inputs.pitch_error_m = values_.or_0<"gearbox.pitch_error_um">();
        inputs.eccentricity_m = values_.or_0<"gearbox.eccentricity_um">();
        inputs.planets = recipe_.planets;
        inputs.support_stiffness_N_m = values_.or_0<"gearbox.support_stiffness_N_m">();
        inputs.support_damping_N_s_m = values_.or_0<"gearbox.support_damping_N_s_m">();
        inputs.mesh_damping = values_[*recipe_.mesh_damping].value_or(0.0);
        inputs.torque_N_m = values_.or_0<"operation.torque_N_m">();
        inputs.speed_rad_s = speed_rad_s();
        inputs.fluctuations = fluctuations();
        // A fixed-shaft gearbox has no transmission path weighting.
        inputs.path_exponent = recipe_.gear_ratio ? 0.0 : values_.or_0<"sensor.path_exponent">();
        inputs.gain = values_.or_0<"sensor.gain">();
        inputs.tone_level = values_.or_0<"sensor.tone_level">();
        inputs.bearing_level = values_.or_0<"sensor.bearing_level">();
        inputs.housing_frequency_factor = values_.or_0<"sensor.housing_frequency_factor">();
        const SensorNoise noise =
            sensor_noise(recipe_.noise, {values_.get<"sensor.noise_density_m_s2_per_sqrt_Hz">(),
                                         values_.or_0<"sensor.noise_m_s2">(),
                                         values_.or_0<"sensor.background_level">()});
        inputs.noise_m_s2 = noise.all_m_s2;
        inputs.white_noise_m_s2 = noise.white_m_s2;
        inputs.background_noise_m_s2 = noise.background_m_s2;
        inputs.encoder_noise_rad = values_.or_0<"sensor.encoder_noise_arcsec">();
        inputs.fault_size = value(recipe_.fault_size).value_or(0.0);
        inputs.paris_factor = values_.or_0<"life.paris_factor">();
        inputs.paris_exponent = values_.or_0<"life.paris_exponent">();
        inputs.curve_pace = values_.get<"life.curve_pace">().value_or(1.0);
        return inputs;
    }

  private:
    std::optional<double> value(std::optional<InputId> id) const {
        return id ? values_[*id] : std::nullopt;
    }

    // Masses are optional for a quasi-static gearbox, bearings for a torsional one.
    BodyInstance body(const InputsRecipe::Body& recipe) const {
        BodyInstance body{value(recipe.mass).value_or(0.0),
                          0.0,
                          0.0,
                          value(recipe.bearing_stiffness).value_or(0.0),
                          value(recipe.bearing_damping).value_or(0.0),
                          tooth_scale(recipe)};
        const std::optional<double> inertia = value(recipe.inertia);
        const double radius_m = recipe.radius_m;
        if (!recipe_.gear_ratio) {
            const std::optional<double> over_r2 = value(recipe.inertia_over_r2);
            body.inertia_over_r2_kg = over_r2   ? *over_r2
                                      : inertia ? *inertia / (radius_m * radius_m)
                                                : recipe.disc_over_r2 * body.mass_kg;
        } else {
            // By default that of a disc with the pitch radius: I = m R_p^2 / 2 (Tian, Table 4.1).
            body.inertia_kg_m2 = inertia.value_or(0.5 * body.mass_kg * radius_m * radius_m);
        }
        return body;
    }

    // Tooth deviations relative to grade 5: a factor of sqrt(2) for each grade.
    double tooth_scale(const InputsRecipe::Body& recipe) const {
        const std::optional<double> of_body = value(recipe.quality);
        const std::optional<double> grade =
            of_body ? of_body : values_.get<"gearbox.tooth_quality">();
        return grade ? std::pow(2.0, 0.5 * (*grade - 5.0)) : 0.0;
    }

    FixedShaftInstance fixed_shaft(double gear_ratio) const {
        return {values_.or_0<"gearbox.motor_inertia_kg_m2">(),
                values_.or_0<"gearbox.load_inertia_kg_m2">(),
                values_.or_0<"gearbox.motor_coupling_stiffness_N_m_rad">(),
                values_.or_0<"gearbox.load_coupling_stiffness_N_m_rad">(),
                values_.or_0<"gearbox.motor_coupling_damping_N_m_s_rad">(),
                values_.or_0<"gearbox.load_coupling_damping_N_m_s_rad">(),
                values_.get<"operation.load_torque_N_m">().value_or(
                    values_.or_0<"operation.torque_N_m">() * gear_ratio)};
    }

    FluctuationInstance fluctuations() const {
        return {values_.or_0<"operation.torque_noise">(),
                values_.or_0<"operation.torque_noise_band_Hz">(),
                values_.or_0<"operation.speed_fluctuation">(),
                values_.or_0<"operation.speed_fluctuation_order">(),
                values_.or_0<"operation.speed_fluctuation_phase_deg">(),
                values_.or_0<"operation.speed_noise">(),
                values_.or_0<"operation.speed_noise_band_Hz">()};
    }

    double speed_rad_s() const {
        for (const std::optional<double> given :
             {values_.get<"operation.pinion_speed_rpm">(), values_.get<"operation.sun_speed_rpm">(),
              values_.get<"operation.carrier_speed_rpm">()}) {
            if (given) {
                return *given;
            }
        }
        return 0.0;
    }

    const InputsRecipe& recipe_;
    const InputValues& values_;
};

}  // namespace

InputId input_id(std::string_view key) {
    return find_input_id(key).value();
}

InputValues::InputValues(const Study& study) {
    for (const Key& key : schema()) {
        if (key.may_be_random()) {
            values_.push_back(std::get<NumberAccess>(key.access).get(study));
        }
    }
}

InputsRecipe::InputsRecipe(const Study& study)
    : nominal(study), planets(given_planets(study)), noise(noise_model(study)) {
    for (const Member member : kAllMembers) {
        bodies[member] = body_recipe(study, member);
    }
    if (study.gearbox.kind == GearboxKind::fixed_shaft) {
        gear_ratio =
            static_cast<double>(*teeth_of(study, Member::gear)) / *teeth_of(study, Member::pinion);
    }
    dynamics::with_mesh_damping(study.effects.mesh_damping, [&](const auto& law) {
        mesh_damping = input_id("gearbox." + std::string(law.kParameter.key));
    });
    if (study.fault.kind != nullptr) {
        fault_size = input_id("fault." + std::string(study.fault.kind->size().name));
    }
}

Member speed_member(const Study& study) {
    return study.operation.pinion_speed_rad_s ? Member::pinion
           : study.operation.sun_speed_rad_s  ? Member::sun
                                              : Member::carrier;
}

InstanceInputs instance_inputs(const InputsRecipe& recipe, const InputValues& values) {
    return Computation(recipe, values).inputs();
}

InstanceInputs nominal_inputs(const Study& study) {
    const InputsRecipe recipe(study);
    return instance_inputs(recipe, recipe.nominal);
}

PlanetScatter::PlanetScatter(const Gearbox& gearbox, DrawnPer pin_owner) : pins(pin_owner) {
    for (std::size_t n = 0; n < static_cast<std::size_t>(gearbox.planets); ++n) {
        angles_rad.push_back(angle_of(gearbox, n));
    }
}

void add_random_planets(const PlanetScatter& scatter, const InputValues& values,
                        std::function<double()> normal, Planets& planets) {
    const double tangential_m = values.or_0<"gearbox.pin_tangential_rms_um">(),
                 radial_m = values.or_0<"gearbox.pin_radial_rms_um">();
    for (std::size_t n = 0; n < scatter.angles_rad.size(); ++n) {
        // Five variates for each planet, as in earlier versions: fewer would change all later ones.
        std::array<double, 5> variates{};
        std::ranges::generate(variates, std::ref(normal));
        move_pin(scatter.angles_rad[n], tangential_m * variates[0], radial_m * variates[1],
                 planets[n]);
    }
}

}  // namespace gearpod::mc
