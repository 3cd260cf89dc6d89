// Interface of a kind of fault, one file per kind: names, keys, checks against the tooth, and the
// corresponding fault model of the stiffness library. All kinds: all_faults().
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gears/mesh_geometry.hpp"
#include "mc/study/draft.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/keys/key.hpp"
#include "stiffness/foundation/fillet_foundation.hpp"
#include "stiffness/teeth/tooth_fault.hpp"

namespace gearpod::mc {

// Key of [fault] that gives the fault's size: depth, stage, width or fraction. It is the only key
// of a kind that may be random.
struct FaultSize {
    std::string_view name;  // "depth_mm"
    NumberAccess access;
    Unit unit;
    Range range;
    std::string_view doc;
};

// Any other key of [fault] that a kind has. Kinds may share a key.
struct FaultKey {
    std::string_view name;
    AnyAccess access;
    Unit unit;
    Range range;
    Need need;  // when the study has this kind
    std::string_view fixed_because;
    std::string_view doc;
};

// Mesh in which the faulty tooth engages.
struct FaultyTooth {
    MeshMembers mesh;
    const std::optional<gears::MeshGeometry>& geometry;  // empty where the stiffness is given
    int gear;  // gear with the faulty tooth: 1 or 2 of the mesh
    const stiffness::FilletFoundation* foundation;  // foundation of that gear, or null
    bool reversed;                                  // true if the mesh's first gear is driven
};

// Part of a tooth dimension that a fault size (SI) takes: size * factor / whole.
struct SizeShare {
    double factor = 1.0, whole = 0.0;
    std::string of;  // "the tooth section"; "" if the size is no part of a dimension

    std::string text(double size) const;  // "70 % of the tooth section", or ""
};

class FaultKind {
  public:
    virtual std::string_view name() const = 0;   // in study files, "spatial-crack"
    virtual std::string_view words() const = 0;  // in messages, "a spatial crack"
    // Name in descriptions of a study.
    virtual std::string_view title() const { return name(); }
    virtual const FaultSize& size() const = 0;
    virtual std::span<const FaultKey> other_keys() const { return {}; }
    // True if the fault changes the tooth's sections or its contact; false if only the pair's
    // stiffness.
    virtual bool shapes_tooth() const { return true; }
    // False if a planet's tooth may have the fault on both flanks.
    virtual bool on_one_flank() const { return shapes_tooth(); }
    // True if the fault is wear of all flanks of the gear; its size is then the depth in m.
    virtual bool wears_flanks() const { return false; }
    // Rejects values that the faulty tooth cannot have, of known gears and face width.
    virtual void check(StudyDraft& /*draft*/) const {}
    // Null for wear, which changes no stiffness.
    virtual std::unique_ptr<const stiffness::ToothFaultFamily> family(
        const Study& study, const FaultyTooth& tooth) const = 0;

    // Text for the user: location of the fault on the tooth, and the datum from which its sizes
    // (SI) are measured. Needs the tooth geometry if the kind shapes the tooth.
    virtual std::string origin(const Study& study, std::span<const double> sizes) const = 0;

    // Part of the tooth that a size takes. Needs what origin() needs.
    virtual SizeShare share(const Study& /*study*/) const { return {}; }

    // All keys of the kind, the size first.
    std::vector<FaultKey> keys() const;

  protected:
    ~FaultKind() = default;
};

// Kinds of fault that a study can have.

// All kinds, in the order in which their keys are shown.
std::span<const FaultKind* const> all_faults();

// Kind of fault that defines the size key: the study's own, or the first kind (with size 0) for a
// study without a fault.
const FaultKind& size_defining_kind(const Study& study);

// Upper limits of fault sizes set by the faulty tooth, shared by the checks of several kinds.

inline constexpr double kMmPerM = 1e3;
inline constexpr double kMargin = 1.0 + 1e-12;  // for the rounding of unit conversions

// Largest size that the tooth allows, in the file's unit, and the reason.
struct SizeLimit {
    double largest;
    std::string why;  // "longer than the tooth (...)"
};

// The limit rounded down to four decimals, so that the value named in a message is allowed.
double rounded_down(double limit);

// Rejects sizes above the limit, whether nominal or random.
void check_size(StudyDraft& draft, const SizeLimit& limit);
// The same with the face width as the limit.
void check_on_face(StudyDraft& draft);

// Part of the face width that a size along it takes.
SizeShare share_of_face(const Study& study);

// Height of the faulty member's teeth, from root to tip circle, m.
double tooth_height_m(const Study& study);

}  // namespace gearpod::mc
