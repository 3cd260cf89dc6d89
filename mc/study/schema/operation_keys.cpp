// Keys of [operation] and [effects].
#include "mc/study/keys/schema_line.hpp"
#include "mc/study/schema/presence.hpp"
#include "mc/study/schema/schema.hpp"

namespace gearpod::mc {
namespace {

constexpr ChoiceName kCentral[] = {name("ring", Member::ring), name("sun", Member::sun),
                                   name("carrier", Member::carrier)};
constexpr ChoiceName kMotions[] = {name("translational-torsional", Motion::translational_torsional),
                                   name("torsional", Motion::torsional),
                                   name("quasi-static", Motion::quasi_static),
                                   name("quasi-static-torsional", Motion::quasi_static_torsional)};
constexpr ChoiceName kFoundations[] = {name("none", Foundation::none),
                                       name("sainsot", Foundation::sainsot),
                                       name("elastic-ring", Foundation::elastic_ring)};
constexpr ChoiceName kContacts[] = {name("linear", Contact::linear),
                                    name("load-dependent", Contact::load_dependent)};
constexpr ChoiceName kSeparations[] = {name("none", Separation::none),
                                       name("one-sided", Separation::one_sided),
                                       name("two-sided", Separation::two_sided)};
constexpr ChoiceName kOnsets[] = {name("abrupt", ContactOnset::abrupt),
                                  name("extended", ContactOnset::extended)};
constexpr ChoiceName kDampings[] = {
#define GEARPOD_MESH_DAMPING(NAME, LAW) name(#NAME, MeshDamping::NAME),
#include "dynamics/effects/mesh_dampings.def"
#undef GEARPOD_MESH_DAMPING
};

std::span<const ChoiceName> path_names() {
    static const std::vector<ChoiceName> names = [] {
        std::vector<ChoiceName> all;
        for (const signals::PathWindow& window : signals::path_windows()) {
            all.push_back({window.name, static_cast<int>(all.size()) + 1});
        }
        all.push_back({"none", 0});
        return all;
    }();
    return names;
}

using U = Fluctuations;
// Limited so that the speed stays well above zero: time integration in mesh phase divides by it.
// Noise can reach six times its rms.
constexpr Range kSpeedAmplitude = closed_range(0, 0.3);
constexpr Range kSpeedNoise = closed_range(0, 0.05);

// clang-format off
const Key kOperationKeys[] = {
    {"operation", "fixed", choice<&Operation::fixed>(kCentral), kNone, kAny, planetary<may>, kShared, "member that stands still"},
    {"operation", "input", choice<&Operation::input>(kCentral), kNone, kAny, planetary<may>, kShared, "input member; by default the sun, or the ring if the sun is fixed"},
    {"operation", "torque_on", choice<&Operation::torque_on>(kCentral), kNone, kAny, planetary<may>, kShared, "member whose torque is given; by default the sun, or the ring if the sun is fixed"},
    {"operation", "torque_N_m", number<&Operation::torque_N_m>, kNm, kNotNegative, always, kRandom, "torque on the member torque_on, or of the motor of a fixed-shaft gearbox"},
    {"operation", "sun_speed_rpm", number<&Operation::sun_speed_rad_s>, kRpm, kPositive, planetary<may>, kRandom, "speed of the sun"},
    {"operation", "carrier_speed_rpm", number<&Operation::carrier_speed_rad_s>, kRpm, kPositive, planetary<may>, kRandom, "speed of the carrier"},
    {"operation", "load_torque_N_m", number<&Operation::load_torque_N_m>, kNm, kNotNegative, fixed_shaft<may>, kRandom, "torque of the load; by default in balance with the motor's"},
    {"operation", "pinion_speed_rpm", number<&Operation::pinion_speed_rad_s>, kRpm, kPositive, fixed_shaft<always>, kRandom, "speed of the pinion"},

    {"operation", "torque_noise", number<&U::torque_noise>, kNone, closed_range(0, 10), may, kRandom, "relative rms of a random fluctuation of all torques: Gaussian, different in every gearbox"},
    {"operation", "torque_noise_band_Hz", number<&U::torque_noise_Hz>, kHz, kFrequency, needed_with<"operation.torque_noise">, kRandom, "frequency at which the spectrum of torque_noise has fallen to half (to a twentieth at twice this frequency): white noise shaped by cubic B-splines"},
    {"operation", "speed_fluctuation", number<&U::speed>, kNone, kSpeedAmplitude, integration, kRandom, "relative amplitude of a sinusoidal fluctuation of the speed; the input torque accelerates all masses"},
    {"operation", "speed_fluctuation_order", number<&U::speed_order>, kNone, kPositive, needed_with<"operation.speed_fluctuation">, kRandom, "periods of the speed fluctuation in a turn of the input member (the pinion)"},
    {"operation", "speed_fluctuation_phase_deg", number<&U::speed_phase_rad>, kDeg, closed_range(-360, 360), only_with<"operation.speed_fluctuation">, kRandom, "phase of the speed fluctuation at the first recorded mesh period"},
    {"operation", "speed_noise", number<&U::speed_noise>, kNone, kSpeedNoise, integration, kRandom, "relative rms of a random fluctuation of the speed"},
    {"operation", "speed_noise_band_Hz", number<&U::speed_noise_Hz>, kHz, kFrequency, needed_with<"operation.speed_noise">, kRandom, "frequency at which the spectrum of speed_noise has fallen to half, at the mean speed"},

    {"effects", "motion", choice<&Effects::motion>(kMotions), kNone, kAny, may, kShared, "degrees of freedom"},
    {"effects", "foundation", choice<&Effects::foundation>(kFoundations), kNone, kAny, tooth_model, kShared, "compliance of the gear bodies under the teeth"},
    {"effects", "contact", choice<&Effects::contact>(kContacts), kNone, kAny, tooth_model, kShared, "law of the contact between teeth"},
    {"effects", "contact_onset", choice<&Effects::contact_onset>(kOnsets), kNone, kAny, tooth_model, kShared, "start and end of tooth contact: abrupt, with the full stiffness at the ends of the nominal path of contact, or extended, when the deflected gears close the gap that the tip corners leave before and after it"},
    {"effects", "shear", boolean<&Effects::shear>, kNone, kAny, tooth_model, kShared, "shear energy of the teeth"},
    {"effects", "separation", choice<&Effects::separation>(kSeparations), kNone, kAny, may, kShared, "loss of contact of the teeth: none, one-sided, or two-sided with contact of the back flanks"},
    {"effects", "inertial_terms", boolean<&Effects::inertial_terms>, kNone, kAny, planetary<may>, kShared, "Coriolis and centrifugal terms of the turning carrier"},
    {"effects", "mesh_damping", choice<&Effects::mesh_damping>(kDampings), kNone, kAny, may, kShared, "law of mesh damping"},
    {"effects", "gravity", boolean<&Effects::gravity>, kNone, kAny, may, kShared, "weight of all bodies, along -y: away from the sensor of a planetary gearbox, whose frame it turns in if the carrier turns; y is the line of action of a fixed-shaft one"},
    {"effects", "path", listed<&Effects::path, signals::path_windows>(path_names()), kNone, kAny, may, kShared, "window function of the transmission path"},
};
// clang-format on

}  // namespace

std::span<const Key> operation_keys() {
    return kOperationKeys;
}

}  // namespace gearpod::mc
