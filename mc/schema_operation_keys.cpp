// Keys of [operation] and [effects].
#include "mc/schema_table.hpp"

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
constexpr ChoiceName kDampings[] = {name("ratio", MeshDamping::ratio),
                                    name("proportional", MeshDamping::proportional),
                                    name("constant", MeshDamping::constant)};
constexpr ChoiceName kPaths[] = {
    name("hamming", PathWindow::hamming), name("hann", PathWindow::hann),
    name("rectangular", PathWindow::rectangular), name("none", PathWindow::none)};

// clang-format off
const Key kKeys[] = {
    {"operation", "fixed", choice<&Operation::fixed>(kCentral), kNone, kAny, planetary<may>, kShared, "member that stands still"},
    {"operation", "input", choice<&Operation::input>(kCentral), kNone, kAny, planetary<may>, kShared, "member that is driven; the sun by default, or the ring if the sun is fixed"},
    {"operation", "torque_on", choice<&Operation::torque_on>(kCentral), kNone, kAny, planetary<may>, kShared, "member whose torque is given; the sun by default, or the ring if the sun is fixed"},
    {"operation", "torque_N_m", number<&Operation::torque_N_m>, kNm, kNotNegative, always, kRandom, "torque on that member, or of a fixed-shaft gearbox's motor"},
    {"operation", "sun_speed_rpm", number<&Operation::sun_speed_rad_s>, kRpm, kPositive, planetary<may>, kRandom, "speed of the sun"},
    {"operation", "ring_speed_rpm", number<&Operation::ring_speed_rad_s>, kRpm, kPositive, planetary<may>, kRandom, "speed of the ring"},
    {"operation", "carrier_speed_rpm", number<&Operation::carrier_speed_rad_s>, kRpm, kPositive, planetary<may>, kRandom, "speed of the carrier"},
    {"operation", "load_torque_N_m", number<&Operation::load_torque_N_m>, kNm, kNotNegative, fixed_shaft<may>, kRandom, "torque of the load; in balance with the motor's by default"},
    {"operation", "pinion_speed_rpm", number<&Operation::pinion_speed_rad_s>, kRpm, kPositive, fixed_shaft<always>, kRandom, "speed of the pinion"},

    {"effects", "motion", choice<&Effects::motion>(kMotions), kNone, kAny, may, kShared, "degrees of freedom"},
    {"effects", "foundation", choice<&Effects::foundation>(kFoundations), kNone, kAny, tooth_model, kShared, "compliance of the gear bodies under the teeth"},
    {"effects", "contact", choice<&Effects::contact>(kContacts), kNone, kAny, tooth_model, kShared, "law of the contact between teeth"},
    {"effects", "shear", boolean<&Effects::shear>, kNone, kAny, tooth_model, kShared, "shear energy of the teeth"},
    {"effects", "separation", choice<&Effects::separation>(kSeparations), kNone, kAny, may, kShared, "whether teeth lose contact: one-sided, or two-sided with contact of the back flanks"},
    {"effects", "inertial_terms", boolean<&Effects::inertial_terms>, kNone, kAny, planetary<may>, kShared, "Coriolis and centrifugal terms of the turning carrier"},
    {"effects", "mesh_damping", choice<&Effects::mesh_damping>(kDampings), kNone, kAny, may, kShared, "law of mesh damping"},
    {"effects", "path", choice<&Effects::path>(kPaths), kNone, kAny, may, kShared, "window of the transmission path"},
};
// clang-format on

}  // namespace

std::span<const Key> operation_keys() {
    return kKeys;
}

}  // namespace gearpod::mc
