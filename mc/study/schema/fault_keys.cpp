// Keys of [fault]. Each kind of fault has one size, the only key that may be random.
#include "mc/study/keys/access.hpp"
#include "mc/study/keys/units.hpp"
#include "mc/study/schema/presence.hpp"
#include "mc/study/schema/table.hpp"

namespace gearpod::mc {
namespace {

constexpr ChoiceName kFaults[] = {name("none", FaultKind::none),
                                  name("crack", FaultKind::crack),
                                  name("spatial-crack", FaultKind::spatial_crack),
                                  name("chip", FaultKind::chip),
                                  name("pitting", FaultKind::pitting),
                                  name("broken", FaultKind::broken),
                                  name("reduction", FaultKind::reduction)};
constexpr ChoiceName kToothed[] = {name("planet", Member::planet), name("sun", Member::sun),
                                   name("ring", Member::ring), name("pinion", Member::pinion),
                                   name("gear", Member::gear)};
constexpr ChoiceName kSides[] = {name("ring", FaultSide::ring), name("sun", FaultSide::sun),
                                 name("both", FaultSide::both)};

constexpr FaultKind kSpatial = FaultKind::spatial_crack;

// clang-format off
const Key kKeys[] = {
    {"fault", "kind", choice<&Fault::kind>(kFaults), kNone, kAny, always, kShared, "kind of fault"},
    {"fault", "member", choice<&Fault::member>(kToothed), kNone, kAny, faulty_member, kShared, "gear with the faulty tooth"},
    {"fault", "side", choice<&Fault::side>(kSides), kNone, kAny, planet_side, kShared, "mesh in which a planet's fault acts"},
    {"fault", "planet", integer<&Fault::planet>, kNone, from_to(1, 8), planet_number, kShared, "number of the faulty planet"},
    {"fault", "depth_mm", number<&Fault::depth_m>, kMm, kNotNegative, fault_needs<FaultKind::crack>, kRandom, "depth along the crack"},
    {"fault", "angle_deg", number<&Fault::angle_rad>, kDeg, inside(0, 90), crack_angle, "the tables of cracked teeth hold for one angle", "angle between crack and tooth centre line; of a spatial crack where it begins"},
    {"fault", "stage", number<&Fault::stage>, kNone, kNotNegative, fault_needs<kSpatial>, kRandom, "how far a spatial crack has grown: entry k of the growth lists is stage k, linear between them, 0 healthy"},
    {"fault", "growth_depth_mm", numbers<&Fault::growth_depth_m>, kMm, kPositive, fault_needs<kSpatial>, kFaultShape, "depths q1 where it begins"},
    {"fault", "growth_end_depth_mm", numbers<&Fault::growth_end_depth_m>, kMm, kNotNegative, fault_needs<kSpatial>, kFaultShape, "depths q2 at the other end face; 0 until it gets there"},
    {"fault", "growth_length_mm", numbers<&Fault::growth_length_m>, kMm, kPositive, fault_needs<kSpatial>, kFaultShape, "lengths L_c along the face width"},
    {"fault", "growth_height_mm", numbers<&Fault::growth_height_m>, kMm, kNotNegative, fault_needs<kSpatial>, kFaultShape, "heights l1 over the root where it begins"},
    {"fault", "growth_end_height_mm", numbers<&Fault::growth_end_height_m>, kMm, kNotNegative, fault_needs<kSpatial>, kFaultShape, "heights l2 at the other end face"},
    {"fault", "end_angle_deg", number<&Fault::end_angle_rad>, kDeg, Range{0.0, 90.0, true, false}, fault_may<kSpatial>, kFaultShape, "angle at the other end face; angle_deg by default"},
    {"fault", "height_wave", number<&Fault::height_wave>, kNone, kNotNegative, fault_may<kSpatial>, kFaultShape, "wave on the height, a of Yang (2022), Eq. 65; 0 for none"},
    {"fault", "height_waves", number<&Fault::height_waves>, kNone, kNotNegative, fault_may<kSpatial>, kFaultShape, "half waves along the face width, b of that equation"},
    {"fault", "slices", integer<&Fault::slices>, kNone, from_to(1, 10000), fault_may<kSpatial>, kFaultShape, "slices along the face width"},
    {"fault", "chip_mm", number<&Fault::chip_m>, kMm, kNotNegative, fault_needs<FaultKind::chip>, kRandom, "width that the chip takes off the face width at the tip"},
    {"fault", "chip_height_mm", number<&Fault::chip_height_m>, kMm, kPositive, fault_may<FaultKind::chip>, kFaultShape, "height of the chip along the tooth, from the tip; a quarter of its width by default"},
    {"fault", "pit_width_mm", number<&Fault::pit_width_m>, kMm, kNotNegative, fault_needs<FaultKind::pitting>, kRandom, "width of the pitted band along the face width"},
    {"fault", "pit_length_mm", number<&Fault::pit_length_m>, kMm, kPositive, fault_needs<FaultKind::pitting>, kFaultShape, "length of the band along the tooth height"},
    {"fault", "pit_radius_mm", number<&Fault::pit_radius_m>, kMm, kPositive, fault_needs<FaultKind::pitting>, kFaultShape, "radius of the band's centre"},
    {"fault", "pit_depth_mm", number<&Fault::pit_depth_m>, kMm, kNotNegative, fault_needs<FaultKind::pitting>, kFaultShape, "depth of the pits under the flank"},
    {"fault", "teeth", integer<&Fault::teeth>, kNone, from_to(1, 100), fault_may<FaultKind::pitting>, kFaultShape, "neighbouring pitted teeth"},
    {"fault", "broken", number<&Fault::broken>, kNone, from_to(0, 1), fault_needs<FaultKind::broken>, kRandom, "share of the tooth that has broken off: 1 carries nothing"},
    {"fault", "reduction", number<&Fault::reduction>, kNone, from_to(0, 1), fault_needs<FaultKind::reduction>, kRandom, "share of the tooth pair's stiffness that is lost"},
};
// clang-format on

}  // namespace

std::span<const Key> fault_keys() {
    return kKeys;
}

}  // namespace gearpod::mc
