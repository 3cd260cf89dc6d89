// Units, ranges and reasons against randomness that several keys share.
#pragma once

#include <concepts>
#include <limits>
#include <tuple>
#include <type_traits>
#include <utility>

#include "mc/study/keys/key.hpp"

namespace gearpod::mc {

inline constexpr double kPi = 3.14159265358979323846;

inline constexpr Unit kNone{"", "1", "", "1", 1.0};
inline constexpr Unit kMm{"mm", "mm", "m", "m", 1e-3};
inline constexpr Unit kUm{"um", "um", "m", "m", 1e-6};
inline constexpr Unit kDeg{"deg", "deg", "rad", "rad", kPi / 180};
inline constexpr Unit kArcsec{"arcsec", "arcsec", "rad", "rad", kPi / 648000};
inline constexpr Unit kPa{"Pa", "Pa", "Pa", "Pa", 1.0};
inline constexpr Unit kKg{"kg", "kg", "kg", "kg", 1.0};
inline constexpr Unit kKgM2{"kg_m2", "kg m^2", "kg_m2", "kg m^2", 1.0};
inline constexpr Unit kNPerM{"N_m", "N/m", "N_m", "N/m", 1.0};
inline constexpr Unit kNSPerM{"N_s_m", "N s/m", "N_s_m", "N s/m", 1.0};
inline constexpr Unit kNm{"N_m", "N m", "N_m", "N m", 1.0};
inline constexpr Unit kNmPerRad{"N_m_rad", "N m/rad", "N_m_rad", "N m/rad", 1.0};
inline constexpr Unit kNmSPerRad{"N_m_s_rad", "N m s/rad", "N_m_s_rad", "N m s/rad", 1.0};
inline constexpr Unit kS{"s", "s", "s", "s", 1.0};
inline constexpr Unit kHours{"h", "h", "h", "h", 1.0};
inline constexpr Unit kHz{"Hz", "Hz", "Hz", "Hz", 1.0};
inline constexpr Unit kRpm{"rpm", "rpm", "rad_s", "rad/s", kPi / 30};
inline constexpr Unit kMPerS2{"m_s2", "m/s^2", "m_s2", "m/s^2", 1.0};
inline constexpr Unit kMPerS2RootHz{"m_s2_per_sqrt_Hz", "m/s^2/sqrt(Hz)", "m_s2_per_sqrt_Hz",
                                    "m/s^2/sqrt(Hz)", 1.0};

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr Range kAny{};
inline constexpr Range kPositive{0.0, kInfinity, true, false};
inline constexpr Range kNotNegative{0.0, kInfinity, false, false};
// ISO 1328-1:1995 grades.
inline constexpr Range kGrade{0.0, 12.0, false, false};
// Above the sampling rate of real converters; the limit also bounds the number of samples.
inline constexpr Range kFrequency{0.0, 1e7, true, false};
constexpr Range closed_range(double low, double high) {
    return {low, high, false, false};
}
constexpr Range inside(double low, double high) {
    return {low, high, true, true};
}

inline constexpr std::string_view kRandom = "";  // may be random
inline constexpr std::string_view kGeometry =
    "it defines the teeth, which are the same in all gearboxes";
inline constexpr std::string_view kSampling = "sampling is the same for all gearboxes";
inline constexpr std::string_view kShared = "it is the same for all gearboxes";
inline constexpr std::string_view kFaultShape = "only the size of a fault may be random";

// Builds the accessor of a schema line from a member of a part of Study:
// number<&Gearbox::module_m>. For values of one body or mesh: number<Member::sun,
// &MemberValues::mass_kg>. A fault kind's parameter struct is such a part, too.

template <class AnyStudy>
auto parts(AnyStudy& s) {
    return std::tie(s.gearbox, s.fixed_shaft, s.errors, s.planets, s.operation, s.fluctuations,
                    s.effects, s.fault, s.sensor, s.features, s.detection, s.monitoring, s.life,
                    s.numerics, s.ensemble);
}
template <class Part>
Part& part_of(Study& s) {
    return std::get<Part&>(parts(s));
}
template <class Part>
const Part& part_of(const Study& s) {
    return std::get<const Part&>(parts(s));
}
template <std::derived_from<FaultShape> Part>
Part& part_of(Study& s) {
    return s.fault.shapes.edit<Part>();
}
template <std::derived_from<FaultShape> Part>
const Part& part_of(const Study& s) {
    return s.fault.shapes.get<Part>();
}

template <class Part, class Type>
Part part_type(Type Part::*);

template <auto Member>
using PartOf = decltype(part_type(Member));

// Reference to the value that a schema line names: a member of a part, or of the values of one body
// or mesh, or the parameter of a mesh-damping law.
template <auto Member, class AnyStudy>
    requires std::is_member_object_pointer_v<decltype(Member)>
auto& stored(AnyStudy& s) {
    return part_of<PartOf<Member>>(s).*Member;
}
template <mc::Member kBody, auto Value, class AnyStudy>
auto& stored(AnyStudy& s) {
    return s.gearbox.bodies[kBody].*Value;
}
template <MeshKind kMesh, auto Value, class AnyStudy>
auto& stored(AnyStudy& s) {
    return s.gearbox.meshes[kMesh].*Value;
}

template <MeshDamping kLaw, class AnyStudy>
auto& stored(AnyStudy& s) {
    return s.gearbox.mesh_damping[kLaw];
}

template <class Type>
struct Inner {
    using type = Type;
};
template <class Type>
struct Inner<std::optional<Type>> {
    using type = Type;
};
// Type of that value, without its std::optional.
template <auto... Named>
using TypeOf =
    typename Inner<std::remove_cvref_t<decltype(stored<Named...>(std::declval<Study&>()))>>::type;

template <class Enum>
constexpr ChoiceName name(std::string_view text, Enum value) {
    return {text, static_cast<int>(value)};
}

// `Shown` is the schema's type for the value: int64 for an int, int for an enumeration.
template <class Shown, auto... Named>
std::optional<Shown> get(const Study& s) {
    const std::optional<TypeOf<Named...>> value = stored<Named...>(s);
    return value ? std::optional<Shown>(static_cast<Shown>(*value)) : std::nullopt;
}
template <class Shown, auto... Named>
void set(Study& s, Shown value) {
    stored<Named...>(s) = static_cast<TypeOf<Named...>>(value);
}

template <auto... Named>
constexpr NumberAccess number{get<double, Named...>, set<double, Named...>};
template <auto... Named>
constexpr IntegerAccess integer{get<std::int64_t, Named...>, set<std::int64_t, Named...>};
template <auto... Named>
constexpr BooleanAccess boolean{get<bool, Named...>, set<bool, Named...>};
template <auto Member>
constexpr ChoiceAccess choice(std::span<const ChoiceName> names) {
    return {get<int, Member>, set<int, Member>, names};
}

// Choice that the program makes if the key is not given; it then reads "auto".
inline constexpr ChoiceName kAutomatic{"auto", -1};
template <auto Member>
std::optional<int> get_or_auto(const Study& s) {
    return get<int, Member>(s).value_or(kAutomatic.value);
}
template <auto Member>
void set_or_auto(Study& s, int value) {
    if (value == kAutomatic.value) {
        stored<Member>(s).reset();
    } else {
        set<int, Member>(s, value);
    }
}
template <auto Member>
constexpr ChoiceAccess choice_or_auto(std::span<const ChoiceName> names) {
    return {get_or_auto<Member>, set_or_auto<Member>, names};
}

// Choice from a list of objects: the member points to one of them, or is null for none. Its value
// is the 1-based index in the list, 0 for none.
template <class Entry>
const Entry* address(const Entry& entry) {
    return &entry;
}
template <class Entry>
const Entry* address(const Entry* entry) {
    return entry;
}
template <auto Member, auto List>
std::optional<int> get_listed(const Study& s) {
    int rank = 0;
    for (const auto& entry : List()) {
        ++rank;
        if (address(entry) == stored<Member>(s)) {
            return rank;
        }
    }
    return 0;
}
template <auto Member, auto List>
void set_listed(Study& s, int rank) {
    stored<Member>(s) = rank > 0 ? address(List()[static_cast<std::size_t>(rank - 1)]) : nullptr;
}
template <auto Member, auto List>
constexpr ChoiceAccess listed(std::span<const ChoiceName> names) {
    return {get_listed<Member, List>, set_listed<Member, List>, names};
}

template <auto... Named>
TypeOf<Named...> get_list(const Study& s) {
    return stored<Named...>(s);
}
template <auto... Named>
void set_list(Study& s, TypeOf<Named...> value) {
    stored<Named...>(s) = std::move(value);
}
// List of strings or of features in Python.
template <auto Member>
constexpr Access<TypeOf<Member>, TypeOf<Member>> list{get_list<Member>, set_list<Member>};
// List of tables. Read(list, reject) returns the elements, Text(element) a table.
template <auto Member, auto Read>
void read_tables(Study& s, const Value& elements, const RejectElement& reject) {
    stored<Member>(s) = Read(elements, reject);
}
template <auto Member, auto Text>
std::vector<std::string> table_texts(const Study& s) {
    std::vector<std::string> texts;
    for (const auto& element : stored<Member>(s)) {
        texts.push_back(Text(element));
    }
    return texts;
}
template <auto Member, auto Read, auto Text>
TablesAccess tables(std::string_view elements, std::span<const TableField> fields) {
    return {elements, fields, read_tables<Member, Read>, table_texts<Member, Text>};
}
template <auto... Named>
constexpr NumbersAccess numbers{get_list<Named...>, set_list<Named...>, false};
template <auto Member>
constexpr NumbersAccess ascending{get_list<Member>, set_list<Member>, true};

// Accessor of a number, an integer or a list of numbers, by the type of the value.
template <auto... Named>
AnyAccess access_of() {
    if constexpr (std::is_same_v<TypeOf<Named...>, int>) {
        return integer<Named...>;
    } else if constexpr (std::is_same_v<TypeOf<Named...>, double>) {
        return number<Named...>;
    } else {
        return numbers<Named...>;
    }
}
// Accessors of the same value in each body or mesh, in the order of the enumeration.
template <class Enum, auto Value, std::size_t... kAll>
std::array<AnyAccess, sizeof...(kAll)> each_of(std::index_sequence<kAll...>) {
    return {access_of<static_cast<Enum>(kAll), Value>()...};
}
template <auto Value>
std::array<AnyAccess, kAllMembers.size()> of_members() {
    return each_of<Member, Value>(std::make_index_sequence<kAllMembers.size()>());
}
template <auto Value>
std::array<AnyAccess, kMeshKinds> of_meshes() {
    return each_of<MeshKind, Value>(std::make_index_sequence<kMeshKinds>());
}

}  // namespace gearpod::mc
